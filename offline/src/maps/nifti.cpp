// SPDX-License-Identifier: GPL-3.0-or-later
// NIfTI-1 and NIfTI-2, also compressed, without a library: libraries decide silently what the user
// should be told (which of two contradicting frames holds, what becomes of NaN), and crash on some
// headers. Source: nifti1.h and nifti2.h of nifti.nimh.nih.gov.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>

#include "base/matrix.h"
#include "base/numbers.h"
#include "maps/header.h"
#include "maps/names.h"
#include "maps/readers.h"

namespace stylet::offline {
namespace {

// The fields of either header that a label map needs.
struct Header {
  std::array<std::int64_t, 8> dim{};
  std::array<double, 8> pixdim{};
  std::int64_t datatype = 0, qform_code = 0, sform_code = 0, units = 0;
  double voxels_at = 0, slope = 0, inter = 0;
  std::array<double, 3> quatern{}, qoffset{};
  std::array<std::array<double, 4>, 3> srow{};
  std::size_t bytes = 0;
  std::endian order = std::endian::native;
};

// Offsets of the fields, where the two versions differ in more than the type.
struct Layout {
  std::size_t bytes, dim, datatype, pixdim, voxels_at, slope, codes, quatern, srow, units;
};
constexpr Layout kNifti1 = {348, 40, 70, 76, 108, 112, 252, 256, 280, 123};
constexpr Layout kNifti2 = {540, 16, 12, 104, 168, 176, 344, 352, 400, 500};

template <typename Whole, typename Code, typename Real>
Header read_fields(std::string_view bytes, const Layout& at, std::endian order) {
  Header h;
  h.bytes = at.bytes;
  h.order = order;
  const auto whole = [&](std::size_t place) {
    return static_cast<std::int64_t>(number_at<Whole>(bytes, place, order));
  };
  const auto code = [&](std::size_t place) {
    return static_cast<std::int64_t>(number_at<Code>(bytes, place, order));
  };
  const auto real = [&](std::size_t place) {
    return static_cast<double>(number_at<Real>(bytes, place, order));
  };
  for (std::size_t i = 0; i < 8; ++i) {
    h.dim[i] = whole(at.dim + i * sizeof(Whole));
    h.pixdim[i] = real(at.pixdim + i * sizeof(Real));
  }
  h.datatype = number_at<std::int16_t>(bytes, at.datatype, order);
  h.qform_code = code(at.codes);
  h.sform_code = code(at.codes + sizeof(Code));
  h.slope = real(at.slope);
  h.inter = real(at.slope + sizeof(Real));
  for (std::size_t i = 0; i < 3; ++i) {
    h.quatern[i] = real(at.quatern + i * sizeof(Real));
    h.qoffset[i] = real(at.quatern + (3 + i) * sizeof(Real));
    for (std::size_t j = 0; j < 4; ++j) h.srow[i][j] = real(at.srow + (4 * i + j) * sizeof(Real));
  }
  return h;
}

Header read_header(const std::string& path, std::string_view bytes) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    if (bytes.size() < kNifti1.bytes) break;
    const auto size = number_at<std::int32_t>(bytes, 0, order);
    if (size == 348 && bytes.substr(344, 4) == std::string_view("n+1\0", 4)) {
      Header h = read_fields<std::int16_t, std::int16_t, float>(bytes, kNifti1, order);
      h.voxels_at = static_cast<double>(number_at<float>(bytes, kNifti1.voxels_at, order));
      h.units = static_cast<unsigned char>(bytes[kNifti1.units]);
      return h;
    }
    if (size == 540 && bytes.size() >= kNifti2.bytes &&
        bytes.substr(4, 8) == std::string_view("n+2\0\r\n\032\n", 8)) {
      Header h = read_fields<std::int64_t, std::int32_t, double>(bytes, kNifti2, order);
      h.voxels_at = static_cast<double>(number_at<std::int64_t>(bytes, kNifti2.voxels_at, order));
      h.units = number_at<std::int32_t>(bytes, kNifti2.units, order);
      return h;
    }
  }
  refuse("{}: expected the header of a NIfTI-1 or NIfTI-2 file that holds its voxels (n+1, n+2)",
         path);
}

// Calls visit with a value of the file's data type.
template <typename Visit>
auto with_type(const std::string& path, std::int64_t datatype, Visit visit) {
  switch (datatype) {
    case 2:
      return visit(std::uint8_t{});
    case 4:
      return visit(std::int16_t{});
    case 8:
      return visit(std::int32_t{});
    case 16:
      return visit(float{});
    case 64:
      return visit(double{});
    case 256:
      return visit(std::int8_t{});
    case 512:
      return visit(std::uint16_t{});
    case 768:
      return visit(std::uint32_t{});
    case 1024:
      return visit(std::int64_t{});
    case 1280:
      return visit(std::uint64_t{});
    default:
      refuse("{}: datatype {}: expected whole or real numbers of 1 to 8 bytes", path, datatype);
  }
}

// Limit for extensions between header and voxels. The largest in use, the description of a CIFTI
// matrix, has a few megabytes; a packed file of some kilobytes could claim as many.
constexpr double kMostExtensionBytes = 1 << 26;

std::array<std::uint32_t, 3> read_sizes(const std::string& path, const Header& h) {
  const std::int64_t axes = h.dim[0];
  if (axes < 3 || axes > 7) {
    refuse("{}: {} dimensions: expected 3, with one value a voxel", path, axes);
  }
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes); ++axis) {
    const std::int64_t size = h.dim[axis + 1];
    if (size < 1 || (axis >= 3 && size != 1)) {
      refuse("{}: {} values along axis {}: expected a volume of three dimensions", path, size,
             axis);
    }
  }
  const auto size_of = [&](std::size_t axis) { return static_cast<std::size_t>(h.dim[axis + 1]); };
  require_map_size(path, {size_of(0), size_of(1), size_of(2)});
  const auto first = static_cast<double>(h.bytes + 4);
  if (!(h.voxels_at >= first && h.voxels_at <= first + kMostExtensionBytes)) {
    refuse("{}: vox_offset {}: expected from {} to {}", path, h.voxels_at, first,
           first + kMostExtensionBytes);
  }
  if (h.voxels_at != std::floor(h.voxels_at)) {
    refuse("{}: vox_offset {}: expected a whole number", path, h.voxels_at);
  }
  return {static_cast<std::uint32_t>(size_of(0)), static_cast<std::uint32_t>(size_of(1)),
          static_cast<std::uint32_t>(size_of(2))};
}

// From the beginning of the file to the end of its voxels.
std::size_t bytes_of(const std::string& path, const Header& h,
                     const std::array<std::uint32_t, 3>& size) {
  const std::size_t each = with_type(path, h.datatype, [](auto number) { return sizeof number; });
  return std::size_t{size[0]} * size[1] * size[2] * each + static_cast<std::size_t>(h.voxels_at);
}

// ---- where it lies ------------------------------------------------------------------------------

// Steps and origin in the header's unit and frame: x to the right, y to the front.
struct Frame {
  std::array<Vec, 3> step;
  Vec origin;
};

Frame frame_of_qform(const std::string& path, const Header& h) {
  constexpr double kRounding = 1e-5;  // of single precision
  const auto [b, c, d] = h.quatern;
  const double rest = 1 - (b * b + c * c + d * d);
  if (!(rest >= -kRounding) || !finite({h.qoffset[0], h.qoffset[1], h.qoffset[2]})) {
    refuse("{}: qform: quatern {} {} {}, qoffset {} {} {}: expected a rotation and a place", path,
           b, c, d, h.qoffset[0], h.qoffset[1], h.qoffset[2]);
  }
  const double a = std::sqrt(std::max(0.0, rest));
  const double flip = h.pixdim[0] < 0 ? -1 : 1;
  const Eigen::Matrix3d turn = Eigen::Quaterniond(a, b, c, d).toRotationMatrix();
  Frame frame;
  frame.step = {from_eigen(turn.col(0)) * h.pixdim[1], from_eigen(turn.col(1)) * h.pixdim[2],
                from_eigen(turn.col(2)) * (flip * h.pixdim[3])};
  frame.origin = {h.qoffset[0], h.qoffset[1], h.qoffset[2]};
  return frame;
}

Frame frame_of_sform(const std::string& path, const Header& h) {
  Frame frame;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    frame.step[axis] = {h.srow[0][axis], h.srow[1][axis], h.srow[2][axis]};
  }
  frame.origin = {h.srow[0][3], h.srow[1][3], h.srow[2][3]};
  constexpr double kSquare = 1e-3;  // half a millimetre over half a metre
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec u = frame.step[axis], v = frame.step[(axis + 1) % 3];
    if (!finite(u) || !finite(frame.origin) || !(length(u) > 0) || !(length(v) > 0)) {
      std::string rows;
      for (const auto& row : h.srow) {
        rows += fmt::format(" [{} {} {} {}]", row[0], row[1], row[2], row[3]);
      }
      refuse("{}: sform: srow{}: expected numbers that span a volume", path, rows);
    }
    const double cosine = dot(u, v) / (length(u) * length(v));
    if (std::fabs(cosine) > kSquare) {
      refuse(
          "{}: sform: axes {} and {} are {:.4g} degrees apart: expected 90; resample the image "
          "first",
          path, axis, (axis + 1) % 3, std::acos(cosine) * 180 / M_PI);
    }
  }
  return frame;
}

void check_spacing(const std::string& path, const Header& h, const Frame& frame) {
  constexpr double kSame = 1e-3;  // half a voxel in 500
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double step = length(frame.step[axis]), told = h.pixdim[axis + 1];
    if (std::fabs(step - told) <= kSame * told) continue;
    refuse(
        "{}: sform has voxels of {:.6g} along axis {}, pixdim says {:.6g}: expected the same; "
        "write the file again with the one that is right",
        path, step, axis, told);
  }
}

// If the header declares two frames valid, both must put the volume's corners at the same places.
void check_same_place(const std::string& path, const Header& h, const Frame& s, const Frame& q) {
  constexpr double kOff = 0.1;  // of the smallest voxel edge
  const double edge = std::min({length(q.step[0]), length(q.step[1]), length(q.step[2])});
  double most = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec apart = s.origin - q.origin;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1U) == 0) continue;
      apart = apart + (s.step[axis] - q.step[axis]) * static_cast<double>(h.dim[axis + 1] - 1);
    }
    most = std::max(most, length(apart));
  }
  if (most <= kOff * edge) return;
  refuse(
      "{}: sform (code {}) and qform (code {}) put the same voxel up to {:.6g} apart: expected one "
      "place; set the code of the one that is wrong to 0",
      path, h.sform_code, h.qform_code, most);
}

double metres_per_unit(const std::string& path, std::int64_t units) {
  constexpr std::int64_t kOfSpace = 7;
  switch (units & kOfSpace) {
    case 0:  // not said: millimetres, as is usual
    case 2:
      return 1e-3;
    case 1:
      return 1;
    case 3:
      return 1e-6;
    default:
      refuse("{}: xyzt_units {}: expected metres (1), millimetres (2) or micrometres (3)", path,
             units);
  }
}

void read_frame(const std::string& path, const Header& h, LabelMap& map) {
  for (std::size_t axis = 1; axis <= 3; ++axis) {
    if (h.pixdim[axis] > 0 && std::isfinite(h.pixdim[axis])) continue;
    refuse("{}: pixdim[{}] {}: expected a length above 0", path, axis, h.pixdim[axis]);
  }
  Frame frame;
  if (h.sform_code > 0) {
    frame = frame_of_sform(path, h);
    check_spacing(path, h, frame);
    if (h.qform_code > 0) check_same_place(path, h, frame, frame_of_qform(path, h));
  } else if (h.qform_code > 0) {
    frame = frame_of_qform(path, h);
  } else {
    frame.step = {Vec{-h.pixdim[1], 0, 0}, Vec{0, -h.pixdim[2], 0}, Vec{0, 0, h.pixdim[3]}};
    map.notes.push_back(fmt::format("{}: neither sform nor qform: {}", path, kAxesTaken));
  }
  const double unit_m = metres_per_unit(path, h.units);
  const auto to_lps_m = [unit_m](Vec v) { return Vec{-v.x, -v.y, v.z} * unit_m; };
  for (std::size_t axis = 0; axis < 3; ++axis) map.step_m[axis] = to_lps_m(frame.step[axis]);
  map.origin_m = to_lps_m(frame.origin);
  require_frame(path, map);
}

// ---- voxels and names ---------------------------------------------------------------------------

// Takes the voxels as the header scales them; rounding errors of the scaling are removed.
template <typename T>
void take(const std::string& path, const Header& h, std::string_view voxels, LabelMap& map) {
  const std::size_t count = std::size_t{map.size[0]} * map.size[1] * map.size[2];
  constexpr double kRounding = 0x1p-22;  // four times that of slope and intercept as floats
  const bool scaled = h.slope != 0 && (h.slope != 1 || h.inter != 0);
  if (!std::isfinite(h.slope) || !std::isfinite(h.inter)) {
    refuse("{}: scl_slope {}, scl_inter {}: expected numbers", path, h.slope, h.inter);
  }
  std::set<std::uint16_t> different;
  if (!scaled) {
    return take_labels<T>(path, voxels.substr(0, count * sizeof(T)), map, different, h.order);
  }
  std::vector<char> bytes(count * sizeof(double));
  for (std::size_t i = 0; i < count; ++i) {
    const T raw = number_at<T>(voxels, i * sizeof(T), h.order);
    const double part = static_cast<double>(raw) * h.slope;
    double value = part + h.inter;
    const double error = kRounding * (std::fabs(part) + std::fabs(h.inter));
    if (std::fabs(value - std::round(value)) <= error) value = std::round(value);
    if (value != std::floor(value)) {
      refuse(
          "{}: voxel {}: {} with scl_slope {} and scl_inter {} is {}: expected labels, which are "
          "whole numbers",
          path, i, static_cast<double>(raw), h.slope, h.inter, value);
    }
    std::memcpy(bytes.data() + i * sizeof(double), &value, sizeof(double));
  }
  take_labels<double>(path, bytes, map, different);
}

// Reads the extensions between header and voxels. Names of labels are in an extension with Caret's
// XML, which TotalSegmentator also writes.
void read_names(const std::string& path, const Header& h, std::string_view bytes, LabelMap& map) {
  constexpr std::size_t kHead = 8;  // size and code of an extension
  const auto end = static_cast<std::size_t>(h.voxels_at);
  if (bytes[h.bytes] == 0) return;
  if (end < h.bytes + 4 + kHead) {
    refuse("{}: extensions, but vox_offset {} leaves no room: expected {} or more", path, end,
           h.bytes + 4 + kHead);
  }
  for (std::size_t at = h.bytes + 4; at + kHead <= end;) {
    const auto size = number_at<std::int32_t>(bytes, at, h.order);
    if (size < static_cast<std::int32_t>(kHead) || static_cast<std::size_t>(size) > end - at) {
      refuse("{}: extension of {} bytes at byte {}: expected from {} to {}", path, size, at, kHead,
             end - at);
    }
    const std::string_view text = bytes.substr(at + kHead, static_cast<std::size_t>(size) - kHead);
    if (text.find("<LabelTable") != std::string_view::npos) {
      read_label_table(path, text.substr(0, text.find('\0')), map);
    }
    at += static_cast<std::size_t>(size);
  }
}

// How many bytes, which nobody reads, a packed file may have after its voxels.
constexpr std::size_t kMostTail = std::size_t{1} << 20U;

}  // namespace

LabelMap read_nifti(const std::string& path, std::string_view stored) {
  const Header header = read_header(path, inflated(path, stored, kNifti2.bytes));
  LabelMap map;
  map.size = read_sizes(path, header);
  const std::size_t wanted = bytes_of(path, header, map.size), most = wanted + kMostTail;
  const std::string bytes = inflated(path, stored, most);
  if (bytes.size() < wanted) {
    refuse("{}: ends after {} bytes: expected {}", path, bytes.size(), wanted);
  }
  if (is_gzip(stored) && bytes.size() == most) {
    refuse("{}: more than {} bytes follow the voxels: expected none", path, kMostTail);
  }
  read_frame(path, header, map);
  if (bytes.size() > wanted) {
    map.notes.push_back(
        fmt::format("{}: {} bytes behind its voxels: not read", path, bytes.size() - wanted));
  }
  read_names(path, header, bytes, map);
  const auto voxels = std::string_view(bytes).substr(static_cast<std::size_t>(header.voxels_at));
  with_type(path, header.datatype,
            [&](auto number) { take<decltype(number)>(path, header, voxels, map); });
  return map;
}

}  // namespace stylet::offline
