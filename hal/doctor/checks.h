// SPDX-License-Identifier: Apache-2.0
// A check: a look at the machine, how bad it is if that is not good, and what to do then.
#pragma once

#include <span>
#include <string>

#include "hal/base/host_tree.h"
#include "hal/doctor/doctor.h"

namespace stylet::hal {

// kMinor: bad, but one step less than the check's severity. kBesides: neither good nor bad.
enum class Condition { kGood, kBesides, kMinor, kBad, kUnknown };

struct Seen {
  Condition state = Condition::kUnknown;
  std::string value;
  std::string source;
};

struct Check {
  const char* name;
  Verdict severity;
  Seen (*look)(const Patient& patient, const HostTree& tree);
  const char* remedy;  // "{cpu}" is replaced by the loop's processor, "{priority}" by its priority
};

std::span<const Check> kernel_checks();     // kernel, clocks, rights, settings that disturb
std::span<const Check> processor_checks();  // who else may use the processor, and how it sleeps
std::span<const Check> device_checks();     // USB, and the threads that serve it

// The finding of a check that saw this.
Finding finding_of(const Check& check, const Seen& seen, const Patient& patient);

inline Seen not_read(const std::string& path) {
  return {Condition::kUnknown, "cannot be read", path};
}

}  // namespace stylet::hal
