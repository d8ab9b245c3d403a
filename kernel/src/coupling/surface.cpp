// SPDX-License-Identifier: Apache-2.0
#include "coupling/surface.h"

#include "lattice/voxel.h"
#include "organ/triangle.h"
#include "state/attachment.h"

namespace stylet {
namespace {

// Least length of needle behind the tip that is searched: longer than any tick's motion at
// 1 kHz. Longer ticks search as far as the fastest handle moves in one tick.
constexpr float kContactReachM = 0.02F;
// The tip must be this far behind the surface, so that rounding brings back no tip that just left.
constexpr float kContactSkinM = 2e-5F;
// A tip that is drawn back more than it is swept aside is on its way out: cos 60 degrees.
constexpr float kSideways = 0.5F;

struct SearchPath {
  Vec3 from_m, direction;
  float length_m;
};

struct Vertex {
  Vec3 rest_m, place_m;
};

// Trilinear: rest place plus the weighted displacements of the voxel's corners.
Vertex deformed(const Model& model, const State& state, const OrganVertex& v) {
  constexpr float kScale = 1.0F / 65535.0F;
  const std::uint32_t slot = model.voxel_slot[v.voxel];
  const Row& row = model.row[model.voxel_row[v.voxel]];
  const std::uint32_t along = slot - row.slot;
  const float fx = static_cast<float>(v.fx) * kScale;
  const float fy = static_cast<float>(v.fy) * kScale;
  const float fz = static_cast<float>(v.fz) * kScale;
  Vertex out = {};
  out.rest_m =
      rest_place(model.organ(), cell_of(model, slot, row), model.plane[row.plane].level, v);
  Vec3 moved = {};
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    const std::uint32_t p = row.node[corner >> 1U] + along + (corner & 1U);
    const float weight = ((corner & 1U) != 0 ? fx : 1 - fx) * ((corner & 2U) != 0 ? fy : 1 - fy) *
                         ((corner & 4U) != 0 ? fz : 1 - fz);
    moved = moved + weight * Vec3{state.ux[p], state.uy[p], state.uz[p]};
  }
  out.place_m = out.rest_m + moved;
  return out;
}

// The farthest place on the segment where it can be crossed within a sphere; false: nowhere.
bool reaches(const OrganSphere& sphere, const SearchPath& s, float grow_m, float& latest_out_m) {
  const Vec3 to = Vec3{sphere.x, sphere.y, sphere.z} - s.from_m;
  const float along = clamp(dot(to, s.direction), 0, s.length_m);
  const Vec3 gap = to - along * s.direction;
  const float reach = sphere.radius + grow_m;
  latest_out_m = along + reach;
  return dot(gap, gap) <= reach * reach;
}

struct Search {
  SearchPath segment;
  float grow_m;
  float best_m;
  Vec3 rest_m, place_m;
  bool found;
  std::uint32_t triangles_left;
};

// One vertex of a leaf is looked at first, because it shows where all of them are: tissue dragged
// far elsewhere makes a search reach many leaves, most of which have hardly moved.
bool is_near(const Model& model, const State& state, const OrganSphere& leaf,
             const SearchPath& segment) {
  const OrganVertex& one = model.organ().vertices[model.organ().triangles[leaf.first].a];
  const Vec3 place = deformed(model, state, one).place_m;
  float unused = 0;
  return reaches({place.x, place.y, place.z, 0, 0, 0}, segment,
                 2 * kMaxSurfaceStretch * leaf.radius, unused);
}

// Tests the triangles of a leaf; false when the triangle budget is spent.
bool search_leaf(const Model& model, const State& state, const OrganSphere& leaf, Search& search) {
  if (!is_near(model, state, leaf, search.segment)) return true;
  for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
    if (search.triangles_left == 0) return false;
    --search.triangles_left;
    const OrganTriangle& t = model.organ().triangles[i];
    const Vertex a = deformed(model, state, model.organ().vertices[t.a]);
    const Vertex b = deformed(model, state, model.organ().vertices[t.b]);
    const Vertex c = deformed(model, state, model.organ().vertices[t.c]);
    float at = 0, u = 0, v = 0;
    const SearchPath& segment = search.segment;
    if (!hit_triangle(segment.from_m, segment.direction, a.place_m, b.place_m, c.place_m, at, u,
                      v) ||
        at < 0 || at > segment.length_m || (search.found && at <= search.best_m)) {
      continue;
    }
    search.found = true;
    search.best_m = at;
    search.place_m = search.segment.from_m + at * search.segment.direction;
    search.rest_m = a.rest_m + u * (b.rest_m - a.rest_m) + v * (c.rest_m - a.rest_m);
  }
  return true;
}

// A node still to be visited, and how far along the segment it can be crossed.
struct Open {
  std::uint32_t node;
  float latest_m;
};

// Nearest to the tip first, with a fixed stack; false when a bound was reached.
bool search_tree(const Model& model, const State& state, Search& search) {
  Open stack[kMaxTreeDepth];
  std::uint32_t top = 0;
  if (model.organ().spheres.empty()) return true;
  const auto push = [&](std::uint32_t node) {
    float latest_m = 0;
    if (!reaches(model.organ().spheres[node], search.segment, search.grow_m, latest_m)) return;
    stack[top++] = {node, latest_m};
    if (top < 2 || stack[top - 2].latest_m <= latest_m) return;
    const Open other = stack[top - 2];
    stack[top - 2] = stack[top - 1];
    stack[top - 1] = other;
  };
  push(0);
  for (std::uint32_t visit = 0; visit < kMaxTreeVisits; ++visit) {
    if (top == 0) return true;
    const Open open = stack[--top];
    if (search.found && open.latest_m <= search.best_m) continue;
    const OrganSphere& node = model.organ().spheres[open.node];
    if (node.count > 0) {
      if (!search_leaf(model, state, node, search)) return false;
      continue;
    }
    if (top + 2 > kMaxTreeDepth) return false;
    push(node.first + 1);
    push(node.first);
  }
  return top == 0;
}

// Searches along a new segment.
bool search_along(const Model& model, const State& state, const SearchPath& segment,
                  Search& search) {
  search.segment = segment;
  search.found = false;
  return search_tree(model, state, search);
}

}  // namespace

float contact_reach_m(const Model& model) {
  return min_of(max_of(kContactReachM, kMaxHandleSpeedMPerS * model.head->config.period_s),
                model.needle_config().length_m);
}

Contact find_contact(const Model& model, State& state, Vec3 tip_m, Vec3 direction, float reach_m,
                     Vec3 step_m, Vec3& rest_out_m, Vec3& place_out_m, std::uint32_t& flags_out) {
  Search search = {};
  // sqrt(3), because the displacement bound is per axis.
  search.grow_m = 1.7320509F * state.head->max_displacement_m;
  search.triangles_left = kMaxTriangleTests;
  bool whole = search_along(
      model, state, {tip_m - reach_m * direction, direction, reach_m - kContactSkinM}, search);
  // For a tip that comes in sideways, the surface may be farther behind it, or nowhere behind it.
  const float way = norm(step_m);
  const bool sideways =
      whole && !search.found && way > kContactSkinM && dot(step_m, direction) > -kSideways * way;
  if (sideways) {
    // From the skin before the last tip to the skin before this one: nothing between the ticks is
    // left out.
    const Vec3 along = (1 / way) * step_m;
    whole =
        search_along(model, state, {tip_m - step_m - kContactSkinM * along, along, way}, search);
    const float depth = dot(tip_m - search.place_m, direction);
    if (depth < kContactSkinM) search.place_m = tip_m - kContactSkinM * direction;
  }
  if (!whole && !search.found) {
    ++state.head->contact_budget;
    flags_out |= kFlagContactBudget;
    return Contact::kUnknown;
  }
  rest_out_m = search.rest_m;
  place_out_m = search.place_m;
  if (!search.found) return Contact::kNone;
  return sideways ? Contact::kSideways : Contact::kFound;
}

std::uint32_t surface(const Kernel& kernel, std::span<Vec3> positions_out) {
  const View view = view_of(kernel);
  const std::size_t count = view.model.organ().vertices.size() < positions_out.size()
                                ? view.model.organ().vertices.size()
                                : positions_out.size();
  const Vec3 shift = attachment_shift(view.model, view.state);
  for (std::size_t i = 0; i < count; ++i) {
    positions_out[i] =
        deformed(view.model, view.state, view.model.organ().vertices[i]).place_m + shift;
  }
  return static_cast<std::uint32_t>(count);
}

std::uint32_t particle_count(const Kernel& kernel) {
  return counts_of(kernel).particles;
}

std::uint32_t voxel_corners(const Kernel& kernel, std::span<std::uint32_t> corners_out) {
  const View view = view_of(kernel);
  std::uint32_t written = 0;
  for (std::uint32_t v = 0; v < view.model.organ().voxel_count; ++v) {
    const Row& row = view.model.row[view.model.voxel_row[v]];
    const std::uint32_t along = view.model.voxel_slot[v] - row.slot;
    for (std::uint32_t corner = 0; corner < 8 && written < corners_out.size(); ++corner) {
      corners_out[written++] = row.node[corner >> 1U] + along + (corner & 1U);
    }
  }
  return written;
}

std::uint32_t particles(const Kernel& kernel, std::span<Vec3> moved_out_m) {
  const View view = view_of(kernel);
  const std::uint32_t all = counts_of(kernel).particles;
  const std::size_t count = all < moved_out_m.size() ? all : moved_out_m.size();
  const Vec3 shift = attachment_shift(view.model, view.state);
  for (std::size_t i = 0; i < count; ++i) {
    moved_out_m[i] = Vec3{view.state.ux[i], view.state.uy[i], view.state.uz[i]} + shift;
  }
  return static_cast<std::uint32_t>(count);
}

}  // namespace stylet
