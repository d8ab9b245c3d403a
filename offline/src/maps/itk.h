// SPDX-License-Identifier: GPL-3.0-or-later
// What the readers that use ITK share. Only they include this, as it brings ITK's headers.
#pragma once

#include <itkImageIOBase.h>

#include "maps/readers.h"

namespace stylet::offline {

// Why ITK failed, without the names of its objects and functions.
std::string reason_of(const itk::ExceptionObject& failure);
// Reads all pixels of an image whose header has been read. Refuses files that end early.
std::vector<char> read_bytes(const std::string& path, itk::ImageIOBase& reader);
// take_labels for whatever type the pixels have.
void take_any_labels(const std::string& path, itk::ImageIOBase::IOComponentType type,
                     const std::vector<char>& bytes, LabelMap& map,
                     std::set<std::uint16_t>& different);

}  // namespace stylet::offline
