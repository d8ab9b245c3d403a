// SPDX-License-Identifier: Apache-2.0
#include "hal/console/assets.h"

// STYLET_PAGE_DIST: the folder, from CMake, where the page's files are dependencies of this file.
#define STYLET_EMBED(name, file)                 \
  asm(".section .rodata\n"                       \
      ".global stylet_" #name                    \
      "_begin\n"                                 \
      ".global stylet_" #name                    \
      "_end\n"                                   \
      "stylet_" #name                            \
      "_begin:\n"                                \
      ".incbin \"" STYLET_PAGE_DIST "/" file     \
      "\"\n"                                     \
      "stylet_" #name                            \
      "_end:\n"                                  \
      ".byte 0\n"                                \
      ".previous\n");                            \
  extern "C" const char stylet_##name##_begin[]; \
  extern "C" const char stylet_##name##_end[]

STYLET_EMBED(page_html, "index.html");
STYLET_EMBED(page_script, "app.js");
STYLET_EMBED(page_style, "app.css");
#undef STYLET_EMBED

namespace stylet::console {

std::string_view page_html() {
  return {stylet_page_html_begin, stylet_page_html_end};
}
std::string_view page_script() {
  return {stylet_page_script_begin, stylet_page_script_end};
}
std::string_view page_style() {
  return {stylet_page_style_begin, stylet_page_style_end};
}

}  // namespace stylet::console
