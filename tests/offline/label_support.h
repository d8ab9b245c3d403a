// SPDX-License-Identifier: Apache-2.0
// For tests of label readers: the line with which a file is refused, and packed bytes.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <string>

#include "base/refusal.h"
#include "maps/label_map.h"

namespace stylet::test {

// The refusal, in one line; empty: the file is read.
inline std::string refusal_of(const std::filesystem::path& path) {
  try {
    (void)offline::read_label_map(path);
  } catch (const offline::Refusal& refused) {
    EXPECT_EQ(std::string(refused.what()).find('\n'), std::string::npos) << refused.what();
    return refused.what();
  }
  return "";
}

// Bytes in gzip's format; with a window of MAX_WBITS in zlib's.
inline std::string deflated(const std::string& bytes, int window = 16 + MAX_WBITS) {
  std::string out(compressBound(bytes.size()) + 32, '\0');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace stylet::test
