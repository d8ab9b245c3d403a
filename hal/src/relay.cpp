// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/relay.h"

namespace stylet::hal {

void Relay::publish(const Pose& pose, std::uint32_t buttons, std::int64_t t_ns) {
  samples_.publish({++seq_, t_ns, pose, buttons});
  measured_.store(true, std::memory_order_release);
}

Relay::Order Relay::order(std::int64_t now_ns) {
  (void)orders_.take(given_);
  if (failed() || now_ns - given_.t_ns > kOrderLifeNs) return {};
  return given_.order;
}

void Relay::fail(std::uint32_t why) {
  std::uint32_t none = 0;
  (void)why_.compare_exchange_strong(none, why);
  failed_.store(true, std::memory_order_release);
}

bool Relay::read(std::int64_t now_ns, Sample& sample_out) {
  tick_ns_ = now_ns;
  (void)samples_.take(newest_);
  if (failed() || newest_.seq == 0 || now_ns - newest_.t_ns > kQuietNs) return false;
  sample_out = newest_;
  return true;
}

void Relay::write(const Command& command) {
  orders_.publish({{command.force_n, command.torque_nm}, tick_ns_});
}

}  // namespace stylet::hal
