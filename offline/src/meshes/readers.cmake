# SPDX-License-Identifier: GPL-3.0-or-later
# Sets mesh_readers: the files that read meshes, one for each reader that readers.inc names, and
# what they share.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_LIST_DIR}/readers.inc)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/readers.inc mesh_readers REGEX "^STYLET_MESH_READER")
list(TRANSFORM mesh_readers
  REPLACE "^.*, *([a-z_0-9]+).*$" "${CMAKE_CURRENT_LIST_DIR}/\\1.cpp")
list(REMOVE_DUPLICATES mesh_readers)
list(APPEND mesh_readers ${CMAKE_CURRENT_LIST_DIR}/mesh_text.cpp)
