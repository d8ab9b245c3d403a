// SPDX-License-Identifier: Apache-2.0
#include <windows.h>

#include <system_error>

#include "hal/base/thread_rights.h"

namespace stylet::hal {
namespace {

int error_unless(bool granted) {
  return granted ? 0 : static_cast<int>(GetLastError());
}

}  // namespace

int rise_to(int /*priority*/) {
  return error_unless(SetThreadPriority(GetCurrentThread(), THREAD_PRIORITY_TIME_CRITICAL) != 0);
}

// Of the first 64: the others are in processor groups of their own, between which a thread would
// have to be moved.
int stay_on(int processor) {
  if (processor < 0 || processor >= 64) return ERROR_INVALID_PARAMETER;
  const DWORD_PTR mask = DWORD_PTR{1} << static_cast<unsigned>(processor);
  return error_unless(SetThreadAffinityMask(GetCurrentThread(), mask) != 0);
}

std::string why_refused(int error) {
  return std::system_category().message(error);
}

}  // namespace stylet::hal
