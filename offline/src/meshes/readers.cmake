# SPDX-License-Identifier: GPL-3.0-or-later
# Sets mesh_readers: the files that read meshes, one for each reader that readers.inc names, and
# what they share; and mesh_reader_libraries: what these files are linked with, wherever they are
# built. A reader that needs one more library adds it to this list, with its find_package.
find_package(fmt REQUIRED)
set(mesh_reader_libraries fmt::fmt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_LIST_DIR}/readers.inc)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/readers.inc mesh_readers REGEX "^STYLET_MESH_READER")
list(TRANSFORM mesh_readers
  REPLACE "^.*, *([a-z_0-9]+).*$" "${CMAKE_CURRENT_LIST_DIR}/\\1.cpp")
list(REMOVE_DUPLICATES mesh_readers)
foreach(reader ${mesh_readers})
  if(NOT EXISTS ${reader})
    message(FATAL_ERROR "${CMAKE_CURRENT_LIST_DIR}/readers.inc: a line names the reader of "
      "${reader}, and there is no such file: expected STYLET_MESH_READER(ENDING, READER) and "
      "the file READER.cpp beside it")
  endif()
endforeach()
list(APPEND mesh_readers ${CMAKE_CURRENT_LIST_DIR}/bytes.cpp ${CMAKE_CURRENT_LIST_DIR}/lines.cpp
  ${CMAKE_CURRENT_LIST_DIR}/reader.cpp)
