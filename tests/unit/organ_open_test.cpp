// SPDX-License-Identifier: Apache-2.0
// organ_open: every reason for refusal, with place, index, value and expectation; files cut at
// every length; every byte flipped.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include "organ_objects.h"  // before organ_generated.h, which it replaces
#include "session.h"
#include "state/layout.h"
#include "stylet/organ.h"
#include "tiny_organ.h"

namespace stylet::test {
namespace {

using Change = std::function<void(format::OrganT&)>;

// A good organ, unpacked, changed and packed again.
std::vector<std::byte> changed(const Change& change, const TinyOrgan& tiny) {
  const std::vector<std::byte> good = tiny_organ(tiny);
  std::unique_ptr<format::OrganT> organ(format::GetOrgan(good.data())->UnPack());
  change(*organ);
  flatbuffers::FlatBufferBuilder builder;
  format::FinishOrganBuffer(builder, format::Organ::Pack(builder, organ.get()));
  const auto* bytes = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return {bytes, bytes + builder.GetSize()};
}

TinyOrgan small() {
  TinyOrgan tiny;
  tiny.nx = 3;
  tiny.ny = 2;
  tiny.nz = 2;
  tiny.fixed_faces = kLowZ;
  return tiny;
}

struct Case {
  const char* name;
  Change change;
  Status status;
  const char* place;
  std::uint64_t index;
  double value;
  const char* expected;
};

using Owner = format::OrganT;

Change material(const std::function<void(format::MaterialT&)>& change) {
  return [change](Owner& o) { change(*o.materials[0]); };
}

#define STYLET_WRITTEN(field, ...) &format::MaterialT::field,
constexpr float format::MaterialT::*kWritten[] = {STYLET_MATERIAL_NUMBERS(STYLET_WRITTEN)};
#undef STYLET_WRITTEN

// Every number of the list, also later ones, twice its range below and above: refused with its
// name, the value and the limits in words.
std::vector<Case> material_cases() {
  std::vector<Case> cases;
  for (std::size_t i = 0; i < std::size(kMaterialNumbers); ++i) {
    const MaterialNumber& number = kMaterialNumbers[i];
    const float range = number.most - number.least;
    for (const float value : {number.least - range, number.most + range}) {
      cases.push_back({number.name, material([i, value](auto& m) { m.*kWritten[i] = value; }),
                       Status::kOrganValueOutOfRange, number.name, 0, static_cast<double>(value),
                       number.expected});
    }
  }
  return cases;
}

std::vector<Case> lattice_cases() {
  const Status range = Status::kOrganValueOutOfRange, index = Status::kOrganIndexOutOfRange;
  const Status disagree = Status::kOrganSizesDisagree, order = Status::kOrganOrderWrong;
  const auto run = [](Owner& o, std::size_t i, std::uint16_t x, std::uint16_t count) {
    const format::Run old = o.runs[i];
    o.runs[i] = format::Run(x, old.y(), old.z(), count);
  };
  return {
      {"version", [](Owner& o) { o.format_version = 7; }, Status::kOrganVersionUnknown,
       "format_version", 0, 7, "version 1 to 6"},
      {"sum", [](Owner& o) { o.content_sha256.assign(20, 1); }, Status::kOrganSizesDisagree,
       "content_sha256", 0, 20, "32 bytes, or none"},
      {"edge", [](Owner& o) { o.voxel_edge_m = 0.25F; }, range, "voxel_edge_m", 0, 0.25,
       "0.0001 to 0.1"},
      {"origin", [](Owner& o) { o.origin_x_m = 4.125F; }, range, "origin_x_m", 0, 4.125,
       "within 4 m"},
      {"no voxels",
       [](Owner& o) {
         o.runs.clear();
         o.voxel_material.clear();
       },
       range, "voxel_material", 0, 0, "1 to 4000000 voxels"},
      {"no materials", [](Owner& o) { o.materials.clear(); }, range, "materials", 0, 0,
       "1 to 64 materials"},
      {"many materials",
       [](Owner& o) {
         while (o.materials.size() < 65) {
           o.materials.push_back(std::make_unique<format::MaterialT>(*o.materials[0]));
         }
       },
       range, "materials", 0, 65, "1 to 64 materials"},
      {"empty run", [run](Owner& o) { run(o, 1, 0, 0); }, range, "runs.count", 1, 0,
       "at least 1 voxel"},
      {"run outside", [run](Owner& o) { run(o, 2, 1, 3); }, index, "runs", 2, 4,
       "a run inside the lattice"},
      {"runs swapped", [](Owner& o) { std::swap(o.runs[0], o.runs[1]); }, order, "runs", 1, 0,
       "runs sorted by z, y, x with a gap between runs of a row"},
      {"later rows swapped", [](Owner& o) { std::swap(o.runs[2], o.runs[3]); }, order, "runs", 3, 0,
       "runs sorted by z, y, x with a gap between runs of a row"},
      {"runs touching",
       [](Owner& o) {
         o.runs[0] = format::Run(0, 0, 0, 1);
         o.runs.insert(o.runs.begin() + 1, format::Run(1, 0, 0, 2));
       },
       order, "runs", 1, 1, "runs sorted by z, y, x with a gap between runs of a row"},
      {"fewer run voxels", [run](Owner& o) { run(o, 3, 0, 2); }, disagree, "voxel_material", 12, 11,
       "as many entries as the runs have voxels"},
      {"fill count", [](Owner& o) { o.voxel_fill.pop_back(); }, disagree, "voxel_fill", 11, 12,
       "one per voxel"},
      {"fixed count", [](Owner& o) { o.voxel_fixed.pop_back(); }, disagree, "voxel_fixed", 11, 12,
       "none, or one per voxel"},
      {"material index", [](Owner& o) { o.voxel_material[7] = 1; }, index, "voxel_material", 7, 1,
       "an index into materials"},
      {"fill", [](Owner& o) { o.voxel_fill[5] = 0; }, range, "voxel_fill", 5, 0, "1 to 255"},
  };
}

std::vector<Case> mixed_cases() {
  const Status range = Status::kOrganValueOutOfRange, index = Status::kOrganIndexOutOfRange;
  const auto mixed = [](auto... of) {
    return [of...](Owner& o) {
      o.format_version = 2;
      o.mixed = {of...};
    };
  };
  using Mixed = format::Mixed;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  return {
      {"in an old file", [](Owner& o) { o.mixed = {Mixed(0, 0, 0, 1, 0, 0, 0)}; },
       Status::kOrganVersionUnknown, "mixed", 0, 1,
       "format version 2 where there are mixed voxels"},
      {"voxel", mixed(Mixed(12, 0, 0, 1, 0, 0, 0)), index, "mixed.voxel", 0, 12,
       "a voxel of the lattice"},
      {"voxel twice", mixed(Mixed(3, 0, 0, 1, 0, 0, 0), Mixed(3, 0, 0, 0, 1, 0, 0)),
       Status::kOrganOrderWrong, "mixed.voxel", 1, 3, "voxels in rising order, each once"},
      {"material", mixed(Mixed(3, 1, 0, 1, 0, 0, 0)), index, "mixed.material", 0, 1,
       "an index into materials, or 65535 for no tissue"},
      {"normal x", mixed(Mixed(3, 0, 0, -1.5F, 0, 0, 0)), range, "mixed.nx", 0, -1.5, "-1 to 1"},
      {"normal y", mixed(Mixed(3, 0, 0, 0, 1.5F, 0, 0)), range, "mixed.ny", 0, 1.5, "-1 to 1"},
      {"normal z", mixed(Mixed(3, 0, 0, 0, 0, 2, 0)), range, "mixed.nz", 0, 2, "-1 to 1"},
      {"limit", mixed(Mixed(3, kNoTissue, 0, 1, 0, 0, 2.5F)), range, "mixed.limit", 0, 2.5,
       "-2 to 2"},
      {"not a number", mixed(Mixed(3, kNoTissue, 0, nan, 0, 0, 0)), range, "mixed.nx", 0,
       static_cast<double>(nan), "-1 to 1"},
  };
}

std::vector<Case> skin_cases() {
  const auto skins = [](auto... of) {
    return [of...](Owner& o) {
      o.format_version = 6;
      o.skins = {of...};
    };
  };
  using format::Skin;
  const Status range = Status::kOrganValueOutOfRange;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  return {
      {"in an old file", [](Owner& o) { o.skins = {Skin(0, 1)}; }, Status::kOrganVersionUnknown,
       "skins", 0, 1, "format version 6 where there are skins"},
      {"voxel", skins(Skin(12, 1)), Status::kOrganIndexOutOfRange, "skins.voxel", 0, 12,
       "a voxel of the lattice"},
      {"voxel twice", skins(Skin(3, 1), Skin(3, 0.5F)), Status::kOrganOrderWrong, "skins.voxel", 1,
       3, "voxels in rising order, each once"},
      {"area", skins(Skin(3, 256.5F)), range, "skins.area", 0, 256.5, "0 to 256"},
      {"negative", skins(Skin(3, -0.5F)), range, "skins.area", 0, -0.5, "0 to 256"},
      {"not a number", skins(Skin(3, nan)), range, "skins.area", 0, static_cast<double>(nan),
       "0 to 256"},
  };
}

// A good membrane: one triangle, in one cell of material 0.
void add_membrane(Owner& o) {
  o.format_version = 3;
  o.membranes = std::make_unique<format::MembranesT>();
  o.membranes->points = {{0, 0, 0}, {0.01F, 0, 0}, {0, 0.01F, 0}};
  o.membranes->triangles = {{0, 1, 2}};
  o.membranes->cells = {format::MembraneCell(1, 1, 0, 0, 0, 1, 0.5F)};
}

std::vector<Case> membrane_cases() {
  const Status range = Status::kOrganValueOutOfRange, index = Status::kOrganIndexOutOfRange;
  const auto with = [](auto change) {
    return [change](Owner& o) {
      add_membrane(o);
      change(*o.membranes);
    };
  };
  const auto cells = [&](auto... of) {
    return with([of...](format::MembranesT& m) { m.cells = {of...}; });
  };
  using M = format::MembranesT;
  using Cell = format::MembraneCell;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  return {
      {"in an old file",
       [](Owner& o) {
         add_membrane(o);
         o.format_version = 2;
       },
       Status::kOrganVersionUnknown, "membranes", 0, 2,
       "format version 3 where there are membranes"},
      {"point", with([](M& m) {
         m.points[2] = {0, 9, 0};
       }),
       range, "membranes.points", 2, 9, "within 8 m"},
      {"point that is not a number", with([nan](M& m) {
         m.points[1] = {0, 0, nan};
       }),
       range, "membranes.points", 1, static_cast<double>(nan), "within 8 m"},
      {"corner", with([](M& m) {
         m.triangles[0] = {0, 1, 3};
       }),
       index, "membranes.triangles", 0, 3, "three indices into points"},
      {"cell beyond x", cells(Cell(3, 1, 0, 0, 0, 1, 0)), index, "membranes.cells", 0, 3,
       "a cell of the lattice"},
      {"cell beyond y", cells(Cell(1, 2, 0, 0, 0, 1, 0)), index, "membranes.cells", 0, 1,
       "a cell of the lattice"},
      {"cell beyond z", cells(Cell(1, 1, 2, 0, 0, 1, 0)), index, "membranes.cells", 0, 1,
       "a cell of the lattice"},
      {"order of cells", cells(Cell(1, 1, 0, 0, 0, 1, 0), Cell(0, 1, 0, 0, 0, 1, 0)),
       Status::kOrganOrderWrong, "membranes.cells", 1, 0, "cells sorted by z, y, x, material"},
      {"cell twice", cells(Cell(1, 1, 0, 0, 0, 1, 0), Cell(1, 1, 0, 0, 0, 1, 0)),
       Status::kOrganOrderWrong, "membranes.cells", 1, 1, "cells sorted by z, y, x, material"},
      {"material", cells(Cell(1, 1, 0, 1, 0, 1, 0)), index, "membranes.cells.material", 0, 1,
       "an index into materials"},
      {"no triangles", cells(Cell(1, 1, 0, 0, 0, 0, 0)), index, "membranes.cells.first", 0, 0,
       "triangles of the list, at least 1; none at a finer level"},
      {"triangles beyond the list", cells(Cell(1, 1, 0, 0, 0xFFFFFFFF, 1, 0)), index,
       "membranes.cells.first", 0, 4294967295.0,
       "triangles of the list, at least 1; none at a finer level"},
      {"too many triangles", with([](M& m) {
         m.triangles.assign(257, {0, 1, 2});
         m.cells = {Cell(1, 1, 0, 0, 0, 257, 0)};
       }),
       range, "membranes.cells.count", 0, 257, "at most 256 triangles in a cell"},
      {"area", cells(Cell(1, 1, 0, 0, 0, 1, -1)), range, "membranes.cells.area", 0, -1, "0 to 256"},
  };
}

format::SlideGround slide_ground(std::uint32_t voxel, const std::array<float, 8>& distance) {
  const auto& d = distance;
  return {voxel, d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7]};
}

// A point in voxel 0, and grounds in voxels 3 and 5.
void add_slides(Owner& o) {
  o.format_version = 4;
  o.slides = std::make_unique<format::SlidesT>();
  o.slides->points = {format::SlidePoint(0, 1, 2, 65535, 0, 0.5F, 1, 0.125F)};
  o.slides->grounds = {slide_ground(3, {}), slide_ground(5, {1, 2, 3, 4, 5, 6, 7, 8.25F})};
}

Change slides(const std::function<void(format::SlidesT&)>& change) {
  return [change](Owner& o) {
    add_slides(o);
    change(*o.slides);
  };
}

std::vector<Case> slide_point_cases() {
  const Status range = Status::kOrganValueOutOfRange, index = Status::kOrganIndexOutOfRange;
  using S = format::SlidesT;
  using Point = format::SlidePoint;
  const auto point = [](const Point& p) { return slides([p](S& s) { s.points.push_back(p); }); };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const char* const area = "above 0, at most 4";
  return {
      {"in an old file",
       [](Owner& o) {
         add_slides(o);
         o.format_version = 3;
       },
       Status::kOrganVersionUnknown, "slides", 0, 3, "format version 4 where parts slide"},
      {"many points", slides([](S& s) { s.points.resize(65537, s.points[0]); }), range,
       "slides.points", 0, 65537, "at most 65536 points"},
      {"voxel", point({12, 0, 0, 0, 0, 1, 0, 0}), index, "slides.points.voxel", 1, 12,
       "a voxel of the lattice"},
      {"voxel of its ground", point({5, 0, 0, 0, 0, 1, 1, 0}), index, "slides.points.ground", 1, 1,
       "the ground of another voxel than the point's"},
      {"reserved", point({0, 0, 0, 0, 7, 1, 0, 0}), range, "slides.points.reserved", 1, 7, "0"},
      {"no area", point({0, 0, 0, 0, 0, 0, 0, 0}), range, "slides.points.area", 1, 0, area},
      {"much area", point({0, 0, 0, 0, 0, 4.5F, 0, 0}), range, "slides.points.area", 1, 4.5, area},
      {"area that is not a number", point({0, 0, 0, 0, 0, nan, 0, 0}), range, "slides.points.area",
       1, static_cast<double>(nan), area},
      {"ground", point({0, 0, 0, 0, 0, 1, 2, 0}), index, "slides.points.ground", 1, 2,
       "an index into grounds"},
      {"friction below 0", point({0, 0, 0, 0, 0, 1, 0, -0.5F}), range, "slides.points.friction", 1,
       -0.5, "0 to 2"},
      {"friction", point({0, 0, 0, 0, 0, 1, 0, 2.5F}), range, "slides.points.friction", 1, 2.5,
       "0 to 2"},
      {"friction that is not a number", point({0, 0, 0, 0, 0, 1, 0, nan}), range,
       "slides.points.friction", 1, static_cast<double>(nan), "0 to 2"},
      {"bodies", slides([](S& s) {
         s.bodies = {0, 0};
       }),
       Status::kOrganSizesDisagree, "slides.bodies", 0, 2,
       "one for each ground where there are levels, else none"},
      {"no grounds", slides([](S& s) { s.grounds.clear(); }), index, "slides.points.ground", 0, 1,
       "an index into grounds"},
  };
}

std::vector<Case> slide_ground_cases() {
  const Status range = Status::kOrganValueOutOfRange, index = Status::kOrganIndexOutOfRange;
  using S = format::SlidesT;
  const auto ground = [](std::uint32_t voxel, std::size_t corner, float distance) {
    return slides([=](S& s) {
      std::array<float, 8> distances{};
      distances[corner] = distance;
      s.grounds.push_back(slide_ground(voxel, distances));
    });
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const char* const rising = "voxels in rising order, each once";
  return {
      {"voxel", ground(12, 0, 0), index, "slides.grounds.voxel", 2, 12, "a voxel of the lattice"},
      {"order", ground(4, 0, 0), Status::kOrganOrderWrong, "slides.grounds.voxel", 2, 4, rising},
      {"twice", ground(5, 0, 0), Status::kOrganOrderWrong, "slides.grounds.voxel", 2, 5, rising},
      {"first corner", ground(6, 0, -100.5F), range, "slides.grounds.distance", 2, -100.5,
       "-100 to 100"},
      {"last corner", ground(6, 7, 100.5F), range, "slides.grounds.distance", 2, 100.5,
       "-100 to 100"},
      {"not a number", ground(6, 3, nan), range, "slides.grounds.distance", 2,
       static_cast<double>(nan), "-100 to 100"},
  };
}

std::vector<Case> surface_cases() {
  const Status range = Status::kOrganValueOutOfRange, index = Status::kOrganIndexOutOfRange;
  const auto first_leaf = [](const Owner& o) {
    std::size_t i = 0;
    while (o.sphere_nodes[i].count() == 0) ++i;
    return i;
  };
  const auto set_node = [](Owner& o, std::size_t i, float radius, std::uint32_t first,
                           std::uint32_t count) {
    const format::SphereNode n = o.sphere_nodes[i];
    o.sphere_nodes[i] = format::SphereNode(n.x(), n.y(), n.z(), radius, first, count);
  };
  const std::unique_ptr<Owner> good(format::GetOrgan(tiny_organ(small()).data())->UnPack());
  const std::size_t leaf = first_leaf(*good);
  const auto triangles = static_cast<std::uint32_t>(good->triangles.size());
  const auto nodes = static_cast<double>(good->sphere_nodes.size());
  return {
      {"vertex voxel", [](Owner& o) { o.vertices[4] = format::Vertex(12, 0, 0, 0, 0); }, index,
       "vertices.voxel", 4, 12, "a voxel of the lattice"},
      {"triangle a", [](Owner& o) { o.triangles[3] = format::Triangle(100000, 0, 1); }, index,
       "triangles", 3, 100000, "three indices into vertices"},
      {"no tree", [](Owner& o) { o.sphere_nodes.clear(); }, Status::kOrganSizesDisagree,
       "sphere_nodes", 0, static_cast<double>(triangles),
       "a sphere tree exactly where there are triangles"},
      {"radius", [set_node](Owner& o) { set_node(o, 0, -1, o.sphere_nodes[0].first(), 0); }, range,
       "sphere_nodes", 0, -1, "finite spheres"},
      {"child before parent", [set_node](Owner& o) { set_node(o, 0, 1, 0, 0); }, index,
       "sphere_nodes.first", 0, 0, "children behind the parent, leaves inside triangles"},
      {"leaf outside",
       [set_node, leaf, triangles](Owner& o) { set_node(o, leaf, 1, triangles, 1); }, index,
       "sphere_nodes.first", leaf, static_cast<double>(triangles),
       "children behind the parent, leaves inside triangles"},
      {"orphans", [set_node](Owner& o) { set_node(o, 0, 1, 0, 2); }, index, "sphere_nodes", 1,
       nodes, "every node the child of exactly one node"},
  };
}

void expect_refused(const Case& c) {
  const std::vector<std::byte> bytes = changed(c.change, small());
  Organ organ;
  OrganRefusal refusal;
  EXPECT_EQ(organ_open(bytes, organ, &refusal), c.status) << c.name;
  EXPECT_EQ(refusal.status, c.status) << c.name;
  EXPECT_STREQ(refusal.place, c.place) << c.name;
  EXPECT_EQ(refusal.index, c.index) << c.name;
  if (std::isnan(c.value)) {
    EXPECT_TRUE(std::isnan(refusal.value)) << c.name;
  } else {
    EXPECT_DOUBLE_EQ(refusal.value, c.value) << c.name;
  }
  EXPECT_STREQ(refusal.expected, c.expected) << c.name;
  EXPECT_EQ(organ.root, nullptr) << c.name << ": the organ must not be touched";
}

TEST(OrganOpen, OpensAGoodOrgan) {
  const std::vector<std::byte> bytes = changed([](Owner&) {}, small());
  Organ organ;
  OrganRefusal refusal;
  ASSERT_EQ(organ_open(bytes, organ, &refusal), Status::kOk) << refusal.place;
  EXPECT_EQ(organ.voxel_count, 12U);
  EXPECT_EQ(organ.size_x, 3);
  EXPECT_STREQ(organ.name, "tiny");
  EXPECT_STREQ(organ_material(organ, 0).name, "gel");
}

TEST(OrganOpen, AcceptsALeafWithOnlyTheLastTriangle) {
  const auto last_alone = [](Owner& o) {
    for (format::SphereNode& n : o.sphere_nodes) {
      if (n.count() == 0) continue;
      const auto last = static_cast<std::uint32_t>(o.triangles.size() - 1);
      n = format::SphereNode(n.x(), n.y(), n.z(), n.radius(), last, 1);
    }
  };
  Organ organ;
  OrganRefusal refusal;
  EXPECT_EQ(organ_open(changed(last_alone, small()), organ, &refusal), Status::kOk)
      << refusal.place;
}

TEST(OrganOpen, RefusesMaterialsWithTheirPlace) {
  for (const Case& c : material_cases()) expect_refused(c);
}
TEST(OrganOpen, RefusesLatticesWithTheirPlace) {
  for (const Case& c : lattice_cases()) expect_refused(c);
  for (const Case& c : mixed_cases()) expect_refused(c);
  for (const Case& c : skin_cases()) expect_refused(c);
}
TEST(OrganOpen, RefusesSurfacesWithTheirPlace) {
  for (const Case& c : surface_cases()) expect_refused(c);
}

TEST(OrganOpen, RefusesMembranesWithTheirPlace) {
  Organ organ;
  ASSERT_EQ(organ_open(changed(add_membrane, small()), organ), Status::kOk);
  EXPECT_EQ(organ.membrane_cells.size(), 1U);
  for (const Case& c : membrane_cases()) expect_refused(c);
}

TEST(OrganOpen, RefusesSlidesWithTheirPlace) {
  Organ organ;
  const std::vector<std::byte> good = changed(add_slides, small());
  ASSERT_EQ(organ_open(good, organ), Status::kOk);
  ASSERT_EQ(organ.slide_points.size(), 1U);
  ASSERT_EQ(organ.slide_grounds.size(), 2U);
  EXPECT_EQ(organ.slide_points[0].fz, 65535);
  EXPECT_EQ(organ.slide_points[0].ground, 1U);
  EXPECT_EQ(organ.slide_points[0].friction, 0.125F);
  EXPECT_EQ(organ.slide_grounds[1].voxel, 5U);
  EXPECT_EQ(organ.slide_grounds[1].distance[7], 8.25F);
  for (const Case& c : slide_point_cases()) expect_refused(c);
  for (const Case& c : slide_ground_cases()) expect_refused(c);
}

// The tree is checked last.
TEST(OrganOpen, OfTwoFaultsNamesTheFirst) {
  for (const std::vector<Case>& cases :
       {material_cases(), lattice_cases(), mixed_cases(), skin_cases()}) {
    for (Case c : cases) {
      c.change = [first = c.change](Owner& o) {
        first(o);
        o.sphere_nodes.clear();
      };
      expect_refused(c);
    }
  }
}

// The value named must be the one that is wrong, not a neighbour.
TEST(OrganOpen, NamesTheWrongOriginComponent) {
  expect_refused({"origin y", [](Owner& o) { o.origin_y_m = 128; }, Status::kOrganValueOutOfRange,
                  "origin_y_m", 0, 128, "within 4 m"});
  expect_refused({"origin z", [](Owner& o) { o.origin_z_m = 128; }, Status::kOrganValueOutOfRange,
                  "origin_z_m", 0, 128, "within 4 m"});
}
TEST(OrganOpen, NamesTheWrongTriangleCorner) {
  expect_refused({"triangle c", [](Owner& o) { o.triangles[3] = format::Triangle(0, 1, 100000); },
                  Status::kOrganIndexOutOfRange, "triangles", 3, 100000,
                  "three indices into vertices"});
}

TEST(OrganOpen, RefusesNumbersThatAreNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Change changes[] = {
      [nan](Owner& o) { o.voxel_edge_m = nan; },
      [nan](Owner& o) { o.origin_z_m = nan; },
      [nan](Owner& o) { o.materials[0]->density_kg_per_m3 = nan; },
      [nan](Owner& o) { o.materials[0]->coulomb_friction_n_per_m = nan; },
      [nan](Owner& o) { o.materials[0]->static_friction_n_per_m = nan; },
      [nan](Owner& o) {
        const format::SphereNode n = o.sphere_nodes[0];
        o.sphere_nodes[0] = format::SphereNode(nan, n.y(), n.z(), n.radius(), n.first(), 0);
      },
  };
  for (const Change& change : changes) {
    Organ organ;
    EXPECT_EQ(organ_open(changed(change, small()), organ), Status::kOrganValueOutOfRange);
  }
}

// Values that are refused beyond a limit are accepted at the limit.
TEST(OrganOpen, AcceptsEveryLimitItself) {
  const auto at = [](bool high) {
    return changed(
        [high](Owner& o) {
          format::MaterialT& m = *o.materials[0];
          for (std::size_t i = 0; i < std::size(kMaterialNumbers); ++i) {
            m.*kWritten[i] = high ? kMaterialNumbers[i].most : kMaterialNumbers[i].least;
          }
          o.voxel_edge_m = high ? kMaxVoxelEdgeM : kMinVoxelEdgeM;
          o.origin_x_m = o.origin_y_m = o.origin_z_m = high ? kMaxOriginM : -kMaxOriginM;
          std::fill(o.voxel_fill.begin(), o.voxel_fill.end(), std::uint8_t{1});
          o.format_version = 2;
          const float end = high ? 1 : -1;
          o.mixed = {format::Mixed(3, 0, 0, end, end, end, 2 * end)};
          while (high && o.materials.size() < kMaxMaterials) {
            o.materials.push_back(std::make_unique<format::MaterialT>(m));
          }
        },
        small());
  };
  for (const bool high : {false, true}) {
    Organ organ;
    OrganRefusal refusal;
    EXPECT_EQ(organ_open(at(high), organ, &refusal), Status::kOk)
        << refusal.place << ": " << refusal.expected;
    EXPECT_EQ(organ.material_count, high ? kMaxMaterials : 1U);
  }
}

// And they are refused just beyond it; of a material's numbers,
// KeepsEveryMaterialNumberWithinTheLimitsItNames tests that.
TEST(OrganOpen, RefusesJustBeyondEveryLimitOfTheLattice) {
  const Change changes[] = {
      [](Owner& o) { o.voxel_edge_m = 0.1001F; },
      [](Owner& o) { o.origin_z_m = 100.5F; },
      [](Owner& o) { o.voxel_edge_m = 0.99e-4F; },
      [](Owner& o) { o.origin_y_m = -100.1F; },
  };
  for (std::size_t i = 0; i < std::size(changes); ++i) {
    Organ organ;
    EXPECT_EQ(organ_open(changed(changes[i], small()), organ), Status::kOrganValueOutOfRange) << i;
  }
}

// The list (stylet/material.h) and the schema: the same fields, in the same order.
TEST(OrganOpen, ListsTheNumbersOfAMaterialAsTheSchemaDoes) {
  const flatbuffers::TypeTable& schema = *format::MaterialTypeTable();
  constexpr std::size_t kTexts = 2;  // name and source, before all numbers
  ASSERT_EQ(schema.num_elems, kTexts + std::size(kMaterialNumbers));
  for (std::size_t i = 0; i < std::size(kMaterialNumbers); ++i) {
    EXPECT_STREQ(kMaterialNumbers[i].name, schema.names[kTexts + i]);
  }
}

// For every number of the list, also later ones: a value just beyond a limit is refused with the
// name, the value and the correct limits; a value at a limit is read as it was written.
TEST(OrganOpen, KeepsEveryMaterialNumberWithinTheLimitsItNames) {
  for (std::size_t i = 0; i < std::size(kMaterialNumbers); ++i) {
    const MaterialNumber& number = kMaterialNumbers[i];
    const bool at_rest = number.field == &Material::static_friction_n_per_m;
    const float least = at_rest ? TinyMaterial{}.coulomb_friction_n_per_m : number.least;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const float end : {least, number.most}) {
      const float value = std::nextafter(end, end == least ? -kInfinity : kInfinity);
      expect_refused({number.name, material([&](auto& m) { m.*kWritten[i] = value; }),
                      Status::kOrganValueOutOfRange, number.name, 0, static_cast<double>(value),
                      number.expected});
      Organ organ;
      const auto bytes = changed(material([&](auto& m) {
                                   m.static_friction_n_per_m = 1e4F;
                                   m.*kWritten[i] = end;
                                 }),
                                 small());
      ASSERT_EQ(organ_open(bytes, organ), Status::kOk) << number.name;
      EXPECT_EQ(organ_material(organ, 0).*number.field, end) << number.name;
    }
    const std::string words = number.expected;
    const std::size_t to = words.find(" to ");
    ASSERT_NE(to, std::string::npos) << words;
    EXPECT_EQ(std::stof(words.substr(to + 4)), number.most) << number.name;
    EXPECT_TRUE(at_rest || std::stof(words) == number.least) << number.name;
  }
}

// Rows are ordered by z before y, however many rows a plane has.
TEST(OrganOpen, RowsBeyondFifteenBitsAreInOrder) {
  const auto wide = [](Owner& o) {
    o.size_x = 1;
    o.size_y = 40001;
    o.size_z = 2;
    o.runs = {format::Run(0, 40000, 0, 1), format::Run(0, 0, 1, 1)};
    o.voxel_material.resize(2);
    o.voxel_fill.resize(2);
    o.voxel_fixed.clear();
    o.vertices.clear();
    o.triangles.clear();
    o.sphere_nodes.clear();
  };
  Organ organ;
  OrganRefusal refusal;
  EXPECT_EQ(organ_open(changed(wide, small()), organ, &refusal), Status::kOk)
      << refusal.place << ": " << refusal.expected;
}

// The tree is a chain: every inner node has the next one as its first child and a leaf as its
// second, which waits on the stack while the search goes down.
std::vector<std::byte> chain_organ(std::uint32_t levels) {
  const auto chain = [levels](Owner& o) {
    const format::SphereNode leaf(0, 0, 0, 1, 0, 1);
    std::vector<format::SphereNode> nodes = {format::SphereNode(0, 0, 0, 1, 1, 0)};
    for (std::uint32_t i = 1; i < levels; ++i) {
      nodes.emplace_back(0.0F, 0.0F, 0.0F, 1.0F, 2 * i + 1, 0U);
      nodes.push_back(leaf);
    }
    nodes.push_back(leaf);
    nodes.push_back(leaf);
    o.sphere_nodes = nodes;
  };
  return changed(chain, small());
}

TEST(OrganOpen, RefusesATreeDeeperThanTheTicksStack) {
  Organ organ;
  OrganRefusal refusal;
  EXPECT_EQ(organ_open(chain_organ(kMaxTreeDepth - 1), organ, &refusal), Status::kOk)
      << refusal.place << " " << refusal.index << ": " << refusal.expected;
  EXPECT_EQ(organ_open(chain_organ(kMaxTreeDepth), organ, &refusal), Status::kOrganValueOutOfRange);
  EXPECT_STREQ(refusal.expected, "a tree at most 62 levels deep");
}

TEST(OrganOpen, RefusesBytesThatAreNotAligned) {
  const std::vector<std::byte> good = tiny_organ(small());
  std::vector<std::byte> moved(good.size() + 8);
  for (std::size_t shift = 1; shift < 8; ++shift) {
    std::copy(good.begin(), good.end(), moved.begin() + static_cast<std::ptrdiff_t>(shift));
    Organ organ;
    OrganRefusal refusal;
    EXPECT_EQ(organ_open(std::span(moved).subspan(shift, good.size()), organ, &refusal),
              Status::kMemoryNotAligned);
    EXPECT_STREQ(refusal.expected, "bytes that start at a multiple of 8");
  }
}

TEST(OrganOpen, RefusesOtherFiles) {
  std::vector<std::byte> bytes = tiny_organ(small());
  bytes[4] = std::byte{'X'};
  Organ organ;
  OrganRefusal refusal;
  EXPECT_EQ(organ_open(bytes, organ, &refusal), Status::kOrganNotAnOrganFile);
  EXPECT_STREQ(refusal.place, "identifier");
  EXPECT_EQ(refusal.index, 4U);
  EXPECT_EQ(organ_open({}, organ, &refusal), Status::kOrganTooSmall);
}

TEST(OrganOpen, RefusesEveryTruncation) {
  const std::vector<std::byte> good = tiny_organ(small());
  for (std::size_t size = 0; size < good.size(); ++size) {
    // A copy of exactly this size, so that a sanitizer notices any read beyond it.
    Block copy = make_block(size + 1);
    std::copy_n(good.begin(), size, copy.bytes.get());
    Organ organ;
    OrganRefusal refusal;
    const Status status = organ_open(copy.span().subspan(0, size), organ, &refusal);
    ASSERT_NE(status, Status::kOk) << size << " of " << good.size() << " bytes";
    ASSERT_EQ(status, size < 16 ? Status::kOrganTooSmall : Status::kOrganStructureDamaged) << size;
    ASSERT_STRNE(refusal.place, "");
    ASSERT_STRNE(refusal.expected, "");
  }
}

// A lattice far larger than its voxels would cost memory and time out of proportion to the file's
// size.
TEST(OrganOpen, RefusesALatticeMuchLargerThanItsVoxels) {
  const auto vast = [](Owner& o) { o.size_y = o.size_z = 65535; };
  Organ organ;
  EXPECT_NE(organ_open(changed(vast, small()), organ), Status::kOk)
      << "12 voxels, and create would walk and store 4e9 rows";
}

// An organ that can be opened must also run: sizes, create and a few ticks at the surface. (Vast
// lattices have their own test.)
void run_opened(const Organ& organ) {
  if (std::uint32_t{organ.size_y} * organ.size_z > 4096) return;
  Sizes need = {};
  if (sizes(organ, Config{}, need) != Status::kOk) return;
  Session session = make_session(organ, Config{});
  for (int i = 0; i < 3; ++i) {
    const float z = organ.origin_m.z + 0.01F + 0.15F - 2e-3F * static_cast<float>(i);
    const Output out =
        tick(session.kernel,
             {{{organ.origin_m.x + 7e-3F, organ.origin_m.y + 5e-3F, z}, {1, 0, 0, 0}}, 1});
    ASSERT_TRUE(std::isfinite(out.force_n.x) && std::isfinite(out.force_n.y) &&
                std::isfinite(out.force_n.z));
  }
  float distance = 0;
  (void)organ_raycast(organ, {organ.origin_m.x, organ.origin_m.y, 1}, {0, 0, -1}, distance);
}

void open_or_explain(const std::vector<std::byte>& bytes, const std::string& what) {
  Organ organ;
  OrganRefusal refusal;
  const Status status = organ_open(bytes, organ, &refusal);
  ASSERT_EQ(status, refusal.status) << what;
  if (status == Status::kOk) {
    run_opened(organ);
    return;
  }
  ASSERT_STRNE(refusal.place, "") << what;
  ASSERT_STRNE(refusal.expected, "") << what;
}

TEST(OrganOpenFuzz, EveryByteFlipped) {
  const std::vector<std::byte> good = tiny_organ(small());
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const unsigned flip : {0x01U, 0x80U, 0xFFU}) {
      std::vector<std::byte> bytes = good;
      bytes[at] ^= static_cast<std::byte>(flip);
      open_or_explain(bytes, "byte " + std::to_string(at));
    }
  }
}

TEST(OrganOpenFuzz, TenThousandRandomPatches) {
  const std::vector<std::byte> good = tiny_organ(small());
  std::mt19937 random(4);
  const std::uint32_t words[] = {0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7FC00000, 0x7F800000};
  for (int i = 0; i < 10000; ++i) {
    std::vector<std::byte> bytes = good;
    for (int patch = 0; patch < 1 + i % 4; ++patch) {
      const std::size_t at = random() % (bytes.size() - 4) / 4 * 4;
      const std::uint32_t word = random() % 2 == 0 ? words[random() % std::size(words)]
                                                   : static_cast<std::uint32_t>(random());
      std::memcpy(bytes.data() + at, &word, 4);
    }
    open_or_explain(bytes, "sample " + std::to_string(i));
  }
}

}  // namespace
}  // namespace stylet::test
