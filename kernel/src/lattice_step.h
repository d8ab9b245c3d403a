// SPDX-License-Identifier: Apache-2.0
// Body of the lattice sweep, included once per instruction set by lattice_<isa>.cpp with
// STYLET_LATTICE_STEP naming the function. See lattice.h for physics and promises.
//
// Per voxel plane: 1 sums and differences of the eight corners, row by row; 2 rotation and the four
// vectors each cluster sends to its corners, over all slots of the plane in full lanes; 3 each
// window of nodes collects what the voxel rows at its sides send (lattice_plan.h); then the
// particles of the plane's low side have all their forces and move. A plane of clusters and two of
// forces stay in cache; nothing else is stored.

#include "lattice.h"
#include "lattice_team.h"
#include "rotation.h"

namespace stylet {
namespace {

// Smallest steps of velocity, displacement and rotation: keeps denormals (20 times slower, and
// rounded differently by processors that flush them) out of the state.
constexpr float kQuantum = 1.52587890625e-05F;  // 2^-16: displacements and velocities to 2e-12
constexpr float kQuantumTurn = 1.953125e-3F;    // 2^-9: quaternion parts to 2e-10

// The loops below run over whole groups of lanes and do not overlap; they stay functions of their
// own so that the compiler sees that.
#if defined(__clang__)
#define STYLET_VECTOR _Pragma("clang loop vectorize(assume_safety)")
#else
#define STYLET_VECTOR _Pragma("GCC ivdep")
#endif
#define STYLET_KEEP_APART __attribute__((noinline))

// A group of lanes as one value, for loops over short rows: as wide as the registers are.
#if defined(__AVX512F__)
constexpr std::uint32_t kWide = 16;
#elif defined(__AVX2__)
constexpr std::uint32_t kWide = 8;
#else
constexpr std::uint32_t kWide = 4;
#endif
typedef float Wide __attribute__((vector_size(4 * kWide)));
typedef std::int32_t WideBits __attribute__((vector_size(4 * kWide)));
// The same at any address of a float.
typedef float Loose __attribute__((vector_size(4 * kWide), aligned(4), may_alias));

inline Wide load(const float* from) {
  return *reinterpret_cast<const Loose*>(from);
}
inline void store(float* to, Wide value) {
  *reinterpret_cast<Loose*>(to) = value;
}
// Lane i is set if bit i is.
inline WideBits lanes_set(std::uint32_t bits) {
  WideBits bit = {};
  for (std::uint32_t i = 0; i < kWide; ++i) bit[i] = 1 << i;
  return (bit & static_cast<std::int32_t>(bits)) != 0;
}
inline Wide zero_unless(WideBits set, Wide value) {
  return set ? value : Wide{};
}

// Stage 1 for one component of eight corners; `n` are the first nodes of the four rows, the results
// lie at `mean` and from `gradient` on, `stride` apart.
inline void sum_corners(const float* const n[4], std::ptrdiff_t offset, float inverse_edge_4,
                        float* mean, float* gradient, std::ptrdiff_t stride) {
  const Wide a0 = load(n[0] + offset), b0 = load(n[0] + offset + 1), s0 = a0 + b0, d0 = b0 - a0;
  const Wide a1 = load(n[1] + offset), b1 = load(n[1] + offset + 1), s1 = a1 + b1, d1 = b1 - a1;
  const Wide a2 = load(n[2] + offset), b2 = load(n[2] + offset + 1), s2 = a2 + b2, d2 = b2 - a2;
  const Wide a3 = load(n[3] + offset), b3 = load(n[3] + offset + 1), s3 = a3 + b3, d3 = b3 - a3;
  const Wide low = s0 + s1, high = s2 + s3;
  store(mean, (low + high) * 0.125F);
  store(gradient, ((d0 + d1) + (d2 + d3)) * inverse_edge_4);
  store(gradient + stride, ((s1 - s0) + (s3 - s2)) * inverse_edge_4);
  store(gradient + 2 * stride, (high - low) * inverse_edge_4);
}

// Stage 1: twelve arrays over the slots of a plane, `slots_per_plane` apart: mean displacement (3),
// then its gradient, row-major (9). Rows in order, so that what a row's last lanes write beyond its
// end is written again by the next row.
void sum_plane(const View& view, const Plane& plane) {
  const ModelHead& head = *view.model.head;
  const float inverse_edge_4 = head.inverse_edge_per_m * 0.25F;
  const auto stride = static_cast<std::ptrdiff_t>(head.counts.slots_per_plane);
  const std::ptrdiff_t next_axis = view.state.ey - view.state.ex;  // as from y to z
  const float* e = view.state.ex;
  // Slots no row reaches still pass through stage 2: give them numbers. They are the first, and
  // some of the last group of lanes.
  for (std::ptrdiff_t k = 0; k < 12; ++k) {
    float* array = view.scratch.sums + k * stride;
    array[0] = 0;
    float* last = array + (plane.slot_end - plane.slot_begin) - kLanes;
    for (std::uint32_t i = 0; i < kLanes; i += kWide) store(last + i, Wide{});
  }
  for (std::uint32_t r = plane.row_begin; r < plane.row_end; ++r) {
    const Row& row = view.model.row[r];
    const float* n[4] = {e + row.node[0], e + row.node[1], e + row.node[2], e + row.node[3]};
    float* mean = view.scratch.sums + (row.slot - plane.slot_begin);
    const float* const end = mean + row.count;
    for (; mean <= end; mean += kWide) {
      float* gradient = mean + 3 * stride;
      for (int c = 0; c < 3; ++c) {
        sum_corners(n, c * next_axis, inverse_edge_4, mean + c * stride, gradient, stride);
        gradient += 3 * stride;
      }
      for (const float*& node : n) node += kWide;
    }
  }
}

// Stage 2, in place over all slots of a plane: `t` mean displacement -> T = k chi t, `g` gradient,
// row-major -> columns of k (h / 2) H. The twelve arrays lie `stride` apart from `sums` on.
STYLET_KEEP_APART void fit_slots(std::uint32_t lanes, std::size_t stride, float chi,
                                 float half_edge, const float* __restrict stiffness,
                                 const float* __restrict volume, float* __restrict qw,
                                 float* __restrict qx, float* __restrict qy, float* __restrict qz,
                                 float* __restrict sums) {
  float* t0 = sums;
  float* t1 = sums + stride;
  float* t2 = sums + 2 * stride;
  float* g0 = sums + 3 * stride;
  float* g1 = sums + 4 * stride;
  float* g2 = sums + 5 * stride;
  float* g3 = sums + 6 * stride;
  float* g4 = sums + 7 * stride;
  float* g5 = sums + 8 * stride;
  float* g6 = sums + 9 * stride;
  float* g7 = sums + 10 * stride;
  float* g8 = sums + 11 * stride;
  lanes = lanes / kLanes * kLanes;
  STYLET_VECTOR
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const float d00 = g0[i], d01 = g1[i], d02 = g2[i];
    const float d10 = g3[i], d11 = g4[i], d12 = g5[i];
    const float d20 = g6[i], d21 = g7[i], d22 = g8[i];
    float w = qw[i], x = qx[i], y = qy[i], z = qz[i];
    rotation_step<0>(1 + d00, d01, d02, d10, 1 + d11, d12, d20, d21, 1 + d22, w, x, y, z);
    x = (x + kQuantumTurn) - kQuantumTurn;
    y = (y + kQuantumTurn) - kQuantumTurn;
    z = (z + kQuantumTurn) - kQuantumTurn;
    const float k = stiffness[i];
    // Empty slots stay upright, whatever their neighbours do.
    qw[i] = k > 0 ? w : 1.0F;
    qx[i] = k > 0 ? x : 0.0F;
    qy[i] = k > 0 ? y : 0.0F;
    qz[i] = k > 0 ? z : 0.0F;
    // R - I, written so that small rotations keep their digits.
    const float x2 = x + x, y2 = y + y, z2 = z + z;
    const float xx = x * x2, yy = y * y2, zz = z * z2;
    const float xy = x * y2, xz = x * z2, yz = y * z2;
    const float wx = w * x2, wy = w * y2, wz = w * z2;
    const float r00 = -(yy + zz), r01 = xy - wz, r02 = xz + wy;
    const float r10 = xy + wz, r11 = -(xx + zz), r12 = yz - wx;
    const float r20 = xz - wy, r21 = yz + wx, r22 = -(xx + yy);
    const float trace = ((r00 + r11) + r22) + ((d00 + d11) + d22);
    const float inner = ((r00 * d00 + r01 * d01) + (r02 * d02 + r10 * d10)) +
                        ((r11 * d11 + r12 * d12) + (r20 * d20 + r21 * d21)) + r22 * d22;
    const float p = volume[i] * (trace + inner);
    const float a = 1 - p;
    const float b = 1 - chi;
    const float s = k * half_edge;
    const float tk = k * chi;
    t0[i] = tk * t0[i];
    t1[i] = tk * t1[i];
    t2[i] = tk * t2[i];
    g0[i] = s * ((a * r00 - p) - b * d00);
    g1[i] = s * (a * r01 - b * d01);
    g2[i] = s * (a * r02 - b * d02);
    g3[i] = s * (a * r10 - b * d10);
    g4[i] = s * ((a * r11 - p) - b * d11);
    g5[i] = s * (a * r12 - b * d12);
    g6[i] = s * (a * r20 - b * d20);
    g7[i] = s * (a * r21 - b * d21);
    g8[i] = s * ((a * r22 - p) - b * d22);
  }
}

void fit_plane(const View& view, const Plane& plane) {
  const ModelHead& head = *view.model.head;
  const std::uint32_t at = plane.slot_begin;
  fit_slots(plane.slot_end - plane.slot_begin, head.counts.slots_per_plane, head.hourglass_weight,
            head.edge_m * 0.5F, view.model.slot_k + at, view.model.slot_volume + at,
            view.state.qw + at, view.state.qx + at, view.state.qy + at, view.state.qz + at,
            view.scratch.sums);
}

// Two refined steps for the corners alone, and two more from there for all together.
STYLET_KEEP_APART void turn_fits(Fits& fits) {
  // No more lanes than the voxels need: without wide registers each is work.
  const std::uint32_t lanes = (fits.count + kWide - 1) / kWide * kWide;
  for (int pass = 0; pass < 4; ++pass) {
    const float(&m)[9][kLanes] = pass < 2 ? fits.corner : fits.joint;
    const float(&from)[4][kLanes] = pass < 3 ? fits.corner_turn : fits.joint_turn;
    float(&to)[4][kLanes] = pass < 2 ? fits.corner_turn : fits.joint_turn;
    STYLET_VECTOR
    for (std::uint32_t i = 0; i < lanes; ++i) {
      float w = from[0][i], x = from[1][i], y = from[2][i], z = from[3][i];
      rotation_step<1>(m[0][i], m[1][i], m[2][i], m[3][i], m[4][i], m[5][i], m[6][i], m[7][i],
                       m[8][i], w, x, y, z);
      to[0][i] = w;
      to[1][i] = x;
      to[2][i] = y;
      to[3][i] = z;
    }
  }
}

void couple_plane(const View& view, std::uint32_t plane) {
  const std::uint32_t end = view.scratch.plane_first[plane + 1];
  for (std::uint32_t first = view.scratch.plane_first[plane]; first < end; first += kLanes) {
    Fits fits;
    prepare_fits(view, plane, first, fits);
    turn_fits(fits);
    finish_fits(view, plane, fits);
  }
}

// What one voxel row sends to a window of its nodes at its low (`kSide` -1) or high (1) side along
// y: to the particles of the plane below and above.
struct Sent {
  Wide low, high;
};
template <int kSide>
inline Sent sent_by_row(const float* t, const float* xyz, std::ptrdiff_t stride, WideBits lanes) {
  const float *x = xyz, *y = xyz + stride, *z = xyz + 2 * stride;
  const Wide along_x = (load(t) + load(x)) + (load(t + 1) - load(x + 1));
  const Wide along_z = load(z) + load(z + 1);
  const Wide across = load(y) + load(y + 1);
  const Wide low = along_x - along_z, high = along_x + along_z;
  return {zero_unless(lanes, kSide > 0 ? low + across : low - across),
          zero_unless(lanes, kSide > 0 ? high + across : high - across)};
}

// Stage 3. Windows in order, so that the zeros which their last lanes write beyond the end of a
// line are written over by the next line. `low` and `high`: x, y, z, `axis` apart.
void spread_plane(const View& view, const Plane& plane, float* low, float* high) {
  constexpr std::uint32_t kList = kWide > 8 ? 1 : 0;
  constexpr std::uint32_t kWindow = kWide > 8 ? 16 : 8;
  const auto stride = static_cast<std::ptrdiff_t>(view.model.head->counts.slots_per_plane);
  const auto axis = static_cast<std::ptrdiff_t>(view.model.head->counts.particles_per_plane);
  const Window* windows = kList == 0 ? view.model.window8 : view.model.window16;
  const Window* const end = windows + plane.window_end[kList];
  for (const Window* w = windows + plane.window_begin[kList]; w != end; ++w) {
    for (std::uint32_t i = 0; i < kWindow; i += kWide) {
      const WideBits before = lanes_set(std::uint32_t{w->lanes[0]} >> i);
      const WideBits behind = lanes_set(std::uint32_t{w->lanes[1]} >> i);
      const float* a = view.scratch.sums + (w->slot[0] + static_cast<std::ptrdiff_t>(i));
      const float* b = view.scratch.sums + (w->slot[1] + static_cast<std::ptrdiff_t>(i));
      const float *a_xyz = a + 3 * stride, *b_xyz = b + 3 * stride;
      for (int c = 0; c < 3; ++c) {
        const Sent one = sent_by_row<1>(a + c * stride, a_xyz, stride, before);
        const Sent other = sent_by_row<-1>(b + c * stride, b_xyz, stride, behind);
        store(low + w->low + i + c * axis, one.low + other.low);
        store(high + w->high + i + c * axis, one.high + other.high);
        a_xyz += 3 * stride;
        b_xyz += 3 * stride;
      }
    }
  }
}

struct Motion {
  float dt, tau, keep;
  // Largest displacement so far: its bits, which as integers have the order of floats.
  WideBits largest = {};
};

// Moves a group of lanes along one axis.
inline void move_lanes(Wide force, Wide per_mass, Wide hold, float* u, float* v, float* e,
                       Motion& motion) {
  force = force - hold * load(e);
  Wide velocity = motion.keep * load(v) + per_mass * force;
  velocity = (velocity + kQuantum) - kQuantum;
  Wide place = load(u) + motion.dt * velocity;
  place = (place + kQuantum) - kQuantum;
  store(v, velocity);
  store(u, place);
  store(e, place + motion.tau * velocity);
  const WideBits size = __builtin_bit_cast(WideBits, place) & 0x7FFFFFFF;
  motion.largest = motion.largest > size ? motion.largest : size;
}

// Moves the particles of a plane. `below` and `here`: forces x, y, z from the clusters below and
// above, `particles_per_plane` apart.
void move_particles(const View& view, const Plane& plane, const float* below, const float* here,
                    Motion& motion_out) {
  const auto force_axis = static_cast<std::ptrdiff_t>(view.model.head->counts.particles_per_plane);
  const std::ptrdiff_t axis = view.state.uy - view.state.ux;  // as from y to z, for u, v and e
  Motion motion = motion_out;
  float* u = view.state.ux + plane.particle_begin;
  float* v = view.state.vx + plane.particle_begin;
  float* e = view.state.ex + plane.particle_begin;
  const float* per_mass = view.model.step_per_mass + plane.particle_begin;
  const float* hold = view.model.hold + plane.particle_begin;
  const std::ptrdiff_t count = plane.particle_end - plane.particle_begin;
  // The first group is padding. It is not written: the slab below may read it meanwhile.
  for (std::ptrdiff_t group = kLanes; group < count; group += kLanes) {
    for (std::ptrdiff_t i = group; i < group + std::ptrdiff_t{kLanes}; i += kWide) {
      for (std::ptrdiff_t c = 0; c < 3; ++c) {
        const Wide force = load(below + i + c * force_axis) + load(here + i + c * force_axis);
        move_lanes(force, load(per_mass + i), load(hold + i), u + i + c * axis, v + i + c * axis,
                   e + i + c * axis, motion);
      }
    }
  }
  motion_out = motion;
}

float largest_displacement(const Motion& motion) {
  std::int32_t largest = 0;
  for (std::uint32_t i = 0; i < kWide; ++i) {
    largest = largest > motion.largest[i] ? largest : motion.largest[i];
  }
  return __builtin_bit_cast(float, largest);
}

// Forces on the particles of a plane, to zero.
void clear(const View& view, const Plane& plane, float* force) {
  const auto axis = static_cast<std::ptrdiff_t>(view.model.head->counts.particles_per_plane);
  const float* const end = force + (plane.particle_end - plane.particle_begin);
  for (force += kLanes; force != end; force += kLanes) {
    for (std::uint32_t i = 0; i < kLanes; i += kWide) {
      store(force + i, Wide{});
      store(force + i + axis, Wide{});
      store(force + i + 2 * axis, Wide{});
    }
  }
}

// Sweeps the voxel planes of a slab and moves the particles they share. Particles at the slab's low
// end stay, unless they are the lattice's, and `kept` has the forces on them from above; returns
// the forces on those at its high end from below.
float* sweep_planes(const View& view, std::uint32_t begin, std::uint32_t end, float* kept,
                    Motion& motion) {
  const std::size_t part = 3 * std::size_t{view.model.head->counts.particles_per_plane};
  const Plane* const plane = view.model.plane;
  float* below = view.scratch.force;
  float* const here = below + part;
  float* above = here + part;
  clear(view, plane[begin], below);
  for (std::uint32_t z = begin; z < end; ++z) {
    const bool stay = z == begin && z > 0;
    float* const low = stay ? kept : here;
    clear(view, plane[z], low);
    clear(view, plane[z + 1], above);
    sum_plane(view, plane[z]);
    fit_plane(view, plane[z]);
    couple_plane(view, z);
    spread_plane(view, plane[z], low, above);
    if (!stay) move_particles(view, plane[z], below, low, motion);
    float* const spent = below;
    below = above;
    above = spent;
  }
  if (end == view.model.head->counts.planes) {
    clear(view, plane[end], here);
    move_particles(view, plane[end], below, here, motion);
  }
  return below;
}

Motion start_motion(const ModelHead& head) {
  return {head.substep_s, head.config.tissue_damping_s,
          1 - head.substep_s * head.config.surround_drag_per_s};
}

float* kept_by(const View& view, const Slab& slab) {
  const std::size_t part = 3 * std::size_t{view.model.head->counts.particles_per_plane};
  return slab.force + (kForceParts - 1) * part;
}

// In scratch of its own (lattice_team.h).
void sweep_slab(const Kernel& kernel, Slab& slab) {
  View view = view_of(kernel);
  view.scratch.sums = slab.sums;
  view.scratch.force = slab.force;
  Motion motion = start_motion(*view.model.head);
  slab.high = sweep_planes(view, slab.begin, slab.end, kept_by(view, slab), motion);
  slab.largest_m = largest_displacement(motion);
}

void join(Motion& motion, const Slab& slab) {
  const auto size = __builtin_bit_cast(std::int32_t, slab.largest_m);
  if (size > motion.largest[0]) motion.largest[0] = size;
}

}  // namespace

void STYLET_LATTICE_STEP(const Kernel& kernel) {
  const View view = view_of(kernel);
  const ModelHead& head = *view.model.head;
  Motion motion = start_motion(head);
  if (kernel.team == nullptr) {
    sweep_planes(view, 0, head.counts.planes, nullptr, motion);
  } else {
    sweep_together(kernel, sweep_slab);
    Team& team = team_of(kernel);
    join(motion, team.slab[0]);
    for (std::uint32_t s = 1; s < team.slab_count; ++s) {
      move_particles(view, view.model.plane[team.slab[s].begin], team.slab[s - 1].high,
                     kept_by(view, team.slab[s]), motion);
      join(motion, team.slab[s]);
    }
  }
  view.state.head->max_displacement_m = largest_displacement(motion);
}

}  // namespace stylet
