// SPDX-License-Identifier: Apache-2.0
// A recorded insertion as bytes: configuration, bodies and the input of every tick. What the replay
// matrix plays on every target.
//
// Layout: CaseHead, Config, obstacle_count ObstacleConfig, tick_count Input; all plain numbers of
// four bytes, little-endian, so the bytes are the structs on every target.
#pragma once

#include <cstddef>
#include <cstdint>

#include "stylet/kernel.h"

namespace stylet::test {

struct CaseHead {
  std::uint32_t config_bytes, obstacle_bytes, input_bytes;  // sizes of the structs, to be sure
  std::uint32_t obstacle_count, tick_count;
};

struct Case {
  const Config* config;
  std::span<const ObstacleConfig> obstacles;
  std::span<const Input> inputs;
};

// False: bytes of another layout. They must be aligned to four and outlive the case.
inline bool open_case(std::span<const std::byte> bytes, Case& case_out) {
  const auto& head = *reinterpret_cast<const CaseHead*>(bytes.data());
  if (bytes.size() < sizeof head || head.config_bytes != sizeof(Config) ||
      head.obstacle_bytes != sizeof(ObstacleConfig) || head.input_bytes != sizeof(Input)) {
    return false;
  }
  const std::byte* at = bytes.data() + sizeof head;
  case_out.config = reinterpret_cast<const Config*>(at);
  at += sizeof(Config);
  case_out.obstacles = {reinterpret_cast<const ObstacleConfig*>(at), head.obstacle_count};
  at += sizeof(ObstacleConfig) * head.obstacle_count;
  case_out.inputs = {reinterpret_cast<const Input*>(at), head.tick_count};
  return at + sizeof(Input) * head.tick_count == bytes.data() + bytes.size();
}

}  // namespace stylet::test
