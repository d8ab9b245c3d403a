// SPDX-License-Identifier: Apache-2.0
// Makes the seeds that are not text: organs, and inputs of whole insertions. Run it after a change
// of a format. usage: fuzz_make_seeds tests/fuzz/seeds
#include <fstream>
#include <memory>

#include "graded.h"
#include "graded_parts.h"

namespace stylet::test {
namespace {

void write(const std::string& path, const void* data, std::size_t size) {
  std::ofstream out(path, std::ios::binary);
  out.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

void write_organ(const std::string& path, const TinyOrgan& tiny) {
  const std::vector<std::byte> bytes = tiny_organ(tiny);
  write(path, bytes.data(), bytes.size());
}

// Everything that only a file of version 2 may have: two sheets with a tie, a cell with a part of
// each, a plane between two tissues, and a checksum.
void write_sheets(const std::string& path) {
  constexpr std::uint16_t kRows = 3;
  TinyOrgan tiny;
  tiny.nx = tiny.nz = 2;
  tiny.ny = 2 * kRows;
  tiny.fixed_faces = kLowZ;
  tiny.inside = [](std::uint16_t x, std::uint16_t y, std::uint16_t z) {
    return y % kRows < 2 && (y < kRows || (x == 1 && z == 1));
  };
  const std::vector<std::byte> whole = tiny_organ(tiny);
  const std::unique_ptr<format::OrganT> organ(format::GetOrgan(whole.data())->UnPack());
  organ->format_version = 2;
  organ->sheets = std::make_unique<format::SheetsT>();
  organ->sheets->rows = kRows;
  organ->sheets->ties.emplace_back(1, kRows, 1, 0);
  organ->sheets->parts.emplace_back(1, 0, 1, 0, 0x3333333333333333);
  organ->sheets->parts.emplace_back(1, kRows, 1, 0, 0xCCCCCCCCCCCCCCCC);
  organ->mixed.emplace_back(0, kNoTissue, 0, 1.0F, 0.0F, 0.0F, 0.4F);
  organ->content_sha256.assign(32, 7);
  flatbuffers::FlatBufferBuilder builder;
  format::FinishOrganBuffer(builder, format::Organ::Pack(builder, organ.get()));
  write(path, builder.GetBufferPointer(), builder.GetSize());
}

// What only new files may have: two levels, in two sheets; a membrane across both; and skins.
void write_levels(const std::string& path) {
  Graded graded;
  graded.nx = 2;
  graded.ny = graded.nz = 1;
  graded.cut = 1;
  graded.split = [](std::uint32_t, int x, int, int) { return x == 0; };
  const std::unique_ptr<Owner> organ = graded_organ(graded);
  organ->membranes = std::make_unique<format::MembranesT>();
  organ->membranes->points = {{0, 0, 0.001F}, {0.01F, 0, 0.001F}, {0, 0.005F, 0.002F}};
  organ->membranes->triangles = {{0, 1, 2}, {0, 1, 2}};
  for (std::uint16_t x = 0; x < 2; ++x) {
    organ->membranes->cells.emplace_back(x, 0, 0, 0, x, 1, 0.5F);
  }
  organ->membranes->cells.emplace_back(0, 0, 2, 0, 0, 0, 0.9F);
  organ->format_version = 6;
  organ->materials[0]->membrane_n_per_m = 50;
  organ->skins = {format::Skin(0, 0.5F), format::Skin(1, 0)};
  const std::vector<std::byte> bytes = bytes_of(*organ);
  write(path, bytes.data(), bytes.size());
}

// What only a file of version 6 may have: parts that slide, in voxels of two sizes.
void write_sliding_levels(const std::string& path) {
  GradedParts graded;
  graded.parts.floor_x = graded.parts.lid_x = 2;
  graded.parts.floor_y = graded.parts.lid_y = 1;
  graded.parts.height = 2;
  graded.parts.plane = 1;
  graded.split = [](std::uint32_t, int x, int, int) { return x == 0; };
  const std::vector<std::byte> bytes = bytes_of(*graded_parts(graded));
  write(path, bytes.data(), bytes.size());
}

// Runs as organ_target.cpp draws them: rows with voxels far apart, a comb, planes far apart.
void write_sparse(const std::string& folder) {
  const auto write_runs = [&](const char* name, std::initializer_list<int> numbers) {
    std::string bytes = "sparse";
    for (const int number : numbers) bytes.push_back(static_cast<char>(number));
    write(folder + name, bytes.data(), bytes.size());
  };
  write_runs("far-rows.sparse", {0, 0x34, 0, 0, 0x14, 0xF0, 0, 0x05, 0x10, 0, 3, 0x24, 1, 0});
  write_runs("comb.sparse", {128, 8, 6, 8, 6, 8, 7, 8, 8, 8, 9, 1, 0, 3, 8, 6, 8, 7, 0x11, 0, 0});
  write_runs("planes.sparse",
             {255, 0x30, 0, 0x32, 0, 0, 0, 0x36, 2, 0, 0, 0, 0x32, 0, 9, 40, 8, 20});
}

void write_organs(const std::string& folder) {
  TinyOrgan one;
  one.nx = one.ny = one.nz = 1;
  write_organ(folder + "one-voxel.organ", one);
  TinyOrgan held;
  held.nx = 3;
  held.ny = held.nz = 2;
  held.fixed_faces = kLowZ | kHighX;
  TinyMaterial hard;
  hard.name = "capsule";
  hard.youngs_modulus_pa = 2e5F;
  hard.relaxing_fraction = 0.5F;
  hard.puncture_velocity_exponent = 0.2F;
  held.materials = {TinyMaterial{}, hard};
  held.material_at = [](std::uint16_t x, std::uint16_t, std::uint16_t z) {
    return static_cast<std::uint8_t>((x + z) % 2);
  };
  write_organ(folder + "two-materials.organ", held);
  TinyOrgan tall;
  tall.nx = tall.ny = 1;
  tall.nz = 6;
  tall.fixed_faces = kLowZ;
  tall.voxel_edge_m = 2e-3F;
  tall.origin_m = {0.1F, -0.2F, 0.05F};
  write_organ(folder + "tall.organ", tall);
  write_sheets(folder + "sheets.organ");
  write_levels(folder + "levels.organ");
  write_sliding_levels(folder + "sliding-levels.organ");
  write_sparse(folder);
}

// Operations as tick_target.cpp reads them: needle, kind, repeats, and their numbers.
struct Script {
  std::vector<std::uint8_t> bytes;

  void op(unsigned needle, unsigned kind, unsigned repeats, std::initializer_list<int> numbers) {
    bytes.push_back(static_cast<std::uint8_t>(needle | kind << 2U | (repeats - 1) << 5U));
    for (const int number : numbers) bytes.push_back(static_cast<std::uint8_t>(number));
  }
  void push(unsigned needle, int sixteenths_of_100_um, int times) {
    for (int i = 0; i < times; ++i) op(needle, 0, 8, {sixteenths_of_100_um});
  }
};

// The needle goes in, sideways, turns, and comes out, with missing and wrong samples.
Script insertion(std::uint8_t kind, std::uint8_t tip, std::uint8_t obstacles) {
  Script script;
  script.bytes = {kind, tip, obstacles};
  for (unsigned i = 0; i < obstacles % 4U; ++i) {
    script.bytes.insert(script.bytes.end(), {static_cast<std::uint8_t>(0x20 + i), 10, 0,
                                             static_cast<std::uint8_t>(-60)});
  }
  const unsigned needles = 1U + ((kind >> 3U) & 3U);
  for (unsigned i = 0; i < needles; ++i) {
    script.push(i, 127, 2);
    script.op(i, 1, 8, {20, -10});
    script.op(i, 2, 4, {5, -5, 20});
    script.op(i, 4, 1, {1, 0, 0, 0xC0, 0x7F});
    script.op(i, 5, 5, {});
    script.op(i, 7, 1, {});
    script.push(i, -127, 3);
  }
  script.op(0, 6, 1, {});
  script.op(0, 7, 2, {});
  return script;
}

void write_inputs(const std::string& folder) {
  const struct {
    const char* name;
    std::uint8_t kind, tip, obstacles;
  } all[] = {{"rigid", 0x02, 0x00, 0},        {"paper", 0x03, 0x00, 0},
             {"elastic-bone", 0x02, 0x01, 2}, {"bevel-breathing", 0x22, 0x0B, 0},
             {"bent-fine", 0x42, 0x15, 1},    {"four-needles", 0x1A, 0x09, 1}};
  for (const auto& each : all) {
    const Script script = insertion(each.kind, each.tip, each.obstacles);
    write(folder + each.name + ".bin", script.bytes.data(), script.bytes.size());
  }
}

// Changes as snapshot_target.cpp reads them: kernel, moment, how many; field, element, word, how.
void write_snapshots(const std::string& folder) {
  const std::uint8_t as_it_was[] = {0, 2, 0, 100, 3, 0, 0};
  const std::uint8_t shaft_count[] = {0, 2, 1, 14, 0, 0, 13, 0, 0, 0xA0, 0x86, 0x01, 0};
  const std::uint8_t neighbour_slot[] = {1, 2, 1, 15, 1, 0, 40, 0, 0x0D, 100, 3, 0, 0};
  const std::uint8_t far_goal[] = {0, 2, 1, 15, 0, 0, 44, 0, 0x06, 100, 3, 0, 0};
  const std::uint8_t fast_tissue[] = {2, 3, 2, 4, 90, 0, 0, 0, 0x02, 5, 80, 0, 0, 0, 0x06, 9};
  write(folder + "as-it-was.bin", as_it_was, sizeof as_it_was);
  write(folder + "shaft-count.bin", shaft_count, sizeof shaft_count);
  write(folder + "neighbour-slot.bin", neighbour_slot, sizeof neighbour_slot);
  write(folder + "far-goal.bin", far_goal, sizeof far_goal);
  write(folder + "fast-tissue.bin", fast_tissue, sizeof fast_tissue);
}

// Changes as recording_target.cpp reads them.
void write_changes(const std::string& folder) {
  const std::uint8_t none[] = {2, 0}, missing[] = {0, 3}, attribute[] = {1, 5, 0, 1, 9, 9, 9, 9},
                     column[] = {3, 20, 2, 1, 3, 0, 0}, deleted[] = {2, 12};
  write(folder + "unchanged.bin", none, sizeof none);
  write(folder + "missing-attribute.bin", missing, sizeof missing);
  write(folder + "other-attribute.bin", attribute, sizeof attribute);
  write(folder + "other-column.bin", column, sizeof column);
  write(folder + "missing-column.bin", deleted, sizeof deleted);
}

// Steps as packet_target.cpp reads them, after the byte that says who listens: a good packet with
// its changes, and a tick with its force; a wait; raw bytes.
void write_packets(const std::string& folder) {
  const std::vector<std::uint8_t> steady = {4, 0, 10, 20, 0, 0, 0x80, 0x3F};
  const std::vector<std::uint8_t> gap = {1, 30}, none = {0, 9, 'S', 'T', 'Y', 'S', 3, 0, 108, 0, 1},
                                  nan = {2, 2, 47, 0x7F, 46, 0xC0}, later = {2, 1, 30, 1},
                                  clock = {3, 2, 27, 0x40, 26, 0};
  const char* const names[] = {"memory", "udp", "station"};
  for (std::uint8_t who = 0; who < 3; ++who) {
    std::vector<std::uint8_t> bytes = {who};
    for (const auto& strange : {steady, gap, none, nan, later, clock}) {
      for (int i = 0; i < 6; ++i) bytes.insert(bytes.end(), steady.begin(), steady.end());
      bytes.insert(bytes.end(), strange.begin(), strange.end());
    }
    write(folder + names[who] + ".bin", bytes.data(), bytes.size());
  }
}

}  // namespace
}  // namespace stylet::test

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = argv[1];
  stylet::test::write_organs(folder + "/organ/");
  stylet::test::write_inputs(folder + "/tick/");
  stylet::test::write_snapshots(folder + "/snapshot/");
  stylet::test::write_changes(folder + "/recording/");
  stylet::test::write_packets(folder + "/packet/");
  return 0;
}
