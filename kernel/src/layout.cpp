// SPDX-License-Identifier: Apache-2.0
#include "layout.h"

#include <algorithm>
#include <cstring>

#include "lattice_plan.h"

namespace stylet {
namespace {

template <typename Bytes>
constexpr Bytes round_block(Bytes bytes) {
  return (bytes + kBlockAlignment - 1) / kBlockAlignment * kBlockAlignment;
}
constexpr std::uint64_t round_lanes(std::uint64_t n) {
  return (n + kLanes - 1) / kLanes * kLanes;
}

// In 64 bits, where no sum of counts below 2^32 wraps; what a pointer cannot span is refused.
#define STYLET_FIELD_SIZE(name, type, count) \
  bytes += round_block(sizeof(type) * static_cast<std::uint64_t>(count));
std::uint64_t model_bytes(const Counts& c) {
  std::uint64_t bytes = 0;
  STYLET_MODEL_FIELDS(STYLET_FIELD_SIZE)
  return bytes;
}
std::uint64_t state_bytes(const Counts& c) {
  std::uint64_t bytes = 0;
  STYLET_STATE_FIELDS(STYLET_FIELD_SIZE)
  return bytes;
}
std::uint64_t scratch_bytes(const Counts& c) {
  std::uint64_t bytes = 0;
  STYLET_SCRATCH_FIELDS(STYLET_FIELD_SIZE)
  return bytes;
}
#undef STYLET_FIELD_SIZE

// Slots, particles and windows: differences of two are 32-bit numbers with a sign.
constexpr std::uint64_t kMostOfACount = INT32_MAX - 64;

}  // namespace

Status count_lattice(const Organ& organ, const Config& config, Counts& counts_out) {
  Counts& c = counts_out = {};
  c.needles = config.needle_count;
  c.voxels = organ.voxel_count;
  c.sheets = organ.size_y / organ.sheet_rows;
  c.ties = static_cast<std::uint32_t>(organ.ties.size());
  c.planes = organ.size_z;
  c.row_grid = static_cast<std::uint32_t>(organ.size_y) * organ.size_z;
  std::uint64_t all_slots = 0, all_particles = 0, most_particles = 0;
  std::uint32_t longest = 0;
  for (std::uint32_t z = 0; z < organ.size_z; ++z) {
    std::uint64_t slots = 1;
    for (std::uint32_t y = 0; y < organ.size_y; ++y) {
      const Extent e = voxel_extent(organ, y, z);
      if (e.begin == e.end) continue;
      slots += e.end - e.begin + 1;
      longest = std::max(longest, e.end - e.begin + 1);
      ++c.rows;
    }
    slots = round_lanes(slots);
    all_slots += slots;
  }
  for (std::uint32_t z = 0; z <= organ.size_z; ++z) {
    std::uint64_t particles = kLanes;
    for (std::uint32_t y = 0; y <= organ.size_y; ++y) {
      const Extent e = node_extent(organ, y, z);
      particles += e.end - e.begin;
    }
    particles = round_lanes(particles);
    all_particles += particles;
    most_particles = std::max(most_particles, particles);
  }
  if (all_slots > kMostOfACount || all_particles > kMostOfACount) return Status::kOrganTooLarge;
  c.slots = static_cast<std::uint32_t>(all_slots);
  c.particles = static_cast<std::uint32_t>(all_particles);
  c.particles_per_plane = static_cast<std::uint32_t>(most_particles);
  for (std::uint32_t z = 0; z < organ.size_z; ++z) {
    for (std::uint32_t y = 0; y <= organ.size_y; ++y) {
      const Extent before = y > 0 ? voxel_extent(organ, y - 1, z) : Extent{0, 0};
      const Extent behind = y < organ.size_y ? voxel_extent(organ, y, z) : Extent{0, 0};
      for (std::uint32_t i = 0; i < 2; ++i) {
        for_each_window(before, behind, 8U << i, [&](auto...) { ++c.windows[i]; });
      }
    }
  }
  // A chunk, the rest of the row it ends in, and two rows kept from the chunk before.
  c.slots_at_once =
      static_cast<std::uint32_t>(round_lanes(kChunk + 3 * std::uint64_t{longest} + 2 * kLanes));
  // The sweep works in whole lanes, so it touches up to two groups behind the last row.
  c.particles += 2 * kLanes;
  c.particles_per_plane += 2 * kLanes;
  return Status::kOk;
}

Status block_sizes(const Counts& counts, Sizes& sizes_out) {
  const std::uint64_t bytes[] = {model_bytes(counts), state_bytes(counts), scratch_bytes(counts)};
  for (const std::uint64_t block : bytes) {
    if (block > static_cast<std::uint64_t>(PTRDIFF_MAX)) return Status::kOrganTooLarge;
  }
  sizes_out = {static_cast<std::size_t>(bytes[0]), static_cast<std::size_t>(bytes[1]),
               static_cast<std::size_t>(bytes[2])};
  return Status::kOk;
}

const Counts& counts_of(const Kernel& kernel) {
  return reinterpret_cast<const ModelHead*>(kernel.model)->counts;
}

#define STYLET_FIELD_PLACE(name, type, count) \
  view.name = reinterpret_cast<type*>(block); \
  block += round_block(sizeof(type) * static_cast<std::size_t>(count));
ModelView model_view(std::byte* block, const Counts& c) {
  ModelView view = {};
  STYLET_MODEL_FIELDS(STYLET_FIELD_PLACE)
  return view;
}
StateView state_view(std::byte* block, const Counts& c) {
  StateView view = {};
  STYLET_STATE_FIELDS(STYLET_FIELD_PLACE)
  view.tip = view.shaft + kMaxConstraintParticles;
  return view;
}
ScratchView scratch_view(std::byte* block, const Counts& c) {
  ScratchView view = {};
  STYLET_SCRATCH_FIELDS(STYLET_FIELD_PLACE)
  return view;
}
#undef STYLET_FIELD_PLACE

View view_of(const Kernel& kernel) {
  const Counts& c = counts_of(kernel);
  return {*kernel.organ, model_view(kernel.model, c), state_view(kernel.state, c),
          scratch_view(kernel.scratch, c), 0};
}

View needle_view(const View& view, std::uint32_t needle) {
  View out = view;
  const std::size_t n = needle;
  out.needle = needle;
  out.model.rod += n;
  out.state.needle += n;
  out.state.shaft += n * kNeedleParticles;
  out.state.tip = out.state.shaft + kMaxConstraintParticles;
  out.state.rod_shape += n;
  out.state.node += n * (kMaxRods + 1);
  out.state.touch += n * kMaxTouches;
  return out;
}

// Padding inside a struct is zero from reset on and never written apart from its fields, so bytes
// are as good as fields here; a test fills the block with a pattern before create to prove it.
std::uint64_t fnv1a(std::uint64_t hash, const void* data, std::size_t bytes) {
  const auto* p = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ p[i]) * 0x100000001b3ULL;
  return hash;
}

std::uint64_t hash_state(const Kernel& kernel) {
  const Counts& c = counts_of(kernel);
  const StateView view = state_view(kernel.state, c);
  std::uint64_t hash = 0xcbf29ce484222325ULL;
#define STYLET_FIELD_HASH(name, type, count) \
  hash = fnv1a(hash, view.name, sizeof(type) * static_cast<std::size_t>(count));
  STYLET_STATE_FIELDS(STYLET_FIELD_HASH)
#undef STYLET_FIELD_HASH
  return hash;
}

Difference first_difference(const Kernel& a, const Kernel& b) {
  const Counts& c = counts_of(a);
  const StateView va = state_view(a.state, c);
  const StateView vb = state_view(b.state, c);
#define STYLET_FIELD_COMPARE(name, type, count)                                      \
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {                \
    if (std::memcmp(&va.name[i], &vb.name[i], sizeof(type)) != 0) return {#name, i}; \
  }
  STYLET_STATE_FIELDS(STYLET_FIELD_COMPARE)
#undef STYLET_FIELD_COMPARE
  return {nullptr, 0};
}

}  // namespace stylet
