// SPDX-License-Identifier: GPL-3.0-or-later
#include "maps/label_map.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "base/file.h"
#include "maps/header.h"
#include "maps/names.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

struct Format {
  const char* ending;
  LabelMap (*read)(const std::string& path, std::string_view bytes);
};

LabelMap read_dicom(const std::string& path, std::string_view /*bytes*/) {
  return read_dicom_file(path);
}

constexpr Format kFormats[] = {
    {".nrrd", read_by_itk},  {".nhdr", read_by_itk}, {".nii", read_nifti},
    {".nii.gz", read_nifti}, {".mha", read_by_itk},  {".mhd", read_by_itk},
    {".inr", read_inr},      {".inr.gz", read_inr},  {".dcm", read_dicom}};

const Format* format_of(const std::string& path) {
  const std::string name = lower(path);
  const auto* found = std::find_if(std::begin(kFormats), std::end(kFormats),
                                   [&](const Format& f) { return name.ends_with(f.ending); });
  return found == std::end(kFormats) ? nullptr : found;
}

int redirected(int descriptor) {
  const int kept = ::dup(descriptor);
  const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nothing >= 0) {
    ::dup2(nothing, descriptor);
    ::close(nothing);
  }
  return kept;
}

void restore(int descriptor, int kept) {
  if (kept < 0) return;
  ::dup2(kept, descriptor);
  ::close(kept);
}

}  // namespace

// The streams of C++ keep nothing of their own back (sync_with_stdio).
Silence::Silence() {
  std::fflush(nullptr);
  out_ = redirected(STDOUT_FILENO);
  err_ = redirected(STDERR_FILENO);
}

Silence::~Silence() {
  std::fflush(nullptr);
  restore(STDOUT_FILENO, out_);
  restore(STDERR_FILENO, err_);
}

void require_map_size(const std::string& path, const std::array<std::size_t, 3>& size) {
  std::size_t voxels = 1;
  for (const std::size_t each : size) {
    if (each == 0) refuse("{}: 0 voxels along an axis: expected a volume", path);
    if (each > kMostMapVoxels || (voxels *= each) > kMostMapVoxels) {
      refuse("{}: more than {} voxels: expected a smaller image", path, kMostMapVoxels);
    }
  }
}

void require_frame(const std::string& path, const LabelMap& map) {
  const double volume = voxel_volume_m3(map);
  if (!(volume > 0) || !std::isfinite(volume) || !finite(map.origin_m)) {
    refuse("{}: spacing and directions span {} mm3 a voxel: expected more than 0", path,
           volume * 1e9);
  }
}

bool is_label_map(const std::filesystem::path& path) {
  std::error_code error;
  return format_of(path.string()) != nullptr || std::filesystem::is_directory(path, error) ||
         is_dicom(path.string());
}

LabelMap read_label_map(const std::filesystem::path& file) {
  const std::string path = file.string();
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) return read_dicom_series(path);
  constexpr Format kDicom = {"", read_dicom};  // recognised by its first bytes
  const Format* format = format_of(path);
  if (format == nullptr && is_dicom(path)) format = &kDicom;
  if (format == nullptr) {
    refuse(
        "{}: expected a label map: .nrrd .nhdr .nii .nii.gz .mha .mhd .inr .inr.gz .dcm, or a "
        "folder of DICOM slices",
        path);
  }
  const std::string bytes = read_file(file);
  LabelMap map = format->read(path, bytes);
  if (map.sha256.empty()) map.sha256 = sha256_hex(bytes);
  for (auto& [label, name] : map.names) name = printable(name);
  for (std::string& note : map.notes) note = printable(note);  // they quote the file
  return map;
}

double voxel_volume_m3(const LabelMap& map) {
  return std::fabs(dot(map.step_m[0], cross(map.step_m[1], map.step_m[2])));
}

std::vector<LabelCount> count_labels(const LabelMap& map) {
  std::vector<std::size_t> voxels(65536, 0);
  std::vector<Vec> indices(65536);  // sums of the voxels' indices
  std::size_t i = 0;
  for (std::uint32_t z = 0; z < map.size[2]; ++z) {
    for (std::uint32_t y = 0; y < map.size[1]; ++y) {
      for (std::uint32_t x = 0; x < map.size[0]; ++x, ++i) {
        const std::uint16_t label = map.label[i];
        if (label == 0) continue;
        ++voxels[label];
        indices[label] = indices[label] + Vec{1.0 * x, 1.0 * y, 1.0 * z};
      }
    }
  }
  std::vector<LabelCount> counts;
  for (std::size_t label = 1; label < voxels.size(); ++label) {
    if (voxels[label] == 0) continue;
    const Vec mean = indices[label] * (1.0 / static_cast<double>(voxels[label]));
    counts.push_back(
        {static_cast<std::uint16_t>(label), voxels[label],
         map.origin_m + map.step_m[0] * mean.x + map.step_m[1] * mean.y + map.step_m[2] * mean.z});
  }
  return counts;
}

}  // namespace stylet::offline
