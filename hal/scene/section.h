// SPDX-License-Identifier: Apache-2.0
// Section: one table of a TOML file. It is read key by key, and each value is checked.
//
// Promise: every error throws SceneError with one line "file:line: key: value: what is
// allowed"; finish() refuses keys that were not read. Units: those of the file.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hal/scene/scene.h"
#include "stylet/toml_text.h"

namespace stylet::hal {

// Throws SceneError if the text is not TOML.
toml::table parse_toml(std::string_view text, const std::string& file);
// The whole file as text; `kind` is for the message if it cannot be read.
std::string read_text(const std::string& path, const char* kind);

class Section {
 public:
  // `file` and `table` must outlive the section. Without a table every key is missing.
  Section(const std::string& file, const toml::table* table, std::string name)
      : file_(file), table_(table), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string& key, const std::string& allowed) const;
  bool there() const { return table_ != nullptr; }
  bool has(const std::string& key) const { return find(key) != nullptr; }
  const toml::node* get(const std::string& key);  // may be null

  double number(const std::string& key, double fallback, double low, double high);
  double needed_number(const std::string& key, double low, double high);
  std::int64_t integer(const std::string& key, std::int64_t fallback, std::int64_t low,
                       std::int64_t high);
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  std::string choice(const std::string& key, const std::string& fallback,
                     const std::vector<const char*>& allowed);

  template <std::size_t N>
  std::array<double, N> numbers(const std::string& key, std::array<double, N> fallback, double low,
                                double high) {
    const toml::node* node = get(key);
    return node == nullptr ? fallback : list<N>(key, *node, low, high);
  }

  // A list of `least` to `most` points; empty if the key is missing.
  std::vector<std::array<double, 3>> points(const std::string& key, std::size_t least,
                                            std::size_t most, double low, double high);

  Section table(const std::string& key);
  std::vector<Section> tables(const std::string& key);
  void finish() const;

 private:
  const toml::node* find(const std::string& key) const {
    return table_ != nullptr ? table_->get(key) : nullptr;
  }
  std::string full(const std::string& key) const { return name_.empty() ? key : name_ + "." + key; }
  double checked(const std::string& key, const toml::node& node, double low, double high) const;

  template <std::size_t N>
  std::array<double, N> list(const std::string& key, const toml::node& node, double low,
                             double high) const {
    const toml::array* found = node.as_array();
    if (found == nullptr || found->size() != N) fail(key, fmt::format("a list of {} numbers", N));
    std::array<double, N> values{};
    for (std::size_t i = 0; i < N; ++i) values[i] = checked(key, *found->get(i), low, high);
    return values;
  }

  const std::string& file_;
  const toml::table* table_;
  std::string name_;
  std::set<std::string> known_;
};

inline float si(double value, double unit) {
  return static_cast<float>(value * unit);
}

inline Vec3 si(const std::array<double, 3>& value, double unit) {
  return {si(value[0], unit), si(value[1], unit), si(value[2], unit)};
}

}  // namespace stylet::hal
