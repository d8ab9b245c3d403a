// SPDX-License-Identifier: GPL-3.0-or-later
#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkMetaDataObject.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "file.h"
#include "label_itk.h"

namespace stylet::bake {
namespace {

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

LabelMap read_dicom_series(const std::string& folder) {
  try {
    const Silence silence;
    return read_slices(folder);
  } catch (const itk::ExceptionObject& failure) {
    refuse("{}: cannot be read: {}", folder, reason_of(failure));
  }
}

}  // namespace stylet::bake
