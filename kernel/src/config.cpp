// SPDX-License-Identifier: Apache-2.0
#include "config.h"

#include <cstring>

#include "base/math.h"
#include "stylet/first_outside.h"

namespace stylet {
namespace {

double wide(float value) {
  return static_cast<double>(value);
}

void check_fluid(const NeedleConfig& n, FirstOutside& first) {
  const auto within = [&](const char* field, float value, float least, float most) {
    first.check(field, wide(value), wide(least), wide(most));
  };
  first.check("needle.hub", static_cast<std::uint32_t>(n.hub), 0, 2);
  if (n.hub == Hub::kClosed) return;
  within("needle.bore_radius_m", n.bore_radius_m, kMinBoreM, n.outer_radius_m);
  within("needle.opening_m", n.opening_m, 0, kMaxOpeningM);
  within("needle.filling_pa_s", n.filling_pa_s, kMinViscosityPaS, kMaxViscosityPaS);
  if (n.hub != Hub::kSyringe) return;
  within("needle.plunger_radius_m", n.plunger_radius_m, kMinPlungerM, kMaxPlungerM);
  within("needle.plunger_friction_n", n.plunger_friction_n, 0, kMaxPlungerFrictionN);
  within("needle.syringe_m3", n.syringe_m3, kMinSyringeM3, kMaxSyringeM3);
  within("needle.syringe_filled", n.syringe_filled, 0, 1);
  within("needle.syringe_gas_m3", n.syringe_gas_m3, kMinSyringeGasM3, kMaxSyringeM3);
}

// A narrower needle than 0.02 mm has no steel; a longer unit than 5 cm is no part of a shaft.
Status check_needle(const NeedleConfig& n, std::uint32_t index, ConfigRefusal* refusal_out) {
  FirstOutside first(index);
  const auto within = [&](const char* field, float value, float least, float most) {
    first.check(field, wide(value), wide(least), wide(most));
  };
  within("needle.length_m", n.length_m, 1e-3F, kMaxNeedleLengthM);
  within("needle.outer_radius_m", n.outer_radius_m, 1e-5F, 0.01F);
  within("needle.unit_m", n.unit_m, 1e-4F, 0.05F);
  within("needle.bending_nm2", n.bending_nm2, 0, kMaxBendingNm2);
  first.check("needle.rods", n.rods, 1, kMaxRods);
  within("needle.bevel_per_m", n.bevel_per_m, 0, kMaxBevelPerM);
  within("needle.bent_length_m", n.bent_length_m, 0, n.length_m);
  within("needle.bent_angle_rad", n.bent_angle_rad, 0, kMaxBentAngleRad);
  within("needle.torsion_nm2", n.torsion_nm2, 0, kMaxTorsionNm2);
  within("needle.tip_half_angle_rad", n.tip_half_angle_rad, kMinTipHalfAngleRad,
         kMaxTipHalfAngleRad);
  within("needle.torn_diameters", n.torn_diameters, kMinTornDiameters, kMaxTornDiameters);
  check_fluid(n, first);
  return first.status(refusal_out);
}

Status check_tissue(const Config& c, ConfigRefusal* refusal_out) {
  FirstOutside first(0);
  const auto within = [&](const char* field, float value, float least, float most) {
    first.check(field, wide(value), wide(least), wide(most));
  };
  first.check("mode", static_cast<std::uint32_t>(c.mode), 0, 1);
  within("period_s", c.period_s, kMinPeriodS, kMaxPeriodS);
  first.check("substeps", c.substeps, 1, kMaxSubsteps);
  first.check("inertia", static_cast<std::uint32_t>(c.inertia), 0, 1);
  within("tissue_damping_s", c.tissue_damping_s, 0, 1);
  within("surround_drag_per_s", c.surround_drag_per_s, 0, 100);
  within("hourglass_weight", c.hourglass_weight, 0.05F, 1);
  within("paper_alpha", c.paper_alpha, 1e-3F, 1);
  within("breathing.period_s", c.breathing.period_s, 0.1F, 1000);
  within("breathing.amplitude_m", norm(c.breathing.amplitude_m), 0, kMaxBreathM);
  within("gravity_m_per_s2", norm(c.gravity_m_per_s2), 0, kMaxGravityMPerS2);
  first.check("needle_count", c.needle_count, 1, kMaxNeedles);
  return first.status(refusal_out);
}

// Here the sign of zero in floats. (A count cannot be a word that is only a sign bit: all counts
// are smaller.)
template <typename Words>
void drop_signs_of_zero(Words& words) {
  static_assert(sizeof(Words) % sizeof(std::uint32_t) == 0);
  for (std::size_t i = 0; i < sizeof(Words); i += sizeof(std::uint32_t)) {
    std::byte* const at = reinterpret_cast<std::byte*>(&words) + i;
    std::uint32_t word = 0;
    std::memcpy(&word, at, sizeof word);
    if (word == 0x80000000U) std::memset(at, 0, sizeof word);
  }
}

}  // namespace

Status check_config(const Config& config, ConfigRefusal* refusal_out) {
  Status status = check_tissue(config, refusal_out);
  if (status != Status::kOk) return status;
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    status = check_needle(config.needle[i], i, refusal_out);
    if (status != Status::kOk) return status;
  }
  return Status::kOk;
}

Config canonical(Config config) {
  for (std::uint32_t i = config.needle_count; i < kMaxNeedles; ++i) config.needle[i] = {};
  drop_signs_of_zero(config);
  return config;
}

ObstacleConfig canonical(ObstacleConfig config) {
  for (std::uint32_t i = config.vertex_count; i < kMaxHullVertices; ++i) config.vertices_m[i] = {};
  drop_signs_of_zero(config);
  return config;
}

}  // namespace stylet
