// SPDX-License-Identifier: Apache-2.0
// Bone and other things that a needle cannot enter: convex bodies, where a piece of needle touches
// them, and what the touch does to it.
//
// Promises: no allocation, a bounded number of operations, finite results for every finite piece.
// The force never exceeds sqrt(1 + friction^2) times the largest force. A contact turns by at most
// kMaxNormalTurnRadPerS while the needle does not pass through the body. Touch and slip only take
// energy, as the step goes to zero. Bodies stand still. Units: SI. Frames: pieces, forces
// and states in the world; a body's vertices in its own frame. Source: the law is ours; friction is
// Coulomb's, as a return map (an elastic bristle that slips at its limit).
//
// Use: one ObstacleContact for each pair of piece and body, kept between ticks, zero at the start.
// For a needle of given shape call obstacle_load. A needle that bends looks for faces (find_face)
// at its shape, bends against all of them at once (rod.h), looks again, and keeps what it found.
// Neighbouring pieces that share a node may both touch there: two springs side by side, which fade
// in and out as the body passes the node. A piece that lies flat is held at its deepest point. That
// point may jump from one end to the other (the force does not): the shorter the pieces, the
// smoother the torque. No memory smooths the jump, because a load that lags behind the tilt
// increases it. PHYSICS 13.
#pragma once

#include <cstdint>

#include "base/math.h"
#include "needle/convex.h"
#include "stylet/kernel.h"
#include "stylet/limits.h"
#include "stylet/status.h"

namespace stylet {

// ---- bodies -------------------------------------------------------------------------------------

// A body ready for queries. Only the functions below look inside.
struct Obstacle {
  ObstacleConfig config;
  Mat3 rotation;
  Vec3 centre_m;  // mean of the vertices, in the body's frame
  float bound_m;  // no point of the body is farther from the centre
};

// kConfigValueOutOfRange: a number that is not finite, no vertex or more than kMaxHullVertices, a
// quaternion that is no rotation, a stiffness or force that is not positive, a negative friction.
// The first such field is told, with `index` as the obstacle's number.
Status check_obstacle(const ObstacleConfig& config, std::uint32_t index,
                      ConfigRefusal* refusal_out);
// Of a configuration that check_obstacle accepts; else its status.
Status obstacle_prepare(const ObstacleConfig& config, Obstacle& obstacle_out);

// ---- where --------------------------------------------------------------------------------------

// A straight piece of needle from a to b; a == b makes a sphere. The radius must be positive.
struct NeedlePiece {
  Vec3 a_m, b_m;
  float radius_m;
};

// ---- what it does -------------------------------------------------------------------------------

// What a contact remembers. All zero: no contact.
struct ObstacleContact {
  Vec3 normal;     // zero: no contact
  Vec3 bristle_m;  // elastic sideways way
  Vec3d at_m;      // where its point of the needle was
  float place;     // parameter of that point on the piece
  float limit_n;   // limit of friction
};

// What a piece may touch of a body: the plane through the body's nearest point.
struct ObstacleFace {
  Vec3d normal;         // unit, out of the body
  Vec3d at_m;           // the needle's nearest point
  float place;          // parameter of that point on the piece
  double depth_m;       // along the normal; negative: apart
  double depth_last_m;  // along the last normal, of the point that touched
  Vec3d bristle_m;      // what the last bristle becomes by this sideways way, without slip
  bool goes_on;         // continues the contact of the last call
};

// The side from which a piece that touched nothing has entered a body, and on which it leaves it
// again.
struct CameFrom {
  Vec3d seen;        // the direction out of the body when it was last seen; zero: it was not
  Segment before_m;  // else: where the piece's axis was before
};

// How near a face must be, and how far a normal may turn since the last call.
struct FaceLimits {
  double reach_m, turn_rad;
};

// Finds a face within these limits. `last`: what the contact remembers. `now_m`: where its point of
// the needle is now.
bool find_face(const Obstacle& obstacle, const Segment& axis_m, double radius_m,
               const ObstacleContact& last, Vec3d now_m, const CameFrom& from,
               const FaceLimits& limits, ObstacleFace& out);

// Energy in J that slip, turning and release take from a contact. The contact ends `moved_m` from
// where the face was found, with the bristle `bristle_m`.
double face_loss(const Obstacle& obstacle, const ObstacleFace& face, const ObstacleContact& last,
                 Vec3d moved_m, Vec3d bristle_m);

// Stiffness of a contact: along its normal by the law, across it where it does not slip.
Mat3 obstacle_stiffness(const Obstacle& obstacle, Vec3 normal, double depth_m, bool slips);

// A load on the needle: f(x) = force_n - stiffness * (x - at_m) for the needle's point that is now
// at at_m. The matrix is symmetric and has no negative eigenvalue.
struct ObstacleLoad {
  Vec3 force_n;
  Vec3 at_m;
  Mat3 stiffness_n_per_m;
  float place;    // parameter of at_m on the piece
  float depth_m;  // 0: no contact
  Vec3 normal;
  float elastic_j;     // stored in the contact
  float dissipated_j;  // since the last call, by slip, turning and release
  std::uint32_t slips;
};

// `before_m`: the piece's axis in the last call. `turn_rad`: how far a normal may turn since then.
ObstacleLoad obstacle_load(const Obstacle& obstacle, const NeedlePiece& piece,
                           const Segment& before_m, double turn_rad, const ObstacleContact& last,
                           ObstacleContact& next_out);

}  // namespace stylet
