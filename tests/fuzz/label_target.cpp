// SPDX-License-Identifier: Apache-2.0
// Any bytes as a label map; the first byte chooses the format. They are refused with one line, or
// give a map with all its voxels, at a finite position, with names that can be shown.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "base/refusal.h"
#include "maps/label_map.h"
#include "maps/readers.h"
#include "target.h"

namespace stylet::test {
namespace {

namespace fs = std::filesystem;

// Files that are removed with the object.
struct Folder {
  fs::path path;
  Folder() {
    const char* from = std::getenv("TMPDIR");
    std::string name = std::string(from != nullptr ? from : "/tmp") + "/stylet-fuzz-XXXXXX";
    promise(mkdtemp(name.data()) != nullptr, "no temporary folder could be made");
    path = name;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path); }

  // The beginning of DICOM files is not part of the input.
  fs::path write(const std::string& name, std::string_view bytes, bool is_dicom) const {
    std::ofstream out(path / name, std::ios::binary);
    if (is_dicom) out << std::string(128, '\0') << "DICM";
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path / name;
  }
};

// A series of two files: the size of the first in two bytes, then the bytes of both.
fs::path write_series(const Folder& folder, std::string_view bytes) {
  if (bytes.size() < 2) return folder.path;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const std::size_t size = byte(0) + std::size_t{256} * byte(1);
  const std::string_view rest = bytes.substr(2);
  (void)folder.write("a.dcm", rest.substr(0, size), true);
  if (rest.size() > size) (void)folder.write("b.dcm", rest.substr(size), true);
  return folder.path;
}

void promise_usable(const offline::LabelMap& map) {
  promise(std::all_of(map.size.begin(), map.size.end(), [](auto n) { return n > 0; }),
          "a map without a size");
  promise(std::size_t{map.size[0]} * map.size[1] * map.size[2] == map.label.size(),
          "not as many voxels as the size says");
  promise(map.label.size() <= offline::kMostMapVoxels, "a map that is too large");
  promise(offline::finite(map.origin_m) && std::isfinite(offline::voxel_volume_m3(map)) &&
              offline::voxel_volume_m3(map) > 0,
          "a map that is nowhere");
  for (const auto& [label, name] : map.names) {
    promise(std::none_of(name.begin(), name.end(), [](unsigned char c) { return c < ' '; }),
            "a name that cannot be shown");
  }
  for (const std::string& note : map.notes) promise_one_line(note);
}

}  // namespace
}  // namespace stylet::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet;
  constexpr std::array kEndings = {".nrrd", ".nii",    ".nii.gz", ".mha",
                                   ".inr",  ".inr.gz", ".dcm",    "/"};
  if (size == 0) return 0;
  const std::size_t format = data[0] % kEndings.size();
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  // If the voxels are in a file of their own, a reader would read any file that the input names.
  std::string lower(bytes);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::erase(lower, ' ');
  if (lower.find("datafile") != std::string::npos && lower.find("local") == std::string::npos) {
    return 0;
  }
  const test::Folder folder;
  const std::string ending = kEndings[format];
  const std::filesystem::path path = ending == "/"
                                         ? test::write_series(folder, bytes)
                                         : folder.write("map" + ending, bytes, ending == ".dcm");
  try {
    test::promise_usable(offline::read_label_map(path));
  } catch (const offline::Refusal& refused) {
    test::promise_one_line(refused.what());
  }
  return 0;
}
