// SPDX-License-Identifier: Apache-2.0
// Files and folders of this machine, or of a captured one, and the notations Linux uses in them.
// Promise: what does not exist or cannot be read gives nullopt, never a default.
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

// The text without blanks and newlines at its end.
std::optional<std::string> read_text(const HostTree& tree, const std::string& path);
bool exists(const HostTree& tree, const std::string& path);
// Sorted; empty if the folder does not exist.
std::vector<std::string> names_in(const HostTree& tree, const std::string& folder);

std::vector<std::string> words_of(const std::string& text);
std::vector<std::string> lines_of(const std::string& text);
// The whole text as a number, hexadecimal if base is 16.
std::optional<std::uint64_t> parse_number(std::string_view text, int base = 10);
// Processors of a list such as "0-1,3". Any other text, "" too, is a list without processors.
std::vector<int> parse_cpu_list(const std::string& text);
bool list_holds(const std::string& cpu_list, int cpu);
// A mask of processors such as "3" or "ffffffff,00000001": hexadecimal, highest processors first.
std::optional<bool> mask_holds(std::string mask, int cpu);
// The word in brackets of a text such as "always [madvise] never"; without brackets the whole text.
std::string chosen(const std::string& text);
// The value of the line "key: value" or "key<tab>: value".
std::optional<std::string> value_of(const std::string& text, std::string_view key);

// A thread, read from its folder in /proc; nullopt if it has ended meanwhile.
struct Task {
  std::string name;
  std::uint64_t priority = 0;  // 0: not real-time
  std::string cpus_allowed;    // list
};
std::optional<Task> read_task(const HostTree& tree, const std::string& folder);

}  // namespace stylet::hal
