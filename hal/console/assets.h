// SPDX-License-Identifier: Apache-2.0
// The page's files as they were when the program was built; no file is read at run time.
#pragma once

#include <string_view>

namespace stylet::console {

std::string_view page_html();
std::string_view page_script();
std::string_view page_style();

}  // namespace stylet::console
