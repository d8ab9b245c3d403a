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

#include "hal/app/terminal.h"
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

// Why the samples were not used, and for how long; empty: the fault is not theirs.
inline std::string words_of(const hal::FaultCause& cause) {
  if (cause.why == hal::Refusal::kNone) return "";
  return fmt::format(" ({}: {:.1f} ms, allowed {:.1f} ms)", hal::refusal_name(cause.why),
                     cause.for_us * 1e-3, cause.allowed_us * 1e-3);
}

class FaultDesk {
 public:
  // One device for each box; both must outlive this. Notes that devices have now count as told.
  FaultDesk(std::span<hal::FaultMailbox> boxes, std::vector<std::string> names,
            std::span<const hal::Device> devices)
      : boxes_(boxes),
        names_(std::move(names)),
        devices_(devices),
        told_(names_.size()),
        clears_itself_(names_.size()),
        away_(names_.size()) {
    for (const hal::Device& each : devices_) noted_.push_back(hal::note_of(each));
  }

  void look() {
    const bool enter = enter_was_pressed();
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const hal::LatchedFault latched = boxes_[i].latched.load(std::memory_order_acquire);
      // Enter pressed before a fault was told does not count for it.
      const bool known = latched == told_[i];
      if (!known) tell(i, latched.fault, boxes_[i].cause.load(std::memory_order_relaxed));
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
    if (terminal_rewrites_lines()) rewrite_line("");
    fmt::print(stderr, "stylet: {}: {}\n", names_[i], what);
  }
  // Only what somebody did is called acknowledged.
  void tell(std::size_t i, hal::Fault latched, const hal::FaultCause& cause) {
    if (latched == hal::Fault::kNone) {
      say(i, clears_itself_[i] ? "a usable sample came before any force: forces fade in"
                               : "acknowledged: forces fade in");
      return;
    }
    clears_itself_[i] = cause.clears_itself;
    const char* const until = cause.clears_itself  ? "it gives a usable sample"
                              : reads_a_terminal() ? "it is acknowledged: Enter"
                                                   : "it is acknowledged";
    say(i,
        fmt::format("{}{}: no force until {}", hal::fault_name(latched), words_of(cause), until));
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
  std::vector<bool> clears_itself_;        // the fault that was last told of each device
  std::vector<std::string> away_, noted_;  // trouble and note that were last told of each device
  bool asked_ = false;
};

}  // namespace stylet::app
