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
// Use: one ObstacleContact for each piece and body, kept between ticks, zero at the start. Within
// a tick obstacle_load may be asked for several trial shapes with the same `last`; the caller keeps
// the `next` of the shape it ends with. Neighbouring pieces that share a node may both touch there:
// two springs side by side, which fade in and out as the body passes the node. A piece that lies
// flat is held at its deepest point, which may jump from one end to the other (the force does not):
// make the pieces as short as the torque should be smooth. No memory smooths that jump, because
// a load that lags behind the tilt feeds it.
#pragma once

#include <cstdint>

#include "math.h"
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

// Whether the piece's axis may come within its radius of the body: it passes the sphere around it.
bool obstacle_near(const Obstacle& obstacle, const NeedlePiece& piece);

// ---- what it does -------------------------------------------------------------------------------

// What a contact remembers. All zero: no contact.
struct ObstacleContact {
  Vec3 normal;     // zero: no contact
  Vec3 bristle_m;  // elastic sideways give
  Vec3 a_m, b_m;   // the piece at the last call
  float place;
};

// A load on the needle: f(x) = force_n - stiffness * (x - at_m) for the needle's point that is now
// at at_m. The matrix is symmetric and has no negative eigenvalue.
//
// A contact of the last call that is lost has no force, but a stiffness: of the surface it has come
// clear of, at the place there (at_m). Kept for one tick it keeps a needle that is pressed on hard
// bodies from passing in and out of them.
struct ObstacleLoad {
  Vec3 force_n;
  Vec3 at_m;
  Mat3 stiffness_n_per_m;
  float place;    // of at_m on the piece
  float depth_m;  // positive: contact; negative: lost; 0: none
  Vec3 normal;
  float elastic_j;     // stored in the contact
  float dissipated_j;  // since the last call, by slip, turning and release
  std::uint32_t slips;
};

ObstacleLoad obstacle_load(const Obstacle& obstacle, const NeedlePiece& piece,
                           const ObstacleContact& last, ObstacleContact& next_out);

}  // namespace stylet
