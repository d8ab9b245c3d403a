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
// Among faces of bodies (bend_rod) contact and friction are terms of the same energy: a face
// presses by its law where the needle is in it, and holds by a bristle up to a limit (Huber's
// function). A step reckons with the faces that it is expected to end in, and where these turn out
// to be others it is found anew; of some lengths the one with the least energy is taken, none that
// raises it. Between steps the limits of friction go to what the force allows: by the secant
// through two limits, as the force answers to the limit linearly; where it grows faster than the
// limit, friction holds itself and the contact sticks. Rejected: contact forces of the last tick
// with their stiffness (alternate at 500 Hz, and pass in and out of stiff bodies); limits that take
// over the force at once (swing where friction relieves the contact) or by half (slide through
// places where friction holds itself); the needle's inertia (delays buckling: 1.3 to 1.7 times
// Euler's load).
//
// Promises: no allocation; the number of operations depends on the numbers of rods and faces only,
// not on loads or shape; any finite input gives a finite result; only + - * / and sqrt in a written
// order. Units: SI, double. Frame: world directions, places relative to the handle's position; the
// needle leaves the handle along its -z. Source: Dehghan, Goksel, Salcudean 2006 (angular springs);
// Hencky 1920 (the chain's buckling load). PHYSICS 6.2, 6.3.
#pragma once

#include <cstdint>
#include <span>

#include "base/vec3d.h"
#include "stylet/limits.h"

namespace stylet {

constexpr double kRigidBendingNm2 = 1e6;
// Lengths of a step among faces that are tried.
constexpr std::uint32_t kRodTrials = 4;

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
  double arc_m;  // from the handle; beyond the tip straight on, as far again as the needle is long
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

// A body's face beside a place of the needle. It pushes out along its normal by the law of
// laws/touch.h, and holds what slides over it up to the limit of friction.
struct RodFace {
  double arc_m;     // from the handle
  Vec3d place_m;    // where the needle was there when the face was looked at
  Vec3d normal;     // unit, out of the body
  double depth_m;   // along it, there; negative: apart
  Vec3d bristle_m;  // sideways give there, were there no slip
  double stiffness_n_per_m, largest_force_n, friction;
  double limit_n;  // of friction; comes to `friction` times the force
  bool holds;      // it is taken to touch where the next step ends
  bool slid;       // with limit_before_n, when `friction` times the force was allowed_before_n
  double limit_before_n, allowed_before_n;
};
struct RodFaces {
  std::uint32_t count;
  RodFace face[kMaxTouches];
};

// What a face does to the needle where it is.
struct RodTouch {
  Vec3d moved_m;  // since the face was looked at
  double depth_m;
  double force_n;  // along the normal
  Vec3d bristle_m;
  bool slips;
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
  Lump load_lump[kMaxRods];  // without what faces and inertia add
  Vec3d tried[kRodTrials][kMaxRods];
  RodLoad load[kMaxRodLoads];  // within the limits
  Vec3d change[kMaxRods], change_before[kMaxRods];
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

// The same among faces of bodies, in two parts. carry_rod: what the handle alone does to the shape.
// bend_rod: from there, or from where the last call ended, kRodFaceSteps Newton steps, each of the
// tried length that lowers the energy (of joints, loads and faces) most, and none that raises it.
// No step takes a node farther than `farthest_m`. After one that found no lower energy the next are
// held by springs of `hold_n_per_m` to where the nodes are, which moves no equilibrium.
void carry_rod(const RodModel& model, const double (&handle_wxyz)[4], RodShape& shape,
               RodScratch& scratch, RodResult& result);
struct RodCare {
  double farthest_m, hold_n_per_m;
};
void bend_rod(const RodModel& model, const double (&handle_wxyz)[4], const RodLoads& loads,
              RodFaces& faces, const RodCare& care, RodShape& shape, RodScratch& scratch,
              RodResult& result);

// What a face does at the shape that was found; friction by its own limit.
RodTouch touch_face(const RodModel& model, const RodResult& result, const RodFace& face);

// What the joints of a shape store, in J.
double bending_energy(const RodModel& model, const RodShape& shape);

RodPoint rod_point(const RodModel& model, const RodResult& result, double arc_m);

}  // namespace stylet
