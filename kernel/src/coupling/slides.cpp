// SPDX-License-Identifier: Apache-2.0
#include "coupling/slides.h"

#include "base/math.h"
#include "coupling/grounds.h"
#include "lattice/hanging.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// Stiffness of a point over that of the softer part's voxel: so pressed parts come nearer to each
// other by a quarter of what a voxel of them is compressed. The room that the step leaves for it
// is inertia that surfaces have at every moment (add_slide_room), in proportion to it.
constexpr float kContactStiffness = 4.0F;
// What contact may add to the bound on a particle's stiffness at most, in parts of what its voxels
// have. More would cost passes of the filter everywhere. Where voxels are slivers, and where a fold
// brings many points to one voxel, contact is softer instead.
constexpr float kRoom = 0.5F;
// A ground that is compressed to less than half makes depths steeper. Beyond, the slope is held.
constexpr float kSteepest = 2.0F;
// A voxel flatter than this has no place for a point that could be found.
constexpr float kLeastVolume = 0.05F;
// How far beyond the last voxel of a ground its depth is still known, in edges.
constexpr float kBeyond = 0.25F;
// How far a point goes in a substep at most, in edges.
constexpr float kStep = 1.0F;

// Weights of a voxel's corners at a place in it (0 to 1 along each axis), and their slopes.
struct Weights {
  float of[8];
  Vec3 slope[8];
};
Weights weights_at(Vec3 place) {
  Weights out;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const float sx = (i & 1U) != 0 ? 1.0F : -1.0F, wx = (i & 1U) != 0 ? place.x : 1 - place.x;
    const float sy = (i & 2U) != 0 ? 1.0F : -1.0F, wy = (i & 2U) != 0 ? place.y : 1 - place.y;
    const float sz = (i & 4U) != 0 ? 1.0F : -1.0F, wz = (i & 4U) != 0 ? place.z : 1 - place.z;
    out.of[i] = wx * wy * wz;
    out.slope[i] = {sx * (wy * wz), sy * (wx * wz), sz * (wx * wy)};
  }
  return out;
}

// Where the tissue's particles are: displacements, x, y, z one after the other.
struct Places {
  const float *x, *y, *z;
  Vec3 of(std::uint32_t node) const { return {x[node], y[node], z[node]}; }
};
// As the tissue's own forces are taken: ahead by its damping time.
Places damped(const State& state) {
  return {state.ex, state.ey, state.ez};
}

// A place of a ground now. Farther than kBeyond from the voxel its map goes on straight.
struct Seen {
  Vec3 at_m;
  Mat3 gradient;  // of the place now, by the place at rest
};
Seen see(const SlideGround& ground, Vec3 place, float edge_m, const Places& places) {
  Seen out;
  const Vec3 near = within(place, -kBeyond, 1 + kBeyond);
  const Weights weights = weights_at(near);
  Vec3 moved = {};
  Mat3 d = {};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const Vec3 u = places.of(ground.node[i]), s = weights.slope[i];
    moved = moved + weights.of[i] * u;
    const float of_u[3] = {u.x, u.y, u.z}, along[3] = {s.x, s.y, s.z};
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) d.m[a][b] += of_u[a] * along[b];
    }
  }
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      out.gradient.m[a][b] = (a == b ? 1.0F : 0.0F) + d.m[a][b] / edge_m;
    }
  }
  out.at_m = ground.low_m + edge_m * near + moved + edge_m * (out.gradient * (place - near));
  return out;
}

// The inverse of a gradient; false if it is (nearly) flat or turned inside out.
bool invert(const Mat3& f, Mat3& inverse_out) {
  const Vec3 a = column(f, 0), b = column(f, 1), c = column(f, 2);
  const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const float volume = dot(a, bc);
  if (!(volume > kLeastVolume)) return false;
  const float scale = 1 / volume;
  inverse_out = {{{scale * bc.x, scale * bc.y, scale * bc.z},
                  {scale * ca.x, scale * ca.y, scale * ca.z},
                  {scale * ab.x, scale * ab.y, scale * ab.z}}};
  return true;
}

Vec3 place_of(const SlidePoint& point, const Places& places) {
  Vec3 moved = {};
  for (std::uint32_t i = 0; i < 8; ++i) {
    moved = moved + point.weight[i] * places.of(point.node[i]);
  }
  return point.rest_m + moved;
}

bool is_beside(Vec3 place) {
  return place.x < -kBeyond || place.y < -kBeyond || place.z < -kBeyond ||  //
         place.x > 1 + kBeyond || place.y > 1 + kBeyond || place.z > 1 + kBeyond;
}

// How far outside the ground's surface a place of it lies, in the ground at rest, and its slope.
struct Outside {
  float m;
  Vec3 slope;
};
Outside outside(const SlideGround& ground, const Weights& weights, float edge_m) {
  Outside out = {};
  for (std::uint32_t i = 0; i < 8; ++i) {
    out.m = out.m + weights.of[i] * ground.outside_m[i];
    out.slope = out.slope + (ground.outside_m[i] / edge_m) * weights.slope[i];
  }
  return out;
}

// Follows a point through the ground: one Newton step from where it was a substep ago. The slope is
// turned with the gradient there: a gradient at the new place would cost a third more.
SlideContact meet(const Model& model, const SlidePoint& point, const Places& places,
                  SlideState& own) {
  const SlideGround& last = model.ground[own.ground];
  const float edge_m = edge_m_of(model, last);
  SlideContact out = {};
  Mat3 back = {};  // from now to rest
  const Seen before = see(last, own.place, edge_m, places);
  const Vec3 slip_m = place_of(point, places) - before.at_m;
  const bool crushed = !invert(before.gradient, back);
  if (crushed) {  // it stays with its material, and is pressed as that was at rest
    back = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  } else {
    own.place = own.place + within((1 / edge_m) * (back * slip_m), -kStep, kStep);
  }
  enter_ground(model, own.ground, own.place);
  own.place = settle(own.place);
  if (is_beside(own.place)) return out;
  const Weights weights = weights_at(own.place);
  const SlideGround& ground = model.ground[own.ground];
  const Outside off = outside(ground, weights, edge_m_of(model, ground));
  out.slope = transposed_times(back, off.slope);
  const float steep = norm(out.slope);
  if (!(steep > 0)) return out;
  if (steep > kSteepest) out.slope = (kSteepest / steep) * out.slope;
  out.depth_m = max_of(point.rest_outside_m - off.m, 0);
  for (std::uint32_t i = 0; i < 8; ++i) out.weight[i] = weights.of[i];
  const Vec3 normal = (1 / norm(out.slope)) * out.slope;
  if (!crushed) out.slip_m = slip_m - dot(normal, slip_m) * normal;
  return out;
}

// Bound on the stiffness that a point's contact adds to a particle with this weight in it: of
// w w^T, with the sum of all sizes of w, by rows.
float bound_of(float stiffness_n_per_m, float weight, float weights) {
  return stiffness_n_per_m * (weight < 0 ? -weight : weight) * (1 + weights);
}

float size_of(const float (&weights)[8]) {
  float sum = 0;
  for (const float w : weights) sum += w < 0 ? -w : w;
  return sum;
}

// Calls visit(particle, bound) for all that a contact is between.
template <typename Visit>
void each_bound(const Model& model, const SlidePoint& point, const SlideState& own,
                const SlideContact& c, Visit visit) {
  const float k = point.stiffness_n_per_m * max_of(dot(c.slope, c.slope), 1);
  const float size = size_of(c.weight);
  const SlideGround& ground = model.ground[own.ground];
  for (std::uint32_t i = 0; i < 8; ++i) {
    visit(point.node[i], bound_of(k, point.weight[i], size));
    visit(ground.node[i], bound_of(k, c.weight[i], size));
  }
}

double stored_j(float stiffness_n_per_m, Vec3 stretch_m) {
  return 0.5 * static_cast<double>(stiffness_n_per_m) *
         static_cast<double>(dot(stretch_m, stretch_m));
}

// The force on the point; slips what is beyond the limit of friction.
Vec3 press(const SlidePoint& point, const SlideContact& c, float share, SlideState& own,
           SlideBooks& books) {
  const float k = share * point.stiffness_n_per_m;
  const Vec3 pushed_n = (k * c.depth_m) * c.slope;
  const Vec3 normal = (1 / norm(c.slope)) * c.slope;
  const float limit_n = point.friction * norm(pushed_n);
  // The spring along the surface goes with the ground's material.
  const Vec3 carried = own.stretch_m - dot(normal, own.stretch_m) * normal;
  const Vec3 stretched = carried + c.slip_m;
  const float pull_n = k * norm(stretched);
  const Vec3 kept = pull_n > limit_n ? (limit_n / pull_n) * stretched : stretched;
  books.friction_j += stored_j(own.stiffness_n_per_m, own.stretch_m) - stored_j(k, carried);
  books.friction_j += static_cast<double>(k) * static_cast<double>(dot(kept, stretched - kept));
  own.stretch_m = settle(kept);
  own.stiffness_n_per_m = k;
  return pushed_n - k * own.stretch_m;
}

// Nothing holds the point any more.
void part(SlideState& own, SlideBooks& books) {
  books.friction_j += stored_j(own.stiffness_n_per_m, own.stretch_m);
  own.stretch_m = {};
  own.stiffness_n_per_m = 0;
}

void add_force(const Model& model, const SlidePoint& point, const SlideState& own,
               const SlideContact& c, Vec3 force_n, float* sums) {
  const std::size_t axis = model.head->counts.slid_particles;
  const float of[3] = {force_n.x, force_n.y, force_n.z};
  const SlideGround& ground = model.ground[own.ground];
  for (std::uint32_t a = 0; a < 3; ++a) {
    float* const to = sums + a * axis;
    for (std::uint32_t i = 0; i < 8; ++i) {
      to[point.node[i]] += point.weight[i] * of[a];
      to[ground.node[i]] -= c.weight[i] * of[a];
    }
  }
}

// Points may come to any of the ground's particles: each gets the most that any of its level has.
// Where none of a level has a point, those of other levels may come: it gets as much as those of
// level 0 would have.
void level_out(const Model& model, float* of_particles) {
  float most[kMaxLevels] = {}, as_coarsest = 0;
  const SlideGround* const end = model.ground + model.head->counts.grounds;
  for (const SlideGround* ground = model.ground; ground != end; ++ground) {
    for (const std::uint32_t node : ground->node) {
      most[ground->level] = max_of(most[ground->level], of_particles[node]);
    }
  }
  for (std::uint32_t level = 0; level < kMaxLevels; ++level) {
    as_coarsest = max_of(as_coarsest, static_cast<float>(1U << (2 * level)) * most[level]);
  }
  for (const SlideGround* ground = model.ground; ground != end; ++ground) {
    const float own = most[ground->level];
    for (const std::uint32_t node : ground->node) of_particles[node] = own > 0 ? own : as_coarsest;
  }
}

// The bounds of tissue with that of what hangs on a particle; a hanging one has that of its
// masters. So a sliver of a voxel above finer or coarser ones has room as above its like.
const float* all_bounds(Model& model, const float* bound) {
  const Counts& counts = model.head->counts;
  float* const all = model.bound;  // later that of the particle alone
  for (std::uint32_t i = 0; i < counts.particles; ++i) all[i] = bound[i];
  add_to_masters(model, all);
  for (std::uint32_t i = 0; i < counts.hanging; ++i) {
    const HangingNode& h = model.hanging[i];
    float sum = 0;
    for (std::uint32_t m = 0; m < kMasters; ++m) sum += h.weight[m] * all[h.master[m]];
    all[h.node] = sum;
  }
  return all;
}

void fill_point(const Organ& organ, const Model& model, const OrganSlidePoint& given,
                SlidePoint& point) {
  constexpr float kScale = 1.0F / 65535.0F;
  const ModelHead& head = *model.head;
  const std::uint32_t slot = model.voxel_slot[given.voxel];
  const Row& row = model.row[model.voxel_row[given.voxel]];
  const Level& level = level_of(model, row);
  const Vec3 in_voxel = kScale * Vec3{static_cast<float>(given.fx), static_cast<float>(given.fy),
                                      static_cast<float>(given.fz)};
  const Weights weights = weights_at(in_voxel);
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    point.node[corner] = corner_node(row, slot, corner);
    point.weight[corner] = weights.of[corner];
  }
  point.ground = ground_of(organ, model, given.ground);
  const SlideGround& given_ground = model.ground[point.ground];
  const std::uint32_t ground_slot = given_ground.slot;
  point.rest_m = head.origin_m + level.edge_m * (cell_of(model, slot, row) + in_voxel);
  point.place =
      head.level[given_ground.level].inverse_edge_per_m * (point.rest_m - given_ground.low_m);
  enter_ground(model, point.ground, point.place);
  // What overlaps at rest, by rounding or as it was drawn, rests there. Across a gap the distance
  // is that at the ground's end: trilinear weights grow without bound beyond it.
  const Weights there = weights_at(within(point.place, -kBeyond, 1 + kBeyond));
  const SlideGround& ground = model.ground[point.ground];
  point.rest_outside_m = min_of(outside(ground, there, edge_m_of(model, ground)).m, 0);
  // For each area, that of voxels of level 0, also between finer ones: so it does not change where
  // a point comes to another level, which would add energy, and one pressure gives one depth.
  const float ratio = level.edge_m / head.edge_m;
  const auto shear_pa = [&](std::uint32_t of_slot) {
    return head.material[model.slot_material[of_slot]].lattice[0].shear_pa;
  };
  point.stiffness_n_per_m = kContactStiffness * head.edge_m * (given.area * ratio * ratio) *
                            min_of(shear_pa(slot), shear_pa(ground_slot));
  point.friction = given.friction;
}

}  // namespace

void count_slides(const Organ& organ, Counts& counts_io) {
  counts_io.slide_points = static_cast<std::uint32_t>(organ.slide_points.size());
  if (counts_io.slide_points == 0) return;
  counts_io.grounds = static_cast<std::uint32_t>(organ.slide_grounds.size());
  counts_io.slid_particles = counts_io.particles;
  counts_io.slides = 1;
}

void fill_slides(const Organ& organ, Model& model) {
  if (!has_slides(model)) return;
  fill_grounds(organ, model);
  for (std::uint32_t i = 0; i < model.head->counts.slide_points; ++i) {
    fill_point(organ, model, organ.slide_points[i], model.slide_point[i]);
  }
}

// What contact needs where the parts lie on each other as they do at rest. The room is there from
// the start, touching or not: a particle whose inertia fell when it let go would be thrown.
void add_slide_room(Model& model, float* bound_io) {
  const Counts& counts = model.head->counts;
  if (!has_slides(model)) return;
  float* const room = model.slide_room;
  for (std::uint32_t i = 0; i < counts.slid_particles; ++i) room[i] = 0;
  for (std::uint32_t i = 0; i < counts.slide_points; ++i) {
    const SlidePoint& point = model.slide_point[i];
    const SlideGround& ground = model.ground[point.ground];
    const Weights there = weights_at(within(point.place, 0, 1));
    for (std::uint32_t n = 0; n < 8; ++n) {
      room[point.node[n]] += bound_of(point.stiffness_n_per_m, point.weight[n], 1);
      room[ground.node[n]] += bound_of(point.stiffness_n_per_m, there.of[n], 1);
    }
  }
  sum_tied(model, room);
  level_out(model, room);
  for (std::uint32_t i = 0; i < counts.ties; ++i) {  // one particle, one inertia
    float& of_both = room[model.tie[i].representative];
    of_both = max_of(of_both, room[model.tie[i].node]);
  }
  for (std::uint32_t i = 0; i < counts.ties; ++i) {
    room[model.tie[i].node] = room[model.tie[i].representative];
  }
  const float* const bound = is_graded(model) ? all_bounds(model, bound_io) : bound_io;
  for (std::uint32_t i = 0; i < counts.slid_particles; ++i) {
    room[i] = min_of(room[i], kRoom * bound[i]);
    bound_io[i] += room[i];
  }
}

void reset_slides(const Model& model, State& state) {
  for (std::uint32_t i = 0; i < model.head->counts.slide_points; ++i) {
    const SlidePoint& point = model.slide_point[i];
    state.slide[i] = {point.place, {}, 0, point.ground};
  }
}

void press_slides(const Model& model, State& state, Scratch& scratch) {
  if (!has_slides(model)) return;
  const Counts& counts = model.head->counts;
  const Places places = damped(state);
  float* const use = scratch.slide_use;
  for (std::uint32_t i = 0; i < counts.slid_particles; ++i) use[i] = 0;
  for (std::uint32_t i = 0; i < 3 * counts.slid_particles; ++i) scratch.slide_force[i] = 0;
  for (std::uint32_t i = 0; i < counts.slide_points; ++i) {
    const SlidePoint& point = model.slide_point[i];
    SlideContact& c = scratch.slide_contact[i];
    c = meet(model, point, places, state.slide[i]);
    if (c.depth_m > 0) {
      each_bound(model, point, state.slide[i], c,
                 [&](std::uint32_t node, float bound) { use[node] += bound; });
    } else {
      part(state.slide[i], *state.slide_books);
    }
  }
  sum_tied(model, use);
  for (std::uint32_t i = 0; i < counts.slide_points; ++i) {
    const SlideContact& c = scratch.slide_contact[i];
    if (!(c.depth_m > 0)) continue;
    const SlidePoint& point = model.slide_point[i];
    SlideState& own = state.slide[i];
    float share = 1;
    each_bound(model, point, own, c, [&](std::uint32_t node, float bound) {
      if (bound > 0 && use[node] > model.slide_room[node]) {
        share = min_of(share, model.slide_room[node] / use[node]);
      }
    });
    add_force(model, point, own, c, press(point, c, share, own, *state.slide_books),
              scratch.slide_force);
  }
}

double slides_energy(const Model& model, const State& state) {
  const Places places = {state.ux, state.uy, state.uz};
  double sum = 0;
  for (std::uint32_t i = 0; i < model.head->counts.slide_points; ++i) {
    SlideState own = state.slide[i];
    const SlideContact c = meet(model, model.slide_point[i], places, own);
    sum += stored_j(own.stiffness_n_per_m, {c.depth_m, 0, 0}) +
           stored_j(own.stiffness_n_per_m, own.stretch_m);
  }
  return sum;
}

}  // namespace stylet
