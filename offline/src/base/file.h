// SPDX-License-Identifier: GPL-3.0-or-later
// Whole files, and their SHA-256. What goes wrong is refused with one line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace stylet::bake {

std::string read_file(const std::filesystem::path& path);
// By this program, under any name: no output may be it.
bool was_read(const std::filesystem::path& path);

std::string hex_of(std::span<const std::uint8_t> bytes);
std::string sha256_hex(std::string_view bytes);

// The sum of a file lies beside it under this ending, in the format of sha256sum.
constexpr const char* kSumEnding = ".sha256";
std::string sum_line(const std::filesystem::path& path, std::span<const std::byte> bytes);
// Whether there is such a line beside a file, of whatever bytes: anything else is somebody's own.
bool has_sum_line(const std::filesystem::path& path);
enum class SumCheck { kNone, kSame, kDiffers };
SumCheck check_sum(const std::filesystem::path& path, std::string_view bytes);

}  // namespace stylet::bake
