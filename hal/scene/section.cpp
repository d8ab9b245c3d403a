// SPDX-License-Identifier: Apache-2.0
#include "hal/scene/section.h"

#include <algorithm>
#include <sstream>

#include "hal/base/input_file.h"

namespace stylet::hal {
namespace {

// Lists are written here: toml++ 3.3 can write them too, but to find the width it first converts
// the logarithm of each number to an integer, which cannot hold it for numbers below 1.
std::string value_text(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (const toml::array* list = node.as_array()) {
    std::string text;
    for (const toml::node& each : *list) text += (text.empty() ? "[ " : ", ") + value_text(each);
    return text.empty() ? "[]" : text + " ]";
  }
  std::ostringstream out;
  node.visit([&out](const auto& n) { out << n; });
  return out.str();
}

// Text quoted from a scene may contain line ends and other control characters.
std::string one_line(std::string text) {
  const auto control = [](unsigned char c) { return c < ' '; };
  std::replace_if(text.begin(), text.end(), control, '?');
  return text;
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
  try {
    return parse_toml_text(text, file);
  } catch (const TomlFault& fault) {
    throw SceneError(one_line(fmt::format("{}:{}: not TOML: {}", file, fault.line, fault.what())));
  }
}

std::string read_text(const std::string& path, const char* kind) {
  constexpr std::size_t kMostBytes = std::size_t{16} << 20U;  // as recordings hold
  std::string text;
  if (const std::string why = read_whole(path, kMostBytes, text); !why.empty()) {
    throw SceneError(fmt::format("{}: {}: expected {} (TOML)", path, why, kind));
  }
  return text;
}

void Section::fail(const std::string& key, const std::string& allowed) const {
  const toml::node* node = find(key);
  const auto line = node != nullptr     ? node->source().begin.line
                    : table_ != nullptr ? table_->source().begin.line
                                        : 1U;
  throw SceneError(one_line(fmt::format("{}:{}: {}: {}: expected {}", file_, line, full(key),
                                        node != nullptr ? value_text(*node) : "missing", allowed)));
}

const toml::node* Section::get(const std::string& key) {
  known_.insert(key);
  return find(key);
}

double Section::number(const std::string& key, double fallback, double low, double high) {
  const toml::node* node = get(key);
  return node == nullptr ? fallback : checked(key, *node, low, high);
}

double Section::needed_number(const std::string& key, double low, double high) {
  const toml::node* node = get(key);
  if (node == nullptr) fail(key, fmt::format("a number from {} to {}", low, high));
  return checked(key, *node, low, high);
}

std::int64_t Section::integer(const std::string& key, std::int64_t fallback, std::int64_t low,
                              std::int64_t high) {
  const toml::node* node = get(key);
  if (node == nullptr) return fallback;
  const auto value = node->value_exact<std::int64_t>();
  if (!value || *value < low || *value > high) {
    fail(key, fmt::format("a whole number from {} to {}", low, high));
  }
  return *value;
}

bool Section::flag(const std::string& key, bool fallback) {
  const toml::node* node = get(key);
  if (node == nullptr) return fallback;
  const auto value = node->value_exact<bool>();
  if (!value) fail(key, "true or false");
  return *value;
}

std::string Section::text(const std::string& key, const std::string& fallback) {
  const toml::node* node = get(key);
  if (node == nullptr) return fallback;
  const auto value = node->value_exact<std::string>();
  if (!value) fail(key, "a text in quotes");
  return *value;
}

std::string Section::choice(const std::string& key, const std::string& fallback,
                            const std::vector<const char*>& allowed) {
  const std::string value = text(key, fallback);
  std::string all;
  for (const char* each : allowed) {
    if (value == each) return value;
    all += fmt::format("{}\"{}\"", all.empty() ? "" : " or ", each);
  }
  fail(key, all);
}

std::vector<std::array<double, 3>> Section::points(const std::string& key, std::size_t least,
                                                   std::size_t most, double low, double high) {
  std::vector<std::array<double, 3>> result;
  const toml::node* node = get(key);
  if (node == nullptr) return result;
  const toml::array* found = node->as_array();
  if (found == nullptr || found->size() < least || found->size() > most) {
    fail(key, fmt::format("a list of {} to {} points [x, y, z]", least, most));
  }
  for (const toml::node& each : *found) result.push_back(list<3>(key, each, low, high));
  return result;
}

Section Section::table(const std::string& key) {
  const toml::node* node = get(key);
  if (node != nullptr && !node->is_table()) fail(key, "a table");
  return {file_, node != nullptr ? node->as_table() : nullptr, full(key)};
}

std::vector<Section> Section::tables(const std::string& key) {
  std::vector<Section> result;
  const toml::node* node = get(key);
  if (node == nullptr) return result;
  if (!node->is_array_of_tables()) fail(key, fmt::format("tables, each headed [[{}]]", full(key)));
  for (const toml::node& each : *node->as_array()) {
    result.emplace_back(file_, each.as_table(), full(key));
  }
  return result;
}

void Section::finish() const {
  if (table_ == nullptr) return;
  for (const auto& [key, node] : *table_) {
    if (known_.count(std::string(key.str())) == 0) {
      std::string all;
      for (const std::string& each : known_) all += (all.empty() ? "" : ", ") + each;
      fail(std::string(key.str()), "one of the known keys " + all);
    }
  }
}

double Section::checked(const std::string& key, const toml::node& node, double low,
                        double high) const {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !(*value >= low && *value <= high)) {
    fail(key, fmt::format("a number from {} to {}", low, high));
  }
  return *value;
}

}  // namespace stylet::hal
