/* SPDX-License-Identifier: Apache-2.0 */
/* Stylet in MATLAB and Octave: one MEX function over the C interface, which stylet.m makes into
 * calls with names. Handles are numbers that stylet.m keeps; each is looked up here, so that a
 * wrong or freed one is an error and nothing else. Places and forces are columns: 3 x n doubles. */
#include <mex.h>
#include <stdlib.h>
#include <string.h>
#include <stylet/stylet.h>

#define MOST_HANDLES 4096

enum kind { NOTHING, ORGAN, SIMULATION };
static struct {
  enum kind kind;
  void* handle;
} known[MOST_HANDLES];
static int locked;

static void fail(const char* text) {
  mexErrMsgIdAndTxt("stylet:refused", "%s", text);
}

static void check(stylet_status status, const stylet_refusal* why) {
  if (status == STYLET_OK) return;
  fail(why != NULL && why->text[0] != 0 ? why->text : stylet_status_name(status));
}

static void free_handle(int number) {
  if (known[number].kind == ORGAN) stylet_organ_free(known[number].handle);
  if (known[number].kind == SIMULATION) stylet_simulation_free(known[number].handle);
  known[number].kind = NOTHING;
  known[number].handle = NULL;
}

static void free_all(void) {
  for (int i = 0; i < MOST_HANDLES; ++i) free_handle(i);
}

static mxArray* new_handle(enum kind kind, void* handle) {
  for (int i = 1; i < MOST_HANDLES; ++i) {
    if (known[i].kind != NOTHING) continue;
    known[i].kind = kind;
    known[i].handle = handle;
    return mxCreateDoubleScalar(i);
  }
  if (kind == ORGAN) stylet_organ_free(handle);
  if (kind == SIMULATION) stylet_simulation_free(handle);
  fail("4095 organs and simulations are open: expected fewer: free some");
  return NULL;
}

static double number(const mxArray* value, const char* what) {
  if (!mxIsNumeric(value) || mxIsComplex(value) || mxIsSparse(value) ||
      mxGetNumberOfElements(value) != 1) {
    mexErrMsgIdAndTxt("stylet:refused", "%s: expected one number", what);
  }
  return mxGetScalar(value);
}

static void* handle_of(const mxArray* value, enum kind kind) {
  const double at = number(value, "handle");
  if (!(at >= 1 && at < MOST_HANDLES) || known[(int)at].kind != kind) {
    fail(kind == ORGAN ? "expected an organ that is open" : "expected a simulation that is open");
  }
  return known[(int)at].handle;
}

static const double* columns(const mxArray* value, size_t rows, const char* what, size_t* count) {
  /* A sparse matrix has fewer numbers than elements, so numbers behind it would be read. */
  if (!mxIsDouble(value) || mxIsComplex(value) || mxIsSparse(value) || mxGetM(value) != rows) {
    mexErrMsgIdAndTxt("stylet:refused", "%s: expected a full matrix of doubles with %d rows", what,
                      (int)rows);
  }
  *count = mxGetN(value);
  return mxGetPr(value);
}

/* A struct's fields of these names; fields of other names are refused. */
struct field {
  const char* name;
  float* value;
  uint32_t* count;
  stylet_vec3* vector;
};

static stylet_vec3 vector_of(const mxArray* value, const char* what) {
  if (!mxIsDouble(value) || mxIsComplex(value) || mxIsSparse(value) ||
      mxGetNumberOfElements(value) != 3) {
    mexErrMsgIdAndTxt("stylet:refused", "%s: expected three numbers", what);
  }
  const double* from = mxGetPr(value);
  const stylet_vec3 out = {(float)from[0], (float)from[1], (float)from[2]};
  return out;
}

static void take_field(const mxArray* from, const struct field* field, const char* what) {
  if (field->vector != NULL) {
    *field->vector = vector_of(from, field->name);
    return;
  }
  const double value = number(from, field->name);
  if (field->value != NULL) {
    *field->value = (float)value;
  } else if (value >= 0 && value <= 4294967295.0 && value == (uint32_t)value) {
    *field->count = (uint32_t)value;
  } else {
    mexErrMsgIdAndTxt("stylet:refused", "%s.%s: %g: expected a whole number", what, field->name,
                      value);
  }
}

static void take_fields(const mxArray* from, const struct field* fields, int field_count,
                        const char* what) {
  if (from == NULL || mxIsEmpty(from)) return;
  if (!mxIsStruct(from) || mxGetNumberOfElements(from) != 1) {
    mexErrMsgIdAndTxt("stylet:refused", "%s: expected one struct", what);
  }
  for (int i = 0; i < mxGetNumberOfFields(from); ++i) {
    const char* name = mxGetFieldNameByNumber(from, i);
    int found = 0;
    for (int j = 0; j < field_count; ++j) {
      if (strcmp(name, fields[j].name) != 0) continue;
      take_field(mxGetFieldByNumber(from, 0, i), &fields[j], what);
      found = 1;
    }
    if (!found) mexErrMsgIdAndTxt("stylet:refused", "%s: no field is called %s", what, name);
  }
}

static void open_organ(mxArray** out, const mxArray** in) {
  char* path = mxArrayToString(in[0]);
  if (path == NULL) fail("expected the name of an organ file");
  stylet_organ* organ = NULL;
  stylet_refusal why = {.struct_bytes = sizeof why};
  const stylet_status status = stylet_organ_read(path, &organ, &why);
  mxFree(path);
  check(status, &why);
  out[0] = new_handle(ORGAN, organ);
}

static mxArray* row(const stylet_vec3 v) {
  mxArray* out = mxCreateDoubleMatrix(3, 1, mxREAL);
  double* to = mxGetPr(out);
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
  return out;
}

static mxArray* places(const stylet_vec3* from, uint32_t count) {
  mxArray* out = mxCreateDoubleMatrix(3, count, mxREAL);
  double* to = mxGetPr(out);
  for (uint32_t i = 0; i < count; ++i) {
    to[3 * (size_t)i] = from[i].x;
    to[3 * (size_t)i + 1] = from[i].y;
    to[3 * (size_t)i + 2] = from[i].z;
  }
  return out;
}

static void organ_info(mxArray** out, const mxArray** in) {
  const stylet_organ* organ = handle_of(in[0], ORGAN);
  stylet_organ_info info = {.struct_bytes = sizeof info};
  check(stylet_organ_get_info(organ, &info), NULL);
  const char* names[] = {"name",     "voxel_edge_m", "low_m",     "high_m",
                         "vertices", "triangles",    "materials", "voxels"};
  out[0] = mxCreateStructMatrix(1, 1, 8, names);
  mxSetField(out[0], 0, "name", mxCreateString(info.name));
  mxSetField(out[0], 0, "voxel_edge_m", mxCreateDoubleScalar(info.voxel_edge_m));
  mxSetField(out[0], 0, "low_m", row(info.low_m));
  mxSetField(out[0], 0, "high_m", row(info.high_m));
  mxSetField(out[0], 0, "materials", mxCreateDoubleScalar(info.materials));
  mxSetField(out[0], 0, "voxels", mxCreateDoubleScalar(info.voxels));
  stylet_vec3* rest = mxCalloc(info.vertices + 1, sizeof *rest);
  uint32_t* corners = mxCalloc(3 * (size_t)info.triangles + 1, sizeof *corners);
  stylet_organ_vertices(organ, rest, info.vertices);
  stylet_organ_triangles(organ, corners, info.triangles);
  mxSetField(out[0], 0, "vertices", places(rest, info.vertices));
  mxArray* triangles = mxCreateDoubleMatrix(3, info.triangles, mxREAL);
  for (size_t i = 0; i < 3 * (size_t)info.triangles; ++i) {
    mxGetPr(triangles)[i] = corners[i] + 1; /* counted from 1, as trisurf does */
  }
  mxSetField(out[0], 0, "triangles", triangles);
  mxFree(rest);
  mxFree(corners);
}

/* The library takes a direction without length as -z: after a mistake the needle points down. */
static const double* direction(const mxArray* value) {
  size_t one;
  const double* way = columns(value, 3, "direction", &one);
  if (one != 1) fail("expected one direction, 3 x 1");
  if (!mxIsFinite(way[0]) || !mxIsFinite(way[1]) || !mxIsFinite(way[2])) {
    fail("direction: expected finite numbers");
  }
  return way;
}

static void raycast(mxArray** out, const mxArray** in) {
  size_t one;
  const double* from = columns(in[1], 3, "origin", &one);
  const double* way = direction(in[2]);
  if (one != 1) fail("expected one origin, 3 x 1");
  float distance = 0;
  const int hit = stylet_organ_raycast(
      handle_of(in[0], ORGAN), (stylet_vec3){(float)from[0], (float)from[1], (float)from[2]},
      (stylet_vec3){(float)way[0], (float)way[1], (float)way[2]}, &distance);
  out[0] = mxCreateDoubleScalar(hit ? distance : mxGetInf());
}

static void create(mxArray** out, const mxArray** in) {
  stylet_config c;
  stylet_needle n;
  check(stylet_config_init(&c, sizeof c), NULL);
  check(stylet_needle_init(&n, sizeof n), NULL);
  const struct field of_config[] = {
      {"mode", NULL, &c.mode, NULL},
      {"period_s", &c.period_s, NULL, NULL},
      {"substeps", NULL, &c.substeps, NULL},
      {"inertia", NULL, &c.inertia, NULL},
      {"tissue_damping_s", &c.tissue_damping_s, NULL, NULL},
      {"surround_drag_per_s", &c.surround_drag_per_s, NULL, NULL},
      {"hourglass_weight", &c.hourglass_weight, NULL, NULL},
      {"paper_alpha", &c.paper_alpha, NULL, NULL},
      {"breathing_amplitude_m", NULL, NULL, &c.breathing_amplitude_m},
      {"breathing_period_s", &c.breathing_period_s, NULL, NULL},
      {"gravity_m_per_s2", NULL, NULL, &c.gravity_m_per_s2},
  };
  const struct field of_needle[] = {
      {"length_m", &n.length_m, NULL, NULL},
      {"outer_radius_m", &n.outer_radius_m, NULL, NULL},
      {"unit_m", &n.unit_m, NULL, NULL},
      {"bending_nm2", &n.bending_nm2, NULL, NULL},
      {"rods", NULL, &n.rods, NULL},
      {"bevel_per_m", &n.bevel_per_m, NULL, NULL},
      {"bent_length_m", &n.bent_length_m, NULL, NULL},
      {"bent_angle_rad", &n.bent_angle_rad, NULL, NULL},
      {"torsion_nm2", &n.torsion_nm2, NULL, NULL},
      {"tip_half_angle_rad", &n.tip_half_angle_rad, NULL, NULL},
      {"torn_diameters", &n.torn_diameters, NULL, NULL},
      {"hub", NULL, &n.hub, NULL},
      {"bore_radius_m", &n.bore_radius_m, NULL, NULL},
      {"opening_m", &n.opening_m, NULL, NULL},
      {"filling_pa_s", &n.filling_pa_s, NULL, NULL},
      {"plunger_radius_m", &n.plunger_radius_m, NULL, NULL},
      {"plunger_friction_n", &n.plunger_friction_n, NULL, NULL},
      {"syringe_m3", &n.syringe_m3, NULL, NULL},
      {"syringe_filled", &n.syringe_filled, NULL, NULL},
      {"syringe_gas_m3", &n.syringe_gas_m3, NULL, NULL},
  };
  take_fields(in[1], of_needle, sizeof of_needle / sizeof *of_needle, "needle");
  take_fields(in[2], of_config, sizeof of_config / sizeof *of_config, "config");
  stylet_simulation* made = NULL;
  stylet_refusal why = {.struct_bytes = sizeof why};
  check(stylet_simulation_create(handle_of(in[0], ORGAN), &c, &n, 1, &made, &why), &why);
  out[0] = new_handle(SIMULATION, made);
}

/* Poses, 7 x n: position and quaternion (w x y z) of the handle in each tick. With an eighth row,
 * the force on a syringe's plunger. */
static void run(mxArray** out, const mxArray** in) {
  stylet_simulation* simulation = handle_of(in[0], SIMULATION);
  size_t ticks;
  const size_t numbers = mxGetM(in[1]) == 8 ? 8 : 7;
  const double* poses = columns(in[1], numbers, "poses", &ticks);
  enum { FIELDS = 13 };
  const char* names[FIELDS] = {
      "force_n",    "torque_nm", "tip_m",      "depth_m",       "phase",       "layer",    "flags",
      "friction_n", "hub_pa",    "opening_pa", "flow_m3_per_s", "injected_m3", "plunger_m"};
  mxArray* to[FIELDS];
  const int rows[FIELDS] = {3, 3, 3, 1, 1, 1, 1, 3, 1, 1, 1, 1, 1};
  out[0] = mxCreateStructMatrix(1, 1, FIELDS, names);
  for (int f = 0; f < FIELDS; ++f) {
    to[f] = mxCreateDoubleMatrix(rows[f], ticks, mxREAL);
    mxSetField(out[0], 0, names[f], to[f]);
  }
  for (size_t i = 0; i < ticks; ++i) {
    const double* p = poses + numbers * i;
    const stylet_input input = {sizeof input,
                                1,
                                {{(float)p[0], (float)p[1], (float)p[2]},
                                 {(float)p[3], (float)p[4], (float)p[5], (float)p[6]}},
                                numbers == 8 ? (float)p[7] : 0};
    stylet_output o = {.struct_bytes = sizeof o};
    check(stylet_simulation_tick(simulation, &input, 1, &o, 1), NULL);
    const double all[FIELDS][3] = {{o.force_n.x, o.force_n.y, o.force_n.z},
                                   {o.torque_nm.x, o.torque_nm.y, o.torque_nm.z},
                                   {o.tip_m.x, o.tip_m.y, o.tip_m.z},
                                   {o.depth_m},
                                   {o.phase},
                                   {o.layer == STYLET_NO_LAYER ? mxGetNaN() : o.layer + 1},
                                   {o.flags},
                                   {o.friction_n.x, o.friction_n.y, o.friction_n.z},
                                   {o.hub_pa},
                                   {o.opening_pa},
                                   {o.flow_m3_per_s},
                                   {o.injected_m3},
                                   {o.plunger_m}};
    for (int f = 0; f < FIELDS; ++f) {
      for (int r = 0; r < rows[f]; ++r) mxGetPr(to[f])[rows[f] * i + r] = all[f][r];
    }
  }
}

static void pose_of_tip(mxArray** out, const mxArray** in) {
  size_t count;
  const double* tips = columns(in[0], 3, "tips", &count);
  const double* way = direction(in[1]);
  const double length = number(in[2], "length_m");
  out[0] = mxCreateDoubleMatrix(7, count, mxREAL);
  double* to = mxGetPr(out[0]);
  for (size_t i = 0; i < count; ++i) {
    const stylet_pose pose = stylet_pose_of_tip(
        (stylet_vec3){(float)tips[3 * i], (float)tips[3 * i + 1], (float)tips[3 * i + 2]},
        (stylet_vec3){(float)way[0], (float)way[1], (float)way[2]}, (float)length);
    const double all[7] = {pose.position_m.x, pose.position_m.y, pose.position_m.z, pose.rotation.w,
                           pose.rotation.x,   pose.rotation.y,   pose.rotation.z};
    memcpy(to + 7 * i, all, sizeof all);
  }
}

static void surface(mxArray** out, const mxArray** in) {
  const stylet_simulation* simulation = handle_of(in[0], SIMULATION);
  const uint32_t count = stylet_simulation_surface(simulation, NULL, 0);
  stylet_vec3* from = mxCalloc(count + 1, sizeof *from);
  stylet_simulation_surface(simulation, from, count);
  out[0] = places(from, count);
  mxFree(from);
}

static void needle_shape(mxArray** out, const mxArray** in) {
  stylet_vec3 nodes[STYLET_MAX_RODS + 1];
  const uint32_t count =
      stylet_simulation_needle_shape(handle_of(in[0], SIMULATION), 0, nodes, STYLET_MAX_RODS + 1);
  out[0] = places(nodes, count);
}

static void events(mxArray** out, const mxArray** in) {
  stylet_event all[STYLET_MAX_EVENTS];
  const uint32_t count =
      stylet_simulation_events(handle_of(in[0], SIMULATION), all, STYLET_MAX_EVENTS);
  const char* names[] = {"tick", "kind", "layer", "depth_m", "force_n"};
  out[0] = mxCreateStructMatrix(count, 1, 5, names);
  for (uint32_t i = 0; i < count; ++i) {
    mxSetField(out[0], i, "tick", mxCreateDoubleScalar((double)all[i].tick));
    mxSetField(out[0], i, "kind", mxCreateString(stylet_event_name(all[i].kind)));
    mxSetField(out[0], i, "layer", mxCreateDoubleScalar(all[i].layer + 1.0));
    mxSetField(out[0], i, "depth_m", mxCreateDoubleScalar(all[i].depth_m));
    mxSetField(out[0], i, "force_n", mxCreateDoubleScalar(all[i].force_n));
  }
}

static void hash(mxArray** out, const mxArray** in) {
  out[0] = mxCreateNumericMatrix(1, 1, mxUINT64_CLASS, mxREAL);
  const uint64_t value = stylet_simulation_hash(handle_of(in[0], SIMULATION));
  memcpy(mxGetData(out[0]), &value, sizeof value);
}

static void reset(mxArray** out, const mxArray** in) {
  (void)out;
  check(stylet_simulation_reset(handle_of(in[0], SIMULATION)), NULL);
}

static void free_one(mxArray** out, const mxArray** in) {
  (void)out;
  const double at = number(in[0], "handle");
  if (at >= 1 && at < MOST_HANDLES) free_handle((int)at);
}

static void version(mxArray** out, const mxArray** in) {
  (void)in;
  out[0] = mxCreateString(stylet_version_text());
}

static const struct {
  const char* name;
  int arguments;
  void (*call)(mxArray** out, const mxArray** in);
} commands[] = {
    {"organ", 1, open_organ}, {"info", 1, organ_info},
    {"raycast", 3, raycast},  {"simulation", 3, create},
    {"run", 2, run},          {"pose_of_tip", 3, pose_of_tip},
    {"surface", 1, surface},  {"shape", 1, needle_shape},
    {"events", 1, events},    {"hash", 1, hash},
    {"reset", 1, reset},      {"free", 1, free_one},
    {"version", 0, version},
};

void mexFunction(int out_count, mxArray* out[], int in_count, const mxArray* in[]) {
  (void)out_count;
  if (!locked) {
    locked = 1;
    mexAtExit(free_all);
  }
  char name[32] = "";
  if (in_count < 1 || mxGetString(in[0], name, sizeof name) != 0) fail("expected a command");
  for (size_t i = 0; i < sizeof commands / sizeof *commands; ++i) {
    if (strcmp(name, commands[i].name) != 0) continue;
    if (in_count - 1 != commands[i].arguments) {
      mexErrMsgIdAndTxt("stylet:refused", "%s: expected %d arguments", name, commands[i].arguments);
    }
    commands[i].call(out, in + 1);
    return;
  }
  mexErrMsgIdAndTxt("stylet:refused", "%s: expected the name of a command", name);
}
