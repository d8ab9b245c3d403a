// SPDX-License-Identifier: Apache-2.0
// Voxels of NRRD and MetaImage that are packed, text or hexadecimal: random labels are read
// unchanged. Voxels that are too many, too few, cut off, damaged, or of another type than the
// header says are refused.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <zlib.h>

#include <functional>

#include "base/refusal.h"
#include "label_support.h"
#include "maps/label_map.h"
#include "offline_support.h"
#include "random_bodies.h"

namespace stylet::test {
namespace {

using testing::HasSubstr;

struct Written {
  const char* name;  // of the file
  std::string encoding;
  std::function<std::string(const std::string& bytes)> voxels;
};

std::string text_of(const std::string& bytes) {
  std::string out;
  for (const char each : bytes) out += fmt::format("{}\n", static_cast<unsigned char>(each));
  return out;
}
std::string hex_of(const std::string& bytes) {
  std::string out;
  for (const char each : bytes) out += fmt::format("{:02X}", static_cast<unsigned char>(each));
  return out;
}
const Written kWritten[] = {
    {"a.nrrd", "gzip", [](const auto& bytes) { return deflated(bytes, 16 + MAX_WBITS); }},
    {"a.nrrd", "ascii", text_of},
    {"a.nrrd", "hex", hex_of},
    {"a.mha", "CompressedData = True",
     [](const auto& bytes) { return deflated(bytes, MAX_WBITS); }},
    {"a.mha", "BinaryData = False", text_of}};

std::string file_of(const Written& how, std::size_t count, const std::string& voxels,
                    const std::string& type = "") {
  if (std::string(how.name) == "a.nrrd") {
    return fmt::format(
        "NRRD0004\ntype: {}\ndimension: 3\nspacings: 1 1 1\nsizes: {} 1 1\n"
        "encoding: {}\nendian: little\n\n{}",
        type.empty() ? "uchar" : type, count, how.encoding, voxels);
  }
  return fmt::format(
      "ObjectType = Image\nNDims = 3\nElementSpacing = 1 1 1\nDimSize = {} 1 1\n{}\n"
      "CompressedDataSize = {}\nElementType = {}\nElementDataFile = LOCAL\n{}",
      count, how.encoding, voxels.size(), type.empty() ? "MET_UCHAR" : type, voxels);
}

TEST(WholeVoxels, AreReadAndOthersRefused) {
  const Scratch scratch;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Draw draw(seed);
    std::string bytes;
    for (std::size_t i = 5 + draw.below(300); i > 0; --i) {
      bytes += static_cast<char>(draw.below(256));
    }
    for (const Written& how : kWritten) {
      const auto written = [&](const std::string& voxels) {
        return scratch.write(how.name, file_of(how, bytes.size(), voxels));
      };
      const offline::LabelMap map = offline::read_label_map(written(how.voxels(bytes)));
      ASSERT_EQ(map.label.size(), bytes.size());
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        ASSERT_EQ(map.label[i], static_cast<unsigned char>(bytes[i])) << how.encoding;
      }
      const std::string more = bytes + std::string(1 + draw.below(40), '\1');
      EXPECT_THAT(refusal_of(written(how.voxels(more))), HasSubstr(" or more are there"));
      const std::string less = bytes.substr(0, bytes.size() - 1 - draw.below(4));
      EXPECT_THAT(refusal_of(written(how.voxels(less))), HasSubstr("expected"));
      if (how.voxels("\1").size() < 4) continue;
      const std::string packed = how.voxels(bytes);
      for (std::size_t cut = 1; cut < packed.size(); cut += 1 + draw.below(20)) {
        EXPECT_THAT(refusal_of(written(packed.substr(0, packed.size() - cut))),
                    HasSubstr("expected"));
      }
      EXPECT_THAT(refusal_of(written(packed + "tail")), HasSubstr("expected whole packed voxels"));
      std::string damaged = packed;
      damaged[damaged.size() - (how.encoding == "gzip" ? 5 : 1)] ^= 1;  // its checksum
      EXPECT_THAT(refusal_of(written(damaged)), HasSubstr("expected whole packed voxels"));
    }
  }
}

// A library would read 256 in a byte as 0, 1.5 as 1, and 2e1 as 2.
TEST(WholeVoxels, OfTextAreNumbersOfTheirType) {
  const Scratch scratch;
  struct Case {
    const char *nrrd, *meta, *number;
    bool taken;
  };
  const Case cases[] = {
      {"uchar", "MET_UCHAR", "255", true},      {"uchar", "MET_UCHAR", "256", false},
      {"signed char", "MET_CHAR", "127", true}, {"signed char", "MET_CHAR", "128", false},
      {"short", "MET_SHORT", "32767", true},    {"short", "MET_SHORT", "32768", false},
      {"ushort", "MET_USHORT", "65535", true},  {"ushort", "MET_USHORT", "65536", false},
      {"int", "MET_INT", "70000", false},  // beyond all labels
      {"uchar", "MET_UCHAR", "-1", false},      {"uchar", "MET_UCHAR", "1.5", false},
      {"uchar", "MET_UCHAR", "2e1", false},     {"uchar", "MET_UCHAR", "0x1", false},
      {"uchar", "MET_UCHAR", "x", false},       {"float", "MET_FLOAT", "2e1", true},
      {"float", "MET_FLOAT", "1.5", false},     {"float", "MET_FLOAT", "nan", false},
      {"double", "MET_DOUBLE", "7.0", true}};
  for (const Case& each : cases) {
    for (const Written& how : {kWritten[1], kWritten[4]}) {
      const bool is_nrrd = std::string(how.name) == "a.nrrd";
      const std::string voxels = fmt::format("1 {}\t3", each.number);
      const auto path =
          scratch.write(how.name, file_of(how, 3, voxels, is_nrrd ? each.nrrd : each.meta));
      const std::string said = refusal_of(path);
      EXPECT_EQ(said.empty(), each.taken) << each.nrrd << " " << each.number << " " << said;
      if (!each.taken) {
        EXPECT_THAT(said, HasSubstr("voxel 1: "));
      }
    }
  }
}

// Text that is no number may be long: its first 40 characters are quoted.
TEST(WholeVoxels, AreQuotedByTheirFirstCharacters) {
  const Scratch scratch;
  const std::string begin = "0123456789abcdefghijklmnopqrstuvwxyzABCD";
  EXPECT_THAT(refusal_of(scratch.write("a.nrrd", file_of(kWritten[1], 3, "1 " + begin + "EF 3"))),
              HasSubstr("voxel 1: " + begin + ": expected a number from 0 to 255"));
}

// NRRD allows commas between numbers, MetaImage does not; hexadecimal digits may have blanks
// between them.
TEST(WholeVoxels, MayBeSeparatedAsTheFormatAllows) {
  const Scratch scratch;
  const auto nrrd = [&](const Written& how, const char* voxels) {
    return refusal_of(scratch.write("a.nrrd", file_of(how, 3, voxels)));
  };
  EXPECT_EQ(nrrd(kWritten[1], "1, 2,\r\n3\n"), "");
  EXPECT_EQ(nrrd(kWritten[2], "0 10\n2 0A\n"), "");
  EXPECT_THAT(nrrd(kWritten[2], "01020g"), HasSubstr("digit 5 of the voxels: expected"));
  EXPECT_THAT(refusal_of(scratch.write("a.mha", file_of(kWritten[4], 3, "1,2,3"))),
              HasSubstr("voxel 0: 1,2,3: expected"));
  EXPECT_THAT(refusal_of(scratch.write("a.nrrd",
                                       "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 1 1\n"
                                       "spacings: 1 1 1\nencoding: ascii\nline skip: 1\n"
                                       "\nnote\n1 2 3\n")),
              HasSubstr("expected nothing to skip"));
}

// ITK's reader handles bytes to skip in packed voxels; we check that such voxels are complete.
TEST(WholeVoxels, MayHaveOtherBytesBeforeThem) {
  const Scratch scratch;
  const auto file = [&](const std::string& bytes) {
    return scratch.write("a.nrrd",
                         "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 3 1 1\nspacings: 1 1 1\n"
                         "encoding: gzip\nline skip: 1\nbyte skip: 2\n\nnote\n" +
                             deflated(bytes, 16 + MAX_WBITS));
  };
  EXPECT_EQ(offline::read_label_map(file("ab\1\2\3")).label, (std::vector<std::uint16_t>{1, 2, 3}));
  EXPECT_THAT(refusal_of(file("ab\1\2")), HasSubstr("expected 3 bytes but received 2"));
}

// A gzip file that is cut anywhere, or has a wrong checksum.
TEST(WholeVoxels, OfPackedFilesAreWholeToo) {
  const Scratch scratch;
  std::string header =
      "#INRIMAGE-4#{\nXDIM=3\nYDIM=1\nZDIM=1\nVDIM=1\nTYPE=unsigned fixed\n"
      "PIXSIZE=8 bits\nCPU=decm\nVX=1\nVY=1\nVZ=1\n";
  header.resize(252, '\n');
  const std::string whole = deflated(header + "##}\n\1\2\3");
  EXPECT_EQ(refusal_of(scratch.write("a.inr.gz", whole)), "");
  for (std::size_t size = 2; size < whole.size(); ++size) {
    EXPECT_THAT(refusal_of(scratch.write("a.inr.gz", whole.substr(0, size))),
                HasSubstr("expected a whole gzip file"))
        << size;
  }
  std::string damaged = whole;
  damaged[damaged.size() - 5] ^= 1;
  EXPECT_THAT(refusal_of(scratch.write("a.inr.gz", damaged)), HasSubstr("a whole gzip file"));
}

// In several files, one after the other.
TEST(WholeVoxels, OfSeveralFilesAreCountedTogether) {
  const Scratch scratch;
  const auto said = [&](const std::string& first, const std::string& second) {
    scratch.write("1.gz", deflated(first, 16 + MAX_WBITS));
    scratch.write("2.gz", deflated(second, 16 + MAX_WBITS));
    return refusal_of(
        scratch.write("a.nhdr",
                      "NRRD0004\ntype: uchar\ndimension: 3\nspacings: 1 1 1\nsizes: 2 2 2\n"
                      "encoding: gzip\ndata file: LIST\n1.gz\n2.gz\n"));
  };
  EXPECT_EQ(said("abca", "abca"), "");
  EXPECT_THAT(said("abca", "abcab"), HasSubstr("8 bytes of voxels: 9 or more are there"));
  EXPECT_THAT(said("abca", "abc"), HasSubstr("8 bytes of voxels: 7 are there"));
}

}  // namespace
}  // namespace stylet::test
