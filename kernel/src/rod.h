// SPDX-License-Identifier: Apache-2.0
// The elastic needle: a chain of rigid rods with angular springs, clamped to the handle, in
// quasi-static equilibrium with springs and forces along it.
//
// Model: rods of equal length l; every inner joint has the stiffness EI / l, the clamp 2 EI / l (it
// stands for half a rod). With c the cosine of the angle theta between a rod and its rest
// direction, a joint stores (2/3) k (2 / (1 + c) - c), which is k theta^2 / 2 up to theta^6 and
// grows steeply towards a fold. Bending turns a rod about an axis across the bisector of the
// two directions, so nothing twists: rest kinks (a pre-bent needle) and roll are carried from the
// handle along the shaft, and turn with it. Rigid is EI = kRigidBendingNm2, no case of its own.
//
// Method: kRodNewtonSteps Newton steps on the energy. One step is a sweep from tip to handle that
// keeps what lies beyond a joint as a quadratic function of the displacement and turn of the rod
// before it (6 x 6), eliminates the joint's two angles (2 x 2), and comes back handing out the
// turns: O(n), and rods keep their length because only directions are unknown. The pivots are those
// of the energy's second derivative: all positive means stable, so they show buckling. Rejected:
// positions with multipliers for the lengths (indefinite, larger blocks, lengths only approximate);
// directions alone in a band (a load at the tip couples every pair of rods, the band is full);
// forces foreseen by the last step instead of the present ones in the second derivative (slower).
//
// Robust by three bounds, none of which moves an equilibrium, for the gradient is exact: a pivot
// that is not positive is lifted; compression's share in the second derivative is lowered for the
// next steps after that, and steps are cut to kMaxTurnRad and shortened while they oscillate.
// Warm start: the shape of the last tick, carried along by the handle; two steps then follow a
// 22G needle swung and rolled in tissue within 3 nm. Of 10 000 drawn needles under hard loads (30
// N, springs of 10 kN/m pulled by 3 cm) 99.7 % rest within 20 ticks and all within 160.
//
// Promises: no allocation; the number of operations depends on the number of rods only, not on
// loads or shape; any finite input gives a finite result; only + - * / and sqrt in a written order.
// Units: SI, double. Frame: world directions, places relative to the handle's position; the needle
// leaves the handle along its -z. Source: Dehghan, Goksel, Salcudean 2006 (angular springs); Hencky
// 1920 (the chain's buckling load).
#pragma once

#include <cstdint>
#include <span>

#include "stylet/limits.h"
#include "vec3d.h"

namespace stylet {

constexpr double kRigidBendingNm2 = 1e6;

struct Sym3d {
  double xx, xy, xz, yy, yz, zz;
};

// Where a rod points at rest: components of its direction along the x and y of the rod before it
// (of the handle, for the first rod), as that rod carries them; the sine of the kink.
struct RodKink {
  double x, y;
};

struct RodModel {
  std::uint32_t rods;
  double rod_m;
  double joint_nm_per_rad;  // EI / l
  struct Rest {
    double x, y, along;  // direction in the frame of the rod before
    double turn;         // x / (1 + along): carries that frame's x over
  } rest[kMaxRods];
};

// Force on the needle at a place x: force_n - stiffness (x - place_m). The stiffness is positive
// semidefinite. Components beyond kMaxRodForceN and kMaxRodPlaceM are clamped, a stiffness with a
// trace beyond kMaxRodStiffnessNPerM is scaled down.
struct RodLoad {
  double arc_m;  // from the handle; clamped to the needle
  Vec3d place_m;
  Vec3d force_n;
  Sym3d stiffness_n_per_m;
};

struct RodLoads {
  std::uint32_t count;
  RodLoad load[kMaxRodLoads];
};

// State: all that a tick leaves to the next.
struct RodShape {
  Vec3d direction[kMaxRods];  // in the handle's frame
  double compression_share;   // of compression in the second derivative, 0 to 1
  double step_share;          // of a Newton step that is taken
};

struct RodScratch {
  struct Joint {
    Vec3d rest;                            // where the rod would point without load
    Vec3d axis_1, axis_2;                  // it turns about these
    double angle_1, angle_2;               // by minus these, and minus these times
    Vec3d move_1, turn_1, move_2, turn_2;  // displacement and turn of the rod before
  } joint[kMaxRods];
  struct Lump {  // the loads of one rod, as a quadratic function of its start and direction
    Sym3d start, mixed, along;
    Vec3d start_n, along_nm;
  } lump[kMaxRods];
  RodLoad load[kMaxRodLoads];  // within the limits
  Vec3d change[kMaxRods], change_before[kMaxRods];
  Vec3d start_m[kMaxRods + 1];  // nodes as the handle alone would have carried them
  Vec3d start_direction[kMaxRods];
};

struct RodResult {
  Vec3d node_m[kMaxRods + 1];
  Vec3d direction[kMaxRods];
  Vec3d load_n[kMaxRodLoads];  // force of each load on the needle, at this shape
  Vec3d force_n, torque_nm;    // their sum, about the handle's position: what the hand feels
  double least_pivot;          // of the tick, over EI / l; not positive: no stable shape was found
  double last_turn_rad;        // largest change of direction the last step asked for
};

struct RodPoint {
  Vec3d place_m, direction;
};

// 1 <= rods <= kMaxRods; an empty rest is a straight needle, else it has one kink a rod.
void make_rod(std::uint32_t rods, double length_m, double bending_nm2,
              std::span<const RodKink> rest, RodModel& model_out);
// The unloaded shape.
void relax_rod(const RodModel& model, RodShape& shape_out);

// One tick. handle_wxyz is a quaternion of any length but zero.
void solve_rod(const RodModel& model, const double (&handle_wxyz)[4], const RodLoads& loads,
               RodShape& shape, RodScratch& scratch, RodResult& result_out);

// After solve_rod, with the same loads: bends anew, but now every node that went farther than
// `free_m` from where the handle alone would have carried it is drawn back to that distance by
// `drag_n_per_m`. Where none did, nothing changes but the rest of the iteration.
void slow_bend(const RodModel& model, const double (&handle_wxyz)[4], double drag_n_per_m,
               double free_m, RodShape& shape, RodScratch& scratch, RodResult& result);

// Takes back a part of the bending that was just found: the shape is only `share` of the way
// from where the tick began. 1: nothing changes.
void shorten_bend(const RodModel& model, const double (&handle_wxyz)[4], double share,
                  RodShape& shape, const RodScratch& scratch, RodResult& result);

// What the joints of a shape store, in J.
double bending_energy(const RodModel& model, const RodShape& shape);

RodPoint rod_point(const RodModel& model, const RodResult& result, double arc_m);

}  // namespace stylet
