// SPDX-License-Identifier: Apache-2.0
// Whole insertions under LLVM's real-time sanitizer, which ends the program at any call that may
// wait or allocate (several hundred functions of the C library). Its runtime is used without the
// compiler's part: it is linked as a whole into a program made by GCC, and switched on and off by
// hand.
//
// usage: stylet_rtsan tick|heap|lock|file; the last three are what the sanitizer must stop.
#include <fcntl.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string_view>

#include "session.h"

extern "C" {
void __rtsan_init();
void __rtsan_realtime_enter();
void __rtsan_realtime_exit();
}

namespace stylet::test {
namespace {

void insert(Setup setup) {
  const auto opened = block_organ(8, 8, 8);
  Session session = make_session(opened->organ, setup);
  const Script script = block_script(opened->organ, config_of(setup));
  __rtsan_realtime_enter();
  run(session.kernel, script, 0, kCycleTicks);
  __rtsan_realtime_exit();
  std::printf("%s: %llu ticks\n", setup_name(setup),
              static_cast<unsigned long long>(stats(session.kernel).ticks));
}

void misbehave(std::string_view how) {
  std::mutex mutex;
  __rtsan_realtime_enter();
  if (how == "heap") {
    void* volatile bytes = std::malloc(1);
    std::free(bytes);
  }
  if (how == "lock") mutex.lock();
  if (how == "file") (void)open("/dev/null", O_RDONLY);
  __rtsan_realtime_exit();
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  using namespace stylet::test;
  __rtsan_init();
  const std::string_view what = argc > 1 ? argv[1] : "tick";
  if (what != "tick") misbehave(what);
  if (what == "tick") {
    for (const Setup setup : kSetups) insert(setup);
    std::puts("nothing that may wait");
  }
  return 0;
}
