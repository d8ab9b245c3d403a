// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/itk.h"

#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cctype>

#include "base/file.h"
#include "maps/bzip2.h"
#include "maps/header.h"
#include "maps/names.h"
#include "maps/readers.h"
#include "maps/whole.h"

namespace stylet::offline {
namespace {

bool is_nrrd(const std::string& path) {
  const std::string name = lower(path);
  return name.ends_with(".nrrd") || name.ends_with(".nhdr");
}

itk::ImageIOBase::Pointer reader_for(const std::string& path) {
  itk::Object::GlobalWarningDisplayOff();
  itk::ImageIOBase::Pointer reader;
  if (is_nrrd(path)) {
    reader = itk::NrrdImageIO::New();
  } else {
    reader = itk::MetaImageIO::New();
  }
  reader->SetFileName(path);
  return reader;
}

struct Held {
  std::uint64_t bytes;        // of the header file, or of the data files if there are any
  std::uint64_t voxel_bytes;  // of them, behind the header and what is to be skipped
};

// A header may name a file any number of times.
void require_readable_sum(const std::string& path, const Claim& claim) {
  std::uintmax_t bytes = 0;
  for (const std::filesystem::path& file : claim.files) {
    std::error_code error;  // told by the reading
    const auto size =
        std::filesystem::file_size(std::filesystem::path(path).parent_path() / file, error);
    if (!error) bytes += size;
  }
  if (bytes <= kMaxFileBytes) return;
  refuse("{}: its {} data files have {} bytes: expected at most {}", path, claim.files.size(),
         bytes, kMaxFileBytes);
}

// Reads the data files.
Held held_bytes(const std::string& path, const Claim& claim, std::string_view bytes,
                std::string& sha256_out) {
  if (claim.files.empty()) {
    const std::string_view voxels = bytes.substr(bytes.size() - claim.behind);
    return {bytes.size(), voxels.size() - skipped_bytes(claim, voxels)};
  }
  require_readable_sum(path, claim);
  Held held = {};
  std::string sums = sha256_hex(bytes);
  for (const std::filesystem::path& file : claim.files) {
    const std::string voxels = read_file(std::filesystem::path(path).parent_path() / file);
    held.bytes += voxels.size();
    held.voxel_bytes += voxels.size() - skipped_bytes(claim, voxels);
    sums += sha256_hex(voxels);
  }
  sha256_out = sha256_hex(sums);
  return held;
}

void require_whole(const std::string& path, const Claim& claim, std::string_view bytes) {
  if (!WholeVoxels::concern(claim)) return;
  WholeVoxels voxels(path, claim);
  if (claim.files.empty()) voxels.add(path, bytes.substr(bytes.size() - claim.behind));
  for (const std::filesystem::path& file : claim.files) {
    const std::filesystem::path beside = std::filesystem::path(path).parent_path() / file;
    voxels.add(beside.string(), read_file(beside));
  }
  voxels.finish();
}

Claim checked_claim(const std::string& path, std::string_view bytes, std::string& sha256_out) {
  Claim claim = is_nrrd(path) ? nrrd_claim(path, bytes) : meta_claim(path, bytes);
  const std::array<std::size_t, 3>& axes = claim.frame.axes;
  require_map_size(path, {claim.sizes[axes[0]], claim.sizes[axes[1]], claim.sizes[axes[2]]});
  const Held held = held_bytes(path, claim, bytes, sha256_out);
  if (claim.bzip2) return claim;  // its own reader unpacks the bytes and counts them
  require_held(path, claim, held.bytes);
  require_no_more(path, claim, held.voxel_bytes);
  require_whole(path, claim, bytes);
  return claim;
}

void take_sizes(const std::string& path, const itk::ImageIOBase& reader, LabelMap& map) {
  std::array<std::size_t, 3> sizes{};
  for (unsigned axis = 0; axis < reader.GetNumberOfDimensions(); ++axis) {
    const std::size_t size = reader.GetDimensions(axis);
    if (axis >= 3 && size != 1) {
      refuse("{}: {} values along axis {}: expected a volume of three dimensions", path, size,
             axis);
    }
    if (axis < 3) sizes[axis] = size;
  }
  require_map_size(path, sizes);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    map.size[axis] = static_cast<std::uint32_t>(sizes[axis]);
  }
}

// MetaIO does not write the pixels that a truncated file lacks: there two readings differ.
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

// The last line is the innermost reason; the lines before name objects and functions of ITK.
std::string reason_of(const itk::ExceptionObject& failure) {
  std::string text = failure.GetDescription();
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
    text.pop_back();
  }
  const std::size_t line = text.rfind('\n');
  const std::string last = line == std::string::npos ? text : text.substr(line + 1);
  const std::size_t colon = last.find("): ");  // follows an object's address
  return colon == std::string::npos ? last : last.substr(colon + 3);
}

std::vector<char> read_bytes(const std::string& path, itk::ImageIOBase& reader) {
  itk::ImageIORegion all(reader.GetNumberOfDimensions());
  for (unsigned axis = 0; axis < reader.GetNumberOfDimensions(); ++axis) {
    all.SetSize(axis, reader.GetDimensions(axis));
  }
  reader.SetIORegion(all);
  std::vector<char> bytes(static_cast<std::size_t>(reader.GetImageSizeInBytes()));
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
    case Type::ULONGLONG:
      return take_labels<unsigned long long>(path, bytes, map, different);
    case Type::LONGLONG:
      return take_labels<long long>(path, bytes, map, different);
    case Type::FLOAT:
      return take_labels<float>(path, bytes, map, different);
    case Type::DOUBLE:
      return take_labels<double>(path, bytes, map, different);
    default:
      refuse("{}: voxels of type {}: expected numbers", path,
             itk::ImageIOBase::GetComponentTypeAsString(type));
  }
}

LabelMap read_by_itk(const std::string& path, std::string_view bytes) {
  LabelMap map;
  const Claim claim = checked_claim(path, bytes, map.sha256);
  map.origin_m = claim.frame.origin_m;
  map.step_m = claim.frame.step_m;
  map.notes = claim.frame.notes;
  require_frame(path, map);
  if (claim.bzip2) {
    const std::size_t layers = read_bzip2(path, bytes, claim, map);
    take_segments(path, slicer_segments(path, claim, layers), layers, map);
    return map;
  }
  try {
    const Silence silence;
    const itk::ImageIOBase::Pointer reader = reader_for(path);
    reader->ReadImageInformation();
    take_sizes(path, *reader, map);
    const std::size_t layers = reader->GetNumberOfComponents();
    const std::vector<Segment> segments = slicer_segments(path, claim, layers);
    std::set<std::uint16_t> different;
    take_any_labels(path, reader->GetComponentType(), read_bytes(path, *reader), map, different);
    take_segments(path, segments, layers, map);
  } catch (const itk::ExceptionObject& failure) {
    refuse("{}: cannot be read: {}", path, reason_of(failure));
  }
  return map;
}

}  // namespace stylet::offline
