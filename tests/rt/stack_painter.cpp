// SPDX-License-Identifier: Apache-2.0
// How much stack a tick really uses: a stack is filled with one byte, and after whole insertions it
// is measured how deep that byte was overwritten. Prints one line for each setup and instruction
// set; exits with 1 if the measurement does not find a frame of known size.
// toolchain/checks/stack.py compares it with the bound.
#include <ucontext.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>

#include "session.h"
#include "variants.h"

namespace stylet::test {
namespace {

constexpr std::size_t kStackBytes = 256 * 1024;
constexpr std::byte kPaint{0xA5};

struct Painted {
  void (*body)(void*);
  void* argument;
  std::uintptr_t top;
  ucontext_t here, there;
};
Painted painted;  // a context starts a function without arguments

void run_painted() {
  painted.top = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  painted.body(painted.argument);
}

// Bytes of stack that `body` uses. It runs in a context of its own and not in a thread, because
// start and end of a thread use more than a tick.
std::size_t stack_use(void (*body)(void*), void* argument) {
  const Block stack = make_block(kStackBytes, kPaint);
  painted.body = body;
  painted.argument = argument;
  if (getcontext(&painted.there) != 0) std::abort();
  painted.there.uc_stack.ss_sp = stack.bytes.get();
  painted.there.uc_stack.ss_size = kStackBytes;
  painted.there.uc_link = &painted.here;
  makecontext(&painted.there, run_painted, 0);
  if (swapcontext(&painted.here, &painted.there) != 0) std::abort();
  const auto bytes = stack.span();
  const auto deepest =
      std::find_if(bytes.begin(), bytes.end(), [](std::byte b) { return b != kPaint; });
  return painted.top - reinterpret_cast<std::uintptr_t>(&*deepest);
}

constexpr std::size_t kKnownBytes = 20'000;

void use_known_frame(void*) {
  volatile char frame[kKnownBytes];
  for (volatile char& c : frame) c = 1;
}

struct Insertion {
  Session session;
  Script script;
};

void insert(void* argument) {
  auto& insertion = *static_cast<Insertion*>(argument);
  run(insertion.session.kernel, insertion.script, 0, kCycleTicks);
}

// A needle that first appears with its tip in the middle of the bone: libccd looks for the way out.
void appear_in_bone(void* argument) {
  auto& insertion = *static_cast<Insertion*>(argument);
  Input input = {};
  input.handle.rotation = {1, 0, 0, 0};
  input.handle.position_m = insertion.script.entry_m;
  input.handle.position_m.z += insertion.script.needle_length_m - 25e-3F;
  input.valid = 1;
  for (int i = 0; i < 10; ++i) tick(insertion.session.kernel, input);
}

void print_use(const char* what, const Variant& variant, std::size_t bytes) {
  std::printf("%s, %s: %zu bytes\n", what, variant.name, bytes);
}

}  // namespace
}  // namespace stylet::test

int main() {
  using namespace stylet::test;
  const std::size_t known = stack_use(use_known_frame, nullptr);
  if (known < kKnownBytes || known > kKnownBytes + 512) {
    std::fprintf(stderr, "a frame of %zu bytes was measured as %zu\n", kKnownBytes, known);
    return 1;
  }
  const auto opened = block_organ(8, 8, 8);
  for (const Variant& variant : variants_here()) {
    for (const Setup setup : kSetups) {
      Insertion insertion = {make_session(opened->organ, setup),
                             block_script(opened->organ, config_of(setup))};
      insertion.session.kernel.step = variant.step;
      print_use(setup_name(setup), variant, stack_use(insert, &insertion));
    }
    Insertion insertion = {make_session(opened->organ, Setup::kElastic),
                           block_script(opened->organ, config_of(Setup::kElastic))};
    insertion.session.kernel.step = variant.step;
    print_use("in bone", variant, stack_use(appear_in_bone, &insertion));
  }
  return 0;
}
