// SPDX-License-Identifier: Apache-2.0
// What a thread asks of the system so that it runs in time.
//
// Promises: they apply to the calling thread, and neither allocate nor throw; 0 if they were
// granted, else the error's number (errno; on Windows GetLastError).
#pragma once

#include <string>

namespace stylet::hal {

// SCHED_FIFO with this priority, 1 to 99. Windows has one class for all of them: time-critical.
int rise_to(int priority);
// Runs on this processor alone.
int stay_on(int processor);
// What an error of theirs means.
std::string why_refused(int error);

}  // namespace stylet::hal
