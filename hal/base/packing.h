// SPDX-License-Identifier: Apache-2.0
// Plain data to bytes and back, between processes of the same program on one machine.
//
// Promise: whatever the bytes are, reading them gives values or throws PackingError, and never
// allocates more than the bytes can fill. Values are not checked: the reader must check them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace stylet::hal {

using Bytes = std::vector<std::byte>;

struct PackingError : std::runtime_error {
  PackingError() : std::runtime_error("a damaged message from another process") {}
};

class Packer {
 public:
  template <typename T>
  requires std::is_trivially_copyable_v<T> Packer& put(const T& value) {
    return put_all(&value, 1);
  }
  template <typename T>
  requires std::is_trivially_copyable_v<T> Packer& put(const std::vector<T>& values) {
    put(std::uint64_t{values.size()});
    return put_all(values.data(), values.size());
  }
  Packer& put(const std::string& text) {
    put(std::uint64_t{text.size()});
    return put_all(text.data(), text.size());
  }
  // For values whose bytes alone are not enough: calls `pack(packer, value)` for each.
  template <typename T, typename Pack>
  Packer& put_each(const std::vector<T>& values, Pack pack) {
    put(std::uint64_t{values.size()});
    for (const T& each : values) pack(*this, each);
    return *this;
  }
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  template <typename T>
  Packer& put_all(const T* first, std::size_t count) {
    const std::size_t before = bytes_.size(), more = count * sizeof(T);
    bytes_.resize(before + more);
    if (more > 0) std::memcpy(&bytes_[before], first, more);
    return *this;
  }
  Bytes bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(std::span<const std::byte> bytes) : left_(bytes) {}

  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void get(T& out) { get_all(&out, 1); }
  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void get(std::vector<T>& out) {
    out.resize(count(sizeof(T)));
    get_all(out.data(), out.size());
  }
  void get(std::string& out) {
    out.resize(count(1));
    get_all(out.data(), out.size());
  }
  template <typename T, typename Unpack>
  void get_each(std::vector<T>& out, Unpack unpack) {
    const std::size_t size = count(1);
    out.clear();
    for (std::size_t i = 0; i < size; ++i) unpack(*this, out.emplace_back());
  }

 private:
  std::size_t count(std::size_t bytes_each) {
    std::uint64_t size = 0;
    get(size);
    if (size > left_.size() / bytes_each) throw PackingError();
    return size;
  }
  template <typename T>
  void get_all(T* out, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes > left_.size()) throw PackingError();
    if (bytes > 0) std::memcpy(static_cast<void*>(out), left_.data(), bytes);
    left_ = left_.subspan(bytes);
  }
  std::span<const std::byte> left_;
};

}  // namespace stylet::hal
