// SPDX-License-Identifier: Apache-2.0
// Organs of stylet.h: bytes copied, checked and kept as long as somebody uses them.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>

#include "hal/hosts/c/handles.h"
#include "hal/hosts/c/plain.h"
#include "hal/hosts/c/refusal.h"
#include "hal/hosts/c/sized.h"
#include "stylet/content_sum.h"
#include "stylet/levels.h"

namespace stylet::c {

stylet_organ::Block make_block(std::size_t bytes) {
  // The library of C++ rounds the size up to the alignment, and so up to nothing if it is SIZE_MAX.
  if (bytes > static_cast<std::size_t>(PTRDIFF_MAX)) return nullptr;
  return stylet_organ::Block(static_cast<std::byte*>(
      ::operator new (bytes, std::align_val_t{kBlockAlignment}, std::nothrow)));
}

Vec3 unit(stylet_vec3 d) {
  // In double no square of a float overflows or vanishes.
  const double x = static_cast<double>(d.x), y = static_cast<double>(d.y),
               z = static_cast<double>(d.z);
  const double length = std::sqrt(x * x + y * y + z * z);
  if (!(length > 0) || !std::isfinite(length)) return {0, 0, -1};
  return {static_cast<float>(x / length), static_cast<float>(y / length),
          static_cast<float>(z / length)};
}

stylet_organ* keep(const stylet_organ* organ) {
  auto* const kept = const_cast<stylet_organ*>(organ);
  kept->users.fetch_add(1, std::memory_order_relaxed);
  return kept;
}

namespace {

struct File {
  std::FILE* stream;
  explicit File(const char* path) : stream(std::fopen(path, "rb")) {}
  ~File() {
    if (stream != nullptr) std::fclose(stream);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
};

// Of a file, not of what cannot be measured; -1: it cannot be read.
long long bytes_of(std::FILE* stream) {
  if (std::fseek(stream, 0, SEEK_END) != 0) return -1;
  const long long bytes = std::ftell(stream);
  return std::fseek(stream, 0, SEEK_SET) == 0 ? bytes : -1;
}

stylet_status open(stylet_organ::Block bytes, std::size_t count, stylet_organ** organ_out,
                   stylet_refusal* refusal_out) {
  const std::span<const std::byte> all(bytes.get(), count);
  Organ organ;
  OrganRefusal why;
  if (organ_open(all, organ, &why) != Status::kOk) return refuse_organ(refusal_out, why);
  if (!has_its_bytes(all, organ)) return refuse(refusal_out, STYLET_CONTENT_DAMAGED);
  auto* const made = new (std::nothrow) stylet_organ;
  if (made == nullptr) return refuse(refusal_out, STYLET_OUT_OF_MEMORY);
  made->bytes = std::move(bytes);
  made->organ = organ;
  *organ_out = made;
  return refuse(refusal_out, STYLET_OK);
}

// Walks all voxels in the order of their numbers.
template <typename Visit>
void each_voxel(const Organ& organ, const Visit& visit) {
  std::uint32_t number = 0;
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i) visit(number++, run.x + i, run.y, run.z);
  }
}

struct Place {
  std::uint32_t x, y, z;
};

// The lattice's place of every voxel; null: out of memory.
std::unique_ptr<Place[]> places(const Organ& organ) {
  std::unique_ptr<Place[]> out(new (std::nothrow) Place[organ.voxel_count]);
  if (out == nullptr) return out;
  each_voxel(organ, [&](std::uint32_t number, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    out[number] = {x, y % organ.sheet_rows, z};
  });
  return out;
}

template <typename Visit>
bool each_vertex(const Organ& organ, std::uint32_t count, const Visit& visit) {
  const std::unique_ptr<Place[]> place = places(organ);
  if (place == nullptr) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    const OrganVertex& v = organ.vertices[i];
    const Place& at = place[v.voxel];
    visit(i, organ_vertex_place(organ, at.x, at.y, at.z, v));
  }
  return true;
}

}  // namespace
}  // namespace stylet::c

using namespace stylet;

stylet_status stylet_organ_from_bytes(const void* bytes, size_t count, stylet_organ** organ_out,
                                      stylet_refusal* refusal_out) {
  if (organ_out != nullptr) *organ_out = nullptr;
  if (organ_out == nullptr) return c::refuse_missing(refusal_out, "organ_out");
  if (bytes == nullptr) return c::refuse_missing(refusal_out, "bytes");
  stylet_organ::Block copy = c::make_block(count);
  if (copy == nullptr) return c::refuse(refusal_out, STYLET_OUT_OF_MEMORY);
  std::memcpy(copy.get(), bytes, count);
  return c::open(std::move(copy), count, organ_out, refusal_out);
}

stylet_status stylet_organ_read(const char* path, stylet_organ** organ_out,
                                stylet_refusal* refusal_out) {
  if (organ_out != nullptr) *organ_out = nullptr;
  if (organ_out == nullptr) return c::refuse_missing(refusal_out, "organ_out");
  if (path == nullptr) return c::refuse_missing(refusal_out, "path");
  const auto unreadable = [&](const char* why) {
    return c::refuse_file(refusal_out, STYLET_FILE_UNREADABLE, path, why);
  };
  const c::File file(path);
  if (file.stream == nullptr) return unreadable(std::strerror(errno));
  const long long bytes = c::bytes_of(file.stream);
  if (bytes < 0 || bytes == LLONG_MAX) return unreadable("this is no file that can be read");
  const auto count = static_cast<std::size_t>(bytes);
  stylet_organ::Block all = c::make_block(std::max<std::size_t>(count, 1));
  if (all == nullptr) return c::refuse(refusal_out, STYLET_OUT_OF_MEMORY);
  if (std::fread(all.get(), 1, count, file.stream) != count) return unreadable("cannot be read");
  return c::open(std::move(all), count, organ_out, refusal_out);
}

void stylet_organ_free(stylet_organ* organ) {
  if (organ == nullptr) return;
  if (organ->users.fetch_sub(1, std::memory_order_acq_rel) == 1) delete organ;
}

stylet_status stylet_organ_get_info(const stylet_organ* organ, stylet_organ_info* info_out) {
  if (organ == nullptr || info_out == nullptr) return c::missing(info_out);
  const Organ& o = organ->organ;
  constexpr float kFar = std::numeric_limits<float>::infinity();
  Vec3 low = {kFar, kFar, kFar}, high = {-kFar, -kFar, -kFar};
  const auto all = static_cast<std::uint32_t>(o.vertices.size());
  if (!c::each_vertex(o, all, [&](std::uint32_t, Vec3 at) {
        low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
      })) {
    return c::nothing(STYLET_OUT_OF_MEMORY, info_out);
  }
  if (all == 0) low = high = o.origin_m;
  stylet_organ_info info = {};
  info.format_version = o.format_version;
  info.hash = o.hash;
  info.name = o.name;
  info.voxel_edge_m = o.voxel_edge_m;
  info.origin_m = c::plain(o.origin_m);
  info.size_x = o.size_x;
  info.size_y = o.sheet_rows;
  info.size_z = o.size_z;
  info.voxels = o.voxel_count;
  info.vertices = all;
  info.triangles = static_cast<std::uint32_t>(o.triangles.size());
  info.materials = o.material_count;
  info.low_m = c::plain(low);
  info.high_m = c::plain(high);
  return c::answer(info, info_out);
}

stylet_status stylet_organ_get_material(const stylet_organ* organ, uint32_t index,
                                        stylet_material* material_out) {
  if (organ == nullptr || material_out == nullptr) return c::missing(material_out);
  if (index >= organ->organ.material_count) {
    return c::nothing(STYLET_ARGUMENT_OUT_OF_RANGE, material_out);
  }
  const Material m = organ_material(organ->organ, index);
  const stylet_material out = {0,
                               m.density_kg_per_m3,
                               m.name,
                               m.source,
                               m.youngs_modulus_pa,
                               m.poisson_ratio,
                               m.relaxing_fraction,
                               m.relaxation_time_s,
                               m.puncture_force_n,
                               m.cutting_force_n,
                               m.recut_fraction,
                               m.coulomb_friction_n_per_m,
                               m.static_friction_n_per_m,
                               m.stribeck_velocity_m_per_s,
                               m.viscous_friction_n_s_per_m2,
                               m.puncture_velocity_exponent,
                               m.membrane_n_per_m,
                               m.strain_stiffening,
                               m.fracture_toughness_j_per_m2,
                               m.toughness_velocity_exponent,
                               m.needle_friction_coefficient,
                               m.fluid_pressure_pa,
                               m.fluid_conductance_m3_per_pa_s,
                               m.fluid_viscosity_pa_s};
  return c::answer(out, material_out);
}

uint32_t stylet_organ_voxels(const stylet_organ* organ, stylet_voxel* out, uint32_t capacity) {
  if (organ == nullptr) return 0;
  const Organ& o = organ->organ;
  if (out == nullptr) return o.voxel_count;
  c::each_voxel(o, [&](std::uint32_t i, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    if (i >= capacity) return;
    const std::uint8_t fixed = o.voxel_fixed.empty() ? std::uint8_t{0} : o.voxel_fixed[i];
    out[i] = {static_cast<std::uint16_t>(x),
              static_cast<std::uint16_t>(y % o.sheet_rows),
              static_cast<std::uint16_t>(z),
              o.voxel_material[i],
              fixed,
              static_cast<float>(o.voxel_fill[i]) / 255.0F};
  });
  return o.voxel_count;
}

uint32_t stylet_organ_cubes(const stylet_organ* organ, stylet_cube* out, uint32_t capacity) {
  if (organ == nullptr) return 0;
  const Organ& o = organ->organ;
  if (out == nullptr) return o.voxel_count;
  c::each_voxel(o, [&](std::uint32_t i, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    if (i >= capacity) return;
    const Vec3 low = organ_vertex_place(o, x, y % o.sheet_rows, z, {i, 0, 0, 0, 0});
    const float edge_m = o.voxel_edge_m * edge_ratio(level_of(o.level_planes, z));
    out[i] = {{low.x, low.y, low.z}, edge_m};
  });
  return o.voxel_count;
}

uint32_t stylet_organ_triangles(const stylet_organ* organ, uint32_t* out, uint32_t capacity) {
  if (organ == nullptr) return 0;
  const auto all = static_cast<std::uint32_t>(organ->organ.triangles.size());
  for (std::uint32_t i = 0; out != nullptr && i < std::min(all, capacity); ++i) {
    const OrganTriangle& t = organ->organ.triangles[i];
    out[3 * std::size_t{i}] = t.a;
    out[3 * std::size_t{i} + 1] = t.b;
    out[3 * std::size_t{i} + 2] = t.c;
  }
  return all;
}

uint32_t stylet_organ_vertices(const stylet_organ* organ, stylet_vec3* out, uint32_t capacity) {
  if (organ == nullptr) return 0;
  const auto all = static_cast<std::uint32_t>(organ->organ.vertices.size());
  if (out == nullptr) return all;
  const bool walked = c::each_vertex(organ->organ, std::min(all, capacity),
                                     [&](std::uint32_t i, Vec3 at) { out[i] = c::plain(at); });
  return walked ? all : 0;
}

uint32_t stylet_organ_vertex_materials(const stylet_organ* organ, uint8_t* out, uint32_t capacity) {
  if (organ == nullptr) return 0;
  const Organ& o = organ->organ;
  const auto all = static_cast<std::uint32_t>(o.vertices.size());
  for (std::uint32_t i = 0; out != nullptr && i < std::min(all, capacity); ++i) {
    out[i] = o.voxel_material[o.vertices[i].voxel];
  }
  return all;
}

int stylet_organ_raycast(const stylet_organ* organ, stylet_vec3 origin_m, stylet_vec3 direction,
                         float* distance_out_m) {
  float distance = 0;
  const bool points = std::isfinite(direction.x) && std::isfinite(direction.y) &&
                      std::isfinite(direction.z) &&
                      (direction.x != 0 || direction.y != 0 || direction.z != 0);
  const bool hit = organ != nullptr && points && std::isfinite(origin_m.x) &&
                   std::isfinite(origin_m.y) && std::isfinite(origin_m.z) &&
                   organ_raycast(organ->organ, c::vec(origin_m), c::unit(direction), distance);
  if (distance_out_m != nullptr) *distance_out_m = hit ? distance : 0;
  return hit ? 1 : 0;
}
