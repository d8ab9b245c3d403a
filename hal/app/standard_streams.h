// SPDX-License-Identifier: Apache-2.0
// Standard output and error of a program that must end when it is told to.
#pragma once

namespace stylet::app {

// From then on a reader that reads no more (a full pipe, a terminal that was held) keeps nobody
// waiting for longer than a second after a signal has asked for the end (stop_signal.h). What then
// does not fit fails with EAGAIN on standard output, and is dropped on standard error. May be
// called again.
void bound_standard_streams();

}  // namespace stylet::app
