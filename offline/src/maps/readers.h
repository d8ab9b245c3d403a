// SPDX-License-Identifier: GPL-3.0-or-later
// The readers behind read_label_map, one library each at most, and what they share. All refuse with
// one line and print nothing. Units: metres. Frame: the patient's (LPS), as far as the format knows
// it.
#pragma once

#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <string_view>

#include "base/refusal.h"
#include "maps/label_map.h"

namespace stylet::bake {

// Of a file with these bytes.
LabelMap read_by_itk(const std::string& path, std::string_view bytes);  // NRRD, MetaImage
LabelMap read_nifti(const std::string& path, std::string_view bytes);
LabelMap read_inr(const std::string& path, std::string_view bytes);  // by CGAL
LabelMap read_dicom_series(const std::string& folder);               // one series, by DCMTK
LabelMap read_dicom_file(const std::string& path);                   // of several frames, by DCMTK
// Whether a file begins as DICOM does, whatever its name.
bool is_dicom(const std::string& path);

// How axes are taken of which a file says nothing.
constexpr const char* kAxesTaken =
    "left and right are not known; x was taken to the left, y to the back, z to the head";

constexpr std::size_t kMostMapVoxels = std::size_t{1} << 28U;
constexpr std::size_t kMostLabels = 500;  // whole-body maps name about a hundred

// Libraries talk to the terminal; what is wrong becomes one line of ours.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int out_, err_;
};

// Sizes from a header, before memory is taken for them.
void require_map_size(const std::string& path, const std::array<std::size_t, 3>& size);
// Spacing and directions that span a volume.
void require_frame(const std::string& path, const LabelMap& map);

// Appends the labels of `bytes`; of all that were appended to the map, no more than kMostLabels
// may differ.
template <typename T>
void take_labels(const std::string& path, const std::vector<char>& bytes, LabelMap& map,
                 std::set<std::uint16_t>& different) {
  const std::size_t first = map.label.size(), count = bytes.size() / sizeof(T);
  map.label.resize(first + count);
  for (std::size_t i = 0; i < count; ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    const auto number = static_cast<double>(value);
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

}  // namespace stylet::bake
