// SPDX-License-Identifier: GPL-3.0-or-later
#include "label_itk.h"

#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "file.h"
#include "label_readers.h"

namespace stylet::bake {
namespace {

itk::ImageIOBase::Pointer reader_for(const std::string& path) {
  itk::Object::GlobalWarningDisplayOff();
  itk::ImageIOBase::Pointer reader;
  if (path.ends_with(".nrrd") || path.ends_with(".nhdr")) {
    reader = itk::NrrdImageIO::New();
  } else if (path.ends_with(".nii") || path.ends_with(".nii.gz")) {
    reader = itk::NiftiImageIO::New();
  } else {
    reader = itk::MetaImageIO::New();
  }
  reader->SetFileName(path);
  return reader;
}

void check_dimensions(const std::string& path, const itk::ImageIOBase& reader) {
  std::array<std::size_t, 3> sizes = {1, 1, 1};
  for (unsigned axis = 0; axis < reader.GetNumberOfDimensions(); ++axis) {
    const std::size_t size = reader.GetDimensions(axis);
    if (axis >= 3 && size != 1) {
      refuse("{}: {} values along axis {}: expected a volume of three dimensions", path, size,
             axis);
    }
    if (axis < 3) sizes[axis] = size;
  }
  require_map_size(path, sizes);
  if (reader.GetNumberOfDimensions() < 3 || reader.GetNumberOfComponents() != 1) {
    refuse("{}: {} dimensions of {} values: expected 3 of 1", path, reader.GetNumberOfDimensions(),
           reader.GetNumberOfComponents());
  }
}

void read_frame(const std::string& path, const itk::ImageIOBase& reader, LabelMap& map) {
  constexpr double kMetresPerMm = 1e-3;
  const auto at = [&](unsigned axis) { return reader.GetOrigin(axis) * kMetresPerMm; };
  map.origin_m = {at(0), at(1), at(2)};
  for (unsigned axis = 0; axis < 3; ++axis) {
    map.size[axis] = static_cast<std::uint32_t>(reader.GetDimensions(axis));
    const std::vector<double> direction = reader.GetDirection(axis);
    map.step_m[axis] =
        Vec{direction[0], direction[1], direction[2]} * (reader.GetSpacing(axis) * kMetresPerMm);
  }
  require_frame(path, map);
}

// NIfTI's reader takes zeros for what a file cut short does not hold.
void check_nifti_length(const std::string& path, const itk::ImageIOBase& reader,
                        std::size_t image_bytes) {
  std::string offset;
  itk::ExposeMetaData<std::string>(reader.GetMetaDataDictionary(), "vox_offset", offset);
  const std::size_t wanted = image_bytes + static_cast<std::size_t>(std::atof(offset.c_str()));
  const gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) refuse("{}: cannot be read", path);
  std::vector<char> block(std::size_t{1} << 20U);
  std::size_t total = 0;
  int count = 0;
  while ((count = gzread(file, block.data(), static_cast<unsigned>(block.size()))) > 0) {
    total += static_cast<std::size_t>(count);
  }
  const bool whole = gzclose(file) == Z_OK && count == 0;
  if (!whole || total < wanted) {
    refuse("{}: ends or is damaged after {} bytes: expected {}", path, total, wanted);
  }
}

// MetaIO leaves what a file cut short does not hold as it was: two readings differ there.
void check_meta_length(const std::string& path, itk::ImageIOBase& reader,
                       const std::vector<char>& bytes) {
  std::vector<char> again(bytes.size(), '\x55');
  reader.Read(again.data());
  const auto differ = std::mismatch(bytes.begin(), bytes.end(), again.begin());
  if (differ.first != bytes.end()) {
    refuse("{}: the voxels end or are damaged after {} bytes: expected {}", path,
           differ.first - bytes.begin(), bytes.size());
  }
}

}  // namespace

// The last line is the deepest reason; what comes before names objects and functions of ITK.
std::string reason_of(const itk::ExceptionObject& failure) {
  std::string text = failure.GetDescription();
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
    text.pop_back();
  }
  const std::size_t line = text.rfind('\n');
  const std::string last = line == std::string::npos ? text : text.substr(line + 1);
  const std::size_t colon = last.find("): ");  // after an object's address
  return colon == std::string::npos ? last : last.substr(colon + 3);
}

std::vector<char> read_bytes(const std::string& path, itk::ImageIOBase& reader) {
  itk::ImageIORegion all(reader.GetNumberOfDimensions());
  for (unsigned axis = 0; axis < reader.GetNumberOfDimensions(); ++axis) {
    all.SetSize(axis, reader.GetDimensions(axis));
  }
  reader.SetIORegion(all);
  std::vector<char> bytes(static_cast<std::size_t>(reader.GetImageSizeInBytes()));
  if (dynamic_cast<itk::NiftiImageIO*>(&reader) != nullptr) {
    check_nifti_length(path, reader, bytes.size());
  }
  reader.Read(bytes.data());
  if (dynamic_cast<itk::MetaImageIO*>(&reader) != nullptr) check_meta_length(path, reader, bytes);
  return bytes;
}

void take_any_labels(const std::string& path, itk::ImageIOBase::IOComponentType type,
                     const std::vector<char>& bytes, LabelMap& map,
                     std::set<std::uint16_t>& different) {
  using Type = itk::ImageIOBase::IOComponentType;
  switch (type) {
    case Type::UCHAR:
      return take_labels<unsigned char>(path, bytes, map, different);
    case Type::CHAR:
      return take_labels<signed char>(path, bytes, map, different);
    case Type::USHORT:
      return take_labels<unsigned short>(path, bytes, map, different);
    case Type::SHORT:
      return take_labels<short>(path, bytes, map, different);
    case Type::UINT:
      return take_labels<unsigned int>(path, bytes, map, different);
    case Type::INT:
      return take_labels<int>(path, bytes, map, different);
    case Type::ULONG:
      return take_labels<unsigned long>(path, bytes, map, different);
    case Type::LONG:
      return take_labels<long>(path, bytes, map, different);
    case Type::FLOAT:
      return take_labels<float>(path, bytes, map, different);
    case Type::DOUBLE:
      return take_labels<double>(path, bytes, map, different);
    default:
      refuse("{}: voxels of type {}: expected numbers", path,
             itk::ImageIOBase::GetComponentTypeAsString(type));
  }
}

LabelMap read_by_itk(const std::string& path) {
  LabelMap map;
  try {
    const Silence silence;
    const itk::ImageIOBase::Pointer reader = reader_for(path);
    reader->ReadImageInformation();
    check_dimensions(path, *reader);
    read_frame(path, *reader, map);
    std::set<std::uint16_t> different;
    take_any_labels(path, reader->GetComponentType(), read_bytes(path, *reader), map, different);
  } catch (const itk::ExceptionObject& failure) {
    refuse("{}: cannot be read: {}", path, reason_of(failure));
  }
  return map;
}

}  // namespace stylet::bake
