// SPDX-License-Identifier: Apache-2.0
// The example driver of example_driver.cpp, and its packets, for the stand-in in its test.
//
// Both have 40 bytes, little-endian, without gaps. Numbers grow with each packet, also from one
// start of a program to the next. Promise: plain data. Units: SI, ns.
// Frame: x right, y up, z toward the operator.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "hal/device/driver.h"

namespace stylet::hal {

// A driver that has a line in drivers.inc is declared in driver.h, and needs no such line.
extern const DriverDescriptor plumb_driver;

struct PlumbPacket {
  std::array<char, 4> kind = {};      // "PLMS", a sample to Stylet; "PLMF", a force to the device
  std::uint32_t buttons = 0;          // of a sample; bit i: button i is pressed
  std::uint64_t number = 0;           // of this packet
  std::int64_t time_or_answered = 0;  // when a sample was taken; which sample a force answers
  std::array<float, 3> vector_xyz = {};  // the position, m; the force, N
  std::uint32_t sum = 0;                 // plumb_sum of the bytes before
};
static_assert(sizeof(PlumbPacket) == 40 && std::endian::native == std::endian::little);

constexpr std::array<char, 4> kPlumbSample = {'P', 'L', 'M', 'S'};
constexpr std::array<char, 4> kPlumbForce = {'P', 'L', 'M', 'F'};
// After its sample, a force ends in the device.
constexpr std::int64_t kPlumbLifeNs = 20'000'000;

using PlumbBytes = std::array<std::byte, sizeof(PlumbPacket)>;

// FNV-1a of all bytes but the last four.
inline std::uint32_t plumb_sum(std::span<const std::byte> bytes) {
  std::uint32_t sum = 2166136261U;
  for (const std::byte each : bytes.first(bytes.size() - sizeof sum)) {
    sum = (sum ^ std::to_integer<std::uint32_t>(each)) * 16777619U;
  }
  return sum;
}

inline PlumbBytes plumb_encode(PlumbPacket packet) {
  PlumbBytes bytes;
  std::memcpy(bytes.data(), &packet, sizeof packet);
  packet.sum = plumb_sum(bytes);
  std::memcpy(bytes.data(), &packet, sizeof packet);
  return bytes;
}

// False: another length or kind, or a wrong checksum.
inline bool plumb_decode(std::span<const std::byte> bytes, const std::array<char, 4>& kind,
                         PlumbPacket& out) {
  if (bytes.size() != sizeof out) return false;
  std::memcpy(&out, bytes.data(), sizeof out);
  return out.kind == kind && out.sum == plumb_sum(bytes);
}

}  // namespace stylet::hal
