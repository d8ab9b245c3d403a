// SPDX-License-Identifier: Apache-2.0
// NRRD packed by bzip2: random labels, in every type of number and byte order, in one stream or
// several, attached or in separate files. And streams that are not bzip2, end early, or contain
// something else than the header says.
#include <bzlib.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <chrono>
#include <cstring>

#include "base/refusal.h"
#include "label_support.h"
#include "maps/label_map.h"
#include "offline_support.h"
#include "random_bodies.h"

namespace stylet::test {
namespace {

using offline::LabelMap;
using testing::HasSubstr;

std::string packed(const std::string& bytes) {
  auto size = static_cast<unsigned>(bytes.size() + bytes.size() / 100 + 600);  // bzip2's manual
  std::string out(size, '\0');
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(bytes.data()),
                                     static_cast<unsigned>(bytes.size()), 9, 0, 0),
            BZ_OK);
  return out.substr(0, size);
}

// Several streams that follow each other, as parallel packers write them.
std::string packed_in_parts(Draw& draw, const std::string& bytes) {
  std::string out;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t size = 1 + draw.below(bytes.size() - at);
    out += packed(bytes.substr(at, size));
    at += size;
  }
  return out;
}

std::string header(const std::string& type, const std::string& sizes, const std::string& more) {
  return "NRRD0004\ntype: " + type + "\ndimension: 3\nspacings: 1 2 3\nsizes: " + sizes +
         "\nencoding: bzip2\n" + more;
}

template <typename T>
void expect_labels_as(const char* type) {
  const Scratch scratch;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Draw draw(seed);
    const std::array<std::size_t, 3> size = {1 + draw.below(40), 1 + draw.below(40),
                                             1 + draw.below(40)};
    const bool big = draw.below(2) == 0;
    std::vector<std::uint16_t> labels;
    std::string voxels;
    for (std::size_t i = 0; i < size[0] * size[1] * size[2]; ++i) {
      labels.push_back(static_cast<std::uint16_t>(draw.below(100)));
      const auto value = static_cast<T>(labels.back());
      std::array<char, sizeof(T)> raw{};
      std::memcpy(raw.data(), &value, sizeof(T));
      if (big) std::reverse(raw.begin(), raw.end());
      voxels.append(raw.data(), sizeof(T));
    }
    const std::string sizes = fmt::format("{} {} {}", size[0], size[1], size[2]);
    const std::string endian = std::string("endian: ") + (big ? "big" : "little") + "\n";
    const std::string head = header(type, sizes, endian);
    const std::size_t half = voxels.size() / sizeof(T) / 2 * sizeof(T);
    scratch.write("a.bz2", packed(voxels.substr(0, half)));
    scratch.write("b.bz2", packed_in_parts(draw, voxels.substr(half)));
    for (const auto& path :
         {scratch.write("one.nrrd", head + "\n" + packed(voxels)),
          scratch.write("parts.nrrd", head + "byte skip: 0\n\n" + packed_in_parts(draw, voxels)),
          scratch.write("files.nhdr", head + "data file: LIST\na.bz2\nb.bz2\n")}) {
      const LabelMap map = offline::read_label_map(path);
      EXPECT_EQ(map.label, labels) << path << type << seed;
      EXPECT_EQ(map.step_m[2], (offline::Vec{0, 0, 3e-3}));
    }
  }
}

TEST(Bzip2, LabelsAreReadFromEveryTypeOfNumber) {
  expect_labels_as<std::int8_t>("signed char");
  expect_labels_as<std::uint8_t>("uchar");
  expect_labels_as<std::int16_t>("short");
  expect_labels_as<std::uint16_t>("uint16_t");
  expect_labels_as<std::int32_t>("signed int");
  expect_labels_as<std::uint32_t>("unsigned int");
  expect_labels_as<std::int64_t>("long long int");
  expect_labels_as<std::uint64_t>("uint64");
  expect_labels_as<float>("float");
  expect_labels_as<double>("double");
}

TEST(Bzip2, LayersOfSlicerAreRead) {
  const Scratch scratch;
  const auto path = scratch.write(
      "a.seg.nrrd",
      "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 1 1\nspace: left-posterior-superior\n"
      "space directions: none (2,0,0) (0,3,0) (0,0,4)\nspace origin: (0,0,0)\n"
      "kinds: list domain domain domain\nencoding: bz2\nSegment0_ID:=a\nSegment0_Name:=Liver\n"
      "Segment0_LabelValue:=1\nSegment0_Layer:=0\nSegment1_ID:=b\nSegment1_Name:=Vein\n"
      "Segment1_LabelValue:=1\nSegment1_Layer:=1\n\n" +
          packed(std::string("\1\0\0\1", 4)));
  const LabelMap map = offline::read_label_map(path);
  EXPECT_EQ(map.label, (std::vector<std::uint16_t>{1, 2}));
  EXPECT_EQ(map.names, (offline::LabelNames{{1, "Liver"}, {2, "Vein"}}));
}

TEST(Bzip2, ValuesOfNoSegmentAreReported) {
  const Scratch scratch;
  const auto file = [&](const char* value) {
    return scratch.write(
        "a.seg.nrrd",
        fmt::format("NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 3 1 1\nspace: LPS\nspace "
                    "directions: none (2,0,0) (0,3,0) (0,0,4)\nspace origin: (0,0,0)\nkinds: list "
                    "domain domain domain\nencoding: bz2\nSegment0_Name:=Liver\n"
                    "Segment0_LabelValue:={}\nSegment0_Layer:=0\nSegment1_Name:=Vein\n"
                    "Segment1_LabelValue:=1\nSegment1_Layer:=1\n\n",
                    value) +
            packed(std::string("\1\0\0\3\2\1", 6)));
  };
  const LabelMap map = offline::read_label_map(file("1"));
  EXPECT_EQ(map.label, (std::vector<std::uint16_t>{1, 0, 2}));
  EXPECT_THAT(map.notes, testing::Contains(testing::HasSubstr(
                             "2 voxels have a value that no segment of their layer has (first 3 in "
                             "layer 1): left out")));
  EXPECT_THAT(refusal_of(file("0")),
              testing::HasSubstr("Segment0_LabelValue 0: expected 1 to 65535"));
}

// Layers may be along any axis that is not spatial.
TEST(Bzip2, LayersOnAnyAxisAreRead) {
  const Scratch scratch;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Draw draw(seed);
    const std::size_t place = draw.below(4), layers = 2 + draw.below(2);
    const std::array<std::size_t, 3> size = {1 + draw.below(4), 1 + draw.below(4),
                                             1 + draw.below(4)};
    std::vector<std::size_t> sizes(size.begin(), size.end());
    sizes.insert(sizes.begin() + static_cast<std::ptrdiff_t>(place), layers);
    std::string kinds = "kinds:", spacings = "spacings:", lengths = "sizes:", segments;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      kinds += axis == place ? " list" : " domain";
      spacings += axis == place ? " nan" : " 1";
      lengths += fmt::format(" {}", sizes[axis]);
    }
    for (std::size_t layer = 0; layer < layers; ++layer) {
      segments += fmt::format("Segment{0}_ID:=s{0}\nSegment{0}_Name:=S{0}\n", layer);
      segments += fmt::format("Segment{0}_LabelValue:=1\nSegment{0}_Layer:={0}\n", layer);
    }
    // The layer of each labelled voxel; in the file the first axis is the fastest.
    std::vector<std::uint16_t> expected;
    for (std::size_t i = 0; i < size[0] * size[1] * size[2]; ++i) {
      expected.push_back(static_cast<std::uint16_t>(draw.below(layers + 1)));
    }
    std::string voxels;
    std::array<std::size_t, 4> at{};
    for (at[3] = 0; at[3] < sizes[3]; ++at[3]) {
      for (at[2] = 0; at[2] < sizes[2]; ++at[2]) {
        for (at[1] = 0; at[1] < sizes[1]; ++at[1]) {
          for (at[0] = 0; at[0] < sizes[0]; ++at[0]) {
            std::vector<std::size_t> in_space(at.begin(), at.end());
            in_space.erase(in_space.begin() + static_cast<std::ptrdiff_t>(place));
            const std::size_t voxel = (in_space[2] * size[1] + in_space[1]) * size[0] + in_space[0];
            voxels += static_cast<char>(expected[voxel] == at[place] + 1 ? 1 : 0);
          }
        }
      }
    }
    const LabelMap map = offline::read_label_map(scratch.write(
        "a.seg.nrrd", "NRRD0004\ntype: uchar\ndimension: 4\n" + lengths + "\n" + spacings + "\n" +
                          kinds + "\nencoding: bzip2\n" + segments + "\n" + packed(voxels)));
    EXPECT_EQ(map.label, expected) << seed;
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(map.size[axis], size[axis]) << seed;
  }
}

// Lines are skipped in each file before it is unpacked, bytes after that: as in teem's
// encodingBzip2.c, with which ITK and 3D Slicer read.
TEST(Bzip2, LinesAndBytesAreSkipped) {
  const Scratch scratch;
  Draw draw(3);
  std::string voxels;
  std::vector<std::uint16_t> labels;
  for (int i = 0; i < 64; ++i) {
    labels.push_back(static_cast<std::uint16_t>(draw.below(100)));
    voxels += static_cast<char>(labels.back());
  }
  const std::string skips = "line skip: 2\nbyte skip: 1\n";
  const auto file_of = [&](std::size_t from, std::size_t size) {
    return "one\r\n\n" + packed(fmt::format("1{}", voxels.substr(from, size)));
  };
  scratch.write("a.bz2", file_of(0, 40));
  scratch.write("b.bz2", file_of(40, 24));
  const std::string files = "data file: LIST\na.bz2\nb.bz2\n";
  for (const auto& path :
       {scratch.write("one.nrrd", header("uchar", "4 4 4", skips) + "\n" + file_of(0, 64)),
        scratch.write("two.nhdr", header("uchar", "4 4 4", skips + files))}) {
    EXPECT_EQ(offline::read_label_map(path).label, labels) << path;
  }
  const auto said = [&](const std::string& more, const std::string& data) {
    return refusal_of(scratch.write("a.nrrd", header("uchar", "4 4 4", more) + "\n" + data));
  };
  EXPECT_THAT(said("line skip: 2\n", "one\n"), HasSubstr("1 lines before the voxels: expected 2"));
  EXPECT_THAT(said("byte skip: 70\n", packed(voxels)), HasSubstr("fewer than 70 bytes"));
  EXPECT_EQ(said("byte skip: 64\n", packed(voxels + voxels)), "");
  EXPECT_EQ(said("byte skip: 2000000\n", packed(std::string(2000064, '\0'))), "");
  EXPECT_THAT(said("byte skip: 64\n", packed(voxels)), HasSubstr("0 bytes were unpacked"));
  EXPECT_THAT(said("byte skip: -1\n", packed(voxels)), HasSubstr("a byte skip from 0"));
  EXPECT_THAT(said("line skip: -1\n", packed(voxels)), HasSubstr("expected whole numbers from 0"));
  EXPECT_THAT(said("byte skip: 268435457\n", packed(voxels)), HasSubstr("from 0 to 268435456"));
  EXPECT_THAT(said("byte skip: 1 2\n", packed(voxels)), HasSubstr("expected one number"));
}

// Streams that are cut at any place or have changed bytes: none is taken for complete.
TEST(Bzip2, CutOrDamagedStreamsAreRefusedWithThePlace) {
  const Scratch scratch;
  Draw draw(5);
  std::string voxels;
  for (int i = 0; i < 4096; ++i) voxels += static_cast<char>(draw.below(4));
  const std::string head = header("uchar", "16 16 16", "\n"), whole = packed(voxels);
  for (std::size_t size = 0; size < whole.size(); size += 1 + draw.below(20)) {
    EXPECT_THAT(refusal_of(scratch.write("a.nrrd", head + whole.substr(0, size))),
                AnyOf(HasSubstr(" unpacked bytes: "), HasSubstr(" bytes of voxels")))
        << size;
  }
  // Except for the digit that gives the size of blocks, and the bits that fill up the last byte.
  constexpr std::size_t kDigit = 3;
  for (int round = 0; round < 200; ++round) {
    std::string damaged = whole;
    const std::size_t at = draw.below(damaged.size() - 1);
    if (at == kDigit) continue;
    damaged[at] ^= static_cast<char>(1U << draw.below(8));
    EXPECT_THAT(refusal_of(scratch.write("a.nrrd", head + damaged)), HasSubstr("expected "));
  }
  EXPECT_THAT(refusal_of(scratch.write("a.nrrd", head + whole + "tail")),
              HasSubstr("damaged after 4096 unpacked bytes"));
  EXPECT_THAT(
      refusal_of(scratch.write("a.nrrd", header("uchar", "1 1 1", "\n") + packed("1") + "tail")),
      HasSubstr("damaged after 1 unpacked bytes"));
}

TEST(Bzip2, OtherVoxelsThanTheHeaderAnnouncesAreRefused) {
  const Scratch scratch;
  const auto said = [&](const char* type, const char* sizes, const char* more, std::size_t bytes) {
    return refusal_of(scratch.write(
        "a.nrrd", header(type, sizes, more) + "\n" + packed(std::string(bytes, '\0'))));
  };
  EXPECT_EQ(said("uchar", "4 4 4", "", 64), "");
  EXPECT_THAT(said("uchar", "4 4 4", "", 63), HasSubstr("64 bytes of voxels: 63 bytes were"));
  EXPECT_THAT(said("uchar", "4 4 4", "", 65), HasSubstr("64 bytes of voxels: 65 or more were"));
  EXPECT_THAT(said("uchar", "4 4 4", "", std::size_t{1} << 24U), HasSubstr("65 or more were"));
  EXPECT_THAT(said("short", "4 4 4", "", 128), HasSubstr("expected the field endian"));
  EXPECT_THAT(said("short", "4 4 4", "endian: middle\n", 128), HasSubstr("expected little or big"));
  EXPECT_THAT(said("short", "4 4 4", "endian: big\n", 127), HasSubstr("128 bytes of voxels"));
  EXPECT_THAT(said("signed float", "4 4 4", "endian: big\n", 256), HasSubstr("expected whole or"));
  EXPECT_THAT(said("uchar", "40000 40000 1", "", 64), HasSubstr("expected a smaller image"));
  EXPECT_THAT(refusal_of(scratch.write(
                  "a.nrrd",
                  "NRRD0004\ntype: uchar\ndimension: 4\nkinds: list domain domain domain"
                  "\nspacings: nan 1 1 1\nsizes: 4611686018427387904 2 2 2\n"
                  "encoding: bzip2\n\nBZh9")),
              HasSubstr("more than 268435456 values"));
  EXPECT_THAT(refusal_of(scratch.write(
                  "a.nrrd",
                  "NRRD0004\ntype: uchar\ndimension: 4\nkinds: list domain domain domain"
                  "\nspacings: nan 1 1 1\nsizes: 2 16384 16384 1\nencoding: bzip2\n\nBZh9")),
              HasSubstr("more than 268435456 values"));
}

// Headers that claim 250 million voxels, over a few bytes; and half a gigabyte of zeros in 500
// bytes, over a header that claims 64 voxels.
TEST(Bzip2, CostsGrowWithTheBytesNotWithTheClaim) {
  const Scratch scratch;
  const auto start = std::chrono::steady_clock::now();
  const std::string some = packed(std::string(1000, '\0'));
  EXPECT_THAT(refusal_of(scratch.write("a.nrrd", header("uchar", "16384 16384 1", "\n") + some)),
              HasSubstr("1000 bytes were unpacked"));
  EXPECT_THAT(refusal_of(scratch.write("a.nrrd", header("uchar", "268435456 1 1", "\n") + some)),
              HasSubstr("1000 bytes were unpacked"));
  std::string bomb;
  const std::string nothing = packed(std::string(std::size_t{1} << 26U, '\0'));
  for (int i = 0; i < 8; ++i) bomb += nothing;
  EXPECT_LT(bomb.size(), 1000U);
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  EXPECT_THAT(refusal_of(scratch.write("a.nrrd", header("uchar", "4 4 4", "\n") + bomb)),
              HasSubstr("65 or more were"));
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64L << 10U);  // KiB
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

}  // namespace
}  // namespace stylet::test
