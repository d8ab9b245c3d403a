// SPDX-License-Identifier: Apache-2.0
// The last catch of every thread: an exception that left one would end the process, with a hand on
// the device.
//
// Promises: nothing leaves contained(); what escaped `work` is one line on standard error, at most
// kMostEscapesTold of them in a process, so that what fails in every turn fills no disk.
#pragma once

#include <pthread.h>

#include <exception>
#include <new>

namespace stylet::hal {

constexpr int kMostEscapesTold = 10;

// "stylet: WHO: WHAT". Neither allocates nor throws.
void tell_escape(const char* who, const char* what) noexcept;

// False: something escaped.
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
    tell_escape(who, "something was thrown that is no error");
  }
  return false;
}

// As tools show it: at most 15 characters.
inline void name_thread(const char* name) {
  (void)pthread_setname_np(pthread_self(), name);
}

}  // namespace stylet::hal
