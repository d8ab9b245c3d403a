// SPDX-License-Identifier: Apache-2.0
// A Cortex-M7 without anything below it: vectors, start, text and exit through semihosting, and
// SysTick as the clock.
//
// The emulator counts instructions as time: with `-icount shift=6` each takes 64 ns, and SysTick
// counts 25 MHz, so 8 counts are 5 instructions.
#include <cstdint>

#include "../platform.h"

extern "C" {
extern std::uint32_t stack_top, data_load, data_begin, data_end, bss_begin, bss_end;
void reset_handler();
void fault_handler();
void __assert_func(const char* file, int line, const char* function, const char* what);
}

namespace {

using Handler = void (*)();
struct Vectors {
  const void* stack;
  Handler handler[15];
};
[[gnu::section(".vectors"), gnu::used]] const Vectors vectors = {
    &stack_top,
    {reset_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler,
     fault_handler, fault_handler, fault_handler, fault_handler, fault_handler, fault_handler,
     fault_handler, fault_handler, fault_handler}};

struct SysTick {
  std::uint32_t control, reload, value;
};
SysTick volatile& systick = *reinterpret_cast<SysTick volatile*>(0xE000E010U);
constexpr std::uint32_t kSysTickMask = 0xFFFFFFU;

enum Semihosting : std::uint32_t { kWriteText = 0x04, kCommandLine = 0x15, kExit = 0x20 };

std::uint32_t semihosting(Semihosting what, const void* argument) {
  register std::uint32_t r0 asm("r0") = what;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

[[noreturn]] void leave(int code) {
  const std::uint32_t argument[2] = {0x20026, static_cast<std::uint32_t>(code)};
  semihosting(kExit, argument);
  for (;;) asm volatile("wfi");
}

// The emulator's words: the program's name, then the rest.
stylet::test::Words command_line() {
  static char text[256];
  struct {
    char* text;
    std::uint32_t size;
  } request = {text, sizeof text};
  stylet::test::Words words = {};
  if (semihosting(kCommandLine, &request) != 0) return words;
  bool inside = false, first = true;
  for (char* c = text; *c != '\0'; ++c) {
    const bool blank = *c == ' ';
    if (!blank && !inside && !first && words.count < stylet::test::kMaxWords) {
      words.word[words.count++] = c;
    }
    if (blank && inside) first = false;
    if (blank) *c = '\0';
    inside = !blank;
  }
  return words;
}

}  // namespace

namespace stylet::test {

void put(const char* text) {
  semihosting(kWriteText, text);
}

std::uint32_t clock() {
  return (kSysTickMask - systick.value) & kSysTickMask;
}

}  // namespace stylet::test

extern "C" {

[[gnu::noinline, noreturn]] void start() {
  const std::uint32_t* from = &data_load;
  for (std::uint32_t* to = &data_begin; to != &data_end;) *to++ = *from++;
  for (std::uint32_t* to = &bss_begin; to != &bss_end;) *to++ = 0;
  systick.reload = kSysTickMask;
  systick.value = 0;
  systick.control = 5;  // on, the processor's clock, no interrupt
  leave(stylet::test::replay(command_line()));
}

void reset_handler() {
  // The floating-point unit, before the compiler can use it.
  *reinterpret_cast<std::uint32_t volatile*>(0xE000ED88U) |= 0xFU << 20U;
  asm volatile("dsb\n isb" ::: "memory");
  start();
}

void fault_handler() {
  stylet::test::put("fault\n");
  leave(3);
}

void __assert_func(const char*, int, const char*, const char* what) {
  stylet::test::put(what);
  stylet::test::put("\n");
  leave(4);
}

}  // extern "C"
