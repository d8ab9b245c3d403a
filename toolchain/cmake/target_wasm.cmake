# SPDX-License-Identifier: Apache-2.0
# WebAssembly with vectors of 128 bits, by Debian's emscripten, and with the shorter instructions
# that every engine with vectors has.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
set(instructions "-msimd128 -mbulk-memory -mnontrapping-fptoint -msign-ext")
set(CMAKE_CXX_FLAGS_INIT "${instructions} -include ${CMAKE_CURRENT_LIST_DIR}/wasm_bit_cast.h")
set(CMAKE_C_FLAGS_INIT "${instructions}")
set(CMAKE_ASM_FLAGS_INIT "${instructions}")
