// SPDX-License-Identifier: Apache-2.0
// Fluid through the whole kernel: needles that go through a tight layer into one that holds fluid.
// Where pressure and flow begin is the geometry of the layers and of the opening, what they are the
// closed forms of PHYSICS 9.9; and a closed hub changes nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "coupling/layers.h"
#include "draw.h"
#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kFaceM = 20e-3F;  // from tight tissue to that with fluid

double wide(float value) {
  return static_cast<double>(value);
}

// Tight tissue, then tissue with fluid, then tight tissue again, in layers across x.
TinyOrgan layers(float pressure_pa, float conductance, float viscosity_pa_s) {
  TinyOrgan tiny;
  tiny.nx = 20;
  tiny.ny = tiny.nz = 8;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  TinyMaterial tight, wet;
  tight.youngs_modulus_pa = wet.youngs_modulus_pa = 5e4F;
  tight.puncture_force_n = tight.cutting_force_n = 0.2F;
  wet.puncture_force_n = wet.cutting_force_n = 0.2F;
  tight.coulomb_friction_n_per_m = tight.static_friction_n_per_m = 2;
  wet.coulomb_friction_n_per_m = wet.static_friction_n_per_m = 2;
  wet.fluid_pressure_pa = pressure_pa;
  wet.fluid_conductance_m3_per_pa_s = conductance;
  wet.fluid_viscosity_pa_s = viscosity_pa_s;
  tiny.materials = {tight, wet};
  tiny.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t) {
    return static_cast<std::uint8_t>(x >= 4 && x < 12 ? 1 : 0);
  };
  return tiny;
}

Config needle_with(Hub hub) {
  Config config;
  config.needle[0].hub = hub;
  return config;
}

double bore_resistance_of(const NeedleConfig& n, double viscosity) {
  return 8 * viscosity * wide(n.length_m) / (kPi * std::pow(wide(n.bore_radius_m), 4));
}

std::vector<Event> events_of(Rig& rig, EventKind kind) {
  Event all[kMaxEvents];
  const std::uint32_t count = events(rig.kernel(), all);
  std::vector<Event> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (all[i].kind == kind) out.push_back(all[i]);
  }
  return out;
}

// Goes on along x with a force on the plunger.
template <typename Visit>
void press_on(Rig& rig, float from_x_m, float to_x_m, float plunger_n, Visit visit) {
  const auto ticks = static_cast<int>(std::lround(std::fabs(to_x_m - from_x_m) / 10e-6F));
  for (int i = 1; i <= ticks; ++i) {
    const float x =
        from_x_m + (to_x_m - from_x_m) * static_cast<float>(i) / static_cast<float>(ticks);
    Input input = along_x({x, 19e-3F, 21e-3F}, rig.length_m);
    input.plunger_n = plunger_n;
    visit(checked_tick(rig, input));
  }
}

TEST(Flow, TheOpenHubOfANeedleDripsOnceItsOpeningIsInFluid) {
  Draw draw(31);
  for (int round = 0; round < 4; ++round) {
    Config config = needle_with(Hub::kOpen);
    NeedleConfig& n = config.needle[0];
    n.bore_radius_m = draw.between(2e-4, 4e-4);
    n.opening_m = round == 0 ? 0 : draw.between(0.3e-3, 3e-3);
    const float pressure = draw.between(1e3, 1e4), conductance = draw.magnitude(1e-11, 1e-8);
    const float viscosity = draw.between(7e-4, 4e-3);
    Rig rig = make_rig(layers(pressure, conductance, viscosity), config);
    float began_m = 0, depth_m = 0;
    Output out = {};
    press_on(rig, -1e-3F, 45e-3F, 0, [&](const Output& now) {
      out = now;
      if (began_m == 0 && now.flow.flow_m3_per_s != 0) began_m = now.depth_m;
      depth_m = now.depth_m;
    });
    ASSERT_GT(depth_m, 30e-3F);
    EXPECT_NEAR(began_m, kFaceM + n.opening_m, 0.3e-3F) << round;
    const double resistance = bore_resistance_of(n, wide(viscosity)) + 1 / wide(conductance);
    ASSERT_EQ(out.flow.filled, 1);
    EXPECT_NEAR(wide(out.flow.flow_m3_per_s) * resistance / -wide(pressure), 1, 1e-5);
    EXPECT_NEAR(out.flow.opening_pa,
                wide(pressure) + wide(out.flow.flow_m3_per_s) / wide(conductance),
                1e-4 * wide(pressure));
    EXPECT_EQ(out.flow.hub_pa, 0);
    const auto shown = events_of(rig, EventKind::kFlashback);
    ASSERT_EQ(shown.size(), 1U);
    EXPECT_EQ(shown[0].layer, 1U);
    EXPECT_GE(shown[0].depth_m, kFaceM + n.opening_m - 0.3e-3F);
    EXPECT_TRUE(events_of(rig, EventKind::kLossOfResistance).empty());
    // On the way back it ends where the opening leaves.
    float ended_m = 0;
    press_on(rig, 45e-3F, 12e-3F, 0, [&](const Output& now) {
      if (now.flow.flow_m3_per_s != 0) ended_m = now.depth_m;
    });
    // At the tip itself the layer is that of the tip, which a tremor at the face does not change.
    const float skin_m = round == 0 ? kLayerSkinM : 0;
    EXPECT_NEAR(ended_m, kFaceM + n.opening_m, 0.3e-3F + skin_m) << round;
  }
}

TEST(Flow, APressedPlungerHoldsInTightTissueAndGivesWayBehindIt) {
  Draw draw(32);
  for (int round = 0; round < 4; ++round) {
    Config config = needle_with(Hub::kSyringe);
    NeedleConfig& n = config.needle[0];
    n.opening_m = round == 0 ? 0 : draw.between(0.3e-3, 2e-3);
    n.plunger_friction_n = draw.between(0.1, 1);
    Rig rig = make_rig(layers(-500, 1e-8F, 0), config);
    const float thumb_n = draw.between(8, 12);
    press_on(rig, -1e-3F, 10e-3F, 0, [](const Output&) {});
    const double area = kPi * std::pow(wide(n.plunger_radius_m), 2);
    const double held = (wide(thumb_n) - wide(n.plunger_friction_n)) / area;
    const double gas = wide(n.syringe_gas_m3);
    const double squeezed = (gas - gas * 101'325 / (101'325 + held)) / area;
    press_on(rig, 10e-3F, 18e-3F, thumb_n, [&](const Output& out) {
      EXPECT_NEAR(out.flow.hub_pa, held, 1e-4 * held);
      EXPECT_EQ(out.flow.flow_m3_per_s, 0);
      EXPECT_NEAR(out.flow.plunger_m, squeezed, 1e-4 * squeezed);
    });
    EXPECT_TRUE(events_of(rig, EventKind::kLossOfResistance).empty());
    float before_m = 0;
    const double flow = (held + 500) / (bore_resistance_of(n, 1e-3) + 1e8);
    press_on(rig, 18e-3F, 26e-3F, thumb_n, [&](const Output& out) {
      const bool slides = out.flow.plunger_m > before_m && out.flow.plunger_m < 20e-3F;
      if (wide(before_m) > squeezed * 1.01 && slides) {
        EXPECT_NEAR(wide(out.flow.flow_m3_per_s) / flow, 1, 1e-4);
        EXPECT_NEAR(wide(out.flow.plunger_m_per_s) * area / flow, 1, 1e-3);
      }
      before_m = out.flow.plunger_m;
    });
    const auto lost = events_of(rig, EventKind::kLossOfResistance);
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(lost[0].layer, 1U);
    EXPECT_EQ(lost[0].force_n, thumb_n);
    EXPECT_NEAR(lost[0].depth_m, kFaceM + n.opening_m, 0.3e-3F);
    EXPECT_TRUE(events_of(rig, EventKind::kFlashback).empty());
  }
}

// Drawn, a syringe gets blood when the opening is in the vessel: as much as the plunger goes back.
TEST(Flow, ADrawnPlungerGetsTheFluid) {
  Rig rig = make_rig(layers(1000, 1e-8F, 3.5e-3F), needle_with(Hub::kSyringe));
  Output out = {};
  const auto keep = [&](const Output& now) { out = now; };
  press_on(rig, -1e-3F, 10e-3F, 0, keep);
  press_on(rig, 10e-3F, 45e-3F, -3, keep);
  EXPECT_EQ(events_of(rig, EventKind::kFlashback).size(), 1U);
  EXPECT_EQ(out.flow.filled, 1);
  const NeedleConfig n;
  const double area = kPi * std::pow(wide(n.plunger_radius_m), 2);
  const double drawn = (-3 + wide(n.plunger_friction_n)) / area;
  EXPECT_NEAR(wide(out.flow.flow_m3_per_s) * (bore_resistance_of(n, 3.5e-3) + 1e8) / (drawn - 1000),
              1, 1e-4);
  const double gas = 5e-8, hub = wide(out.flow.hub_pa);
  EXPECT_NEAR(wide(out.flow.plunger_m) * area,
              wide(out.flow.injected_m3) + gas - gas * 101'325 / (101'325 + hub), 1e-10);
}

// Air that is drawn before the needle goes in is no fluid of the tissue.
TEST(Flow, DrawnAirIsNoFlashback) {
  Rig rig = make_rig(layers(1000, 1e-8F, 3.5e-3F), needle_with(Hub::kSyringe));
  Output out = {};
  press_on(rig, -10e-3F, 15e-3F, -3, [&](const Output& now) { out = now; });
  EXPECT_LT(out.flow.injected_m3, -2e-7F);  // twice the bore
  EXPECT_EQ(out.flow.filled, 0);
  EXPECT_TRUE(events_of(rig, EventKind::kFlashback).empty());
}

// Nothing of what moves the hand knows of the fluid; and with a closed hub the state is the same
// bit by bit, whatever the tissue holds.
TEST(Flow, FluidMovesNoTissue) {
  Rig dry = make_rig(layers(0, 0, 0), Config{});
  Rig closed = make_rig(layers(1e4F, 1e-6F, 3e-3F), Config{});
  Rig open = make_rig(layers(1e4F, 1e-6F, 3e-3F), needle_with(Hub::kOpen));
  for (int i = 0; i < 3000; ++i) {
    const Input input =
        along_x({-1e-3F + 10e-6F * static_cast<float>(i), 19e-3F, 21e-3F}, dry.length_m);
    const Output a = checked_tick(dry, input), b = checked_tick(closed, input);
    const Output c = checked_tick(open, input);
    ASSERT_EQ(hash(dry.kernel()), hash(closed.kernel())) << "tick " << i;
    ASSERT_EQ(a.force_n.x, b.force_n.x);
    ASSERT_EQ(a.force_n.x, c.force_n.x) << "tick " << i;
    ASSERT_EQ(a.flow.hub_pa + a.flow.flow_m3_per_s + b.flow.flow_m3_per_s + b.flow.filled, 0);
  }
  EXPECT_EQ(closed.kernel().sizes.state_bytes, dry.kernel().sizes.state_bytes);
  EXPECT_EQ(closed.kernel().sizes.model_bytes, dry.kernel().sizes.model_bytes);
  EXPECT_EQ(open.kernel().sizes.state_bytes, dry.kernel().sizes.state_bytes + 64);
  EXPECT_EQ(open.kernel().sizes.model_bytes,
            dry.kernel().sizes.model_bytes + 64 + kMaxMaterials * 3 * sizeof(double));
}

// A force on the plunger that is no number, or too large: flagged, counted, kept or clamped.
TEST(Flow, AWrongPlungerForceIsCounted) {
  Rig rig = make_rig(layers(1000, 1e-8F, 0), needle_with(Hub::kSyringe));
  Input input = along_x({10e-3F, 19e-3F, 21e-3F}, rig.length_m);
  const auto flags_with = [&](float plunger_n) {
    input.plunger_n = plunger_n;
    return checked_tick(rig, input).flags;
  };
  EXPECT_EQ(flags_with(5), 0U);
  const float kept = rig.view().state.fluid->plunger_n;
  EXPECT_EQ(kept, 5);
  EXPECT_EQ(flags_with(std::numeric_limits<float>::quiet_NaN()), kFlagInputNotFinite);
  EXPECT_EQ(flags_with(-std::numeric_limits<float>::infinity()), kFlagInputNotFinite);
  EXPECT_EQ(rig.view().state.fluid->plunger_n, kept);
  EXPECT_EQ(flags_with(1e9F), kFlagInputClamped);
  EXPECT_EQ(rig.view().state.fluid->plunger_n, kMaxPlungerN);
  EXPECT_EQ(flags_with(-1e9F), kFlagInputClamped);
  EXPECT_EQ(stats(rig.kernel()).input_not_finite, 2U);
  EXPECT_EQ(stats(rig.kernel()).input_clamped, 2U);
  // Without a syringe nobody reads it.
  Rig closed = make_rig(layers(1000, 1e-8F, 0), Config{});
  input.plunger_n = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(checked_tick(closed, input).flags, 0U);
}

}  // namespace
}  // namespace stylet::test
