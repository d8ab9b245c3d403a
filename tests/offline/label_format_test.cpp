// SPDX-License-Identifier: Apache-2.0
// What headers of label maps claim is compared with the existing bytes, and must not contradict
// itself. Maps and frames are random; expected positions come from rotations given as axis and
// angle.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <random>

#include "base/refusal.h"
#include "label_support.h"
#include "maps/header.h"
#include "maps/label_map.h"
#include "maps/names.h"
#include "maps/readers.h"
#include "offline_support.h"
#include "random_bodies.h"

namespace stylet::test {
namespace {

using offline::LabelMap;
using offline::Vec;
using testing::HasSubstr;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// ---- what is counted ---------------------------------------------------------------------------

// Each voxel counts at its position in space.
TEST(LabelMap, CountsEachLabelAndSaysWhereItsMiddleIs) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    Draw draw(seed);
    LabelMap map;
    const std::array<Vec, 3> frame = random_frame(draw);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      map.size[axis] = static_cast<std::uint32_t>(1 + draw.below(9));
      map.step_m[axis] = frame[axis] * draw.between(0.5e-3, 3e-3);
    }
    map.origin_m = draw.direction() * 0.2;
    struct Label {
      std::size_t voxels = 0;
      Vec sum_m;
    };
    std::map<std::uint16_t, Label> expected;
    const std::array<std::uint16_t, 4> labels = {0, 1, 300, 65535};
    for (std::uint32_t z = 0; z < map.size[2]; ++z) {
      for (std::uint32_t y = 0; y < map.size[1]; ++y) {
        for (std::uint32_t x = 0; x < map.size[0]; ++x) {
          map.label.push_back(labels[draw.below(4)]);
          if (map.label.back() == 0) continue;
          Label& label = expected[map.label.back()];
          ++label.voxels;
          label.sum_m = label.sum_m + map.origin_m + map.step_m[0] * x + map.step_m[1] * y +
                        map.step_m[2] * z;
        }
      }
    }
    const std::vector<offline::LabelCount> counts = offline::count_labels(map);
    ASSERT_EQ(counts.size(), expected.size());
    auto next = expected.begin();
    for (const offline::LabelCount& each : counts) {
      EXPECT_EQ(std::pair(each.label, each.voxels), std::pair(next->first, next->second.voxels));
      const Vec middle_m = next->second.sum_m * (1.0 / static_cast<double>(each.voxels));
      EXPECT_LT(length(each.centroid_m - middle_m), 1e-12);
      ++next;
    }
  }
}

// ---- what is claimed and what is there ----------------------------------------------------------

using Sizes = std::array<std::string, 3>;

std::string nrrd(const Sizes& n, const std::string& encoding, const std::string& voxels) {
  return "NRRD0004\ntype: uchar\ndimension: 3\nspacings: 1 1 1\nsizes: " + n[0] + " " + n[1] + " " +
         n[2] + "\nencoding: " + encoding + "\n\n" + voxels;
}

std::string meta(const Sizes& n, const std::string& keys, const std::string& voxels) {
  return "ObjectType = Image\nNDims = 3\nElementSpacing = 1 1 1\nDimSize = " + n[0] + " " + n[1] +
         " " + n[2] + "\nElementType = MET_UCHAR\n" + keys + "ElementDataFile = LOCAL\n" + voxels;
}

std::string inr(const Sizes& n, const std::string& voxels) {
  std::string head = "#INRIMAGE-4#{\nXDIM=" + n[0] + "\nYDIM=" + n[1] + "\nZDIM=" + n[2] +
                     "\nVDIM=1\nTYPE=unsigned fixed\nPIXSIZE=8 bits\nCPU=decm\nVX=1\nVY=1\nVZ=1\n";
  head.resize(252, '\n');
  return head + "##}\n" + voxels;
}

// The same voxels in every spelling, first with a correct header and then with one that claims
// more.
TEST(LabelHeader, MustNotClaimMoreVoxelsThanThereAre) {
  const Scratch scratch;
  std::mt19937 random(11);
  for (int round = 0; round < 40; ++round) {
    std::array<std::size_t, 3> size{};
    for (std::size_t& each : size) each = 1 + random() % 6;
    std::string voxels;
    for (std::size_t i = 0; i < size[0] * size[1] * size[2]; ++i) {
      voxels += static_cast<char>(random() % 4);
    }
    const auto files = [&](const Sizes& n) {
      const std::string zlib = deflated(voxels);
      return std::vector<std::filesystem::path>{
          scratch.write("a.nrrd", nrrd(n, "raw", voxels)),
          scratch.write("b.nrrd", nrrd(n, "gzip", zlib)),
          scratch.write("a.mha", meta(n, "", voxels)), scratch.write("a.inr", inr(n, voxels)),
          scratch.write("a.inr.gz", deflated(inr(n, voxels)))};
    };
    const Sizes right = {std::to_string(size[0]), std::to_string(size[1]), std::to_string(size[2])};
    for (const auto& path : files(right)) {
      const LabelMap map = offline::read_label_map(path);
      EXPECT_EQ(std::string(map.label.begin(), map.label.end()), voxels) << path;
    }
    // Sizes for far more voxels than there are, negative ones, and ones whose products overflow.
    const char* const wrong[] = {
        "40000", "-1",  "0", "4294967296", "65536", "-40000", "99999999999999999999", "x",
        "2.5",   "1e3", ""};
    Sizes claimed = right;
    const std::string& taken = claimed[random() % 3] = wrong[random() % std::size(wrong)];
    for (const auto& path : files(claimed)) {
      EXPECT_THAT(refusal_of(path), HasSubstr("expected")) << path << " " << taken;
    }
  }
}

// With these a library would take gigabytes of memory for a file of 200 bytes, or never return.
TEST(LabelHeader, CostsGrowWithTheBytesNotWithTheClaim) {
  const Scratch scratch;
  const Sizes large = {"16384", "16384", "1"}, small = {"2", "2", "2"};
  const std::pair<std::string, const char*> files[] = {
      {scratch.write("raw.nrrd", nrrd(large, "raw", "ab")), "bytes are there"},
      {scratch.write("gzip.nrrd", nrrd(large, "gzip", deflated("ab"))), "bytes are there"},
      {scratch.write("text.nrrd", nrrd(large, "ascii", "1 2")), "bytes are there"},
      {scratch.write("hex.nrrd", nrrd(large, "hex", "0102")), "bytes are there"},
      {scratch.write(
           "many.nrrd",
           "NRRD0004\ntype: uchar\ndimension: 4\nkinds: list domain domain "
           "domain\nspacings: nan 1 1 1\nsizes: 4611686018427387904 2 2 2\nencoding: raw\n\nab"),
       "bytes are there"},
      {scratch.write("far.nrrd", nrrd(small, "raw\nbyte skip: 99999999999", "abcdefgh")),
       "header line 7: byte skip: 99999999999: expected"},
      {scratch.write("back.nrrd", nrrd(small, "raw\nline skip: -1", "abcdefgh")),
       "header line 7: line skip: -1: expected"},
      {scratch.write("wide.nrrd",
                     "NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\n"
                     "space directions: (1e200,0,0) (0,1e200,0) (0,0,1e200)\n"
                     "space origin: (0,0,0)\nsizes: 2 2 2\nencoding: raw\n\nabcdefgh"),
       "span inf mm3 a voxel: expected"},
      {scratch.write("twice.nrrd", nrrd(small, "raw\nsizes: 9 9 9", "abcdefgh")),
       "sizes: expected"},
      {scratch.write("a.nhdr", nrrd(small, "raw\ndata file: /dev/zero", "")),
       "/dev/zero: is a device"},
      {scratch.write("b.nhdr", nrrd(small, "raw\ndata file: %s%n 1 2 1", "")), "one %d or %0Nd"},
      {scratch.write("raw.mha", meta(large, "", "ab")), "bytes are there"},
      {scratch.write("zip.mha",
                     meta(large, "CompressedData = True\nCompressedDataSize = 2\n", "ab")),
       "bytes are there"},
      {scratch.write("text.mha", meta(large, "BinaryData = False\n", "1 2")), "bytes are there"},
      {scratch.write(
           "size.mha",
           meta(small, "CompressedData = True\nCompressedDataSize = 9999999999\n", "abcdefgh")),
       "CompressedDataSize = 9999999999: expected"},
      {scratch.write("part.mha", meta(small, "ElementNumberOfChannels = 2147483647\n", "abcdefgh")),
       "several values a voxel"},
      {scratch.write("name.mha",
                     meta(small, "Comment = " + std::string(5000, 'c') + "\n", "abcdefgh")),
       "5000 characters: expected at most"},
      {scratch.write("a.mhd",
                     "NDims = 3\nDimSize = 2 2 2\nElementSpacing = 1 1 1\nElementType = MET_UCHAR\n"
                     "ElementDataFile = /dev/zero\n"),
       "/dev/zero: is a device"},
      {scratch.write("minus.mha", "NDims = -3\nDimSize = 2 2 2\nElementDataFile = LOCAL\nabcdefgh"),
       "header line 1: NDims = -3: expected whole numbers from 1 to 10"},
      {scratch.write("axes.mha", "NDims = 3000000000\nElementDataFile = LOCAL\nabcdefgh"),
       "NDims = 3000000000: expected"},
      {scratch.write("raw.inr", inr(large, "ab")), "bytes are there"},
      {scratch.write("other.inr", "P5\n16384 16384\n255\nab"),
       "expected the header of an Inrimage"}};
  for (const auto& [path, reason] : files) EXPECT_THAT(refusal_of(path), HasSubstr(reason)) << path;
#ifndef STYLET_SANITIZED
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  EXPECT_LT(use.ru_maxrss, 200L << 10U);  // KiB
#endif
}

// Deflate's longest match, of 258 bytes, takes at least two bits: one for its length, one for its
// distance.
TEST(LabelHeader, MustNotClaimMoreThanItsBytesCanContain) {
  std::mt19937_64 engine(3);
  for (int round = 0; round < 200; ++round) {
    const std::uint64_t held = 1 + engine() % 1000;
    offline::Claim claim;
    claim.packed = engine() % 2 == 0;
    claim.text = engine() % 4 == 0;
    claim.bytes_each = std::uint64_t{1} << engine() % 4;
    const std::uint64_t bytes = claim.packed ? held * 258 * 8 / 2 : held;
    const std::uint64_t most = claim.text ? bytes : bytes / claim.bytes_each;
    if (most == 0) continue;
    claim.sizes = {1, 1, 1};
    claim.sizes[engine() % 3] = most;
    EXPECT_NO_THROW(offline::require_held("a", claim, held));
    claim.sizes[engine() % 3] *= most + 1;
    EXPECT_THROW(offline::require_held("a", claim, held), offline::Refusal) << most;
  }
}

// MetaIO copies texts, also those of digits, into fields of 255 characters; CGAL takes lines of
// 255.
TEST(LabelHeader, TextsAreNoLongerThanTheirReadersAllow) {
  const Scratch scratch;
  const Sizes n = {"2", "2", "2"};
  for (const std::string key : {"Comment", "Name", "AcquisitionDate", "Modality", "Anything"}) {
    for (const char c : {'c', '1', '-'}) {
      const auto said = [&](std::size_t count) {
        const auto text = key + " = " + std::string(count, c) + "\n";
        return refusal_of(scratch.write("a.mha", meta(n, text, "abcdefgh")));
      };
      EXPECT_EQ(said(250), "") << key << c;
      for (const std::size_t count : {251U, 255U, 300U, 4000U}) {
        EXPECT_THAT(said(count), HasSubstr(fmt::format("header line 6: {}: {} characters: "
                                                       "expected at most 250",
                                                       key, count)));
      }
    }
  }
  const std::string zeros(400, '0');
  const auto offset = "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1." + zeros + " 2 3\n";
  const LabelMap map = offline::read_label_map(scratch.write("a.mha", meta(n, offset, "abcdefgh")));
  EXPECT_EQ(map.origin_m, (Vec{1, 2, 3} * 1e-3));
  const auto said_of = [&](const std::string& line) {
    return refusal_of(scratch.write("a.mha", meta(n, line + "\n", "abcdefgh")));
  };
  for (const std::string key : {"Offset", "DimSize2"}) {
    const std::size_t most = key == "Offset" ? 4000 : 250;  // a list's field has 4096
    const auto line = [&](std::size_t count) {
      return key + " = 1." + std::string(count - 6, '0') + " 2 3";
    };
    EXPECT_EQ(said_of("TransformMatrix = 1 0 0 0 1 0 0 0 1\n" + line(most)), "");
    EXPECT_THAT(said_of(line(most + 1)),
                HasSubstr(fmt::format("{} characters: expected at most {}", most + 1, most)));
  }
  EXPECT_EQ(said_of(std::string(250, 'k') + "= 1"), "");
  EXPECT_THAT(said_of(std::string(251, 'k') + "= 1"),
              HasSubstr("header line 6: expected KEY = VALUE"));
  const auto header = [&](std::size_t count) {
    std::string text = inr(n, "abcdefgh");
    const std::string line = "NOTE=" + std::string(count - 5, 'n') + "\n";
    return refusal_of(scratch.write("a.inr", text.replace(text.find("VX="), 0, line)));
  };
  EXPECT_EQ(header(255), "");
  EXPECT_THAT(header(256), HasSubstr("header line 9: expected at most 255 characters"));
}

// The end of the library's message tells why; the beginning only names its own functions.
TEST(LabelHeader, OfAFileThatALibraryCannotReadSaysItsReason) {
  const Scratch scratch;
  EXPECT_THAT(refusal_of(scratch.write("a.nrrd", nrrd({"2", "2", "2"}, "raw", "abcdefg"))),
              testing::ContainsRegex("a.nrrd: cannot be read: .*fread got only 7 .*, not 8"));
}

// The first and last characters of each length, and byte sequences that table 3-7 of the Unicode
// Standard excludes.
TEST(LabelNames, ShowAQuestionMarkForEachByteThatIsNoCharacter) {
  const std::pair<std::string, std::string> shown[] = {
      {"Gr\xc3\xb6\xc3\x9f"
       "e",
       "Gr\xc3\xb6\xc3\x9f"
       "e"},
      {"\xc2\x80\xdf\xbf", "\xc2\x80\xdf\xbf"},
      {"\xe0\xa0\x80\xed\x9f\xbf", "\xe0\xa0\x80\xed\x9f\xbf"},
      {"\xf0\x90\x80\x80\xf4\x8f\xbf\xbf", "\xf0\x90\x80\x80\xf4\x8f\xbf\xbf"},
      {"a\xffz", "a?z"},
      {"\xc1\xbf", "??"},
      {"\xe0\x9f\xbf", "???"},
      {"\xed\xa0\x80", "???"},
      {"\xf0\x8f\xbf\xbf", "????"},
      {"\xf4\x90\x80\x80", "????"},
      {"\xc3", "?"},
      {"\xc3z", "?z"},
      {"\xe2z\xa1", "?z?"},
      {"\xe2\x82z", "??z"},
      {"\xf0\x90\x80z", "???z"},
      {"a\tb\x7f", "a?b?"}};
  for (const auto& [name, expected] : shown) EXPECT_EQ(offline::printable(name), expected);
}

// MetaIO's and teem's names of types, whether their numbers are real, and their bytes.
struct Type {
  std::vector<std::string> names;
  bool real;
  std::size_t bytes;
};

TEST(LabelHeader, KnowsTheBytesOfEveryTypeOfNumber) {
  const Type types[] = {
      {{"MET_CHAR", "MET_UCHAR", "signed char", "int8", "int8_t", "uchar", "unsigned char", "uint8",
        "uint8_t"},
       false,
       1},
      {{"MET_SHORT", "MET_USHORT", "short", "short int", "signed short", "int16", "int16_t",
        "ushort", "unsigned short int", "uint16", "uint16_t"},
       false,
       2},
      {{"MET_INT", "MET_UINT", "MET_LONG", "MET_ULONG", "int", "signed int", "int32", "int32_t",
        "uint", "unsigned int", "uint32", "uint32_t"},
       false,
       4},
      {{"MET_LONG_LONG", "MET_ULONG_LONG", "longlong", "long long int", "signed long long", "int64",
        "int64_t", "ulonglong", "unsigned long long int", "uint64", "uint64_t"},
       false,
       8},
      {{"MET_FLOAT", "float"}, true, 4},
      {{"MET_DOUBLE", "double"}, true, 8}};
  const Scratch scratch;
  for (const Type& type : types) {
    std::string voxels;
    for (int i = 0; i < 512; ++i) {
      const float single = static_cast<float>(i % 8);
      const double real = i % 8;
      char raw[8] = {static_cast<char>(i % 8)};  // a small number, its lowest byte first
      if (type.real && type.bytes == 4) std::memcpy(raw, &single, 4);
      if (type.real && type.bytes == 8) std::memcpy(raw, &real, 8);
      voxels.append(raw, type.bytes);
    }
    for (const std::string& name : type.names) {
      const auto file = [&](std::size_t bytes) {
        const std::string data = voxels.substr(0, bytes);
        if (name.starts_with("MET_")) {
          return scratch.write("a.mha",
                               "NDims = 3\nDimSize = 8 8 8\nElementSpacing = 1 1 1\n"
                               "ElementType = " +
                                   name + "\nElementDataFile = LOCAL\n" + data);
        }
        return scratch.write("a.nrrd", "NRRD0004\ntype: " + name +
                                           "\ndimension: 3\nspacings: 1 1 1\nsizes: 8 8 8\n"
                                           "endian: little\nencoding: raw\n\n" +
                                           data);
      };
      const LabelMap map = offline::read_label_map(file(voxels.size()));
      for (std::size_t i = 0; i < 512; ++i) ASSERT_EQ(map.label[i], i % 8) << name;
      EXPECT_EQ(map.step_m, (std::array{Vec{1e-3, 0, 0}, Vec{0, 1e-3, 0}, Vec{0, 0, 1e-3}}));
      // Half the size: the file, header included, has more bytes than numbers of half the size
      // need.
      EXPECT_THAT(refusal_of(file(voxels.size() / 2)),
                  HasSubstr(fmt::format("8 x 8 x 8 voxels of {} bytes: ", type.bytes)))
          << name;
    }
  }
}

TEST(LabelHeader, OfSeveralFilesHasTheBytesOfAll) {
  const Scratch scratch;
  const auto header = scratch.write(
      "a.nhdr",
      "NRRD0004\ntype: uchar\ndimension: 3\nspacings: 1 1 1\nsizes: 2 2 2\nencoding: raw\n"
      "data file: v.raw\n");
  const auto sum_with = [&](const std::string& voxels) {
    scratch.write("v.raw", voxels);
    return offline::read_label_map(header).sha256;
  };
  EXPECT_EQ(sum_with("\1\1\1\1\1\1\1\1"), sum_with("\1\1\1\1\1\1\1\1"));
  EXPECT_NE(sum_with("\1\1\1\1\1\1\1\1"), sum_with("\1\1\1\1\1\1\1\2"));
}

// ---- NIfTI --------------------------------------------------------------------------------------

// A file of 2 x 3 x 4 voxels, as either version has it.
struct Nifti {
  std::array<double, 8> pixdim{1, 1, 1, 1, 0, 0, 0, 0};
  int qform_code = 0, sform_code = 0, units = 2, datatype = 2, version = 1;
  double voxels_at = -1, slope = 1, inter = 0;  // -1: the right value
  std::array<double, 3> quatern{}, qoffset{};
  std::array<double, 12> srow{};
  std::string extension;
  std::string voxels = std::string(24, '\1');
  bool swapped = false;
};

std::string bytes_of(const Nifti& n) {
  const bool two = n.version == 2;
  std::string head(two ? 540 : 348, '\0');
  const auto put = [&](std::size_t at, auto value) {
    std::array<char, sizeof value> raw{};
    std::memcpy(raw.data(), &value, sizeof value);
    if (n.swapped) std::reverse(raw.begin(), raw.end());
    std::copy(raw.begin(), raw.end(), head.begin() + static_cast<std::ptrdiff_t>(at));
  };
  const auto real = [&](std::size_t one, std::size_t other, std::size_t i, double value) {
    if (two) return put(other + i * 8, value);
    put(one + i * 4, static_cast<float>(value));
  };
  put(0, static_cast<std::int32_t>(head.size()));
  std::memcpy(head.data() + (two ? 4 : 344), two ? "n+2\0\r\n\032\n" : "n+1\0", two ? 8 : 4);
  for (std::size_t i = 0; i < 8; ++i) {
    constexpr int kDim[8] = {3, 2, 3, 4, 1, 1, 1, 1};
    if (two) put(16 + i * 8, static_cast<std::int64_t>(kDim[i]));
    if (!two) put(40 + i * 2, static_cast<std::int16_t>(kDim[i]));
    real(76, 104, i, n.pixdim[i]);
  }
  put(two ? 12 : 70, static_cast<std::int16_t>(n.datatype));
  const double at =
      n.voxels_at != -1 ? n.voxels_at : static_cast<double>(head.size() + 4 + n.extension.size());
  if (two) put(168, static_cast<std::int64_t>(at));
  if (!two) put(108, static_cast<float>(at));
  real(112, 176, 0, n.slope);
  real(112, 176, 1, n.inter);
  for (std::size_t i = 0; i < 3; ++i) {
    real(256, 352, i, n.quatern[i]);
    real(268, 376, i, n.qoffset[i]);
  }
  for (std::size_t i = 0; i < 12; ++i) real(280, 400, i, n.srow[i]);
  if (two) {
    put(344, static_cast<std::int32_t>(n.qform_code));
    put(348, static_cast<std::int32_t>(n.sform_code));
    put(500, static_cast<std::int32_t>(n.units));
  } else {
    put(252, static_cast<std::int16_t>(n.qform_code));
    put(254, static_cast<std::int16_t>(n.sform_code));
    put(123, static_cast<std::int8_t>(n.units));
  }
  const std::string flag = n.extension.empty() ? std::string(4, '\0') : std::string("\1\0\0\0", 4);
  return head + flag + n.extension + n.voxels;
}

// A rotation about an axis (Rodrigues), spacings, a handedness and a position, in every field of
// the header.
struct Placed {
  std::array<Vec, 3> step_mm;  // to the right, the front, the head
  Vec origin_mm;
};

Placed place_at_random(std::mt19937& random, Nifti& n) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const Vec raw = {unit(random), unit(random), unit(random) + 2};
  const Vec axis = raw * (1 / length(raw));
  const double angle = 3 * unit(random);
  const bool mirrored = random() % 2 == 0;
  Placed placed;
  n.pixdim[0] = mirrored ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec e = {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
    const Vec turned = e * std::cos(angle) + cross(axis, e) * std::sin(angle) +
                       axis * (dot(axis, e) * (1 - std::cos(angle)));
    n.pixdim[i + 1] = 1.5 + unit(random);
    placed.step_mm[i] = turned * (n.pixdim[i + 1] * (mirrored && i == 2 ? -1 : 1));
  }
  placed.origin_mm = {100 * unit(random), 100 * unit(random), 100 * unit(random)};
  const double turn = std::sin(angle / 2) * (std::cos(angle / 2) < 0 ? -1 : 1);
  n.quatern = {axis.x * turn, axis.y * turn, axis.z * turn};
  n.qoffset = {placed.origin_mm.x, placed.origin_mm.y, placed.origin_mm.z};
  const auto& s = placed.step_mm;
  n.srow = {s[0].x, s[1].x, s[2].x, placed.origin_mm.x, s[0].y, s[1].y, s[2].y, placed.origin_mm.y,
            s[0].z, s[1].z, s[2].z, placed.origin_mm.z};
  return placed;
}

void expect_place(const LabelMap& map, const Placed& placed, double metres_per_unit) {
  const auto near = [&](Vec seen_m, Vec expected) {
    const Vec lps_m = Vec{-expected.x, -expected.y, expected.z} * metres_per_unit;
    EXPECT_LT(length(seen_m - lps_m), 2e-5 * metres_per_unit * (1 + length(expected)));
  };
  near(map.origin_m, placed.origin_mm);
  for (std::size_t i = 0; i < 3; ++i) near(map.step_m[i], placed.step_mm[i]);
}

TEST(Nifti, LiesWhereEitherFormSaysInAnyVersionByteOrderAndUnit) {
  const Scratch scratch;
  std::mt19937 random(5);
  for (int round = 0; round < 100; ++round) {
    Nifti n;
    n.version = 1 + static_cast<int>(random() % 2);
    n.swapped = random() % 2 == 0;
    const Placed placed = place_at_random(random, n);
    const auto forms = static_cast<unsigned>(1 + random() % 3);
    n.qform_code = (forms & 1U) != 0 ? 1 : 0;
    n.sform_code = (forms & 2U) != 0 ? 2 : 0;
    if (n.qform_code == 0) n.quatern = {kNan, kNan, kNan};
    if (n.sform_code == 0) n.srow.fill(kNan);
    n.units = static_cast<int>(random() % 4);
    constexpr double kMetres[] = {1e-3, 1, 1e-3, 1e-6};
    for (char& label : n.voxels) label = static_cast<char>(random() % 5);
    const std::string bytes = bytes_of(n);
    const bool zipped = random() % 2 == 0;
    const auto path =
        scratch.write(zipped ? "a.nii.gz" : "a.nii", zipped ? deflated(bytes) : bytes);
    const LabelMap map = offline::read_label_map(path);
    EXPECT_EQ(map.size, (std::array<std::uint32_t, 3>{2, 3, 4}));
    EXPECT_EQ(std::string(map.label.begin(), map.label.end()), n.voxels);
    EXPECT_TRUE(map.notes.empty());
    expect_place(map, placed, kMetres[n.units]);
  }
}

TEST(Nifti, FormsThatContradictEachOtherAreNamed) {
  const Scratch scratch;
  std::mt19937 random(6);
  const auto said = [&](const Nifti& n) { return refusal_of(scratch.write("a.nii", bytes_of(n))); };
  for (int round = 0; round < 30; ++round) {
    Nifti good;
    good.version = 1 + static_cast<int>(random() % 2);
    place_at_random(random, good);
    good.qform_code = good.sform_code = 1;
    EXPECT_EQ(said(good), "");
    Nifti n = good;
    const std::size_t axis = random() % 3;
    n.srow[4 * axis + 3] += 5;
    EXPECT_THAT(said(n), HasSubstr("sform (code 1) and qform (code 1) put the same voxel up to 5"));
    n.qform_code = 0;
    EXPECT_EQ(said(n), "");
    n = good;
    n.pixdim[0] = -n.pixdim[0];
    EXPECT_THAT(said(n), HasSubstr("sform (code 1) and qform (code 1)"));
    n = good;
    n.pixdim[axis + 1] *= 1.01;
    EXPECT_THAT(said(n), HasSubstr("pixdim says"));
    n = good;
    for (std::size_t row = 0; row < 3; ++row) n.srow[4 * row] += 0.5 * n.srow[4 * row + 1];
    EXPECT_THAT(said(n), HasSubstr("sform: axes 0 and 1 are"));
  }
}

TEST(Nifti, InvalidNumbersAreNamed) {
  const Scratch scratch;
  std::mt19937 random(7);
  Nifti good;
  place_at_random(random, good);
  good.qform_code = good.sform_code = 1;
  const std::pair<std::function<void(Nifti&)>, const char*> cases[] = {
      {[](Nifti& n) { n.srow[5] = kNan; }, "sform: srow"},
      {[](Nifti& n) { n.srow.fill(0); }, "sform: srow [0 0 0 0]"},
      {[](Nifti& n) { n.srow[3] = HUGE_VAL; }, "inf"},
      {[](Nifti& n) { n.quatern[1] = kNan; }, "qform: quatern"},
      {[](Nifti& n) {
         n.quatern = {1, 1, 0};
       },
       "qform: quatern 1 1 0"},
      {[](Nifti& n) { n.qoffset[2] = kNan; }, "qoffset"},
      {[](Nifti& n) { n.pixdim[2] = kNan; }, "pixdim[2] nan"},
      {[](Nifti& n) { n.pixdim[3] = 0; }, "pixdim[3] 0: expected a length above 0"},
      {[](Nifti& n) { n.units = 5; }, "xyzt_units 5"},
      {[](Nifti& n) { n.datatype = 128; }, "datatype 128"},
      {[](Nifti& n) { n.voxels_at = 40; }, "vox_offset 40: expected from 352"},
      {[](Nifti& n) { n.voxels_at = 1e9; }, "vox_offset 1000000000: expected"},
      {[](Nifti& n) { n.voxels_at = kNan; }, "vox_offset nan"},
      {[](Nifti& n) { n.voxels_at = 353.5; }, "vox_offset 353.5: expected a whole number"},
      {[](Nifti& n) { n.slope = kNan; }, "scl_slope nan"},
      {[](Nifti& n) { n.slope = 0.5; }, "voxel 0: 1 with scl_slope 0.5 and scl_inter 0 is 0.5"},
      {[](Nifti& n) { n.slope = 2e-5; }, "voxel 0: 1 with scl_slope 1.99"},
      {[](Nifti& n) { n.inter = 0.0001; }, "voxel 0: 1 with scl_slope 1 and scl_inter 9.99"},
      {[](Nifti& n) { n.inter = -5; }, "-4: expected labels"},
      {[](Nifti& n) { n.extension = std::string("\0\0\0\x7F\0\0\0\0", 8); }, "extension of"}};
  for (const auto& [change, reason] : cases) {
    Nifti n = good;
    change(n);
    EXPECT_THAT(refusal_of(scratch.write("a.nii", bytes_of(n))), HasSubstr(reason)) << reason;
  }
  Nifti n = good;
  n.datatype = 8;
  n.voxels.clear();
  for (const std::int32_t label : std::vector<std::int32_t>(24, 65536)) {
    n.voxels.append(reinterpret_cast<const char*>(&label), sizeof label);
  }
  EXPECT_THAT(refusal_of(scratch.write("a.nii", bytes_of(n))), HasSubstr("voxel 0: 65536: expec"));
  n.datatype = 16;
  n.voxels.clear();
  for (int i = 0; i < 24; ++i) {
    const float label = i == 7 ? std::nanf("") : 1.0F;
    n.voxels.append(reinterpret_cast<const char*>(&label), sizeof label);
  }
  EXPECT_THAT(refusal_of(scratch.write("a.nii", bytes_of(n))), HasSubstr("voxel 7: nan: expected"));
}

// The same labels in each type of number, in both versions and byte orders.
template <typename T>
void expect_labels_as(std::mt19937& random, int datatype) {
  const Scratch scratch;
  for (int round = 0; round < 4; ++round) {
    Nifti n;
    n.datatype = datatype;
    n.version = 1 + round % 2;
    n.swapped = round / 2 != 0;
    n.voxels.clear();
    std::vector<std::uint16_t> labels;
    for (int i = 0; i < 24; ++i) {
      labels.push_back(static_cast<std::uint16_t>(random() % 100));
      std::array<char, sizeof(T)> raw{};
      const auto value = static_cast<T>(labels.back());
      std::memcpy(raw.data(), &value, sizeof(T));
      if (n.swapped) std::reverse(raw.begin(), raw.end());
      n.voxels.append(raw.data(), sizeof(T));
    }
    EXPECT_EQ(offline::read_label_map(scratch.write("a.nii", bytes_of(n))).label, labels)
        << datatype;
  }
}

TEST(Nifti, LabelsAreReadFromEveryTypeOfNumber) {
  std::mt19937 random(23);
  expect_labels_as<std::uint8_t>(random, 2);
  expect_labels_as<std::int16_t>(random, 4);
  expect_labels_as<std::int32_t>(random, 8);
  expect_labels_as<float>(random, 16);
  expect_labels_as<double>(random, 64);
  expect_labels_as<std::int8_t>(random, 256);
  expect_labels_as<std::uint16_t>(random, 512);
  expect_labels_as<std::uint32_t>(random, 768);
  expect_labels_as<std::int64_t>(random, 1024);
  expect_labels_as<std::uint64_t>(random, 1280);
}

// One word of a good header is replaced.
TEST(Nifti, HeadersOfNoVolumeAreRefused) {
  const Scratch scratch;
  const auto with = [&](int version, std::size_t at, auto value) {
    Nifti n;
    n.version = version;
    std::string bytes = bytes_of(n);
    std::memcpy(bytes.data() + at, &value, sizeof value);
    return refusal_of(scratch.write("a.nii", bytes));
  };
  const auto dim = [&](int version, std::size_t axis, std::int16_t size) {
    return version == 1 ? with(1, 40 + 2 * axis, size)
                        : with(2, 16 + 8 * axis, static_cast<std::int64_t>(size));
  };
  for (const int version : {1, 2}) {
    EXPECT_EQ(dim(version, 0, 3), "");
    EXPECT_EQ(dim(version, 0, 7), "") << "seven dimensions, four of them 1";
    EXPECT_THAT(dim(version, 0, 2), HasSubstr("2 dimensions: expected 3, with one value a voxel"));
    EXPECT_THAT(dim(version, 0, 8), HasSubstr("8 dimensions: expected 3, with one value a voxel"));
    EXPECT_THAT(dim(version, 2, 0), HasSubstr("0 values along axis 1: expected a volume"));
    const std::size_t magic = version == 1 ? 344 : 4;
    EXPECT_THAT(with(version, magic, 'x'), HasSubstr("expected the header of a NIfTI-1 or"));
    Nifti n;
    n.version = version;
    for (const std::size_t size : {100U, 347U, version == 1 ? 351U : 539U}) {
      const auto path = scratch.write("a.nii", bytes_of(n).substr(0, size));
      EXPECT_THAT(refusal_of(path), HasSubstr("expected"));
    }
    std::string four = bytes_of(n);
    const std::size_t first = version == 1 ? 40 : 16, step = version == 1 ? 2 : 8;
    four[first] = 4;
    four[first + 4 * step] = 2;
    EXPECT_THAT(refusal_of(scratch.write("a.nii", four)), HasSubstr("2 values along axis 3"));
    n.pixdim[2] = std::numeric_limits<double>::infinity();
    EXPECT_THAT(refusal_of(scratch.write("a.nii", bytes_of(n))), HasSubstr("pixdim[2] inf"));
    n = Nifti();
    n.version = version;
    n.sform_code = 1;
    n.srow = {kNan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    EXPECT_THAT(refusal_of(scratch.write("a.nii", bytes_of(n))), HasSubstr("sform: srow [nan"));
    n.sform_code = 0;
    n.inter = kNan;
    EXPECT_THAT(refusal_of(scratch.write("a.nii", bytes_of(n))), HasSubstr("scl_inter nan"));
    n.inter = 0;
    n.extension = std::string("\0\0\0\0abcd", 8);
    EXPECT_THAT(refusal_of(scratch.write("a.nii", bytes_of(n))), HasSubstr("extension of 0 bytes"));
    n.extension = "abcd";
    EXPECT_THAT(refusal_of(scratch.write("a.nii", bytes_of(n))), HasSubstr("leaves no room"));
  }
}

TEST(Gzip, MembersFollowEachOther) {
  const Scratch scratch;
  const std::string whole = bytes_of(Nifti{});
  const auto two = deflated(whole.substr(0, 200)) + deflated(whole.substr(200));
  EXPECT_EQ(offline::read_label_map(scratch.write("a.nii.gz", two)).label,
            std::vector<std::uint16_t>(24, 1));
}

// Members are longer and shorter than the block of a megabyte that is unpacked at a time.
TEST(Gzip, AsManyBytesAreUnpackedAsAreAskedFor) {
  std::mt19937 random(17);
  const auto up_to = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n)(random);
  };
  for (int round = 0; round < 10; ++round) {
    std::string text, packed;
    while (text.empty() || up_to(3) != 0) {
      std::string member(up_to(3) == 0 ? up_to(5000) : up_to(3U << 19U), '\0');
      for (std::size_t i = 0; i < member.size(); i += 97) member[i] = static_cast<char>(up_to(255));
      packed += deflated(member);
      text += member;
    }
    const std::size_t most = up_to(2) == 0 ? text.size() + up_to(1) : up_to(text.size());
    EXPECT_TRUE(offline::inflated("a", packed, most) == text.substr(0, most))
        << round << ": " << most << " of " << text.size();
  }
}

// Half a gigabyte of zeros in half a megabyte, behind an image of 24 voxels: no more memory is
// taken than the image needs.
TEST(Gzip, NoMoreIsUnpackedThanTheHeaderAnnounces) {
  const Scratch scratch;
  const auto most_kb = [] {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return used.ru_maxrss;
  };
  std::string tail;
  for (int i = 0; i < 32; ++i) tail += deflated(std::string(std::size_t{1} << 24U, '\0'));
  const long before_kb = most_kb();
  const std::string image = deflated(bytes_of(Nifti{}));
  EXPECT_THAT(refusal_of(scratch.write("a.nii.gz", image + tail)),
              HasSubstr("bytes follow the voxels: expected none"));
  const std::string little = deflated(std::string(1000, '\0'));
  EXPECT_EQ(refusal_of(scratch.write("a.nii.gz", image + little)), "");
  const std::string inrimage = deflated(inr({"2", "3", "4"}, std::string(24, '\1')));
  EXPECT_EQ(refusal_of(scratch.write("a.inr.gz", inrimage + tail)), "");
  EXPECT_LT(most_kb() - before_kb, 64 * 1024);
}

TEST(Nifti, SlopesThatGiveWholeNumbersAreAccepted) {
  const Scratch scratch;
  Nifti n;
  n.qform_code = 1;
  n.slope = 3;
  n.inter = 2;
  EXPECT_EQ(offline::read_label_map(scratch.write("a.nii", bytes_of(n))).label.front(), 5);
  n.slope = 0.1;  // in single precision
  n.inter = 0;
  n.voxels.assign(24, '\x64');
  EXPECT_EQ(offline::read_label_map(scratch.write("a.nii", bytes_of(n))).label.front(), 10);
  n.slope = 0;  // 0: not scaled
  EXPECT_EQ(offline::read_label_map(scratch.write("a.nii", bytes_of(n))).label.front(), 100);
}

TEST(Nifti, WithoutAFrameSaysThatLeftAndRightAreUnknown) {
  const Scratch scratch;
  const LabelMap map = offline::read_label_map(scratch.write("a.nii", bytes_of(Nifti{})));
  EXPECT_THAT(map.notes, testing::ElementsAre(HasSubstr("left and right are not known")));
}

// ---- names --------------------------------------------------------------------------------------

// Names of labels as TotalSegmentator and the Connectome Workbench write them.
std::string label_table(const offline::LabelNames& names) {
  std::string xml = "<?xml version=\"1.0\"?><CaretExtension><VolumeInformation><LabelTable>";
  for (const auto& [label, name] : names) {
    xml +=
        "<Label Key=\"" + std::to_string(label) + "\" Red=\"1\"><![CDATA[" + name + "]]></Label>";
  }
  return xml + "</LabelTable></VolumeInformation></CaretExtension>";
}

std::string extension(const std::string& text, bool swapped) {
  const std::int32_t words[] = {static_cast<std::int32_t>(text.size() + 8), 30};
  std::string out;
  for (const std::int32_t word : words) {
    std::array<char, 4> raw{};
    std::memcpy(raw.data(), &word, sizeof word);
    if (swapped) std::reverse(raw.begin(), raw.end());
    out.append(raw.data(), raw.size());
  }
  return out + text;
}

TEST(Nifti, NamesItsLabels) {
  const Scratch scratch;
  std::mt19937 random(8);
  for (int round = 0; round < 20; ++round) {
    offline::LabelNames names;
    for (int i = 0; i < 4; ++i) {
      names[static_cast<std::uint16_t>(1 + random() % 65535)] =
          "Vène <" + std::to_string(random() % 100) + "> & more";
    }
    Nifti n;
    n.version = 1 + static_cast<int>(random() % 2);
    n.swapped = random() % 2 == 0;
    place_at_random(random, n);
    n.qform_code = 1;
    n.extension = extension(label_table(names) + std::string(random() % 9, '\0'), n.swapped);
    EXPECT_EQ(offline::read_label_map(scratch.write("a.nii", bytes_of(n))).names, names);
    n.extension = extension("<LabelTable><Label Key='1'>liver", n.swapped);
    const LabelMap damaged = offline::read_label_map(scratch.write("a.nii", bytes_of(n)));
    EXPECT_TRUE(damaged.names.empty());
    EXPECT_THAT(damaged.notes, testing::ElementsAre(HasSubstr("names of its labels")));
  }
}

// Keys that are no labels, and elements that are no labels, name nothing; text in other elements is
// no name.
TEST(Nifti, TakesOnlyNamesOfLabels) {
  const Scratch scratch;
  Nifti n;
  n.extension = extension(
      "<LabelTable><Label Key='0'>zero</Label><Label Key='x'>letter</Label><Label "
      "Key='8x'>both</Label><Label "
      "Red='1'>none</Label>"
      "<Label Key='70000'>far</Label><Label Key='-1'>minus</Label><Note>text</Note>"
      "<Label Red='1' Key='7'>  vena <i>cava</i> inferior</Label></LabelTable>",
      false);
  EXPECT_EQ(offline::read_label_map(scratch.write("a.nii", bytes_of(n))).names,
            (offline::LabelNames{{7, "vena"}}));
}

// In one table or in two, with anything between them, each value has one name, or the file is
// refused.
TEST(Nifti, TwoNamesForOneLabelAreRefusedWithBoth) {
  const Scratch scratch;
  std::mt19937 random(12);
  const auto label = [](int key, const std::string& name) {
    return "<Label Key='" + std::to_string(key) + "'>" + name + "</Label>";
  };
  for (int round = 0; round < 20; ++round) {
    const int key = 1 + static_cast<int>(random() % 65535);
    const auto said = [&](const std::string& first, const std::string& second, bool two_tables) {
      const std::string between = two_tables ? "</LabelTable>\n<LabelTable>" : label(key - 1, "c");
      Nifti n;
      n.version = 1 + static_cast<int>(random() % 2);
      if (two_tables && random() % 2 == 0) {
        for (const std::string& name : {first, second}) {
          n.extension += extension("<LabelTable>" + label(key, name) + "</LabelTable>", false);
        }
      } else {
        n.extension = extension("<T><LabelTable>" + label(key, first) + between +
                                    label(key, second) + "</LabelTable></T>",
                                false);
      }
      return refusal_of(scratch.write("a.nii", bytes_of(n)));
    };
    for (const bool two_tables : {false, true}) {
      EXPECT_THAT(said("liver", "spleen", two_tables),
                  HasSubstr(fmt::format("label {} is called liver and spleen: expected one", key)));
      EXPECT_EQ(said("liver", " liver ", two_tables), "");
      EXPECT_EQ(said("liver", "", two_tables), "");
    }
  }
}

// A segmentation of 3D Slicer: segments lie in layers; in different layers they may have the same
// value.
TEST(Nrrd, SegmentsInLayersAreAllRead) {
  const Scratch scratch;
  std::mt19937 random(9);
  for (int round = 0; round < 30; ++round) {
    const std::size_t layers = 1 + random() % 3, voxels = 24;
    std::string stacked;
    for (std::size_t i = 0; i < layers * voxels; ++i) stacked += static_cast<char>(random() % 4);
    struct Listed {
      std::size_t layer;
      char value;
    };
    std::vector<Listed> listed;
    std::string header =
        "NRRD0004\ntype: unsigned char\n" +
        std::string(layers > 1 ? "dimension: 4\nsizes: " : "dimension: 3\nsizes: ") +
        (layers > 1 ? std::to_string(layers) + " " : "") +
        "2 3 4\nspace: left-posterior-superior\nspace directions: " + (layers > 1 ? "none " : "") +
        "(2,0,0) (0,3,0) (0,0,4)\nspace origin: (0,0,0)\n" +
        (layers > 1 ? "kinds: list domain domain domain\n" : "") + "encoding: raw\n";
    for (std::size_t layer = 0; layer < layers; ++layer) {
      for (char value = 1; value < 4; ++value) {
        if (random() % 4 == 0) continue;
        const std::string key = "Segment" + std::to_string(listed.size());
        listed.push_back({layer, value});
        header += key + "_ID:=s\n" + key + "_Name:=Part " + key.substr(7) + "\n" + key +
                  "_LabelValue:=" + std::to_string(value) + "\n" + key +
                  "_Layer:=" + std::to_string(layer) + "\n";
      }
    }
    if (listed.empty()) continue;
    const LabelMap map =
        offline::read_label_map(scratch.write("a.seg.nrrd", header + "\n" + stacked));
    std::size_t shared = 0, nameless = 0;
    for (std::size_t i = 0; i < voxels * layers && layers > 1; ++i) {
      const std::pair<std::size_t, char> here = {i % layers, stacked[i]};
      const bool named = std::any_of(listed.begin(), listed.end(), [&](const auto& each) {
        return std::pair<std::size_t, char>(each.layer, each.value) == here;
      });
      nameless += stacked[i] != 0 && !named ? 1 : 0;
    }
    for (std::size_t i = 0; i < voxels; ++i) {
      std::size_t expected = layers > 1 ? 0 : static_cast<std::size_t>(stacked[i]), claims = 0;
      for (std::size_t s = 0; s < listed.size() && layers > 1; ++s) {
        if (stacked[i * layers + listed[s].layer] != listed[s].value) continue;
        expected = s + 1;
        ++claims;
      }
      shared += claims > 1 ? 1 : 0;
      EXPECT_EQ(map.label[i], expected) << i;
    }
    for (std::size_t s = 0; s < listed.size(); ++s) {
      const auto label = layers > 1 ? static_cast<std::uint16_t>(s + 1)
                                    : static_cast<std::uint16_t>(listed[s].value);
      EXPECT_EQ(map.names.at(label), "Part " + std::to_string(s));
    }
    ASSERT_EQ(map.notes.size(), (shared > 0 ? 1U : 0U) + (nameless > 0 ? 1U : 0U));
    if (shared > 0) {
      EXPECT_THAT(map.notes.front(), HasSubstr(std::to_string(shared) + " voxels lie in"));
    }
    if (nameless > 0) {
      EXPECT_THAT(map.notes.back(), HasSubstr(std::to_string(nameless) + " voxels have a value"));
    }
  }
}

// Sizes that are too small would shift every voxel except those of the first row.
TEST(LabelHeader, MoreVoxelsThanItAnnouncesAreRefused) {
  const Scratch scratch;
  const std::string nrrd =
      "NRRD0004\ntype: ushort\ndimension: 3\nspacings: 1 1 1\nsizes: 3 2 2\n"
      "encoding: raw\nendian: little\n";
  const std::string meta =
      "ObjectType = Image\nNDims = 3\nDimSize = 3 2 2\n"
      "ElementType = MET_USHORT\nElementSpacing = 1 1 1\n";
  const std::string voxels(24, '\0'), more(26, '\0');
  struct Case {
    const char* name;
    std::string header;
  };
  for (const Case& each : {Case{"a.nrrd", nrrd + "\n"}, Case{"a.nhdr", nrrd + "data file: v.raw\n"},
                           Case{"a.mha", meta + "ElementDataFile = LOCAL\n"},
                           Case{"a.mhd", meta + "ElementDataFile = v.raw\n"}}) {
    const bool attached =
        std::string(each.name).ends_with("mha") || std::string(each.name).ends_with("nrrd");
    const auto with = [&](const std::string& bytes) {
      scratch.write("v.raw", bytes);
      return scratch.write(each.name, attached ? each.header + bytes : each.header);
    };
    EXPECT_EQ(offline::read_label_map(with(voxels)).size, (std::array<std::uint32_t, 3>{3, 2, 2}));
    EXPECT_THAT(refusal_of(with(more)), HasSubstr("3 x 2 x 2 voxels of 2 bytes: 26 bytes of voxels "
                                                  "are there, expected 24"))
        << each.name;
  }
  EXPECT_THAT(refusal_of(scratch.write("c.nrrd", nrrd + "byteskip: 0\n\n" + more)),
              HasSubstr("expected 24"));
  const std::string text =
      "NRRD0004\ntype: uchar\ndimension: 3\nspacings: 1 1 1\nsizes: 3 2 2\n"
      "encoding: ascii\n\n";
  EXPECT_EQ(
      offline::read_label_map(scratch.write("d.nrrd", text + "1 1 1 1 1 1 1 1 1 1 1 1\n")).size,
      (std::array<std::uint32_t, 3>{3, 2, 2}));
  Nifti tail;
  tail.voxels = std::string(24 + 5, '\1');
  EXPECT_THAT(offline::read_label_map(scratch.write("a.nii", bytes_of(tail))).notes,
              testing::Contains(HasSubstr("5 bytes behind its voxels: not read")));
  scratch.write("v.raw", more);  // the header says that bytes are in front
  (void)offline::read_label_map(scratch.write("b.nhdr", nrrd + "byteskip: 2\ndata file: v.raw\n"));
  (void)offline::read_label_map(
      scratch.write("b.mhd", meta + "HeaderSize = -1\nElementDataFile = v.raw\n"));
}

// The same if something is skipped first in each file: lines, then bytes.
TEST(LabelHeader, SurplusAfterSkippedBytesIsRefused) {
  const Scratch scratch;
  std::mt19937 engine(29);
  const std::string nrrd =
      "NRRD0004\ntype: uchar\ndimension: 3\nspacings: 1 1 1\nsizes: 3 2 2\nencoding: raw\n";
  for (int round = 0; round < 60; ++round) {
    const auto lines = engine() % 3, bytes = engine() % 20, surplus = engine() % 3;
    std::string before;
    for (unsigned i = 0; i < lines; ++i) before += std::string(engine() % 9, 'x') + "\n";
    before += std::string(bytes, 'y');
    const std::string skip =
        "line skip: " + std::to_string(lines) + "\nbyte skip: " + std::to_string(bytes) + "\n";
    scratch.write("v0.raw", before + std::string(6, '\1'));
    scratch.write("v1.raw", before + std::string(6 + surplus, '\1'));
    const std::string whole = before + std::string(12 + surplus, '\1');
    scratch.write("v.raw", whole);
    std::vector<std::string> files = {
        scratch.write("a.nrrd", nrrd + skip + "\n" + whole),
        scratch.write("b.nhdr", nrrd + skip + "data file: v.raw\n"),
        scratch.write("c.nhdr", nrrd + skip + "data file: v%d.raw 0 1 1\n")};
    if (lines == 0) {
      files.push_back(scratch.write("d.mhd",
                                    "ObjectType = Image\nNDims = 3\nDimSize = 3 2 "
                                    "2\nElementSpacing = 1 1 1\nElementType = MET_UCHAR\n"
                                    "HeaderSize = " +
                                        std::to_string(bytes) + "\nElementDataFile = v.raw\n"));
    }
    for (const std::string& file : files) {
      const std::string told = std::to_string(12 + surplus) + " bytes of voxels are there";
      const std::string refusal = refusal_of(file);
      EXPECT_EQ(refusal.empty(), surplus == 0) << file << ": " << refusal;
      EXPECT_THAT(refusal, HasSubstr(surplus == 0 ? "" : told)) << file;
    }
  }
}

// Output from before and after comes out; output of a library in between does not.
TEST(Silence, HidesOnlyWhatIsPrintedDuringIt) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::cerr << "c";  // first, because it flushes std::cout
  std::cout << "a";
  std::printf("b");
  {
    const offline::Silence silence;
    std::cerr << "f";
    std::fprintf(stderr, "g");
    std::cout << "d";
    std::printf("e");
  }
  std::cout << "h";
  std::printf("i");
  std::cerr << "j";
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "abhi");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "cj");
}

}  // namespace
}  // namespace stylet::test
