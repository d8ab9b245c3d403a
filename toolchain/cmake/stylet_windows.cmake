# SPDX-License-Identifier: Apache-2.0
# What a build for Windows has in the place of Debian's libraries, of which there are none for it:
# the host's where they are headers alone, and libccd of the source of Debian's package, which
# debian_source.sh fetches once, or whoever has it already names in STYLET_LIBCCD_SOURCE.
#
# find_package finds the targets made here (CMAKE_FIND_PACKAGE_REDIRECTS_DIR).
set(STYLET_LIBCCD_SOURCE "" CACHE PATH "The unpacked source of Debian's package libccd")
# No path of the machine in what is built.
add_compile_options(-ffile-prefix-map=${PROJECT_BINARY_DIR}=.
  -ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)
add_compile_definitions(NOMINMAX WIN32_LEAN_AND_MEAN _WIN32_WINNT=0x0A00)

# The host's other headers must stay out of reach.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(library ccd Eigen flatbuffers fmt)
  find_path(STYLET_HEADERS_OF_${library} ${library} PATHS /usr/include /usr/include/eigen3
    NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  file(CREATE_LINK ${STYLET_HEADERS_OF_${library}}/${library} ${headers}/${library} SYMBOLIC)
endforeach()
include_directories(SYSTEM ${headers})

if(NOT STYLET_LIBCCD_SOURCE)
  set(STYLET_LIBCCD_SOURCE ${PROJECT_BINARY_DIR}/sources/libccd)
endif()
if(NOT EXISTS ${STYLET_LIBCCD_SOURCE}/src/mpr.c)
  execute_process(COMMAND ${PROJECT_SOURCE_DIR}/toolchain/debian_source.sh libccd
    ${STYLET_LIBCCD_SOURCE} RESULT_VARIABLE failed ERROR_VARIABLE why OUTPUT_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "${why}\n${output}\nlibccd's source is needed for Windows: "
      "expected a network, or its unpacked source in STYLET_LIBCCD_SOURCE")
  endif()
endif()
# With Debian's own settings (ccd/config.h of the host), so that its numbers are the same.
set(ccd_sources ccd.c mpr.c polytope.c support.c vec3.c)
list(TRANSFORM ccd_sources PREPEND ${STYLET_LIBCCD_SOURCE}/src/)
add_library(ccd STATIC EXCLUDE_FROM_ALL ${ccd_sources})
target_compile_definitions(ccd PUBLIC CCD_STATIC_DEFINE)
target_compile_options(ccd PRIVATE -ffp-contract=off -w)

add_library(fmt::fmt-header-only INTERFACE IMPORTED GLOBAL)
set_target_properties(fmt::fmt-header-only PROPERTIES
  INTERFACE_COMPILE_DEFINITIONS FMT_HEADER_ONLY=1)
add_library(Eigen3::Eigen INTERFACE IMPORTED GLOBAL)
foreach(package ccd fmt eigen3)
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}-config.cmake "")
endforeach()
