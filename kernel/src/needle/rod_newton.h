// SPDX-License-Identifier: Apache-2.0
// The Newton step of the chain of rods (rod.h says what it solves, and why in this way): frames
// carried along the chain, loads gathered at the joints, the sweep that eliminates joints and the
// one that assigns turns. rod.cpp makes it an equilibrium, or one among faces.
//
// Included by rod.cpp alone: in one unit the dearest tick of fig02 takes 2 to 3 % less.
// Promises, units and frame as in rod.h.
#pragma once

#include <cmath>

#include "needle/rod.h"

namespace stylet {
namespace {

// A joint folded further than this (163 degrees) gets no stiffer.
constexpr double kLeastOpening = 0.02;
constexpr double kMaxTurnRad = 0.5;
// Pivots below this part of the joint's stiffness are lifted, with this slope: a small positive
// pivot stays soft enough to buckle, and none becomes so small that the next pivots blow up.
struct PivotLift {
  double least, slope;
};
constexpr PivotLift kFirmLift = {0.01, 100};
// For steps whose length the energy decides: a soft direction of the needle stays soft.
constexpr PivotLift kSoftLift = {1e-6, 2};
constexpr double kLeastCompressionFraction = 1.0 / 1024;

constexpr Sym3d operator+(const Sym3d& a, const Sym3d& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}
constexpr Sym3d operator-(const Sym3d& a, const Sym3d& b) {
  return {a.xx - b.xx, a.xy - b.xy, a.xz - b.xz, a.yy - b.yy, a.yz - b.yz, a.zz - b.zz};
}
constexpr Sym3d operator*(double s, const Sym3d& a) {
  return {s * a.xx, s * a.xy, s * a.xz, s * a.yy, s * a.yz, s * a.zz};
}
constexpr Vec3d operator*(const Sym3d& a, Vec3d v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}
constexpr Sym3d square(Vec3d a) {
  return {a.x * a.x, a.x * a.y, a.x * a.z, a.y * a.y, a.y * a.z, a.z * a.z};
}

// The direction of a rod and the axes of its material; y = x cross along.
struct Frame {
  Vec3d along, x, y;
};

struct OnRod {
  std::uint32_t rod;
  double from_start_m;
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

// The frame of a rod that points along `along` and at rest would point along `rest`: the smallest
// turn from before to rest, then the smallest from rest to along. half_out is the frame half way
// through the second turn; half_out.x and .y are the axes about which the joint bends.
Frame carried(const RodModel::Rest& kink, const Frame& before, Vec3d rest, Vec3d along,
              Frame& half_out) {
  const Vec3d x = before.x - kink.turn * (before.along + rest);
  const Vec3d sum = rest + along;
  const double opening = max_of(1 + dot(rest, along), 1e-9);
  const double length = std::sqrt(2 * opening), per_length = 1 / length;  // of sum
  const double across = dot(along, x);
  const double lean = across * per_length;
  half_out.along = per_length * sum;
  half_out.x = x - (lean / (1 + 0.5 * length)) * (rest + half_out.along);
  half_out.y = cross(half_out.x, half_out.along);
  const Vec3d carried_x = x - (across / opening) * sum;
  return {along, carried_x, cross(carried_x, along)};
}

// A load that a violent hand has left ahead of the tip keeps its own place, as needle_point does:
// with a shorter lever the hand took 0.6 uJ a tick out of a needle that the load bent.
OnRod on_rod(const RodModel& model, double arc_m) {
  const double last = static_cast<double>(model.rods - 1);
  const auto rod = static_cast<std::uint32_t>(max_of(0, min_of(arc_m / model.rod_m, last)));
  const double rest_m = arc_m - static_cast<double>(rod) * model.rod_m;
  return {rod, max_of(0, min_of(rest_m, static_cast<double>(model.rods) * model.rod_m))};
}

// Adds a quadratic function of a place on a rod: force there and stiffness.
void add_to_lump(RodScratch::Lump& lump, double from_start_m, const Sym3d& k, Vec3d at_origin_n) {
  lump.start = lump.start + k;
  lump.mixed = lump.mixed + from_start_m * k;
  lump.along = lump.along + (from_start_m * from_start_m) * k;
  lump.start_n = lump.start_n + at_origin_n;
  lump.along_nm = lump.along_nm + from_start_m * at_origin_n;
}

constexpr double kLeastStepFraction = 0.1;
// A squared change of direction below this is rounding, rad^2.
constexpr double kNoTurn2 = 1e-24;

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

constexpr RodLoad kNoLoad{};

constexpr Vec3d clamped(Vec3d v, double limit) {
  return {max_of(-limit, min_of(v.x, limit)), max_of(-limit, min_of(v.y, limit)),
          max_of(-limit, min_of(v.z, limit))};
}
constexpr double fraction_below(double limit, double size) {
  return limit / max_of(limit, size);
}

// The part of a load that is used: within the limits, and nothing beyond the count.
RodLoad bounded(const RodLoads& loads, std::uint32_t i) {
  const RodLoad& load = i < loads.count ? loads.load[i] : kNoLoad;
  const Sym3d& k = load.stiffness_n_per_m;
  const double share = fraction_below(kMaxRodStiffnessNPerM, k.xx + k.yy + k.zz);
  return {load.arc_m, clamped(load.place_m, kMaxRodPlaceM), clamped(load.force_n, kMaxRodForceN),
          share * k};
}

// A place on a rod is linear in the rod's start and direction. So the loads of a rod add up to one
// quadratic function, however many they are.
void lump_loads(const RodModel& model, const RodLoads& loads, RodScratch& scratch) {
  for (std::uint32_t j = 0; j < model.rods; ++j) scratch.lump[j] = {};
  for (std::uint32_t i = 0; i < kMaxRodLoads; ++i) {
    const RodLoad& a = scratch.load[i] = bounded(loads, i);
    const OnRod on = on_rod(model, a.arc_m);
    const Sym3d& k = a.stiffness_n_per_m;
    add_to_lump(scratch.lump[on.rod], on.from_start_m, k, a.force_n + k * a.place_m);
  }
}

// Springs that hold the nodes where they are.
void add_hold(const RodModel& model, double hold_n_per_m, const RodResult& result,
              RodScratch& scratch) {
  const Sym3d k{hold_n_per_m, 0, 0, hold_n_per_m, 0, hold_n_per_m};
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    add_to_lump(scratch.lump[j], model.rod_m, k, hold_n_per_m * result.node_m[j + 1]);
  }
}

void read_loads(const RodModel& model, const RodScratch& scratch, RodResult& result) {
  result.force_n = result.torque_nm = {0, 0, 0};
  for (std::uint32_t i = 0; i < kMaxRodLoads; ++i) {
    const RodLoad& a = scratch.load[i];
    const Vec3d at = rod_point(model, result, a.arc_m).place_m;
    const Vec3d force = a.force_n - a.stiffness_n_per_m * (at - a.place_m);
    result.load_n[i] = force;
    result.force_n = result.force_n + force;
    result.torque_nm = result.torque_nm + cross(at, force);
  }
}

// Energy of everything beyond a place, to second order in the place's small displacement and the
// turn of its rod. Derivatives: by displacement, displacement and turn (rows: displacement),
// turn.
struct QuadraticEnergy {
  Sym3d move_move;
  Vec3d move_turn[3];
  Sym3d turn_turn;
  Vec3d move, turn;
};

// A rod's end moves by its start's displacement plus l (turn cross t): turns a function of the end
// into one of the start, and adds the loads on the rod. To second order the end also moves by
// -l |turn|^2 t / 2: there an axial force adds or removes stiffness.
void move_to_start(double l, Vec3d t, Vec3d start, const RodScratch::Lump& load,
                   double compression_fraction, QuadraticEnergy& e) {
  const Vec3d by_start = load.start * start + load.mixed * t - load.start_n;
  const Vec3d by_direction = l * e.move + (load.mixed * start + load.along * t - load.along_nm);

  const Sym3d l_move = l * e.move_move;
  const Sym3d mixed = l_move + load.mixed;                    // by start and direction
  const Sym3d along = (0.5 * l) * l_move + 0.5 * load.along;  // half of: by direction twice
  const Vec3d r0 = l * e.move_turn[0] + cross(t, {along.xx, along.xy, along.xz});
  const Vec3d r1 = l * e.move_turn[1] + cross(t, {along.xy, along.yy, along.yz});
  const Vec3d r2 = l * e.move_turn[2] + cross(t, {along.xz, along.yz, along.zz});
  const Vec3d c0 = cross(t, {r0.x, r1.x, r2.x});
  const Vec3d c1 = cross(t, {r0.y, r1.y, r2.y});
  const Vec3d c2 = cross(t, {r0.z, r1.z, r2.z});
  const double axial = dot(t, by_direction);  // positive: compression
  const double a = axial > 0 ? compression_fraction * axial : axial;
  const Vec3d at = a * t;
  e.turn_turn =
      e.turn_turn + Sym3d{(c0.x + c0.x) + (at.x * t.x - a), (c1.x + c0.y) + at.x * t.y,
                          (c2.x + c0.z) + at.x * t.z,       (c1.y + c1.y) + (at.y * t.y - a),
                          (c2.y + c1.z) + at.y * t.z,       (c2.z + c2.z) + (at.z * t.z - a)};
  e.move_turn[0] = e.move_turn[0] + cross(t, {mixed.xx, mixed.xy, mixed.xz});
  e.move_turn[1] = e.move_turn[1] + cross(t, {mixed.xy, mixed.yy, mixed.yz});
  e.move_turn[2] = e.move_turn[2] + cross(t, {mixed.xz, mixed.yz, mixed.zz});
  e.move_move = e.move_move + load.start;
  e.move = e.move + by_start;
  e.turn = e.turn + cross(t, by_direction);
}

// Inverse of a symmetric 2 x 2 pivot, lifted where it is not positive enough.
struct Pivot {
  double least;  // least eigenvalue, before lifting
  double i00, i01, i11;
};
Pivot invert(double m00, double m01, double m11, double joint_stiffness, PivotLift lift) {
  const double mean = 0.5 * (m00 + m11), apart = 0.5 * (m00 - m11);
  const double least = mean - std::sqrt(apart * apart + m01 * m01);
  double a = m00, b = m11;
  const double wanted = lift.least * joint_stiffness;
  // A branch, because it is rare: the division need not wait for the square root.
  if (least < wanted) [[unlikely]] {
    a += lift.slope * (wanted - least);
    b += lift.slope * (wanted - least);
  }
  const double scale = 1 / (a * b - m01 * m01);
  return {least, b * scale, -m01 * scale, a * scale};
}

// a b' + c d', which these vectors make symmetric.
constexpr Sym3d product(Vec3d a, Vec3d b, Vec3d c, Vec3d d) {
  return {a.x * b.x + c.x * d.x, a.x * b.y + c.x * d.y, a.x * b.z + c.x * d.z,
          a.y * b.y + c.y * d.y, a.y * b.z + c.y * d.z, a.z * b.z + c.z * d.z};
}

// Turns a function of the rod after a joint into one of the rod before it: adds the joint's energy
// and minimises over its two angles. Returns the least eigenvalue of the pivot.
double cross_joint(double stiffness, Vec3d t, PivotLift lift, RodScratch::Joint& joint,
                   QuadraticEnergy& e) {
  const Vec3d u = joint.rest, v = cross(t, u), b1 = joint.axis_1, b2 = joint.axis_2;
  const double c = dot(u, t);
  const double s = 1 / max_of(1 + c, kLeastOpening);
  const double k = (2.0 / 3) * stiffness * (2 * s * s + 1);  // -dE/dc
  const double k2 = (8.0 / 3) * stiffness * s * s * s;       // d2E/dc2
  const double t1 = dot(b1, t), t2 = dot(b2, t);  // u has the opposite: the axes cross u + t
  const double v1 = dot(b1, v), v2 = dot(b2, v);

  const Vec3d turn_1 = e.turn_turn * b1, turn_2 = e.turn_turn * b2;
  const Pivot pivot =
      invert(dot(b1, turn_1) + k2 * v1 * v1 + k * c * (1 - t1 * t1),
             dot(b1, turn_2) + k2 * v1 * v2 - k * c * t1 * t2,
             dot(b2, turn_2) + k2 * v2 * v2 + k * c * (1 - t2 * t2), stiffness, lift);
  const double g1 = dot(b1, e.turn) - k * v1, g2 = dot(b2, e.turn) - k * v2;
  // How the two angles couple to displacement and turn of the rod before.
  const Vec3d* const m = e.move_turn;
  const Vec3d move_1{dot(m[0], b1), dot(m[1], b1), dot(m[2], b1)};
  const Vec3d move_2{dot(m[0], b2), dot(m[1], b2), dot(m[2], b2)};
  const double both = -k * (1 + c);
  const Vec3d angle_1 = turn_1 + (both * t1) * t, angle_2 = turn_2 + (both * t2) * t;

  joint.move_1 = pivot.i00 * move_1 + pivot.i01 * move_2;
  joint.move_2 = pivot.i01 * move_1 + pivot.i11 * move_2;
  joint.turn_1 = pivot.i00 * angle_1 + pivot.i01 * angle_2;
  joint.turn_2 = pivot.i01 * angle_1 + pivot.i11 * angle_2;
  joint.angle_1 = pivot.i00 * g1 + pivot.i01 * g2;
  joint.angle_2 = pivot.i01 * g1 + pivot.i11 * g2;

  const Vec3d ku = k * u, kt = k * t;
  e.turn_turn = e.turn_turn + product(ku, t - c * u, kt, u - c * t) -
                product(joint.turn_1, angle_1, joint.turn_2, angle_2);
  e.move_move = e.move_move - product(joint.move_1, move_1, joint.move_2, move_2);
  const double by_1[3] = {joint.move_1.x, joint.move_1.y, joint.move_1.z};
  const double by_2[3] = {joint.move_2.x, joint.move_2.y, joint.move_2.z};
  for (int i = 0; i < 3; ++i) {
    e.move_turn[i] = e.move_turn[i] - (by_1[i] * angle_1 + by_2[i] * angle_2);
  }
  e.move = e.move - (g1 * joint.move_1 + g2 * joint.move_2);
  e.turn = e.turn - (g1 * joint.turn_1 + g2 * joint.turn_2);
  return pivot.least;
}

// From tip to handle. Returns the least pivot over EI / l.
double sweep_back(const RodModel& model, double compression_fraction, PivotLift lift,
                  const RodResult& result, RodScratch& scratch) {
  QuadraticEnergy energy{};
  double least = kRigidBendingNm2;
  for (std::uint32_t j = model.rods; j-- > 0;) {
    const double stiffness = j == 0 ? 2 * model.joint_nm_per_rad : model.joint_nm_per_rad;
    const Vec3d t = result.direction[j];
    move_to_start(model.rod_m, t, result.node_m[j], scratch.lump[j], compression_fraction, energy);
    const double pivot = cross_joint(stiffness, t, lift, scratch.joint[j], energy);
    least = min_of(least, pivot / model.joint_nm_per_rad);
  }
  return least;
}

// Handle to tip: the change of each direction. Returns the largest; a joint's kink counts double.
double sweep_forth(const RodModel& model, const RodResult& result, RodScratch& scratch) {
  Vec3d moved{0, 0, 0}, turned{0, 0, 0};
  double largest = 0;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const RodScratch::Joint& joint = scratch.joint[j];
    const double a = -(joint.angle_1 + (dot(joint.move_1, moved) + dot(joint.turn_1, turned)));
    const double b = -(joint.angle_2 + (dot(joint.move_2, moved) + dot(joint.turn_2, turned)));
    turned = turned + (a * joint.axis_1 + b * joint.axis_2);
    const Vec3d change = cross(turned, result.direction[j]);
    moved = moved + model.rod_m * change;
    scratch.change[j] = change;
    largest = max_of(largest, max_of(dot(change, change), 4 * (a * a + b * b)));
  }
  return std::sqrt(largest);
}

// Takes the step, or a part of it, and stores how the next one should be bounded.
void take_step(const RodModel& model, double least_pivot, RodShape& shape, RodScratch& scratch,
               RodResult& result) {
  const bool stable = least_pivot > 0;
  shape.compression_fraction =
      stable ? min_of(1, 2 * shape.compression_fraction)
             : max_of(kLeastCompressionFraction, 0.25 * shape.compression_fraction);
  double reversal = 0, before = 0;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    reversal -= dot(scratch.change[j], scratch.change_before[j]);
    before += dot(scratch.change_before[j], scratch.change_before[j]);
  }
  // A tick's first step has no earlier one to compare with, and does not change the step length.
  const bool moved = before > kNoTurn2, oscillates = moved && reversal > 0.25 * before;
  shape.step_length *= oscillates ? 0.5 : (moved ? 2.0 : 1.0);
  shape.step_length = max_of(kLeastStepFraction, min_of(shape.step_length, 1));
  const double share = shape.step_length * fraction_below(kMaxTurnRad, result.last_turn_rad);
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const Vec3d change = share * scratch.change[j];
    const Vec3d t = result.direction[j] + change;
    scratch.change_before[j] = change;
    result.direction[j] = (1 / std::sqrt(dot(t, t))) * t;
  }
}

// Newton steps from the shape at the tick's start.
void newton_steps(const RodModel& model, const Frame& handle, RodShape& shape, RodScratch& scratch,
                  RodResult& result) {
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    result.direction[j] = scratch.start_direction[j];
    scratch.change_before[j] = {0, 0, 0};
  }
  for (std::uint32_t step = 0; step < kRodNewtonSteps; ++step) {
    place_rods(model, handle, scratch, result);
    const double least = sweep_back(model, shape.compression_fraction, kFirmLift, result, scratch);
    result.least_pivot = min_of(result.least_pivot, least);
    result.last_turn_rad = sweep_forth(model, result, scratch);
    take_step(model, least, shape, scratch, result);
  }
}

// Sets nodes and state from the directions.
void keep_shape(const RodModel& model, const Frame& handle, RodShape& shape, RodResult& result) {
  const Vec3d z = -1.0 * handle.along;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const Vec3d t = result.direction[j];
    result.node_m[j + 1] = result.node_m[j] + model.rod_m * t;
    shape.direction[j] = {dot(t, handle.x), dot(t, handle.y), dot(t, z)};
  }
}

// Starts from the shape as the handle carries it.
void start_rods(const RodModel& model, const Frame& handle, const RodShape& shape,
                RodScratch& scratch) {
  const Vec3d z = -1.0 * handle.along;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const Vec3d t = shape.direction[j];
    scratch.start_direction[j] = t.x * handle.x + t.y * handle.y + t.z * z;
  }
}

}  // namespace
}  // namespace stylet
