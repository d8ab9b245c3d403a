// SPDX-License-Identifier: Apache-2.0
#include "hal/base/host_tree.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <sstream>

namespace stylet::hal {
namespace {

#ifdef _WIN32
constexpr int kToRead = O_RDONLY | O_BINARY | O_NOINHERIT;
#else
constexpr int kToRead = O_RDONLY | O_CLOEXEC;
#endif
constexpr const char* kBlanks = " \t\r\n";

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

}  // namespace

// Uses read(2): a stream cannot tell an empty file from one that refuses to be read.
std::optional<std::string> read_text(const HostTree& tree, const std::string& path) {
  const int file = open((tree.root + path).c_str(), kToRead);
  if (file < 0) return std::nullopt;
  std::string text;
  std::array<char, 4096> block;
  ssize_t count = 0;
  while ((count = read(file, block.data(), block.size())) > 0) {
    text.append(block.data(), static_cast<std::size_t>(count));
  }
  close(file);
  if (count < 0) return std::nullopt;
  return trimmed(text);
}

bool exists(const HostTree& tree, const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(tree.root + path, ignored);
}

std::vector<std::string> names_in(const HostTree& tree, const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(tree.root + folder, error), end;
       !error && entry != end; entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::optional<std::uint64_t> parse_number(std::string_view text, int base) {
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number, base);
  if (error != std::errc() || stop != end) return std::nullopt;
  return number;
}

std::vector<int> parse_cpu_list(const std::string& text) {
  constexpr std::uint64_t kMostProcessors = 65536;
  std::vector<int> cpus;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    const std::size_t dash = part.find('-');
    const auto first = parse_number(part.substr(0, dash));
    const auto last = dash == std::string::npos ? first : parse_number(part.substr(dash + 1));
    if (!first || !last || *last >= kMostProcessors) continue;
    for (std::uint64_t cpu = *first; cpu <= *last; ++cpu) cpus.push_back(static_cast<int>(cpu));
  }
  return cpus;
}

bool list_holds(const std::string& cpu_list, int cpu) {
  const std::vector<int> cpus = parse_cpu_list(cpu_list);
  return std::find(cpus.begin(), cpus.end(), cpu) != cpus.end();
}

std::optional<bool> mask_holds(std::string mask, int cpu) {
  std::erase(mask, ',');
  if (mask.empty() || mask.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
    return std::nullopt;
  }
  const auto digit = static_cast<std::size_t>(cpu / 4);
  if (digit >= mask.size()) return false;
  const auto bits = parse_number(mask.substr(mask.size() - 1 - digit, 1), 16);
  return (*bits >> static_cast<unsigned>(cpu % 4) & 1U) != 0;
}

std::string chosen(const std::string& text) {
  const std::size_t open = text.find('['), close = text.find(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return text;
  return text.substr(open + 1, close - open - 1);
}

std::optional<std::string> value_of(const std::string& text, std::string_view key) {
  for (const std::string& line : lines_of(text)) {
    const std::size_t colon = line.find(':');
    if (colon != std::string::npos && trimmed(line.substr(0, colon)) == key) {
      return trimmed(line.substr(colon + 1));
    }
  }
  return std::nullopt;
}

std::optional<Task> read_task(const HostTree& tree, const std::string& folder) {
  constexpr std::size_t kPriority = 37;  // words after the name, which may hold anything
  const std::string stat = read_text(tree, folder + "/stat").value_or("");
  const std::size_t open = stat.find('('), close = stat.rfind(')');
  if (open == std::string::npos || close == std::string::npos) return std::nullopt;
  const std::vector<std::string> words = words_of(stat.substr(close + 1));
  if (words.size() <= kPriority) return std::nullopt;
  const std::string status = read_text(tree, folder + "/status").value_or("");
  return Task{stat.substr(open + 1, close - open - 1), parse_number(words[kPriority]).value_or(0),
              value_of(status, "Cpus_allowed_list").value_or("")};
}

}  // namespace stylet::hal
