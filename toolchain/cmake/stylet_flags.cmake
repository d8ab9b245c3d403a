# SPDX-License-Identifier: Apache-2.0
# Compiler settings shared by all targets. stylet_flags is for everything; stylet_rt_flags adds the
# rules of the real-time path (same bits everywhere, no exceptions, no RTTI).
include_guard(GLOBAL)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
# Programs side by side, so that one finds another next to itself (stylet bench -> stylet-bench).
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
# Assertions stay on in every build: they guard against programming errors, never against input.
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELWITHDEBINFO "${CMAKE_CXX_FLAGS_RELWITHDEBINFO}")

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

# Warnings are for those who work on Stylet, not for those who use it: inside another project its
# CMAKE_CXX_FLAGS and compile options reach these folders. Its warnings as errors end here; so do
# -ffast-math and its parts, which would change the bits, and what engines do without: exceptions,
# run-time types, statics that threads may make at once. What is set so is for these folders, not
# for who links the libraries.
set(warnings)
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH root)
cmake_path(GET root PARENT_PATH root)
if(CMAKE_SOURCE_DIR STREQUAL root)
  set(warnings -Wall -Wextra -Wshadow -Wconversion -Wdouble-promotion -Wvla -Wnon-virtual-dtor
    -Werror)
else()
  # Each part by itself, too: GCC's -fno-fast-math leaves one that was asked for by its own name.
  add_compile_options(-w -fno-fast-math -fno-unsafe-math-optimizations -fno-associative-math
    -fno-reciprocal-math -fno-finite-math-only -fsigned-zeros)
  foreach(flag -fexceptions -frtti -fthreadsafe-statics)
    add_compile_options($<$<COMPILE_LANGUAGE:CXX>:${flag}>)
  endforeach()
  # Linked with -ffast-math, a library makes every program that loads it flush subnormal numbers.
  add_link_options(-fno-fast-math)
endif()

add_library(stylet_flags INTERFACE)
target_compile_options(stylet_flags INTERFACE -ffp-contract=off ${warnings})
if(WIN32)
  # GCC believes that Windows aligns the stack to the registers of AVX, which it does not (GCC's bug
  # 54412): the assembler takes the moves that do not care.
  target_compile_options(stylet_flags INTERFACE -Wa,-muse-unaligned-vector-move)
endif()
# Resolves symbols at program start, not at the first call, which would be in a tick.
target_link_options(stylet_flags INTERFACE $<$<PLATFORM_ID:Linux>:LINKER:-z,now>)

add_library(stylet_rt_flags INTERFACE)
target_link_libraries(stylet_rt_flags INTERFACE stylet_flags)
target_compile_options(stylet_rt_flags INTERFACE
  -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno -fno-trapping-math
  -fvisibility=hidden)
