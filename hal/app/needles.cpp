// SPDX-License-Identifier: Apache-2.0
#include "hal/base/needles.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "hal/app/commands.h"

namespace stylet::app {

int list_needles(bool json) {
  nlohmann::json all = nlohmann::json::array();
  if (!json) {
    fmt::print("{:<18}{:<16}{:<11}{:<9}{:<12}{:<15}what\n", "name", "OD / ID mm", "length mm",
               "material", "EI N m^2", "tip");
  }
  for (const hal::NeedlePreset& each : hal::needle_presets()) {
    const double stiffness_nm2 =
        hal::bending_nm2(each.outer_mm, each.inner_mm, each.material.youngs_modulus_gpa);
    all.push_back({{"name", each.name},
                   {"outer_mm", each.outer_mm},
                   {"inner_mm", each.inner_mm},
                   {"length_mm", each.length_mm},
                   {"material", each.material.name},
                   {"bending_nm2", stiffness_nm2},
                   {"tip", each.tip},
                   {"half_angle_deg", each.half_angle_deg},
                   {"torn_diameters", hal::find_tip(each.tip)->torn_diameters},
                   {"what", each.what}});
    if (json) continue;
    fmt::print("{:<18}{:<16}{:<11}{:<9}{:<12.2e}{:<15}{}\n", each.name,
               fmt::format("{} / {}", each.outer_mm, each.inner_mm), each.length_mm,
               each.material.name, stiffness_nm2,
               fmt::format("{} {} deg", each.tip, each.half_angle_deg), each.what);
  }
  if (json) fmt::print("{}\n", all.dump());
  return kExitOk;
}

}  // namespace stylet::app
