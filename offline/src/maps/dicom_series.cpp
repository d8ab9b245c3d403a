// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "base/file.h"
#include "maps/dicom_file.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

namespace fs = std::filesystem;

struct Slice {
  std::size_t file = 0, frame = 0;
  FramePlace place;
};

// The DICOM files of a folder.
struct Folder {
  std::vector<DicomFile> images;
  std::vector<DicomFile> structures;     // RTSTRUCT
  std::vector<DicomFile> segmentations;  // SEG
  std::vector<std::string> notes;
};

// The second UID is Label Map Segmentation Storage, for which DCMTK 3.6.7 has no name.
bool is_segmentation(const std::string& kind) {
  return kind == UID_SegmentationStorage || kind == "1.2.840.10008.5.1.4.1.1.66.7";
}

bool is_named_dicom(const fs::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".dcm" || ending == ".DCM" || ending == ".ima" || ending == ".IMA";
}

Folder open_folder(const std::string& folder) {
  Folder found;
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    if (!is_dicom(path.string()) && !is_named_dicom(path)) {
      found.notes.push_back(fmt::format("{}: not a DICOM file: left out", path.string()));
      continue;
    }
    DicomFile file = open_dicom(path.string());
    const std::string kind = text_of(file, DCM_SOPClassUID);
    const std::string image_type = text_of(file, DCM_ImageType);
    if (kind == UID_RTStructureSetStorage) {
      found.structures.push_back(std::move(file));
    } else if (is_segmentation(kind)) {
      found.segmentations.push_back(std::move(file));
    } else if (image_type.find("LOCALIZER") != std::string::npos) {
      found.notes.push_back(fmt::format("{}: a localizer: left out", path.string()));
    } else if (file.columns > 0 && file.rows > 0) {
      found.images.push_back(std::move(file));
    } else if (items_of(*file.format->getDataset(), DCM_DirectoryRecordSequence).empty()) {
      refuse("{}: {} x {} pixels: expected a slice", path.string(), file.columns, file.rows);
    }
  }
  return found;
}

void require_one_series(const std::string& folder, const std::vector<DicomFile>& images) {
  std::map<std::string, std::size_t> series;
  for (const DicomFile& file : images) ++series[text_of(file, DCM_SeriesInstanceUID)];
  if (series.size() != 1) {
    std::string list;
    for (const auto& [uid, files] : series) {
      list += fmt::format("{}{}: {} files", list.empty() ? " (" : ", ", uid, files);
    }
    refuse("{}: {} DICOM series{}: expected one", folder, series.size(),
           list.empty() ? list : list + ")");
  }
  const std::string frame = text_of(images.front(), DCM_FrameOfReferenceUID);
  for (const DicomFile& file : images) {
    const std::string other = text_of(file, DCM_FrameOfReferenceUID);
    if (other == frame) continue;
    refuse("{}: FrameOfReferenceUID {}: expected {}, as in {}", file.path, other, frame,
           images.front().path);
  }
}

std::vector<Slice> slices_of(const std::vector<DicomFile>& files) {
  std::vector<Slice> slices;
  for (std::size_t i = 0; i < files.size(); ++i) {
    require_map_size(files[i].path, {files[i].columns, files[i].rows, files[i].frames});
    for (std::size_t frame = 0; frame < files[i].frames; ++frame) {
      slices.push_back({i, frame, place_of(files[i], frame)});
      require_same_grid(slices.front().place, slices.back().place);
    }
  }
  return slices;
}

LabelMap map_of(const std::string& path, const std::vector<DicomFile>& files) {
  const std::vector<Slice> slices = slices_of(files);
  std::vector<Plane> planes;
  for (const Slice& slice : slices) planes.push_back(slice.place.plane);
  Stack stack = whole_stack(path, slices.front().place.grid, planes);
  std::set<std::uint16_t> different;
  std::string sums;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    if (slices[i].frame == 0) {
      sums += sha256_hex(read_file(files[slices[i].file].path));
      load_pixels(files[slices[i].file]);
    }
    const DicomFile& file = files[slices[i].file];
    put_plane(stack, i, label_pixels(file, slices[i].frame, different));
    // Frees the file after its last frame.
    if (slices[i].frame + 1 == file.frames) file.format->clear();
  }
  stack.map.sha256 = sha256_hex(sums);
  return std::move(stack.map);
}

// The series only says where planes and pixels are; its pixel values are not used.
LabelMap map_of_contours(const std::string& folder, const Folder& found) {
  if (found.structures.size() != 1) {
    refuse("{}: {} structure sets: expected one", folder, found.structures.size());
  }
  const DicomFile& file = found.structures.front();
  std::vector<FramePlace> series;
  if (!found.images.empty()) {
    require_one_series(folder, found.images);
    for (const Slice& slice : slices_of(found.images)) series.push_back(slice.place);
    const std::string frame = text_of(found.images.front(), DCM_FrameOfReferenceUID);
    for (DcmItem* const roi : items_of(*file.format->getDataset(), DCM_StructureSetROISequence)) {
      const std::string own = text_of(*roi, DCM_ReferencedFrameOfReferenceUID);
      if (own == frame || own.empty() || frame.empty()) continue;
      refuse("{}: ReferencedFrameOfReferenceUID {}: expected {}, as in {}", file.path, own, frame,
             found.images.front().path);
    }
  }
  LabelMap map = read_dicom_contours(file, series);
  map.sha256 = sha256_hex(read_file(file.path));
  return map;
}

// A segmentation has the positions of its planes; which of several files is meant is not guessed.
LabelMap map_of_segmentation(const std::string& folder, const Folder& found) {
  const DicomFile& file = found.segmentations.front();
  if (found.segmentations.size() + found.images.size() + found.structures.size() > 1) {
    refuse(
        "{}: {} segmentations (SEG), {} images and {} structure sets: expected one segmentation "
        "alone; give its file instead of the folder, as {}",
        folder, found.segmentations.size(), found.images.size(), found.structures.size(),
        file.path);
  }
  LabelMap map = read_dicom_seg(file);
  map.sha256 = sha256_hex(read_file(file.path));
  return map;
}

}  // namespace

bool is_dicom(const std::string& path) {
  constexpr std::size_t kPreamble = 128;
  std::array<char, kPreamble + 4> head{};
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;  // to open a pipe waits for its writer
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  return file && std::string_view(head.data() + kPreamble, 4) == "DICM";
}

LabelMap read_dicom_series(const std::string& folder) {
  const Folder found = open_folder(folder);
  const auto read = [&] {
    if (!found.segmentations.empty()) return map_of_segmentation(folder, found);
    if (!found.structures.empty()) return map_of_contours(folder, found);
    require_one_series(folder, found.images);
    return map_of(folder, found.images);
  };
  LabelMap map = read();
  map.notes.insert(map.notes.end(), found.notes.begin(), found.notes.end());
  return map;
}

LabelMap read_dicom_file(const std::string& path) {
  const DicomFile file = open_dicom(path);
  const std::string kind = text_of(file, DCM_SOPClassUID);
  if (is_segmentation(kind)) return read_dicom_seg(file);
  if (kind == UID_RTStructureSetStorage) return read_dicom_contours(file, {});
  if (file.frames < 2) {
    refuse(
        "{}: expected a DICOM segmentation, a structure set or an image of several frames; for a "
        "series of slices give its folder",
        path);
  }
  return map_of(path, {file});
}

}  // namespace stylet::offline
