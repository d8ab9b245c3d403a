/* SPDX-License-Identifier: Apache-2.0 */
/* Stylet in Godot 3: a GDNative library with one class, Stylet, over the interface in C. An object
 * is an organ with a needle in it. README.md says how it is built and what each function is for.
 *
 * The arrays that are passed in every frame are made once, so a frame allocates nothing here. */
#include <gdnative_api_struct.gen.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <stylet/stylet.h>

#include "hal/hosts/godot/src/values.h"

static const godot_gdnative_ext_nativescript_api_struct* g_script;

/* Place and normal of a vertex, as Godot keeps them for a surface without compression. */
typedef struct {
  stylet_vec3 place, normal;
} corner;

typedef struct {
  stylet_organ* organ;
  stylet_simulation* simulation;
  stylet_needle needle;
  stylet_input input;
  stylet_output output;
  uint32_t vertices, triangles;
  stylet_vec3* moved; /* in the organ's frame */
  uint32_t* corners;  /* of the triangles, counter-clockwise */
  godot_pool_byte_array region;
  godot_pool_vector3_array shape;
} stylet_object;

/* ==== An object ============================================================================== */

static void forget(stylet_object* it) {
  stylet_simulation_free(it->simulation);
  stylet_organ_free(it->organ);
  free(it->moved);
  free(it->corners);
  it->simulation = NULL;
  it->organ = NULL;
  it->moved = NULL;
  it->corners = NULL;
  it->vertices = it->triangles = 0;
}

static void* create(godot_object* self, void* data) {
  (void)self, (void)data;
  stylet_object* const it = calloc(1, sizeof *it);
  if (it == NULL) return NULL;
  g_api->godot_pool_byte_array_new(&it->region);
  g_api->godot_pool_vector3_array_new(&it->shape);
  return it;
}

static void destroy(godot_object* self, void* data, void* user) {
  (void)self, (void)data;
  stylet_object* const it = user;
  if (it == NULL) return;
  forget(it);
  g_api->godot_pool_byte_array_destroy(&it->region);
  g_api->godot_pool_vector3_array_destroy(&it->shape);
  free(it);
}

/* Names of a needle's numbers, as in stylet_needle. */
static const struct {
  const char* name;
  size_t at;
} kNumbers[] = {{"length_m", offsetof(stylet_needle, length_m)},
                {"outer_radius_m", offsetof(stylet_needle, outer_radius_m)},
                {"unit_m", offsetof(stylet_needle, unit_m)},
                {"bending_nm2", offsetof(stylet_needle, bending_nm2)},
                {"bevel_per_m", offsetof(stylet_needle, bevel_per_m)},
                {"bent_length_m", offsetof(stylet_needle, bent_length_m)},
                {"bent_angle_rad", offsetof(stylet_needle, bent_angle_rad)},
                {"torsion_nm2", offsetof(stylet_needle, torsion_nm2)},
                {"tip_half_angle_rad", offsetof(stylet_needle, tip_half_angle_rad)},
                {"torn_diameters", offsetof(stylet_needle, torn_diameters)}};

/* False: a needle has no number of this name, or `value` is not a number. */
static bool set_number(stylet_needle* needle, const char* name, const godot_variant* value) {
  if (!is_number(value)) return false;
  if (strcmp(name, "rods") == 0) {
    const int64_t rods = g_api->godot_variant_as_int(value);
    needle->rods = rods < 0 || rods > UINT32_MAX ? UINT32_MAX : (uint32_t)rods;
    return true;
  }
  for (size_t i = 0; i < sizeof kNumbers / sizeof kNumbers[0]; ++i) {
    if (strcmp(name, kNumbers[i].name) != 0) continue;
    *(float*)((char*)needle + kNumbers[i].at) = (float)g_api->godot_variant_as_real(value);
    return true;
  }
  return false;
}

/* Sets the numbers that the dictionary has; the first that is wrong is told in `fault`. */
static bool read_needle(const godot_variant* from, stylet_needle* needle, char* fault,
                        size_t room) {
  godot_dictionary all = g_api->godot_variant_as_dictionary(from);
  godot_array keys = g_api->godot_dictionary_keys(&all);
  bool good = true;
  for (godot_int i = 0; good && i < g_api->godot_array_size(&keys); ++i) {
    godot_variant key = g_api->godot_array_get(&keys, i);
    godot_variant value = g_api->godot_dictionary_get(&all, &key);
    godot_string name = g_api->godot_variant_as_string(&key);
    godot_char_string bytes = g_api->godot_string_utf8(&name);
    const char* const text = g_api->godot_char_string_get_data(&bytes);
    good = set_number(needle, text, &value);
    if (!good) snprintf(fault, room, "needle.%s: expected a number of stylet_needle", text);
    g_api->godot_char_string_destroy(&bytes);
    g_api->godot_string_destroy(&name);
    g_api->godot_variant_destroy(&value);
    g_api->godot_variant_destroy(&key);
  }
  g_api->godot_array_destroy(&keys);
  g_api->godot_dictionary_destroy(&all);
  return good;
}

/* Makes the arrays in which the surface is passed on. */
static bool make_room(stylet_object* it) {
  it->vertices = stylet_simulation_surface(it->simulation, NULL, 0);
  it->triangles = stylet_organ_triangles(it->organ, NULL, 0);
  it->moved = malloc((it->vertices + 1) * sizeof *it->moved);
  it->corners = malloc((3 * (size_t)it->triangles + 1) * sizeof *it->corners);
  if (it->moved == NULL || it->corners == NULL) return false;
  (void)stylet_organ_triangles(it->organ, it->corners, it->triangles);
  g_api->godot_pool_byte_array_resize(&it->region, (godot_int)(it->vertices * sizeof(corner)));
  return true;
}

static stylet_status open_organ(stylet_object* it, const godot_variant* bytes,
                                stylet_refusal* why) {
  godot_pool_byte_array all = g_api->godot_variant_as_pool_byte_array(bytes);
  godot_pool_byte_array_read_access* const access = g_api->godot_pool_byte_array_read(&all);
  const stylet_status status =
      stylet_organ_from_bytes(g_api->godot_pool_byte_array_read_access_ptr(access),
                              (size_t)g_api->godot_pool_byte_array_size(&all), &it->organ, why);
  g_api->godot_pool_byte_array_read_access_destroy(access);
  g_api->godot_pool_byte_array_destroy(&all);
  return status;
}

/* open(bytes, needle, period_s): an empty text, or what was refused. */
static godot_variant open_method(stylet_object* it, godot_variant** words) {
  char fault[160] = "";
  forget(it);
  stylet_refusal why = {.struct_bytes = sizeof why};
  stylet_config config;
  (void)stylet_config_init(&config, sizeof config);
  config.period_s = (float)g_api->godot_variant_as_real(words[2]);
  (void)stylet_needle_init(&it->needle, sizeof it->needle);
  if (!read_needle(words[1], &it->needle, fault, sizeof fault)) return of_text(fault);
  stylet_status status = open_organ(it, words[0], &why);
  if (status == STYLET_OK) {
    status = stylet_simulation_create(it->organ, &config, &it->needle, 1, &it->simulation, &why);
  }
  if (status == STYLET_OK && !make_room(it)) status = STYLET_OUT_OF_MEMORY;
  memset(&it->input, 0, sizeof it->input);
  memset(&it->output, 0, sizeof it->output);
  it->input.struct_bytes = sizeof it->input;
  it->output.struct_bytes = sizeof it->output;
  if (status == STYLET_OK) return of_text("");
  forget(it);
  return of_text(why.text[0] != '\0' ? why.text : stylet_status_name(status));
}

/* ==== The needle ============================================================================= */

/* move(tip, direction): where the unbent needle's tip is from the next tick on. */
static godot_variant move_method(stylet_object* it, godot_variant** words) {
  it->input.handle =
      stylet_pose_of_tip(vector_from(words[0]), vector_from(words[1]), it->needle.length_m);
  it->input.valid = 1;
  return nothing();
}

/* tick(count): computes this many ticks. */
static godot_variant tick_method(stylet_object* it, godot_variant** words) {
  const int64_t ticks = g_api->godot_variant_as_int(words[0]);
  for (int64_t i = 0; it->simulation != NULL && i < ticks; ++i) {
    (void)stylet_simulation_tick(it->simulation, &it->input, 1, &it->output, 1);
  }
  return nothing();
}

static godot_variant reset_method(stylet_object* it, godot_variant** words) {
  (void)words;
  (void)stylet_simulation_reset(it->simulation);
  return nothing();
}

/* force(): on the hand at the handle, newtons. */
static godot_variant force_method(stylet_object* it, godot_variant** words) {
  (void)words;
  return of_vector(it->output.force_n);
}

static godot_variant depth_method(stylet_object* it, godot_variant** words) {
  (void)words;
  return of_real((double)it->output.depth_m);
}

/* phase(): 0 free, 1 contact, 2 inserted, 3 retracting. */
static godot_variant phase_method(stylet_object* it, godot_variant** words) {
  (void)words;
  return of_int(it->output.phase);
}

/* event(): name of the newest event; empty: there was none. */
static godot_variant event_method(stylet_object* it, godot_variant** words) {
  (void)words;
  stylet_event all[STYLET_MAX_EVENTS];
  const uint32_t found = stylet_simulation_events(it->simulation, all, STYLET_MAX_EVENTS);
  return of_text(found == 0 ? "" : stylet_event_name(all[found - 1].kind));
}

/* state(): a hash of all that is simulated; the same ticks give the same one in every program. */
static godot_variant state_method(stylet_object* it, godot_variant** words) {
  (void)words;
  const uint64_t hash = stylet_simulation_hash(it->simulation);
  char text[17];
  snprintf(text, sizeof text, "%08lx%08lx", (unsigned long)(hash >> 32),
           (unsigned long)(hash & 0xFFFFFFFFU));
  return of_text(text);
}

/* ==== What is drawn ========================================================================== */

/* The direction of the sum of the normals of a vertex's triangles, each as long as its triangle is
 * large. */
static void add_normals(const stylet_object* it, corner* out) {
  for (uint32_t i = 0; i < it->triangles; ++i) {
    const uint32_t* const t = it->corners + 3 * (size_t)i;
    const stylet_vec3 a = out[t[0]].place, b = out[t[1]].place, c = out[t[2]].place;
    const stylet_vec3 u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
    const stylet_vec3 n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    for (int k = 0; k < 3; ++k) {
      out[t[k]].normal.x += n.x;
      out[t[k]].normal.y += n.y;
      out[t[k]].normal.z += n.z;
    }
  }
  for (uint32_t i = 0; i < it->vertices; ++i) {
    stylet_vec3* const n = &out[i].normal;
    const float length = sqrtf(n->x * n->x + n->y * n->y + n->z * n->z);
    if (length > 0) *n = (stylet_vec3){n->x / length, n->y / length, n->z / length};
  }
}

static void write_surface(stylet_object* it, corner* out) {
  (void)stylet_simulation_surface(it->simulation, it->moved, it->vertices);
  for (uint32_t i = 0; i < it->vertices; ++i) {
    const corner at = {to_godot(it->moved[i]), {0, 0, 0}};
    out[i] = at;
  }
  add_normals(it, out);
}

/* surface(): the bytes of all vertices, for VisualServer.mesh_surface_update_region. */
static godot_variant surface_method(stylet_object* it, godot_variant** words) {
  (void)words;
  if (it->simulation != NULL && it->vertices > 0) {
    godot_pool_byte_array_write_access* const access =
        g_api->godot_pool_byte_array_write(&it->region);
    write_surface(it, (corner*)(void*)g_api->godot_pool_byte_array_write_access_ptr(access));
    g_api->godot_pool_byte_array_write_access_destroy(access);
  }
  godot_variant out;
  g_api->godot_variant_new_pool_byte_array(&out, &it->region);
  return out;
}

static godot_variant corners_of(const stylet_object* it) {
  godot_pool_int_array all;
  g_api->godot_pool_int_array_new(&all);
  g_api->godot_pool_int_array_resize(&all, (godot_int)(3 * it->triangles));
  godot_pool_int_array_write_access* const access = g_api->godot_pool_int_array_write(&all);
  godot_int* const out = g_api->godot_pool_int_array_write_access_ptr(access);
  for (size_t i = 0; i < 3 * (size_t)it->triangles; i += 3) { /* clockwise, as Godot wants them */
    out[i] = (godot_int)it->corners[i];
    out[i + 1] = (godot_int)it->corners[i + 2];
    out[i + 2] = (godot_int)it->corners[i + 1];
  }
  g_api->godot_pool_int_array_write_access_destroy(access);
  godot_variant value;
  g_api->godot_variant_new_pool_int_array(&value, &all);
  g_api->godot_pool_int_array_destroy(&all);
  return value;
}

static godot_variant vectors_of(const stylet_object* it, const corner* from, bool normals) {
  godot_pool_vector3_array all;
  g_api->godot_pool_vector3_array_new(&all);
  g_api->godot_pool_vector3_array_resize(&all, (godot_int)it->vertices);
  godot_pool_vector3_array_write_access* const access = g_api->godot_pool_vector3_array_write(&all);
  godot_vector3* const out = g_api->godot_pool_vector3_array_write_access_ptr(access);
  for (uint32_t i = 0; i < it->vertices; ++i) {
    const stylet_vec3 v = normals ? from[i].normal : from[i].place;
    g_api->godot_vector3_new(&out[i], v.x, v.y, v.z);
  }
  g_api->godot_pool_vector3_array_write_access_destroy(access);
  godot_variant value;
  g_api->godot_variant_new_pool_vector3_array(&value, &all);
  g_api->godot_pool_vector3_array_destroy(&all);
  return value;
}

/* mesh(): the arrays of ArrayMesh.add_surface_from_arrays (vertices, normals, indices), once. */
static godot_variant mesh_method(stylet_object* it, godot_variant** words) {
  (void)words;
  enum { VERTEX = 0, NORMAL = 1, INDEX = 8, ALL = 9 }; /* ArrayMesh.ARRAY_... */
  godot_array arrays;
  g_api->godot_array_new(&arrays);
  g_api->godot_array_resize(&arrays, ALL);
  corner* const at = malloc((it->vertices + 1) * sizeof *at);
  if (it->simulation != NULL && at != NULL) {
    write_surface(it, at);
    godot_variant parts[3] = {vectors_of(it, at, false), vectors_of(it, at, true), corners_of(it)};
    const godot_int places[3] = {VERTEX, NORMAL, INDEX};
    for (int i = 0; i < 3; ++i) {
      g_api->godot_array_set(&arrays, places[i], &parts[i]);
      g_api->godot_variant_destroy(&parts[i]);
    }
  }
  free(at);
  godot_variant out;
  g_api->godot_variant_new_array(&out, &arrays);
  g_api->godot_array_destroy(&arrays);
  return out;
}

/* needle(): points along the needle, from handle to tip; none before its first tick. */
static godot_variant needle_method(stylet_object* it, godot_variant** words) {
  (void)words;
  stylet_vec3 nodes[STYLET_MAX_RODS + 1];
  const uint32_t all =
      stylet_simulation_needle_shape(it->simulation, 0, nodes, STYLET_MAX_RODS + 1);
  if (g_api->godot_pool_vector3_array_size(&it->shape) != (godot_int)all) {
    g_api->godot_pool_vector3_array_resize(&it->shape, (godot_int)all);
  }
  if (all > 0) {
    godot_pool_vector3_array_write_access* const access =
        g_api->godot_pool_vector3_array_write(&it->shape);
    godot_vector3* const out = g_api->godot_pool_vector3_array_write_access_ptr(access);
    for (uint32_t i = 0; i < all; ++i) out[i] = vector_of(nodes[i]);
    g_api->godot_pool_vector3_array_write_access_destroy(access);
  }
  godot_variant out;
  g_api->godot_variant_new_pool_vector3_array(&out, &it->shape);
  return out;
}

/* box(): around the surface at rest. */
static godot_variant box_method(stylet_object* it, godot_variant** words) {
  (void)words;
  stylet_organ_info info = {.struct_bytes = sizeof info};
  (void)stylet_organ_get_info(it->organ, &info);
  const stylet_vec3 corner_m = {info.low_m.x, info.high_m.y, info.low_m.z};
  const stylet_vec3 size_m = {info.high_m.x - info.low_m.x, info.low_m.y - info.high_m.y,
                              info.high_m.z - info.low_m.z};
  const godot_vector3 low = vector_of(corner_m), size = vector_of(size_m);
  godot_aabb box;
  g_api->godot_aabb_new(&box, &low, &size);
  godot_variant out;
  g_api->godot_variant_new_aabb(&out, &box);
  return out;
}

/* raycast(origin, direction): distance to the surface at rest; -1: the ray misses it. */
static godot_variant raycast_method(stylet_object* it, godot_variant** words) {
  float distance_m = 0;
  const int met =
      stylet_organ_raycast(it->organ, vector_from(words[0]), vector_from(words[1]), &distance_m);
  return of_real(met == 1 ? (double)distance_m : -1);
}

/* ==== What Godot asks for ==================================================================== */

enum {
  BYTES = GODOT_VARIANT_TYPE_POOL_BYTE_ARRAY,
  NAMES = GODOT_VARIANT_TYPE_DICTIONARY,
  NUMBER = GODOT_VARIANT_TYPE_REAL,
  VECTOR = GODOT_VARIANT_TYPE_VECTOR3
};
typedef struct {
  const char* name;
  godot_variant (*method)(stylet_object*, godot_variant**);
  int words, type[3]; /* how many it takes, and what they are */
  const char* expected;
} method_of_class;
static const method_of_class kMethods[] = {
    {"open",
     open_method,
     3,
     {BYTES, NAMES, NUMBER},
     "a PoolByteArray of an organ, a Dictionary of a needle, a period in seconds"},
    {"move", move_method, 2, {VECTOR, VECTOR}, "tip and direction, two Vector3"},
    {"tick", tick_method, 1, {NUMBER}, "a number of ticks"},
    {"raycast", raycast_method, 2, {VECTOR, VECTOR}, "origin and direction, two Vector3"},
    {"reset", reset_method, 0, {0}, "nothing"},
    {"force", force_method, 0, {0}, "nothing"},
    {"depth", depth_method, 0, {0}, "nothing"},
    {"phase", phase_method, 0, {0}, "nothing"},
    {"event", event_method, 0, {0}, "nothing"},
    {"state", state_method, 0, {0}, "nothing"},
    {"surface", surface_method, 0, {0}, "nothing"},
    {"mesh", mesh_method, 0, {0}, "nothing"},
    {"needle", needle_method, 0, {0}, "nothing"},
    {"box", box_method, 0, {0}, "nothing"}};

static bool fits(const method_of_class* method, int count, godot_variant** words) {
  bool good = count == method->words;
  for (int i = 0; good && i < count; ++i) {
    const int type = (int)g_api->godot_variant_get_type(words[i]);
    const bool whole = method->type[i] == NUMBER && type == GODOT_VARIANT_TYPE_INT;
    good = type == method->type[i] || whole;
  }
  return good;
}

/* `data` is the method that was called. */
static godot_variant call(godot_object* self, void* data, void* user, int count,
                          godot_variant** words) {
  (void)self;
  const method_of_class* const method = data;
  if (user != NULL && fits(method, count, words)) return method->method(user, words);
  char text[160];
  snprintf(text, sizeof text, "Stylet.%s: expected %s", method->name,
           user == NULL ? "memory" : method->expected);
  g_api->godot_print_error(text, method->name, "stylet_godot.c", 0);
  return of_text(text);
}

void GDN_EXPORT stylet_godot_gdnative_init(godot_gdnative_init_options* options) {
  g_api = options->api_struct;
  for (unsigned int i = 0; i < g_api->num_extensions; ++i) {
    if (g_api->extensions[i]->type == GDNATIVE_EXT_NATIVESCRIPT) {
      g_script =
          (const godot_gdnative_ext_nativescript_api_struct*)(const void*)g_api->extensions[i];
    }
  }
}

void GDN_EXPORT stylet_godot_gdnative_terminate(godot_gdnative_terminate_options* options) {
  (void)options;
  g_api = NULL;
  g_script = NULL;
}

void GDN_EXPORT stylet_godot_nativescript_init(void* handle) {
  const godot_instance_create_func made = {create, NULL, NULL};
  const godot_instance_destroy_func ended = {destroy, NULL, NULL};
  g_script->godot_nativescript_register_class(handle, "Stylet", "Reference", made, ended);
  const godot_method_attributes here = {GODOT_METHOD_RPC_MODE_DISABLED};
  for (size_t i = 0; i < sizeof kMethods / sizeof kMethods[0]; ++i) {
    const godot_instance_method method = {call, (void*)&kMethods[i], NULL};
    g_script->godot_nativescript_register_method(handle, "Stylet", kMethods[i].name, here, method);
  }
}
