// SPDX-License-Identifier: GPL-3.0-or-later
// Two tissues that are not joined: the first lies on the ground and slides along it.
#pragma once

#include <string>

namespace stylet::offline {

constexpr double kUsualFriction = 0.1;  // Coulomb's coefficient between wet tissues

struct Slide {
  std::string tissue, ground;
  double friction = kUsualFriction;
  std::string from;  // where the user wrote it, for messages
};

}  // namespace stylet::offline
