# SPDX-License-Identifier: Apache-2.0
# What a build for Windows has in the place of Debian's libraries, of which there are none for it:
# the host's where they are headers alone, and libccd of the source of Debian's package.
include(stylet_debian_source)
# No path of the machine in what is built.
add_compile_options(-ffile-prefix-map=${PROJECT_BINARY_DIR}=.
  -ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)
add_compile_definitions(NOMINMAX WIN32_LEAN_AND_MEAN _WIN32_WINNT=0x0A00)

stylet_host_headers(ccd Eigen flatbuffers fmt)
stylet_add_ccd()
add_library(fmt::fmt-header-only INTERFACE IMPORTED GLOBAL)
set_target_properties(fmt::fmt-header-only PROPERTIES
  INTERFACE_COMPILE_DEFINITIONS FMT_HEADER_ONLY=1)
add_library(Eigen3::Eigen INTERFACE IMPORTED GLOBAL)
foreach(package fmt eigen3)
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}-config.cmake "")
endforeach()
