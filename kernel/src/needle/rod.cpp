// SPDX-License-Identifier: Apache-2.0
#include "needle/rod.h"

#include <cmath>

#include "laws/touch.h"
#include "needle/rod_newton.h"

namespace stylet {
namespace {

// Tried parts of a step. The first is Newton's step; the others find the way if faces are met or
// left on it, or if the shape is not stable.
constexpr double kTriedFraction[kRodTrials] = {1, 0.5, 0.2, 0.05};
// A pivot below this says that earlier pivots were almost zero, and the step is no better: it is
// computed again with this part of the compression. (When it was taken, and only later steps used
// a smaller part, every third step was lost: a needle pressed on hard bone reached its buckled
// shape a tick late, at up to four times its load.)
constexpr double kWildPivot = -0.1;
constexpr double kTamedFraction = 0.25;
// A step below this is rounding.
constexpr double kRestsRad = 1e-7;
// From this slope of friction's allowed force over its limit on, the contact is taken to stick.
constexpr double kHoldsItself = 0.95;
// A steeper slope than this is taken to come from faces met or left: a tenth of the way is used.
constexpr double kSteepestFall = -9;
// Limits that differ by less than this part say nothing about how the force follows them. Nor does
// a limit whose last step was longer than this: the force then changes for other reasons, too.
// (That gave a slope of 5, and a tip that slid stuck for a tick, at 2 to 4 N.)
constexpr double kLeastLimitFraction = 0.01;
constexpr double kSettledRad = 1e-4;

RodTouch touch_at(const RodFace& face, Vec3d x) {
  const Vec3d moved = x - face.place_m;
  const double into = -dot(face.normal, moved), depth = face.depth_m + into;
  const Press pressed = press(face.stiffness_n_per_m, face.largest_force_n, depth);
  const Vec3d trial = face.bristle_m + moved + into * face.normal;
  const Slip slid = slip(face.stiffness_n_per_m, face.limit_n, trial);
  return {moved, depth, pressed.force_n, slid.bristle_m, slid.slips};
}

// What a face adds to the energy and its derivatives. Along the normal the law's chord replaces its
// slope: it is larger, so that a step does not go too far. A careful step does not count on sliding
// to go on, either: friction ends it where it turns back.
void add_faces(const RodModel& model, const RodResult& result, const RodFaces& faces, bool careful,
               RodScratch& scratch) {
  for (std::uint32_t i = 0; i < faces.count; ++i) {
    const RodFace& face = faces.face[i];
    const OnRod on = on_rod(model, face.arc_m);
    const Vec3d x = result.node_m[on.rod] + on.from_start_m * result.direction[on.rod];
    const RodTouch touch = touch_at(face, x);
    if (!face.holds) continue;
    const double k = face.stiffness_n_per_m;
    const double along =
        touch.depth_m > 0 ? press(k, face.largest_force_n, touch.depth_m).chord_n_per_m : k;
    // Across: k if it sticks; if it slips, the stiffness against turning the bristle.
    const double length = norm(face.bristle_m + across(face.normal, touch.moved_m));
    const double side = touch.slips ? face.limit_n / max_of(length, 1e-12) : k;
    const Vec3d n = face.normal;
    Sym3d stiffness = Sym3d{side, 0, 0, side, 0, side} + (along - side) * square(n);
    if (touch.slips && !careful) {
      const Vec3d d = (1 / max_of(norm(touch.bristle_m), 1e-15)) * touch.bristle_m;
      stiffness = stiffness - side * square(d);
    }
    const Vec3d force = along * touch.depth_m * n - k * touch.bristle_m;
    add_to_lump(scratch.lump[on.rod], on.from_start_m, stiffness, force + stiffness * x);
  }
}

// Finds which faces touch where the present step would end. Returns whether they are others than
// the step assumed.
bool expect_faces(const RodModel& model, const RodResult& result, const RodScratch& scratch,
                  RodFaces& faces) {
  bool changes = false;
  for (std::uint32_t i = 0; i < faces.count; ++i) {
    RodFace& face = faces.face[i];
    const OnRod on = on_rod(model, face.arc_m);
    Vec3d moved = on.from_start_m * scratch.change[on.rod];
    for (std::uint32_t j = 0; j < on.rod; ++j) moved = moved + model.rod_m * scratch.change[j];
    const double depth = touch_face(model, result, face).depth_m;
    const bool holds = depth > 0 || depth - dot(face.normal, moved) > 0;
    changes |= holds != face.holds;
    face.holds = holds;
  }
  return changes;
}

// What friction allows follows the force, and the force follows what friction allows: linearly
// while the faces stay the same, so two limits give the third. If the force grows faster than its
// limit, the contact holds itself, and sticks.
double next_limit(const RodFace& face, double allowed_n) {
  const double change = face.limit_n - face.limit_before_n;
  const double least = kLeastLimitFraction * (face.limit_n + allowed_n);
  if (!face.slid || (change < least && change > -least)) return 0.5 * (face.limit_n + allowed_n);
  const double slope = (allowed_n - face.allowed_before_n) / change;
  if (slope > kHoldsItself) return kMaxRodForceN;
  return max_of(0, face.limit_n + (allowed_n - face.limit_n) / (1 - max_of(slope, kSteepestFall)));
}

void settle_limits(const RodModel& model, const RodResult& result, RodFaces& faces) {
  for (std::uint32_t i = 0; i < faces.count; ++i) {
    RodFace& face = faces.face[i];
    const RodTouch touch = touch_face(model, result, face);
    const double allowed = face.friction * touch.force_n;
    const double limit = touch.slips ? next_limit(face, allowed) : allowed;
    face.slid = touch.slips && result.last_turn_rad < kSettledRad;
    face.limit_before_n = face.limit_n;
    face.allowed_before_n = allowed;
    face.limit_n = limit;
  }
}

double joint_energy(double stiffness, Vec3d rest, Vec3d along) {
  // 1 - c from the difference: with a stiff joint the rounding of c would show.
  const Vec3d apart = along - rest;
  const double d = 0.5 * dot(apart, apart);
  return (2.0 / 3) * stiffness * d * (3 - d) / max_of(2 - d, kLeastOpening);
}

double face_energy(const RodFace& face, Vec3d x) {
  const Vec3d moved = x - face.place_m;
  const double into = -dot(face.normal, moved);
  const Vec3d trial = face.bristle_m + moved + into * face.normal;
  const double pressed_j =
      press(face.stiffness_n_per_m, face.largest_force_n, face.depth_m + into).energy_j;
  return face.holds ? pressed_j + slip(face.stiffness_n_per_m, face.limit_n, trial).energy_j
                    : pressed_j;
}

// Energy of a shape, without a constant.
double energy_of(const RodModel& model, const Frame& handle, const Vec3d* direction,
                 const RodFaces& faces, const RodScratch& scratch) {
  Frame frame = handle, half;
  Vec3d node[kMaxRods + 1];
  node[0] = {0, 0, 0};
  double sum = 0;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const Vec3d rest = rest_direction(model.rest[j], frame), t = direction[j];
    const double stiffness = j == 0 ? 2 * model.joint_nm_per_rad : model.joint_nm_per_rad;
    sum += joint_energy(stiffness, rest, t);
    frame = carried(model.rest[j], frame, rest, t, half);
    const RodScratch::Lump& lump = scratch.load_lump[j];
    const Vec3d x = node[j];
    sum += dot(x, 0.5 * (lump.start * x) + lump.mixed * t - lump.start_n) +
           dot(t, 0.5 * (lump.along * t) - lump.along_nm);
    node[j + 1] = x + model.rod_m * t;
  }
  for (std::uint32_t i = 0; i < faces.count; ++i) {
    const OnRod on = on_rod(model, faces.face[i].arc_m);
    sum += face_energy(faces.face[i], node[on.rod] + on.from_start_m * direction[on.rod]);
  }
  return sum;
}

// How far the present step moves a node, at most.
double farthest(const RodModel& model, const RodScratch& scratch) {
  Vec3d moved{0, 0, 0};
  double largest = 0;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    moved = moved + model.rod_m * scratch.change[j];
    largest = max_of(largest, dot(moved, moved));
  }
  return std::sqrt(largest);
}

// Lengths of the tried steps, as parts of the present step: at most what a fold or a look allows.
// A needle that buckles starts from an almost straight shape with an almost zero step, so it tries
// half of all that is allowed.
void choose_lengths(const RodModel& model, double farthest_m, const RodScratch& scratch,
                    const RodResult& result, double (&length_out)[kRodTrials]) {
  const double far_m = farthest(model, scratch);
  const double allowed = min_of(kMaxTurnRad / max_of(result.last_turn_rad, kRestsRad),
                                farthest_m / max_of(far_m, kRestsRad));
  for (std::uint32_t trial = 0; trial < kRodTrials; ++trial) {
    length_out[trial] = min_of(1, allowed) * kTriedFraction[trial];
  }
  if (!(result.least_pivot > 0) && allowed > 2) length_out[1] = 0.5 * allowed;
}

enum class Step { kWhole, kPart, kNone };

// Takes the tried step with the least energy, or none if each would raise it. At rest no step
// lowers it by more than rounding: that counts as a whole step.
Step take_best_step(const RodModel& model, const Frame& handle, const RodFaces& faces,
                    double farthest_m, RodScratch& scratch, RodResult& result) {
  double length[kRodTrials];
  choose_lengths(model, farthest_m, scratch, result, length);
  double least = energy_of(model, handle, result.direction, faces, scratch);
  const Vec3d* best = result.direction;
  Step step = result.last_turn_rad < kRestsRad ? Step::kWhole : Step::kNone;
  for (std::uint32_t trial = 0; trial < kRodTrials; ++trial) {
    Vec3d* const tried = scratch.tried[trial];
    for (std::uint32_t j = 0; j < model.rods; ++j) {
      const Vec3d t = result.direction[j] + length[trial] * scratch.change[j];
      tried[j] = (1 / std::sqrt(dot(t, t))) * t;
    }
    const double energy = energy_of(model, handle, tried, faces, scratch);
    if (!(energy < least)) continue;
    least = energy;
    best = tried;
    step = trial == 0 || length[trial] > length[0] ? Step::kWhole : Step::kPart;
  }
  for (std::uint32_t j = 0; j < model.rods; ++j) result.direction[j] = best[j];
  return step;
}

// One step. If no step was taken, the next ones are careful.
Step bend_step(const RodModel& model, const Frame& handle, const RodCare& care, bool last,
               RodFaces& faces, RodShape& shape, RodScratch& scratch, RodResult& result) {
  for (std::uint32_t j = 0; j < model.rods; ++j) scratch.lump[j] = scratch.load_lump[j];
  const bool careful = shape.compression_fraction < 1;
  add_faces(model, result, faces, careful, scratch);
  if (careful) add_hold(model, care.hold_n_per_m, result, scratch);
  const double share = shape.compression_fraction;
  result.least_pivot = sweep_back(model, share, careful ? kFirmLift : kSoftLift, result, scratch);
  if (result.least_pivot < kWildPivot) {
    if (!careful) add_hold(model, care.hold_n_per_m, result, scratch);
    (void)sweep_back(model, kTamedFraction * share, kFirmLift, result, scratch);
  }
  result.last_turn_rad = sweep_forth(model, result, scratch);
  if (expect_faces(model, result, scratch, faces) && !last) return Step::kNone;
  const Step step = take_best_step(model, handle, faces, care.farthest_m, scratch, result);
  shape.compression_fraction =
      step == Step::kNone ? max_of(kLeastCompressionFraction, 0.25 * share) : min_of(1, 2 * share);
  return step;
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
  shape_out.compression_fraction = shape_out.step_length = 1;
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
  start_rods(model, handle, shape, scratch);
  lump_loads(model, loads, scratch);
  result_out.least_pivot = kRigidBendingNm2;
  newton_steps(model, handle, shape, scratch, result_out);
  keep_shape(model, handle, shape, result_out);
  read_loads(model, scratch, result_out);
}

void carry_rod(const RodModel& model, const double (&handle_wxyz)[4], RodShape& shape,
               RodScratch& scratch, RodResult& result) {
  const Frame handle = handle_frame(handle_wxyz);
  start_rods(model, handle, shape, scratch);
  for (std::uint32_t j = 0; j < model.rods; ++j) result.direction[j] = scratch.start_direction[j];
  place_rods(model, handle, scratch, result);
}

void bend_rod(const RodModel& model, const double (&handle_wxyz)[4], const RodLoads& loads,
              RodFaces& faces, const RodCare& care, RodShape& shape, RodScratch& scratch,
              RodResult& result) {
  const Frame handle = handle_frame(handle_wxyz);
  lump_loads(model, loads, scratch);
  for (std::uint32_t j = 0; j < model.rods; ++j) scratch.load_lump[j] = scratch.lump[j];
  for (std::uint32_t i = 0; i < kRodFaceSteps; ++i) {
    const bool last = i + 1 == kRodFaceSteps;
    place_rods(model, handle, scratch, result);
    const Step step = bend_step(model, handle, care, last, faces, shape, scratch, result);
    if (last || step != Step::kWhole) continue;
    place_rods(model, handle, scratch, result);
    settle_limits(model, result, faces);
  }
  keep_shape(model, handle, shape, result);
  read_loads(model, scratch, result);
}

RodTouch touch_face(const RodModel& model, const RodResult& result, const RodFace& face) {
  return touch_at(face, rod_point(model, result, face.arc_m).place_m);
}

double bending_energy(const RodModel& model, const RodShape& shape) {
  Frame frame = handle_frame({1, 0, 0, 0}), half;
  double sum = 0;
  for (std::uint32_t j = 0; j < model.rods; ++j) {
    const Vec3d rest = rest_direction(model.rest[j], frame), along = shape.direction[j];
    sum += joint_energy((j == 0 ? 2 : 1) * model.joint_nm_per_rad, rest, along);
    frame = carried(model.rest[j], frame, rest, along, half);
  }
  return sum;
}

RodPoint rod_point(const RodModel& model, const RodResult& result, double arc_m) {
  const OnRod on = on_rod(model, arc_m);
  const Vec3d direction = result.direction[on.rod];
  return {result.node_m[on.rod] + on.from_start_m * direction, direction};
}

}  // namespace stylet
