# SPDX-License-Identifier: Apache-2.0
# What a module for Python is built with. Afterwards pybind11_FOUND says whether it is there.
if(EXISTS /usr/bin/python3 AND NOT Python_EXECUTABLE)
  set(Python_EXECUTABLE /usr/bin/python3)  # Debian's own, for which setup.sh installs packages
endif()
find_package(Python COMPONENTS Interpreter Development.Module QUIET)
if(Python_FOUND)
  find_package(pybind11 2.10 CONFIG QUIET)  # takes that Python
endif()
if(NOT pybind11_FOUND)
  message(STATUS "pybind11: not found, no Python package (Debian: pybind11-dev python3-dev)")
endif()

# stylet_python_package(NAME TARGET FOLDER COMPONENT): in the build tree the package NAME lies in
# python/ as it will be installed, with the Python files of FOLDER as links, and the module TARGET.
function(stylet_python_package name target folder component)
  set(package ${PROJECT_BINARY_DIR}/python/${name})
  set(installed lib/python3/dist-packages/${name})
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME _${name} LIBRARY_OUTPUT_DIRECTORY ${package})
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.py ${folder}/*.pyi ${folder}/py.typed)
  file(MAKE_DIRECTORY ${package})
  foreach(source ${sources})
    cmake_path(GET source FILENAME file)
    file(CREATE_LINK ${source} ${package}/${file} SYMBOLIC)
  endforeach()
  install(FILES ${sources} DESTINATION ${installed} COMPONENT ${component})
  install(TARGETS ${target} LIBRARY DESTINATION ${installed} COMPONENT ${component})
endfunction()
