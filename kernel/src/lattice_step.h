// SPDX-License-Identifier: Apache-2.0
// Body of the lattice sweep, included once per instruction set by lattice_<isa>.cpp with
// STYLET_LATTICE_STEP naming the function. See lattice.h for physics and promises.
//
// Per voxel plane: 1 sums and differences of the eight corners, row by row; 2 rotation and the four
// vectors each cluster sends to its corners, over all slots of the plane in full lanes; 3 each row
// adds them to its four particle rows; then the particles of the plane's low side have all their
// forces and move. A plane of clusters and two of forces stay in cache; nothing else is stored.

#include "lattice.h"
#include "rotation.h"

namespace stylet {
namespace {

// Smallest steps of velocity, displacement and rotation: keeps denormals (20 times slower, and
// rounded differently by processors that flush them) out of the state.
constexpr float kQuantum = 1.52587890625e-05F;  // 2^-16: displacements and velocities to 2e-12
constexpr float kQuantumTurn = 1.953125e-3F;    // 2^-9: quaternion parts to 2e-10

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

// Stage 1 for one component of one row. Slot i of the arrays is the empty one before the row.
void sum_corners(const float* __restrict n0, const float* __restrict n1, const float* __restrict n2,
                 const float* __restrict n3, std::uint32_t blocks, float inverse_edge_4,
                 float* __restrict mean, float* __restrict gx, float* __restrict gy,
                 float* __restrict gz) {
  for (std::uint32_t block = 0; block < blocks; ++block) {
    const std::uint32_t base = block * kLanes;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t i = base + lane;
      const float s0 = n0[i] + n0[i + 1], d0 = n0[i + 1] - n0[i];
      const float s1 = n1[i] + n1[i + 1], d1 = n1[i + 1] - n1[i];
      const float s2 = n2[i] + n2[i + 1], d2 = n2[i + 1] - n2[i];
      const float s3 = n3[i] + n3[i + 1], d3 = n3[i + 1] - n3[i];
      const float low = s0 + s1, high = s2 + s3;
      mean[i] = (low + high) * 0.125F;
      gx[i] = ((d0 + d1) + (d2 + d3)) * inverse_edge_4;
      gy[i] = ((s1 - s0) + (s3 - s2)) * inverse_edge_4;
      gz[i] = (high - low) * inverse_edge_4;
    }
  }
}

void sum_plane(const View& view, const Plane& plane, const Sums& sums) {
  const float inverse_edge_4 = view.model.head->inverse_edge_per_m * 0.25F;
  const float* e[3] = {view.state.ex, view.state.ey, view.state.ez};
  std::uint32_t end = 0;
  for (std::uint32_t r = plane.row_begin; r < plane.row_end; ++r) {
    const Row& row = view.model.row[r];
    const std::uint32_t at = row.slot - 1 - plane.slot_begin;
    const std::uint32_t blocks = (row.count + 1U + kLanes - 1) / kLanes;
    end = at + row.count + 1;
    for (int c = 0; c < 3; ++c) {
      sum_corners(e[c] + row.node[0] - 1, e[c] + row.node[1] - 1, e[c] + row.node[2] - 1,
                  e[c] + row.node[3] - 1, blocks, inverse_edge_4, sums.mean[c] + at,
                  sums.gradient[3 * c] + at, sums.gradient[3 * c + 1] + at,
                  sums.gradient[3 * c + 2] + at);
    }
  }
  // Slots no row reaches still pass through stage 2: give them numbers.
  const std::uint32_t slots = plane.slot_end - plane.slot_begin;
  for (std::uint32_t i = end; i < slots; ++i) {
    for (float* array : sums.mean) array[i] = 0;
    for (float* array : sums.gradient) array[i] = 0;
  }
}

// Stage 2, in place: mean -> T = k chi t, gradient -> columns of k (h / 2) H.
void fit_plane(const View& view, const Plane& plane, const Sums& sums) {
  const float chi = view.model.head->hourglass_weight;
  const float half_edge = view.model.head->edge_m * 0.5F;
  const float* __restrict stiffness = view.model.slot_k + plane.slot_begin;
  const float* __restrict volume = view.model.slot_volume + plane.slot_begin;
  float* __restrict qw = view.state.qw + plane.slot_begin;
  float* __restrict qx = view.state.qx + plane.slot_begin;
  float* __restrict qy = view.state.qy + plane.slot_begin;
  float* __restrict qz = view.state.qz + plane.slot_begin;
  float* __restrict t0 = sums.mean[0];
  float* __restrict t1 = sums.mean[1];
  float* __restrict t2 = sums.mean[2];
  float* __restrict g0 = sums.gradient[0];
  float* __restrict g1 = sums.gradient[1];
  float* __restrict g2 = sums.gradient[2];
  float* __restrict g3 = sums.gradient[3];
  float* __restrict g4 = sums.gradient[4];
  float* __restrict g5 = sums.gradient[5];
  float* __restrict g6 = sums.gradient[6];
  float* __restrict g7 = sums.gradient[7];
  float* __restrict g8 = sums.gradient[8];
  const std::uint32_t blocks = (plane.slot_end - plane.slot_begin) / kLanes;
  for (std::uint32_t block = 0; block < blocks; ++block) {
    const std::uint32_t base = block * kLanes;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t i = base + lane;
      const float d00 = g0[i], d01 = g1[i], d02 = g2[i];
      const float d10 = g3[i], d11 = g4[i], d12 = g5[i];
      const float d20 = g6[i], d21 = g7[i], d22 = g8[i];
      float w = qw[i], x = qx[i], y = qy[i], z = qz[i];
      rotation_step<0>(1 + d00, d01, d02, d10, 1 + d11, d12, d20, d21, 1 + d22, w, x, y, z);
      x = (x + kQuantumTurn) - kQuantumTurn;
      y = (y + kQuantumTurn) - kQuantumTurn;
      z = (z + kQuantumTurn) - kQuantumTurn;
      const float k = stiffness[i];
      const bool alive = k > 0;
      qw[i] = alive ? w : 1.0F;
      qx[i] = alive ? x : 0.0F;
      qy[i] = alive ? y : 0.0F;
      qz[i] = alive ? z : 0.0F;
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
}

// Stage 3 for one component of one row: `t`, `x`, `y`, `z` start at the empty slot before the row,
// node arrays at its first node. Lanes behind the last node add zero to somebody else's node.
void spread_row(const float* __restrict t, const float* __restrict x, const float* __restrict y,
                const float* __restrict z, std::uint32_t nodes, float* __restrict f0,
                float* __restrict f1, float* __restrict f2, float* __restrict f3) {
  const std::uint32_t blocks = (nodes + kLanes - 1) / kLanes;
  for (std::uint32_t block = 0; block < blocks; ++block) {
    const std::uint32_t base = block * kLanes;
    const std::uint32_t left = nodes - base;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t i = base + lane;
      const float along_x = (t[i] + x[i]) + (t[i + 1] - x[i + 1]);
      const float along_y = y[i] + y[i + 1];
      const float along_z = z[i] + z[i + 1];
      const bool mine = lane < left;
      const float low = along_x - along_z, high = along_x + along_z;
      const float a = mine ? low - along_y : 0.0F;
      const float b = mine ? low + along_y : 0.0F;
      const float c = mine ? high - along_y : 0.0F;
      const float d = mine ? high + along_y : 0.0F;
      f0[i] += a;
      f1[i] += b;
      f2[i] += c;
      f3[i] += d;
    }
  }
}

struct Forces {  // x, y, z over the particles of a plane
  float* axis[3];
};

void spread_plane(const View& view, const Plane& plane, const Plane& above, const Sums& sums,
                  const Forces& low, const Forces& high) {
  for (std::uint32_t r = plane.row_begin; r < plane.row_end; ++r) {
    const Row& row = view.model.row[r];
    const std::uint32_t at = row.slot - 1 - plane.slot_begin;
    for (int c = 0; c < 3; ++c) {
      spread_row(sums.mean[c] + at, sums.gradient[3 * c] + at, sums.gradient[3 * c + 1] + at,
                 sums.gradient[3 * c + 2] + at, row.count + 1U,
                 low.axis[c] + (row.node[0] - plane.particle_begin),
                 low.axis[c] + (row.node[1] - plane.particle_begin),
                 high.axis[c] + (row.node[2] - above.particle_begin),
                 high.axis[c] + (row.node[3] - above.particle_begin));
    }
  }
}

// Moves the particles of a plane; returns the largest squared displacement.
float move_particles(const View& view, const Plane& plane, const Forces& below,
                     const Forces& here) {
  const std::uint32_t begin = plane.particle_begin;
  const std::uint32_t blocks = (plane.particle_end - begin) / kLanes;
  const float dt = view.model.head->substep_s;
  const float tau = view.model.head->config.tissue_damping_s;
  const float* __restrict per_mass = view.model.step_per_mass + begin;
  const float* __restrict hold = view.model.hold + begin;
  float largest[kLanes] = {};
  float* u[3] = {view.state.ux + begin, view.state.uy + begin, view.state.uz + begin};
  float* v[3] = {view.state.vx + begin, view.state.vy + begin, view.state.vz + begin};
  float* e[3] = {view.state.ex + begin, view.state.ey + begin, view.state.ez + begin};
  for (int c = 0; c < 3; ++c) {
    float* __restrict uc = u[c];
    float* __restrict vc = v[c];
    float* __restrict ec = e[c];
    const float* __restrict f_below = below.axis[c];
    const float* __restrict f_here = here.axis[c];
    for (std::uint32_t block = 0; block < blocks; ++block) {
      const std::uint32_t base = block * kLanes;
      for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t i = base + lane;
        const float force = (f_below[i] + f_here[i]) - hold[i] * ec[i];
        float velocity = vc[i] + per_mass[i] * force;
        velocity = (velocity + kQuantum) - kQuantum;
        float place = uc[i] + dt * velocity;
        place = (place + kQuantum) - kQuantum;
        vc[i] = velocity;
        uc[i] = place;
        ec[i] = place + tau * velocity;
        const float size = place < 0 ? -place : place;
        largest[lane] = largest[lane] > size ? largest[lane] : size;
      }
    }
  }
  float all = 0;
  for (const float one : largest) all = all > one ? all : one;
  return all;
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
      fit_plane(view, plane, sums);
      couple_plane(view, z);
      spread_plane(view, plane, view.model.plane[z + 1], sums, here, above);
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
