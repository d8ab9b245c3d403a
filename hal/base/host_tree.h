// SPDX-License-Identifier: Apache-2.0
// Files and folders of a machine, or of a captured one, and the notations Linux uses in them.
// Promise: what is not there or cannot be read is none, never a default.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stylet::hal {

struct HostTree {
  std::string root;
};

// Without the blanks and newlines at the end.
std::optional<std::string> read_text(const HostTree& tree, const std::string& path);
bool exists(const HostTree& tree, const std::string& path);
// Sorted; empty where the folder is not there.
std::vector<std::string> names_in(const HostTree& tree, const std::string& folder);

std::vector<std::string> words_of(const std::string& text);
std::vector<std::string> lines_of(const std::string& text);
// The whole text as a number, hexadecimal for base 16.
std::optional<std::uint64_t> parse_number(std::string_view text, int base = 10);
// "0-1,3": processors. Anything else, "" too, is a list without processors.
std::vector<int> parse_cpu_list(const std::string& text);
bool list_holds(const std::string& cpu_list, int cpu);
// "3", "ffffffff,00000001": processors, in hexadecimal, the highest first.
std::optional<bool> mask_holds(std::string mask, int cpu);
// Of "always [madvise] never" the one in brackets, of anything else all.
std::string chosen(const std::string& text);
// The value of the line "key: value" or "key<tab>: value".
std::optional<std::string> value_of(const std::string& text, std::string_view key);

// A thread, from its folder in /proc; none where it has ended meanwhile.
struct Task {
  std::string name;
  std::uint64_t priority = 0;  // 0: not real-time
  std::string cpus_allowed;    // list
};
std::optional<Task> read_task(const HostTree& tree, const std::string& folder);

}  // namespace stylet::hal
