// SPDX-License-Identifier: Apache-2.0
// What this program does when it runs beside another process of itself.
#include <algorithm>
#include <array>
#include <string_view>

#include "hal/app/commands.h"
#include "hal/console/console_process.h"
#include "hal/publish/igtl_process.h"
#include "hal/record/recorder_process.h"

namespace stylet::app {
namespace {

struct Role {
  const char* name;
  hal::SideWork work;
  bool outlives;
};
constexpr std::array kRoles = {Role{console::kConsoleRole, console::console_beside, false},
                               Role{hal::kIgtlRole, hal::igtl_beside, false},
                               Role{hal::kRecorderRole, hal::recorder_beside, true}};

}  // namespace

int beside(std::string_view role) {
  const auto* found = std::find_if(kRoles.begin(), kRoles.end(),
                                   [role](const Role& each) { return role == each.name; });
  if (found == kRoles.end()) return kExitUsage;
  return hal::side_seat(found->name, found->work, found->outlives);
}

}  // namespace stylet::app
