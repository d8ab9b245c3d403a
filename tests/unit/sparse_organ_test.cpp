// SPDX-License-Identifier: Apache-2.0
// Voxels far apart cost memory and time only for themselves, not for the space between them, and no
// count overflows.
#include "sparse_organ.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "lattice/tiles.h"
#include "lattice/voxel.h"
#include "organ/runs.h"
#include "promises.h"
#include "session.h"
#include "set_speed.h"
#include "state/layout.h"
#include "stylet/limits.h"
#include "tick_work.h"

namespace stylet::test {
namespace {

std::uint32_t below(std::mt19937_64& random, std::uint32_t limit) {
  return static_cast<std::uint32_t>(random() % limit);
}

std::uint64_t total(const Sizes& s) {
  return std::uint64_t{s.model_bytes} + s.state_bytes + s.scratch_bytes;
}

Sizes sizes_of(const Organ& organ) {
  Sizes need = {};
  EXPECT_EQ(sizes(organ, Config{}, need), Status::kOk);
  return need;
}

std::uint64_t bytes_of_one_voxel() {
  return total(sizes_of(open_organ(organ_of_runs({format::Run(0, 0, 0, 1)}))->organ));
}

void expect_bounded(const Organ& organ, const char* what) {
  const std::uint64_t most =
      bytes_of_one_voxel() + std::uint64_t{kMaxBytesPerVoxel} * organ.voxel_count;
  EXPECT_LE(total(sizes_of(organ)), most) << what << ", " << organ.voxel_count << " voxels";
}

// ---- what hostile files claim -------------------------------------------------------------------

// Rows of two voxels `apart`.
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

// If everything from the first voxel to the last were stored, the arrays would have 64 G, 4.3 G and
// 66 M elements, and those of the plates (2 m apart in voxels of 1 mm) 0.5 G.
TEST(SparseOrgan, ClaimedSizesCostNothing) {
  expect_bounded(open_organ(organ_of_runs(rows_of_two(1024, 960, 65534)))->organ, "983040 rows");
  expect_bounded(open_organ(organ_of_runs(rows_of_two(1024, 64, 65534)))->organ, "65536 rows");
  expect_bounded(open_organ(organ_of_runs(rows_of_two(1, 1000, 65534)))->organ, "1000 rows");
  expect_bounded(open_organ(organ_of_runs(rows_of_two(491, 491, 2000)))->organ, "two plates");
}

// Each of these voxels has corners in as many tiles as possible (lattice/tiles.h), all in one
// plane, whose arrays each pass keeps.
TEST(SparseOrgan, LoneVoxelsAcrossTilesAreBounded) {
  for (const std::uint32_t apart : {8U, 16U, 24U}) {
    std::vector<format::Run> runs;
    for (std::uint32_t y = 0; y < 40; y += 2) {
      for (std::uint32_t x = 7; x < 4000; x += apart) {
        runs.emplace_back(static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                          std::uint16_t{0}, std::uint16_t{1});
      }
    }
    expect_bounded(open_organ(organ_of_runs(runs))->organ, "across tiles");
  }
}

TEST(SparseOrgan, RowsFromEndToEndRun) {
  const auto opened = open_organ(organ_of_runs(rows_of_two(1024, 64, 65534)));
  Session session = make_session(opened->organ, Config{});
  View view = view_of(session.kernel);
  const Row& far = view.model.row[view.model.head->counts.rows - 1];
  set_speed(view, far.node[0], {0.1F, 0, 0});
  for (int i = 0; i < 3; ++i) {
    const Output out = tick(session.kernel, Input{});
    EXPECT_EQ(broken_promise(session.kernel, {&out, 1}), nullptr);
  }
  EXPECT_NE(view.state.ux[far.node[0]], 0.0F);
  EXPECT_EQ(view.state.ux[view.model.row[0].node[0]], 0.0F);
}

// ---- drawn organs -------------------------------------------------------------------------------

// Random runs (x, count) at (z, y) that do not touch each other.
using Cells = std::map<std::tuple<std::uint16_t, std::uint16_t, std::uint16_t>, std::uint16_t>;

std::vector<format::Run> runs_of(const Cells& cells) {
  std::vector<format::Run> runs;
  std::uint32_t end = 0;
  for (const auto& [at, count] : cells) {
    const auto [z, y, x] = at;
    const bool same = !runs.empty() && runs.back().y() == y && runs.back().z() == z;
    if (same && x <= end) continue;
    runs.emplace_back(x, y, z, count);
    end = std::uint32_t{x} + count;
  }
  return runs;
}

struct Shape {
  std::uint32_t runs;
  std::uint32_t size[3], longest, step;  // in x
};

std::vector<format::Run> draw(std::mt19937_64& random, const Shape& shape) {
  Cells cells;
  for (std::uint32_t i = 0; i < shape.runs; ++i) {
    const auto count = static_cast<std::uint16_t>(1 + below(random, shape.longest));
    const auto x =
        static_cast<std::uint16_t>(below(random, shape.size[0] / shape.step) * shape.step);
    const auto y = static_cast<std::uint16_t>(below(random, shape.size[1]));
    const auto z = static_cast<std::uint16_t>(below(random, shape.size[2]));
    if (x + count < 65535) cells[{z, y, x}] = count;
  }
  return runs_of(cells);
}

// Far rows and near ones; combs on either side of the length of holes at which a row is cut in two;
// sheets of single voxels; single planes and lines.
constexpr Shape kShapes[] = {
    {400, {65000, 240, 240}, 40, 1}, {400, {65000, 4000, 4000}, 3, 1}, {3000, {900, 1, 1}, 2, 1},
    {2000, {16000, 1, 1}, 1, 8},     {2000, {18000, 1, 1}, 1, 9},      {2000, {16000, 9, 9}, 1, 8},
    {900, {1, 65000, 200}, 1, 1},    {900, {1, 240, 65000}, 1, 1},     {900, {30, 30, 30}, 6, 1},
    {3000, {500, 60, 60}, 30, 1},    {60, {65000, 1, 65000}, 200, 1},
};

TEST(SparseOrgan, MemoryIsProportionalToTheVoxels) {
  std::mt19937_64 random(1971);
  for (const Shape& shape : kShapes) {
    for (int i = 0; i < 4; ++i) {
      const auto opened = open_organ(organ_of_runs(draw(random, shape)));
      expect_bounded(opened->organ, "drawn");
    }
  }
}

// (slot, side of the line, node below, node above), of the plane.
using Sent = std::vector<std::array<std::uint32_t, 4>>;

Sent sent(const View& view, std::uint32_t plane_index, std::uint32_t list) {
  const Plane& plane = view.model.plane[plane_index];
  const Window* const windows = list == 0 ? view.model.window8 : view.model.window16;
  Sent all;
  std::uint32_t low = 0, high = 0;
  for (std::uint32_t i = plane.window_begin[list]; i < plane.window_end[list]; ++i) {
    const Window& w = windows[i];
    EXPECT_TRUE(i == plane.window_begin[list] || (w.low > low && w.high > high)) << "out of order";
    low = w.low;
    high = w.high;
    for (std::uint32_t lane = 0; lane < 8U << list; ++lane) {
      for (std::uint32_t side = 0; side < 2; ++side) {
        if (((w.lanes[side] >> lane) & 1U) == 0) continue;
        all.push_back(
            {static_cast<std::uint32_t>(w.slot[side]) + lane, side, w.low + lane, w.high + lane});
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

Sent wanted(const View& view, std::uint32_t plane_index) {
  const Plane &plane = view.model.plane[plane_index], &next = view.model.plane[plane_index + 1];
  Sent all;
  for (std::uint32_t r = plane.row_begin; r < next.row_begin; ++r) {
    const Row& row = view.model.row[r];
    for (std::uint32_t i = 0; i <= row.count; ++i) {
      for (std::uint32_t side = 0; side < 2; ++side) {  // a row is behind the line of its own y
        all.push_back({row.slot + i - plane.slot_begin, side,
                       row.node[1 - side] + i - plane.particle_begin,
                       row.node[3 - side] + i - next.particle_begin});
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

// ---- tiles of the filter's passes ---------------------------------------------------------------

// (slot, which of a row's lines of nodes, particle): a voxel takes from the first node of each line
// and from the next one, which is the first of the next slot.
using Taken = std::vector<std::array<std::uint32_t, 3>>;

// The slot or particle, by its index in the lattice, at each place of a plane's array.
std::map<std::uint32_t, std::uint32_t> placed(const View& view, std::uint32_t begin,
                                              std::uint32_t end, std::uint32_t plane_begin) {
  std::map<std::uint32_t, std::uint32_t> out;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Piece& piece = view.model.piece[i];
    for (std::uint32_t lane = 0; lane < kTile; ++lane) {
      if (((piece.lanes >> lane) & 1U) == 0) continue;
      const auto at = static_cast<std::int64_t>(plane_begin) + piece.at + lane;
      const std::uint32_t place = (i - begin + 1) * kTileFloats + lane;
      EXPECT_TRUE(out.emplace(place, static_cast<std::uint32_t>(at)).second);
    }
  }
  return out;
}
std::map<std::uint32_t, std::uint32_t> placed_nodes(const View& view, const Plane& plane) {
  return placed(view, plane.tiles.node, plane.tiles.voxel, plane.particle_begin);
}
std::map<std::uint32_t, std::uint32_t> placed_slots(const View& view, const Plane& plane) {
  return placed(view, plane.tiles.voxel, plane.tiles.end, plane.slot_begin);
}

Taken taken_by_voxels(const View& view) {
  Taken all;
  for (std::uint32_t z = 0; z < view.model.head->counts.planes; ++z) {
    const Plane& plane = view.model.plane[z];
    const auto slots = placed_slots(view, plane);
    const auto low = placed_nodes(view, plane), high = placed_nodes(view, (&plane)[1]);
    for (const auto& [place, slot] : slots) {
      const Tile& tile = view.model.tile[plane.tiles.voxel + place / kTileFloats - 1];
      for (std::uint32_t line = 0; line < 4; ++line) {
        all.push_back(
            {slot, line, (line < 2 ? low : high).at(tile.from[line] + place % kTileFloats)});
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

Taken taken_by_nodes(const View& view) {
  Taken all;
  for (std::uint32_t z = 0; z <= view.model.head->counts.planes; ++z) {
    const Plane& plane = view.model.plane[z];
    const auto nodes = placed_nodes(view, plane), above = placed_slots(view, plane);
    const auto below = z > 0 ? placed_slots(view, (&plane)[-1]) : decltype(above){};
    for (const auto& [place, particle] : nodes) {
      const Tile& tile = view.model.tile[plane.tiles.node + place / kTileFloats - 1];
      for (std::uint32_t from = 0; from < 4; ++from) {
        const auto& slots = from < 2 ? below : above;
        const auto slot = slots.find(tile.from[from] + place % kTileFloats);
        if (tile.from[from] == 0 || slot == slots.end()) continue;
        all.push_back({slot->second, 3 - from, particle});
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

Taken taken_by_rows(const View& view) {
  Taken all;
  for (std::uint32_t r = 0; r < view.model.head->counts.rows; ++r) {
    const Row& row = view.model.row[r];
    for (std::uint32_t i = 0; i <= row.count; ++i) {
      for (std::uint32_t line = 0; line < 4; ++line) {
        all.push_back({row.slot + i, line, row.node[line] + i});
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Nodes that are marked as ready take nothing from later voxels.
void expect_ready(const View& view, const Plane& plane) {
  for (std::uint32_t i = plane.tiles.voxel; i < plane.tiles.end; ++i) {
    const std::uint32_t place = (i - plane.tiles.voxel + 1) * kTileFloats;
    const std::uint32_t ready = view.model.tile[i].ready;
    ASSERT_LE(ready, plane.tiles.voxel - plane.tiles.node);
    for (std::uint32_t node = 0; node < ready; ++node) {
      const Tile& tile = view.model.tile[plane.tiles.node + node];
      ASSERT_LE(std::max(tile.from[2], tile.from[3]), place);
    }
  }
}

TEST(SparseOrgan, TilesTakeFromEveryNodeAndVoxelOnce) {
  std::mt19937_64 random(99);
  for (const Shape& shape : kShapes) {
    const auto opened = open_organ(organ_of_runs(draw(random, shape)));
    const Session session = make_session(opened->organ, Config{});
    const View view = view_of(session.kernel);
    const Taken wanted = taken_by_rows(view);
    EXPECT_EQ(taken_by_voxels(view), wanted);
    EXPECT_EQ(taken_by_nodes(view), wanted);
    for (std::uint32_t z = 0; z < view.model.head->counts.planes; ++z) {
      expect_ready(view, view.model.plane[z]);
    }
  }
}

// ---- what is found ------------------------------------------------------------------------------

// Every voxel is found where it is, and none elsewhere.
TEST(SparseOrgan, EveryVoxelIsFound) {
  std::mt19937_64 random(77);
  for (const Shape& shape : kShapes) {
    const std::vector<format::Run> runs = draw(random, shape);
    const auto opened = open_organ(organ_of_runs(runs));
    const Session session = make_session(opened->organ, Config{});
    View view = view_of(session.kernel);
    std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> all;
    const auto found = [&](std::int32_t x, std::uint32_t y, std::uint32_t z) {
      const float edge = opened->organ.voxel_edge_m;
      const Vec3 middle = {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F,
                           static_cast<float>(z) + 0.5F};
      return inside_lattice(view.model, edge * middle);
    };
    for (const format::Run& run : runs) {
      for (std::uint32_t x = run.x(); x < std::uint32_t{run.x()} + run.count(); ++x) {
        all.insert({x, run.y(), run.z()});
        EXPECT_TRUE(found(static_cast<std::int32_t>(x), run.y(), run.z())) << x;
      }
    }
    for (int i = 0; i < 3000; ++i) {  // near a run, or anywhere
      const format::Run& run = runs[random() % runs.size()];
      const auto x = static_cast<std::int32_t>(run.x() + below(random, 80)) - 40;
      const auto y = (run.y() + below(random, 3)) % opened->organ.size_y;
      const auto z = (run.z() + below(random, 3)) % opened->organ.size_z;
      const bool there = x >= 0 && all.count({static_cast<std::uint32_t>(x), y, z}) > 0;
      EXPECT_EQ(found(x, y, z), there) << x << ' ' << y << ' ' << z;
    }
  }
}

// So are voxels and nodes of the file, which stores only runs.
TEST(SparseOrgan, EveryVoxelAndNodeOfTheFileIsFound) {
  std::mt19937_64 random(78);
  for (int round = 0; round < 50; ++round) {
    constexpr std::uint16_t kSpan = 9;
    std::vector<format::Run> runs;
    std::set<std::array<std::uint32_t, 3>> voxels, nodes;
    const std::uint32_t often = 2 + below(random, 40);
    for (std::uint16_t z = 0; z < kSpan; ++z) {
      for (std::uint16_t y = 0; y < kSpan; ++y) {
        for (std::uint16_t x = 0; x < kSpan; ++x) {
          if (below(random, often) != 0 && (x != 8 || y != 8 || z != 8)) continue;
          if (voxels.count({x - 1U, y, z}) > 0) {
            const format::Run last = runs.back();
            runs.back() = {last.x(), y, z, static_cast<std::uint16_t>(last.count() + 1)};
          } else {
            runs.emplace_back(x, y, z, std::uint16_t{1});
          }
          voxels.insert({x, y, z});
          for (std::uint32_t corner = 0; corner < 8; ++corner) {
            nodes.insert({x + (corner & 1U), y + (corner >> 1U & 1U), z + (corner >> 2U)});
          }
        }
      }
    }
    const auto opened = open_organ(organ_of_runs(runs));
    const Session session = make_session(opened->organ, Config{});
    View view = view_of(session.kernel);
    for (std::uint32_t z = 0; z <= kSpan; ++z) {
      for (std::uint32_t y = 0; y <= kSpan; ++y) {
        for (std::uint32_t x = 0; x <= kSpan; ++x) {
          const bool there = voxels.count({x, y, z}) > 0;
          ASSERT_EQ(has_voxel(opened->organ, {x, x + 1}, y, z), there) << x << ' ' << y << ' ' << z;
          ASSERT_EQ(has_node(opened->organ, x, y, z), nodes.count({x, y, z}) > 0)
              << x << ' ' << y << ' ' << z;
          if (y == kSpan || z == kSpan) continue;
          const Vec3 middle = {static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F,
                               static_cast<float>(z) + 0.5F};
          ASSERT_EQ(inside_lattice(view.model, opened->organ.voxel_edge_m * middle), there)
              << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
}

// Windows are in rising order, the nodes of each window are in line, and each node of a row gets
// what the row sends exactly once.
TEST(SparseOrgan, WindowsReachEveryNodeOnce) {
  std::mt19937_64 random(8);
  for (const Shape& shape : kShapes) {
    const auto opened = open_organ(organ_of_runs(draw(random, shape)));
    const Session session = make_session(opened->organ, Config{});
    View view = view_of(session.kernel);
    for (std::uint32_t list = 0; list < 2; ++list) {
      for (std::uint32_t p = 0; p < view.model.head->counts.planes; ++p) {
        EXPECT_EQ(sent(view, p, list), wanted(view, p)) << list << ", plane " << p;
      }
    }
  }
}

// Runs that share nothing with each other: each has a slot for every voxel and one behind them,
// four rows of nodes, and windows on the lines at either side.
TEST(SparseOrgan, CountsOfRunsApart) {
  std::mt19937_64 random(5);
  for (int draws = 0; draws < 20; ++draws) {
    std::vector<format::Run> runs;
    std::uint64_t slots = 0, nodes = 0, windows[2] = {}, planes = 0;
    const auto lanes = [](std::uint64_t n) { return (n + kLanes - 1) / kLanes * kLanes; };
    std::uint32_t z = 0;
    for (std::uint32_t plane = 1 + below(random, 6); plane > 0; --plane) {
      std::uint64_t own_slots = 1, own_nodes = 0;
      for (std::uint32_t row = 1 + below(random, 4), y = 0; row > 0;
           --row, y += 2 + below(random, 900)) {
        for (std::uint32_t run = 1 + below(random, 5), x = 0; run > 0; --run) {
          const std::uint32_t count = 1 + below(random, 60);
          runs.emplace_back(static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                            static_cast<std::uint16_t>(z), static_cast<std::uint16_t>(count));
          x += count + kGap + below(random, 3000);
          own_slots += count + 1;
          own_nodes += 2 * (count + 1);
          windows[0] += 2 * ((count + 8) / 8);
          windows[1] += 2 * ((count + 16) / 16);
        }
      }
      slots += lanes(own_slots) + kLanes;  // and those of an empty plane behind it
      nodes += 2 * lanes(kLanes + own_nodes);
      planes += 2;
      z += 2 + below(random, 300);
    }
    const auto opened = open_organ(organ_of_runs(runs));
    const Session session = make_session(opened->organ, Config{});
    const Counts& c = counts_of(session.kernel);
    EXPECT_EQ(c.rows, runs.size());
    EXPECT_EQ(c.planes, planes - 1) << "nothing behind the last";
    EXPECT_EQ(c.slots, slots - kLanes);
    EXPECT_EQ(c.particles, nodes + 2 * kLanes);
    EXPECT_EQ(c.windows[0], windows[0]);
    EXPECT_EQ(c.windows[1], windows[1]);
  }
}

// ---- a body beside another ----------------------------------------------------------------------

// A bean of 26 x 20 x 36 voxels: a ball with a part of another ball removed, without a hole in any
// row.
bool in_bean(int x, int y, int z) {
  const auto square = [](double a, double b, double c) { return a * a + b * b + c * c; };
  const double at[3] = {(x + 0.5 - 13) / 13, (y + 0.5 - 10) / 10, (z + 0.5 - 18) / 18};
  return square(at[0], at[1], at[2]) < 1 && square(at[0] - 1.1, at[1], at[2] * 1.5) > 0.36;
}

struct Offset {
  std::uint16_t x, y, z;
};

TinyOrgan beans(const Offset* second) {
  TinyOrgan tiny;
  tiny.voxel_edge_m = 2e-3F;
  const Offset at = second != nullptr ? *second : Offset{0, 0, 0};
  tiny.nx = static_cast<std::uint16_t>(26 + at.x);
  tiny.ny = static_cast<std::uint16_t>(20 + at.y);
  tiny.nz = static_cast<std::uint16_t>(36 + at.z);
  tiny.fixed_faces = kLowZ;
  tiny.materials[0].youngs_modulus_pa = 50000;
  tiny.materials[0].puncture_force_n = 0.05F;
  tiny.inside = [at](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    return in_bean(x, y, z) || in_bean(x - at.x, y - at.y, z - at.z);
  };
  return tiny;
}

// Apart along one axis or more, by a few voxels to a few hundred.
Offset draw_offset(std::mt19937_64& random) {
  const auto far = [&](std::uint32_t size) {
    return static_cast<std::uint16_t>(size + 1 + below(random, below(random, 2) == 0 ? 20 : 130));
  };
  const std::uint32_t axes = 1 + below(random, 7);
  return {(axes & 1U) != 0 ? far(26) : static_cast<std::uint16_t>(below(random, 9)),
          (axes & 2U) != 0 ? far(20) : static_cast<std::uint16_t>(below(random, 9)),
          (axes & 4U) != 0 ? far(36) : static_cast<std::uint16_t>(below(random, 9))};
}

// The parts of the arrays that a step goes through, each times its price in instructions.
std::uint64_t step_of(const Counts& c) {
  return c.slots * kPrices[kSlots].instructions + c.particles * kPrices[kNodes].instructions +
         c.rows * kPrices[kRows].instructions;
}

TEST(SparseOrgan, TwoBodiesCostTwiceAsMuch) {
  std::mt19937_64 random(2026);
  const auto alone = open_organ(tiny_organ(beans(nullptr)));
  const Session one = make_session(alone->organ, Config{});
  for (int i = 0; i < 8; ++i) {
    const Offset at = draw_offset(random);
    const auto opened = open_organ(tiny_organ(beans(&at)));
    ASSERT_EQ(opened->organ.voxel_count, 2 * alone->organ.voxel_count);
    const Session two = make_session(opened->organ, Config{});
    const auto what = testing::Message() << at.x << ' ' << at.y << ' ' << at.z;
    EXPECT_LE(static_cast<double>(total(two.kernel.sizes)),
              2.2 * static_cast<double>(total(one.kernel.sizes)))
        << what;
    EXPECT_LE(10 * step_of(counts_of(two.kernel)), 22 * step_of(counts_of(one.kernel))) << what;
  }
}

Input into_the_first(const Config& config, int tick) {
  const int depth = std::min(tick, 800 - tick / 3);
  const Vec3 tip = {0.0271F, 0.0183F, 0.085F - 6e-5F * static_cast<float>(depth)};
  return {{{tip.x, tip.y, tip.z + config.needle[0].length_m}, {1, 0, 0, 0}}, 1};
}

// The first body moves in the same way, bit for bit, whatever lies far away from it.
TEST(SparseOrgan, DistantBodiesHaveNoEffect) {
  std::mt19937_64 random(42);
  const auto alone = open_organ(tiny_organ(beans(nullptr)));
  Config config;
  config.needle[0].unit_m = 2e-3F;
  for (int i = 0; i < 3; ++i) {
    Offset at = draw_offset(random);
    at.x = static_cast<std::uint16_t>(at.x + 40);
    const auto opened = open_organ(tiny_organ(beans(&at)));
    Session one = make_session(alone->organ, config), two = make_session(opened->organ, config);
    const std::uint32_t helpers = static_cast<std::uint32_t>(i) % 3;
    const Block team = make_block(team_bytes(two.kernel, helpers));
    ASSERT_EQ(set_team(two.kernel, helpers, team.span()), Status::kOk);
    float largest_n = 0;
    for (int t = 0; t < 700; ++t) {
      const Output a = tick(one.kernel, into_the_first(config, t));
      const Output b = tick(two.kernel, into_the_first(config, t));
      largest_n = std::max(largest_n, std::fabs(a.force_n.z));
      ASSERT_EQ(std::memcmp(&a.force_n, &b.force_n, sizeof(a.force_n)), 0)
          << "tick " << t << ": " << at.x << ' ' << at.y << ' ' << at.z;
    }
    EXPECT_GT(largest_n, 0.1F);
    EXPECT_GT(stats(one.kernel).constraint_particles.used_max, 3U);
  }
}

}  // namespace
}  // namespace stylet::test
