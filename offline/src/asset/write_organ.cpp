// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset/write_organ.h"

#include <cstring>
#include <iterator>

#include "base/refusal.h"
#include "organ_generated.h"
#include "stylet/content_sum.h"

namespace stylet::offline {
namespace {

using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

constexpr std::uint32_t kFormatVersion = 2, kWithMembranes = 3, kWithSlides = 4, kWithLevels = 5,
                        kNewest = 6;

// Our plain structs and the generated structs have the same bytes.
template <typename Theirs, typename Mine>
auto write_structs(FlatBufferBuilder& builder, const std::vector<Mine>& values) {
  static_assert(sizeof(Theirs) == sizeof(Mine));
  return builder.CreateVectorOfStructs(reinterpret_cast<const Theirs*>(values.data()),
                                       values.size());
}

// Numbers that every file has. Later ones are left out at 0, which is what a file without them
// means: so a new number changes no organ that does not use it.
constexpr std::size_t kFirstNumbers = 14;

#define STYLET_STORE(field, ...) \
  {&format::MaterialBuilder::add_##field, static_cast<float>(t.field)},
Offset<format::Material> write_material(FlatBufferBuilder& builder, const Tissue& t) {
  struct Number {
    void (format::MaterialBuilder::*add)(float);
    float value;
  };
  const Number numbers[] = {STYLET_MATERIAL_NUMBERS(STYLET_STORE)};
  const auto name = builder.CreateString(t.name);
  const auto source = builder.CreateString(t.source);
  format::MaterialBuilder material(builder);
  for (std::size_t i = std::size(numbers); i-- > 0;) {  // the last first, as generated code does
    const bool stored = i < kFirstNumbers || numbers[i].value != 0;
    if (stored) (material.*numbers[i].add)(numbers[i].value);
  }
  material.add_source(source);
  material.add_name(name);
  return material.Finish();
}
#undef STYLET_STORE

Offset<format::Provenance> write_provenance(FlatBufferBuilder& builder, const OrganParts& parts) {
  std::vector<Offset<format::Source>> sources;
  for (const SourceRecord& s : parts.sources) {
    const auto path = builder.CreateString(s.path);
    const auto tissue = builder.CreateString(s.tissue);
    const auto sha256 = builder.CreateString(s.sha256);
    sources.push_back(format::CreateSource(builder, path, tissue, sha256, s.metres_per_unit,
                                           s.priority, s.triangle_count));
  }
  const auto version = builder.CreateString(parts.tool_version);
  const auto options = builder.CreateString(parts.options);
  const auto list = builder.CreateVector(sources);
  return format::CreateProvenance(builder, version, options, list);
}

Offset<format::Sheets> write_sheets(FlatBufferBuilder& builder, const OrganParts& parts) {
  const auto ties = write_structs<format::Tie>(builder, parts.ties);
  const auto cell_parts = write_structs<format::Part>(builder, parts.cell_parts);
  return format::CreateSheets(builder, static_cast<std::uint16_t>(parts.sheet_rows), ties,
                              cell_parts);
}

Offset<format::Membranes> write_membranes(FlatBufferBuilder& builder, const MembraneLists& m) {
  const auto points = write_structs<format::MembranePoint>(builder, m.points);
  const auto triangles = write_structs<format::Triangle>(builder, m.triangles);
  const auto cells = write_structs<format::MembraneCell>(builder, m.cells);
  return format::CreateMembranes(builder, points, triangles, cells);
}

Offset<format::Slides> write_slides(FlatBufferBuilder& builder, const OrganParts& parts) {
  const auto points = write_structs<format::SlidePoint>(builder, parts.slide_points);
  const auto grounds = write_structs<format::SlideGround>(builder, parts.slide_grounds);
  const auto bodies = parts.levels > 1 ? builder.CreateVector(parts.slide_bodies)
                                       : Offset<flatbuffers::Vector<std::uint8_t>>();
  return format::CreateSlides(builder, points, grounds, bodies);
}

Offset<format::Levels> write_levels(FlatBufferBuilder& builder, const OrganParts& parts) {
  const auto hanging = write_structs<format::Hanging>(builder, parts.hanging);
  return format::CreateLevels(builder, static_cast<std::uint8_t>(parts.levels),
                              static_cast<std::uint16_t>(parts.level_planes), hanging);
}

void write_root(FlatBufferBuilder& builder, const OrganParts& parts) {
  std::vector<Offset<format::Material>> materials;
  for (const Tissue& t : parts.materials) {
    materials.push_back(write_material(builder, t));
  }
  const auto name = builder.CreateString(parts.name);
  const auto runs = write_structs<format::Run>(builder, parts.runs);
  const auto voxel_material = builder.CreateVector(parts.voxel_material);
  const auto voxel_fill = builder.CreateVector(parts.voxel_fill);
  const auto voxel_fixed = parts.voxel_fixed.empty() ? Offset<flatbuffers::Vector<std::uint8_t>>()
                                                     : builder.CreateVector(parts.voxel_fixed);
  const auto material_list = builder.CreateVector(materials);
  const auto vertices = write_structs<format::Vertex>(builder, parts.vertices);
  const auto triangles = write_structs<format::Triangle>(builder, parts.triangles);
  const auto spheres = write_structs<format::SphereNode>(builder, parts.spheres);
  const bool has_mixed = !parts.mixed.empty();
  const auto mixed = has_mixed ? write_structs<format::Mixed>(builder, parts.mixed)
                               : Offset<flatbuffers::Vector<const format::Mixed*>>();
  const auto provenance = write_provenance(builder, parts);
  const bool has_sheets = parts.sheets > 1;
  const auto sheets = has_sheets ? write_sheets(builder, parts) : Offset<format::Sheets>();
  const bool has_membranes = !parts.membranes.cells.empty();
  const auto membranes =
      has_membranes ? write_membranes(builder, parts.membranes) : Offset<format::Membranes>();
  const bool has_slides = !parts.slide_points.empty();
  const auto slides = has_slides ? write_slides(builder, parts) : Offset<format::Slides>();
  const bool has_levels = parts.levels > 1;
  const auto levels = has_levels ? write_levels(builder, parts) : Offset<format::Levels>();
  const bool has_skins = !parts.skins.empty();
  const auto skins = has_skins ? write_structs<format::Skin>(builder, parts.skins)
                               : Offset<flatbuffers::Vector<const format::Skin*>>();
  const std::uint32_t version = has_skins || (has_levels && has_slides) ? kNewest
                                : has_levels                            ? kWithLevels
                                : has_slides                            ? kWithSlides
                                : has_membranes                         ? kWithMembranes
                                                                        : kFormatVersion;
  const auto seal = builder.CreateVector(std::vector<std::uint8_t>(32, 0));  // sealed below
  const auto f = [](double value) { return static_cast<float>(value); };
  const auto u = [](std::uint32_t value) { return static_cast<std::uint16_t>(value); };
  format::FinishOrganBuffer(
      builder,
      format::CreateOrgan(builder, version, name, f(parts.edge_m), f(parts.origin_m.x),
                          f(parts.origin_m.y), f(parts.origin_m.z), u(parts.size_x),
                          u(parts.sheets * parts.sheet_rows), u(parts.size_z), runs, voxel_material,
                          voxel_fill, voxel_fixed, material_list, vertices, triangles, spheres,
                          provenance, mixed, sheets, seal, membranes, slides, levels, skins));
}

}  // namespace

std::vector<std::byte> write_organ(const OrganParts& parts) {
  FlatBufferBuilder builder;
  builder.ForceDefaults(true);  // also stores values that happen to be zero
  write_root(builder, parts);
  const auto* first = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  std::vector<std::byte> bytes(first, first + builder.GetSize());
  Organ organ;
  OrganRefusal refusal;
  if (organ_open(bytes, organ, &refusal) != Status::kOk) {
    refuse("the organ does not pass the kernel's check: {}", describe(refusal));
  }
  const auto sum = content_sha256(bytes, organ);
  const auto place = reinterpret_cast<const std::byte*>(organ.content_sha256.data()) - bytes.data();
  std::memcpy(bytes.data() + place, sum.data(), sum.size());
  return bytes;
}

std::string describe(const OrganRefusal& refusal) {
  return fmt::format("{}: {}[{}] = {}: expected {}", status_name(refusal.status), refusal.place,
                     refusal.index, refusal.value, refusal.expected);
}

}  // namespace stylet::offline
