// SPDX-License-Identifier: Apache-2.0
// Snapshots: the state block as bytes, and what such bytes are held against before they are used.
//
// Bytes come from files and networks, and a tick indexes by what is in its state without another
// look. So every count and index is held against the model, every number against what a tick can
// leave, element by element of the one table of fields (layout.h); a field that is not looked at
// fails a test (unit_snapshot). The checksum tells a damaged file from a whole one and is no
// protection: whoever makes bytes can make that, too.
//
// Promises: no allocation; time linear in the state; nothing is written before all is found good.
// Units SI.
#pragma once

#include "state/layout.h"

namespace stylet {

struct SnapshotHeader {
  std::uint64_t magic, layout, organ_hash, config_hash, state_bytes;
  std::uint64_t checksum;  // of the state's bytes
};

// What a snapshot of this kernel begins with, for these bytes of its state.
SnapshotHeader snapshot_header(const Kernel& kernel, const std::byte* state);

// Of configuration and obstacles.
std::uint64_t config_hash(const Kernel& kernel);

// Whether the bytes of a state (of this kernel's size, at any address) do no harm.
bool state_sound(const Kernel& kernel, const std::byte* state);

}  // namespace stylet
