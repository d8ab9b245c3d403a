// SPDX-License-Identifier: Apache-2.0
#include "rod.h"

#include <cmath>

namespace stylet {
namespace {

// A joint folded back further than this (163 degrees) gets no stiffer.
constexpr double kLeastOpening = 0.02;
constexpr double kMaxTurnRad = 0.5;
// Pivots below this share of the joint's stiffness are lifted, by this slope: a small positive
// pivot stays soft enough to buckle, and none becomes so small that the next ones explode.
constexpr double kLeastPivot = 0.01;
constexpr double kPivotLift = 100;
constexpr double kLeastCompressionShare = 1.0 / 1024;
constexpr double kLeastStepShare = 0.1;
// Square of a change of direction that is rounding, rad^2.
constexpr double kNoTurn2 = 1e-24;

constexpr Vec3d operator+(Vec3d a, Vec3d b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3d operator-(Vec3d a, Vec3d b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3d operator*(double s, Vec3d a) {
  return {s * a.x, s * a.y, s * a.z};
}
constexpr double dot(Vec3d a, Vec3d b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3d cross(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr Sym3d operator+(const Sym3d& a, const Sym3d& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
constexpr Sym3d operator*(double s, const Sym3d& a) {
  return {s * a.xx, s * a.xy, s * a.xz, s * a.yy, s * a.yz, s * a.zz};
}
constexpr Vec3d operator*(const Sym3d& a, Vec3d v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}
constexpr double max_of(double a, double b) {
  return a > b ? a : b;
}
constexpr double min_of(double a, double b) {
  return a < b ? a : b;
}

// The direction of a rod and the axes of its material; y = x cross along.
struct Frame {
  Vec3d along, x, y;
};

Frame handle_frame(const double (&q)[4]) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return {{-s * (x * z + w * y), s * (w * x - y * z), s * (x * x + y * y) - 1},
          {1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
          {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)}};
}

Vec3d rest_direction(const RodModel::Rest& rest, const Frame& before) {
  return rest.x * before.x + rest.y * before.y + rest.along * before.along;
}

// The frame of a rod that points along `along` and would at rest point along `rest`: the smallest
// turn from before to rest, then the smallest from rest to along. half_out is the frame half way
// along the second one; half_out.x and .y are the axes about which the joint bends.
Frame carried(const RodModel::Rest& kink, const Frame& before, Vec3d rest, Vec3d along,
              Frame& half_out) {
  const Vec3d x = before.x - kink.turn * (before.along + rest);
  const double opening = max_of(1 + dot(rest, along), 1e-9);
  const Vec3d sum = rest + along;
  half_out.along = (1 / std::sqrt(2 * opening)) * sum;
  const double lean = dot(half_out.along, x) / (1 + dot(half_out.along, rest));
  half_out.x = x - lean * (rest + half_out.along);
  half_out.y = cross(half_out.x, half_out.along);
  const Vec3d carried_x = x - (dot(along, x) / opening) * sum;
  return {along, carried_x, cross(carried_x, along)};
}

void place_rods(const RodModel& model, const Frame& handle, RodScratch& scratch,
                RodResult& result) {
  Frame frame = handle, half;
  result.node_m[0] = {0, 0, 0};
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    RodScratch::Joint& joint = scratch.joint[j];
    const Vec3d along = result.direction[j];
    joint.rest = rest_direction(model.rest[j], frame);
    frame = carried(model.rest[j], frame, joint.rest, along, half);
    joint.axis_1 = half.x;
    joint.axis_2 = half.y;
    result.node_m[j + 1] = result.node_m[j] + model.rod_m * along;
  }
}

// ==== Loads
// =========================================================================================

constexpr RodLoad kNoLoad{};

double share_below(double limit, double size) {
  return limit / max_of(limit, size);
}

// What is used of a load: within the limits, and nothing beyond the count.
RodLoad bounded(const RodLoads& loads, std::uint32_t i) {
  RodLoad a = i < loads.count ? loads.load[i] : kNoLoad;
  const Sym3d& k = a.stiffness_n_per_m;
  a.place_m = share_below(kMaxRodPlaceM, std::sqrt(dot(a.place_m, a.place_m))) * a.place_m;
  a.force_n = share_below(kMaxRodForceN, std::sqrt(dot(a.force_n, a.force_n))) * a.force_n;
  a.stiffness_n_per_m = share_below(kMaxRodStiffnessNPerM, k.xx + k.yy + k.zz) * k;
  return a;
}

struct OnRod {
  std::uint32_t rod;
  double from_start_m;
};

OnRod on_rod(const RodModel& model, double arc_m) {
  const double last = static_cast<double>(model.rods - 1);
  const auto rod = static_cast<std::uint32_t>(max_of(0, min_of(arc_m / model.rod_m, last)));
  const double rest_m = arc_m - static_cast<double>(rod) * model.rod_m;
  return {rod, max_of(0, min_of(rest_m, model.rod_m))};
}

// A place on a rod is linear in the rod's start and direction, so the loads of a rod add up to one
// quadratic function, whatever their number.
void lump_loads(const RodModel& model, const RodLoads& loads, RodScratch& scratch) {
  for (std::uint32_t j = 0; j < model.rods; ++j) scratch.lump[j] = {};
  for (std::uint32_t i = 0; i < kMaxRodLoads; ++i) {
    const RodLoad a = bounded(loads, i);
    const OnRod on = on_rod(model, a.arc_m);
    const Sym3d& k = a.stiffness_n_per_m;
    const Vec3d at_origin_n = a.force_n + k * a.place_m;
    RodScratch::Lump& lump = scratch.lump[on.rod];
    lump.start = lump.start + k;
    lump.mixed = lump.mixed + on.from_start_m * k;
    lump.along = lump.along + (on.from_start_m * on.from_start_m) * k;
    lump.start_n = lump.start_n + at_origin_n;
    lump.along_nm = lump.along_nm + on.from_start_m * at_origin_n;
  }
}

void read_loads(const RodModel& model, const RodLoads& loads, RodResult& result) {
  result.force_n = result.torque_nm = {0, 0, 0};
  for (std::uint32_t i = 0; i < kMaxRodLoads; ++i) {
    const RodLoad a = bounded(loads, i);
    const Vec3d at = rod_point(model, result, a.arc_m).place_m;
    const Vec3d force = a.force_n - a.stiffness_n_per_m * (at - a.place_m);
    result.load_n[i] = force;
    result.force_n = result.force_n + force;
    result.torque_nm = result.torque_nm + cross(at, force);
  }
}

// ==== Newton step
// ===================================================================================

// Energy of all that lies beyond a joint, to second order in the small displacement (0 to 2) and
// turn (3 to 5) of a rod: second derivative, first derivative.
struct Energy {
  double second[6][6];
  double first[6];
};

void spread(const Sym3d& a, double (&full_out)[3][3]) {
  const double full[3][3] = {{a.xx, a.xy, a.xz}, {a.xy, a.yy, a.yz}, {a.xz, a.yz, a.zz}};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) full_out[i][k] = full[i][k];
  }
}

// A rod's end moves by its start's displacement plus l (turn cross t): from a function of the end
// to one of the start. The loads on the rod join. Beyond first order the end moves by
// -l |turn|^2 t / 2, which is where an axial force gains or costs stiffness.
void move_to_start(double l, Vec3d t, Vec3d start, const RodScratch::Lump& load,
                   double compression_share, Energy& energy) {
  auto& h = energy.second;
  double* const g = energy.first;
  const Vec3d at_start = load.start * start + load.mixed * t - load.start_n;
  const Vec3d at_direction =
      l * Vec3d{g[0], g[1], g[2]} + (load.mixed * start + load.along * t - load.along_nm);

  double k_start[3][3], k_mixed[3][3], k_along[3][3], half[3][3];
  spread(load.start, k_start);
  spread(load.mixed, k_mixed);
  spread(load.along, k_along);
  for (int i = 0; i < 3; ++i) {
    const double* const r = h[i];
    const Vec3d mixed =
        cross(t, {l * r[0] + k_mixed[i][0], l * r[1] + k_mixed[i][1], l * r[2] + k_mixed[i][2]});
    const double ll = l * l;
    const Vec3d along =
        cross(t, {ll * r[0] + k_along[i][0], ll * r[1] + k_along[i][1], ll * r[2] + k_along[i][2]});
    half[i][0] = l * r[3] + 0.5 * along.x;
    half[i][1] = l * r[4] + 0.5 * along.y;
    half[i][2] = l * r[5] + 0.5 * along.z;
    h[i][3] += mixed.x;
    h[i][4] += mixed.y;
    h[i][5] += mixed.z;
    for (int k = 0; k < 3; ++k) h[i][k] += k_start[i][k];
  }
  const Vec3d c0 = cross(t, {half[0][0], half[1][0], half[2][0]});
  const Vec3d c1 = cross(t, {half[0][1], half[1][1], half[2][1]});
  const Vec3d c2 = cross(t, {half[0][2], half[1][2], half[2][2]});
  const double axial = dot(t, at_direction);  // positive: compression
  const double a = axial > 0 ? compression_share * axial : axial;
  const double turn[3][3] = {{c0.x + c0.x - a, c1.x + c0.y, c2.x + c0.z},
                             {c0.y + c1.x, c1.y + c1.y - a, c2.y + c1.z},
                             {c0.z + c2.x, c1.z + c2.y, c2.z + c2.z - a}};
  const double ta[3] = {t.x, t.y, t.z};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) h[3 + i][3 + k] += turn[i][k] + a * ta[i] * ta[k];
  }
  const Vec3d moment = cross(t, at_direction);
  const double add[6] = {at_start.x, at_start.y, at_start.z, moment.x, moment.y, moment.z};
  for (int i = 0; i < 6; ++i) g[i] += add[i];
}

// Inverse of a symmetric 2 x 2 pivot, lifted where it is not positive enough.
struct Pivot {
  double least;  // eigenvalue, before
  double i00, i01, i11;
};
Pivot invert(double m00, double m01, double m11, double joint_stiffness) {
  const double mean = 0.5 * (m00 + m11), apart = 0.5 * (m00 - m11);
  const double least = mean - std::sqrt(apart * apart + m01 * m01);
  const double lift = max_of(0, kPivotLift * (kLeastPivot * joint_stiffness - least));
  const double a = m00 + lift, b = m11 + lift;
  const double scale = 1 / (a * b - m01 * m01);
  return {least, b * scale, -m01 * scale, a * scale};
}

// From a function of the rod after a joint to one of the rod before it: adds the joint's energy and
// minimises over its two angles. Returns the least eigenvalue of the pivot.
double cross_joint(double stiffness, Vec3d t, RodScratch::Joint& joint, Energy& energy) {
  auto& h = energy.second;
  double* const g = energy.first;
  const Vec3d u = joint.rest, v = cross(t, u);
  const double c = dot(u, t);
  const double s = 1 / max_of(1 + c, kLeastOpening);
  const double k = (2.0 / 3) * stiffness * (2 * s * s + 1);  // -dE/dc
  const double k2 = (8.0 / 3) * stiffness * s * s * s;       // d2E/dc2
  const Vec3d axis[2] = {joint.axis_1, joint.axis_2};
  const double ta[3] = {t.x, t.y, t.z}, ua[3] = {u.x, u.y, u.z};

  double coupling[6][2], on_t[2], on_u[2], on_v[2], first[2];
  for (int a = 0; a < 2; ++a) {
    const Vec3d b = axis[a];
    on_t[a] = dot(b, t);
    on_u[a] = dot(b, u);
    on_v[a] = dot(b, v);
    first[a] = b.x * g[3] + b.y * g[4] + b.z * g[5] - k * on_v[a];
    for (int i = 0; i < 6; ++i) coupling[i][a] = h[i][3] * b.x + h[i][4] * b.y + h[i][5] * b.z;
  }
  const auto pivot_entry = [&](int a, int b) {
    return axis[a].x * coupling[3][b] + axis[a].y * coupling[4][b] + axis[a].z * coupling[5][b] +
           k2 * on_v[a] * on_v[b] - k * c * on_t[a] * on_t[b];
  };
  const Pivot pivot =
      invert(pivot_entry(0, 0) + k * c, pivot_entry(0, 1), pivot_entry(1, 1) + k * c, stiffness);
  for (int i = 0; i < 3; ++i) {
    for (int a = 0; a < 2; ++a) coupling[3 + i][a] += k * ta[i] * (on_u[a] - c * on_t[a]);
    for (int m = 0; m < 3; ++m) {
      h[3 + i][3 + m] += k * (ua[i] * ta[m] + ta[i] * ua[m] - c * (ta[i] * ta[m] + ua[i] * ua[m]));
    }
  }
  for (int i = 0; i < 6; ++i) {
    joint.gain[i][0] = coupling[i][0] * pivot.i00 + coupling[i][1] * pivot.i01;
    joint.gain[i][1] = coupling[i][0] * pivot.i01 + coupling[i][1] * pivot.i11;
  }
  joint.offset[0] = pivot.i00 * first[0] + pivot.i01 * first[1];
  joint.offset[1] = pivot.i01 * first[0] + pivot.i11 * first[1];
  for (int i = 0; i < 6; ++i) {
    const double a = joint.gain[i][0], b = joint.gain[i][1];
    for (int m = 0; m < 6; ++m) h[i][m] -= a * coupling[m][0] + b * coupling[m][1];
    g[i] -= a * first[0] + b * first[1];
  }
  return pivot.least;
}

// Tip to handle. Returns the least pivot over EI / l.
double sweep_back(const RodModel& model, double compression_share, const RodResult& result,
                  RodScratch& scratch) {
  Energy energy{};
  double least = kRigidBendingNm2;
  for (std::uint32_t j = model.rods; j-- > 0;) {
    const double stiffness = j == 0 ? 2 * model.joint_nm_per_rad : model.joint_nm_per_rad;
    const Vec3d t = result.direction[j];
    move_to_start(model.rod_m, t, result.node_m[j], scratch.lump[j], compression_share, energy);
    const double pivot = cross_joint(stiffness, t, scratch.joint[j], energy);
    least = min_of(least, pivot / model.joint_nm_per_rad);
  }
  return least;
}

// Handle to tip: the change of each direction. Returns the largest, a joint's kink counting double.
double sweep_forth(const RodModel& model, const RodResult& result, RodScratch& scratch) {
  Vec3d moved{0, 0, 0}, turned{0, 0, 0};
  double largest = 0;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const RodScratch::Joint& joint = scratch.joint[j];
    const double before[6] = {moved.x, moved.y, moved.z, turned.x, turned.y, turned.z};
    double a = -joint.offset[0], b = -joint.offset[1];
    for (int i = 0; i < 6; ++i) {
      a -= joint.gain[i][0] * before[i];
      b -= joint.gain[i][1] * before[i];
    }
    turned = turned + (a * joint.axis_1 + b * joint.axis_2);
    const Vec3d change = cross(turned, result.direction[j]);
    moved = moved + model.rod_m * change;
    scratch.change[j] = change;
    largest = max_of(largest, max_of(dot(change, change), 4 * (a * a + b * b)));
  }
  return std::sqrt(largest);
}

// Takes the step, or less of it, and remembers how the next one should be bounded.
void take_step(const RodModel& model, double least_pivot, RodShape& shape, RodScratch& scratch,
               RodResult& result) {
  const bool stable = least_pivot > 0;
  shape.compression_share = stable ? min_of(1, 2 * shape.compression_share)
                                   : max_of(kLeastCompressionShare, 0.25 * shape.compression_share);
  double reversal = 0, before = 0;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    reversal -= dot(scratch.change[j], scratch.change_before[j]);
    before += dot(scratch.change_before[j], scratch.change_before[j]);
  }
  const bool oscillates = reversal > 0.25 * before + kNoTurn2;
  shape.step_share = oscillates ? max_of(kLeastStepShare, 0.5 * shape.step_share)
                                : min_of(1, 2 * shape.step_share);
  const double share = shape.step_share * share_below(kMaxTurnRad, result.last_turn_rad);
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const Vec3d change = share * scratch.change[j];
    const Vec3d t = result.direction[j] + change;
    scratch.change_before[j] = change;
    result.direction[j] = (1 / std::sqrt(dot(t, t))) * t;
  }
}

}  // namespace

void make_rod(std::uint32_t rods, double length_m, double bending_nm2,
              std::span<const RodKink> rest, RodModel& model_out) {
  model_out = {};
  model_out.rods = rods;
  model_out.rod_m = length_m / static_cast<double>(rods);
  model_out.joint_nm_per_rad = bending_nm2 / model_out.rod_m;
  for (std::uint32_t j = 0; j < rods; ++j) {
    const RodKink kink = j < rest.size() ? rest[j] : RodKink{0, 0};
    const double along = std::sqrt(1 - kink.x * kink.x - kink.y * kink.y);
    model_out.rest[j] = {kink.x, kink.y, along, kink.x / (1 + along)};
  }
}

void relax_rod(const RodModel& model, RodShape& shape_out) {
  shape_out = {};
  shape_out.compression_share = shape_out.step_share = 1;
  Frame frame = handle_frame({1, 0, 0, 0}), half;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const Vec3d rest = rest_direction(model.rest[j], frame);
    shape_out.direction[j] = rest;
    frame = carried(model.rest[j], frame, rest, rest, half);
  }
}

void solve_rod(const RodModel& model, const double (&handle_wxyz)[4], const RodLoads& loads,
               RodShape& shape, RodScratch& scratch, RodResult& result_out) {
  const Frame handle = handle_frame(handle_wxyz);
  const Vec3d z = -1.0 * handle.along;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const Vec3d t = shape.direction[j];
    result_out.direction[j] = t.x * handle.x + t.y * handle.y + t.z * z;
    scratch.change_before[j] = {0, 0, 0};
  }
  lump_loads(model, loads, scratch);
  result_out.least_pivot = kRigidBendingNm2;
  for (std::uint32_t step = 0; step < kRodNewtonSteps; ++step) {
    place_rods(model, handle, scratch, result_out);
    const double least = sweep_back(model, shape.compression_share, result_out, scratch);
    result_out.least_pivot = min_of(result_out.least_pivot, least);
    result_out.last_turn_rad = sweep_forth(model, result_out, scratch);
    take_step(model, least, shape, scratch, result_out);
  }
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const Vec3d t = result_out.direction[j];
    result_out.node_m[j + 1] = result_out.node_m[j] + model.rod_m * t;
    shape.direction[j] = {dot(t, handle.x), dot(t, handle.y), dot(t, z)};
  }
  read_loads(model, loads, result_out);
}

RodPoint rod_point(const RodModel& model, const RodResult& result, double arc_m) {
  const OnRod on = on_rod(model, arc_m);
  const Vec3d direction = result.direction[on.rod];
  return {result.node_m[on.rod] + on.from_start_m * direction, direction};
}

}  // namespace stylet
