// SPDX-License-Identifier: Apache-2.0
// A damaged organ file is either opened or refused with a reason, and never crashes the program; an
// opened one keeps its promises.
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/refusal.h"
#include "meshes/phantom.h"
#include "offline_support.h"
#include "report/info.h"

namespace stylet::test {
namespace {

std::vector<std::byte> small_organ() {
  offline::BuildOptions options;
  options.held = offline::parse_regions(offline::kDefaultFix, {1});
  return build_quietly({input_of(offline::block_phantom({0.02, 0.015, 0.01}, 0.005), 1)}, options)
      .bytes;
}

// True if refused; the refusal must be one line with a place.
bool refused(std::span<const std::byte> bytes) {
  try {
    (void)offline::open_organ("a.organ", bytes);
    return false;
  } catch (const offline::Refusal& refusal) {
    const std::string what = refusal.what();
    EXPECT_TRUE(what.starts_with("a.organ: ")) << what;
    EXPECT_NE(what.find("expected"), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return true;
  }
}

// Reads every value that a tick would use as an index.
void walk(const Organ& organ) {
  std::size_t voxels = 0;
  for (const OrganRun& run : organ.runs) voxels += run.count;
  ASSERT_EQ(voxels, organ.voxel_count);
  for (const std::uint8_t m : organ.voxel_material) ASSERT_LT(m, organ.material_count);
  for (const OrganVertex& v : organ.vertices) ASSERT_LT(v.voxel, organ.voxel_count);
  for (const OrganTriangle& t : organ.triangles) {
    ASSERT_LT(std::max({t.a, t.b, t.c}), organ.vertices.size());
  }
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    ASSERT_NE(organ_material(organ, i).name, nullptr);
  }
}

TEST(Damage, EveryCutIsRefused) {
  const std::vector<std::byte> whole = small_organ();
  ASSERT_FALSE(refused(whole));
  for (std::size_t size = 0; size < whole.size(); size += size < 256 ? 1 : 37) {
    // A separate copy, so that a read behind its end is one behind the allocation.
    const std::vector<std::byte> cut(whole.begin(), whole.begin() + static_cast<long>(size));
    ASSERT_TRUE(refused(cut)) << size;
  }
}

// The file is refused for its structure, its values, its checksum or because it has none; and a
// file that the kernel opens causes no crash.
TEST(Damage, EveryFlippedByteIsRefused) {
  std::vector<std::byte> bytes = small_organ();
  std::size_t by_the_sum = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    for (const std::byte mask : {std::byte{0xFF}, std::byte{0x80}, std::byte{0x01}}) {
      bytes[i] ^= mask;
      Organ organ;
      EXPECT_TRUE(refused(bytes)) << i;
      if (organ_open(bytes, organ) == Status::kOk) {
        ++by_the_sum;
        walk(organ);
        (void)offline::organ_text(offline::organ_facts(organ, bytes));
      }
      bytes[i] ^= mask;
    }
  }
  EXPECT_GT(by_the_sum, bytes.size() / 10);
}

TEST(Damage, WordsSetToExtremesDoNotCrash) {
  std::vector<std::byte> bytes = small_organ();
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    std::byte saved[4];
    std::memcpy(saved, bytes.data() + i, 4);
    for (const std::uint32_t word : {0U, 1U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU, 0x7FC00000U}) {
      std::memcpy(bytes.data() + i, &word, 4);
      Organ organ;
      (void)refused(bytes);
      if (organ_open(bytes, organ) == Status::kOk) walk(organ);
    }
    std::memcpy(bytes.data() + i, saved, 4);
  }
}

}  // namespace
}  // namespace stylet::test
