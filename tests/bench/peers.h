// SPDX-License-Identifier: Apache-2.0
// Other programs' work on the same lattice: one step of shape matching by Bullet's soft body, and
// by the textbook on Eigen. Both are attached where the organ is and have eight particles dragged
// to and fro by a hand of 2 Hz, so that clusters turn. Their parameters differ from ours; the work
// is the same: each voxel is a cluster of eight, matched once. Bullet's clusters are as Bullet
// makes them, in its tree of what may collide, which takes 5 % of its time.
#pragma once

#include <functional>

#include "stylet/organ.h"

namespace stylet::test {

// Bullet: predictMotion and solveConstraints of a btSoftBody with a cluster for each voxel.
std::function<void()> bullet_step(const Organ& organ);

// Eigen: JacobiSVD for each cluster, goals averaged, explicit motion.
std::function<void()> eigen_step(const Organ& organ);

}  // namespace stylet::test
