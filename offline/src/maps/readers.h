// SPDX-License-Identifier: GPL-3.0-or-later
// The readers behind read_label_map, and what they share. Each uses at most one library, refuses
// with one line and prints nothing. Units: metres. Frame: the patient's (LPS), as far as the format
// says.
#pragma once

#include <cmath>
#include <cstring>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "base/numbers.h"
#include "base/refusal.h"
#include "maps/label_map.h"

namespace stylet::offline {

// `bytes` are those of the whole file.
LabelMap read_by_itk(const std::string& path, std::string_view bytes);  // NRRD, MetaImage
LabelMap read_nifti(const std::string& path, std::string_view bytes);
LabelMap read_inr(const std::string& path, std::string_view bytes);  // by CGAL
LabelMap read_dicom_series(const std::string& folder);               // one series, by DCMTK
LabelMap read_dicom_file(const std::string& path);                   // of several frames, by DCMTK
// Whether the content of a file begins as DICOM does, whatever its name.
bool is_dicom(const std::string& path);

// The note on axes that were assumed because a file says nothing of them.
constexpr const char* kAxesTaken =
    "left and right are not known; x was taken to the left, y to the back, z to the head";

constexpr std::size_t kMostMapVoxels = std::size_t{1} << 28U;
constexpr std::size_t kMostLabels = 500;  // whole-body maps name about a hundred

// Silences libraries that print on the terminal; faults are told in one line of our own.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int out_, err_;
};

// Checks sizes from a header, before memory is allocated for them.
void require_map_size(const std::string& path, const std::array<std::size_t, 3>& size);
// Refuses spacing and directions that do not span a volume.
void require_frame(const std::string& path, const LabelMap& map);

// Appends the labels that are numbers in `bytes` to the map. Refuses more than kMostLabels
// different labels, counted over all calls for the map.
template <typename T>
void take_labels(const std::string& path, std::span<const char> bytes, LabelMap& map,
                 std::set<std::uint16_t>& different, std::endian order = std::endian::native) {
  const std::size_t first = map.label.size(), count = bytes.size() / sizeof(T);
  map.label.resize(first + count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = static_cast<double>(number_at<T>(bytes, i * sizeof(T), order));
    if (!(number >= 0 && number <= 65535) || number != std::floor(number)) {
      refuse("{}: voxel {}: {}: expected labels, which are whole numbers from 0 to 65535", path,
             first + i, number);
    }
    const auto label = static_cast<std::uint16_t>(number);
    if (i == 0 || map.label[first + i - 1] != label) different.insert(label);
    map.label[first + i] = label;
    if (different.size() > kMostLabels) {
      refuse("{}: more than {} different values: expected a label map, not grey values", path,
             kMostLabels);
    }
  }
}

}  // namespace stylet::offline
