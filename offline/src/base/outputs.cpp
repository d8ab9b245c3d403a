// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/outputs.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/file.h"
#include "base/refusal.h"
#include "stylet/output_place.h"

namespace stylet::offline {
namespace {

constexpr std::string_view kPart = ".stylet-part-", kOlder = ".old";
constexpr std::size_t kRandomLetters = 6;  // of mkostemp

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
  std::error_code error;
  const auto whole = std::filesystem::absolute(path, error);
  const auto place = std::filesystem::weakly_canonical(whole, error);
  return error ? whole : place;
}

// mkstemp lets only the owner read the file; the umask shall decide what others may do.
bool follow_umask(int file) {
  constexpr mode_t kAllMayWrite = 0666;
  const mode_t mask = ::umask(0);  // can only be read by setting it
  ::umask(mask);
  return ::fchmod(file, kAllMayWrite & ~mask) == 0;
}

// A new file beside `path`. Its lock says that its writer lives. Another command that ends between
// making and locking takes it for a leftover: then again.
int open_temporary(const std::filesystem::path& path, std::string& name_out) {
  for (;;) {
    name_out = path.string() + std::string(kPart) + std::string(kRandomLetters, 'X');
    const int file = ::mkostemp(name_out.data(), O_CLOEXEC);
    if (file < 0) return file;
    (void)::flock(file, LOCK_EX);  // where there are no locks, nothing is taken for a leftover
    struct stat now {};
    if (::fstat(file, &now) != 0 || now.st_nlink > 0) return file;
    ::close(file);
  }
}

// Whether a file's name, less that of the output, is one that open_temporary or name_beside gives.
bool is_part(std::string_view ending) {
  if (!ending.starts_with(kPart)) return false;
  ending.remove_prefix(kPart.size());
  if (ending.ends_with(kOlder)) ending.remove_suffix(kOlder.size());
  return ending.size() == kRandomLetters &&
         std::all_of(ending.begin(), ending.end(),
                     [](unsigned char letter) { return std::isalnum(letter) != 0; });
}

bool remove_without_writer(const std::filesystem::path& part) {
  const int file = ::open(part.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  struct stat now {};
  const bool removed = file >= 0 && ::fstat(file, &now) == 0 && S_ISREG(now.st_mode) &&
                       ::flock(file, LOCK_EX | LOCK_NB) == 0 && ::unlink(part.c_str()) == 0;
  if (file >= 0) ::close(file);
  return removed;
}

// Removes what commands that were killed left beside an output; adds their names.
void remove_leftovers(const std::filesystem::path& path, std::vector<std::string>& names) {
  const std::string name = path.filename().string();
  std::error_code error;
  const auto folder = path.has_parent_path() ? path.parent_path() : ".";
  for (const auto& each : std::filesystem::directory_iterator(folder, error)) {
    const std::string other = each.path().filename().string();
    if (!other.starts_with(name) || !is_part(std::string_view(other).substr(name.size()))) continue;
    const auto part = path.parent_path() / other;
    if (remove_without_writer(part)) names.push_back(part.string());
  }
}

}  // namespace

std::filesystem::path checked_output(const std::filesystem::path& path) {
  const OutputPlace place = output_place(path);
  if (!place.trouble.empty()) refuse("{}: {}", path.string(), place.trouble);
  if (was_read(place.path)) {
    refuse("{}: this command reads this file, too: expected another name for what it writes",
           path.string());
  }
  return place.path;
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
  const std::filesystem::path target = checked_output(path);
  hold_signals();
  const auto place = place_of(target);
  for (const File& other : files_) {
    if (place_of(other.path) == place) {
      refuse("{}: would be written twice by this command: expected another name", path.string());
    }
  }
  std::string temporary;
  const int file = open_temporary(target, temporary);
  if (file < 0) refuse("{}: cannot be written: {}", path.string(), std::strerror(errno));
  files_.push_back({target, temporary, file});
  if (follow_umask(file) && write_all(file, bytes)) return;
  refuse("{}: cannot be written: {}", path.string(), std::strerror(errno));
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
  const std::string older = file.temporary + std::string(kOlder);
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

std::vector<std::string> Outputs::commit() {
  hold_signals();
  for (File& file : files_) {
    if (name(file)) continue;
    refuse("{}: cannot be written: {}", file.path.string(), std::strerror(errno));
  }
  for (const File& file : files_) {
    if (file.replaced) ::unlink(file.temporary.c_str());
  }
  std::error_code error;
  std::vector<std::string> leftovers;
  for (const auto& path : removed_) {
    std::filesystem::remove(path, error);
    remove_leftovers(path, leftovers);
  }
  for (const File& file : files_) {
    remove_leftovers(file.path, leftovers);
    ::close(file.lock);
  }
  files_.clear();
  folders_.clear();
  release_signals();
  return leftovers;
}

void Outputs::take_back() {
  for (const File& file : files_) {
    if (file.replaced) ::rename(file.temporary.c_str(), file.path.c_str());
    if (!file.replaced) ::unlink(file.named ? file.path.c_str() : file.temporary.c_str());
    ::close(file.lock);
  }
  for (auto each = folders_.rbegin(); each != folders_.rend(); ++each) ::rmdir(each->c_str());
}

std::vector<std::string> write_file(const std::filesystem::path& path, std::string_view text) {
  Outputs one;
  one.add(path, text);
  return one.commit();
}

}  // namespace stylet::offline
