// SPDX-License-Identifier: Apache-2.0
// Organs as FlatBuffers' own objects, for tests that change one before they pack and open it.
#pragma once

#include <memory>
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

inline std::unique_ptr<OpenOrgan> packed(const Owner& owner) {
  return open_organ(bytes_of(owner));
}

}  // namespace stylet::test
