# SPDX-License-Identifier: Apache-2.0
# Found instead of Debian's libccd, which is there for the host alone: its headers; no_ccd.cpp has
# the one function.
add_library(ccd INTERFACE)
target_include_directories(ccd SYSTEM INTERFACE ${headers})
