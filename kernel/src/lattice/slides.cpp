// SPDX-License-Identifier: Apache-2.0
#include "lattice/slides.h"

#include "base/math.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// Stiffness of a point over that of the softer part's voxel: so pressed parts come nearer to each
// other by a tenth of what a voxel of them is compressed.
constexpr float kContactStiffness = 10.0F;
// What contact may add to the bound on a particle's stiffness, in parts of what its voxels have.
// More would cost passes of the filter everywhere. Where voxels are slivers, and where a fold
// brings many points to one voxel, contact is softer instead.
constexpr float kRoom = 0.5F;
// A ground that is compressed to less than half makes depths steeper. Beyond, the slope is held.
constexpr float kSteepest = 2.0F;
// A voxel flatter than this has no place for a point that could be found.
constexpr float kLeastVolume = 0.05F;
// How far beyond the last voxel of a ground its depth is still known, in edges.
constexpr float kBeyond = 0.25F;

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

// A place of a ground now.
struct Seen {
  Weights weights;
  Vec3 at_m;
  Mat3 gradient;  // of the place now, by the place at rest
};
Seen see(const SlideGround& ground, Vec3 place, float edge_m, const Places& places) {
  Seen out;
  out.weights = weights_at(place);
  Vec3 moved = {};
  Mat3 d = {};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const Vec3 u = places.of(ground.node[i]), s = out.weights.slope[i];
    moved = moved + out.weights.of[i] * u;
    const float of_u[3] = {u.x, u.y, u.z}, along[3] = {s.x, s.y, s.z};
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) d.m[a][b] += of_u[a] * along[b];
    }
  }
  out.at_m = ground.low_m + edge_m * place + moved;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      out.gradient.m[a][b] = (a == b ? 1.0F : 0.0F) + d.m[a][b] / edge_m;
    }
  }
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

// Brings a place back into a voxel of the ground, at most one voxel on along each axis. Where there
// is no further voxel, the last one's map goes on a little.
void enter_voxel(const Model& model, std::uint32_t& ground, Vec3& place) {
  float* const along[3] = {&place.x, &place.y, &place.z};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    float& at = *along[axis];
    const std::uint32_t* const beside = model.ground[ground].beside;
    if (at < 0 && beside[2 * axis] != kNoGround) {
      ground = beside[2 * axis];
      at += 1;
    } else if (at > 1 && beside[2 * axis + 1] != kNoGround) {
      ground = beside[2 * axis + 1];
      at -= 1;
    }
    at = clamp(at, -1, 2);
  }
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

// Follows a point through the ground: one Newton step from where it was a substep ago.
SlideContact meet(const Model& model, const SlidePoint& point, const Places& places,
                  SlideState& own) {
  const float edge_m = model.head->edge_m;
  const Vec3 at_m = place_of(point, places);
  SlideContact out = {};
  Mat3 back = {};  // from now to rest
  const Seen before = see(model.ground[own.ground], own.place, edge_m, places);
  const Vec3 slip_m = at_m - before.at_m;
  if (!invert(before.gradient, back)) return out;
  const Vec3 step = (1 / edge_m) * (back * slip_m);
  own.place = own.place + Vec3{clamp(step.x, -1, 1), clamp(step.y, -1, 1), clamp(step.z, -1, 1)};
  enter_voxel(model, own.ground, own.place);
  const SlideGround& ground = model.ground[own.ground];
  const Seen now = see(ground, own.place, edge_m, places);
  if (is_beside(own.place) || !invert(now.gradient, back)) return out;
  const Outside off = outside(ground, now.weights, edge_m);
  out.slope = transposed_times(back, off.slope);
  const float steep = norm(out.slope);
  if (!(steep > 0)) return out;
  if (steep > kSteepest) out.slope = (kSteepest / steep) * out.slope;
  out.depth_m = max_of(point.rest_outside_m - off.m, 0);
  for (std::uint32_t i = 0; i < 8; ++i) out.weight[i] = now.weights.of[i];
  const Vec3 normal = (1 / norm(out.slope)) * out.slope;
  out.slip_m = slip_m - dot(normal, slip_m) * normal;
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

// The force on the point; slips what is beyond the limit of friction.
Vec3 press(const SlidePoint& point, const SlideContact& c, float share, SlideState& own,
           SlideBooks& books) {
  const float k = share * point.stiffness_n_per_m;
  const Vec3 pushed_n = (k * c.depth_m) * c.slope;
  const float size = norm(c.slope), limit_n = point.friction * norm(pushed_n);
  const Vec3 normal = (1 / size) * c.slope;
  // The spring along the surface goes with the ground's material.
  const Vec3 carried = own.stretch_m - dot(normal, own.stretch_m) * normal;
  Vec3 stretch_m = carried + c.slip_m;
  const float pull_n = k * norm(stretch_m);
  if (pull_n > limit_n) {
    const float kept = limit_n / pull_n;
    books.friction_j += 0.5 * static_cast<double>(k * (1 - kept * kept)) *
                        static_cast<double>(dot(stretch_m, stretch_m));
    stretch_m = kept * stretch_m;
  }
  own.stretch_m = settle(stretch_m);
  own.stiffness_n_per_m = k;
  return pushed_n - k * own.stretch_m;
}

// Nothing holds the point any more.
void part(SlideState& own, SlideBooks& books) {
  books.friction_j += 0.5 * static_cast<double>(own.stiffness_n_per_m) *
                      static_cast<double>(dot(own.stretch_m, own.stretch_m));
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

std::uint32_t node_of(const Row& row, std::uint32_t slot, std::uint32_t corner) {
  return row.node[corner >> 1U] + (slot - row.slot) + (corner & 1U);
}

// The ground in this slot, if it is one. Slots rise with voxels.
std::uint32_t ground_in(const Model& model, std::uint32_t slot) {
  std::uint32_t low = 0, high = model.head->counts.grounds;
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (model.ground[middle].slot < slot) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low < model.head->counts.grounds && model.ground[low].slot == slot ? low : kNoGround;
}

// The ground in the next voxel along an axis, up or down, in the same sheet.
std::uint32_t ground_beside(const Model& model, const Row& row, std::uint32_t slot,
                            std::uint32_t axis, bool up) {
  const std::int32_t x = static_cast<std::int32_t>(row.x0 + (slot - row.slot));
  std::uint32_t y = row.y, z = model.plane[row.plane].z;
  if (!up && ((axis == 1 && y == 0) || (axis == 2 && z == 0))) return kNoGround;
  if (axis == 1) y = up ? y + 1 : y - 1;
  if (axis == 2) z = up ? z + 1 : z - 1;
  if (y >= model.head->size_y || z >= model.head->size_z) return kNoGround;
  const std::int32_t next = axis != 0 ? x : (up ? x + 1 : x - 1);
  const std::uint32_t index = row_at(model, next, y, z);
  if (index == kNoRow) return kNoGround;
  const Row& other = model.row[index];
  return ground_in(model, other.slot + static_cast<std::uint32_t>(next - other.x0));
}

void fill_grounds(const Organ& organ, Model& model) {
  const ModelHead& head = *model.head;
  for (std::uint32_t i = 0; i < head.counts.grounds; ++i) {
    const OrganSlideGround& given = organ.slide_grounds[i];
    SlideGround& ground = model.ground[i];
    const Row& row = model.row[model.voxel_row[given.voxel]];
    ground.slot = model.voxel_slot[given.voxel];
    ground.low_m = head.origin_m + head.edge_m * cell_of(model, ground.slot, row);
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      ground.node[corner] = node_of(row, ground.slot, corner);
      ground.outside_m[corner] = head.edge_m * given.distance[corner];
    }
  }
  for (std::uint32_t i = 0; i < head.counts.grounds; ++i) {  // once all slots are known
    SlideGround& ground = model.ground[i];
    const Row& row = model.row[model.voxel_row[organ.slide_grounds[i].voxel]];
    for (std::uint32_t side = 0; side < 6; ++side) {
      ground.beside[side] = ground_beside(model, row, ground.slot, side / 2, side % 2 != 0);
    }
  }
}

void fill_points(const Organ& organ, Model& model) {
  const ModelHead& head = *model.head;
  for (std::uint32_t i = 0; i < head.counts.slide_points; ++i) {
    constexpr float kScale = 1.0F / 65535.0F;
    const OrganSlidePoint& given = organ.slide_points[i];
    SlidePoint& point = model.slide_point[i];
    const std::uint32_t slot = model.voxel_slot[given.voxel];
    const Row& row = model.row[model.voxel_row[given.voxel]];
    const Vec3 in_voxel = kScale * Vec3{static_cast<float>(given.fx), static_cast<float>(given.fy),
                                        static_cast<float>(given.fz)};
    const Weights weights = weights_at(in_voxel);
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      point.node[corner] = node_of(row, slot, corner);
      point.weight[corner] = weights.of[corner];
    }
    const SlideGround& ground = model.ground[given.ground];
    point.rest_m = head.origin_m + head.edge_m * (cell_of(model, slot, row) + in_voxel);
    point.ground = given.ground;
    point.place = head.inverse_edge_per_m * (point.rest_m - ground.low_m);
    enter_voxel(model, point.ground, point.place);
    // What overlaps at rest, by rounding or as it was drawn, rests there.
    const Weights there = weights_at(point.place);
    point.rest_outside_m = min_of(outside(model.ground[point.ground], there, head.edge_m).m, 0);
    const auto shear_pa = [&](std::uint32_t of_slot) {
      return head.material[model.slot_material[of_slot]].lattice[0].shear_pa;
    };
    point.stiffness_n_per_m = kContactStiffness * head.edge_m * given.area *
                              min_of(shear_pa(slot), shear_pa(ground.slot));
    point.friction = given.friction;
  }
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
  fill_points(organ, model);
}

void add_slide_room(Model& model, float* bound_io) {
  const Counts& counts = model.head->counts;
  for (std::uint32_t i = 0; i < counts.slid_particles; ++i) model.slide_room[i] = 0;
  const auto give = [&](std::uint32_t node) { model.slide_room[node] = kRoom * bound_io[node]; };
  for (std::uint32_t i = 0; i < counts.slide_points; ++i) {
    for (const std::uint32_t node : model.slide_point[i].node) give(node);
  }
  for (std::uint32_t i = 0; i < counts.grounds; ++i) {
    for (const std::uint32_t node : model.ground[i].node) give(node);
  }
  if (counts.slid_particles == 0) return;
  for (std::uint32_t i = 0; i < counts.ties; ++i) {  // one particle, one room
    const TiedNode& tie = model.tie[i];
    const float room = max_of(model.slide_room[tie.node], model.slide_room[tie.representative]);
    model.slide_room[tie.representative] = room;
  }
  for (std::uint32_t i = 0; i < counts.ties; ++i) {
    model.slide_room[model.tie[i].node] = model.slide_room[model.tie[i].representative];
  }
  for (std::uint32_t i = 0; i < counts.slid_particles; ++i) bound_io[i] += model.slide_room[i];
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
  for (std::uint32_t i = 0; i < counts.ties; ++i) {  // one particle
    use[model.tie[i].representative] += use[model.tie[i].node];
  }
  for (std::uint32_t i = 0; i < counts.ties; ++i) {
    use[model.tie[i].node] = use[model.tie[i].representative];
  }
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
    const double k = static_cast<double>(own.stiffness_n_per_m);
    sum += 0.5 * k * static_cast<double>(c.depth_m) * static_cast<double>(c.depth_m);
    sum += 0.5 * k * static_cast<double>(dot(own.stretch_m, own.stretch_m));
  }
  return sum;
}

}  // namespace stylet
