// SPDX-License-Identifier: Apache-2.0
#include "drawn_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw.h"
#include "base/math.h"

namespace stylet::test {
namespace {

constexpr double kOutsideM = 3e-3;  // where a tip begins and ends

// Force of a flat punch as wide as the needle, pressed into this material to the given depth:
// Sneddon 1965.
float punch_n(const TinyMaterial& m, float radius_m, float depth_m) {
  return 2 * radius_m * m.youngs_modulus_pa / (1 - m.poisson_ratio * m.poisson_ratio) * depth_m;
}

TinyMaterial draw_material(Draw& draw, float radius_m) {
  TinyMaterial m;
  m.youngs_modulus_pa = draw.magnitude(3e3, 5e4);
  m.poisson_ratio = draw.between(0.3, 0.49);
  m.relaxing_fraction = draw.chance(0.5) ? draw.between(0.2, 0.6) : 0;
  m.relaxation_time_s = draw.magnitude(0.1, 5);
  m.puncture_force_n = punch_n(m, radius_m, draw.between(2e-3, 8e-3));
  m.cutting_force_n = m.puncture_force_n * draw.between(0.3, 0.9);
  m.recut_fraction = draw.between(0, 0.5);
  m.coulomb_friction_n_per_m = m.puncture_force_n * draw.magnitude(3, 30);
  m.static_friction_n_per_m = m.coulomb_friction_n_per_m * draw.between(1, 1.5);
  m.stribeck_velocity_m_per_s = draw.magnitude(1e-4, 1e-2);
  m.viscous_friction_n_s_per_m2 = draw.chance(0.5) ? draw.magnitude(1, 200) : 0;
  m.puncture_velocity_exponent = draw.chance(0.3) ? draw.between(0, 0.3) : 0;
  return m;
}

// Boundaries of layers do not lie between voxels: each voxel just below a boundary has a plane in
// it.
void tilt_faces(Draw& draw, std::uint32_t layers, TinyOrgan& tiny) {
  const float tilt = draw.between(-0.3, 0.3);
  std::uint32_t voxel = 0;
  for (std::uint16_t z = 0; z < tiny.nz; ++z) {
    const std::uint32_t below = z * layers / tiny.nz, above = (z + 1U) * layers / tiny.nz;
    for (std::uint32_t i = 0; i < std::uint32_t{tiny.nx} * tiny.ny; ++i, ++voxel) {
      if (above == below || above == layers) continue;
      tiny.mixed.emplace_back(voxel, static_cast<std::uint16_t>(above), std::uint16_t{0}, tilt,
                              0.0F, 1.0F, 0.5F + 0.5F * tilt);
    }
  }
}

std::unique_ptr<OpenOrgan> draw_organ(Draw& draw, Kind kind, float radius_m) {
  TinyOrgan tiny;
  for (std::uint16_t* size : {&tiny.nx, &tiny.ny, &tiny.nz}) {
    *size = static_cast<std::uint16_t>(8 + draw.below(4));
  }
  tiny.voxel_edge_m = draw.between(3e-3, 6e-3);
  tiny.origin_m = {draw.between(-0.1, 0.1), draw.between(-0.1, 0.1), draw.between(-0.1, 0.1)};
  tiny.fixed_faces = kLowZ;
  for (const std::uint32_t face : {kLowX, kHighX, kLowY, kHighY}) {
    if (draw.chance(0.3)) tiny.fixed_faces |= face;
  }
  const std::uint32_t layers = kind == Kind::kLayers ? 3 : 1;
  tiny.materials.clear();
  for (std::uint32_t i = 0; i < layers; ++i) {
    tiny.materials.push_back(draw_material(draw, radius_m));
  }
  tiny.material_at = [nz = tiny.nz, layers](std::uint16_t, std::uint16_t, std::uint16_t z) {
    return static_cast<std::uint8_t>(std::uint32_t{z} * layers / nz);
  };
  if (kind == Kind::kLayers) {
    // The second of two organs, below the first with a gap of a voxel.
    const auto gap = static_cast<std::uint16_t>(tiny.nz / 2);
    if (draw.chance(0.5)) {
      tiny.inside = [gap](std::uint16_t, std::uint16_t, std::uint16_t z) { return z != gap; };
    } else {
      tilt_faces(draw, layers, tiny);
    }
    if (tiny.inside) tiny.fixed_faces |= kLowX | kHighX;  // to hold the upper one
  }
  TinyMaterial& top = tiny.materials.back();
  if (kind == Kind::kSurface) top.puncture_force_n *= 10;  // the surface withstands any force
  if (draw.chance(0.4)) top.membrane_n_per_m = draw.magnitude(50, 1000);
  return open_organ(tiny_organ(tiny));
}

NeedleConfig draw_needle(Draw& draw, Kind kind, float radius_m, float edge_m) {
  NeedleConfig needle;
  needle.outer_radius_m = radius_m;
  needle.unit_m = edge_m * draw.between(0.5, 1);
  needle.tip_half_angle_rad = draw.between(0.15, 0.8);
  const bool bends = kind == Kind::kElastic || (kind != Kind::kRigid && draw.chance(0.5));
  if (!bends) return needle;
  needle.bending_nm2 = draw.magnitude(1e-3, 2e-2);
  needle.rods = 16 + draw.below(32);
  if (kind != Kind::kElastic) return needle;
  if (draw.chance(0.6)) needle.bevel_per_m = draw.between(1, 15);
  if (draw.chance(0.5)) needle.torsion_nm2 = needle.bending_nm2 / 1.3F;
  if (draw.chance(0.3)) {
    needle.bent_length_m = draw.between(5e-3, 20e-3);
    needle.bent_angle_rad = draw.between(0.05, 0.3);
  }
  return needle;
}

class Way {
 public:
  Way(Draw& draw, double start_s) : draw_(draw) { moves_.push_back({place_, start_s, {}, false}); }

  // Moves on by this way, at a random speed.
  void go(Vec3 to_m) {
    const Vec3 step = to_m - place_;
    const double speed = static_cast<double>(draw_.magnitude(15e-3, 60e-3));
    const double way = std::sqrt(static_cast<double>(dot(step, step)));
    place_ = to_m;
    moves_.push_back({place_, std::max(way / speed, 0.02), {}, false});
  }
  void go_deep(float deep_m) { go({place_.x, place_.y, deep_m}); }
  void rest(double low_s, double high_s) {
    moves_.push_back({place_, static_cast<double>(draw_.between(low_s, high_s)), {}, true});
  }
  void swing(Vec3 by_m) { moves_.push_back({place_, 2 / kSwingHz, by_m, false}); }
  // Moves aside and back to the middle.
  void step_aside() {
    go({draw_.between(-2e-3, 2e-3), draw_.between(-2e-3, 2e-3), place_.z});
    rest(0.2, 0.3);
    go({0, 0, place_.z});
  }

  std::vector<Move> moves() && { return std::move(moves_); }

 private:
  Draw& draw_;
  Vec3 place_ = {0, 0, static_cast<float>(-kOutsideM)};
  std::vector<Move> moves_;
};

// `deep_m` is the depth for most of the time, `deeper_m` the largest depth.
std::vector<Move> draw_moves(Draw& draw, double start_s, float deep_m, float deeper_m) {
  constexpr float kSwingM = 1e-3F;
  Way way(draw, start_s);
  way.go_deep(deep_m);
  way.rest(0.2, 0.4);
  way.step_aside();
  const float turn = draw.between(0, 2 * std::numbers::pi);
  way.swing({kSwingM * std::cos(turn), kSwingM * std::sin(turn), 0});
  way.rest(0.2, 0.3);
  way.swing({0, 0, kSwingM});
  way.rest(0.2, 0.3);
  way.go_deep(deeper_m);
  way.rest(0.1, 0.3);
  way.go_deep(deep_m * draw.between(0.2, 0.6));
  way.rest(0.1, 0.2);
  way.go_deep(deep_m);
  way.step_aside();
  way.go_deep(static_cast<float>(-kOutsideM));
  way.rest(0.8, 0.8);
  return std::move(way).moves();
}

ObstacleConfig draw_bone(Draw& draw, const Hand& hand, float deep_m) {
  ObstacleConfig bone;
  const float size_m = draw.between(3e-3, 8e-3);
  if (draw.chance(0.5)) {
    make_sphere(bone, size_m);
  } else {
    make_box(bone, {2 * size_m, 2 * size_m, size_m});
    bone.pose.rotation = hand.rotation;
  }
  const Mat3 frame = rotation_matrix(hand.rotation);
  const Vec3 off = {size_m * draw.between(-0.3, 0.3), size_m * draw.between(-0.3, 0.3),
                    -(deep_m + size_m)};
  bone.pose.position_m = hand.entry_m + frame * off;
  bone.stiffness_n_per_m = draw.magnitude(2e3, 2e4);
  bone.largest_force_n = draw.between(5, 20);
  bone.friction = draw.between(0, 0.6);
  return bone;
}

Hand draw_hand(Draw& draw, const Organ& organ, float length_m, float aside_m) {
  const float edge = organ.voxel_edge_m;
  const Vec3 middle =
      organ.origin_m +
      0.5F * edge * Vec3{static_cast<float>(organ.size_x), static_cast<float>(organ.size_y), 0};
  const Vec3 off = {draw.between(-1, 1) * edge + aside_m, draw.between(-1, 1) * edge,
                    edge * static_cast<float>(organ.size_z)};
  const float x = draw.between(-0.1, 0.1), y = draw.between(-0.1, 0.1), z = draw.between(-0.5, 0.5);
  const float size = std::sqrt(1 + x * x + y * y + z * z);
  return {middle + off, {1 / size, x / size, y / size, z / size}, length_m, {}};
}

double length_s(const std::vector<Move>& moves) {
  double sum = 0;
  for (const Move& each : moves) sum += each.duration_s;
  return sum;
}

}  // namespace

const char* kind_name(Kind kind) {
  constexpr const char* kNames[] = {"rigid", "elastic", "bone", "two", "surface", "layers"};
  return kNames[static_cast<int>(kind)];
}

DrawnScene draw_scene(std::uint64_t seed, Kind kind) {
  Draw draw(seed * kKinds + static_cast<std::uint32_t>(kind));
  const float radius_m = draw.between(0.25e-3, 0.8e-3);
  DrawnScene scene{kind, draw_organ(draw, kind, radius_m), {}, {}, {}, 0};
  const Organ& organ = scene.organ->organ;
  const float edge_m = organ.voxel_edge_m, thick_m = edge_m * static_cast<float>(organ.size_z);
  if (draw.chance(0.3)) scene.config.inertia = Inertia::kTrueMass;
  scene.config.needle_count = kind == Kind::kTwo ? 2 : 1;
  const float apart_m = draw.between(1.2, 2.2) * edge_m;
  for (std::uint32_t i = 0; i < scene.config.needle_count; ++i) {
    scene.config.needle[i] = draw_needle(draw, kind, radius_m, edge_m);
    const float length_m = scene.config.needle[i].length_m = thick_m + draw.between(0.05, 0.1);
    Hand hand = draw_hand(draw, organ, length_m, i == 0 ? 0 : apart_m);
    float deep_m = thick_m * draw.between(0.35, 0.6), deeper_m = thick_m * draw.between(0.65, 0.9);
    if (kind == Kind::kSurface) {
      deep_m = edge_m * draw.between(0.3, 1);
      deeper_m = 1.3F * deep_m;
    } else if (kind == Kind::kBone) {
      scene.obstacles.push_back(draw_bone(draw, hand, deep_m));
      deep_m += draw.between(0.1e-3, 0.6e-3);
      deeper_m = deep_m + draw.between(0.2e-3, 1e-3);
    }
    hand.moves = draw_moves(draw, i == 0 ? 0 : 0.5, deep_m, deeper_m);
    scene.duration_s = std::max(scene.duration_s, length_s(hand.moves));
    scene.hands.push_back(std::move(hand));
  }
  return scene;
}

HandPlace hand_place(const Hand& hand, double time_s, double deeper_m) {
  Vec3 from = hand.moves.front().to_m, tip = hand.moves.back().to_m;
  bool at_rest = false;
  double begin_s = 0;
  for (const Move& move : hand.moves) {
    const double passed_s = time_s - begin_s;
    if (passed_s < move.duration_s) {
      const double x = passed_s / move.duration_s;
      tip = from + static_cast<float>(x * x * (3 - 2 * x)) * (move.to_m - from);
      const double turns = kSwingHz * passed_s;
      const double swing = std::min(turns, 1.0) * std::sin(2 * std::numbers::pi * turns);
      tip = tip + static_cast<float>(swing) * move.swing_m;
      at_rest = move.is_rest && passed_s > move.duration_s - kJudgedS;
      break;
    }
    begin_s += move.duration_s;
    from = move.to_m;
  }
  const float along = hand.length_m - (tip.z + static_cast<float>(deeper_m));
  const Mat3 frame = rotation_matrix(hand.rotation);
  return {{hand.entry_m + frame * Vec3{tip.x, tip.y, along}, hand.rotation}, at_rest};
}

}  // namespace stylet::test
