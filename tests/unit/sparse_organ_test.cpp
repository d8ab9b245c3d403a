// SPDX-License-Identifier: Apache-2.0
// Voxels far apart: what they cost, and that no count wraps.
#include "sparse_organ.h"

#include <gtest/gtest.h>

#include "session.h"

namespace stylet::test {
namespace {

// Rows of two voxels `apart`, as many in a plane as need be for `planes`.
std::vector<format::Run> rows_of_two(std::uint16_t rows, std::uint16_t planes,
                                     std::uint16_t apart) {
  std::vector<format::Run> runs;
  for (std::uint16_t z = 0; z < planes; ++z) {
    for (std::uint16_t y = 0; y < rows; ++y) {
      runs.emplace_back(std::uint16_t{0}, y, z, std::uint16_t{1});
      runs.emplace_back(apart, y, z, std::uint16_t{1});
    }
  }
  return runs;
}

Status sizes_of(const std::vector<format::Run>& runs, Sizes& need) {
  const auto opened = open_organ(organ_of_runs(runs));
  return sizes(opened->organ, Config{}, need);
}

// From first to last voxel these rows are 64 G and 4.3 G long: more than 32 bits count.
TEST(SparseOrgan, CountsDoNotWrap) {
  for (const auto& runs : {rows_of_two(1024, 960, 65534), rows_of_two(1024, 64, 65534)}) {
    Sizes need = {};
    EXPECT_EQ(sizes_of(runs, need), Status::kOrganTooLarge);
  }
}

}  // namespace
}  // namespace stylet::test
