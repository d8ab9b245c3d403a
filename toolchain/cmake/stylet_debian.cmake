# SPDX-License-Identifier: Apache-2.0
# Debian packages, one for each component, by `cpack -G DEB` in the folder of a build, or by the
# target `packages`, which builds first what goes into them. The preset `package` is for them: /usr,
# and no path of the machine in what is built. toolchain/RELEASE.md has the whole procedure.
#
# The same sources give the same bytes: all times are SOURCE_DATE_EPOCH, which if it is not set is
# the day of the changelog's newest version.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME stylet)
set(CPACK_PACKAGE_VENDOR Stylet)
set(CPACK_PACKAGE_CONTACT "Stylet maintainers <maintainers@stylet.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 1)  # xz with several threads gives other bytes on another machine
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL libraries development doc)
if(TARGET stylet)
  list(APPEND CPACK_COMPONENTS_ALL program)
endif()
if(TARGET stylet-organ)
  list(APPEND CPACK_COMPONENTS_ALL organ)
endif()

if(TARGET stylet_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(TARGET stylet_organ_python)
  list(APPEND CPACK_COMPONENTS_ALL organ_python)
endif()

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# stylet_package(COMPONENT NAME SECTION SUMMARY TEXT [DEPENDS...])
function(stylet_package component name section summary text)
  string(TOUPPER ${component} upper)
  string(JOIN ", " depends ${ARGN})
  set(prefix CPACK_DEBIAN_${upper}_PACKAGE)
  set(${prefix}_NAME ${name} PARENT_SCOPE)
  set(${prefix}_SECTION ${section} PARENT_SCOPE)
  set(${prefix}_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)
endfunction()
set(about "Stylet tells the hand that holds a haptic device what a needle feels
in an organ, a thousand times a second.")
string(REGEX MATCH "^[0-9]+" soversion ${PROJECT_VERSION})
stylet_package(libraries libstylet${soversion} libs "needle insertion for haptic devices, library"
  "${about}\nThis is the library with its interface in C.")
stylet_package(development libstylet-dev libdevel
  "needle insertion for haptic devices, to build programs with"
  "${about}
This is what programs in C and C++ are built with: headers, CMake and
pkg-config files, and the kernel and the loop as static libraries."
  "libstylet${soversion} (= ${PROJECT_VERSION})" "libccd-dev")
stylet_package(program stylet science "needle insertion for haptic devices, program and scenes"
  "${about}
This is the program that runs and records scenes, with its scenes, a
phantom of a liver, benchmarks and the rules for haptic devices."
  "passwd" "python3:any")
stylet_package(python python3-stylet python "needle insertion for haptic devices, from Python"
  "${about}
This is the Python package: numpy arrays, many simulations at once,
environments for learning, recordings. The library is in it."
  "python3 (>= 3.11)" "python3 (<< 3.12)"
  "python3-numpy")
stylet_package(organ stylet-organ science "makes organs for stylet of meshes and segmentations"
  "${about}
This is the program that makes its organs of surfaces, label maps and
DICOM segmentations, with recipes. Unlike Stylet it is under the GPL."
  "python3:any")
stylet_package(organ_python python3-stylet-organ python
  "makes organs for stylet of numpy arrays"
  "${about}
This is the Python package that makes its organs of label arrays and
meshes in memory. Unlike Stylet it is under the GPL."
  "python3-stylet (= ${PROJECT_VERSION})" "python3 (>= 3.11)" "python3 (<< 3.12)"
  "python3-numpy")
stylet_package(doc stylet-doc doc "needle insertion for haptic devices, documentation"
  "${about}
These are its pages, with examples in C and Python, and what programs in
C#, for Unity, MATLAB, Octave and Godot take of it; and all of the pages
as a book, to read in a browser, with search and without a network."
  "python3:any")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "stylet-organ")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS
  "stylet-doc, python3-h5py, python3-matplotlib, gnuplot-nox")
set(CPACK_DEBIAN_ORGAN_PACKAGE_SUGGESTS "stylet, stylet-doc, snakemake, python3-pydicom")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-h5py, python3-matplotlib, stylet")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
  "stylet-organ, python3-stylet-organ, python3-distributed")
# It has the library inside: one of another version beside it would give other bits in another
# language.
set(CPACK_DEBIAN_PYTHON_PACKAGE_BREAKS
  "libstylet${soversion} (<< ${PROJECT_VERSION}), libstylet${soversion} (>> ${PROJECT_VERSION})")
set(CPACK_DEBIAN_ORGAN_PYTHON_PACKAGE_SUGGESTS "stylet-organ, stylet-doc")
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_SHLIBDEPS OFF)
# Scripts of the packages with Python in them. CPack takes a script's name from its file.
set(control ${PROJECT_BINARY_DIR}/debian)
foreach(component program organ python organ_python)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  configure_file(toolchain/debian/prerm.in ${control}/${component}/prerm @ONLY)
  set(scripts ${control}/${component}/prerm)
  if(EXISTS ${PROJECT_SOURCE_DIR}/toolchain/debian/postinst.${component})
    configure_file(toolchain/debian/postinst.${component} ${control}/${component}/postinst COPYONLY)
    list(APPEND scripts ${control}/${component}/postinst)
  endif()
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA ${scripts})
endforeach()
# Not CPack's own: it has maintainer scripts call ldconfig, for which Debian has a trigger.
file(WRITE ${control}/shlibs
  "libstylet ${soversion} libstylet${soversion} (>= ${PROJECT_VERSION})\n")
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA ${control}/shlibs ${control}/triggers)

# What Debian wants in a package that other systems do not, once all is installed.
file(STRINGS CHANGELOG.md release REGEX "^## .*[0-9]+-[0-9]+-[0-9]+$" LIMIT_COUNT 1)
string(REGEX MATCH "[0-9]+-[0-9]+-[0-9]+$" STYLET_RELEASED "${release}")
if(NOT STYLET_RELEASED)
  set(STYLET_RELEASED 2000-01-01)  # no version was released yet: some day, always the same
endif()
configure_file(toolchain/cmake/stylet_packing.cmake.in ${PROJECT_BINARY_DIR}/stylet_packing.cmake
  @ONLY)
configure_file(toolchain/cmake/stylet_packed.cmake.in ${PROJECT_BINARY_DIR}/stylet_packed.cmake
  @ONLY)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/stylet_packing.cmake)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_BINARY_DIR}/stylet_packed.cmake)
include(CPack)

# The book goes into stylet-doc where it can be built (toolchain/book.py).
find_program(MKDOCS mkdocs)
find_program(DOXYGEN doxygen)
if(TARGET book AND MKDOCS AND DOXYGEN AND EXISTS /usr/share/javascript/katex/katex.mjs)
  add_custom_target(book_of_packages COMMAND ${PROJECT_SOURCE_DIR}/toolchain/book.py
    --bin $<TARGET_FILE_DIR:stylet> --out ${PROJECT_BINARY_DIR}/book VERBATIM)
  add_dependencies(book_of_packages stylet stylet-organ)
endif()

add_custom_target(packages COMMAND ${CMAKE_CPACK_COMMAND} -G DEB
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR} USES_TERMINAL VERBATIM)
foreach(target book_of_packages stylet_shared stylet_kernel stylet_hal stylet_python
    stylet_organ_python stylet stylet-texts stylet-organ stylet-organ-texts stylet-phantom
    stylet-bench stylet-snapshot)
  if(TARGET ${target})
    add_dependencies(packages ${target})
  endif()
endforeach()
