// SPDX-License-Identifier: Apache-2.0
// Organs as FlatBuffers' own objects, for tests that change one before they pack and open it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "organ_objects.h"  // before organ_generated.h, which it replaces
#include "session.h"

namespace stylet::test {

using Owner = format::OrganT;

inline std::vector<std::byte> bytes_of(const Owner& owner) {
  flatbuffers::FlatBufferBuilder builder;
  format::FinishOrganBuffer(builder, format::Organ::Pack(builder, &owner));
  const auto* bytes = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return {bytes, bytes + builder.GetSize()};
}

// What organ_open says about an organ, as "place[index]: expected"; nothing if it takes it.
inline std::string refusal_text(const Owner& owner) {
  const std::vector<std::byte> bytes = bytes_of(owner);
  Organ organ;
  OrganRefusal refusal;
  if (organ_open(bytes, organ, &refusal) == Status::kOk) return "";
  return std::string(refusal.place) + "[" + std::to_string(refusal.index) +
         "]: " + refusal.expected;
}

inline std::unique_ptr<OpenOrgan> packed(const Owner& owner) {
  return open_organ(bytes_of(owner));
}

}  // namespace stylet::test
