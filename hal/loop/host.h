// SPDX-License-Identifier: Apache-2.0
// Makes the machine fit for the loop, and says plainly what the machine refuses.
//
// Order: prepare_process (locks memory, keeps the processor awake); then, in the loop's thread,
// prepare_thread (pins, priority, touches the stack). Neither throws; what was not granted is in
// the lists, one line each with the remedy. `lacks`: the loop cannot keep its promise. `notes`: it
// can, but the machine makes that harder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace stylet::hal {

struct HostReport {
  std::vector<std::string> lacks;
  std::vector<std::string> notes;
};

struct HostState {
  HostState() = default;
  ~HostState();
  HostState(const HostState&) = delete;
  HostState& operator=(const HostState&) = delete;
  HostReport report;
  int latency_fd = -1;  // kept open: closing it would let the processor sleep deeply again
};

void prepare_process(HostState& host);
// Processors for the loop (the first one) and its helpers, in the order in which they should be
// taken: isolated ones first, then the others that this process may use, the last one first. `cpu`
// -1: none is demanded.
std::vector<int> loop_processors(int cpu);
// `cpu` -1: the first of loop_processors().
void prepare_thread(int cpu, int priority, HostReport& report);

// Use by the calling thread since it started.
struct ThreadUse {
  std::int64_t minor_faults, major_faults, voluntary_switches, involuntary_switches;
};
ThreadUse thread_use();

}  // namespace stylet::hal
