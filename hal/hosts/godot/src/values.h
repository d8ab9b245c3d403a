/* SPDX-License-Identifier: Apache-2.0 */
/* Godot's values from C's, and back.
 *
 * Frames: the organ's is right-handed with z up, Godot's with y up; places go through to_godot and
 * from_godot, which move and negate numbers, so that none is rounded. */
#ifndef STYLET_GODOT_VALUES_H
#define STYLET_GODOT_VALUES_H

#include <gdnative_api_struct.gen.h>
#include <stylet/stylet.h>

static const godot_gdnative_core_api_struct* g_api; /* Godot gives it when it loads the library */

static inline stylet_vec3 to_godot(stylet_vec3 v) {
  const stylet_vec3 out = {v.x, v.z, 0 - v.y}; /* no negative zero, which has other bits */
  return out;
}
static inline stylet_vec3 from_godot(stylet_vec3 v) {
  const stylet_vec3 out = {v.x, 0 - v.z, v.y};
  return out;
}

static inline godot_variant nothing(void) {
  godot_variant out;
  g_api->godot_variant_new_nil(&out);
  return out;
}
static inline godot_variant of_real(double value) {
  godot_variant out;
  g_api->godot_variant_new_real(&out, value);
  return out;
}
static inline godot_variant of_int(int64_t value) {
  godot_variant out;
  g_api->godot_variant_new_int(&out, value);
  return out;
}
static inline godot_variant of_text(const char* text) {
  godot_string string = g_api->godot_string_chars_to_utf8(text);
  godot_variant out;
  g_api->godot_variant_new_string(&out, &string);
  g_api->godot_string_destroy(&string);
  return out;
}
static inline godot_vector3 vector_of(stylet_vec3 v) {
  const stylet_vec3 there = to_godot(v);
  godot_vector3 out;
  g_api->godot_vector3_new(&out, there.x, there.y, there.z);
  return out;
}
static inline godot_variant of_vector(stylet_vec3 v) {
  const godot_vector3 vector = vector_of(v);
  godot_variant out;
  g_api->godot_variant_new_vector3(&out, &vector);
  return out;
}
static inline stylet_vec3 vector_from(const godot_variant* value) {
  const godot_vector3 v = g_api->godot_variant_as_vector3(value);
  const stylet_vec3 out = {g_api->godot_vector3_get_axis(&v, GODOT_VECTOR3_AXIS_X),
                           g_api->godot_vector3_get_axis(&v, GODOT_VECTOR3_AXIS_Y),
                           g_api->godot_vector3_get_axis(&v, GODOT_VECTOR3_AXIS_Z)};
  return from_godot(out);
}
static inline bool is_number(const godot_variant* value) {
  const godot_variant_type type = g_api->godot_variant_get_type(value);
  return type == GODOT_VARIANT_TYPE_INT || type == GODOT_VARIANT_TYPE_REAL;
}

#endif
