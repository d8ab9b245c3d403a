// SPDX-License-Identifier: Apache-2.0
// What must hold after every tick, whatever the input: used by fuzzers, simulator and scenes.
//
// `broken_promise` looks at one tick from outside and from inside and names the first promise that
// does not hold. Promise: no allocation if all of them hold. Units: SI. Frame: world.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "base/math.h"
#include "coupling/roll.h"
#include "state/layout.h"
#include "stylet/kernel.h"

namespace stylet::test {

// Forces are sums of up to 146 floats: they agree with the sum in double to this, relative to the
// sum of magnitudes, or to this many newtons.
constexpr double kSumTolerance = 1e-6;
// A position in the world is rounded twice on its way out of the attachments' frame: moments agree
// to this fraction of position times force.
constexpr double kPlaceRounding = 1.2e-7;

struct Sum3 {
  double x = 0, y = 0, z = 0, magnitude = 0, rounded = 0;

  void add(double ax, double ay, double az) {
    x += ax;
    y += ay;
    z += az;
    magnitude += std::sqrt(ax * ax + ay * ay + az * az);
  }
  void add(Vec3 v) {
    add(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
  }
  void add_moment(Vec3 place, Vec3 handle, Vec3 force) {
    const Vec3 arm = place - handle;
    rounded += kPlaceRounding * static_cast<double>(norm(place) * norm(force));
    const double ax = static_cast<double>(arm.x), ay = static_cast<double>(arm.y),
                 az = static_cast<double>(arm.z);
    const double fx = static_cast<double>(force.x), fy = static_cast<double>(force.y),
                 fz = static_cast<double>(force.z);
    add(ay * fz - az * fy, az * fx - ax * fz, ax * fy - ay * fx);
  }
  double distance(Vec3 v) const {
    const double dx = x - static_cast<double>(v.x), dy = y - static_cast<double>(v.y),
                 dz = z - static_cast<double>(v.z);
    return std::sqrt(dx * dx + dy * dy + dz * dz);
  }
  bool is(Vec3 v, double tolerance) const {
    return distance(v) <= tolerance * (1 + magnitude) + rounded;
  }
};

inline bool all_finite(const Output& out) {
  return is_finite(out.force_n) && is_finite(out.torque_nm) && is_finite(out.tip_m) &&
         is_finite(out.cause.stiffness_n) && is_finite(out.cause.cutting_n) &&
         is_finite(out.cause.friction_n) && is_finite(out.cause.clamping_n) &&
         is_finite(out.cause.obstacle_n) && std::isfinite(out.depth_m) &&
         std::isfinite(out.stiffness_n_per_m) && std::isfinite(out.flow.opening_pa) &&
         std::isfinite(out.flow.hub_pa) && std::isfinite(out.flow.flow_m3_per_s) &&
         std::isfinite(out.flow.injected_m3) && std::isfinite(out.flow.plunger_m) &&
         std::isfinite(out.flow.plunger_m_per_s) && std::isfinite(out.flow.filled);
}

// Force and moment of a needle's constraint particles and contacts on it, about its handle.
struct Wrench {
  Sum3 force, torque;
};
inline Wrench wrench_on(const Kernel& kernel, std::uint32_t needle) {
  static thread_local std::array<ConstraintParticle, kMaxNeedles*(kMaxConstraintParticles + 1)>
      particles;
  static thread_local std::array<ObstacleTouch, kMaxNeedles * kMaxTouches> touches;
  View view = needle_view(view_of(kernel), needle);
  const Vec3 handle = view.state.needle->handle.position_m;
  Wrench sum;
  sum.torque.add(roll_torque_nm(view.state));
  const std::uint32_t held = constraint_particles(kernel, particles);
  for (const ConstraintParticle& p : std::span(particles).first(held)) {
    if (p.needle != needle) continue;
    sum.force.add(p.force_on_needle_n);
    sum.torque.add_moment(p.position_m, handle, p.force_on_needle_n);
  }
  const std::uint32_t touched = obstacle_touches(kernel, touches);
  for (const ObstacleTouch& t : std::span(touches).first(touched)) {
    if (t.needle != needle) continue;
    sum.force.add(t.force_on_needle_n);
    sum.torque.add_moment(t.position_m, handle, t.force_on_needle_n);
  }
  return sum;
}

// The wrench on the hand is that on the needle, and the sum of its causes.
inline const char* broken_sum(const Kernel& kernel, std::uint32_t needle, const Output& out) {
  const Wrench sum = wrench_on(kernel, needle);
  Sum3 causes;
  for (const Vec3 cause : {out.cause.stiffness_n, out.cause.cutting_n, out.cause.friction_n,
                           out.cause.clamping_n, out.cause.obstacle_n}) {
    causes.add(cause);
  }
  if (!sum.force.is(out.force_n, kSumTolerance)) return "force is not the sum over its particles";
  if (!sum.torque.is(out.torque_nm, kSumTolerance))
    return "torque is not the sum over its particles";
  if (!causes.is(out.force_n, kSumTolerance)) return "force is not the sum of its causes";
  return nullptr;
}

inline const char* broken_pool(const Kernel& kernel) {
  const Stats s = stats(kernel);
  const std::uint32_t needles = view_of(kernel).model.head->counts.needles;
  for (const Pool& pool : {s.constraint_particles, s.obstacle_contacts}) {
    // Number used by all needles, most used by one, and capacity of one.
    if (pool.used > pool.capacity * needles) return "a pool holds more than there is room for";
    if (pool.used_max > pool.capacity) return "a pool held more than there is room for";
    if (pool.used > pool.used_max * needles) return "a pool's largest use is less than its use";
  }
  for (const Pool& pool : {s.coupled_voxels, s.tracks}) {
    if (pool.used_max > pool.capacity) return "a pool held more than there is room for";
  }
  if (s.fault != 0) return "the kernel latched a fault";
  if (!(s.coupling_shortfall >= 0 && s.coupling_shortfall <= 1)) return "a shortfall beyond 0 to 1";
  return nullptr;
}

inline const char* broken_phase(const Kernel& kernel, std::uint32_t needle, const Output& out) {
  const NeedleState& own = *needle_view(view_of(kernel), needle).state.needle;
  const bool inside = out.phase == Phase::kInserted || out.phase == Phase::kRetracting;
  if (out.phase > Phase::kRetracting) return "no such phase";
  if (!inside && own.shaft_count > 0) return "shaft particles of a needle that is not inside";
  if (inside && own.shaft_count == 0) return "a needle inside without shaft particles";
  if ((out.phase == Phase::kFree) != (own.tip_alive == 0)) return "phase and tip disagree";
  if (!(out.depth_m >= 0)) return "negative depth";
  if (out.phase == Phase::kFree && out.depth_m > 0) return "depth of a needle outside";
  return nullptr;
}

// The first promise that does not hold after a tick with these outputs; nullptr: all hold.
inline const char* broken_promise(const Kernel& kernel, std::span<const Output> outputs) {
  for (std::uint32_t i = 0; i < outputs.size(); ++i) {
    const Output& out = outputs[i];
    if ((out.flags & kFlagFault) != 0) return "the kernel latched a fault";
    if (!all_finite(out)) return "a number that is not finite in the output";
    if (const char* sum = broken_sum(kernel, i, out); sum != nullptr) return sum;
    if (const char* phase = broken_phase(kernel, i, out); phase != nullptr) return phase;
  }
  return broken_pool(kernel);
}

}  // namespace stylet::test
