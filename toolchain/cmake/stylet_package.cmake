# SPDX-License-Identifier: Apache-2.0
# What is installed, in components (cmake --install BUILD --component NAME): `libraries` is
# libstylet.so alone, `development` what other programs are built with (find_package(stylet),
# pkg-config, headers, static libraries); both need only the targets stylet_shared and stylet_hal
# built. `program` and `organ` are the two programs with what they read, `doc` what is read by
# people. The folder may be moved after the installation.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/stylet)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)

if(WIN32)
  # The library alone, with the terms of what is linked into it. mingw-w64's own are beside it on
  # Debian.
  install(DIRECTORY hal/hosts/c/include/stylet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(TARGETS stylet_shared RUNTIME COMPONENT libraries)
  install(FILES ${PROJECT_BINARY_DIR}/lib/stylet.def DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(FILES LICENSE DESTINATION licences COMPONENT libraries)
  install(FILES ${STYLET_LIBCCD_SOURCE}/BSD-LICENSE DESTINATION licences RENAME libccd.txt
    COMPONENT libraries)
  install(FILES /usr/share/doc/mingw-w64-x86-64-dev/copyright DESTINATION licences
    RENAME mingw-w64.txt COMPONENT libraries)
  return()
endif()
install(DIRECTORY kernel/include/stylet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# Made here, so that who uses it needs no flatc.
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/kernel/organ_generated.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stylet)
set_target_properties(stylet_organ PROPERTIES EXPORT_NAME organ)
set_target_properties(stylet_kernel PROPERTIES EXPORT_NAME kernel)
install(TARGETS stylet_organ stylet_kernel EXPORT stylet)
if(TARGET stylet_hal)
  install(DIRECTORY hal/hosts/c/include/stylet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(DIRECTORY hal/base hal/device hal/guard hal/loop
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stylet-hal/hal
    FILES_MATCHING PATTERN "*.h" PATTERN "*.inc" PATTERN example_driver.h EXCLUDE)
  set_target_properties(stylet_hal PROPERTIES EXPORT_NAME hal)
  install(TARGETS stylet_hal EXPORT stylet)
  install(TARGETS stylet_shared EXPORT stylet
    LIBRARY COMPONENT libraries NAMELINK_COMPONENT development)
endif()
install(EXPORT stylet NAMESPACE stylet:: DESTINATION ${package})
configure_package_config_file(toolchain/cmake/stylet-config.cmake.in
  ${PROJECT_BINARY_DIR}/stylet-config.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stylet-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stylet-config.cmake
  ${PROJECT_BINARY_DIR}/stylet-config-version.cmake DESTINATION ${package})

# The prefix from where stylet.pc lies.
set(pc_folder /${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH prefix_of_pc ${pc_folder} /)
string(REGEX REPLACE "/$" "" prefix_of_pc "${prefix_of_pc}")
configure_file(toolchain/cmake/stylet.pc.in ${PROJECT_BINARY_DIR}/stylet.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/stylet.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# What these pages and those of hal and offline link to; the test hosts.installed follows each link.
foreach(page README.md CHANGELOG.md CONTRIBUTING.md GLOSSARY.md LICENSE kernel/README.md
    kernel/PHYSICS.md kernel/PROMISES.md kernel/constants.md kernel/own_law.md tests/README.md
    tests/bench/README.md tests/golden/README.md
    tests/rt/README.md tests/simulator/README.md tests/e2e/halving.md
    tests/fidelity/calculix/README.md tests/fidelity/calculix/convergence.svg
    toolchain/README.md toolchain/RELEASE.md)
  cmake_path(GET page PARENT_PATH folder)
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DATADIR}/stylet/${folder} COMPONENT doc)
endforeach()
# If the target `packages` built it before.
install(DIRECTORY ${PROJECT_BINARY_DIR}/book DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/stylet
  COMPONENT doc OPTIONAL)
# With which the headers for Godot are made.
set(tools ${CMAKE_INSTALL_DATADIR}/stylet/toolchain)
install(PROGRAMS toolchain/debian_source.sh DESTINATION ${tools} COMPONENT doc)
install(FILES toolchain/common.sh DESTINATION ${tools} COMPONENT doc)
install(DIRECTORY kernel/decisions DESTINATION ${CMAKE_INSTALL_DATADIR}/stylet/kernel COMPONENT doc)
install(DIRECTORY hal/decisions DESTINATION ${CMAKE_INSTALL_DATADIR}/stylet/hal COMPONENT doc)
