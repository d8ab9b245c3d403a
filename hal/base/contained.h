// SPDX-License-Identifier: Apache-2.0
// The last catch of every thread: an uncaught exception would end the process while a hand is on
// the device.
//
// Promises: no exception leaves contained(); one that escapes `work` becomes one line on standard
// error, at most kMostEscapesTold lines a process, so that a failure in every turn fills no disk.
#pragma once

#include <pthread.h>

#include <exception>
#include <new>

namespace stylet::hal {

constexpr int kMostEscapesTold = 10;

// Writes "stylet: WHO: WHAT". Neither allocates nor throws.
void tell_escape(const char* who, const char* what) noexcept;

// False: an exception escaped from `work`.
template <typename Work>
bool contained(const char* who, Work&& work) noexcept {
  try {
    work();
    return true;
  } catch (const std::bad_alloc&) {
    tell_escape(who, "out of memory");
  } catch (const std::exception& error) {
    tell_escape(who, error.what());
  } catch (...) {
    tell_escape(who, "an exception of unknown type was thrown");
  }
  return false;
}

// The name that tools show: at most 15 characters.
inline void name_thread(const char* name) {
  (void)pthread_setname_np(pthread_self(), name);
}

}  // namespace stylet::hal
