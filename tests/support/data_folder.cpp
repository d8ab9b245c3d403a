// SPDX-License-Identifier: Apache-2.0
// The only source that is compiled with a path in it, so that ccache finds all others in any
// checkout.
#include "data_folder.h"

#include <cstdlib>

std::filesystem::path stylet::test::data_folder() {
  const char* from_environment = std::getenv("STYLET_DATA");
  return from_environment != nullptr ? from_environment : STYLET_DATA_DEFAULT;
}
