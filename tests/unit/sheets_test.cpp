// SPDX-License-Identifier: Apache-2.0
// Lattices of several sheets: parts that share cells of space without touching. A block cut into
// two sheets and tied along the cut behaves as the whole block; without ties its halves do not
// influence each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "lattice/voxel.h"
#include "owned_organ.h"
#include "session.h"
#include "set_speed.h"
#include "state/layout.h"

namespace stylet::test {
namespace {

constexpr std::uint16_t kEdge = 4, kRows = kEdge + 1, kCut = 2;
constexpr std::uint64_t kLeft = 0x3333333333333333;  // the sub-samples at the low side of x

std::unique_ptr<Owner> without_surface(const TinyOrgan& tiny) {
  std::unique_ptr<Owner> owner(format::GetOrgan(tiny_organ(tiny).data())->UnPack());
  owner->vertices.clear();
  owner->triangles.clear();
  owner->sphere_nodes.clear();
  return owner;
}

TinyOrgan block() {
  TinyOrgan tiny;
  tiny.nx = tiny.ny = tiny.nz = kEdge;
  tiny.fixed_faces = kLowZ;
  tiny.materials[0].puncture_force_n = 0.05F;
  return tiny;
}

// Voxels up to kCut along x are in one sheet, those beyond it in the others.
std::unique_ptr<Owner> halves(bool tied, std::uint16_t sheets = 2) {
  TinyOrgan tiny = block();
  tiny.ny = static_cast<std::uint16_t>(sheets * kRows);
  tiny.inside = [](std::uint16_t x, std::uint16_t y, std::uint16_t) {
    return y % kRows < kEdge && (y < kRows) == (x < kCut);
  };
  std::unique_ptr<Owner> owner = without_surface(tiny);
  owner->format_version = 2;
  owner->sheets = std::make_unique<format::SheetsT>();
  owner->sheets->rows = kRows;
  for (std::uint16_t z = 0; z <= kEdge && tied; ++z) {
    for (std::uint16_t y = 0; y <= kEdge; ++y) {
      owner->sheets->ties.emplace_back(kCut, static_cast<std::uint16_t>(y + kRows), z, y);
    }
  }
  return owner;
}

// The same, with the surface of the whole block, through which a needle enters.
std::unique_ptr<Owner> halves_with_surface() {
  std::unique_ptr<Owner> owner = halves(true);
  const std::unique_ptr<Owner> whole(format::GetOrgan(tiny_organ(block()).data())->UnPack());
  std::vector<std::uint32_t> number(kEdge * kEdge * kEdge);
  std::uint32_t voxel = 0;
  for (const format::Run& run : owner->runs) {
    for (std::uint32_t x = run.x(); x < 0U + run.x() + run.count(); ++x) {
      number[x + kEdge * (run.y() % kRows) + kEdge * kEdge * run.z()] = voxel++;
    }
  }
  for (const format::Vertex& v : whole->vertices) {
    owner->vertices.emplace_back(number[v.voxel()], v.fx(), v.fy(), v.fz(), 0);
  }
  owner->triangles = whole->triangles;
  owner->sphere_nodes = whole->sphere_nodes;
  return owner;
}

// Two sheets with a voxel each in every cell, half filled: the left half and the right half.
std::unique_ptr<Owner> shared_cells() {
  TinyOrgan tiny = block();
  tiny.ny = 2 * kRows;
  tiny.inside = [](std::uint16_t, std::uint16_t y, std::uint16_t) { return y % kRows < kEdge; };
  std::unique_ptr<Owner> owner = without_surface(tiny);
  owner->format_version = 2;
  owner->sheets = std::make_unique<format::SheetsT>();
  owner->sheets->rows = kRows;
  for (std::uint16_t z = 0; z < kEdge; ++z) {
    for (std::uint16_t y = 0; y < 2 * kRows; ++y) {
      for (std::uint16_t x = 0; x < kEdge && y % kRows < kEdge; ++x) {
        owner->sheets->parts.emplace_back(x, y, z, 0, y < kRows ? kLeft : ~kLeft);
      }
    }
  }
  return owner;
}

std::uint32_t sheet_of(const View& view, std::uint32_t row) {
  const ModelHead& head = *view.model.head;
  return view.model.row[row].y / head.sheet_rows;
}

// Calls visit(sheet, place in space, particle) for the nodes of the lattice.
void each_node(const View& view,
               const std::function<void(std::uint32_t, const Vec3&, std::uint32_t)>& visit) {
  const ModelHead& head = *view.model.head;
  for (std::uint32_t r = 0; r < head.counts.rows; ++r) {
    const Row& row = view.model.row[r];
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      for (std::uint32_t i = 0; i <= row.count; ++i) {
        const Vec3 at = {static_cast<float>(row.x0 + i),
                         static_cast<float>(row.y % head.sheet_rows + (corner & 1U)),
                         static_cast<float>(view.model.plane[row.plane].z + (corner >> 1U))};
        visit(sheet_of(view, r), at, row.node[corner] + i);
      }
    }
  }
}

// A force that differs from place to place, on the nodes for which `pushed` is true.
void push(const View& view, const std::function<bool(const Vec3&)>& pushed) {
  each_node(view, [&](std::uint32_t, const Vec3& at, std::uint32_t particle) {
    if (!pushed(at) || !(view.model.step_per_mass[particle] > 0)) return;
    set_speed(view, particle, {0.01F * at.z + 0.003F * at.y, 0.005F * at.x, -0.002F * at.x * at.y});
  });
}

void let_go(Session& session, int ticks) {
  for (int i = 0; i < ticks; ++i) (void)tick(session.kernel, Input{});
}

TEST(Sheets, TiedHalvesMoveAsTheWhole) {
  const auto whole = packed(*without_surface(block())), cut = packed(*halves(true));
  Session a = make_session(whole->organ, Config{}), b = make_session(cut->organ, Config{});
  View of_whole = view_of(a.kernel), of_cut = view_of(b.kernel);
  const auto everywhere = [](const Vec3&) { return true; };
  push(of_whole, everywhere);
  push(of_cut, everywhere);
  EXPECT_NEAR(energy(a.kernel).kinetic, energy(b.kernel).kinetic, 1e-6 * energy(a.kernel).kinetic);
  let_go(a, 100);
  let_go(b, 100);
  double largest = 0, off = 0;
  each_node(of_whole, [&](std::uint32_t, const Vec3& at, std::uint32_t one) {
    each_node(of_cut, [&](std::uint32_t, const Vec3& there, std::uint32_t other) {
      if (norm(at - there) > 0.1F) return;
      const auto ux = static_cast<double>(of_whole.state.ux[one]);
      largest = std::max(largest, std::fabs(ux));
      off = std::max(off, std::fabs(ux - static_cast<double>(of_cut.state.ux[other])));
    });
  });
  EXPECT_GT(largest, 1e-5);
  EXPECT_LT(off, 1e-4 * largest);
  const double elastic = energy(a.kernel).elastic;
  EXPECT_NEAR(energy(b.kernel).elastic, elastic, 1e-3 * elastic);
}

TEST(Sheets, TiedNodesStayTogetherToTheBit) {
  const auto cut = packed(*halves(true));
  Session session = make_session(cut->organ, Config{});
  View view = view_of(session.kernel);
  push(view, [](const Vec3&) { return true; });
  let_go(session, 50);
  ASSERT_EQ(view.model.head->counts.ties, static_cast<std::uint32_t>(kRows * kRows));
  for (std::uint32_t i = 0; i < view.model.head->counts.ties; ++i) {
    const TiedNode& tie = view.model.tie[i];
    EXPECT_EQ(view.state.ux[tie.node], view.state.ux[tie.representative]);
    EXPECT_EQ(view.state.vz[tie.node], view.state.vz[tie.representative]);
  }
}

double squared(Vec3 v) {
  const auto length = static_cast<double>(norm(v));
  return length * length;
}

// The difference of two bodies as a hand feels it: the difference of their forces, low-passed at 20
// Hz, up to which a hand follows a force (Brooks 1990). So an event that comes a tick later counts
// only by the impulse that it shifts, and a lasting difference counts fully.
struct FeltDifference {
  Vec3 felt_n = {};
  double sum = 0;       // sum of squares over ticks
  double each_sum = 0;  // the same of the ticks' own differences
};
void add_tick(Vec3 off_n, FeltDifference& difference) {
  constexpr float kShare = 1 / 8.0F;  // 1 / (2 pi 20 Hz) is eight ticks
  difference.felt_n = difference.felt_n + kShare * (off_n - difference.felt_n);
  difference.sum += squared(difference.felt_n);
  difference.each_sum += squared(off_n);
}

// Along a cut a needle feels what it would feel in the whole block. On average the forces of the
// two bodies differ no more than those of one body under two hands 0.1 um apart, the worst of
// twenty random ones. (Where the needle stops and punctures, small differences are magnified: those
// of sums in another order, and those of the hand's position. If the bar were the worst of only
// four, the tied halves, which are like one more of them, would be over it by chance at every fifth
// change of the bits. In the very middle of the block, a place of symmetry, any hand beside it goes
// in at another moment; so the place is random, too.)
TEST(Sheets, NeedleInTiedHalvesFeelsTheWhole) {
  std::mt19937 random(3);
  std::vector<Vec3> aside_m(20);
  for (Vec3& each : aside_m) {
    std::normal_distribution<float> way;
    each = {way(random), way(random), way(random)};
    each = 1e-7F / norm(each) * each;
  }
  const auto whole = open_organ(tiny_organ(block())), cut = packed(*halves_with_surface());
  Config config;
  config.needle[0].unit_m = 2e-3F;
  Session a = make_session(whole->organ, config), b = make_session(cut->organ, config);
  std::vector<Session> beside;
  for (std::size_t i = 0; i < aside_m.size(); ++i) {
    beside.push_back(make_session(whole->organ, config));
  }
  Script script = block_script(whole->organ, config);
  std::uniform_real_distribution<float> beside_m(-2e-3F, 2e-3F);
  script.entry_m = script.entry_m + Vec3{beside_m(random), beside_m(random), 0};
  FeltDifference halves_off;
  std::vector<FeltDifference> hand_off(aside_m.size());
  double all = 0, deepest = 0, worst_hand = 0, worst_each = 0;
  for (std::uint64_t i = 0; i < kCycleTicks; ++i) {
    const Input input = scripted_input(script, i);
    const Output one = tick(a.kernel, input);
    add_tick(one.force_n - tick(b.kernel, input).force_n, halves_off);
    for (std::size_t k = 0; k < beside.size(); ++k) {
      Input aside = input;
      aside.handle.position_m = input.handle.position_m + aside_m[k];
      add_tick(one.force_n - tick(beside[k].kernel, aside).force_n, hand_off[k]);
    }
    all += squared(one.force_n);
    deepest = std::max(deepest, static_cast<double>(view_of(b.kernel).state.needle->shaft_count));
  }
  EXPECT_GT(deepest, 3);
  for (const FeltDifference& hand : hand_off) {
    worst_hand = std::max(worst_hand, hand.sum);
    worst_each = std::max(worst_each, hand.each_sum);
  }
  EXPECT_LT(halves_off.sum, worst_hand);
  EXPECT_LT(halves_off.each_sum, worst_each);
  EXPECT_LT(worst_hand, 2.5e-5 * all);  // 0.5 %: otherwise the comparison would say little
}

TEST(Sheets, HelpersChangeNoBit) {
  const auto cut = packed(*halves(true));
  Session alone = make_session(cut->organ, Config{}), helped = make_session(cut->organ, Config{});
  Block team = make_block(team_bytes(helped.kernel, 1));
  ASSERT_EQ(set_team(helped.kernel, 1, team.span()), Status::kOk);
  for (Session* each : {&alone, &helped}) {
    push(view_of(each->kernel), [](const Vec3&) { return true; });
    let_go(*each, 20);
  }
  EXPECT_EQ(hash(alone.kernel), hash(helped.kernel));
}

TEST(Sheets, PartsWithoutTiesDoNotMoveEachOther) {
  const auto cut = packed(*halves(false));
  Session session = make_session(cut->organ, Config{});
  View view = view_of(session.kernel);
  each_node(view, [&](std::uint32_t sheet, const Vec3&, std::uint32_t particle) {
    if (sheet == 1 && view.model.step_per_mass[particle] > 0) {
      set_speed(view, particle, {0.05F, 0, 0});
    }
  });
  let_go(session, 100);
  double moved[2] = {};
  each_node(view, [&](std::uint32_t sheet, const Vec3&, std::uint32_t particle) {
    const auto ux = static_cast<double>(view.state.ux[particle]);
    moved[sheet] = std::max(moved[sheet], std::fabs(ux));
  });
  EXPECT_EQ(moved[0], 0);
  EXPECT_GT(moved[1], 1e-5);
}

TEST(Sheets, APlaceIsHeldByThePartInWhichItLies) {
  const auto shared = packed(*shared_cells());
  Session session = make_session(shared->organ, Config{});
  View view = view_of(session.kernel);
  const float edge_m = view.model.head->edge_m;
  for (const float along : {0.1F, 0.45F, 0.55F, 0.9F}) {
    const Vec3 place_m = edge_m * Vec3{1 + along, 2.3F, 1.6F};
    Support shares[kSupportsPerParticle];
    const std::uint32_t count = find_supports(view.model, place_m, shares);
    ASSERT_EQ(count, 8U);
    for (const Support& share : shares) {
      EXPECT_EQ(sheet_of(view, share.row), along < 0.5F ? 0U : 1U) << along;
      const Vec3 away = rest_centre(view.model, share.slot, view.model.row[share.row]) - place_m;
      EXPECT_LT(norm(away), 1.8F * edge_m) << along;
    }
    Vec3 present = {};
    ASSERT_TRUE(present_place(view.model, view.state, place_m, present));
    EXPECT_NEAR(static_cast<double>(norm(present - place_m)), 0, 1e-7);
  }
  EXPECT_FALSE(inside_lattice(view.model, edge_m * Vec3{1, kEdge + 1.5F, 1}));  // the second sheet
}

// Two voxels of one cell, each with a plane at its side of the gap between them: at any place the
// voxel that contains it counts.
TEST(Sheets, EachPartOfACellHasAPlaneOfItsOwn) {
  const std::unique_ptr<Owner> owner = shared_cells();
  const auto& runs = owner->runs;
  std::uint32_t voxel = 0;
  for (const format::Run& run : runs) {
    for (std::uint16_t i = 0; i < run.count(); ++i, ++voxel) {
      const bool second = run.y() >= kRows;
      if (run.x() + i != 1) continue;
      owner->mixed.emplace_back(voxel, kNoTissue, 0, second ? -1.0F : 1.0F, 0.0F, 0.0F,
                                second ? -0.6F : 0.4F);
    }
  }
  const auto shared = packed(*owner);
  Session session = make_session(shared->organ, Config{});
  View view = view_of(session.kernel);
  const float edge_m = view.model.head->edge_m;
  for (const float along : {0.1F, 0.35F, 0.45F, 0.55F, 0.65F, 0.9F}) {
    const bool gap = along > 0.4F && along < 0.6F;
    EXPECT_EQ(material_at(view.model, edge_m * Vec3{1 + along, 2.3F, 1.6F}), gap ? kNoTissue : 0U)
        << along;
  }
}

// What organ_open says about the shared cells after a change, as "place[index]: expected".
std::string refusal_of(const std::function<void(Owner&)>& change, std::uint16_t sheets = 2) {
  const std::unique_ptr<Owner> owner = halves(true, sheets);
  owner->sheets->parts.emplace_back(0, 0, 0, 0, kLeft);
  owner->sheets->parts.emplace_back(1, 0, 0, 0, kLeft);
  change(*owner);
  return refusal_text(*owner);
}

TEST(Sheets, RefusedWithTheirPlace) {
  using Tie = format::Tie;
  const auto tie = [](std::size_t i, std::uint16_t x, std::uint16_t y, std::uint16_t z,
                      std::uint16_t to_y) {
    return [=](Owner& o) { o.sheets->ties[i] = Tie(x, y, z, to_y); };
  };
  EXPECT_EQ(refusal_of([](Owner&) {}), "");
  EXPECT_EQ(refusal_of([](Owner& o) { o.format_version = 1; }),
            "sheets[0]: format version 2 where there are sheets");
  const char* const rows = "sheets.rows[0]: 2 or more, and size_y 2 to 8 times as many";
  for (const int wrong : {0, 1, 3, 2 * kRows}) {
    const auto wrong_rows = static_cast<std::uint16_t>(wrong);
    EXPECT_EQ(refusal_of([=](Owner& o) { o.sheets->rows = wrong_rows; }), rows) << wrong;
  }
  EXPECT_EQ(refusal_of([](Owner& o) {
              o.size_y = 18;
              o.sheets->rows = 2;
            }),
            rows);
  EXPECT_EQ(refusal_of([](Owner& o) { o.sheets->rows = 2; }),
            "runs[1]: the last row of each sheet empty");
  EXPECT_EQ(refusal_of([](Owner& o) { std::swap(o.sheets->ties[3], o.sheets->ties[4]); }),
            "sheets.ties[4]: ties sorted by z, y, x, one for a node");
  EXPECT_EQ(refusal_of(tie(0, kCut, kRows, 0, 1)),
            "sheets.ties[0]: the same place of an earlier sheet");
  EXPECT_EQ(refusal_of(tie(24, kCut, 2 * kRows - 1, 200, kRows - 1)),
            "sheets.ties[24]: the same place of an earlier sheet");
  EXPECT_EQ(refusal_of(tie(0, kCut, kRows, 0, kRows)),
            "sheets.ties[0]: the same place of an earlier sheet");
  EXPECT_EQ(refusal_of(tie(24, kCut, 500, kRows - 1, 0)),
            "sheets.ties[24]: the same place of an earlier sheet");
  EXPECT_EQ(refusal_of(tie(0, kCut - 1, kRows, 0, 0)), "sheets.ties[0]: nodes of the lattice");
  EXPECT_EQ(refusal_of(tie(0, kCut + 1, kRows, 0, 0)), "sheets.ties[0]: nodes of the lattice");
  EXPECT_EQ(refusal_of(tie(1, kEdge, kRows + 1, 0, 1)), "sheets.ties[1]: nodes of the lattice");
  EXPECT_EQ(refusal_of([](Owner& o) {
              o.sheets->ties.insert(o.sheets->ties.begin(), {2, 5, 0, 0});
            }),
            "sheets.ties[1]: ties sorted by z, y, x, one for a node");
  const auto tie_third = [](std::uint16_t to_y) {  // behind those of the first plane
    return [=](Owner& o) {
      o.sheets->ties.insert(o.sheets->ties.begin() + kRows, {kCut, 2 * kRows, 0, to_y});
    };
  };
  EXPECT_EQ(refusal_of(tie_third(0), 3), "");
  EXPECT_EQ(refusal_of(tie_third(kRows), 3), "sheets.ties[5]: a node that is not tied itself");
  EXPECT_EQ(refusal_of([](Owner& o) { std::swap(o.sheets->parts[0], o.sheets->parts[1]); }),
            "sheets.parts[1]: parts sorted by z, y, x, one for a voxel");
  EXPECT_EQ(refusal_of([](Owner& o) { o.sheets->parts[1] = format::Part(3, 0, 0, 0, 1); }),
            "sheets.parts[1]: a voxel of the lattice");
}

}  // namespace
}  // namespace stylet::test
