// SPDX-License-Identifier: Apache-2.0
// Shows a recording at any tick and any speed, also backwards: a kernel of its own repeats the
// recorded inputs. Snapshots of it are taken on the way and, while nothing is asked for, ahead, so
// that no tick is farther than one stretch of ticks from a snapshot.
//
// Backwards each picture is a way of its own from a snapshot. Where that takes longer than
// `longest_way_s`, the snapshots themselves are shown, as key frames.
//
// Forces and needle poses are the recorded ones, to the bit; the tissue is what this program
// computes from the same inputs, and where that is not what was recorded, it is said so. Memory of
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
  // `organ` is the recording's. Recording, organ and display must outlive it; nobody else may read
  // the recording meanwhile.
  Player(const hal::RecordingReader& recording, const Organ& organ,
         std::shared_ptr<hal::Display> display, double longest_way_s = kLongestWayS);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  // From any thread.
  void seek(std::uint64_t tick);
  void play(float speed);  // 0 holds, 1 as recorded, negative backwards
  // The first tick whose recorded outputs this program does not give; 0: none so far.
  std::uint64_t differs_at() const { return differs_at_.load(std::memory_order_relaxed); }

  const Kernel& kernel() const { return shown_.kernel; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Wish {
    double tick = 1;
    double speed = 0;
    std::uint64_t number = 0;  // of the wish
  };

  void work();
  bool next_wish(std::uint64_t& goal_out, std::uint64_t& wish_out);
  std::uint64_t moved(double elapsed_s);
  std::uint64_t key_before(std::uint64_t tick) const;
  bool overtaken(std::uint64_t number);
  // The kernel after `goal` ticks; false: another wish came first.
  bool bring_to(std::uint64_t goal, std::uint64_t wish);
  void show(std::uint64_t tick);
  void scout();
  void step(Kernel& kernel, std::uint64_t& at_tick);
  const hal::TickRecord& record(std::uint64_t tick, std::uint32_t needle);

  const hal::RecordingReader& recording_;
  std::shared_ptr<hal::Display> display_;
  const double longest_way_s_;
  double step_s_ = 0;  // what a tick took lately
  hal::KernelInstance shown_, scout_;
  std::uint64_t shown_tick_ = 0, scout_tick_ = 0;
  std::uint64_t stretch_;                          // ticks between snapshots
  std::vector<std::vector<std::byte>> snapshots_;  // after 0, stretch, 2 stretch ... ticks
  std::uint64_t block_first_ = 0;                  // rows in memory
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
