// SPDX-License-Identifier: Apache-2.0
// Tells the user at the terminal of a fault when it is latched; Enter acknowledges it.
//
// Call look a few times a second, on any thread but the loop's. Without a terminal to read from it
// only tells. A program in the background does not read: reading would stop it, with a hand on the
// device.
#pragma once

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hal/device/device.h"
#include "hal/guard/fault_mailbox.h"

namespace stylet::app {

inline bool reads_a_terminal() {
  return isatty(STDIN_FILENO) != 0 && tcgetpgrp(STDIN_FILENO) == getpgrp();
}

inline bool enter_was_pressed() {
  pollfd keys = {STDIN_FILENO, POLLIN, 0};
  if (!reads_a_terminal() || ::poll(&keys, 1, 0) <= 0 || (keys.revents & POLLIN) == 0) return false;
  std::array<char, 256> typed;
  return read(STDIN_FILENO, typed.data(), typed.size()) > 0;
}

class FaultDesk {
 public:
  // One device for each box; both must outlive this. Notes that devices have now are not retold.
  FaultDesk(std::span<hal::FaultMailbox> boxes, std::vector<std::string> names,
            std::span<const hal::Device> devices)
      : boxes_(boxes),
        names_(std::move(names)),
        devices_(devices),
        told_(names_.size()),
        away_(names_.size()) {
    for (const hal::Device& each : devices_) noted_.push_back(hal::note_of(each));
  }

  void look() {
    const bool enter = enter_was_pressed();
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const hal::LatchedFault latched = boxes_[i].latched.load(std::memory_order_relaxed);
      // Enter pressed before a fault was told does not count for it.
      const bool known = latched == told_[i];
      if (!known) tell(i, latched.fault);
      told_[i] = latched;
      tell_of_device(i);
      if (!enter || !known || latched.number == 0) continue;
      boxes_[i].seen.store(latched, std::memory_order_relaxed);
      asked_ = true;
    }
    if (enter || !asked_) return;
    asked_ = false;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (told_[i].number != 0) say(i, "not acknowledged: it gives no usable sample yet");
    }
  }

 private:
  void say(std::size_t i, const std::string& what) const {
    fmt::print(stderr, "\r\033[Kstylet: {}: {}\n", names_[i], what);
  }
  void tell(std::size_t i, hal::Fault latched) const {
    // By Enter, by a button of the device, or because it ended before the first force.
    if (latched == hal::Fault::kNone) return say(i, "no fault any more: forces fade in");
    say(i, fmt::format("{}: no force until it is acknowledged{}", hal::fault_name(latched),
                       reads_a_terminal() ? ": Enter" : ""));
  }

  // Tells what is wrong with the device when that changes, and when the device is well again.
  void tell_of_device(std::size_t i) {
    std::string note = hal::note_of(devices_[i]);
    if (!note.empty() && note != noted_[i]) say(i, note);
    noted_[i] = std::move(note);
    std::string now = hal::trouble_of(devices_[i]);
    if (now == away_[i]) return;
    say(i, now.empty() ? "it is back" : now);
    away_[i] = std::move(now);
  }

  std::span<hal::FaultMailbox> boxes_;
  std::vector<std::string> names_;
  std::span<const hal::Device> devices_;
  std::vector<hal::LatchedFault> told_;
  std::vector<std::string> away_, noted_;  // what was last told of each device
  bool asked_ = false;
};

}  // namespace stylet::app
