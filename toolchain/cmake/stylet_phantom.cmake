# SPDX-License-Identifier: Apache-2.0
# The liver phantom, made with the programs and installed with them: the scenes in it, and the first
# lines of Python, need no stylet-organ then. The other scenes' organs are made on first use
# (hal/app/organ_command.h).
#
# The command is that of the scenes' files, word for word: a scene with another makes its own organ.
set(STYLET_PHANTOM_COMMAND "phantom liver --voxel-mm 5")
set(place ${CMAKE_INSTALL_DATADIR}/stylet/organs)  # also below the folder of the build
set(STYLET_PHANTOM ${place}/liver-phantom.organ)

# Builds with sanitizers are slow, and those that count lines count what tests reach.
if(NOT TARGET stylet-organ OR NOT STYLET_WITH_INSTALL OR CMAKE_CROSSCOMPILING
    OR CMAKE_CXX_FLAGS MATCHES "-fsanitize|-fprofile")
  return()
endif()
set(organ ${PROJECT_BINARY_DIR}/${STYLET_PHANTOM})
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/${place})
separate_arguments(words UNIX_COMMAND ${STYLET_PHANTOM_COMMAND})
add_custom_command(OUTPUT ${organ}
  COMMAND stylet-organ ${words} -o ${organ} > ${PROJECT_BINARY_DIR}/liver-phantom.txt
  DEPENDS stylet-organ VERBATIM)
add_custom_target(stylet-phantom ALL DEPENDS ${organ})
install(FILES ${organ} DESTINATION ${place} COMPONENT program)
