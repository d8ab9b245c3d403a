// SPDX-License-Identifier: Apache-2.0
// Judges the force that a hand feels, in virtual time and from outside, by rules that know nothing
// of the code.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "motor_draw.h"
#include "virtual_process.h"

namespace stylet::hal {

constexpr double kZeroMs = 25;    // from any fault to zero force: GUARD.md, R6
constexpr double kSlackMs = 1.1;  // a writer with a period of 1 ms may notice one later

inline double ms(std::int64_t ns) {
  return static_cast<double>(ns) * 1e-6;
}

// Sees the force from outside, whenever a thread begins to wait.
struct Judge {
  std::function<Vec3()> felt;
  std::function<int()> writes;
  double most_n = 0, slew_n_per_s = 0;
  double lag_ms = 2;           // from the guard to the hand
  double way_ms = 0;           // two writes may arrive closer together by this
  double held_ms = 0;          // delay of an order by a service that stands still
  bool drops = false;          // a service drops the force when its client leaves
  bool orders_expire = false;  // after 10 ms
  bool writes_hang = false;    // what a hanging call was about to write may come late
  bool supervised = true;      // a supervisor cuts the force if its writer is held up
  std::function<std::int64_t()> now_ns = test::virtual_now_ns;

  std::int64_t loop_ns = 0;     // of the newest order
  std::int64_t fault_ns = 0;    // 0: none
  std::int64_t trouble_ns = 0;  // of the device: until then it may cut the force
  bool over = false;            // no force until somebody acknowledges
  bool armed_anew = false;      // armed again, but no order has come yet
  bool expired = false;         // orders have expired: no force may grow before an acknowledgement
  Vec3 last_n = {};
  int last_writes = 0;
  std::int64_t written_ns = 0, before_ns = 0;  // of the last write, and of the one before
  double strongest_n = 0;
  int returns = 0;  // how often a force came back after an acknowledgement
  std::string broken;

  void fail(const std::string& why) {
    if (!broken.empty()) return;
    broken = why + " (" + std::to_string(size(last_n)) + " N, loop " +
             std::to_string(ms(now_ns() - loop_ns)) + " ms ago, fault " +
             std::to_string(fault_ns == 0 ? -1 : ms(now_ns() - fault_ns)) + ", written " +
             std::to_string(ms(now_ns() - written_ns)) + ")";
  }

  // Forces may come again with the next order.
  void acknowledged() {
    fault_ns = 0;
    armed_anew = true;
  }
  void ordered(std::int64_t tick_ns) {
    loop_ns = tick_ns;
    if (armed_anew) over = expired = armed_anew = false;
  }
  void fault() {
    if (fault_ns == 0) fault_ns = now_ns();
  }

  void look() {
    const Vec3 force = felt();
    const std::int64_t now = now_ns();
    const bool wrote = writes() != last_writes;
    const double size_n = size(force), passed_ms = written_ns == 0 ? 0 : ms(now - written_ns);
    const double change = size({force.x - last_n.x, force.y - last_n.y, force.z - last_n.z});
    strongest_n = std::max(strongest_n, size_n);
    if (!std::isfinite(size_n)) fail("not finite");
    if (size_n > most_n * (1 + 1e-4)) fail("over the limit: " + std::to_string(size_n) + " N");
    // The vendor's own cut: its device is in trouble, or its writer was held up.
    const bool dropped = drops && !wrote && size_n == 0 && change > 0;
    const bool cut = dropped || (size_n == 0 && (now < trouble_ns || passed_ms > 9.9));
    const double most = slew_n_per_s * 1e-3 * (passed_ms + way_ms) * (1 + 1e-4) + 1e-5;
    if (change > 1e-6 && !cut && !(wrote && (written_ns == 0 || change <= most))) {
      fail("a step of " + std::to_string(change) + " N");
    }
    if (dropped) over = true;
    judge_end(size_n, now);
    const double age_ms = std::max(ms(now - loop_ns), passed_ms);
    const bool late =
        orders_expire && wrote && loop_ns != 0 && age_ms > 10 + (writes_hang ? kSlackMs : 0);
    if (late && !writes_hang) expired = true;
    if (expired && size_n > size(last_n) * (1 + 1e-5) + 1e-6) fail("force after orders expired");
    if (late) expired = true;
    if (wrote || change > 0) {
      before_ns = written_ns;
      written_ns = now;
      last_writes = writes();
    }
    last_n = force;
  }

  // The force is zero in time, and then stays so until somebody has acknowledged.
  void judge_end(double size_n, std::int64_t now) {
    const std::int64_t stopped_ns = loop_ns + static_cast<std::int64_t>(kZeroMs * 1e6);
    std::int64_t end_ns = std::numeric_limits<std::int64_t>::max();
    if (loop_ns != 0) end_ns = stopped_ns;
    if (fault_ns != 0)
      end_ns = std::min(end_ns, fault_ns + static_cast<std::int64_t>(kZeroMs * 1e6));
    const double late_ms = ms(now - end_ns);
    const auto held_since = [&](std::int64_t since_ns, std::int64_t until_ns) {
      return since_ns < end_ns && (!supervised || ms(until_ns - since_ns) < kZeroMs + kSlackMs);
    };
    const bool landed = writes_hang && ms(now - written_ns) <= kSlackMs;
    const bool held = held_since(written_ns, now) || (landed && held_since(before_ns, written_ns));
    if (late_ms > kSlackMs + held_ms && !held) {
      if (size_n > 0) fail("force 25 ms after a fault");
      over = true;
    }
    if (over && size_n > 0 && !held) fail("force before somebody acknowledged");
    const bool under_way = writes_hang && written_ns < fault_ns;
    const bool falls = fault_ns != 0 && ms(now - fault_ns) > lag_ms && !under_way;
    if (falls && !over && size_n > size(last_n) * (1 + 1e-5) + 1e-6) {
      fail("force grows after a fault");
    }
  }
};

}  // namespace stylet::hal
