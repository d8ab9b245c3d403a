// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"

#include <cmath>
#include <cstring>
#include <set>
#include <string_view>

#include "base/file.h"
#include "base/refusal.h"
#include "maps/readers.h"

namespace stylet::offline::python {
namespace {

template <typename T>
std::string_view bytes_of(const T* first, std::size_t count) {
  return {reinterpret_cast<const char*>(first), count * sizeof(T)};
}

// Row by row, so that only a row is in memory twice.
template <typename T>
void take_rows(const std::string& name, const LabelArray& array, LabelMap& map) {
  std::vector<char> row(array.size[0] * sizeof(T));
  std::set<std::uint16_t> different;
  map.label.reserve(array.size[0] * array.size[1] * array.size[2]);
  const auto [step_x, step_y, step_z] = array.stride_bytes;
  for (std::size_t z = 0; z < array.size[2]; ++z) {
    for (std::size_t y = 0; y < array.size[1]; ++y) {
      const char* from =
          array.data + static_cast<py::ssize_t>(z) * step_z + static_cast<py::ssize_t>(y) * step_y;
      for (std::size_t x = 0; x < array.size[0]; ++x, from += step_x) {
        std::memcpy(row.data() + x * sizeof(T), from, sizeof(T));
      }
      take_labels<T>(name, row, map, different);
    }
  }
}

void take_numbers(const std::string& name, const LabelArray& array, LabelMap& map) {
  const bool without_sign = array.kind == 'u' || array.kind == 'b';
  if (array.kind == 'f') {
    return array.item_bytes == 4 ? take_rows<float>(name, array, map)
                                 : take_rows<double>(name, array, map);
  }
  switch (array.item_bytes) {
    case 1:
      return without_sign ? take_rows<std::uint8_t>(name, array, map)
                          : take_rows<std::int8_t>(name, array, map);
    case 2:
      return without_sign ? take_rows<std::uint16_t>(name, array, map)
                          : take_rows<std::int16_t>(name, array, map);
    case 4:
      return without_sign ? take_rows<std::uint32_t>(name, array, map)
                          : take_rows<std::int32_t>(name, array, map);
    default:
      return without_sign ? take_rows<std::uint64_t>(name, array, map)
                          : take_rows<std::int64_t>(name, array, map);
  }
}

std::string shape_of(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

}  // namespace

LabelArray label_array(const py::array& labels, const std::array<std::size_t, 3>& axes) {
  if (labels.ndim() != 3) {
    throw py::value_error("labels of shape " + shape_of(labels) + ": expected three dimensions");
  }
  LabelArray out;
  out.data = static_cast<const char*>(labels.data());
  out.kind = labels.dtype().kind();
  out.item_bytes = static_cast<std::size_t>(labels.itemsize());
  const bool is_real = out.kind == 'f' && (out.item_bytes == 4 || out.item_bytes == 8);
  if (!is_real && out.kind != 'u' && out.kind != 'i' && out.kind != 'b') {
    throw py::type_error("labels of " + py::str(labels.dtype()).cast<std::string>() +
                         ": expected whole numbers, such as numpy.uint8 or numpy.uint16");
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    out.size[i] = static_cast<std::size_t>(labels.shape(static_cast<py::ssize_t>(axes[i])));
    out.stride_bytes[i] = labels.strides(static_cast<py::ssize_t>(axes[i]));
  }
  return out;
}

void take_array(const std::string& name, const LabelArray& array, LabelMap& map) {
  require_map_size(name, array.size);
  for (std::size_t i = 0; i < 3; ++i) map.size[i] = static_cast<std::uint32_t>(array.size[i]);
  require_frame(name, map);
  take_numbers(name, array, map);
  map.sha256 = sha256_hex(bytes_of(map.label.data(), map.label.size()));
}

ReadMesh mesh_of(const std::string& name, const Points& vertices_m, const Faces& faces) {
  if (vertices_m.ndim() != 2 || vertices_m.shape(1) != 3) {
    throw py::value_error(name + ": vertices of shape " + shape_of(vertices_m) +
                          ": expected (vertices, 3)");
  }
  if (faces.ndim() != 2 || faces.shape(1) != 3) {
    throw py::value_error(name + ": faces of shape " + shape_of(faces) + ": expected (faces, 3)");
  }
  ReadMesh out;
  const double* at = vertices_m.data();
  for (py::ssize_t i = 0; i < vertices_m.shape(0); ++i, at += 3) {
    out.mesh.points.push_back({at[0], at[1], at[2]});
    if (!finite(out.mesh.points.back())) refuse("{}: vertex {}: expected finite numbers", name, i);
  }
  const std::int64_t* corner = faces.data();
  for (py::ssize_t i = 0; i < faces.shape(0); ++i) {
    Triangle triangle{};
    for (std::size_t n = 0; n < 3; ++n, ++corner) {
      if (*corner < 0 || *corner >= vertices_m.shape(0)) {
        refuse("{}: face {}: vertex {}: expected 0 to {}", name, i, *corner,
               vertices_m.shape(0) - 1);
      }
      triangle[n] = static_cast<std::uint32_t>(*corner);
    }
    out.mesh.triangles.push_back(triangle);
  }
  if (out.mesh.triangles.empty()) refuse("{}: no faces: expected a surface", name);
  const auto points = static_cast<std::size_t>(vertices_m.size());
  out.sha256 =
      sha256_hex(sha256_hex(bytes_of(vertices_m.data(), points)) +
                 sha256_hex(bytes_of(faces.data(), static_cast<std::size_t>(faces.size()))));
  return out;
}

}  // namespace stylet::offline::python
