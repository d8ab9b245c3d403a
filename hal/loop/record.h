// SPDX-License-Identifier: Apache-2.0
// What is kept of one tick of one needle, and the one list of its columns, which recorder, replay
// and README all use. Then the same for what a kernel was made with.
// Promise: plain data; a new column is written, read and compared without more code.
// Units: SI. Frames: input and output in the world, device in the device's frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/device/device.h"
#include "hal/guard/guard.h"
#include "stylet/kernel.h"

namespace stylet::hal {

struct TickRecord {
  Input input;
  Output output;
  Sample sample;               // as the device gave it; if it did not answer, the last one
  std::uint32_t answered;      // 1: the device gave a sample
  Vec3 command_n;              // after the guard
  Fault fault;                 // latched by the guard
  std::uint32_t fault_number;  // counts the faults it has latched (fault_mailbox.h); 0: no fault
  GuardMode mode;              // of the guard
  float energy_j;              // of its observer of energy
  std::uint32_t tick_ns;       // from reading the device to writing the force
  std::uint32_t late_ns;       // from grid point to wake-up
  std::uint64_t state_hash;    // 0: not computed in this tick
  std::uint32_t needle;        // also says which table of the recording it belongs to
};

// All needles in one tick, for those who only want the newest tick.
struct NewestTick {
  std::uint32_t needles = 0;
  std::array<TickRecord, kMaxNeedles> record = {};
};

// Where a needle enters.
struct Course {
  Vec3 entry_m;    // first contact of the tip with the organ at rest
  Vec3 direction;  // of insertion, unit length
};

struct NeedleRecord {
  NeedleConfig config;
  Course course;
};

enum class ColumnType : std::uint32_t { kFloat32, kUint32, kUint64, kInt64 };
std::size_t column_bytes(ColumnType type);

struct Column {
  const char* name;  // path in the file
  ColumnType type;
  std::uint32_t width;  // numbers in a row
  std::size_t offset;   // in the struct
};

std::span<const Column> tick_columns();
std::span<const Column> event_columns();
std::span<const Column> needle_columns();    // of NeedleRecord
std::span<const Column> obstacle_columns();  // of ObstacleConfig

}  // namespace stylet::hal
