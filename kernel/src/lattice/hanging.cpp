// SPDX-License-Identifier: Apache-2.0
#include "lattice/hanging.h"

#include <algorithm>

#include "base/sort.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// In a substep a hanging node can pass on the force that its bound on stiffness gives when
// stretched by so many edges. Tissue that is torn farther loses momentum there.
constexpr float kFarthest = 16;

// Where in its voxel a node lies, 0 to 1 along each axis.
Vec3 place_in_voxel(const Organ& organ, const OrganHanging& h) {
  const std::uint32_t planes = organ.level_planes;
  const std::uint32_t own = level_of(planes, h.z), other = level_of(planes, h.voxel_z);
  const std::uint32_t ratio = 1U << (own - other);
  const auto part = [&](std::uint32_t node, std::uint32_t voxel) {
    return static_cast<float>(node - voxel * ratio) / static_cast<float>(ratio);
  };
  return {part(h.x, h.voxel_x), part(line_in_space(organ, h.y), line_in_space(organ, h.voxel_y)),
          part(h.z - first_plane(planes, own), h.voxel_z - first_plane(planes, other))};
}

// Calls visit(corner, weight) for the corners of the voxel that move a place in it.
template <typename Visit>
void each_master(Vec3 place, Visit visit) {
  const float f[3] = {place.x, place.y, place.z};
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    float weight = 1;
    for (std::uint32_t a = 0; a < 3; ++a) weight *= ((corner >> a) & 1U) != 0 ? f[a] : 1 - f[a];
    if (weight > 0) visit(corner, weight);
  }
}

HangingNode hanging_node(const Organ& organ, const Model& model, const OrganHanging& h) {
  const Row& row = model.row[row_at(model, h.voxel_x, h.voxel_y, h.voxel_z)];
  HangingNode out = {};
  out.node = node_at(model, h.x, h.y, h.z);
  std::uint32_t count = 0;
  each_master(place_in_voxel(organ, h), [&](std::uint32_t corner, float weight) {
    const std::uint32_t node = row.node[corner >> 1U] + h.voxel_x - row.x0 + (corner & 1U);
    out.master[count] = particle_of(model, node);
    out.weight[count++] = weight;
  });
  for (; count < kMasters; ++count) out.master[count] = out.master[0];
  return out;
}

// After masters that are several nodes have got something.
void copy_tied(const Model& model, float* values) {
  for (std::uint32_t i = 0; i < model.head->counts.ties; ++i) {
    values[model.tie[i].node] = values[model.tie[i].representative];
  }
}

// Shares with the present mobilities: those of the finest nodes first, by master.
void list_shares(const Model& model, HangingShare* shares) {
  HangingShare* end = shares;
  for (std::uint32_t i = 0; i < model.head->counts.hanging; ++i) {
    const HangingNode& h = model.hanging[i];
    const std::uint32_t level = level_of_particle(model, h.node);
    for (std::uint32_t m = 0; m < kMasters; ++m) {
      if (!(h.weight[m] > 0)) continue;
      const float own = model.step_per_mass[h.node], other = model.step_per_mass[h.master[m]];
      *end++ = {h.master[m], h.node, h.weight[m] * other / own, level};
    }
  }
  order_shares(shares, end, true);
  count_shares(shares, end);
}

}  // namespace

void order_shares(HangingShare* first, HangingShare* end, bool finest_first) {
  sort(first, end, [=](const HangingShare& a, const HangingShare& b) {
    if (a.count != b.count) return finest_first ? a.count > b.count : a.count < b.count;
    return a.to != b.to ? a.to < b.to : a.from < b.from;
  });
}

void count_shares(HangingShare* first, const HangingShare* end) {
  while (first != end) {
    HangingShare* next = first;
    for (; next != end && next->to == first->to && next->count == first->count; ++next) {
    }
    first->count = static_cast<std::uint32_t>(next - first);
    first = next;
  }
}

void count_hanging(const Organ& organ, Counts& counts_io) {
  counts_io.hanging = static_cast<std::uint32_t>(organ.hanging.size());
  counts_io.hanging_shares = 0;
  for (const OrganHanging& h : organ.hanging) {
    each_master(place_in_voxel(organ, h), [&](auto...) { ++counts_io.hanging_shares; });
  }
}

void fill_hanging(const Organ& organ, Model& model) {
  for (std::uint32_t i = 0; i < model.head->counts.hanging; ++i) {
    model.hanging[i] = hanging_node(organ, model, organ.hanging[i]);
  }
}

void add_to_masters(const Model& model, float* of_particles) {
  for (std::uint32_t i = model.head->counts.hanging; i-- > 0;) {
    const HangingNode& h = model.hanging[i];
    for (std::uint32_t m = 0; m < kMasters; ++m) {
      of_particles[h.master[m]] += h.weight[m] * of_particles[h.node];
    }
  }
  copy_tied(model, of_particles);
}

std::uint32_t level_of_particle(const Model& model, std::uint32_t particle) {
  const Plane* const end = model.plane + (model.head->counts.planes + 1);
  const auto before = [](std::uint32_t at, const Plane& plane) {
    return at < plane.particle_begin;
  };
  return std::upper_bound(&model.plane[0], end, particle, before)[-1].level;
}

const HangingNode* hanging_at(const Model& model, std::uint32_t particle) {
  const HangingNode* const first = model.hanging;
  const HangingNode* const end = first + model.head->counts.hanging;
  const auto before = [](const HangingNode& h, std::uint32_t node) { return h.node < node; };
  const HangingNode* const at = std::lower_bound(first, end, particle, before);
  return at != end && at->node == particle ? at : nullptr;
}

void fill_shares(Model& model) {
  const Counts& counts = model.head->counts;
  for (std::uint32_t i = 0; i < counts.hanging; ++i) {
    const std::uint32_t node = model.hanging[i].node;
    model.step_per_mass[node] = 1 / (kFarthest * model.head->substep_s * model.bound[node]);
    model.particle_kg[node] = 0;  // its masters have it
  }
  list_shares(model, model.hanging_share);
}

void give_momentum(const Model& model, State& state, float most) {
  const Counts& counts = model.head->counts;
  for (float* const w : {&state.wx[0], &state.wy[0], &state.wz[0]}) {
    const HangingShare* share = model.hanging_share;
    const HangingShare* const end = share + counts.hanging_shares;
    while (share != end) {
      const HangingShare* const next = share + share->count;
      float& to = w[share->to];
      float sum = to;
      for (; share != next; ++share) sum += share->share * w[share->from];
      to = clamp(sum, -most, most);
    }
    for (std::uint32_t i = 0; i < counts.hanging; ++i) w[model.hanging[i].node] = 0;
    copy_tied(model, w);
  }
}

void follow(const Model& model, float* values, std::ptrdiff_t axis) {
  for (std::uint32_t c = 0; c < 3; ++c, values += axis) {
    for (std::uint32_t i = 0; i < model.head->counts.hanging; ++i) {
      const HangingNode& h = model.hanging[i];
      values[h.node] = (h.weight[0] * values[h.master[0]] + h.weight[1] * values[h.master[1]]) +
                       (h.weight[2] * values[h.master[2]] + h.weight[3] * values[h.master[3]]);
    }
  }
}

}  // namespace stylet
