// SPDX-License-Identifier: Apache-2.0
#include "coupling/return_map.h"

#include "coupling/spring.h"

namespace stylet {
namespace {

// Below this speed a CP sticks.
constexpr float kSlidingMPerS = 1e-4F;

float size_of(float way_m) {
  return way_m < 0 ? -way_m : way_m;
}

// The way a that renews the tissue after a slip s: the relaxed part b that lies along the slip
// comes back by a / (L + a), and the CP slips as much farther: a = s + b a / (L + a).
float renewing_way(float slip_m, float relaxed_m, float moved_m) {
  const float off = slip_m + relaxed_m - kRenewalLengthM;
  const float whole = 0.5F * (off + std::sqrt(off * off + 4 * kRenewalLengthM * slip_m));
  return min_of(whole, max_of(slip_m, moved_m));
}

}  // namespace

float overshoot(const Model& model, const Particle& p, float axial_n, float low_n, float high_n) {
  const ModelHead& head = *model.head;
  if (head.rules.unit_slips) {
    const float unit = model.needle_config().unit_m;
    const float beyond_m = axial_n / p.stiffness_n_per_m;
    constexpr auto kMost = static_cast<float>(kMaxUnitsPerTick);
    const float units = clamp(beyond_m / unit, -kMost, kMost);
    return is_finite(units) ? whole_part(units) * unit : 0;  // else a fault, at the tick's end
  }
  const float excess =
      axial_n > high_n ? axial_n - high_n : (axial_n < low_n ? axial_n - low_n : 0);
  return excess / p.stiffness_n_per_m;
}

float renew(const Model& model, Particle& p, Vec3 direction, float slip_m, float moved_m,
            double& booked_j) {
  const float slid = size_of(slip_m);
  if (!(slid > kSlidingMPerS * model.head->config.period_s)) return 0;
  const double before = memory_energy(p);
  const float along = dot(p.slack_m, direction);
  const float relaxed = p.relaxing_fraction * dot(p.memory_m, direction);
  const float way = renewing_way(slid, slip_m < 0 ? -relaxed : relaxed, size_of(moved_m));
  const float part = way / (kRenewalLengthM + way);
  p.memory_m = settle(p.memory_m - part * dot(p.memory_m, direction) * direction);
  p.memory_n = settle(p.memory_n - part * dot(p.memory_n, direction) * direction);
  p.memory_spread = (1 - part) * p.memory_spread;
  set_slack(p);
  const double after = memory_energy(p);
  // Energy would rise if what is forgotten was negative.
  if (after > before) p.memory_n = settle(static_cast<float>(before / after) * p.memory_n);
  booked_j += before - memory_energy(p);
  return along - dot(p.slack_m, direction);
}

void note_slip(const ModelHead& head, Particle& p, float slip_m) {
  const float speed = size_of(slip_m) / head.config.period_s;
  p.slip_m_per_s = settle(speed + head.velocity_keep * (p.slip_m_per_s - speed));
}

void note_no_slip(const ModelHead& head, Particle& p, float slip_m) {
  const float speed = size_of(slip_m) / head.config.period_s;
  p.slip_m_per_s = settle(max_of(p.slip_m_per_s - (1 - head.velocity_keep) * speed, 0));
}

}  // namespace stylet
