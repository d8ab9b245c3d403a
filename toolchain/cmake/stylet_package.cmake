# SPDX-License-Identifier: Apache-2.0
# What other programs find once Stylet is installed: find_package(stylet), pkg-config stylet, the
# headers and the libraries.
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/stylet)

install(DIRECTORY kernel/include/stylet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${CMAKE_BINARY_DIR}/kernel/organ_generated.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stylet)
set(libraries stylet_organ stylet_kernel)
if(TARGET stylet_hal)
  install(DIRECTORY hal/hosts/c/include/stylet DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(DIRECTORY hal/base hal/device hal/guard hal/loop
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stylet-hal/hal
    FILES_MATCHING PATTERN "*.h" PATTERN "*.inc")
  list(APPEND libraries stylet_hal stylet_shared)
endif()
set_target_properties(stylet_organ PROPERTIES EXPORT_NAME organ)
set_target_properties(stylet_kernel PROPERTIES EXPORT_NAME kernel)
if(TARGET stylet_hal)
  set_target_properties(stylet_hal PROPERTIES EXPORT_NAME hal)
endif()
install(TARGETS ${libraries} EXPORT stylet)
install(EXPORT stylet NAMESPACE stylet:: DESTINATION ${package})
configure_package_config_file(toolchain/cmake/stylet-config.cmake.in
  ${PROJECT_BINARY_DIR}/stylet-config.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/stylet-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/stylet-config.cmake
  ${PROJECT_BINARY_DIR}/stylet-config-version.cmake DESTINATION ${package})

configure_file(toolchain/cmake/stylet.pc.in ${PROJECT_BINARY_DIR}/stylet.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/stylet.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
