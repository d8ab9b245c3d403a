// SPDX-License-Identifier: Apache-2.0
// Bone and other things a needle cannot enter: convex bodies, where a needle piece touches them,
// and what the touch does to it.
//
// Promises: no allocation, a bounded number of operations, finite results for every finite piece;
// the force never exceeds sqrt(1 + friction^2) times the largest force, and a contact turns by at
// most kMaxNormalTurnRad a call while the needle does not pass through the body. Touch and slip
// only take energy, as the step goes to zero. Bodies stand still. Units: SI. Frames: pieces, forces
// and states in the world; a body's vertices in its own frame. Source: the law is ours; friction is
// Coulomb's, as a return map (an elastic bristle that slips at its limit).
//
// Use: one ObstacleContact for each piece and body, kept between ticks, zero at the start. A needle
// whose shape is given asks for obstacle_load. One that bends looks for faces (find_face) at its
// shape, bends against all of them at once (rod.h), looks again, and keeps what it ends with.
// Neighbouring pieces that share a node may both touch there: two springs side by side, which fade
// in and out as the body passes the node. A piece that lies flat is held at its deepest point,
// which may jump from one end to the other (the force does not): make the pieces as short as the
// torque should be smooth. No memory smooths that jump, because a load that lags behind the tilt
// feeds it. PHYSICS 13.
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
// rotation that is no rotation, a stiffness or force that is not positive, a negative friction.
Status obstacle_prepare(const ObstacleConfig& config, Obstacle& obstacle_out);

// ---- where --------------------------------------------------------------------------------------

// A straight piece of needle from a to b; a == b makes a sphere. The radius must be positive.
struct NeedlePiece {
  Vec3 a_m, b_m;
  float radius_m;
};

struct Gap {
  float separation_m;  // negative: depth along `normal`
  Vec3 normal;         // unit, out of the body
  float place;         // of the contact on the piece's axis, 0 at a to 1 at b
};

// Exact as long as the piece's axis is outside the body; inside, a depth along which the piece can
// leave, not always the smallest.
Gap obstacle_gap(const Obstacle& obstacle, const NeedlePiece& piece);

// ---- what it does -------------------------------------------------------------------------------

// What a contact remembers. All zero: no contact.
struct ObstacleContact {
  Vec3 normal;     // zero: no contact
  Vec3 bristle_m;  // elastic sideways give
  Vec3d at_m;      // where its point of the needle was
  float place;     // of that point on the piece
  float limit_n;   // of friction
};

// What a piece may touch of a body: the plane through the body's nearest point.
struct ObstacleFace {
  Vec3d normal;         // unit, out of the body
  Vec3d at_m;           // the needle's nearest point
  float place;          // of it on the piece
  double depth_m;       // along the normal; negative: apart
  double depth_last_m;  // along the last normal, of the point that touched
  Vec3d bristle_m;      // sideways give that this takes the last one to, were there no slip
  bool goes_on;         // the contact of the last call, not a new one
};

// Finds a face that is nearer than `reach_m`. `last`: what the contact remembers; `now_m`: where
// its point of the needle is now. `seen`: where the body was last seen, the zero vector if it was
// not: the way out for a needle that is inside and has touched nothing.
bool find_face(const Obstacle& obstacle, const Segment& axis_m, double radius_m,
               const ObstacleContact& last, Vec3d now_m, Vec3d seen, double reach_m,
               ObstacleFace& out);

// What slip, turning and release take, in J, from a contact that ends `moved_m` from where the face
// was found: there it holds `bristle_m`.
double face_loss(const Obstacle& obstacle, const ObstacleFace& face, const ObstacleContact& last,
                 Vec3d moved_m, Vec3d bristle_m);

// How stiff a contact is: along its normal by the law, across it where it does not slip.
Mat3 obstacle_stiffness(const Obstacle& obstacle, Vec3 normal, double depth_m, bool slips);

// A load on the needle: f(x) = force_n - stiffness * (x - at_m) for the needle's point that is now
// at at_m. The matrix is symmetric and has no negative eigenvalue.
struct ObstacleLoad {
  Vec3 force_n;
  Vec3 at_m;
  Mat3 stiffness_n_per_m;
  float place;    // of at_m on the piece
  float depth_m;  // 0: no contact
  Vec3 normal;
  float elastic_j;     // stored in the contact
  float dissipated_j;  // since the last call, by slip, turning and release
  std::uint32_t slips;
};

ObstacleLoad obstacle_load(const Obstacle& obstacle, const NeedlePiece& piece,
                           const ObstacleContact& last, ObstacleContact& next_out);

}  // namespace stylet
