// SPDX-License-Identifier: Apache-2.0
#include "lattice/hanging.h"

#include <algorithm>

#include "lattice/tiles.h"
#include "lattice/voxel.h"
#include "organ/levels.h"

namespace stylet {
namespace {

constexpr std::uint32_t kMasters = 4;
// The force that a hanging node can pass on in a substep is what its bound on stiffness gives at so
// many edges. Tissue that is torn farther loses momentum there.
constexpr float kFarthest = 16;

// One particle has one number in all its nodes.
std::uint32_t particle_of(const Model& model, std::uint32_t node) {
  return model.head->counts.sheets > 1 ? model.representative[node] : node;
}

// Where in its voxel a node lies, 0 to 1 along an axis.
float place_in_voxel(std::uint32_t node, std::uint32_t voxel, std::uint32_t ratio) {
  return static_cast<float>(node - voxel * ratio) / static_cast<float>(ratio);
}

HangingNode hanging_node(const Organ& organ, const Model& model, const OrganHanging& h) {
  const std::uint32_t planes = organ.level_planes;
  const std::uint32_t own = level_of(planes, h.z), other = level_of(planes, h.voxel_z);
  const std::uint32_t ratio = 1U << (own - other);
  const float f[3] = {place_in_voxel(h.x, h.voxel_x, ratio),
                      place_in_voxel(line_in_space(organ, h.y),
                                     line_in_space(organ, h.voxel_y), ratio),
                      place_in_voxel(h.z - first_plane(planes, own),
                                     h.voxel_z - first_plane(planes, other), ratio)};
  const Row& row = model.row[row_at(model, h.voxel_x, h.voxel_y, h.voxel_z)];
  HangingNode out = {};
  out.node = node_at(model, h.x, h.y, h.z);
  std::uint32_t count = 0;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    float weight = 1;
    for (std::uint32_t a = 0; a < 3; ++a) weight *= ((corner >> a) & 1U) != 0 ? f[a] : 1 - f[a];
    if (!(weight > 0)) continue;
    const std::uint32_t node = row.node[corner >> 1U] + h.voxel_x - row.x0 + (corner & 1U);
    out.master[count] = particle_of(model, node);
    out.weight[count++] = weight;
  }
  for (; count < kMasters; ++count) out.master[count] = out.master[0];
  return out;
}

// After masters that are several nodes have got something.
void copy_tied(const Model& model, float* values) {
  for (std::uint32_t i = 0; i < model.head->counts.ties; ++i) {
    values[model.tie[i].node] = values[model.tie[i].representative];
  }
}

}  // namespace

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

bool hangs(const Model& model, std::uint32_t particle) {
  const HangingNode* const first = model.hanging;
  const HangingNode* const end = first + model.head->counts.hanging;
  const auto before = [](const HangingNode& h, std::uint32_t node) { return h.node < node; };
  const HangingNode* const at = std::lower_bound(first, end, particle, before);
  return at != end && at->node == particle;
}

void fill_shares(Model& model) {
  const std::uint32_t count = model.head->counts.hanging;
  const auto share = [&](HangingNode& h) {
    h.mobility = model.step_per_mass[h.node];
    for (std::uint32_t m = 0; m < kMasters; ++m) {
      h.share[m] = h.weight[m] * model.step_per_mass[h.master[m]] / h.mobility;
    }
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    HangingNode& h = model.hanging_place[i] = model.hanging[i];
    share(h);
    h.node = place_in_tiles(model, h.node);
    for (std::uint32_t& master : h.master) master = place_in_tiles(model, master);
  }
  for (std::uint32_t i = 0; i < count; ++i) {  // masters that hang come first
    HangingNode& h = model.hanging[i];
    model.step_per_mass[h.node] = 1 / (kFarthest * model.head->substep_s * model.bound[h.node]);
    share(h);
    model.particle_kg[h.node] = 0;  // its masters have it
  }
}

void give_momentum(const Model& model, State& state, float most) {
  const std::uint32_t count = model.head->counts.hanging;
  for (float* const w : {&state.wx[0], &state.wy[0], &state.wz[0]}) {
    for (std::uint32_t i = count; i-- > 0;) {
      const HangingNode& h = model.hanging[i];
      const float given = w[h.node];
      w[h.node] = 0;
      for (std::uint32_t m = 0; m < kMasters; ++m) w[h.master[m]] += h.share[m] * given;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      for (const std::uint32_t m : model.hanging[i].master) w[m] = clamp(w[m], -most, most);
    }
    copy_tied(model, w);
  }
}

void follow(const Model& model, float* values, std::ptrdiff_t axis) {
  for (std::uint32_t c = 0; c < 3; ++c, values += axis) {
    for (std::uint32_t i = 0; i < model.head->counts.hanging; ++i) {
      const HangingNode& h = model.hanging[i];
      values[h.node] =
          (h.weight[0] * values[h.master[0]] + h.weight[1] * values[h.master[1]]) +
          (h.weight[2] * values[h.master[2]] + h.weight[3] * values[h.master[3]]);
    }
  }
}

void bound_in_tiles(const Model& model, const float* held, float* bounds) {
  for (std::uint32_t i = 0; i < model.head->counts.hanging; ++i) {
    const std::uint32_t node = model.hanging[i].node;
    const HangingNode& h = model.hanging_place[i];
    bounds[h.node] = h.mobility * (model.bound[node] + held[node]);
    bounds[h.node + kTile] = h.mobility;
  }
}

void give_in_tiles(const Model& model, const FilterPass& pass, const Iterated& by, float* next) {
  for (std::uint32_t i = model.head->counts.hanging; i-- > 0;) {
    const HangingNode& h = model.hanging_place[i];
    for (std::uint32_t c = 0; c < kTileFloats; c += kTile) {
      const std::uint32_t at = h.node + c;
      const float earlier = pass.last * by.last[at] +
                            (pass.first * by.first[at] + pass.before * by.before[at]);
      const float given = next[at] - earlier;
      for (std::uint32_t m = 0; m < kMasters; ++m) next[h.master[m] + c] += h.share[m] * given;
    }
  }
  for (std::uint32_t z = 0; z <= model.head->counts.planes; ++z) {  // as copy_tied
    const Plane& plane = model.plane[z];
    float* const own = next + std::size_t{plane.tiles.node} * kTileFloats;
    for (std::uint32_t i = plane.tie_begin; i < plane.tie_end; ++i) {
      for (std::uint32_t c = 0; c < kTileFloats; c += kTile) {
        own[model.tied_place[i].node + c] = own[model.tied_place[i].representative + c];
      }
    }
  }
}

void follow_in_tiles(const Model& model, float* values) {
  for (std::uint32_t i = 0; i < model.head->counts.hanging; ++i) {
    const HangingNode& h = model.hanging_place[i];
    for (std::uint32_t c = 0; c < kTileFloats; c += kTile) {
      const auto of = [&](std::uint32_t m) { return h.weight[m] * values[h.master[m] + c]; };
      values[h.node + c] = (of(0) + of(1)) + (of(2) + of(3));
    }
  }
}

}  // namespace stylet
