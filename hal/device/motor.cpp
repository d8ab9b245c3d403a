// SPDX-License-Identifier: Apache-2.0
#include "hal/device/motor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hal/base/vector.h"
#include "hal/base/wide.h"

namespace stylet::hal {
namespace {

Vec3 approached(Vec3 from, Vec3 to, double most) {
  const Vec3 way = to - from;
  const double size = wide_length(way);
  return size > most ? from + scaled(way, most / size) : to;
}

// Shorter by this much: what is small already is gone sooner, so that one fade after another takes
// no longer than one.
Vec3 faded(Vec3 v, double by) {
  const double size = wide_length(v);
  return size > by ? scaled(v, 1 - by / size) : Vec3{};
}

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-9;
}

// A limit that is NaN, infinite or not positive is replaced by `otherwise`, the smallest.
double limit(float value, float otherwise) {
  return static_cast<double>(value > 0 && std::isfinite(value) ? value : otherwise);
}

// Starts from no more than a falling order: it came late, and its own fade has begun long ago.
void begin_fade(MotorState& state, const MotorOrder& order, std::int64_t since_ns) {
  if (state.fading) return;
  state.fading = true;
  state.fade_ns = since_ns;
  const MotorReport& report = state.report;
  state.fade_force_n =
      order.falls ? shortened(report.force_n, wide_length(order.force_n)) : report.force_n;
  state.fade_torque_nm =
      order.falls ? shortened(report.torque_nm, wide_length(order.torque_nm)) : report.torque_nm;
}

void take_order(MotorState& state, const MotorOrder& order, std::int64_t now_ns) {
  if (order.t_ns == state.given_ns) return;
  const bool first = state.given_ns == 0;
  state.given_ns = order.t_ns;
  state.order_ns = std::min(order.t_ns, now_ns);
  if (!first && !is_newer_arming(order.arming, state.report.arming)) return;
  state.report.stopped = false;
  state.report.arming = order.arming;
}

// Decides whether the motors follow the order or fade out.
void judge(MotorState& state, const MotorOrder& order, MotorCut cut, std::int64_t now_ns) {
  take_order(state, order, now_ns);
  MotorReport& report = state.report;
  const bool given = state.given_ns != 0;
  const std::int64_t age_ns = now_ns - state.order_ns;
  const bool good = finite(order.force_n) && finite(order.torque_nm) && cut == MotorCut::kNone &&
                    order.arming == report.arming;
  if (given && (!good || age_ns > kOrderLifeNs)) report.stopped = true;
  if (given && !report.stopped && age_ns <= kOrderFreshNs) {
    state.fading = false;
  } else {
    begin_fade(state, order, good ? std::min(now_ns, state.order_ns + kOrderFreshNs) : now_ns);
  }
}

// What is to be reached in the end: the order, or what a fade has left of `from`.
Vec3 goal(const MotorState& state, const MotorOrder& order, Vec3 ordered, Vec3 from, Vec3 now,
          double most) {
  if (state.fading) {
    const double gone = seconds(state.t_ns - state.fade_ns) / seconds(kMotorFadeNs);
    const Vec3 left = faded(from, std::max(gone, 0.0) * most);
    return order.falls ? shortened(left, wide_length(ordered))
                       : left;  // it came late and still holds
  }
  return shortened(ordered, order.falls ? std::min(most, wide_length(now)) : most);
}

// Time until no force may be left: a microsecond early, so that rounding leaves nothing.
double left_s(const MotorOrder& order, std::int64_t now_ns) {
  constexpr std::int64_t kEarlyNs = 1000;
  if (order.end_ns == 0) return std::numeric_limits<double>::infinity();
  return std::max(seconds(order.end_ns - kEarlyNs - now_ns), 0.0);
}

// Moves the force, or the torque, one step further. If the order has an end, never leaves more than
// the slew limit can remove in time; what is more is shortened, and turns no further.
Vec3 stepped(const MotorState& state, const MotorOrder& order, Vec3 now, Vec3 ordered, Vec3 from,
             double most, double slew, std::int64_t passed_ns) {
  const double endable = slew * left_s(order, state.t_ns);
  const bool ends = wide_length(now) > endable;
  const Vec3 to = shortened(ends ? now : goal(state, order, ordered, from, now, most), endable);
  // Falls by all the time that has passed, but rises no faster than step by step.
  const bool falls = ends || state.fading || order.falls;
  const double step_s = seconds(falls ? passed_ns : std::min(passed_ns, kMotorStepNs));
  return approached(now, to, slew * step_s);
}

}  // namespace

void motor_step(const MotorLimits& limits, MotorState& state, const MotorOrder& order, MotorCut cut,
                std::int64_t now_ns) {
  const auto passed_since = [&](std::int64_t t_ns) {
    return state.t_ns == 0 ? 0 : std::max<std::int64_t>(now_ns - t_ns, 0);
  };
  const std::int64_t passed_ns = passed_since(state.had_ns);
  // The writing thread was held up: the device may have cut the force by itself.
  if (passed_since(state.t_ns) > kOrderLifeNs) cut = MotorCut::kNow;
  state.t_ns = state.had_ns = now_ns;
  judge(state, order, cut, now_ns);
  MotorReport& report = state.report;
  if (cut == MotorCut::kNow) {
    report.force_n = report.torque_nm = state.fade_force_n = state.fade_torque_nm = {};
  }
  const double most_n = limit(limits.max_force_n, 0), most_nm = limit(limits.max_torque_nm, 0);
  const double slew = limit(limits.max_slew_n_per_s, kUnknownSlewNPerS);
  report.force_n = stepped(state, order, report.force_n, order.force_n, state.fade_force_n, most_n,
                           slew, passed_ns);
  report.torque_nm = stepped(state, order, report.torque_nm, order.torque_nm, state.fade_torque_nm,
                             most_nm, 2 * most_nm / seconds(kMotorFadeNs), passed_ns);
}

void motor_written(MotorState& state, std::int64_t now_ns) {
  std::rotate(state.call_ns.begin(), state.call_ns.begin() + 1, state.call_ns.end());
  state.call_ns.back() = std::max<std::int64_t>(now_ns - state.t_ns, 0);
  state.had_ns = now_ns - *std::min_element(state.call_ns.begin(), state.call_ns.end());
}

}  // namespace stylet::hal
