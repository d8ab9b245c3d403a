// SPDX-License-Identifier: Apache-2.0
#include "hal/console/player.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>

#include "hal/base/contained.h"
#include "hal/console/limits.h"

namespace stylet::console {
namespace {

constexpr std::uint64_t kBlock = 1024;
// Ticks between two checks whether something else is wanted.
constexpr std::uint64_t kLookTicks = 20;

std::uint64_t stretch_for(std::uint64_t ticks, std::size_t bytes) {
  const std::uint64_t affordable = std::max<std::uint64_t>(kSnapshotBytes / bytes, 1);
  return std::max(kLeastSnapshotTicks, (ticks + affordable - 1) / affordable);
}

bool same_bits(const stylet::Vec3& a, const stylet::Vec3& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

std::shared_ptr<const Curve> read_curve(const hal::RecordingReader& recording) {
  const hal::RecordingInfo& info = recording.info();
  auto curve = std::make_shared<Curve>(0);
  std::vector<std::vector<hal::TickRecord>> blocks(info.config.needle_count);
  for (std::uint64_t first = 0; first < recording.ticks(); first += kBlock) {
    const std::uint64_t rows = std::min(kBlock, recording.ticks() - first);
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
      blocks[i].resize(rows);
      recording.read(first, blocks[i], i);
    }
    for (std::uint64_t row = 0; row < rows; ++row) {
      for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        curve->add({false, row_of(blocks[i][row], info.course[i]), {}});
      }
    }
  }
  std::vector<stylet::Event> events(recording.event_count());
  recording.read(0, events);
  for (const stylet::Event& each : events) curve->add({true, {}, happened(each)});
  return curve;
}

Player::Player(const hal::RecordingReader& recording, const Organ& organ,
               std::shared_ptr<hal::Display> display, double longest_way_s)
    : recording_(recording),
      display_(std::move(display)),
      longest_way_s_(longest_way_s),
      shown_(organ, recording.info().config, recording.info().obstacles),
      scout_(organ, recording.info().config, recording.info().obstacles),
      stretch_(stretch_for(recording.ticks(), snapshot_bytes(shown_.kernel))),
      block_(recording.info().config.needle_count),
      thread_(&Player::work, this) {}

Player::~Player() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    ++wish_.number;
  }
  wished_.notify_one();
  thread_.join();
}

void Player::seek(std::uint64_t tick) {
  const std::lock_guard lock(mutex_);
  wish_.tick = static_cast<double>(std::clamp<std::uint64_t>(tick, 1, recording_.ticks()));
  ++wish_.number;
  wished_.notify_one();
}

void Player::play(float speed) {
  const std::lock_guard lock(mutex_);
  wish_.speed = std::isfinite(speed) ? std::clamp(static_cast<double>(speed), -100.0, 100.0) : 0.0;
  ++wish_.number;
  wished_.notify_one();
}

bool Player::overtaken(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  return wish_.number != number;
}

// The tick that playing has reached; at either end it stands still.
std::uint64_t Player::moved(double elapsed_s) {
  const double period_s = static_cast<double>(recording_.info().config.period_s);
  const double wanted = wish_.tick + wish_.speed * elapsed_s / period_s;
  wish_.tick = std::clamp(wanted, 1.0, static_cast<double>(recording_.ticks()));
  if (wish_.tick != wanted) wish_.speed = 0;
  return static_cast<std::uint64_t>(std::llround(wish_.tick));
}

// The tick itself, or the snapshot before it if computing from there takes long.
std::uint64_t Player::key_before(std::uint64_t tick) const {
  const std::uint64_t way = tick % stretch_;
  const bool there = tick / stretch_ < snapshots_.size();
  const bool quick = step_s_ * static_cast<double>(way) <= longest_way_s_;
  return !there || quick ? tick : std::max<std::uint64_t>(tick - way, 1);
}

// What is wanted now; false: the player must end.
bool Player::next_wish(std::uint64_t& goal_out, std::uint64_t& wish_out) {
  std::unique_lock lock(mutex_);
  const bool scouting = scout_tick_ < recording_.ticks();
  if (!scouting || wish_.speed != 0) {
    const auto pause = wish_.speed != 0 ? kFramePause : std::chrono::milliseconds(1000);
    wished_.wait_for(lock, pause, [&] { return stop_ || wish_.number != wish_out; });
  }
  const auto now = Clock::now();
  const double elapsed_s = std::chrono::duration<double>(now - looked_).count();
  looked_ = now;
  goal_out = wish_.number == wish_out ? moved(elapsed_s) : moved(0);
  if (wish_.speed < 0) goal_out = key_before(goal_out);
  wish_out = wish_.number;
  return !stop_;
}

void Player::work() {
  hal::name_thread("stylet-player");
  std::uint64_t on_display = 0, goal = 0, wish = 0;
  looked_ = Clock::now();
  while (next_wish(goal, wish)) {
    // The recording may be cut short while it is played.
    const bool done = hal::contained("playback", [&] {
      if (goal == on_display) {
        scout();
      } else if (bring_to(goal, wish)) {
        show(goal);
        on_display = goal;
      }
    });
    if (!done) std::this_thread::sleep_for(kFramePause);
  }
}

const hal::TickRecord& Player::record(std::uint64_t tick, std::uint32_t needle) {
  const std::uint64_t first = (tick - 1) / kBlock * kBlock;
  if (block_[0].empty() || first != block_first_) {
    const std::uint64_t rows = std::min(kBlock, recording_.ticks() - first);
    for (std::uint32_t i = 0; i < block_.size(); ++i) {
      block_[i].resize(rows);
      recording_.read(first, block_[i], i);
    }
    block_first_ = first;
  }
  return block_[needle][tick - 1 - first];
}

void Player::step(Kernel& kernel, std::uint64_t& at_tick) {
  const std::uint64_t tick = at_tick + 1;
  std::array<Input, kMaxNeedles> inputs;
  std::array<Output, kMaxNeedles> outputs;
  for (std::uint32_t i = 0; i < block_.size(); ++i) inputs[i] = record(tick, i).input;
  stylet::tick(kernel, std::span(inputs).first(block_.size()),
               std::span(outputs).first(block_.size()));
  for (std::uint32_t i = 0; i < block_.size(); ++i) {
    const Output& recorded = record(tick, i).output;
    const bool same = same_bits(outputs[i].force_n, recorded.force_n) &&
                      same_bits(outputs[i].tip_m, recorded.tip_m);
    if (!same && differs_at() == 0) differs_at_.store(tick, std::memory_order_relaxed);
  }
  at_tick = tick;
}

bool Player::bring_to(std::uint64_t goal, std::uint64_t wish) {
  if (!snapshots_.empty()) {
    const std::uint64_t nearest = std::min<std::uint64_t>(goal / stretch_, snapshots_.size() - 1);
    const std::uint64_t from = nearest * stretch_;
    if (shown_tick_ > goal || shown_tick_ < from) {
      (void)restore(shown_.kernel, snapshots_[nearest]);
      shown_tick_ = from;
    }
  }
  if (shown_tick_ > goal) {
    reset(shown_.kernel);
    shown_tick_ = 0;
  }
  const std::uint64_t from = shown_tick_;
  const auto began = Clock::now();
  bool there = true;
  while (there && shown_tick_ < goal) {
    step(shown_.kernel, shown_tick_);
    there = shown_tick_ % kLookTicks != 0 || !overtaken(wish);
  }
  if (shown_tick_ > from) {
    const double passed_s = std::chrono::duration<double>(Clock::now() - began).count();
    step_s_ = passed_s / static_cast<double>(shown_tick_ - from);
  }
  return there;
}

void Player::show(std::uint64_t tick) {
  std::array<hal::TickRecord, kMaxNeedles> records;
  for (std::uint32_t i = 0; i < block_.size(); ++i) records[i] = record(tick, i);
  display_->publish(shown_.kernel, std::span(records).first(block_.size()), 0, 0);
}

// Takes further snapshots ahead, a few ticks at a time.
void Player::scout() {
  for (std::uint64_t i = 0; i < kLookTicks; ++i) {
    if (scout_tick_ % stretch_ == 0 && snapshots_.size() == scout_tick_ / stretch_) {
      snapshots_.emplace_back(snapshot_bytes(scout_.kernel));
      (void)snapshot(scout_.kernel, snapshots_.back());
    }
    if (scout_tick_ == recording_.ticks()) return;
    step(scout_.kernel, scout_tick_);
  }
}

}  // namespace stylet::console
