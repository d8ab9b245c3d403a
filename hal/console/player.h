// SPDX-License-Identifier: Apache-2.0
// Shows a recording at any tick and any speed, also backwards: a kernel of its own repeats the
// recorded inputs. Snapshots of it are taken on the way, and of later ticks while nothing is asked
// for, so that no tick is farther from a snapshot than two snapshots are from each other.
//
// Backwards each picture is computed anew from a snapshot. If that takes longer than
// `longest_way_s`, only the snapshots are shown, as key frames.
//
// Forces and needle poses are exactly the recorded ones; the tissue is what this program computes
// from the same inputs, and if that differs from what was recorded the user is told. Memory for
// the snapshots: kSnapshotBytes. One thread, ordinary priority. Units: SI.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "hal/console/limits.h"
#include "hal/console/rows.h"
#include "hal/loop/display.h"
#include "hal/loop/instance.h"
#include "hal/record/recording.h"

namespace stylet::console {

// All rows and events of a recording.
std::shared_ptr<const Curve> read_curve(const hal::RecordingReader& recording);

class Player {
 public:
  // `organ` is the recording's. Recording, organ and display must outlive the player; nobody else
  // may read the recording meanwhile.
  Player(const hal::RecordingReader& recording, const Organ& organ,
         std::shared_ptr<hal::Display> display, double longest_way_s = kLongestWayS);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  // These may be called from any thread.
  void seek(std::uint64_t tick);
  void play(float speed);  // 0 stops, 1 is the recorded speed, negative is backwards
  // The first tick whose recorded outputs this program does not reproduce; 0: none so far.
  std::uint64_t differs_at() const { return differs_at_.load(std::memory_order_relaxed); }

  const Kernel& kernel() const { return shown_.kernel; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Wish {
    double tick = 1;
    double speed = 0;
    std::uint64_t number = 0;  // grows with each
  };

  void work();
  bool next_wish(std::uint64_t& goal_out, std::uint64_t& wish_out);
  std::uint64_t moved(double elapsed_s);
  std::uint64_t key_before(std::uint64_t tick) const;
  bool overtaken(std::uint64_t number);
  // Brings the kernel to the state after `goal` ticks; false: another wish came first.
  bool bring_to(std::uint64_t goal, std::uint64_t wish);
  void show(std::uint64_t tick);
  void scout();
  void step(Kernel& kernel, std::uint64_t& at_tick);
  const hal::TickRecord& record(std::uint64_t tick, std::uint32_t needle);

  const hal::RecordingReader& recording_;
  std::shared_ptr<hal::Display> display_;
  const double longest_way_s_;
  double step_s_ = 0;  // what a tick took recently
  hal::KernelInstance shown_, scout_;
  std::uint64_t shown_tick_ = 0, scout_tick_ = 0;
  std::uint64_t stretch_;                          // ticks between snapshots
  std::vector<std::vector<std::byte>> snapshots_;  // after 0, stretch, 2 stretch ... ticks
  std::uint64_t block_first_ = 0;                  // of the rows in memory
  std::vector<std::vector<hal::TickRecord>> block_;

  std::mutex mutex_;
  std::condition_variable wished_;
  Wish wish_;
  bool stop_ = false;
  Clock::time_point looked_ = {};
  std::atomic<std::uint64_t> differs_at_{0};
  std::thread thread_;
};

}  // namespace stylet::console
