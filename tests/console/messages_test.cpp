// SPDX-License-Identifier: Apache-2.0
// Frames: deltas rebuild what a key frame says, and the positions in them deform the surface as the
// kernel does. Whatever a page sends that is not a message is refused.
#include "hal/console/messages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "hal/console/limits.h"
#include "tests/hal/rig.h"

namespace stylet::console {
namespace {

// A rig whose needle has gone in for so many ticks.
struct Deformed : hal::Rig {
  explicit Deformed(std::uint64_t ticks) {
    config.ticks = ticks;
    config.hand[0].scripted = true;
    run(device());
    lattice = make_lattice(organ, instance->kernel);
  }

  void go_on(std::uint64_t ticks) {
    config.ticks += ticks;
    run(device());
  }

  Places places() {
    const hal::DisplayState* shown = display->take();
    EXPECT_NE(shown, nullptr);
    Places out;
    if (shown != nullptr) quantise(lattice, shown->moved_m, out);
    return out;
  }

  Lattice lattice;
};

struct Decoded {
  bool key;
  std::size_t changed;
};

// As the page does it.
Decoded take_over(const Bytes& bytes, Places& places) {
  const Frame& frame = *GetMessage(bytes.data())->body_as_Frame();
  const auto& to = *frame.moved_to();
  if (frame.key()) {
    places.assign(to.begin(), to.end());
    return {true, to.size() / 3};
  }
  std::size_t at = 0;
  for (const std::uint32_t particle : *frame.moved_index()) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      places[std::size_t{3} * particle + axis] = to[static_cast<flatbuffers::uoffset_t>(at++)];
    }
  }
  return {false, frame.moved_index()->size()};
}

Bytes frame_of(const hal::DisplayState& state, const Places& now, const Places* sent) {
  const TimingShown timing;
  return frame_message({Activity::Running, &state, &now, sent, {}, {}, &timing});
}

stylet::Vec3 corner_place(const Lattice& lattice, const Places& places, std::uint32_t corner) {
  const std::uint32_t particle = lattice.corners[corner];
  const stylet::Vec3 rest = lattice.rest_m[particle];
  const auto moved = [&](std::size_t axis) {
    return kPositionUnitM * static_cast<float>(places[std::size_t{3} * particle + axis]);
  };
  return {rest.x + moved(0), rest.y + moved(1), rest.z + moved(2)};
}

// The page's way from places to the surface: trilinear in the voxel.
stylet::Vec3 shown_vertex(const Organ& organ, const Lattice& lattice, const Places& places,
                          std::size_t vertex) {
  const OrganVertex& v = organ.vertices[vertex];
  const float f[3] = {static_cast<float>(v.fx) / 65535, static_cast<float>(v.fy) / 65535,
                      static_cast<float>(v.fz) / 65535};
  stylet::Vec3 sum = {};
  for (std::uint32_t c = 0; c < 8; ++c) {
    float weight = 1;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      weight *= ((c >> axis) & 1U) != 0 ? f[axis] : 1 - f[axis];
    }
    const stylet::Vec3 place = corner_place(lattice, places, 8 * v.voxel + c);
    sum = {sum.x + weight * place.x, sum.y + weight * place.y, sum.z + weight * place.z};
  }
  return sum;
}

double distance(stylet::Vec3 a, stylet::Vec3 b) {
  return std::hypot(static_cast<double>(a.x - b.x), static_cast<double>(a.y - b.y),
                    static_cast<double>(a.z - b.z));
}

TEST(Messages, TheSurfaceIsTheKernelsToATenthOfAMillimetre) {
  Deformed rig(100);  // the needle presses a dimple
  const Places places = rig.places();
  std::vector<stylet::Vec3> surface_m(rig.organ.vertices.size());
  ASSERT_EQ(surface(rig.instance->kernel, surface_m), surface_m.size());
  double worst_m = 0, largest_m = 0;
  Places at_rest(places.size());
  for (std::size_t i = 0; i < surface_m.size(); ++i) {
    const stylet::Vec3 shown = shown_vertex(rig.organ, rig.lattice, places, i);
    worst_m = std::max(worst_m, distance(shown, surface_m[i]));
    const stylet::Vec3 rest = shown_vertex(rig.organ, rig.lattice, at_rest, i);
    largest_m = std::max(largest_m, distance(rest, surface_m[i]));
  }
  EXPECT_GT(largest_m, 1e-3);  // the surface is deformed by much more than the allowed error
  EXPECT_LT(worst_m, 1e-4);
  EXPECT_LT(worst_m, 1.0 * static_cast<double>(kPositionUnitM));  // half a unit an axis
}

TEST(Messages, DeltasRebuildTheKeyFrame) {
  Deformed rig(60);
  Places page, sent;
  std::size_t deltas = 0, keys = 0;
  for (int i = 0; i < 12; ++i) {
    const hal::DisplayState* state = rig.display->take();
    ASSERT_NE(state, nullptr);
    Places now;
    quantise(rig.lattice, state->moved_m, now);
    const Decoded decoded = take_over(frame_of(*state, now, &sent), page);
    (decoded.key ? keys : deltas) += 1;
    ASSERT_EQ(page, now) << "frame " << i;
    // A frame of the same state contains no change.
    EXPECT_EQ(take_over(frame_of(*state, now, &now), page).changed, 0U);
    sent = now;
    rig.go_on(i < 6 ? 1 : 16);
  }
  EXPECT_GT(keys, 0U);
  EXPECT_GT(deltas, 0U);
}

TEST(Messages, ParticlesAreOnlyThoseOfVoxels) {
  Deformed rig(1);
  EXPECT_EQ(rig.lattice.rest_m.size(), 125U);  // 5 x 5 x 5 corners of 4 x 4 x 4 voxels
  EXPECT_EQ(rig.lattice.corners.size(), 8U * 64U);
  EXPECT_LT(*std::max_element(rig.lattice.corners.begin(), rig.lattice.corners.end()), 125U);
}

TEST(Messages, RowsAreThinnedWithTheirPeaks) {
  std::vector<Row> rows;
  for (std::uint64_t tick = 1; tick <= 1000; ++tick) {
    const float force = tick == 777 ? 9.0F : 0.001F * static_cast<float>(tick);
    rows.emplace_back(tick, 0, 0, force, 0, 0, 0, 0, 0, 0, 0, 0, 0);
  }
  const std::uint32_t stride = stride_for(rows.size(), 1, 100);
  const std::vector<Row> thinned = thin(rows, 1, stride);
  EXPECT_LE(thinned.size(), 100U);
  EXPECT_GE(thinned.size(), 50U);
  EXPECT_EQ(thinned.front().tick(), 1U);
  const auto peak =
      std::max_element(thinned.begin(), thinned.end(),
                       [](const Row& a, const Row& b) { return a.force_n() < b.force_n(); });
  EXPECT_EQ(peak->tick(), 777U);
  EXPECT_EQ(thin(rows, 1, 1).size(), rows.size());
}

// ---- from a page

template <typename Make>
Bytes page_message(Body type, Make make) {
  flatbuffers::FlatBufferBuilder builder;
  const auto body = make(builder);
  FinishMessageBuffer(builder, CreateMessage(builder, type, body.Union()));
  return builder.Release();
}

std::vector<Bytes> good_messages() {
  std::vector<Bytes> all;
  all.push_back(page_message(Body::Start,
                             [](auto& b) { return CreateStart(b, b.CreateString("A. Trainee")); }));
  all.push_back(page_message(Body::Pause, [](auto& b) { return CreatePause(b); }));
  all.push_back(page_message(
      Body::Choose, [](auto& b) { return CreateChoose(b, b.CreateString("liver-biopsy.toml")); }));
  all.push_back(page_message(Body::Seek, [](auto& b) { return CreateSeek(b, 12345); }));
  all.push_back(page_message(Body::Play, [](auto& b) { return CreatePlay(b, -2.5F); }));
  all.push_back(page_message(Body::AskRows, [](auto& b) { return CreateAskRows(b, 1, 9, 100); }));
  all.push_back(page_message(Body::Pointer, [](auto& b) {
    const Vec3 place(1, 2, 3);
    const Quaternion turn(1, 0, 0, 0);
    return CreatePointer(b, 0, &place, &turn, 1);
  }));
  all.push_back(page_message(Body::Acknowledge, [](auto& b) {
    return CreateAcknowledge(b, 0, b.CreateString("device silent"));
  }));
  return all;
}

std::span<const std::byte> bytes_of(const std::vector<std::byte>& bytes) {
  return bytes;
}
std::vector<std::byte> copied(const Bytes& bytes) {
  const auto* data = reinterpret_cast<const std::byte*>(bytes.data());
  return {data, data + bytes.size()};
}

TEST(Messages, AreReadAsTheyWereMeant) {
  for (const Bytes& each : good_messages()) {
    EXPECT_TRUE(read_message(bytes_of(copied(each))).has_value());
  }
  const auto play = read_message(copied(good_messages()[4]));
  ASSERT_TRUE(play && std::holds_alternative<Order>(*play));
  EXPECT_EQ(std::get<Order>(*play).speed, -2.5F);
}

TEST(Messages, OfTheServerAreNoneOfThePage) {
  EXPECT_FALSE(read_message(copied(refused_message("no"))).has_value());
  EXPECT_FALSE(read_message(copied(marked_message(1, "here", 1))).has_value());
  const Bytes no_place = page_message(Body::Pointer, [](auto& b) { return CreatePointer(b, 0); });
  EXPECT_FALSE(read_message(copied(no_place)).has_value());
  EXPECT_FALSE(read_message({}).has_value());
}

// Whatever the bytes are, reading them ends, and gives a message or a refusal. The bytes end where
// the heap's block does, so that a sanitizer sees any read beyond them.
TEST(Messages, MutatedOnesAreReadOrRefused) {
  std::mt19937 random(20261121);
  const auto below = [&random](std::size_t n) { return random() % std::max<std::size_t>(n, 1); };
  const std::vector<Bytes> good = good_messages();
  std::size_t read = 0, refused = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::byte> bytes = copied(good[below(good.size())]);
    for (std::size_t flips = 1 + below(4); flips > 0; --flips) {
      bytes[below(bytes.size())] = static_cast<std::byte>(random());
    }
    if (below(4) == 0) bytes.resize(below(bytes.size()));
    bytes.shrink_to_fit();
    (read_message(bytes).has_value() ? read : refused) += 1;
  }
  EXPECT_GT(read, 1000U);
  EXPECT_GT(refused, 1000U);
}

}  // namespace
}  // namespace stylet::console
