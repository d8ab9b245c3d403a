// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of DICOM's attributes. Numbers stored as text (DS, IS) are not left to DCMTK, which reads
// a text as far as it is a number: "1,5" as 1 and "0x20" as 0. Here the whole text must be a
// number, or it is refused with file, attribute and text. Only the readers of DICOM include this.
//
// Promises: finite numbers, rounded to nearest, in any locale; time follows the bytes read, which
// are at most kMostNumberBytes a value. Source: DICOM PS3.5, 6.2 (value representations), which
// allows 16 bytes a number; so many files exceed this that it is no limit here.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <string>
#include <vector>

namespace stylet::offline {

constexpr std::size_t kMostNumberBytes = 1024;  // no double has more than 767 digits that count

// NaN if the attribute is missing, empty, or has fewer values. Refuses text that is no number, a
// fraction where whole numbers are stored, and more values than DICOM's dictionary allows.
// `where`: file and place, for refusals.
double number_of(const std::string& where, DcmItem& item, const DcmTagKey& tag,
                 unsigned long place = 0);

// All numbers of an attribute that is text and lists points, three numbers each; empty if there is
// none.
std::vector<double> numbers_of_points(const std::string& where, DcmItem& item,
                                      const DcmTagKey& tag);

}  // namespace stylet::offline
