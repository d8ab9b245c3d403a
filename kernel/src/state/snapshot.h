// SPDX-License-Identifier: Apache-2.0
// Snapshots: the state block as bytes, and how such bytes are checked before they are used.
//
// Bytes come from files and networks, and a tick uses its state as indices without checking it
// again. So every count and index is checked against the model, and every number against what a
// tick can leave, element by element, from the one table of fields (layout.h). A field that is not
// checked fails a test (unit_snapshot). The checksum finds damaged files; it does not protect
// against intent: whoever makes bytes can make a checksum, too.
//
// Promises: no allocation; time linear in the state; nothing is written before all checks pass.
// Units SI.
#pragma once

#include "state/layout.h"

namespace stylet {

struct SnapshotHeader {
  std::uint64_t magic;                    // says that it is a snapshot, and of which format
  std::uint64_t layout;                   // hash of the table of fields
  std::uint64_t organ_hash, config_hash;  // of the kernel that it is of
  std::uint64_t state_bytes, checksum;    // size of the state behind it, and a hash of its bytes
};

// The header of a snapshot of this kernel whose state has these bytes.
SnapshotHeader snapshot_header(const Kernel& kernel, const std::byte* state);

// Hash of configuration and obstacles.
std::uint64_t config_hash(const Kernel& kernel);

// Whether the bytes of a state (of this kernel's size, at any address) can do no harm.
bool state_sound(const Kernel& kernel, const std::byte* state);

}  // namespace stylet
