// SPDX-License-Identifier: Apache-2.0
// What holds of every reader of meshes, whatever it does wrong: readers that no format has are
// called as read_mesh calls those of the list. And what is said of the units of meshes.
#include <gmock/gmock.h>

#include <new>

#include "base/refusal.h"
#include "meshes/bytes.h"
#include "meshes/lines.h"
#include "meshes/reader.h"
#include "offline_support.h"
#include "pipeline/membranes.h"
#include "pipeline/settings.h"

namespace stylet::test {
namespace {

using offline::Bytes;
using offline::Collector;
using offline::Lines;
using offline::Place;
using offline::ReadMesh;
using testing::ElementsAre;
using testing::HasSubstr;
using Reader = ReadMesh (*)(std::string_view file, std::string_view bytes);

ReadMesh read(Reader reader) {
  return offline::read_with({".bad", reader}, "a.bad", "0123");
}

std::string refusal(Reader reader) {
  return refusal_of([reader] { (void)read(reader); });
}

Collector three_points(std::string_view file) {
  Collector collector{.file = file};
  for (int i = 0; i < 3; ++i) {
    add_point(collector, offline::Vec{double(i == 1), double(i == 2), 0},
              {file, Place::Kind::kLine, 1});
  }
  return collector;
}

TEST(AnyReader, IsRefusedACornerThatIsNoPoint) {
  EXPECT_EQ(refusal([](std::string_view file, std::string_view) {
              Collector collector = three_points(file);
              add_polygon(collector, std::array{0U, 1U, 2U}, {file, Place::Kind::kLine, 4});
              add_polygon(collector, std::array{0U, 1U, 3U}, {file, Place::Kind::kLine, 5});
              add_polygon(collector, std::array{0U, 3U, 2U}, {file, Place::Kind::kLine, 6});
              return finish(std::move(collector));
            }),
            "a.bad:5: 3: expected a point index from 0, of one of 3 points");
  EXPECT_EQ(
      refusal([](std::string_view file, std::string_view) {
        Collector collector = three_points(file);
        collector.first_index = 1;
        add_polygon(collector, std::array{0U, 0xFFFFFFFFU, 1U}, {file, Place::Kind::kByte, 0});
        return finish(std::move(collector));
      }),
      "a.bad: byte 0: 4294967296: expected a point index from 1, of one of 3 points");
  EXPECT_THAT(refusal([](std::string_view file, std::string_view) {
                Collector collector = three_points(file);
                collector.mesh.triangles.push_back({0, 1, 3});  // by itself
                return finish(std::move(collector));
              }),
              HasSubstr("a.bad: the reader of .bad files failed"));
}

TEST(AnyReader, ThatThrowsIsARefusalWithTheNameOfTheFile) {
  EXPECT_THAT(refusal([](std::string_view, std::string_view) -> ReadMesh {
                ReadMesh mesh;
                mesh.mesh.points.reserve(std::size_t{1} << 62U);
                return mesh;
              }),
              testing::MatchesRegex("a.bad: the reader of .bad files failed \\(.*reserve\\): "
                                    "expected a valid file"));
  EXPECT_EQ(refusal([](std::string_view, std::string_view) -> ReadMesh { throw std::bad_alloc(); }),
            "a.bad: out of memory: expected a smaller file than 4 bytes, or a larger "
            "--memory-limit");
  EXPECT_EQ(refusal([](std::string_view file, std::string_view) -> ReadMesh {
              offline::refuse("{}:1: own words", file);
            }),
            "a.bad:1: own words");
}

TEST(AnyReader, MaySayItsUnitAndWhatItLeftOut) {
  const ReadMesh mesh = read([](std::string_view file, std::string_view) {
    Collector collector = three_points(file);
    add_polygon(collector, std::array{0U, 1U, 2U}, {file, Place::Kind::kLine, 4});
    collector.metres_per_unit = 0.0254;
    collector.notes.push_back("12 curves are left out");
    return finish(std::move(collector));
  });
  EXPECT_EQ(mesh.metres_per_unit, 0.0254);
  EXPECT_THAT(mesh.notes, ElementsAre("a.bad: 12 curves are left out"));
}

TEST(AnyReader, CountsOnlyWhatTheFileHasRoomFor) {
  const Lines lines{.text = "0123456789", .file = "a", .number = 7};
  EXPECT_EQ(require_count(lines, "5", 2, "a number of points"), 5U);
  for (const std::string count :
       {"6", "-1", "1000000000000000000", "1e3", "99999999999999999999"}) {
    EXPECT_EQ(refusal_of([&] { (void)require_count(lines, count, 2, "a number of points"); }),
              "a:7: '" + count +
                  "': expected a number of points from 0 to 5, for which 10 bytes have room");
  }
  const std::string raw("\x02\0\0\0\0\0\0\xFF\x02\x01", 10);
  Bytes bytes{.bytes = raw, .file = "a"};
  EXPECT_EQ(offline::next_count<std::uint8_t>(bytes, 4, "a number of points"), 2U);
  EXPECT_EQ(refusal_of([&] {
              Bytes all{.bytes = raw, .file = "a"};
              (void)offline::next_count<std::uint64_t>(all, 1, "a number of points");
            }),
            "a: byte 0: 18374686479671623682: expected a number of points from 0 to 2, for which 2 "
            "bytes have room");
  bytes.next = 7;
  EXPECT_THAT(refusal_of([&] { (void)offline::next_count<std::int8_t>(bytes, 1, "a count"); }),
              HasSubstr("a: byte 7: -1: expected a count from 0 to 2"));
}

TEST(BinaryFile, IsReadNumberByNumberUpToItsEnd) {
  const std::string raw("\x01\x02\x03\x04\x05", 5);
  Bytes bytes{.bytes = raw, .file = "a", .order = std::endian::big};
  EXPECT_EQ(offline::next<std::uint16_t>(bytes, "a number"), 0x0102);
  bytes.order = std::endian::little;
  EXPECT_EQ(offline::next_integer<std::uint16_t>(bytes, 0x0403, 0x0403, "a number"), 0x0403);
  EXPECT_EQ(place_of(bytes).number, 4U);
  EXPECT_EQ(refusal_of([&] { (void)offline::next<std::uint16_t>(bytes, "a number"); }),
            "a: byte 5: end of file: expected a number");
  EXPECT_EQ(offline::next<std::uint8_t>(bytes, "a number"), 5);  // refused, and not taken
  EXPECT_EQ(offline::left(bytes), 0U);
}

TEST(BinaryFile, IntegersHaveARange) {
  const std::string raw("\xFF\x05", 2);
  for (const int high : {-2, -1}) {
    Bytes bytes{.bytes = raw, .file = "a"};
    const auto take = [&] {
      (void)offline::next_integer<std::int8_t>(bytes, -3, static_cast<std::int8_t>(high), "a key");
    };
    EXPECT_EQ(refusal_of(take), high == -1 ? "" : "a: byte 0: -1: expected a key from -3 to -2");
  }
  Bytes bytes{.bytes = raw, .file = "a", .next = 1};
  EXPECT_EQ(refusal_of([&] { (void)offline::next_integer<std::uint8_t>(bytes, 6, 9, "a key"); }),
            "a: byte 1: 5: expected a key from 6 to 9");
}

// ---- units --------------------------------------------------------------------------------------

TEST(UnitOfAMesh, IsTheUsersOrTheFilesOrMillimetres) {
  ReadMesh silent, inches;
  inches.metres_per_unit = 0.0254;
  EXPECT_EQ(take_metres(silent, "a", {}), 1e-3);
  EXPECT_EQ(take_metres(silent, "a", {.given_m = 1, .scale = 2}), 2);
  EXPECT_EQ(take_metres(inches, "a", {.scale = 2}), 0.0508);
  EXPECT_EQ(take_metres(inches, "a", {.given_m = 0.0254000001}), 0.0254000001);
  EXPECT_THAT(inches.notes, ElementsAre());
  EXPECT_EQ(take_metres(inches, "a", {.given_m = 1e-3}), 1e-3);
  EXPECT_THAT(inches.notes,
              ElementsAre("a: its unit is 0.0254 m, as it says, but --units makes it 0.001 m"));
  EXPECT_THAT(silent.notes, ElementsAre());
}

TEST(UnitOfAMesh, IsInTheOrganIfTheUserGaveIt) {
  const auto text = [](const std::string& given, std::optional<double> said) {
    offline::Input input;
    input.path = "a.bad";
    input.tissue = "gel";
    input.read.metres_per_unit = said;
    offline::BuildOptions options;
    offline::Settings settings;
    settings.units = given;
    choose_for_meshes(settings, {input}, options);
    return options.options_text;
  };
  EXPECT_EQ(text("", {}), " --units mm --scale 1 --capsule none");
  EXPECT_EQ(text("", 1.0), " --scale 1 --capsule none");
  EXPECT_EQ(text("inch", 1.0), " --units inch --scale 1 --capsule none");
  offline::Settings settings;
  settings.units = "inch";
  settings.scale = 3;
  EXPECT_EQ(offline::units_of(settings).given_m, 0.0254);
  EXPECT_EQ(offline::units_of(settings).scale, 3);
  EXPECT_EQ(offline::units_of({}).given_m, std::nullopt);
}

TEST(UnitOfAMesh, MakesNoPointThatLiesFartherThanTenKilometres) {
  const auto scaled = [](double x, std::uint32_t corner) {
    offline::Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -x, 0}}, {{0, 1, corner}}};
    return refusal_of([&] {
      scale_to_metres(mesh, "a.off", 1e-3);
      EXPECT_EQ(mesh.points[1].x, 1e-3);
    });
  };
  EXPECT_EQ(scaled(1e7, 3), "");
  EXPECT_EQ(scaled(1e300, 2), "");  // no triangle uses it
  for (const char* far : {"1.1e+07", "1e+290", "1e+300"}) {
    EXPECT_EQ(scaled(std::stod(far), 3),
              "a.off: point 4 of 4: (0, -" + std::string(far) +
                  ", 0) in units of 0.001 m: expected coordinates up to 10000 m; check --units and "
                  "--scale");
  }
}

// What readers say of the meshes that are built, that hold the organ and that lie in it.
TEST(NotesOfReaders, AreWarningsOfTheBuild) {
  offline::Input input = input_of(box_mesh({0, 0, 0}, {1e-2, 1e-2, 1e-2}), 1);
  input.read.notes = {"of the input"};
  offline::BuildOptions options;
  options.voxel_edge_m = 5e-3;
  options.held = offline::parse_regions({"z<10%"}, {});
  options.held.front().notes = {"of the region"};
  options.membranes = offline::parse_membranes({"x=5:fascia"}, {});
  options.membranes.front().notes = {"of the membrane"};
  const offline::Built built = build_quietly({input}, options);
  EXPECT_THAT(built.report.warnings,
              testing::IsSupersetOf({"of the input", "of the region", "of the membrane"}));
}

}  // namespace
}  // namespace stylet::test
