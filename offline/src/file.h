// SPDX-License-Identifier: GPL-3.0-or-later
// Whole files in and out, and their SHA-256. What goes wrong is refused with one line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace stylet::bake {

std::string read_file(const std::filesystem::path& path);

// All or nothing: the bytes go to a temporary beside `path`, which takes the name only when they
// are complete and on the disk.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

std::string hex_of(std::span<const std::uint8_t> bytes);
std::string sha256_hex(std::string_view bytes);

// The sum of a file lies beside it under this ending, in the format of sha256sum.
constexpr const char* kSumEnding = ".sha256";
void write_sum(const std::filesystem::path& path, std::span<const std::byte> bytes);
enum class SumCheck { kNone, kSame, kDiffers };
SumCheck check_sum(const std::filesystem::path& path, std::string_view bytes);

}  // namespace stylet::bake
