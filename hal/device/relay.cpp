// SPDX-License-Identifier: Apache-2.0
#include "hal/device/relay.h"

namespace stylet::hal {

void Relay::publish(const Pose& pose, std::uint32_t buttons, std::int64_t t_ns) {
  samples_.publish({++seq_, t_ns, pose, buttons});
  measured_.store(true, std::memory_order_release);
}

MotorReport Relay::order(std::int64_t now_ns) {
  const bool first = order_.t_ns == 0;
  (void)orders_.take(order_);
  if (first) first_ = order_.arming;
  const Vec3 f = order_.force_n, t = order_.torque_nm;
  const bool nothing = f.x == 0 && f.y == 0 && f.z == 0 && t.x == 0 && t.y == 0 && t.z == 0;
  if (!nothing || order_.arming != first_) used_.store(true, std::memory_order_relaxed);
  const bool ending = ending_.load(std::memory_order_relaxed) || resting_.load();
  const MotorCut cut = failed() ? MotorCut::kNow : ending ? MotorCut::kFade : MotorCut::kNone;
  motor_step(limits, motor_, order_, cut, now_ns);
  motor_.report.failed = failed();
  reports_.publish(motor_.report);
  return motor_.report;
}

void Relay::written(std::int64_t now_ns) {
  motor_written(motor_, now_ns);
}

void Relay::end() {
  ending_.store(true, std::memory_order_relaxed);
}

void Relay::rest(bool on) {
  resting_.store(on);
}

void Relay::fail(std::uint32_t why) {
  std::uint32_t none = 0;
  (void)why_.compare_exchange_strong(none, why);
  failed_.store(true, std::memory_order_release);
}

bool Relay::read(std::int64_t now_ns, Sample& sample_out) {
  tick_ns_ = now_ns;
  if (samples_.take(newest_)) new_ns_ = now_ns;
  if (failed() || newest_.seq == 0 || now_ns - new_ns_ > kQuietNs) return false;
  sample_out = newest_;
  return true;
}

void Relay::write(const Command& command) {
  orders_.publish({command.force_n, command.torque_nm, tick_ns_, command.arming, command.falls,
                   command.end_ns});
}

bool Relay::motor(MotorReport& report_out) {
  (void)reports_.take(report_);
  report_out = report_;  // empty until the first report
  return true;
}

}  // namespace stylet::hal
