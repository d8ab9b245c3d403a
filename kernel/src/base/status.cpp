// SPDX-License-Identifier: Apache-2.0
#include "stylet/status.h"

namespace stylet {

const char* status_name(Status status) {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kOrganTooSmall:
      return "organ file too small";
    case Status::kOrganNotAnOrganFile:
      return "not an organ file";
    case Status::kOrganVersionUnknown:
      return "organ format version unknown";
    case Status::kOrganStructureDamaged:
      return "organ file structure damaged";
    case Status::kOrganValueOutOfRange:
      return "organ value out of range";
    case Status::kOrganIndexOutOfRange:
      return "organ index out of range";
    case Status::kOrganSizesDisagree:
      return "organ array sizes disagree";
    case Status::kOrganOrderWrong:
      return "organ entries in wrong order";
    case Status::kOrganTooLarge:
      return "organ too large for this machine's addresses";
    case Status::kConfigValueOutOfRange:
      return "configuration value out of range";
    case Status::kObstaclesTooLate:
      return "obstacles set after the first tick";
    case Status::kMemoryTooSmall:
      return "memory too small";
    case Status::kMemoryNotAligned:
      return "memory not aligned";
    case Status::kSnapshotDoesNotMatch:
      return "snapshot of another organ or configuration";
    case Status::kSnapshotDamaged:
      return "snapshot damaged";
  }
  return "unknown status";
}

}  // namespace stylet
