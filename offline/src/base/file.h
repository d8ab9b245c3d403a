// SPDX-License-Identifier: GPL-3.0-or-later
// Reads whole files and computes their SHA-256. Failures are refused with one line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace stylet::offline {

constexpr std::uintmax_t kMaxFileBytes = 4ULL << 30U;
std::string read_file(const std::filesystem::path& path);
// Whether this program has read the file, under any name; then no output may replace it.
bool was_read(const std::filesystem::path& path);

std::string hex_of(std::span<const std::uint8_t> bytes);
std::string sha256_hex(std::string_view bytes);

// A file's checksum lies beside it, in a file with this ending and in the format of sha256sum.
constexpr const char* kSumEnding = ".sha256";
std::string sum_line(const std::filesystem::path& path, std::span<const std::byte> bytes);
// Whether a checksum line lies beside the file, right or wrong; any other content is the user's.
bool has_sum_line(const std::filesystem::path& path);
enum class SumCheck { kNone, kSame, kDiffers };
SumCheck check_sum(const std::filesystem::path& path, std::string_view bytes);

}  // namespace stylet::offline
