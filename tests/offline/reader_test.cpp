// SPDX-License-Identifier: Apache-2.0
// Each reader with the spellings of its format, with files that it must refuse, and the words with
// which it refuses.
#include "meshes/reader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <random>

#include "base/file.h"
#include "base/refusal.h"
#include "meshes/read_mesh.h"
#include "offline_support.h"

namespace stylet::test {
namespace {

using offline::Mesh;
using offline::ReadMesh;
using offline::Vec;
using testing::HasSubstr;
using testing::Not;

ReadMesh read(const std::string& name, const std::string& bytes) {
  const Scratch scratch;
  return offline::read_mesh(scratch.write(name, bytes));
}

std::string refusal(const std::string& name, const std::string& bytes) {
  try {
    (void)read(name, bytes);
  } catch (const offline::Refusal& refused) {
    const std::string what = refused.what();
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  }
  return "accepted";
}

// ---- OBJ ----------------------------------------------------------------------------------------

TEST(Obj, DividesPolygonsIntoTrianglesAndAcceptsNegativeIndices) {
  const ReadMesh m = read("a.obj",
                          "v 0 0 0\nv 1 0 0\nv 1 1 0 # comment\nv 0 1 0\n"
                          "vt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3/1 4\nf -4 -3 -2\n");
  ASSERT_EQ(m.mesh.triangles.size(), 3U);
  EXPECT_EQ(m.mesh.triangles[1], (offline::Triangle{0, 2, 3}));
  EXPECT_EQ(m.mesh.triangles[2], (offline::Triangle{0, 1, 2}));
  EXPECT_EQ(m.counts.polygons, 1U);
}

TEST(Obj, JoinsContinuedLinesAndAcceptsWindowsLineEnds) {
  const ReadMesh m = read("a.obj", "v 0 0 \\\r\n0\r\nv 1 0 0\r\nv +1 1e0 0\r\nf 1 2 \\\r\n 3\r\n");
  ASSERT_EQ(m.mesh.points.size(), 3U);
  EXPECT_EQ(m.mesh.points[2], (Vec{1, 1, 0}));
  EXPECT_EQ(m.mesh.triangles.size(), 1U);
}

TEST(Obj, CountsWhatItLeavesOut) {
  const ReadMesh m =
      read("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv nan 0 0\nl 1 2\np 1\nf 1 2\nf 1 2 3\n");
  EXPECT_EQ(m.counts.lines_and_points, 2U);
  EXPECT_EQ(m.counts.short_faces, 1U);
  EXPECT_EQ(m.counts.unusable_points, 1U);
}

TEST(Obj, RefusesWithPlaceAndValue) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_THAT(refusal("a.obj", three + "f 1 2 0\n"), HasSubstr("a.obj:4: '0': expected a point"));
  EXPECT_THAT(refusal("a.obj", three + "f 1 2 7\n"),
              HasSubstr("a.obj:4: 7: expected a point index"));
  EXPECT_THAT(refusal("a.obj", three + "f 1 2 -4\n"), HasSubstr("'-4'"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nv 1 0 1e999\nv 1 1 0\nf 1 2 3\n"),
              HasSubstr("a.obj:2: '1e999': expected finite"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nv 1 2mm 0\nv 1 1 0\nf 1 2 3\n"),
              HasSubstr("a.obj:2: '2mm': expected finite"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\n"), HasSubstr("no usable face"));
}

TEST(Obj, IndicesOfPointsMustBeWholeAndInRange) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  for (const std::string corner :
       {"x", "1.5", "1x", "4294967295", "99999999999999999999", "+-1", "/2", "-"}) {
    EXPECT_THAT(refusal("a.obj", three + "f 1 2 " + corner + "\n"),
                HasSubstr("a.obj:4: '" + corner + "': expected a point index"));
  }
  EXPECT_THAT(refusal("a.obj", three + "f 1 2 \x7f" + std::string(50, '\xe4') + "\n"),
              HasSubstr("a.obj:4: '" + std::string(40, '?') + "...': expected"));
  EXPECT_THAT(refusal("a.obj", three + "f 1 2 " + std::string(40, 'x') + "\n"),
              HasSubstr("a.obj:4: '" + std::string(40, 'x') + "': expected"));
  EXPECT_EQ(read("a.obj", three + "f +1 +2 +3\n").mesh.triangles[0], (offline::Triangle{0, 1, 2}));
}

TEST(Obj, JoinsAsManyLinesAsAreContinued) {
  std::mt19937 engine(6);
  for (int round = 0; round < 100; ++round) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf";
    for (const char* corner : {"1", "2", "3"}) {
      for (auto i = engine() % 3; i > 0; --i) text += engine() % 2 == 0 ? " \\\n" : " \\\r\r\n";
      text += std::string(" ") + corner;
    }
    if (engine() % 2 == 0) text += "\\";  // and nothing after it
    EXPECT_EQ(read("a.obj", text).mesh.triangles, (std::vector{offline::Triangle{0, 1, 2}}))
        << text;
  }
}

TEST(ReadMesh, AcceptsAtMostTenThousandPointsWithoutPosition) {
  const auto with = [](int bad) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
    for (int i = 0; i < bad; ++i) text += "v nan 0 0\n";
    return text + "f 1 2 3\n";
  };
  EXPECT_EQ(read("a.obj", with(10000)).counts.unusable_points, 10000U);
  EXPECT_THAT(refusal("a.obj", with(10001)),
              HasSubstr("10004: 'nan': expected finite coordinates (more than 10000"));
}

// ---- STL ----------------------------------------------------------------------------------------

std::string binary_stl(std::uint32_t claimed, std::uint32_t facets, std::string header = "") {
  header.resize(80, ' ');
  std::string bytes = header;
  bytes.append(reinterpret_cast<const char*>(&claimed), 4);
  for (std::uint32_t i = 0; i < facets; ++i) {
    const float numbers[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(Stl, ReadsText) {
  const ReadMesh m =
      read("a.STL",
           "solid f facet\nFACET normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
           "vertex 0 1 0\nendloop\nendfacet\nendsolid f\n");
  EXPECT_EQ(m.mesh.triangles.size(), 1U);
}

// The facets of a tetrahedron, written with random line ends, blanks, names and capitals.
TEST(Stl, TextMayBeOneLine) {
  std::mt19937 engine(5);
  const auto pick = [&](std::initializer_list<const char*> of) {
    return std::string(of.begin()[engine() % of.size()]);
  };
  for (int round = 0; round < 200; ++round) {
    const std::string gap = pick({" ", "\n", "\r", "\r\n", "\t"});
    std::string text = pick({"", "\xEF\xBB\xBF"}) + pick({"solid", "SOLID", "Solid"}) +
                       pick({"", " a", " made by solid facet works", " facet"}) + gap;
    for (int facet = 0; facet < 4; ++facet) {
      text += "facet normal 0 0" + pick({" 1", " nan"}) + gap + "outer loop" + gap;
      for (int corner = 0; corner < 3; ++corner) {
        const int at = (facet + corner) % 4;
        text += fmt::format("vertex {:d} {:d} {:d}", at == 1, at == 2, at == 3) + gap;
      }
      text += "endloop" + gap + "endfacet" + gap;
    }
    text += "endsolid" + pick({"", " a", " made by solid facet works"}) + pick({"", "\n"});
    const ReadMesh m = read("a.stl", text);
    EXPECT_EQ(m.mesh.triangles.size(), 4U) << text;
    EXPECT_EQ(m.mesh.points.size(), 12U) << text;
  }
}

TEST(Stl, BinaryMayBeginWithSolid) {
  EXPECT_EQ(read("a.stl", binary_stl(2, 2, "solid made by an exporter")).mesh.triangles.size(), 2U);
}

TEST(Stl, RefusesToClaimMoreThanTheFileContains) {
  EXPECT_THAT(
      refusal("a.stl", binary_stl(0xFFFFFFFF, 2)),
      HasSubstr("byte 80: 4294967295: expected a number of triangles from 0 to 2, for which"));
  EXPECT_THAT(refusal("a.stl", binary_stl(3, 6)),
              HasSubstr("byte 80: 3: expected 6 triangles, which 384 bytes hold"));
  EXPECT_EQ(read("a.stl", binary_stl(2, 2) + std::string(400, '\0')).mesh.triangles.size(), 2U);
  EXPECT_THAT(refusal("a.stl", "xx"), HasSubstr("2 bytes"));
  EXPECT_THAT(refusal("a.stl", "solid a\nvertex 0 0 0\nhello\n"), HasSubstr("a.stl:3: 'hello'"));
}

TEST(Stl, TextEndsWithItsLastLoop) {
  EXPECT_THAT(refusal("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
              HasSubstr("a.stl:4: 'end of file': expected endloop"));
  std::string binary = "solid a" + std::string(77, '\0');
  binary[80] = '\5';
  EXPECT_THAT(refusal("a.stl", binary),
              HasSubstr("byte 80: 5: expected a number of triangles from 0 to 0"));
}

TEST(Stl, NamesTheByteOfAnInvalidNumber) {
  std::string bytes = binary_stl(1, 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + 84 + 12, &nan, 4);
  EXPECT_THAT(refusal("a.stl", bytes), HasSubstr("byte 96"));
}

// ---- PLY ----------------------------------------------------------------------------------------

constexpr const char* kPlyHeader =
    "comment free text\nelement camera 1\nproperty list uchar float view\nelement vertex 3\n"
    "property uchar red\nproperty double x\nproperty float y\nproperty short z\n"
    "element face 1\nproperty int flags\nproperty list ushort uint vertex_index\nend_header\n";

template <typename T>
void append(std::string& bytes, T value, bool big) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string binary_ply(bool big) {
  std::string bytes = "ply\nformat " +
                      std::string(big ? "binary_big_endian" : "binary_little_endian") + " 1.0\n" +
                      kPlyHeader;
  append<std::uint8_t>(bytes, 2, big);
  append(bytes, 1.0F, big);
  append(bytes, 2.0F, big);
  for (int i = 0; i < 3; ++i) {
    append<std::uint8_t>(bytes, 255, big);
    append(bytes, i == 1 ? 1.5 : 0.0, big);
    append(bytes, i == 2 ? 2.5F : 0.0F, big);
    append<std::int16_t>(bytes, -7, big);
  }
  append<std::int32_t>(bytes, 9, big);
  append<std::uint16_t>(bytes, 3, big);
  for (std::uint32_t i = 0; i < 3; ++i) append(bytes, i, big);
  return bytes;
}

TEST(Ply, ReadsAnyLayoutInEveryEncoding) {
  const std::string text = std::string("ply\nformat ascii 1.0\n") + kPlyHeader +
                           "2 1 2\n255 0 0 -7\n255 1.5 0 -7\n255 0 2.5 -7\n9 3 0 1 2\n";
  for (const std::string& bytes : {text, binary_ply(false), binary_ply(true)}) {
    const ReadMesh m = read("a.ply", bytes);
    ASSERT_EQ(m.mesh.triangles.size(), 1U);
    EXPECT_EQ(m.mesh.points[1], (Vec{1.5, 0, -7}));
    EXPECT_EQ(m.mesh.points[2], (Vec{0, 2.5, -7}));
  }
}

TEST(Ply, RefusesToClaimMoreThanTheFileContains) {
  std::string cut = binary_ply(false);
  cut.resize(cut.size() - 3);
  EXPECT_THAT(refusal("a.ply", cut), HasSubstr("end of file"));
  EXPECT_THAT(refusal("a.ply",
                      "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\n"
                      "end_header\n"),
              HasSubstr("a.ply:3: '99999999999': expected a number of elements"));
  EXPECT_THAT(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty wide x\n"),
              HasSubstr("a.ply:4: 'wide': expected a type"));
  EXPECT_THAT(refusal("a.ply", "ply\nformat ascii 1.0\n"), HasSubstr("expected end_header"));
}

// Numbers of every type, in every encoding, in any order of the properties.
TEST(Ply, ReadsEveryTypeOfNumber) {
  const std::pair<std::vector<const char*>, std::function<void(std::string&, int, bool)>> types[] =
      {{{"char", "int8"},
        [](auto& s, int v, bool b) { append(s, static_cast<std::int8_t>(v), b); }},
       {{"uchar", "uint8"},
        [](auto& s, int v, bool b) { append(s, static_cast<std::uint8_t>(v), b); }},
       {{"short", "int16"},
        [](auto& s, int v, bool b) { append(s, static_cast<std::int16_t>(v), b); }},
       {{"ushort", "uint16"},
        [](auto& s, int v, bool b) { append(s, static_cast<std::uint16_t>(v), b); }},
       {{"int", "int32"}, [](auto& s, int v, bool b) { append(s, v, b); }},
       {{"uint", "uint32"},
        [](auto& s, int v, bool b) { append(s, static_cast<std::uint32_t>(v), b); }},
       {{"float", "float32"}, [](auto& s, int v, bool b) { append(s, static_cast<float>(v), b); }},
       {{"double", "float64"},
        [](auto& s, int v, bool b) { append(s, static_cast<double>(v), b); }}};
  std::mt19937 engine(9);
  for (int round = 0; round < 300; ++round) {
    const bool big = engine() % 2 == 0, text = engine() % 3 == 0;
    const auto& point = types[engine() % 8];
    const auto &count = types[engine() % 6], &index = types[engine() % 8];
    const auto name = [&](const auto& type) { return std::string(type.first[engine() % 2]); };
    std::string axes = "xyzt{";
    std::shuffle(axes.begin(), axes.end(), engine);
    std::string bytes = "ply\nformat " +
                        std::string(text  ? "ascii"
                                    : big ? "binary_big_endian"
                                          : "binary_little_endian") +
                        " 1.0\nelement nothing 0\nelement vertex 4\n";
    for (const char axis : axes) bytes += "property " + name(point) + " " + axis + "\n";
    bytes += "element face 1\nproperty list " + name(count) + " " + name(index) +
             (engine() % 2 == 0 ? " vertex_index\n" : " vertex_indices\n") +
             "property list uchar uchar flags\nend_header\n";
    const auto put = [&](const auto& type, int value) {
      if (text) bytes += std::to_string(value) + "\n";
      if (!text) type.second(bytes, value, big);
    };
    std::vector<Vec> places;
    for (int i = 0; i < 4; ++i) {
      Vec place;
      for (const char axis : axes) {
        const int value = static_cast<int>(engine() % 100);
        put(point, value);
        (axis == 'x'   ? place.x
         : axis == 'y' ? place.y
                       : place.z) = axis == 't' || axis == '{' ? place.z : value;
      }
      places.push_back(place);
    }
    std::vector<std::uint32_t> corners = {0, 1, 2, 3};
    std::shuffle(corners.begin(), corners.end(), engine);
    put(count, 3);
    for (int i = 0; i < 3; ++i) put(index, static_cast<int>(corners[static_cast<unsigned>(i)]));
    put(types[1], 0);
    const ReadMesh m = read("a.ply", bytes);
    EXPECT_EQ(m.mesh.points, places) << bytes;
    EXPECT_EQ(m.mesh.triangles[0], (offline::Triangle{corners[0], corners[1], corners[2]}))
        << bytes;
  }
}

TEST(Ply, RefusesInvalidHeadersAndIndices) {
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string points = "element vertex 3\nproperty float x\nproperty float y\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_index\nend_header\n";
  const std::pair<std::string, const char*> bad[] = {
      {"property float x\n", "a.ply:3: 'property': expected an element before its properties"},
      {points + "property list float int a\n", "a.ply:6: 'list': expected an integer as its count"},
      {"element vertex 3\n" + faces + "3 0 1 2\n", "3 points without coordinates: expected"},
      {points + "property float z\n" + faces + "0 0 0 1 0 0 1 1 0\n3 0 1 3\n",
       "3: expected a point"},
      {points + "property float z\n" + faces + "0 0 0 1 0 0 1 1 0\n3 0 1 -1\n", "-1: expected a"},
      {points + "property float z\n" + faces + "0 0 0 1 0 0 1 1 0\n3 0 1 .5\n", "0.5: expected a"},
      {points + faces + "0 0 1 0 1 1\n3 0 1 2\n", "expected finite"}};
  for (const auto& [text, reason] : bad) {
    EXPECT_THAT(refusal("a.ply", head + text), HasSubstr(reason)) << text;
  }
  // A list is no coordinate, whatever its name.
  EXPECT_THAT(refusal("a.ply", head + points + "property list uchar float z\n" + faces +
                                   "0 0 1 9\n0 1 1 9\n1 1 1 9\n3 0 1 2\n"),
              HasSubstr("expected finite"));
  std::string binary = binary_ply(false);
  binary[binary.size() - 1] = '\1';  // of the last index
  EXPECT_THAT(refusal("a.ply", binary), HasSubstr("a.ply: byte "));
}

// ---- OFF ----------------------------------------------------------------------------------------

TEST(Off, ReadsGluedCountsCommentsAndColours) {
  const std::string body = "0 0 0\n1 0 0 # c\n\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n";
  for (const char* head : {"  OFF4 1 0 # c\n", "OFF\n4 1 0\n", "OFF 4 1 0\n", "COFF\n# c\n4 1\n"}) {
    const ReadMesh m = read("a.off", head + body);
    EXPECT_EQ(m.mesh.triangles.size(), 2U) << head;
    EXPECT_EQ(m.mesh.points.size(), 4U) << head;
  }
}

TEST(Off, RefusesWithPlace) {
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 3\n"),
              HasSubstr("a.off:6: '3': expected a point index from 0 to 2"));
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n"), HasSubstr("end of file"));
  for (const char* keyword : {"POFF\n", "nOFF 3\n", "4OFF\n", "OF\n"}) {
    EXPECT_THAT(refusal("a.off", keyword), HasSubstr("expected the keyword OFF"));
  }
  EXPECT_THAT(refusal("a.off", "OFF\n-3 1 0\n"), HasSubstr("'-3': expected a number of points"));
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 +-1\n1 0 0\n0 1 0\n3 0 1 2\n"),
              HasSubstr("expected"));
}

// A point or face takes at least two bytes, a digit and the end of its line: 17 bytes cannot hold
// nine.
TEST(Off, RefusesToClaimMoreThanTheFileContains) {
  EXPECT_THAT(refusal("a.off", "OFF\n9 1 0\n0 0 0\n\n"),
              HasSubstr("a.off:2: '9': expected a number of points from 0 to 8"));
  EXPECT_THAT(refusal("a.off", "OFF\n1 9 0\n0 0 0\n\n"),
              HasSubstr("a.off:2: '9': expected a number of faces from 0 to 8"));
}

TEST(Off, WrittenMeshReadsBackToTheBit) {
  const Mesh mesh{{{0.1, 1.0 / 3, -1e-300}, {1e22, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(read("a.off", offline::off_text(mesh)).mesh.points, mesh.points);
}

// Files of Linux in /sys claim the size of a page and end much earlier.
TEST(ReadFile, SaysWhereAFileEndsThatIsShorterThanItsSize) {
  const std::filesystem::path file = "/sys/devices/system/cpu/online";
  SKIP_WITHOUT(file);
  const std::string size = std::to_string(std::filesystem::file_size(file));
  const std::string bytes = std::to_string(slurp(file).size());
  try {
    (void)offline::read_file(file);
    ADD_FAILURE() << "read";
  } catch (const offline::Refusal& refused) {
    EXPECT_THAT(refused.what(), HasSubstr(" after " + bytes + " of " + size + " bytes: expected"));
  }
}

// Root may read every file: if the tests run as root, they read as another user.
TEST(ReadFile, NamesAFileThatOnlyOthersMayRead) {
  constexpr uid_t kNobody = 65534;
  const Scratch scratch;
  const auto file = scratch.write("own.off", "OFF");
  std::filesystem::permissions(scratch.folder, std::filesystem::perms(0755));
  std::filesystem::permissions(file, std::filesystem::perms(0));
  const uid_t tester = ::getuid();
  if (tester == 0) {
    ASSERT_EQ(::setresuid(kNobody, kNobody, 0), 0);
  }
  std::string said;
  try {
    (void)offline::read_file(file);
  } catch (const offline::Refusal& refused) {
    said = refused.what();
  }
  if (tester == 0) {
    ASSERT_EQ(::setresuid(0, 0, 0), 0);
  }
  EXPECT_THAT(said, HasSubstr("own.off: Permission denied: expected a readable file"));
}

TEST(ReadMesh, TakesTextWithAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  for (const auto& [name, text] :
       {std::pair{"a.OBJ", "v 5 6 7\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"},
        std::pair{"a.Off", "OFF\n3 1 0\n5 6 7\n1 0 0\n1 1 0\n3 0 1 2\n"},
        std::pair{"a.PLY",
                  "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                  "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                  "end_header\n5 6 7\n1 0 0\n1 1 0\n3 0 1 2\n"}}) {
    const ReadMesh m = read(name, mark + text);
    ASSERT_EQ(m.mesh.points.size(), 3U) << name;
    EXPECT_EQ(m.mesh.points[0], (Vec{5, 6, 7})) << name;
  }
}

TEST(ReadMesh, RefusesOtherFilesByName) {
  EXPECT_THAT(refusal("a.nii.gz", "x"), HasSubstr("expected a mesh file ending in"));
  EXPECT_THROW((void)offline::read_mesh("/no/such/file.obj"), offline::Refusal);
}

// For every format in the list, also later ones: the ending decides, in capitals or not, and a file
// that is no mesh is refused with its name.
TEST(ReadMesh, KnowsEveryFormatOfTheListByItsEnding) {
  std::string endings;
  for (const offline::MeshFormat& format : offline::kMeshFormats) {
    endings += (endings.empty() ? "" : " ") + std::string(format.ending);
    std::string upper(format.ending);
    for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    for (const std::string& name : {"a" + std::string(format.ending), "a" + upper}) {
      for (const char* bytes : {"", "\n", "hello\n1 2\n"}) {
        const std::string said = refusal(name, bytes);
        EXPECT_THAT(said, HasSubstr(name)) << bytes;
        EXPECT_THAT(said, Not(HasSubstr("expected a mesh file"))) << bytes;
      }
    }
    EXPECT_THAT(refusal("a.nii", ""), HasSubstr(format.ending));
  }
  EXPECT_EQ(offline::mesh_endings(), endings);
  EXPECT_THAT(endings, testing::StartsWith(".obj .stl .ply .off"));
}

// A binary file that is cut anywhere is refused, and crashes no reader.
TEST(ReadMesh, RefusesEveryCut) {
  for (const std::string& whole : {binary_ply(false), binary_stl(2, 2)}) {
    const std::string name = whole.starts_with("ply") ? "a.ply" : "a.stl";
    const auto reader = whole.starts_with("ply") ? offline::read_ply : offline::read_stl;
    for (std::size_t size = 0; size < whole.size(); ++size) {
      try {
        (void)reader(name, whole.substr(0, size));
        ADD_FAILURE() << name << " cut to " << size << " bytes was accepted";
      } catch (const offline::Refusal&) {
      }
    }
  }
}

}  // namespace
}  // namespace stylet::test
