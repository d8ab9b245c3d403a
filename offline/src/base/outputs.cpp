// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/outputs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/file.h"
#include "base/refusal.h"

namespace stylet::offline {
namespace {

bool write_all(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return ::fsync(file) == 0;
}

// One path for all names of a file, also if the file does not exist yet.
std::filesystem::path place_of(const std::filesystem::path& path) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path));
}

// mkstemp lets only the owner read the file; the umask shall decide what others may do.
bool follow_umask(int file) {
  constexpr mode_t kAllMayWrite = 0666;
  const mode_t mask = ::umask(0);  // can only be read by setting it
  ::umask(mask);
  return ::fchmod(file, kAllMayWrite & ~mask) == 0;
}

}  // namespace

void check_output(const std::filesystem::path& path) {
  struct stat now {};
  if (::stat(path.c_str(), &now) != 0) return;
  if (S_ISDIR(now.st_mode)) {
    refuse("{}: is a directory: expected the name of a file", path.string());
  }
  if (!S_ISREG(now.st_mode)) {
    refuse("{}: is a device or another special file: expected the name of a file", path.string());
  }
  if (was_read(path)) {
    refuse("{}: this command reads this file, too: expected another name for what it writes",
           path.string());
  }
}

void check_output_folder(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_directory(path, error)) {
    refuse("{}: is a file: expected the name of a folder", path.string());
  }
}

Outputs::~Outputs() {
  take_back();
  release_signals();
}

// Blocks signals that would end the command in the middle; if one has already come, refuses.
// Signals that were ignored before, such as by nohup, remain ignored.
void Outputs::hold_signals() {
  sigset_t pending{};
  for (const int each : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction now {};
    (void)::sigaction(each, nullptr, &now);
    if (now.sa_handler != SIG_IGN) (void)::sigaddset(&held_, each);
  }
  (void)::pthread_sigmask(SIG_BLOCK, &held_, nullptr);
  (void)::sigpending(&pending);
  for (const int each : {SIGINT, SIGTERM, SIGHUP}) {
    if (::sigismember(&held_, each) == 0 || ::sigismember(&pending, each) == 0) continue;
    refuse("stopped by {}: nothing was written", ::strsignal(each));
  }
}

// A signal that came in the meantime ends the command here.
void Outputs::release_signals() {
  (void)::pthread_sigmask(SIG_UNBLOCK, &held_, nullptr);
  (void)::sigemptyset(&held_);
}

void Outputs::add(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  check_output(path);
  hold_signals();
  const auto place = place_of(path);
  for (const File& other : files_) {
    if (place_of(other.path) == place) {
      refuse("{}: would be written twice by this command: expected another name", path.string());
    }
  }
  std::string temporary = path.string() + ".part-XXXXXX";
  const int file = ::mkstemp(temporary.data());
  if (file < 0) refuse("{}: cannot be written: {}", path.string(), std::strerror(errno));
  files_.push_back({path, temporary});
  const bool good = follow_umask(file) && write_all(file, bytes);
  const int error = errno;
  ::close(file);
  if (!good) refuse("{}: cannot be written: {}", path.string(), std::strerror(error));
}

void Outputs::add(const std::filesystem::path& path, std::string_view text) {
  add(path, std::as_bytes(std::span(text)));
}

void Outputs::add_folder(const std::filesystem::path& path) {
  check_output_folder(path);
  hold_signals();
  std::error_code error;
  std::filesystem::path missing = std::filesystem::absolute(path).lexically_normal();
  if (!missing.has_filename()) missing = missing.parent_path();  // "folder/"
  std::vector<std::filesystem::path> fresh;
  while (!std::filesystem::exists(missing, error)) {
    fresh.insert(fresh.begin(), missing);
    missing = missing.parent_path();
  }
  for (const auto& each : fresh) {
    if (!std::filesystem::create_directory(each, error)) {
      refuse("{}: cannot be made: {}", each.string(), error.message());
    }
    folders_.push_back(each);
  }
}

void Outputs::remove(const std::filesystem::path& path) {
  removed_.push_back(path);
}

// Exchanges the new file with an older one, so that a later failure can exchange them back.
bool Outputs::name(File& file) {
  file.replaced = ::renameat2(AT_FDCWD, file.temporary.c_str(), AT_FDCWD, file.path.c_str(),
                              RENAME_EXCHANGE) == 0;
  if (!file.replaced && errno != ENOENT) return name_beside(file);
  file.named = file.replaced || ::rename(file.temporary.c_str(), file.path.c_str()) == 0;
  return file.named;
}

// On a file system that cannot exchange files an older one gets a second name first, or another
// one where it may have only one.
bool Outputs::name_beside(File& file) {
  const std::string older = file.temporary + ".old";
  const bool kept = ::link(file.path.c_str(), older.c_str()) == 0 ||
                    (errno != ENOENT && ::rename(file.path.c_str(), older.c_str()) == 0);
  if (!kept && errno != ENOENT) return false;
  file.named = ::rename(file.temporary.c_str(), file.path.c_str()) == 0;
  const int error = errno;
  if (kept && file.named) {
    file.temporary = older;
    file.replaced = true;
  } else if (kept) {
    ::rename(older.c_str(), file.path.c_str());  // does nothing if both are names of one file
    ::unlink(older.c_str());
  }
  errno = error;
  return file.named;
}

void Outputs::commit() {
  hold_signals();
  for (File& file : files_) {
    if (name(file)) continue;
    refuse("{}: cannot be written: {}", file.path.string(), std::strerror(errno));
  }
  for (const File& file : files_) {
    if (file.replaced) ::unlink(file.temporary.c_str());
  }
  std::error_code error;
  for (const auto& path : removed_) std::filesystem::remove(path, error);
  files_.clear();
  folders_.clear();
  release_signals();
}

void Outputs::take_back() {
  for (const File& file : files_) {
    if (file.replaced) ::rename(file.temporary.c_str(), file.path.c_str());
    if (!file.replaced) ::unlink(file.named ? file.path.c_str() : file.temporary.c_str());
  }
  for (auto each = folders_.rbegin(); each != folders_.rend(); ++each) ::rmdir(each->c_str());
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  Outputs one;
  one.add(path, text);
  one.commit();
}

}  // namespace stylet::offline
