// SPDX-License-Identifier: Apache-2.0
// The elastic needle: a chain of rigid rods with angular springs, clamped to the handle, in
// quasi-static equilibrium with springs and forces along it.
//
// Model: rods of equal length l; every inner joint has the stiffness EI / l, the clamp 2 EI / l (it
// bends like half a rod). With c the cosine of the angle theta between a rod and its rest
// direction, a joint stores (2/3) k (2 / (1 + c) - c), which is k theta^2 / 2 up to theta^6 and
// grows steeply towards a fold. Bending turns a rod about an axis across the bisector of the two
// directions, so nothing twists. The shaft carries rest kinks (a pre-bent needle) and roll from the
// handle on, and they turn with it. A rigid needle has EI = kRigidBendingNm2: not a special case.
//
// Method: kRodNewtonSteps Newton steps on the energy. One step sweeps from tip to handle. It keeps
// the energy beyond a joint as a quadratic function of displacement and turn of the rod before the
// joint (6 x 6), eliminates the joint's two angles (2 x 2), and on the way back assigns the turns.
// That is O(n), and rods keep their length because only directions are unknown. Pivots are those of
// the energy's second derivative: all positive means stable, so they show buckling. Rejected:
// positions with multipliers for the lengths (indefinite, larger blocks, lengths only approximate);
// directions alone in a band (a load at the tip couples every pair of rods, so the band is full);
// a second derivative with forces predicted by the last step, not the present ones (slower).
//
// Three bounds make it robust; none moves an equilibrium, because the gradient is exact. A pivot
// that is not positive is lifted. After that, the next steps use a smaller part of compression in
// the second derivative. Steps are cut to kMaxTurnRad and shortened while they oscillate.
// Warm start: the shape of the last tick, moved along by the handle. Two steps then follow a
// 22G needle swung and rolled in tissue within 3 nm. Of 10 000 random needles under hard loads (30
// N, springs of 10 kN/m pulled by 3 cm) 99.7 % rest within 20 ticks and all within 160.
//
// Among faces of bodies (bend_rod) contact and friction are terms of the same energy. A face
// presses by its law where the needle is in it, and holds by a bristle up to a limit (Huber's
// function). A step assumes in which faces it will end; if these turn out to be others, the step is
// computed again. Of several step lengths it takes the one with the least energy, and none that
// raises the energy. Between steps the limits of friction follow the force: by the secant through
// two limits, as the force depends linearly on the limit. Where the force grows faster than the
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
// How many lengths of a step among faces are tried.
constexpr std::uint32_t kRodTrials = 4;

struct Sym3d {
  double xx, xy, xz, yy, yz, zz;
};

// Where a rod points at rest: components of its direction along the x and y of the rod before it
// (for the first rod: of the handle), in that rod's frame; the sine of the kink.
struct RodKink {
  double x, y;
};

struct RodModel {
  std::uint32_t rods;
  double rod_m;
  double joint_nm_per_rad;  // EI / l
  struct Rest {
    double x, y, along;  // direction in the frame of the rod before
    double turn;         // x / (1 + along): moves that frame's x to this rod
  } rest[kMaxRods];
};

// Force on the needle at a place x: force_n - stiffness (x - place_m). The stiffness is positive
// semidefinite. Components beyond kMaxRodForceN and kMaxRodPlaceM are clamped; a stiffness with a
// trace beyond kMaxRodStiffnessNPerM is scaled down.
struct RodLoad {
  double arc_m;  // from the handle; beyond the tip: straight on, by at most one needle length
  Vec3d place_m;
  Vec3d force_n;
  Sym3d stiffness_n_per_m;
};

struct RodLoads {
  std::uint32_t count;
  RodLoad load[kMaxRodLoads];
};

// State: what a tick leaves to the next.
struct RodShape {
  Vec3d direction[kMaxRods];    // in the handle's frame
  double compression_fraction;  // factor of compression in the second derivative, 0 to 1
  double step_length;           // step length: part of a Newton step that is taken
};

// A body's face beside a place of the needle. It pushes out along its normal by the law of
// laws/touch.h, and holds what slides over it up to the limit of friction.
struct RodFace {
  double arc_m;     // from the handle
  Vec3d place_m;    // place of the needle at arc_m at the time of the look
  Vec3d normal;     // unit, out of the body
  double depth_m;   // along the normal, at that place; negative: apart
  Vec3d bristle_m;  // sideways way there, without slip
  double stiffness_n_per_m, largest_force_n, friction;
  double limit_n;  // of friction; approaches `friction` times the force
  bool holds;      // it is expected to touch where the next step ends
  bool slid;       // with limit_before_n, and `friction` times the force was allowed_before_n
  double limit_before_n, allowed_before_n;
};
struct RodFaces {
  std::uint32_t count;
  RodFace face[kMaxTouches];
};

// Effect of a face on the needle at its present shape.
struct RodTouch {
  Vec3d moved_m;  // since the look that found the face
  double depth_m;
  double force_n;  // along the normal
  Vec3d bristle_m;
  bool slips;
};

struct RodScratch {
  struct Joint {
    Vec3d rest;                            // where the rod would point without load
    Vec3d axis_1, axis_2;                  // it turns about these axes
    double angle_1, angle_2;               // by minus these angles, and minus these times
    Vec3d move_1, turn_1, move_2, turn_2;  // displacement and turn of the rod before
  } joint[kMaxRods];
  struct Lump {  // the loads of one rod, as a quadratic function of its start and direction
    Sym3d start, mixed, along;
    Vec3d start_n, along_nm;
  } lump[kMaxRods];
  Lump load_lump[kMaxRods];  // without what faces and holding springs add
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
  double last_turn_rad;        // largest change of direction that the last step asked for
};

struct RodPoint {
  Vec3d place_m, direction;
};

// 1 <= rods <= kMaxRods; an empty `rest` is a straight needle, else it has one kink per rod.
void make_rod(std::uint32_t rods, double length_m, double bending_nm2,
              std::span<const RodKink> rest, RodModel& model_out);
// The unloaded shape.
void relax_rod(const RodModel& model, RodShape& shape_out);

// One tick. handle_wxyz is a quaternion of any length but zero.
void solve_rod(const RodModel& model, const double (&handle_wxyz)[4], const RodLoads& loads,
               RodShape& shape, RodScratch& scratch, RodResult& result_out);

// The same among faces of bodies, in two parts. carry_rod: what the handle alone does to the shape.
// bend_rod: kRodFaceSteps Newton steps from there, or from where the last call ended. Each takes
// the tried length that lowers the energy (of joints, loads and faces) most, and none that raises
// it. No step moves a node by more than `farthest_m`. After a step that found no lower energy,
// springs of `hold_n_per_m` hold the nodes where they are in the next steps: equilibria stay.
void carry_rod(const RodModel& model, const double (&handle_wxyz)[4], RodShape& shape,
               RodScratch& scratch, RodResult& result);
struct RodCare {
  double farthest_m, hold_n_per_m;
};
void bend_rod(const RodModel& model, const double (&handle_wxyz)[4], const RodLoads& loads,
              RodFaces& faces, const RodCare& care, RodShape& shape, RodScratch& scratch,
              RodResult& result);

// What a face does at the shape that was found; its friction is by its own limit.
RodTouch touch_face(const RodModel& model, const RodResult& result, const RodFace& face);

// What the joints of a shape store, in J.
double bending_energy(const RodModel& model, const RodShape& shape);

RodPoint rod_point(const RodModel& model, const RodResult& result, double arc_m);

}  // namespace stylet
