// SPDX-License-Identifier: Apache-2.0
// Results of calls made before the loop starts. A tick never fails: it clamps, flags and counts.
#pragma once

#include <cstdint>

namespace stylet {

// The numbers are part of recordings and logs, so a number never changes its meaning.
enum class [[nodiscard]] Status : std::uint16_t{
    kOk = 0,
    // 100..199: the organ file.
    kOrganTooSmall = 100,
    kOrganNotAnOrganFile = 101,
    kOrganVersionUnknown = 102,
    kOrganStructureDamaged = 103,
    kOrganValueOutOfRange = 104,
    kOrganIndexOutOfRange = 105,
    kOrganSizesDisagree = 106,
    kOrganOrderWrong = 107,
    kOrganTooLarge = 108,  // from sizes: this machine cannot count a memory block's bytes
    // 200..299: the configuration.
    kConfigValueOutOfRange = 200,
    kObstaclesTooLate = 201,
    // 300..399: the memory.
    kMemoryTooSmall = 300,
    kMemoryNotAligned = 301,
    kSnapshotDoesNotMatch = 302,
    kSnapshotDamaged = 303,
};

const char* status_name(Status status);

}  // namespace stylet
