// SPDX-License-Identifier: Apache-2.0
// Handles of the C interface that are freed with their scope, and random sessions for them.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "draw.h"
#include "session.h"
#include "stylet/stylet_loop.h"

namespace stylet::test {

template <typename T, void (*kFree)(T*)>
struct Freed {
  void operator()(T* handle) const { kFree(handle); }
};
using OrganHandle = std::unique_ptr<stylet_organ, Freed<stylet_organ, stylet_organ_free>>;
using SimulationHandle =
    std::unique_ptr<stylet_simulation, Freed<stylet_simulation, stylet_simulation_free>>;
using BatchHandle = std::unique_ptr<stylet_batch, Freed<stylet_batch, stylet_batch_free>>;
using GuardHandle = std::unique_ptr<stylet_guard, Freed<stylet_guard, stylet_guard_free>>;
using LoopHandle = std::unique_ptr<stylet_loop, Freed<stylet_loop, stylet_loop_free>>;

inline OrganHandle c_organ(const OpenOrgan& opened) {
  stylet_organ* organ = nullptr;
  EXPECT_EQ(stylet_organ_from_bytes(opened.bytes.data(), opened.bytes.size(), &organ, nullptr),
            STYLET_OK);
  return OrganHandle(organ);
}

// The same configuration for C and for C++.
struct DrawnConfig {
  Config cpp;
  stylet_config c;
  std::vector<stylet_needle> needles;
};

inline stylet_needle to_c(const NeedleConfig& n) {
  stylet_needle out;
  EXPECT_EQ(stylet_needle_init(&out, sizeof out), STYLET_OK);
  out.length_m = n.length_m;
  out.outer_radius_m = n.outer_radius_m;
  out.bending_nm2 = n.bending_nm2;
  out.rods = n.rods;
  out.bevel_per_m = n.bevel_per_m;
  out.torsion_nm2 = n.torsion_nm2;
  out.tip_half_angle_rad = n.tip_half_angle_rad;
  out.torn_diameters = n.torn_diameters;
  out.hub = static_cast<std::uint32_t>(n.hub);
  out.bore_radius_m = n.bore_radius_m;
  out.opening_m = n.opening_m;
  out.filling_pa_s = n.filling_pa_s;
  out.plunger_radius_m = n.plunger_radius_m;
  out.plunger_friction_n = n.plunger_friction_n;
  out.syringe_m3 = n.syringe_m3;
  out.syringe_filled = n.syringe_filled;
  out.syringe_gas_m3 = n.syringe_gas_m3;
  return out;
}

inline DrawnConfig drawn_config(Draw& draw) {
  DrawnConfig out;
  EXPECT_EQ(stylet_config_init(&out.c, sizeof out.c), STYLET_OK);
  out.c.substeps = out.cpp.substeps = 1 + draw.below(3);
  out.cpp.inertia = draw.chance(0.5) ? Inertia::kTrueMass : Inertia::kAddedMass;
  out.c.inertia = static_cast<std::uint32_t>(out.cpp.inertia);
  out.c.tissue_damping_s = out.cpp.tissue_damping_s = draw.between(0, 1e-3);
  const Vec3 breath = {draw.between(-2e-3, 2e-3), 0, draw.between(0, 3e-3)};
  out.cpp.breathing = {breath, draw.between(2, 6)};
  out.c.breathing_amplitude_m = {breath.x, breath.y, breath.z};
  out.c.breathing_period_s = out.cpp.breathing.period_s;
  const Vec3 weight = {draw.between(-4, 4), draw.between(-4, 4), draw.between(-4, 4)};
  if (draw.chance(0.5)) out.cpp.gravity_m_per_s2 = weight;
  const Vec3 gravity = out.cpp.gravity_m_per_s2;
  out.c.gravity_m_per_s2 = {gravity.x, gravity.y, gravity.z};
  out.cpp.needle_count = 1 + draw.below(3);
  for (std::uint32_t i = 0; i < out.cpp.needle_count; ++i) {
    NeedleConfig& needle = out.cpp.needle[i];
    needle.length_m = draw.between(0.08, 0.2);
    needle.outer_radius_m = draw.between(0.3e-3, 0.9e-3);
    needle.bending_nm2 = draw.chance(0.5) ? 0 : draw.magnitude(1e-3, 0.1);
    needle.rods = 8 + draw.below(40);
    needle.bevel_per_m = draw.chance(0.5) ? 0 : draw.between(0, 8);
    needle.torsion_nm2 = draw.chance(0.5) ? 0 : draw.magnitude(1e-3, 0.1);
    needle.tip_half_angle_rad = draw.between(0.15, 0.6);
    needle.torn_diameters = draw.between(0.5, 3);
    needle.hub = static_cast<Hub>(draw.below(3));
    needle.bore_radius_m = draw.between(0.1e-3, 0.3e-3);
    needle.opening_m = draw.between(0, 3e-3);
    needle.filling_pa_s = draw.magnitude(1e-5, 1e-2);
    needle.plunger_radius_m = draw.between(2e-3, 15e-3);
    needle.plunger_friction_n = draw.between(0, 1);
    needle.syringe_m3 = draw.between(1e-6, 2e-5);
    needle.syringe_filled = draw.between(0, 1);
    needle.syringe_gas_m3 = draw.magnitude(1e-9, 1e-6);
    out.needles.push_back(to_c(needle));
  }
  return out;
}

inline SimulationHandle c_simulation(const stylet_organ* organ, const DrawnConfig& config) {
  stylet_simulation* made = nullptr;
  stylet_refusal why = {};
  why.struct_bytes = sizeof why;
  const auto count = static_cast<std::uint32_t>(config.needles.size());
  EXPECT_EQ(stylet_simulation_create(organ, &config.c, config.needles.data(), count, &made, &why),
            STYLET_OK)
      << why.text;
  return SimulationHandle(made);
}

inline stylet_input to_c(const Input& input) {
  const Vec3 p = input.handle.position_m;
  const Quat q = input.handle.rotation;
  return {
      sizeof(stylet_input), input.valid, {{p.x, p.y, p.z}, {q.w, q.x, q.y, q.z}}, input.plunger_n};
}

// Needles side by side, each with the script of a single one.
inline std::vector<Input> inputs_at(const Organ& organ, const Config& config, std::uint64_t tick) {
  std::vector<Input> out;
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    Script script = block_script(organ, config);
    script.needle_length_m = config.needle[i].length_m;
    script.entry_m.x += 6e-3F * (static_cast<float>(i) - 1);
    out.push_back(scripted_input(script, tick + 100 * i));
  }
  return out;
}

}  // namespace stylet::test
