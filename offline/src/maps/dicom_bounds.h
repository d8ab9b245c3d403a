// SPDX-License-Identifier: GPL-3.0-or-later
// Loads a DICOM file with DCMTK, which trusts it: it follows nested sequences by recursion, takes
// 260 bytes of memory for an item of 8, and looks for the place of an element that is out of order
// among all others, so that 800 kB of them took minutes.
//
// Promise: stack, memory and time follow the bytes of the file; what breaks that is refused with
// file and value. Source: DICOM PS3.5, 7.1 (elements ascend), 7.5 (items).
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <string>

namespace stylet::offline {

// Everything but large values, which stay on the disk. Prints nothing.
void load_dicom(const std::string& path, DcmFileFormat& format_out);

}  // namespace stylet::offline
