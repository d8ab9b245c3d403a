// SPDX-License-Identifier: Apache-2.0
// Where the shared data is: STYLET_DATA in the environment, otherwise beside the repository.
#pragma once

#include <filesystem>

namespace stylet::test {

std::filesystem::path data_folder();

}  // namespace stylet::test
