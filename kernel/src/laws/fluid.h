// SPDX-License-Identifier: Apache-2.0
// Fluid in a needle: the flow through its bore, between a syringe or the open hub and the tissue at
// the needle's opening.
//
// The bore is a tube with Poiseuille's resistance, in series with the resistance of the tissue.
// From the opening on, a part of it is filled with the tissue's fluid, the rest with what was there
// before; the two have their own viscosities. The syringe is a plunger without mass, with Coulomb
// friction, on a liquid with a bubble of gas (Boyle's law), which stands for all elasticity. The
// pressure after a step is the root of a quadratic equation: implicit, so stable for every step.
//
// Flow, volumes and displacements are positive towards the tissue; pressures are above that of the
// air. Promises: only + - * / and square root, no loop; finite for every accepted configuration.
// Units SI. PHYSICS 9.9.
#pragma once

#include <cmath>

#include "base/vec3d.h"
#include "stylet/kernel.h"
#include "stylet/material.h"

namespace stylet {

constexpr double kAirPa = 101'325;  // standard atmosphere
constexpr double kThinnestPaS = static_cast<double>(kMinViscosityPaS);
constexpr double kLeastHubPa = -0.99 * kAirPa;  // gas cannot be thinned to nothing

// A needle's bore and syringe.
struct Bore {
  double per_viscosity;  // resistance over viscosity, 1/m^3
  double bore_m3, filling_pa_s;
  double plunger_m2;  // 0: no syringe, the hub is open
  double friction_n;
  double gas_m3;               // of the bubble, at the pressure of the air
  double content_m3, room_m3;  // how much the plunger may push out, and draw in
};

// The tissue at the opening. A conductance below 0: the opening is in the air, without resistance.
struct Opening {
  double pressure_pa, conductance_m3_per_pa_s, viscosity_pa_s;
};

// What one step leaves to the next.
struct FluidState {
  double hub_pa;
  double injected_m3;      // that left the opening since the start
  double swept_m3;         // by the plunger
  double flow_m3_per_s;    // mean of the last step
  double filled;           // part of the bore, from the opening on, with fluid that came in
  double entered_pa_s;     // viscosity of that fluid
  float plunger_n;         // the force on the plunger that was accepted last
  std::uint16_t resisted;  // 1: the tissue was what held the pressed plunger
  std::uint16_t shown;     // 1: what came in has reached the hub
};
static_assert(sizeof(FluidState) == 7 * 8);  // without padding

constexpr Opening kOpenAir = {0, -1, 0};

inline Bore bore_of(const NeedleConfig& n) {
  constexpr double kPi = 3.14159265358979324;
  const double radius = static_cast<double>(n.bore_radius_m);
  const double plunger = static_cast<double>(n.plunger_radius_m);
  const double length = static_cast<double>(n.length_m), area = kPi * radius * radius;
  const double barrel = static_cast<double>(n.syringe_m3);
  Bore out = {};
  if (n.hub == Hub::kClosed) return out;
  out.per_viscosity = 8 * kPi * length / (area * area);
  out.bore_m3 = area * length;
  out.filling_pa_s = static_cast<double>(n.filling_pa_s);
  out.plunger_m2 = n.hub == Hub::kSyringe ? kPi * plunger * plunger : 0;
  out.friction_n = static_cast<double>(n.plunger_friction_n);
  out.gas_m3 = static_cast<double>(n.syringe_gas_m3);
  out.content_m3 = barrel * static_cast<double>(n.syringe_filled);
  out.room_m3 = barrel - out.content_m3;
  return out;
}

inline Opening opening_of(const Material& m, double filling_pa_s) {
  const double own = m.fluid_viscosity_pa_s > 0
                         ? max_of(static_cast<double>(m.fluid_viscosity_pa_s), kThinnestPaS)
                         : filling_pa_s;
  return {static_cast<double>(m.fluid_pressure_pa),
          static_cast<double>(m.fluid_conductance_m3_per_pa_s), own};
}

inline double bore_resistance(const Bore& bore, const FluidState& s) {
  const double viscosity = bore.filling_pa_s + s.filled * (s.entered_pa_s - bore.filling_pa_s);
  return bore.per_viscosity * viscosity;
}

// Of bore and tissue in series.
inline double conductance(double bore_resistance, const Opening& opening) {
  const double g = opening.conductance_m3_per_pa_s;
  return g < 0 ? 1 / bore_resistance : g / (1 + bore_resistance * g);
}

inline double gas_volume(const Bore& bore, double hub_pa) {
  return bore.gas_m3 * kAirPa / (kAirPa + hub_pa);
}

// Pressure of the gas after a step in which it gets `passed` (volume per pressure) times what it
// has more than `opening_pa`, and would else have the volume `volume_m3`. With x the absolute
// pressure: passed x^2 + b x = gas p_air.
inline double hub_after(const Bore& bore, double volume_m3, double passed, double opening_pa) {
  const double b = volume_m3 - passed * (kAirPa + opening_pa);
  const double amount = bore.gas_m3 * kAirPa;
  const double root = std::sqrt(b * b + 4 * passed * amount);
  return (b > 0 ? 2 * amount / (b + root) : (root - b) / (2 * passed)) - kAirPa;
}

// One step of the syringe: hub pressure and the plunger's way. The plunger stays where it is while
// its friction bears the difference of its force and the pressure.
inline void step_syringe(const Bore& bore, double passed, double opening_pa, FluidState& s) {
  const double held_m3 = gas_volume(bore, s.hub_pa);
  const double force = static_cast<double>(s.plunger_n);
  const double low = max_of((force - bore.friction_n) / bore.plunger_m2, kLeastHubPa);
  const double high = max_of((force + bore.friction_n) / bore.plunger_m2, low);
  const double still = hub_after(bore, held_m3, passed, opening_pa);
  double hub = min_of(max_of(still, low), high);
  const double wanted = held_m3 - gas_volume(bore, hub) + passed * (hub - opening_pa);
  const double swept = hub == still ? 0.0
                                    : min_of(max_of(wanted, -bore.room_m3 - s.swept_m3),
                                             bore.content_m3 - s.swept_m3);
  if (swept != wanted) hub = hub_after(bore, held_m3 - swept, passed, opening_pa);
  s.hub_pa = max_of(hub, kLeastHubPa);
  s.swept_m3 += swept;
}

inline bool is_open_air(const Opening& opening) {
  return opening.conductance_m3_per_pa_s < 0;
}

// The tissue's fluid fills the bore from the opening on, and mixes with what came in before. Air
// that is drawn in counts as what the needle was filled with.
inline void move_front(const Bore& bore, const Opening& opening, double out_m3, FluidState& s) {
  const double before = s.filled, passed = std::fabs(out_m3) / bore.bore_m3;
  const bool comes_in = out_m3 < 0 && !is_open_air(opening);
  s.filled = comes_in ? min_of(before + passed, 1.0) : max_of(before - passed, 0.0);
  if (!(s.filled > 0)) s.entered_pa_s = bore.filling_pa_s;
  if (!comes_in) return;
  const double fresh = min_of(passed, 1.0);
  s.entered_pa_s += (opening.viscosity_pa_s - s.entered_pa_s) * (fresh / (before + fresh));
}

inline void step_fluid(const Bore& bore, const Opening& opening, double period_s, FluidState& s) {
  const double through = conductance(bore_resistance(bore, s), opening);
  if (bore.plunger_m2 > 0) {
    step_syringe(bore, through * period_s, opening.pressure_pa, s);
  }
  s.flow_m3_per_s = through * (s.hub_pa - opening.pressure_pa);
  const double out_m3 = s.flow_m3_per_s * period_s;
  s.injected_m3 += out_m3;
  move_front(bore, opening, out_m3, s);
}

// Whether the tissue resists a flow more than the bore does.
inline bool tissue_resists(const Bore& bore, const Opening& opening, const FluidState& s) {
  const double g = opening.conductance_m3_per_pa_s;
  return g >= 0 && g * bore_resistance(bore, s) < 1;
}

}  // namespace stylet
