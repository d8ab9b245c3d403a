// SPDX-License-Identifier: GPL-3.0-or-later
// Slide: two tissues that are not joined. The first lies on the second, its ground, and slides on
// it.
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
