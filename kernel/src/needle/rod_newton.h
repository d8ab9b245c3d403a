// SPDX-License-Identifier: Apache-2.0
// The Newton step of the chain of rods (rod.h says what it solves, and why in this way): frames
// carried along the chain, loads gathered at the joints, the sweep that eliminates joints and the
// one that assigns turns. rod.cpp makes it an equilibrium, or one among faces.
//
// Promises, units and frame as in rod.h.
#pragma once

#include "needle/rod.h"

namespace stylet::rod {

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
constexpr double kLeastCompressionShare = 1.0 / 1024;

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

inline Frame handle_frame(const double (&q)[4]) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double s = 2 / (w * w + x * x + y * y + z * z);
  return {{-s * (x * z + w * y), s * (w * x - y * z), s * (x * x + y * y) - 1},
          {1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
          {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)}};
}

inline Vec3d rest_direction(const RodModel::Rest& rest, const Frame& before) {
  return rest.x * before.x + rest.y * before.y + rest.along * before.along;
}

// The frame of a rod that points along `along` and at rest would point along `rest`: the smallest
// turn from before to rest, then the smallest from rest to along. half_out is the frame half way
// through the second turn; half_out.x and .y are the axes about which the joint bends.
inline Frame carried(const RodModel::Rest& kink, const Frame& before, Vec3d rest, Vec3d along,
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

void place_rods(const RodModel& model, const Frame& handle, RodScratch& scratch, RodResult& result);

// A load that a violent hand has left ahead of the tip keeps its own place, as needle_point does:
// with a shorter lever the hand took 0.6 uJ a tick out of a needle that the load bent.
inline OnRod on_rod(const RodModel& model, double arc_m) {
  const double last = static_cast<double>(model.rods - 1);
  const auto rod = static_cast<std::uint32_t>(max_of(0, min_of(arc_m / model.rod_m, last)));
  const double rest_m = arc_m - static_cast<double>(rod) * model.rod_m;
  return {rod, max_of(0, min_of(rest_m, static_cast<double>(model.rods) * model.rod_m))};
}

// Adds a quadratic function of a place on a rod: force there and stiffness.
inline void add_to_lump(RodScratch::Lump& lump, double from_start_m, const Sym3d& k,
                        Vec3d at_origin_n) {
  lump.start = lump.start + k;
  lump.mixed = lump.mixed + from_start_m * k;
  lump.along = lump.along + (from_start_m * from_start_m) * k;
  lump.start_n = lump.start_n + at_origin_n;
  lump.along_nm = lump.along_nm + from_start_m * at_origin_n;
}

// A place on a rod is linear in the rod's start and direction. So the loads of a rod add up to one
// quadratic function, however many they are.
void lump_loads(const RodModel& model, const RodLoads& loads, RodScratch& scratch);

// Springs that hold the nodes where they are.
void add_hold(const RodModel& model, double hold_n_per_m, const RodResult& result,
              RodScratch& scratch);

void read_loads(const RodModel& model, const RodScratch& scratch, RodResult& result);

// From tip to handle. Returns the least pivot over EI / l.
double sweep_back(const RodModel& model, double compression_share, PivotLift lift,
                  const RodResult& result, RodScratch& scratch);

// Handle to tip: the change of each direction. Returns the largest; a joint's kink counts double.
double sweep_forth(const RodModel& model, const RodResult& result, RodScratch& scratch);

// Newton steps from the shape at the tick's start.
void newton_steps(const RodModel& model, const Frame& handle, RodShape& shape, RodScratch& scratch,
                  RodResult& result);

// Sets nodes and state from the directions.
void keep_shape(const RodModel& model, const Frame& handle, RodShape& shape, RodResult& result);

// Starts from the shape as the handle carries it.
void start_rods(const RodModel& model, const Frame& handle, const RodShape& shape,
                RodScratch& scratch);

}  // namespace stylet::rod
