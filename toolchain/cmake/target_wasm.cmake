# SPDX-License-Identifier: Apache-2.0
# WebAssembly with vectors of 128 bits, by Debian's emscripten.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -include ${CMAKE_CURRENT_LIST_DIR}/wasm_bit_cast.h")
set(CMAKE_C_FLAGS_INIT "-msimd128")
set(CMAKE_ASM_FLAGS_INIT "-msimd128")
