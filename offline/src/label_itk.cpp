// SPDX-License-Identifier: GPL-3.0-or-later
#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
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

// ---- DICOM series -------------------------------------------------------------------------------

struct Slice {
  itk::GDCMImageIO::Pointer reader;
  std::string path;
  double along_m = 0;  // the slices' normal
};

// A text of the header, as "0.7\\0.7"; the number at a place in it; not a number where there is
// none.
double told(const itk::ImageIOBase& reader, const char* tag, std::size_t place) {
  std::string text;
  itk::ExposeMetaData<std::string>(reader.GetMetaDataDictionary(), tag, text);
  const char* at = text.c_str();
  for (; place > 0; --place) {
    at = std::strchr(at, '\\');
    if (at == nullptr) return std::nan("");
    ++at;
  }
  char* end = nullptr;
  const double value = std::strtod(at, &end);
  return end == at ? std::nan("") : value;
}

// What ITK would take for granted, or leave out without a word.
void check_slice(const Slice& slice) {
  const itk::ImageIOBase& reader = *slice.reader;
  if (reader.GetNumberOfComponents() != 1) {
    refuse("{}: {} values a pixel: expected labels, which are one", slice.path,
           reader.GetNumberOfComponents());
  }
  if (reader.GetNumberOfDimensions() > 2 && reader.GetDimensions(2) > 1) {
    refuse("{}: {} frames in a file: expected a slice a file, or one segmentation object (.dcm)",
           slice.path, reader.GetDimensions(2));
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double mm = told(reader, "0028|0030", axis);
    if (!(mm > 0)) {
      refuse("{}: PixelSpacing {}: expected two sizes in mm, both above 0", slice.path, mm);
    }
  }
  require_whole_dicom(slice.path);
}

std::vector<Slice> find_slices(const std::string& folder) {
  const auto names = itk::GDCMSeriesFileNames::New();
  names->SetUseSeriesDetails(false);
  names->SetDirectory(folder);
  const std::vector<std::string> series = names->GetSeriesUIDs();
  if (series.size() != 1) {
    refuse("{}: {} DICOM series: expected one", folder, series.size());
  }
  std::vector<Slice> slices;
  for (const std::string& path : names->GetFileNames(series.front())) {
    slices.push_back({itk::GDCMImageIO::New(), path, 0});
    slices.back().reader->SetFileName(path);
    slices.back().reader->ReadImageInformation();
    check_slice(slices.back());
  }
  return slices;
}

Vec vector_of(const std::vector<double>& v) {
  return {v[0], v[1], v[2]};
}

Vec origin_of(const itk::ImageIOBase& reader) {
  return Vec{reader.GetOrigin(0), reader.GetOrigin(1), reader.GetOrigin(2)} * 1e-3;
}

// Puts the slices in order along their normal; the distance between neighbours, which has to be the
// same for all.
double order_slices(std::vector<Slice>& slices) {
  constexpr double kSameM = 1e-5;
  const itk::ImageIOBase& first = *slices.front().reader;
  const Vec normal = cross(vector_of(first.GetDirection(0)), vector_of(first.GetDirection(1)));
  for (Slice& slice : slices) slice.along_m = dot(normal, origin_of(*slice.reader));
  std::sort(slices.begin(), slices.end(),
            [](const Slice& a, const Slice& b) { return a.along_m < b.along_m; });
  if (slices.size() == 1) {
    const double thick_mm = told(first, "0018|0050", 0);
    if (!(thick_mm > 0)) {
      refuse("{}: a single slice without SliceThickness: expected it, or more slices",
             slices.front().path);
    }
    return thick_mm * 1e-3;
  }
  const double step_m = slices[1].along_m - slices[0].along_m;
  for (std::size_t i = 1; i < slices.size(); ++i) {
    const double gap_m = slices[i].along_m - slices[i - 1].along_m;
    if (!(gap_m > kSameM) || std::fabs(gap_m - step_m) > kSameM + 1e-3 * step_m) {
      refuse(
          "{}: {:.6g} mm from the slice before, where others are {:.6g} mm apart: expected no "
          "slice missing or twice",
          slices[i].path, gap_m * 1e3, step_m * 1e3);
    }
    const Vec way = origin_of(*slices[i].reader) - origin_of(*slices[0].reader);
    const Vec aside = way - normal * dot(normal, way);
    if (length(aside) > kSameM + 1e-3 * step_m) {
      refuse(
          "{}: lies {:.4g} mm to the side of the first slice (a tilted gantry, or a slice that was "
          "moved): expected all straight above each other; resample the series first",
          slices[i].path, length(aside) * 1e3);
    }
    for (unsigned axis = 0; axis < 2; ++axis) {
      const double here_mm = slices[i].reader->GetSpacing(axis),
                   first_mm = slices[0].reader->GetSpacing(axis);
      if (std::fabs(here_mm - first_mm) > 1e-4 * first_mm) {
        refuse("{}: pixels of {:.6g} mm: expected {:.6g} mm, as in {}", slices[i].path, here_mm,
               first_mm, slices[0].path);
      }
      if (slices[i].reader->GetDimensions(axis) != slices[0].reader->GetDimensions(axis) ||
          slices[i].reader->GetDirection(axis) != slices[0].reader->GetDirection(axis)) {
        refuse("{}: differs in size or direction: expected that of {}", slices[i].path,
               slices[0].path);
      }
    }
  }
  return step_m;
}

LabelMap read_slices(const std::string& folder) {
  std::vector<Slice> slices = find_slices(folder);
  const double step_m = order_slices(slices);
  const itk::ImageIOBase& first = *slices.front().reader;
  LabelMap map;
  require_map_size(folder, {first.GetDimensions(0), first.GetDimensions(1), slices.size()});
  for (unsigned axis = 0; axis < 2; ++axis) {
    map.size[axis] = static_cast<std::uint32_t>(first.GetDimensions(axis));
    map.step_m[axis] = vector_of(first.GetDirection(axis)) * (first.GetSpacing(axis) * 1e-3);
  }
  map.size[2] = static_cast<std::uint32_t>(slices.size());
  map.origin_m = origin_of(first);
  map.step_m[2] =
      cross(vector_of(first.GetDirection(0)), vector_of(first.GetDirection(1))) * step_m;
  require_frame(folder, map);
  std::set<std::uint16_t> different;
  std::string sums;
  for (const Slice& slice : slices) {
    sums += sha256_hex(read_file(slice.path));
    take_any_labels(slice.path, slice.reader->GetComponentType(),
                    read_bytes(slice.path, *slice.reader), map, different);
  }
  map.sha256 = sha256_hex(sums);
  return map;
}

}  // namespace

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

LabelMap read_dicom_series(const std::string& folder) {
  try {
    const Silence silence;
    return read_slices(folder);
  } catch (const itk::ExceptionObject& failure) {
    refuse("{}: cannot be read: {}", folder, reason_of(failure));
  }
}

}  // namespace stylet::bake
