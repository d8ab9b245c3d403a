// SPDX-License-Identifier: Apache-2.0
#include "virtual_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <memory>
#include <vector>

namespace stylet::test {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

struct Thread {
  sem_t turn;
  int number = 0;
  std::int64_t wake_ns = 0;
  std::uint64_t order = 0;
  pthread_t id = 0;
  bool ended = false;
  void* (*start)(void*) = nullptr;
  void* argument = nullptr;
};

// Changed only by the thread whose turn it is.
struct Process {
  bool on = false;
  std::int64_t now_ns = 1'000 * kNsPerS;
  std::uint64_t orders = 0;
  std::vector<std::unique_ptr<Thread>> threads;
  std::vector<Thread*> waiting;
  VirtualProcess hooks;
};
Process process;
thread_local Thread* self = nullptr;

template <typename Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

Thread* add_thread() {
  process.threads.push_back(std::make_unique<Thread>());
  Thread* thread = process.threads.back().get();
  sem_init(&thread->turn, 0, 0);
  thread->number = static_cast<int>(process.threads.size()) - 1;
  return thread;
}

void enqueue(Thread* thread, std::int64_t wake_ns) {
  thread->wake_ns = std::max(wake_ns, process.now_ns);
  thread->order = ++process.orders;
  process.waiting.push_back(thread);
}

// Passes the turn to the thread that wakes up first; returns when it is this thread's turn again.
void hand_over(Thread* from) {
  const auto next = std::min_element(
      process.waiting.begin(), process.waiting.end(), [](const Thread* a, const Thread* b) {
        return a->wake_ns != b->wake_ns ? a->wake_ns < b->wake_ns : a->order < b->order;
      });
  Thread* const to = *next;
  process.waiting.erase(next);
  process.now_ns = std::max(process.now_ns, to->wake_ns);
  if (to == from) return;
  sem_post(&to->turn);
  while (from != nullptr && sem_wait(&from->turn) != 0) {
  }
}

void* run(void* at) {
  Thread* thread = static_cast<Thread*>(at);
  while (sem_wait(&thread->turn) != 0) {
  }
  self = thread;
  void* result = thread->start(thread->argument);
  self = nullptr;
  thread->ended = true;
  hand_over(nullptr);
  return result;
}

timespec spec_of(std::int64_t ns) {
  return {static_cast<std::time_t>(ns / kNsPerS), static_cast<long>(ns % kNsPerS)};
}
std::int64_t ns_of(const timespec& spec) {
  return spec.tv_sec * kNsPerS + spec.tv_nsec;
}

// Looks again and again until there is something or the time is up.
template <typename Look>
int wait_for(std::int64_t timeout_ns, Look look) {
  const std::int64_t end_ns = process.now_ns + timeout_ns;
  while (true) {
    const int found = look();
    if (found != 0 || timeout_ns == 0) return found;
    if (timeout_ns > 0 && process.now_ns >= end_ns) return 0;
    const std::int64_t next_ns = process.now_ns + kLookNs;
    sleep_until_virtual(timeout_ns > 0 ? std::min(next_ns, end_ns) : next_ns);
  }
}

void wait_until_readable(int file, int flags) {
  if ((flags & MSG_DONTWAIT) != 0 || (fcntl(file, F_GETFL) & O_NONBLOCK) != 0) return;
  pollfd wanted = {file, POLLIN, 0};
  (void)poll(&wanted, 1, -1);
}

}  // namespace

VirtualProcess& enter_virtual_time() {
  if (!process.on) self = add_thread();
  process.on = true;
  return process.hooks;
}

std::int64_t virtual_now_ns() {
  return process.now_ns;
}

void sleep_until_virtual(std::int64_t t_ns) {
  if (process.hooks.look) process.hooks.look();
  enqueue(self, process.hooks.wakes ? process.hooks.wakes(self->number, t_ns) : t_ns);
  hand_over(self);
}

int newest_virtual_thread() {
  return static_cast<int>(process.threads.size()) - 1;
}

}  // namespace stylet::test

using stylet::test::process;
using stylet::test::real;
using stylet::test::self;
using stylet::test::sleep_until_virtual;

extern "C" {

int clock_gettime(clockid_t clock, timespec* out) {
  if (!process.on || clock == CLOCK_PROCESS_CPUTIME_ID || clock == CLOCK_THREAD_CPUTIME_ID) {
    return static_cast<int>(syscall(SYS_clock_gettime, clock, out));
  }
  *out = stylet::test::spec_of(process.now_ns);
  return 0;
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  if (self == nullptr)
    return static_cast<int>(syscall(SYS_clock_nanosleep, clock, flags, time, left));
  const std::int64_t ns = stylet::test::ns_of(*time);
  sleep_until_virtual(flags == TIMER_ABSTIME ? ns : process.now_ns + ns);
  return 0;
}

int nanosleep(const timespec* time, timespec* left) {
  if (self == nullptr) return static_cast<int>(syscall(SYS_nanosleep, time, left));
  sleep_until_virtual(process.now_ns + stylet::test::ns_of(*time));
  return 0;
}

int sched_yield() {
  if (self == nullptr) return static_cast<int>(syscall(SYS_sched_yield));
  sleep_until_virtual(process.now_ns + 1000);
  return 0;
}

int poll(pollfd* files, nfds_t count, int timeout_ms) {
  static const auto real_poll = real<int (*)(pollfd*, nfds_t, int)>("poll");
  if (self == nullptr) return real_poll(files, count, timeout_ms);
  return stylet::test::wait_for(timeout_ms < 0 ? -1 : timeout_ms * std::int64_t{1'000'000},
                                [&] { return real_poll(files, count, 0); });
}

int epoll_wait(int file, epoll_event* events, int most, int timeout_ms) {
  static const auto real_wait = real<int (*)(int, epoll_event*, int, int)>("epoll_wait");
  if (self == nullptr) return real_wait(file, events, most, timeout_ms);
  return stylet::test::wait_for(timeout_ms < 0 ? -1 : timeout_ms * std::int64_t{1'000'000},
                                [&] { return real_wait(file, events, most, 0); });
}

ssize_t recv(int file, void* room, std::size_t size, int flags) {
  static const auto real_recv = real<ssize_t (*)(int, void*, std::size_t, int)>("recv");
  if (self != nullptr) stylet::test::wait_until_readable(file, flags);
  return real_recv(file, room, size, flags);
}

ssize_t recvmsg(int file, msghdr* message, int flags) {
  static const auto real_recv = real<ssize_t (*)(int, msghdr*, int)>("recvmsg");
  if (self != nullptr) stylet::test::wait_until_readable(file, flags);
  return real_recv(file, message, flags);
}

// Now and then it wakes up too early, as the real function may.
int pthread_cond_clockwait(pthread_cond_t* cond, pthread_mutex_t* mutex, clockid_t clock,
                           const timespec* until) {
  static const auto real_wait =
      real<int (*)(pthread_cond_t*, pthread_mutex_t*, clockid_t, const timespec*)>(
          "pthread_cond_clockwait");
  if (self == nullptr) return real_wait(cond, mutex, clock, until);
  const std::int64_t end_ns = stylet::test::ns_of(*until);
  pthread_mutex_unlock(mutex);
  sleep_until_virtual(std::min(end_ns, process.now_ns + 1'000'000));
  pthread_mutex_lock(mutex);
  return process.now_ns >= end_ns ? ETIMEDOUT : 0;
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  static const auto real_lock = real<int (*)(pthread_mutex_t*)>("pthread_mutex_lock");
  if (self == nullptr) return real_lock(mutex);
  int result = pthread_mutex_trylock(mutex);
  while (result == EBUSY) {
    sleep_until_virtual(process.now_ns + stylet::test::kLookNs);
    result = pthread_mutex_trylock(mutex);
  }
  return result;
}

int pthread_create(pthread_t* id, const pthread_attr_t* attributes, void* (*start)(void*),
                   void* argument) {
  static const auto real_create =
      real<int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*)>("pthread_create");
  if (self == nullptr) return real_create(id, attributes, start, argument);
  stylet::test::Thread* thread = stylet::test::add_thread();
  thread->start = start;
  thread->argument = argument;
  stylet::test::enqueue(thread, process.now_ns);
  const int result = real_create(&thread->id, attributes, stylet::test::run, thread);
  *id = thread->id;
  return result;
}

int pthread_join(pthread_t id, void** result) {
  static const auto real_join = real<int (*)(pthread_t, void**)>("pthread_join");
  for (const auto& each : process.threads) {
    while (self != nullptr && each->id == id && !each->ended) {
      sleep_until_virtual(process.now_ns + stylet::test::kLookNs);
    }
    if (each->id == id) each->id = 0;  // the number may be used again
  }
  return real_join(id, result);
}

}  // extern "C"
