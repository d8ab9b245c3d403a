// SPDX-License-Identifier: Apache-2.0
// Lattice and sphere tree on random numbers, against their definitions: which input a cell belongs
// to; which cells are kept, their numbers, and which are skin; where vertices lie; and what each
// sphere contains.
#include "voxels/lattice.h"

#include <algorithm>
#include <map>
#include <numbers>

#include "asset/sphere_tree.h"
#include "offline_support.h"
#include "organ_places.h"
#include "random_bodies.h"
#include "voxels/sample_cell.h"
#include "voxels/sheets.h"

namespace stylet::test {
namespace {

using offline::Claims;
using offline::Grid;
using offline::Vec;

constexpr std::uint64_t kAll = ~std::uint64_t{0};

struct At {
  std::uint32_t x, y, z;
};

Grid drawn_grid(Draw& draw) {
  const auto side = [&] { return static_cast<std::uint32_t>(2 + draw.below(6)); };
  return {{draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)},
          draw.between(0.5, 3),
          {side(), side(), side()}};
}

template <typename Visit>
void each_cell(const Grid& grid, Visit visit) {
  for (std::uint32_t z = 0; z < grid.size[2]; ++z) {
    for (std::uint32_t y = 0; y < grid.size[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.size[0]; ++x) visit(At{x, y, z});
    }
  }
}

std::size_t index_of(const Grid& grid, At at) {
  return at.x + grid.size[0] * (at.y + std::size_t{grid.size[1]} * at.z);
}

std::uint64_t drawn_samples(Draw& draw) {
  const std::size_t kind = draw.below(4);
  std::uint64_t bits = kind == 0 ? 0 : kAll;
  for (unsigned i = 0; i < 64 && kind > 1; ++i) bits &= ~(std::uint64_t{draw.coin()} << i);
  return bits;
}

offline::Occupancy drawn_occupancy(Draw& draw, const Grid& grid) {
  offline::Occupancy drawn;
  each_cell(grid, [&](At) {
    drawn.inside.push_back(drawn_samples(draw));
    drawn.pierced.push_back(draw.below(4) == 0 ? 1 : 0);
  });
  return drawn;
}

int count_of(std::uint64_t bits) {
  int count = 0;
  for (unsigned i = 0; i < 64; ++i) count += (bits >> i & 1U) != 0 ? 1 : 0;
  return count;
}

// Whether an input has samples counts more than its priority, and priority more than size; of equal
// inputs the first has the cell.
TEST(Lattice, ACellBelongsToTheHighestPriorityThatHasSamplesThere) {
  Draw draw(41);
  for (int round = 0; round < 40; ++round) {
    const Grid grid = drawn_grid(draw);
    std::vector<int> priorities;
    for (int i = 0; i < 4; ++i) priorities.push_back(static_cast<int>(draw.below(3)) - 1);
    Claims claims = offline::no_claims(grid);
    std::vector<offline::Occupancy> inputs;
    for (std::uint16_t i = 0; i < 4; ++i) {
      inputs.push_back(drawn_occupancy(draw, grid));
      offline::add_claim(claims, inputs.back(), i, priorities);
    }
    each_cell(grid, [&](At at) {
      const std::size_t cell = index_of(grid, at);
      std::uint64_t inside = 0;
      bool pierced = false;
      int best = -1;
      const auto before = [&](std::size_t a, std::size_t b) {  // a comes before b
        const int of_a = count_of(inputs[a].inside[cell]), of_b = count_of(inputs[b].inside[cell]);
        if ((of_a > 0) != (of_b > 0)) return of_a > 0;
        if (priorities[a] != priorities[b]) return priorities[a] > priorities[b];
        return of_a > of_b;
      };
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        inside |= inputs[i].inside[cell];
        pierced = pierced || inputs[i].pierced[cell] != 0;
        if (inputs[i].inside[cell] == 0 && inputs[i].pierced[cell] == 0) continue;
        if (best < 0 || before(i, static_cast<std::size_t>(best))) best = static_cast<int>(i);
      }
      EXPECT_EQ(claims.inside[cell], inside);
      EXPECT_EQ(claims.pierced[cell] != 0, pierced);
      EXPECT_EQ(offline::is_kept(claims, cell), best >= 0);
      if (best < 0) return;
      EXPECT_EQ(claims.owner[cell], best) << round;
      EXPECT_EQ(claims.owner_fill[cell],
                count_of(inputs[static_cast<unsigned>(best)].inside[cell]));
    });
    // If no single input fills a cell, each input with samples there has its fraction.
    std::map<std::size_t, std::map<int, std::uint64_t>> shares;
    for (const Claims::Share& share : claims.shares) {
      const auto [known, fresh] = shares[share.cell].emplace(share.owner, share.inside);
      EXPECT_EQ(known->second, share.inside);  // however often it occurs
      EXPECT_EQ(share.priority, priorities[share.owner]);
    }
    for (std::size_t cell = 0; cell < claims.inside.size(); ++cell) {
      std::map<int, std::uint64_t> expected;
      for (int i = 0; i < 4; ++i) {
        const std::uint64_t inside = inputs[static_cast<unsigned>(i)].inside[cell];
        if (inside != 0) expected[i] = inside;
      }
      if (expected.size() == 1 && expected.begin()->second == kAll) expected.clear();
      EXPECT_EQ(shares[cell], expected) << round << " " << cell;
    }
  }
}

TEST(Lattice, NumbersTheKeptCellsRowByRow) {
  Draw draw(42);
  for (int round = 0; round < 60; ++round) {
    const Grid grid = drawn_grid(draw);
    Claims claims = offline::no_claims(grid);
    offline::add_claim(claims, drawn_occupancy(draw, grid), 0, {0});
    std::vector<std::uint8_t> cut;
    for (std::size_t i = 0; i < claims.inside.size() && round % 2 == 0; ++i) {
      cut.push_back(draw.below(4) == 0 ? 1 : 0);
    }
    const offline::Lattice lattice = offline::make_lattice(claims, {}, cut);
    std::vector<At> listed;
    for (const OrganRun& run : lattice.runs) {
      for (std::uint32_t i = 0; i < run.count; ++i) listed.push_back({run.x + i, run.y, run.z});
    }
    std::size_t voxel = 0, runs = 0;
    bool goes_on = false;
    each_cell(grid, [&](At at) {
      const std::size_t cell = index_of(grid, at);
      const bool kept = offline::is_kept(claims, cell) && (cut.empty() || cut[cell] == 0);
      if (at.x == 0) goes_on = false;
      if (kept && !goes_on) ++runs;
      goes_on = kept;
      ASSERT_EQ(lattice.voxel_of_cell[cell], kept ? voxel : offline::kNoVoxel);
      if (!kept) return;
      ASSERT_LT(voxel, listed.size());
      EXPECT_EQ(index_of(grid, listed[voxel]), cell);
      EXPECT_EQ(lattice.cell_of_voxel[voxel], cell);
      const double part = count_of(claims.inside[cell]) / 64.0;
      EXPECT_EQ(lattice.fill[voxel], std::max(1.0, std::floor(255 * part + 0.5)));
      ++voxel;
    });
    EXPECT_EQ(listed.size(), voxel);
    EXPECT_EQ(lattice.runs.size(), runs);
    EXPECT_EQ(lattice.fill.size(), voxel);
  }
}

TEST(Lattice, SkinIsEveryBareOrPiercedCellNotAmongFullOnes) {
  Draw draw(43);
  int skin = 0, none = 0;
  for (int round = 0; round < 60; ++round) {
    const Grid grid = drawn_grid(draw);
    Claims claims = offline::no_claims(grid);
    offline::Occupancy drawn = drawn_occupancy(draw, grid);
    // Most cells are full, so that some of them are surrounded by full ones.
    for (std::uint64_t& inside : drawn.inside) inside = draw.below(30) == 0 ? inside : kAll;
    offline::add_claim(claims, drawn, 0, {0});
    each_cell(grid, [&](At at) {
      bool midst = true, bare = false;
      each_cell({{}, 1, {3, 3, 3}}, [&](At by) {
        const At other{at.x + by.x - 1, at.y + by.y - 1, at.z + by.z - 1};  // wraps below 0
        const bool there =
            other.x < grid.size[0] && other.y < grid.size[1] && other.z < grid.size[2];
        const std::size_t cell = there ? index_of(grid, other) : 0;
        midst = midst && there && claims.inside[cell] == kAll;
        const int apart = std::abs(static_cast<int>(by.x) - 1) +
                          std::abs(static_cast<int>(by.y) - 1) +
                          std::abs(static_cast<int>(by.z) - 1);
        bare = bare || (apart == 1 && !(there && offline::is_kept(claims, cell)));
      });
      const bool expected = !midst && (bare || claims.pierced[index_of(grid, at)] != 0);
      EXPECT_EQ(offline::is_skin(claims, at.x, at.y, at.z), expected);
      (expected ? skin : none) += 1;
    });
  }
  EXPECT_GT(skin, 500);
  EXPECT_GT(none, 500);
}

// If two inputs of equal priority fill a cell, lattice and needle have the same tissue there,
// whatever the order of the inputs.
TEST(Lattice, ACellThatTwoInputsFillIsOneTissueAlsoForTheNeedle) {
  Draw draw(46);
  for (int round = 0; round < 6; ++round) {
    std::vector<offline::Input> inputs;
    for (const char* tissue : {"liver", "kidney", "muscle"}) {
      const Vec low{draw.between(0, 0.01), draw.between(0, 0.01), draw.between(0, 0.01)};
      const Vec high{draw.between(0.03, 0.05), draw.between(0.03, 0.05), draw.between(0.03, 0.05)};
      inputs.push_back(input_of(box_mesh(low, high), 1, tissue));
    }
    draw.shuffle(inputs);
    if (round % 2 == 0) inputs.pop_back();
    const offline::Built built = build_quietly(inputs, {});
    const Organ organ = opened(built.bytes);
    const Places places(organ);
    const double edge = static_cast<double>(organ.voxel_edge_m);
    int inside = 0;
    for (std::size_t i = 0; i < places.cells.size(); ++i) {
      const VoxelPlace& c = places.cells[i];
      const Vec middle =
          Vec{static_cast<double>(organ.origin_m.x), static_cast<double>(organ.origin_m.y),
              static_cast<double>(organ.origin_m.z)} +
          Vec{c.x + 0.5, c.y + 0.5, c.z + 0.5} * edge;
      const bool in_all = std::min({middle.x, middle.y, middle.z}) > 0.01 + edge &&
                          std::max({middle.x, middle.y, middle.z}) < 0.03 - edge;
      if (!in_all) continue;
      ++inside;
      EXPECT_EQ(places.material_at(middle), organ.voxel_material[i]) << round;
    }
    EXPECT_GT(inside, 0);
  }
}

// A vertex in a cell that is not kept makes this cell a voxel, of the input that has the most of a
// cell around it.
TEST(Lattice, EmbedsEveryPointToHalfAQuantum) {
  Draw draw(44);
  for (int round = 0; round < 60; ++round) {
    const Grid grid = drawn_grid(draw);
    Claims claims = offline::no_claims(grid);
    for (std::uint16_t i = 0; i < 3; ++i) {
      offline::Occupancy drawn = drawn_occupancy(draw, grid);
      for (std::size_t c = 0; c < drawn.inside.size(); ++c) {
        if (draw.below(3) != 0) drawn.inside[c] = drawn.pierced[c] = 0;
      }
      offline::add_claim(claims, drawn, i, {0, 0, 0});
    }
    const Claims before = claims;
    std::vector<Vec> points;
    for (int i = 0; i < 30; ++i) {
      const Vec at{draw.between(0, grid.size[0]), draw.between(0, grid.size[1]),
                   draw.between(0, grid.size[2])};
      points.push_back(grid.origin_m + at * grid.edge_m);
    }
    const offline::Lattice lattice = offline::make_lattice(claims, points);
    std::vector<offline::Triangle> triangles;
    for (std::uint32_t i = 0; i + 2 < points.size(); i += 3) triangles.push_back({i, i + 1, i + 2});
    const offline::Surface surface = offline::embed({&lattice, 1}, points, triangles);
    ASSERT_EQ(surface.vertices.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const OrganVertex& v = surface.vertices[i];
      const std::size_t cell = lattice.cell_of_voxel[v.voxel];
      const Vec low{static_cast<double>(cell % grid.size[0]),
                    static_cast<double>(cell / grid.size[0] % grid.size[1]),
                    static_cast<double>(cell / grid.size[0] / grid.size[1])};
      const Vec place =
          grid.origin_m + (low + Vec{v.fx / 65535.0, v.fy / 65535.0, v.fz / 65535.0}) * grid.edge_m;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_LE(std::abs(place[axis] - points[i][axis]), grid.edge_m * (0.5 / 65535 + 1e-12));
        EXPECT_NEAR(surface.rest_m[i][axis], place[axis], 1e-12);
      }
      EXPECT_EQ(offline::cell_of(grid, points[i]), cell);
      if (offline::is_kept(before, cell)) continue;
      int most = 0;
      each_cell(grid, [&](At at) {
        if (std::abs(at.x - low.x) > 1 || std::abs(at.y - low.y) > 1 || std::abs(at.z - low.z) > 1)
          return;
        most = std::max<int>(most, before.owner_fill[index_of(grid, at)]);
      });
      bool from_fullest = most == 0;
      each_cell(grid, [&](At at) {
        const std::size_t other = index_of(grid, at);
        if (std::abs(at.x - low.x) > 1 || std::abs(at.y - low.y) > 1 || std::abs(at.z - low.z) > 1)
          return;
        from_fullest = from_fullest || (before.owner_fill[other] == most &&
                                        before.owner[other] == claims.owner[cell]);
      });
      EXPECT_TRUE(from_fullest) << round;
    }
  }
}

// A cell that two voxels share, divided across a random axis, and a triangle along the division, a
// little to either side. Its corners and the triangle itself belong to the voxel below, where its
// body is.
TEST(Lattice, AVertexOfASharedCellBelongsToTheVoxelBelowIt) {
  Draw draw(47);
  for (int round = 0; round < 200; ++round) {
    const std::size_t axis = draw.below(3);
    const bool faces_up = draw.coin();
    offline::Lattice lattice;
    lattice.grid = {{draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)},
                    draw.between(0.002, 0.01),
                    {1, 1, 1}};
    std::uint64_t low_half = 0;
    for (unsigned bit = 0; bit < 64; ++bit) {
      low_half |= std::uint64_t{(bit >> (2 * axis) & 3U) < 2} << bit;
    }
    lattice.voxel_of_cell = {1};
    lattice.cell_of_voxel = {0, 0};
    lattice.shared = {{0, 0, low_half, low_half}, {0, 1, ~low_half, ~low_half}};
    const double turn = draw.between(0, 2 * std::numbers::pi);
    std::vector<Vec> points;
    for (int corner = 0; corner < 3; ++corner) {
      const double at = turn + (faces_up ? 1 : -1) * corner * 2 * std::numbers::pi / 3;
      const double across[3] = {0.5 + draw.between(-0.05, 0.05), 0.5 + 0.4 * std::cos(at),
                                0.5 + 0.4 * std::sin(at)};
      const Vec in_cell{across[(3 - axis) % 3], across[(4 - axis) % 3], across[(5 - axis) % 3]};
      points.push_back(lattice.grid.origin_m + in_cell * lattice.grid.edge_m);
    }
    const offline::Surface surface = offline::embed({&lattice, 1}, points, {{0, 1, 2}});
    const std::uint32_t below = faces_up ? 0 : 1;
    for (const OrganVertex& v : surface.vertices) EXPECT_EQ(v.voxel, below) << round;
    EXPECT_EQ(surface.voxel_of[0], below) << round;
  }
}

// Plates thinner than the distance between them, several through one cell, at random positions and
// angles. Each sub-sample of a cell that voxels share belongs to the voxel whose samples are
// nearest to its middle.
TEST(Lattice, SubSamplesOfASharedCellGoToTheNearestSamples) {
  Draw draw(48);
  offline::SamplePlaces places;
  for (std::uint32_t i = 0; i < 64; ++i) places[i] = offline::sample_point(i);
  int three = 0;
  for (int round = 0; round < 6; ++round) {
    const std::array<Vec, 3> frame = random_frame(draw);
    offline::Mesh plates;
    for (int i = 0; i < 4; ++i) {
      const Vec low{-5 + draw.between(0, 1), -5 + draw.between(0, 1), 1.3 * i};
      append(plates, box_mesh(low, {5, 5, low.z + draw.between(0.6, 0.75)}));
    }
    plates = turned(plates, frame);
    const Grid grid = offline::make_grid(offline::bounds(plates), 1.5);
    Claims claims = offline::no_claims(grid);
    offline::add_claim(claims,
                       offline::voxelize(grid, offline::repair(plates), [](const char*, double) {}),
                       0, {0});
    std::vector<Claims> levels = {claims};
    const offline::Lattice lattice =
        offline::split_parts(levels, places, {offline::make_lattice(levels[0], plates.points)})
            .front();
    std::map<std::size_t, std::vector<offline::SharedCell>> cells;
    for (const offline::SharedCell& each : lattice.shared) cells[each.cell].push_back(each);
    for (const auto& [cell, parts] : cells) {
      std::uint64_t all = 0;
      bool known = true;
      for (const offline::SharedCell& part : parts) {
        EXPECT_EQ(all & part.quarters, 0U);
        all |= part.quarters;
        known = known && part.inside != 0;
      }
      EXPECT_EQ(all, kAll) << round << " " << parts.size();
      three += parts.size() > 2 ? 1 : 0;
      for (unsigned q = 0; q < 64 && known; ++q) {
        const Vec middle = Vec{q % 4 + 0.5, q / 4 % 4 + 0.5, q / 16 + 0.5} * 0.25;
        double nearest = 9, own = 9;
        for (const offline::SharedCell& part : parts) {
          for (unsigned s = 0; s < 64; ++s) {
            if ((part.inside >> s & 1U) == 0) continue;
            const double away = offline::length(places[s] - middle);
            nearest = std::min(nearest, away);
            if ((part.quarters >> q & 1U) != 0) own = std::min(own, away);
          }
        }
        EXPECT_LT(own, nearest + 1e-12) << round;
      }
    }
  }
  EXPECT_GT(three, 0);
}

// ---- spheres ------------------------------------------------------------------------------------

struct DrawnTriangles {
  std::vector<Vec> points;
  std::vector<offline::Triangle> triangles;
  std::vector<std::uint32_t> voxel_of;
};

DrawnTriangles drawn_triangles(Draw& draw) {
  DrawnTriangles drawn;
  const std::size_t count = 1 + draw.below(300), voxels = 1 + draw.below(40);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec at{draw.between(-0.3, 0.1), draw.between(0, 0.2), draw.between(1, 1.2)};
    for (int corner = 0; corner < 3; ++corner) {
      drawn.points.push_back(at + draw.direction() * draw.between(0, 0.02));
    }
    drawn.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    drawn.voxel_of.push_back(static_cast<std::uint32_t>(draw.below(voxels)));
  }
  return drawn;
}

Vec centre_of(const OrganSphere& s) {
  return {static_cast<double>(s.x), static_cast<double>(s.y), static_cast<double>(s.z)};
}

// Possible error of a float of this size and the sums with it, plus the tree's own margin.
constexpr double kRounding = 2e-6;

// The sphere of a leaf: around the middle of its triangles' box, out to the farthest corner.
void expect_leaf(const DrawnTriangles& drawn, const offline::SphereTree& tree,
                 const OrganSphere& s) {
  offline::Box box;
  double farthest = 0;
  const auto each_corner = [&](auto visit) {
    for (std::uint32_t i = s.first; i < s.first + s.count; ++i) {
      for (const std::uint32_t corner : drawn.triangles[tree.order[i]]) visit(drawn.points[corner]);
    }
  };
  each_corner([&](Vec p) { offline::grow(box, p); });
  const Vec middle = (box.low + box.high) * 0.5;
  each_corner([&](Vec p) { farthest = std::max(farthest, offline::length(p - middle)); });
  EXPECT_LT(offline::length(centre_of(s) - middle), kRounding);
  EXPECT_GE(static_cast<double>(s.radius), farthest);
  EXPECT_LT(static_cast<double>(s.radius), farthest + kRounding);
}

// The sphere of two: the larger one if it contains the other, otherwise the smallest around both.
void expect_parent(const OrganSphere& s, const OrganSphere& a, const OrganSphere& b) {
  const double ra = static_cast<double>(a.radius), rb = static_cast<double>(b.radius);
  const double apart = offline::length(centre_of(b) - centre_of(a));
  const double smallest = std::max({ra, rb, (apart + ra + rb) / 2});
  const double radius = static_cast<double>(s.radius);
  EXPECT_LT(radius, smallest + kRounding);
  EXPECT_LE(offline::length(centre_of(a) - centre_of(s)) + ra, radius + 1e-9);
  EXPECT_LE(offline::length(centre_of(b) - centre_of(s)) + rb, radius + 1e-9);
}

TEST(SphereTree, LeavesAndParentsAreAsTightAsTheyCanBe) {
  Draw draw(45);
  for (int round = 0; round < 100; ++round) {
    const DrawnTriangles drawn = drawn_triangles(draw);
    const offline::SphereTree tree =
        offline::sphere_tree(drawn.points, drawn.triangles, drawn.voxel_of);
    std::vector<std::uint32_t> order = tree.order;
    std::sort(order.begin(), order.end());
    for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
    ASSERT_EQ(order.size(), drawn.triangles.size());
    std::map<std::uint32_t, std::size_t> of_voxel;
    for (const std::uint32_t voxel : drawn.voxel_of) ++of_voxel[voxel];
    std::size_t least = 0;  // leaves, each of up to eight triangles
    for (const auto& [voxel, count] : of_voxel) least += (count + 7) / 8;
    std::size_t leaves = 0, covered = 0;
    std::vector<double> depth(tree.nodes.size(), 0);
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      const OrganSphere& s = tree.nodes[i];
      EXPECT_LE(depth[i], 1 + std::log2(static_cast<double>(least)));
      if (s.count == 0) {
        ASSERT_GT(s.first, i);
        ASSERT_LT(s.first + 1, tree.nodes.size());
        depth[s.first] = depth[s.first + 1] = depth[i] + 1;
        expect_parent(s, tree.nodes[s.first], tree.nodes[s.first + 1]);
        continue;
      }
      ++leaves;
      covered += s.count;
      EXPECT_LE(s.count, 8U);
      for (std::uint32_t t = s.first; t < s.first + s.count; ++t) {
        EXPECT_EQ(drawn.voxel_of[tree.order[t]], drawn.voxel_of[tree.order[s.first]]);
      }
      expect_leaf(drawn, tree, s);
    }
    EXPECT_EQ(leaves, least);
    EXPECT_EQ(covered, drawn.triangles.size());
    EXPECT_EQ(tree.nodes.size(), 2 * leaves - 1);
  }
}

}  // namespace
}  // namespace stylet::test
