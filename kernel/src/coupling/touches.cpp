// SPDX-License-Identifier: Apache-2.0
#include "coupling/touches.h"

#include "state/events.h"

namespace stylet {
namespace {

// A touch this near to a rod's end, in rods, may continue at the next rod.
constexpr float kNearNode = 0.1F;

// The touch of the last tick that continues at a piece: its own, or that of the piece beside it
// from which it came along the shaft. Null if there was none.
const Touch* remembered(const State& state, std::uint32_t obstacle, std::uint32_t rod) {
  const Touch* beside = nullptr;
  for (std::uint32_t i = 0; i < state.needle->touch_count; ++i) {
    const Touch& touch = state.touch[i];
    if (touch.obstacle != obstacle) continue;
    if (touch.rod == rod) return &touch;
    const float place = touch.contact.place;
    const bool from_above = touch.rod + 1 == rod && place > 1 - kNearNode;
    const bool from_below = touch.rod == rod + 1 && place < kNearNode;
    if (from_above || from_below) beside = &touch;
  }
  return beside;
}

Vec3d world_origin(const State& state, Vec3 shift) {
  return to_double(state.needle->base_m) + to_double(shift);
}

// Where the needle held a piece before it was placed anew. One that was nowhere has come from
// nowhere: it is where it is now.
Segment before_of(const Vec3* node_m, Vec3d shift_m, const Segment& now_m) {
  const Segment before = {to_double(node_m[0]) + shift_m, to_double(node_m[1]) + shift_m};
  const Vec3d along = before.b_m - before.a_m;
  return dot(along, along) > 0 ? before : now_m;
}

RodFace rod_face(const Model& model, const Near& near, Vec3d origin_m) {
  const ObstacleConfig& config = model.obstacle[near.body].config;
  return {(near.rod + static_cast<double>(near.face.place)) * model.rod->rod_m,
          near.face.at_m - origin_m,
          near.face.normal,
          near.face.depth_m,
          near.face.bristle_m,
          static_cast<double>(config.stiffness_n_per_m),
          min_of(static_cast<double>(config.largest_force_n), kMaxRodForceN),
          static_cast<double>(config.friction),
          near.face.goes_on ? static_cast<double>(near.last->contact.limit_n) : 0,
          near.face.depth_m > 0 || near.last != nullptr,
          false,
          0,
          0};
}

double most_turn_rad(const Model& model) {
  return static_cast<double>(kMaxNormalTurnRadPerS * model.head->config.period_s);
}

// In a full list, the place of the least deep face; null: the new face is left out.
Near* place_for(Nearest& out, double depth_m) {
  if (out.faces.count < kMaxTouches) return out.near + out.faces.count++;
  Near* least = out.near;
  for (Near& each : out.near) {
    if (each.face.depth_m < least->face.depth_m) least = &each;
  }
  if (depth_m > 0 && least->face.depth_m > 0) ++out.left_out;
  return least->face.depth_m < depth_m ? least : nullptr;
}

// A face of the last look and what bending made of it; null: it was not seen.
struct Seen {
  const Near* near;
  const RodFace* face;
};
Seen seen(const Nearest& before, std::uint32_t body, std::uint32_t rod) {
  for (std::uint32_t i = 0; i < before.faces.count; ++i) {
    const Near& near = before.near[i];
    if (near.body == body && near.rod == rod) return {&near, before.faces.face + i};
  }
  return {nullptr, nullptr};
}

}  // namespace

void look_around(const Model& model, const State& state, const Scratch& scratch, Vec3 shift,
                 const Nearest& before, Nearest& out) {
  const RodResult& result = *scratch.rod_result;
  const double radius_m = static_cast<double>(model.needle_config().outer_radius_m);
  const Vec3d origin_m = world_origin(state, shift);
  out = {};
  for (std::uint32_t body = 0; body < model.head->obstacle_count; ++body) {
    for (std::uint32_t rod = 0; rod < model.rod->rods; ++rod) {
      const Segment axis = {origin_m + result.node_m[rod], origin_m + result.node_m[rod + 1]};
      const Touch* last = remembered(state, body, rod);
      Vec3d now = {0, 0, 0};
      if (last != nullptr) {
        const double arc =
            (last->rod + static_cast<double>(last->contact.place)) * model.rod->rod_m;
        now = origin_m + rod_point(*model.rod, result, arc).place_m;
      }
      Near found = {body, rod, {}, last};
      const Seen at = seen(before, body, rod);
      const CameFrom from = {at.near != nullptr ? at.near->face.normal : Vec3d{0, 0, 0},
                             before_of(state.node + rod, to_double(shift), axis)};
      if (!find_face(model.obstacle[body], axis, radius_m,
                     last != nullptr ? last->contact : ObstacleContact{}, now, from,
                     {kReachM, most_turn_rad(model)}, found.face)) {
        continue;
      }
      Near* const place = place_for(out, found.face.depth_m);
      if (place == nullptr) continue;
      *place = found;
      RodFace& face = out.faces.face[place - out.near];
      face = rod_face(model, found, origin_m);
      // Friction starts from the limit of the last look, not again from the last tick's.
      if (at.face != nullptr) face.limit_n = at.face->limit_n;
    }
  }
}

namespace {

// Stores what a face did as the touch for the next tick; its loss goes into the books.
bool enter_touch(const Model& model, State& state, const Scratch& scratch, const Nearest& nearest,
                 std::uint32_t i, Touch& out) {
  const Near& near = nearest.near[i];
  const RodFace& face = nearest.faces.face[i];
  const Obstacle& obstacle = model.obstacle[near.body];
  const RodTouch touch = touch_face(*model.rod, *scratch.rod_result, face);
  // Without force there is no friction, whatever the limit was before.
  const double most_n = face.friction * touch.force_n, most = most_n / face.stiffness_n_per_m;
  const double length = norm(touch.bristle_m);
  const Vec3d bristle = length > most ? (most / length) * touch.bristle_m : touch.bristle_m;
  const ObstacleContact last = near.last != nullptr ? near.last->contact : ObstacleContact{};
  state.head->obstacles_j += face_loss(obstacle, near.face, last, touch.moved_m, bristle);
  if (!(touch.force_n > 0)) return false;
  const Vec3 normal = to_float(near.face.normal);
  const Vec3d at = near.face.at_m + touch.moved_m;
  out = {near.body,
         near.rod,
         {normal, to_float(bristle), at, near.face.place,
          static_cast<float>(touch.slips && face.limit_n < most_n ? face.limit_n : most_n)},
         to_float(at),
         to_float(touch.force_n * near.face.normal - face.stiffness_n_per_m * bristle),
         static_cast<float>(face.arc_m),
         obstacle_stiffness(obstacle, normal, touch.depth_m, touch.slips),
         normal,
         static_cast<float>(touch.depth_m)};
  return true;
}

std::uint32_t keep_touches(State& state, const Touch* touch, std::uint32_t count,
                           std::uint32_t left_out) {
  NeedleState& own = *state.needle;
  state.head->obstacle_pool_full += left_out;
  if (count > 0 && own.touch_count == 0) add_event(state, EventKind::kObstacle, 0);
  for (std::uint32_t i = 0; i < count; ++i) state.touch[i] = touch[i];
  own.touch_count = count;
  own.touch_max = own.touch_max > count ? own.touch_max : count;
  return left_out > 0 ? std::uint32_t{kFlagObstaclePoolFull} : 0U;
}

}  // namespace

std::uint32_t enter_touches(const Model& model, State& state, Scratch& scratch,
                            const Nearest& nearest) {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < nearest.faces.count; ++i) {
    if (enter_touch(model, state, scratch, nearest, i, scratch.touch[count])) ++count;
  }
  return keep_touches(state, scratch.touch, count, nearest.left_out);
}

std::uint32_t touch_obstacles(const Model& model, State& state, Scratch& scratch,
                              const Needle& needle, const Vec3 before_m[2], Vec3 shift) {
  std::uint32_t count = 0;
  for (std::uint32_t body = 0; body < model.head->obstacle_count; ++body) {
    const NeedlePiece piece = {needle.node[0] + shift, needle.node[1] + shift,
                               model.needle_config().outer_radius_m};
    const Touch* const last = remembered(state, body, 0);
    ObstacleContact next = {};
    const Segment before =
        before_of(before_m, to_double(shift), {to_double(piece.a_m), to_double(piece.b_m)});
    const ObstacleLoad load =
        obstacle_load(model.obstacle[body], piece, before, most_turn_rad(model),
                      last != nullptr ? last->contact : ObstacleContact{}, next);
    state.head->obstacles_j += static_cast<double>(load.dissipated_j);
    if (!(load.depth_m > 0)) continue;
    scratch.touch[count++] = {body,
                              0,
                              next,
                              load.at_m,
                              load.force_n,
                              load.place * needle.rod_m,
                              load.stiffness_n_per_m,
                              load.normal,
                              load.depth_m};
  }
  return keep_touches(state, scratch.touch, count, 0);
}

}  // namespace stylet
