// SPDX-License-Identifier: Apache-2.0
// The C interface: every function gives what its C++ counterpart gives, bit for bit.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <vector>

#include "session.h"
#include "stylet/stylet_c.h"

namespace stylet::test {
namespace {

struct Plain {
  std::unique_ptr<OpenOrgan> opened = block_organ(4, 4, 4);
  stylet_organ organ = {};
  stylet_config config = {};
  stylet_sizes need = {};
  Block model, state, scratch;
  stylet_kernel kernel = {};

  Plain() {
    EXPECT_EQ(stylet_organ_open(opened->bytes.data(), opened->bytes.size(), &organ), 0);
    stylet_default_config(&config);
    EXPECT_EQ(stylet_kernel_sizes(&organ, &config, &need), 0);
    model = make_block(need.model_bytes);
    state = make_block(need.state_bytes);
    scratch = make_block(need.scratch_bytes);
    EXPECT_EQ(create(need.state_bytes), 0);
  }
  std::uint16_t create(std::size_t state_bytes) {
    return stylet_kernel_create(&organ, &config, model.bytes.get(), need.model_bytes,
                                state.bytes.get(), state_bytes, scratch.bytes.get(),
                                need.scratch_bytes, &kernel);
  }
};

stylet_obstacle_config ball() {
  ObstacleConfig config;
  make_sphere(config, 2e-3F);
  config.pose.position_m = {0.01F, 0.01F, 0.005F};
  config.stiffness_n_per_m = 1000;
  config.largest_force_n = 10;
  return std::bit_cast<stylet_obstacle_config>(config);
}

TEST(CApi, NamesAndNumbers) {
  EXPECT_EQ(stylet_c_version(), static_cast<std::uint32_t>(STYLET_C_VERSION));
  for (const Status status :
       {Status::kOk, Status::kOrganTooSmall, Status::kOrganNotAnOrganFile,
        Status::kOrganVersionUnknown, Status::kOrganStructureDamaged, Status::kOrganValueOutOfRange,
        Status::kOrganIndexOutOfRange, Status::kOrganSizesDisagree, Status::kOrganOrderWrong,
        Status::kOrganTooLarge, Status::kConfigValueOutOfRange, Status::kObstaclesTooLate,
        Status::kMemoryTooSmall, Status::kMemoryNotAligned, Status::kSnapshotDoesNotMatch,
        Status::kSnapshotDamaged}) {
    const char* name = stylet_status_name(static_cast<std::uint16_t>(status));
    EXPECT_STREQ(name, status_name(status));
    EXPECT_STRNE(name, stylet_status_name(999));
  }
  const char* const kinds[] = {"contact", "release", "puncture", "re-entry",
                               "exit",    "layer",   "obstacle", "unknown"};
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_STREQ(stylet_event_name(i), kinds[i]);
}

TEST(CApi, TipIsThatOfTheConfiguration) {
  Plain c;
  EXPECT_EQ(c.config.needle[0].tip_half_angle_rad, NeedleConfig{}.tip_half_angle_rad);
  c.config.needle[0].tip_half_angle_rad = kMaxTipHalfAngleRad;
  EXPECT_EQ(c.create(c.need.state_bytes), 0);
  c.config.needle[0].tip_half_angle_rad = 0;
  EXPECT_EQ(c.create(c.need.state_bytes),
            static_cast<std::uint16_t>(Status::kConfigValueOutOfRange));
}

TEST(CApi, RefusalsAreTheStatus) {
  Plain c;
  stylet_organ other = {};
  EXPECT_EQ(stylet_organ_open(c.opened->bytes.data(), 8, &other),
            static_cast<std::uint16_t>(Status::kOrganTooSmall));
  EXPECT_EQ(c.create(c.need.state_bytes - 1), static_cast<std::uint16_t>(Status::kMemoryTooSmall));
  stylet_config bad = c.config;
  bad.substeps = 0;
  stylet_sizes need = {};
  EXPECT_EQ(stylet_kernel_sizes(&c.organ, &bad, &need),
            static_cast<std::uint16_t>(Status::kConfigValueOutOfRange));
  bad = c.config;
  bad.inertia = 2;
  EXPECT_EQ(stylet_kernel_sizes(&c.organ, &bad, &need),
            static_cast<std::uint16_t>(Status::kConfigValueOutOfRange));
  stylet_obstacle_config obstacle = ball();
  obstacle.friction = -1;
  EXPECT_EQ(stylet_kernel_set_obstacles(&c.kernel, &obstacle, 1),
            static_cast<std::uint16_t>(Status::kConfigValueOutOfRange));
}

TEST(CApi, SameInsertionAsInCpp) {
  Plain c;
  Session cpp = make_session(c.opened->organ, Config{});
  const stylet_obstacle_config obstacle = ball();
  const auto same = std::bit_cast<ObstacleConfig>(obstacle);
  ASSERT_EQ(stylet_kernel_set_obstacles(&c.kernel, &obstacle, 1), 0);
  ASSERT_EQ(set_obstacles(cpp.kernel, {&same, 1}), Status::kOk);
  const Script script = block_script(c.opened->organ, Config{});
  for (std::uint64_t i = 0; i < 1500; ++i) {
    const Input input = scripted_input(script, i);
    const auto plain = std::bit_cast<stylet_input>(input);
    stylet_output out = {};
    if (i % 2 == 0) {
      stylet_kernel_tick(&c.kernel, &plain, &out);
    } else {
      stylet_kernel_tick_all(&c.kernel, &plain, &out, 1);
    }
    const Output expected = tick(cpp.kernel, input);
    ASSERT_EQ(std::memcmp(&out.force_n, &expected.force_n, sizeof out.force_n), 0) << i;
    ASSERT_EQ(out.tick, expected.tick);
  }
  EXPECT_EQ(stylet_kernel_hash(&c.kernel), hash(cpp.kernel));
  std::array<stylet_event, kMaxEvents> events_c = {};
  std::array<Event, kMaxEvents> events_cpp = {};
  ASSERT_EQ(stylet_kernel_events(&c.kernel, events_c.data(), kMaxEvents),
            events(cpp.kernel, events_cpp));
  EXPECT_EQ(std::memcmp(events_c.data(), events_cpp.data(), sizeof events_c), 0);
  std::vector<stylet_vec3> places(c.opened->organ.vertices.size());
  std::vector<Vec3> expected(places.size());
  const auto count = static_cast<std::uint32_t>(places.size());
  ASSERT_EQ(stylet_kernel_surface(&c.kernel, places.data(), count), count);
  ASSERT_EQ(surface(cpp.kernel, expected), count);
  EXPECT_EQ(std::memcmp(places.data(), expected.data(), count * sizeof(Vec3)), 0);
}

TEST(CApi, SnapshotResetRestore) {
  Plain c;
  const Script script = block_script(c.opened->organ, Config{});
  const auto advance = [&](std::uint64_t first, std::uint64_t behind) {
    for (std::uint64_t i = first; i < behind; ++i) {
      const auto input = std::bit_cast<stylet_input>(scripted_input(script, i));
      stylet_output out = {};
      stylet_kernel_tick(&c.kernel, &input, &out);
    }
  };
  const std::uint64_t fresh = stylet_kernel_hash(&c.kernel);
  advance(0, 800);
  const std::uint64_t then = stylet_kernel_hash(&c.kernel);
  EXPECT_NE(then, fresh);
  std::vector<std::byte> bytes(stylet_kernel_snapshot_bytes(&c.kernel));
  EXPECT_NE(stylet_kernel_snapshot(&c.kernel, bytes.data(), bytes.size() - 1), 0);
  ASSERT_EQ(stylet_kernel_snapshot(&c.kernel, bytes.data(), bytes.size()), 0);
  stylet_kernel_reset(&c.kernel);
  EXPECT_EQ(stylet_kernel_hash(&c.kernel), fresh);
  EXPECT_NE(stylet_kernel_restore(&c.kernel, bytes.data(), bytes.size() - 1), 0);
  ASSERT_EQ(stylet_kernel_restore(&c.kernel, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(stylet_kernel_hash(&c.kernel), then);
}

}  // namespace
}  // namespace stylet::test
