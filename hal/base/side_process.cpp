// SPDX-License-Identifier: Apache-2.0
#include "hal/base/side_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <thread>

#include "hal/base/channel.h"

namespace stylet::hal {
namespace {

using Clock = std::chrono::steady_clock;

// Descriptors in the side process, after its standard error: its memory and its socket.
constexpr int kMemoryDescriptor = 3;
constexpr int kSocketDescriptor = 4;
constexpr int kFirstOther = 5;
static_assert(kFirstOther <= kLeastDescriptor);
constexpr std::array kOutsideSignals = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXFSZ};
constexpr std::chrono::milliseconds kLook{1};
constexpr const char* kOutOfMemory = "out of memory";

// At the front of the shared memory.
struct FrontOfMemory {
  alignas(kCacheLine) std::array<char, 512> last_words;
};

[[noreturn]] void fail(const char* what) {
  throw SideError(fmt::format("a process beside the loop cannot be started: {}: {}", what,
                              std::strerror(errno)));
}

Clock::time_point deadline_after(double seconds) {
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

double seconds_to(Clock::time_point deadline) {
  return std::max(0.0, std::chrono::duration<double>(deadline - Clock::now()).count());
}

}  // namespace

// ---- the socket

SideLink::~SideLink() {
  close();
}

void SideLink::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
  gone_ = true;
}

// A signal that interrupts the wait is not an answer.
bool SideLink::wait(short events, double patience_s) const {
  const Clock::time_point deadline = deadline_after(patience_s);
  pollfd at = {socket_, events, 0};
  for (;;) {
    const int ready = ::poll(&at, 1, static_cast<int>(std::ceil(seconds_to(deadline) * 1e3)));
    if (ready >= 0 || errno != EINTR) return ready > 0;
  }
}

namespace {

// Room for the descriptors of one message.
constexpr std::size_t kMaxDescriptors = 4;
struct Rights {
  alignas(cmsghdr) std::array<char, CMSG_SPACE(kMaxDescriptors * sizeof(int))> room = {};

  void put(msghdr& message, std::span<const int> descriptors) {
    message.msg_control = room.data();
    message.msg_controllen = CMSG_SPACE(descriptors.size_bytes());
    cmsghdr* head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(descriptors.size_bytes());
    std::memcpy(CMSG_DATA(head), descriptors.data(), descriptors.size_bytes());
  }
  static void take(msghdr& message, std::vector<int>& descriptors) {
    for (cmsghdr* head = CMSG_FIRSTHDR(&message); head != nullptr;
         head = CMSG_NXTHDR(&message, head)) {
      if (head->cmsg_level != SOL_SOCKET || head->cmsg_type != SCM_RIGHTS) continue;
      const std::size_t before = descriptors.size();
      descriptors.resize(before + (head->cmsg_len - CMSG_LEN(0)) / sizeof(int));
      std::memcpy(descriptors.data() + before, CMSG_DATA(head), head->cmsg_len - CMSG_LEN(0));
    }
  }
};

}  // namespace

bool SideLink::send(std::span<const std::byte> message, double patience_s,
                    std::span<const int> descriptors) {
  const Clock::time_point deadline = deadline_after(patience_s);
  const std::uint64_t size = message.size();
  const auto size_bytes = std::as_bytes(std::span(&size, 1));
  Bytes whole(size_bytes.begin(), size_bytes.end());
  whole.insert(whole.end(), message.begin(), message.end());
  Rights rights;
  for (std::size_t done = 0; done < whole.size() && !gone_;) {
    iovec part = {whole.data() + done, whole.size() - done};
    msghdr head = {};
    head.msg_iov = &part;
    head.msg_iovlen = 1;
    if (done == 0 && !descriptors.empty()) {
      rights.put(head, descriptors.first(std::min(descriptors.size(), kMaxDescriptors)));
    }
    const ssize_t sent = sendmsg(socket_, &head, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent > 0) done += static_cast<std::size_t>(sent);
    if (sent >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN) gone_ = true;
    if (gone_ || wait(POLLOUT, seconds_to(deadline))) continue;
    if (done == 0) return false;
    gone_ = true;  // half a message cannot be taken back
  }
  return !gone_;
}

std::optional<Bytes> SideLink::take_whole() {
  std::uint64_t size = 0;
  if (arrived_.size() < sizeof size) return std::nullopt;
  std::memcpy(&size, arrived_.data(), sizeof size);
  if (size > kMaxSideMessage) gone_ = true;
  if (gone_ || arrived_.size() - sizeof size < size) return std::nullopt;
  const auto begin = arrived_.begin() + sizeof size;
  const auto end = begin + static_cast<std::ptrdiff_t>(size);
  Bytes message(begin, end);
  arrived_.erase(arrived_.begin(), end);
  return message;
}

std::optional<Bytes> SideLink::receive(double patience_s, std::vector<int>* descriptors) {
  const Clock::time_point deadline = deadline_after(patience_s);
  std::array<std::byte, 65536> part;
  for (;;) {
    if (std::optional<Bytes> whole = take_whole()) return whole;
    if (gone_) return std::nullopt;
    iovec into = {part.data(), part.size()};
    Rights rights;
    msghdr head = {};
    head.msg_iov = &into;
    head.msg_iovlen = 1;
    if (descriptors != nullptr) {
      head.msg_control = rights.room.data();
      head.msg_controllen = rights.room.size();
    }
    const ssize_t got = recvmsg(socket_, &head, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
    if (got >= 0 && descriptors != nullptr) Rights::take(head, *descriptors);
    if (got > 0) arrived_.insert(arrived_.end(), part.begin(), part.begin() + got);
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) gone_ = true;
    if (got < 0 && errno == EAGAIN && !wait(POLLIN, seconds_to(deadline))) return std::nullopt;
  }
}

// ---- the process

namespace {

struct SpawnActions {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  SpawnActions() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnActions() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
};

// Not fork: after it, every page of this process that is written would cause a fault, those of the
// loop too.
pid_t spawn(const std::string& role, int memory, int socket) {
  SpawnActions actions;
  posix_spawn_file_actions_addopen(&actions.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions.files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions.files, memory, kMemoryDescriptor);
  posix_spawn_file_actions_adddup2(&actions.files, socket, kSocketDescriptor);
  posix_spawn_file_actions_addclosefrom_np(&actions.files, kFirstOther);
  sigset_t blocked;
  sigemptyset(&blocked);
  for (const int number : kOutsideSignals) sigaddset(&blocked, number);
  posix_spawnattr_setsigmask(&actions.attributes, &blocked);
  const sched_param no_priority = {0};
  posix_spawnattr_setschedparam(&actions.attributes, &no_priority);
  posix_spawnattr_setschedpolicy(&actions.attributes, SCHED_OTHER);
  posix_spawnattr_setflags(&actions.attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSCHEDULER);
  std::string program = "stylet", command = kBesideCommand, given = role;
  std::array<char*, 4> arguments = {program.data(), command.data(), given.data(), nullptr};
  pid_t pid = -1;
  errno = posix_spawn(&pid, "/proc/self/exe", &actions.files, &actions.attributes, arguments.data(),
                      environ);
  return errno == 0 ? pid : -1;
}

// Both ends; the second is the child's.
std::array<int, 2> socket_pair() {
  std::array<int, 2> ends = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail("socket");
  for (int& each : ends) each = raised(each);
  return ends;
}

std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) {
    return fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  }
  return fmt::format("exit code {}", WEXITSTATUS(status));
}

}  // namespace

SideProcess::SideProcess(const std::string& role, std::size_t shared_bytes,
                         std::span<const std::byte> greeting)
    : memory_(sizeof(FrontOfMemory) + shared_bytes), far_end_(-1), link_([this] {
        const std::array<int, 2> ends = socket_pair();
        far_end_ = ends[1];
        return ends[0];
      }()) {
  pid_ = spawn(role, memory_.descriptor(), far_end_);
  const int error = errno;
  ::close(far_end_);
  errno = error;
  if (pid_ < 0) fail("/proc/self/exe");
  (void)link_.send(greeting);
  std::optional<Bytes> answer = link_.receive(kSidePatienceS);
  if (answer) {
    answer_ = std::move(*answer);
    return;
  }
  kill();
  const std::string words = last_words();
  if (words.empty()) throw SideError(fmt::format("{}: did not start: {}", role, ended_));
  throw SideError(words == kOutOfMemory ? fmt::format("{}: {}", role, words) : words);
}

SideProcess::~SideProcess() {
  link_.close();
  kill();
}

std::span<std::byte> SideProcess::shared() const {
  return memory_.bytes().subspan(sizeof(FrontOfMemory));
}

// The side process may have written anything there.
std::string SideProcess::last_words() const {
  std::string words;
  for (const char each :
       reinterpret_cast<const FrontOfMemory*>(memory_.bytes().data())->last_words) {
    if (each == 0) break;
    words += std::isprint(static_cast<unsigned char>(each)) != 0 || (each & 0x80) != 0 ? each : ' ';
  }
  return words;
}

const std::string& SideProcess::ended() {
  int status = 0;
  if (!ended_.empty() || waitpid(pid_, &status, WNOHANG) != pid_) return ended_;
  ended_ = how_it_ended(status);
  const std::string words = last_words();
  if (WIFEXITED(status) && !words.empty()) ended_ = words;
  return ended_;
}

bool SideProcess::wait_for_end(double patience_s) {
  const Clock::time_point deadline = deadline_after(patience_s);
  while (ended().empty() && Clock::now() < deadline) std::this_thread::sleep_for(kLook);
  return !ended().empty();
}

void SideProcess::kill() {
  // A process that ends by itself says why.
  if (wait_for_end(link_.gone() ? kSideEndS : 0)) return;
  ::kill(pid_, SIGKILL);
  // A hung disk holds up a process that waits for it; this process does not wait as well.
  (void)wait_for_end(1);
}

// ---- in the process beside

namespace {

// Makes the system end this process before the loop's, and a leak of its own end it even earlier.
void bound_memory(std::size_t shared_bytes) {
  if (std::FILE* file = std::fopen("/proc/self/oom_score_adj", "we"); file != nullptr) {
    (void)std::fputs("1000", file);
    (void)std::fclose(file);
  }
#if !defined(STYLET_SANITIZED)  // a sanitizer's shadow memory is larger than any limit
  rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, kMostSideMemory + shared_bytes);
  (void)setrlimit(RLIMIT_AS, &limit);
#else
  (void)shared_bytes;
#endif
}

void say_last(std::span<std::byte> memory, const char* words) {
  auto& room = reinterpret_cast<FrontOfMemory*>(memory.data())->last_words;
  std::strncpy(room.data(), words, room.size() - 1);
}

}  // namespace

int side_seat(const char* role, SideWork work, bool outlives) {
  if (!outlives) (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
  (void)prctl(PR_SET_NAME, fmt::format("stylet-{}", role).c_str());
  const SharedMemory memory = SharedMemory::of(kMemoryDescriptor);
  bound_memory(memory.bytes().size());
  try {
    SideLink link(kSocketDescriptor);
    std::optional<Bytes> greeting = link.receive(kSidePatienceS);
    if (!greeting) return 1;
    SideSeat seat = {link, memory.bytes().subspan(sizeof(FrontOfMemory)), std::move(*greeting)};
    work(seat);
    return 0;
  } catch (const std::bad_alloc&) {
    say_last(memory.bytes(), kOutOfMemory);
  } catch (const std::system_error& error) {
    const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
    say_last(memory.bytes(), no_thread ? kOutOfMemory : error.what());
  } catch (const std::exception& error) {
    say_last(memory.bytes(), error.what());
  } catch (...) {
    say_last(memory.bytes(), "an exception of unknown type was thrown");
  }
  return 1;
}

}  // namespace stylet::hal
