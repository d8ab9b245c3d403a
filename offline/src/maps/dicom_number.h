// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of DICOM's attributes. Those that are text (DS, IS) are not left to DCMTK, which takes as
// much of a text as is a number: 1,5 for 1 and 0x20 for 0. Here the whole text of a value is a
// number, or it is refused with file, attribute and text. Only the readers of DICOM include this.
//
// Promises: finite numbers, rounded to nearest, in any locale; time follows the bytes read, which
// are at most kMostNumberBytes a value. Source: DICOM PS3.5, 6.2 (value representations). Its 16
// bytes a number are exceeded so often that they are no limit here.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <string>
#include <vector>

namespace stylet::offline {

constexpr std::size_t kMostNumberBytes = 1024;  // no double has more than 767 digits that count

// NaN if the item has no such attribute, an empty one, or fewer values. Refuses what is no number,
// a fraction where the attribute has whole numbers, and more values than it has by the dictionary.
// `where`: file and place, for refusals.
double number_of(const std::string& where, DcmItem& item, const DcmTagKey& tag,
                 unsigned long place = 0);

// All numbers of an attribute that is text and lists points, three numbers each; empty if there is
// none.
std::vector<double> numbers_of_points(const std::string& where, DcmItem& item,
                                      const DcmTagKey& tag);

}  // namespace stylet::offline
