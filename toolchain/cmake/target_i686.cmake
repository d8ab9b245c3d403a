# SPDX-License-Identifier: Apache-2.0
# 32-bit x86 with SSE2. Numbers of eight bytes are aligned to eight, as on every other target, so
# that the state's layout is the same.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR i686)
set(CMAKE_CXX_COMPILER i686-linux-gnu-g++)
set(CMAKE_ASM_COMPILER i686-linux-gnu-gcc)
set(CMAKE_CXX_FLAGS_INIT "-msse2 -mfpmath=sse -malign-double")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
