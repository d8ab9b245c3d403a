// SPDX-License-Identifier: Apache-2.0
// Faults and states in words.
#include "hal/guard/guard.h"

namespace stylet::hal {

const char* fault_name(Fault fault) {
  switch (fault) {
    case Fault::kNone:
      return "none";
    case Fault::kForceNotFinite:
      return "force not finite";
    case Fault::kStaleSamples:
      return "no usable sample";
    case Fault::kDeviceSilent:
      return "device silent";
    case Fault::kTooLate:
      return "too many missed ticks";
    case Fault::kKernelFault:
      return "kernel fault";
    case Fault::kTooFast:
      return "device too fast";
    case Fault::kBuzz:
      return "force buzzes";
    case Fault::kEnergy:
      return "energy made";
    case Fault::kForceExpired:
      return "force expired";
  }
  return "unknown fault";
}

const char* refusal_name(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      return "used";
    case Refusal::kSilent:
      return "nothing came";
    case Refusal::kRepeated:
      return "nothing new";
    case Refusal::kLate:
      return "late";
    case Refusal::kNotFinite:
      return "not finite";
    case Refusal::kAbsurd:
      return "not a place within 10 m, or no rotation";
    case Refusal::kJumped:
      return "jumped";
  }
  return "unknown refusal";
}

const char* mode_name(GuardMode mode) {
  switch (mode) {
    case GuardMode::kLetGo:
      return "let go";
    case GuardMode::kUnarmed:
      return "unarmed";
    case GuardMode::kRamp:
      return "ramp";
    case GuardMode::kLive:
      return "live";
    case GuardMode::kRelease:
      return "release";
    case GuardMode::kFading:
      return "fading";
    case GuardMode::kFault:
      return "fault";
  }
  return "unknown mode";
}

}  // namespace stylet::hal
