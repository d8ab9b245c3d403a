// SPDX-License-Identifier: Apache-2.0
// A loop with a console with READERS clients that read and SLEEPERS clients that connect and never
// read: prints the state's hash. watched_loop.py counts what that costs the loop.
//
// usage: stylet_watched_loop READERS SLEEPERS
#include <fmt/format.h>
#include <valgrind/callgrind.h>

#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "served.h"

namespace stylet::console::test {
namespace {

// Virtual time that leaves the other threads some of the real one.
struct Unhurried {
  hal::VirtualTime time;

  static std::int64_t now(void* self) { return static_cast<Unhurried*>(self)->time.now_ns; }
  static void sleep(void* self, std::int64_t t_ns) {
    usleep(1000);
    hal::VirtualTime& time = static_cast<Unhurried*>(self)->time;
    if (t_ns > time.now_ns) time.now_ns = t_ns;
  }
};

void read_until(Client& client, std::uint64_t last) {
  client.next_of<Frame>(Body::Frame, [last](const Frame& frame) { return frame.tick() == last; });
}

int watch(std::size_t readers, std::size_t sleepers) {
  Served served;
  served.config.display_every_ticks = 4;
  std::vector<std::unique_ptr<Client>> clients;
  for (std::size_t i = 0; i < readers + sleepers; ++i) {
    clients.push_back(std::make_unique<Client>(served.port));
    if (clients.back()->join() != 101) return 1;
  }
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < readers; ++i) {
    threads.emplace_back(read_until, std::ref(*clients[i]), served.config.ticks);
  }
  Unhurried unhurried;
  const hal::Device device = served.device();
  CALLGRIND_START_INSTRUMENTATION;
  std::thread loop([&] {
    hal::run_loop(served.config, served.instance->kernel, std::span(&device, 1),
                  {&unhurried, Unhurried::now, Unhurried::sleep},
                  {&served.records, &served.events, served.display.get()}, served.state);
  });
  loop.join();
  CALLGRIND_STOP_INSTRUMENTATION;
  for (std::thread& each : threads) each.join();
  fmt::print("{:016x} {}\n", hash(served.instance->kernel), served.state.ticks);
  return 0;
}

}  // namespace
}  // namespace stylet::console::test

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  return stylet::console::test::watch(std::strtoul(argv[1], nullptr, 10),
                                      std::strtoul(argv[2], nullptr, 10));
}
