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
#define STYLET_LANES(count)            \
  (count) = (count) / kLanes * kLanes; \
  _Pragma("clang loop vectorize(assume_safety)")
#else
#define STYLET_LANES(count)            \
  (count) = (count) / kLanes * kLanes; \
  _Pragma("GCC ivdep")
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

struct Sums {          // twelve arrays over the slots of a plane
  float* mean[3];      // 1: mean displacement; 2: force vector T
  float* gradient[9];  // 1: displacement gradient, row-major; 2: X, Y, Z (3 each)
};

Sums sums_of(const ScratchView& scratch, const Counts& counts) {
  Sums sums = {};
  float* p = scratch.sums;
  for (float*& array : sums.mean) {
    array = p;
    p += counts.slots_per_plane;
  }
  for (float*& array : sums.gradient) {
    array = p;
    p += counts.slots_per_plane;
  }
  return sums;
}

// Stage 1 for one component of a plane: rows in order, so that what a row's last lanes write beyond
// its end is written again by the next row.
void sum_component(const View& view, const Plane& plane, const float* e, float* mean, float* gx,
                   float* gy, float* gz) {
  const float inverse_edge_4 = view.model.head->inverse_edge_per_m * 0.25F;
  for (std::uint32_t r = plane.row_begin; r < plane.row_end; ++r) {
    const Row& row = view.model.row[r];
    const std::uint32_t at = row.slot - plane.slot_begin;
    const float* n[4] = {e + row.node[0], e + row.node[1], e + row.node[2], e + row.node[3]};
    for (std::uint32_t i = 0; i < row.count + 1U; i += kWide) {
      const Wide a0 = load(n[0] + i), b0 = load(n[0] + i + 1), s0 = a0 + b0, d0 = b0 - a0;
      const Wide a1 = load(n[1] + i), b1 = load(n[1] + i + 1), s1 = a1 + b1, d1 = b1 - a1;
      const Wide a2 = load(n[2] + i), b2 = load(n[2] + i + 1), s2 = a2 + b2, d2 = b2 - a2;
      const Wide a3 = load(n[3] + i), b3 = load(n[3] + i + 1), s3 = a3 + b3, d3 = b3 - a3;
      const Wide low = s0 + s1, high = s2 + s3;
      store(mean + at + i, (low + high) * 0.125F);
      store(gx + at + i, ((d0 + d1) + (d2 + d3)) * inverse_edge_4);
      store(gy + at + i, ((s1 - s0) + (s3 - s2)) * inverse_edge_4);
      store(gz + at + i, (high - low) * inverse_edge_4);
    }
  }
}

void sum_plane(const View& view, const Plane& plane, const Sums& sums) {
  const float* e[3] = {view.state.ex, view.state.ey, view.state.ez};
  for (int c = 0; c < 3; ++c) {
    sum_component(view, plane, e[c], sums.mean[c], sums.gradient[3 * c], sums.gradient[3 * c + 1],
                  sums.gradient[3 * c + 2]);
  }
  // Slots no row reaches still pass through stage 2: give them numbers.
  const std::uint32_t slots = plane.slot_end - plane.slot_begin;
  std::uint32_t end = 1;
  if (plane.row_end > plane.row_begin) {
    const Row& last = view.model.row[plane.row_end - 1];
    end = last.slot + last.count - plane.slot_begin;
  }
  const auto clear = [&](float* array) {
    array[0] = 0;
    for (std::uint32_t i = end; i < slots; ++i) array[i] = 0;
  };
  for (float* array : sums.mean) clear(array);
  for (float* array : sums.gradient) clear(array);
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
  STYLET_LANES(lanes)
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

struct Forces {  // x, y, z over the particles of a plane
  float* axis[3];
};

// What one voxel row sends to a window of its nodes, seen from the side `side` along y: to the
// particles of the plane below and above.
struct Sent {
  Wide low, high;
};
inline Sent sent_by_row(const float* t, const float* x, const float* y, const float* z, float side,
                        WideBits lanes) {
  const Wide along_x = (load(t) + load(x)) + (load(t + 1) - load(x + 1));
  const Wide along_z = load(z) + load(z + 1);
  const Wide across = side * (load(y) + load(y + 1));
  return {zero_unless(lanes, (along_x - along_z) + across),
          zero_unless(lanes, (along_x + along_z) + across)};
}

// Stage 3. Windows in order, so that the zeros which their last lanes write beyond the end of a
// line are written over by the next line.
void spread_plane(const View& view, const Plane& plane, const Sums& sums, const Forces& low,
                  const Forces& high) {
  constexpr std::uint32_t kList = kWide > 8 ? 1 : 0;
  constexpr std::uint32_t kWindow = kWide > 8 ? 16 : 8;
  const Window* windows = kList == 0 ? view.model.window8 : view.model.window16;
  const Window* const end = windows + plane.window_end[kList];
  for (const Window* w = windows + plane.window_begin[kList]; w != end; ++w) {
    for (std::uint32_t i = 0; i < kWindow; i += kWide) {
      const WideBits before = lanes_set(std::uint32_t{w->lanes[0]} >> i);
      const WideBits behind = lanes_set(std::uint32_t{w->lanes[1]} >> i);
      const std::ptrdiff_t a = w->slot[0] + static_cast<std::ptrdiff_t>(i);
      const std::ptrdiff_t b = w->slot[1] + static_cast<std::ptrdiff_t>(i);
      for (int c = 0; c < 3; ++c) {
        const float* t = sums.mean[c];
        const float* x = sums.gradient[3 * c];
        const float* y = sums.gradient[3 * c + 1];
        const float* z = sums.gradient[3 * c + 2];
        const Sent one = sent_by_row(t + a, x + a, y + a, z + a, 1.0F, before);
        const Sent other = sent_by_row(t + b, x + b, y + b, z + b, -1.0F, behind);
        store(low.axis[c] + w->low + i, one.low + other.low);
        store(high.axis[c] + w->high + i, one.high + other.high);
      }
    }
  }
}

// Moves the particles of a plane along one axis; returns the largest displacement's bits (as
// integers, because the order of floats above zero is the order of their bits).
STYLET_KEEP_APART std::uint32_t move_axis(std::uint32_t lanes, float dt, float tau, float keep,
                                          const float* __restrict per_mass,
                                          const float* __restrict hold,
                                          const float* __restrict f_below,
                                          const float* __restrict f_here, float* __restrict u,
                                          float* __restrict v, float* __restrict e) {
  std::uint32_t largest = 0;
  STYLET_LANES(lanes)
  for (std::uint32_t i = 0; i < lanes; ++i) {
    const float force = (f_below[i] + f_here[i]) - hold[i] * e[i];
    float velocity = keep * v[i] + per_mass[i] * force;
    velocity = (velocity + kQuantum) - kQuantum;
    float place = u[i] + dt * velocity;
    place = (place + kQuantum) - kQuantum;
    v[i] = velocity;
    u[i] = place;
    e[i] = place + tau * velocity;
    const std::uint32_t size = __builtin_bit_cast(std::uint32_t, place) & 0x7FFFFFFFU;
    largest = largest > size ? largest : size;
  }
  return largest;
}

float move_particles(const View& view, const Plane& plane, const Forces& below,
                     const Forces& here) {
  const std::uint32_t at = plane.particle_begin;
  const std::uint32_t lanes = plane.particle_end - at;
  const float dt = view.model.head->substep_s;
  const float tau = view.model.head->config.tissue_damping_s;
  const float keep = 1 - dt * view.model.head->config.surround_drag_per_s;
  float* u[3] = {view.state.ux, view.state.uy, view.state.uz};
  float* v[3] = {view.state.vx, view.state.vy, view.state.vz};
  float* e[3] = {view.state.ex, view.state.ey, view.state.ez};
  std::uint32_t largest = 0;
  for (int c = 0; c < 3; ++c) {
    const std::uint32_t size =
        move_axis(lanes, dt, tau, keep, view.model.step_per_mass + at, view.model.hold + at,
                  below.axis[c], here.axis[c], u[c] + at, v[c] + at, e[c] + at);
    largest = largest > size ? largest : size;
  }
  return __builtin_bit_cast(float, largest);
}

void clear(const Forces& forces, std::uint32_t count) {
  for (float* array : forces.axis) {
    for (std::uint32_t i = 0; i < count; ++i) array[i] = 0;
  }
}

}  // namespace

void STYLET_LATTICE_STEP(const Kernel& kernel) {
  const View view = view_of(kernel);
  const Counts& counts = view.model.head->counts;
  const Sums sums = sums_of(view.scratch, counts);
  Forces buffer[3] = {};
  for (int b = 0; b < 3; ++b) {
    for (int c = 0; c < 3; ++c) {
      buffer[b].axis[c] =
          view.scratch.force + static_cast<std::size_t>(3 * b + c) * counts.particles_per_plane;
    }
  }
  // Forces on the plane of particles from the clusters below it and above it.
  Forces below = buffer[0], here = buffer[1], above = buffer[2];
  clear(below, counts.particles_per_plane);
  float largest = 0;
  for (std::uint32_t z = 0; z <= counts.planes; ++z) {
    const Plane& plane = view.model.plane[z];
    clear(here, counts.particles_per_plane);
    if (z < counts.planes) {
      clear(above, counts.particles_per_plane);
      sum_plane(view, plane, sums);
      fit_plane(view, plane);
      couple_plane(view, z);
      spread_plane(view, plane, sums, here, above);
    }
    const float moved = move_particles(view, plane, below, here);
    largest = largest > moved ? largest : moved;
    const Forces spent = below;
    below = above;
    above = spent;
  }
  view.state.head->max_displacement_m = largest;
}

}  // namespace stylet
