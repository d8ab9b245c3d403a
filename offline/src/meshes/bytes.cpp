// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/bytes.h"

namespace stylet::offline {

void skip_bytes(Bytes& bytes, std::size_t count, std::string_view expected) {
  if (left(bytes) < count) {
    refuse_at({bytes.file, Place::Kind::kByte, bytes.bytes.size()}, "end of file", expected);
  }
  bytes.next += count;
}

}  // namespace stylet::offline
