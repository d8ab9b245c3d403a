# SPDX-License-Identifier: Apache-2.0
# For systems of which Debian has no libraries: the sources of its packages, and libccd of them.

# Sets STYLET_<PACKAGE>_SOURCE, in capitals, to the unpacked source of a package of Debian's, which
# debian_source.sh fetches once into the build, or whoever has it already names in that variable.
# `file` is one that it holds.
function(stylet_debian_source package file)
  string(TOUPPER STYLET_${package}_SOURCE variable)
  set(${variable} "" CACHE PATH "The unpacked source of Debian's package ${package}")
  if(NOT ${variable})
    set(${variable} ${PROJECT_BINARY_DIR}/sources/${package})
  endif()
  if(NOT EXISTS ${${variable}}/${file})
    execute_process(COMMAND ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../debian_source.sh ${package}
      ${${variable}} RESULT_VARIABLE failed ERROR_VARIABLE why OUTPUT_VARIABLE output)
    if(failed)
      message(FATAL_ERROR "${why}\n${output}\nThe source of ${package} is needed: "
        "expected a network, or its unpacked source in ${variable}")
    endif()
  endif()
  set(${variable} ${${variable}} PARENT_SCOPE)
endfunction()

# Headers of the host's libraries that have nothing else; its other headers stay out of reach.
function(stylet_host_headers)
  set(headers ${PROJECT_BINARY_DIR}/headers)
  file(MAKE_DIRECTORY ${headers})
  foreach(library IN LISTS ARGN)
    find_path(STYLET_HEADERS_OF_${library} ${library} PATHS /usr/include /usr/include/eigen3
      NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
    file(CREATE_LINK ${STYLET_HEADERS_OF_${library}}/${library} ${headers}/${library} SYMBOLIC)
  endforeach()
  include_directories(SYSTEM ${headers})
endfunction()

# libccd with Debian's own settings (ccd/config.h of the host), so that its numbers are the same.
# find_package finds it (CMAKE_FIND_PACKAGE_REDIRECTS_DIR).
function(stylet_add_ccd)
  stylet_debian_source(libccd src/mpr.c)
  set(sources ccd.c mpr.c polytope.c support.c vec3.c)
  list(TRANSFORM sources PREPEND ${STYLET_LIBCCD_SOURCE}/src/)
  add_library(ccd STATIC EXCLUDE_FROM_ALL ${sources})
  target_compile_definitions(ccd PUBLIC CCD_STATIC_DEFINE)
  target_compile_options(ccd PRIVATE -ffp-contract=off -w)
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/ccd-config.cmake "")
  set(STYLET_LIBCCD_SOURCE ${STYLET_LIBCCD_SOURCE} PARENT_SCOPE)
endfunction()
