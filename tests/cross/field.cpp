// SPDX-License-Identifier: Apache-2.0
// The first field that differs between two snapshots of a recorded insertion, by the kernel's own
// table of fields. A snapshot is the hexadecimal text that `replay CASE state TICK` prints, on any
// target. Exits with 0 if they are equal, 1 if they differ, 2 if they cannot be compared.
//
// usage: stylet_field ORGAN_FILE CASE_FILE SNAPSHOT SNAPSHOT
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "case.h"
#include "session.h"

namespace stylet::test {
namespace {

std::vector<std::byte> read_bytes(const char* path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto* begin = reinterpret_cast<const std::byte*>(text.data());
  return {begin, begin + text.size()};
}

// Words of eight digits, each a little-endian number.
std::vector<std::byte> read_snapshot(const char* path) {
  std::ifstream file(path);
  std::vector<std::byte> bytes;
  std::string line;
  while (file >> line) {
    for (std::size_t at = 0; at + 8 <= line.size(); at += 8) {
      const unsigned long word = std::stoul(line.substr(at, 8), nullptr, 16);
      for (unsigned shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<std::byte>(word >> shift));
      }
    }
  }
  return bytes;
}

int compare(char** argv) {
  const auto opened = open_organ(read_bytes(argv[1]));
  const std::vector<std::byte> bytes = read_bytes(argv[2]);
  Case recorded{};
  if (!open_case(bytes, recorded)) {
    std::fprintf(stderr, "%s: not a recorded insertion\n", argv[2]);
    return 2;
  }
  std::vector<Session> sessions;
  for (const char* path : {argv[3], argv[4]}) {
    Session& session = sessions.emplace_back(make_session(opened->organ, *recorded.config));
    if (set_obstacles(session.kernel, recorded.obstacles) != Status::kOk ||
        restore(session.kernel, read_snapshot(path)) != Status::kOk) {
      std::fprintf(stderr, "%s: not a snapshot of this organ and case\n", path);
      return 2;
    }
  }
  const Difference found = difference(sessions[0].kernel, sessions[1].kernel);
  if (found.field == nullptr) {
    std::puts("equal");
    return 0;
  }
  std::printf("%s[%llu]\n", found.field, static_cast<unsigned long long>(found.index));
  return 1;
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("expected: stylet_field ORGAN_FILE CASE_FILE SNAPSHOT SNAPSHOT\n", stderr);
    return 2;
  }
  return stylet::test::compare(argv);
}
