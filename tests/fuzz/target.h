// SPDX-License-Identifier: Apache-2.0
// What every fuzz target shares: the entry libFuzzer calls, a reader of the bytes it gives, and the
// way a target says that a promise is broken (the process ends, the input is the evidence).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

// Takes any bytes. Returns 0, and aborts if a promise is broken.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace stylet::test {

// Always on, unlike assert; `what` says which promise is broken.
inline void promise(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

// A refusal must be one printable line.
inline void promise_one_line(std::string_view message) {
  promise(!message.empty(), "a refusal says nothing");
  promise(message.find('\n') == std::string_view::npos, "a refusal is longer than a line");
}

// Reads numbers from the input, and zeros behind its end.
struct Bytes {
  std::span<const std::uint8_t> left;

  bool empty() const { return left.empty(); }
  std::uint8_t byte() {
    if (left.empty()) return 0;
    const std::uint8_t value = left.front();
    left = left.subspan(1);
    return value;
  }
  float small() { return static_cast<float>(static_cast<std::int8_t>(byte())); }  // -128 to 127
  float any_float() {
    std::uint8_t raw[4];
    for (std::uint8_t& each : raw) each = byte();
    float value;
    std::memcpy(&value, raw, sizeof value);
    return value;
  }
};

// A file with these bytes, removed with the object, for readers that need a path.
class InputFile {
 public:
  InputFile(std::span<const std::uint8_t> bytes, const char* suffix);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace stylet::test
