// SPDX-License-Identifier: Apache-2.0
// Standard output and error of a program that must end when it is told to.
#pragma once

namespace stylet::app {

// After this call, a reader that has stopped reading (a full pipe, a terminal that is held) delays
// the program by at most a second once a signal has asked for the end (stop_signal.h). Output that
// does not fit then fails with EAGAIN on standard output, and is dropped on standard error. May be
// called again.
void bound_standard_streams();

}  // namespace stylet::app
