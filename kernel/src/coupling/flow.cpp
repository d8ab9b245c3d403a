// SPDX-License-Identifier: Apache-2.0
#include "coupling/flow.h"

#include "base/math.h"
#include "coupling/spring.h"
#include "coupling/support.h"
#include "lattice/voxel.h"
#include "laws/fluid.h"
#include "state/events.h"

namespace stylet {
namespace {

// The layer in which the opening's middle lies, or kNoLayer. At the tip itself it is the layer that
// the tip has entered: one that still holds the tip up does not let fluid through.
std::uint32_t layer_of_opening(const Model& model, const State& state, const Needle& needle) {
  const NeedleState& own = *state.needle;
  const Particle& tip = *state.tip;
  const bool inside = own.phase == Phase::kInserted || own.phase == Phase::kRetracting;
  const float behind_m = model.needle_config().opening_m;
  if (!inside || tip.support_count == 0 || tip.track_m < behind_m) return kNoLayer;
  if (!(behind_m > 0)) return own.layer;
  const Support& support = tip.support[heaviest(tip)];
  const VoxelFrame frame = voxel_frame(model, state, support.slot, support.row);
  const Vec3 direction = transposed_times(frame.rotation, needle.tip_direction);
  const std::uint32_t material = material_at(model, tip.rest_m - behind_m * direction);
  return material == kNoTissue ? kNoLayer : material;
}

void tell_flow(const Bore& bore, const Opening& opening, State& state, std::uint32_t layer) {
  FluidState& s = *state.fluid;
  if (layer == kNoLayer) s.resisted = 0;
  if (!(s.filled > 0)) s.shown = 0;  // rinsed
  if (layer == kNoLayer) return;
  if (static_cast<double>(s.plunger_n) > bore.friction_n && bore.plunger_m2 > 0) {
    const bool resists = tissue_resists(bore, opening, s);
    if (!resists && s.resisted != 0) {
      add_event(state, EventKind::kLossOfResistance, s.plunger_n, layer);
    }
    s.resisted = resists ? 1 : 0;
  }
  if (s.filled < 1 || s.shown != 0) return;
  s.shown = 1;
  add_event(state, EventKind::kFlashback, s.plunger_n, layer);
}

float narrow(double value) {
  return static_cast<float>(value);
}

}  // namespace

std::uint32_t accept_plunger(const Model& model, State& state, const Input& input) {
  if (model.needle_config().hub != Hub::kSyringe || input.valid == 0) return 0;
  if (!is_finite(input.plunger_n)) {
    ++state.head->input_not_finite;
    return kFlagInputNotFinite;
  }
  state.fluid->plunger_n = clamp(input.plunger_n, -kMaxPlungerN, kMaxPlungerN);
  if (state.fluid->plunger_n == input.plunger_n) return 0;
  ++state.head->input_clamped;
  return kFlagInputClamped;
}

void move_fluid(const Model& model, State& state, const Needle& needle, Output& out) {
  if (model.needle_config().hub == Hub::kClosed) return;
  const Bore& bore = *model.bore;
  FluidState& s = *state.fluid;
  const double period_s = static_cast<double>(model.head->config.period_s);
  const std::uint32_t layer = layer_of_opening(model, state, needle);
  const Opening opening = layer == kNoLayer ? kOpenAir : model.opening[layer];
  const double resistance = bore_resistance(bore, s), before_m3 = s.swept_m3;
  step_fluid(bore, opening, period_s, s);
  tell_flow(bore, opening, state, layer);
  const double area_m2 = bore.plunger_m2 > 0 ? bore.plunger_m2 : 1;
  out.flow = {narrow(s.hub_pa - resistance * s.flow_m3_per_s),
              narrow(s.hub_pa),
              narrow(s.flow_m3_per_s),
              narrow(s.injected_m3),
              narrow(s.swept_m3 / area_m2),
              narrow((s.swept_m3 - before_m3) / (area_m2 * period_s)),
              narrow(s.filled)};
}

}  // namespace stylet
