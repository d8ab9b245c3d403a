// SPDX-License-Identifier: Apache-2.0
#include "hal/record/organ_file.h"

#include <fmt/format.h>

#include <fstream>
#include <limits>

#include "hal/base/input_file.h"
#include "stylet/content_sum.h"

namespace stylet::hal {

OrganFile load_organ(const std::string& path) {
  constexpr const char* kExpected = "expected an organ file that stylet-organ made";
  if (const std::string why = why_unreadable(path); !why.empty()) {
    throw LoadError(fmt::format("{}: {}: {}", path, why, kExpected));
  }
  OrganFile file;
  file.path = path;
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
  if (size < 0 || size == std::numeric_limits<std::streamoff>::max()) {
    throw LoadError(fmt::format("{}: cannot be read: {}", path, kExpected));
  }
  file.bytes.resize(static_cast<std::size_t>(size));
  in.seekg(0);
  if (!in.read(reinterpret_cast<char*>(file.bytes.data()), size)) {
    throw LoadError(fmt::format("{}: cannot be read to the end", path));
  }
  OrganRefusal refusal;
  if (const Status status = organ_open(file.bytes, file.organ, &refusal); status != Status::kOk) {
    throw LoadError(fmt::format("{}: {}[{}]: {:g}: {}: expected {}", path, refusal.place,
                                refusal.index, refusal.value, status_name(status),
                                refusal.expected));
  }
  if (!has_its_bytes(file.bytes, file.organ)) {
    throw LoadError(
        fmt::format("{}: content_sha256: not the sum of its bytes, some byte has changed: expected "
                    "the file as stylet-organ wrote it",
                    path));
  }
  return file;
}

}  // namespace stylet::hal
