// SPDX-License-Identifier: Apache-2.0
#include "lattice/shadow.h"

#include "lattice/tiles.h"

namespace stylet {
namespace {

constexpr float kLeastBound = 1e-20F;  // N/m: nothing is divided by zero

// Nodes get what the shares of one level say.
void take(const HangingShare* share, const HangingShare* end, Four* all) {
  while (share != end) {
    const HangingShare* const behind = share + share->count;
    Four sum = all[share->to];
    const std::uint32_t to = share->to;
    for (; share != behind; ++share) sum += share->share * all[share->from];
    all[to] = sum;
  }
}

// What moves the momentum of nodes [begin, end) by themselves.
void move_own(const Model& model, std::uint32_t begin, std::uint32_t end, float limit_per_s2,
              Four* all) {
  for (std::uint32_t i = begin; i < end; ++i) {
    const float bound = max_of(model.cascade_bound[i] + all[i][3], kLeastBound);
    all[i] *= min_of(model.cascade_mobility[i], limit_per_s2 / bound);
  }
}

// Border nodes that are several nodes of level 0: so many of a tile's groups of lanes. (In the
// third group, bounds have those of voxels.)
void copy_tied(const Model& model, float* in_tiles, std::uint32_t groups) {
  for (std::uint32_t z = 0; z < model.head->shadows.coarse_planes; ++z) {
    const Plane& plane = model.plane[z];
    float* const own = in_tiles + std::size_t{plane.tiles.node} * kTileFloats;
    for (std::uint32_t i = plane.tie_begin; i < plane.tie_end; ++i) {
      for (std::uint32_t c = 0; c < groups * kTile; c += kTile) {
        own[model.tied_place[i].node + c] = own[model.tied_place[i].representative + c];
      }
    }
  }
}

std::uint32_t coarse_nodes(const Shadows& shadows) {
  return shadows.shadow_begin[1] - shadows.border_begin;
}

}  // namespace

std::uint64_t shadow_floats(const Counts& counts) {
  constexpr std::uint64_t kOfCoarse = 6;  // CascadeVectors
  return 4 * (counts.cascade + kOfCoarse * (std::uint64_t{counts.border} + counts.shadows));
}

CascadeVectors cascade_vectors(const Model& model, float* memory) {
  const Counts& counts = model.head->counts;
  const auto coarse = static_cast<std::ptrdiff_t>(std::uint64_t{counts.border} + counts.shadows);
  Four* const all = reinterpret_cast<Four*>(memory);
  Four* const first = all + counts.cascade;
  return {all,
          first,
          first + coarse,
          {first + 2 * coarse, first + 3 * coarse, first + 4 * coarse},
          first + 5 * coarse};
}

void give_down(const Model& model, const State& state, const Scratch& scratch, Four* all) {
  const Shadows& g = model.head->shadows;
  const auto momentum = [&](std::uint32_t node, std::uint32_t p) {
    const float kg = model.cascade_kg[node];
    all[node] =
        Four{kg * state.wx[p], kg * state.wy[p], kg * state.wz[p], scratch.coupling_bound[p]};
  };
  for (std::uint32_t i = 0; i < g.border_begin; ++i) momentum(i, g.first_particle + i);
  for (std::uint32_t i = g.border_begin; i < g.border_end; ++i) {
    momentum(i, model.border[i - g.border_begin]);
  }
  for (std::uint32_t i = g.border_end; i < model.head->counts.cascade; ++i) all[i] = Four{};
  for (std::uint32_t level = model.head->counts.levels - 1; level > 0; --level) {
    take(model.down_share + g.down_begin[level], model.down_share + g.down_begin[level - 1], all);
    move_own(model, g.fine_begin[level], g.fine_begin[level + 1], g.limit_per_s2[level], all);
    move_own(model, g.shadow_begin[level], g.shadow_begin[level + 1], g.limit_per_s2[level], all);
  }
}

void start_shadows(const Model& model, CascadeVectors& vectors, float* starts, float* bounds) {
  const Shadows& g = model.head->shadows;
  const float dt = model.head->substep_s;
  for (std::uint32_t k = 0; k < coarse_nodes(g); ++k) {
    const std::uint32_t node = g.border_begin + k;
    const float bound = max_of(model.cascade_bound[node] + vectors.all[node][3], kLeastBound);
    const float mobility = min_of(model.cascade_mobility[node], g.fastest_per_s2 / bound);
    vectors.mobility[k] = Four{mobility, mobility * bound, 0, 0};
    vectors.start[k] = mobility * vectors.all[node];
    if (node >= g.border_end) continue;
    const std::uint32_t place = model.border_place[k];
    for (std::uint32_t c = 0; c < 3; ++c) starts[place + c * kTile] = vectors.start[k][c];
    bounds[place] = dt * (mobility * bound);
    bounds[place + kTile] = dt * mobility;
  }
  copy_tied(model, starts, 3);
  copy_tied(model, bounds, 2);
}

void pass_shadows(const Model& model, CascadeVectors& vectors, std::uint32_t j, float* next) {
  const Shadows& g = model.head->shadows;
  const FilterPass& pass = model.head->filter.pass[j - 1];
  const Four *const last = vectors.of_pass(j), *const before = vectors.of_pass(j - 1);
  const std::uint32_t border = g.border_end - g.border_begin;
  Four* const out = vectors.iterate[(j + 1) % 3];
  for (std::uint32_t k = 0; k < coarse_nodes(g); ++k) vectors.got[k] = Four{};
  for (std::uint32_t i = 0; i < g.coarse_cells; ++i) {
    const ShadowCell& cell = model.shadow_cell[i];
    const auto at = [&](std::uint32_t corner) { return cell.node[corner] - g.border_begin; };
    const Four sum = ((last[at(0)] + last[at(1)]) + (last[at(2)] + last[at(3)])) +
                     ((last[at(4)] + last[at(5)]) + (last[at(6)] + last[at(7)]));
    const Four mean = cell.bound_n_per_m * sum;
    for (std::uint32_t corner = 0; corner < 8; ++corner) vectors.got[at(corner)] += mean;
  }
  for (std::uint32_t k = 0; k < border; ++k) {
    const Four more = (pass.bound_s2 * vectors.mobility[k][0]) * vectors.got[k];
    for (std::uint32_t c = 0; c < 3; ++c) next[model.border_place[k] + c * kTile] += more[c];
  }
  copy_tied(model, next, 3);
  for (std::uint32_t k = 0; k < border; ++k) {
    const float* const at = next + model.border_place[k];
    out[k] = Four{at[0], at[kTile], at[2 * kTile], 0};
  }
  for (std::uint32_t k = border; k < coarse_nodes(g); ++k) {
    const Four mobility = vectors.mobility[k];
    out[k] = ((pass.last - pass.bound_s2 * mobility[1]) * last[k] +
              (pass.bound_s2 * mobility[0]) * vectors.got[k]) +
             (pass.first * vectors.start[k] + pass.before * before[k]);
  }
}

void give_up(const Model& model, CascadeVectors& vectors) {
  const Shadows& g = model.head->shadows;
  const Four* const last = vectors.of_pass(model.head->filter.passes + 1);
  for (std::uint32_t k = 0; k < coarse_nodes(g); ++k) vectors.all[g.border_begin + k] = last[k];
  const Counts& counts = model.head->counts;
  for (std::uint32_t level = 1; level < counts.levels; ++level) {
    take(model.up_share + g.up_begin[level], model.up_share + g.up_begin[level + 1], vectors.all);
  }
  for (std::uint32_t z = g.coarse_planes; z <= counts.planes; ++z) {
    for (std::uint32_t i = model.plane[z].tie_begin; i < model.plane[z].tie_end; ++i) {
      const TiedNode& tie = model.tie[i];
      vectors.all[tie.node - g.first_particle] = vectors.all[tie.representative - g.first_particle];
    }
  }
}

void pack_fine(const Model& model, const Plane& plane, const Four* all, float* to,
               std::ptrdiff_t axis) {
  const Four* const from = all + (plane.particle_begin - model.head->shadows.first_particle);
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    for (std::ptrdiff_t c = 0; c < 3; ++c) to[i + c * axis] = from[i][c];
  }
  for (std::ptrdiff_t i = count; i < count + std::ptrdiff_t{kLanes}; ++i) {  // whole registers
    for (std::ptrdiff_t c = 0; c < 3; ++c) to[i + c * axis] = 0;
  }
}

}  // namespace stylet
