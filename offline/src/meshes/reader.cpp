// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/reader.h"

#include <new>

namespace stylet::offline {
namespace {

// With more unreadable points than this, the file is not a damaged mesh but another kind of file.
constexpr std::size_t kMaxBadPoints = 10'000;

void require_points_of_corners(const Collector& collector) {
  const std::size_t points = collector.mesh.points.size();
  if (collector.corners_end <= points) return;
  const std::uint64_t first = collector.first_index;
  refuse_at(collector.highest_place, fmt::format("{}", collector.corners_end - 1 + first),
            fmt::format("a point index from {}, of one of {} points", first, points));
}

}  // namespace

void refuse_at(const Place& place, std::string_view value, std::string_view expected) {
  const bool line = place.kind == Place::Kind::kLine;
  refuse("{}:{}{}: {}: expected {}", place.file, line ? "" : " byte ", place.number, value,
         expected);
}

std::size_t require_room(const Place& place, std::string_view value, std::int64_t count,
                         const Room& room, std::string_view what) {
  const std::size_t most = room.bytes / room.bytes_each;
  if (count < 0 || static_cast<std::uint64_t>(count) > most) {
    refuse_at(place, value,
              fmt::format("{} from 0 to {}, for which {} bytes have room", what, most, room.bytes));
  }
  return static_cast<std::size_t>(count);
}

// 32 bits can count all points: read_file accepts 4 GiB, and a point takes at least 2 bytes.
void add_point(Collector& collector, Vec point, const Place& place, std::string value) {
  if (!finite(point)) {
    if (value.empty()) value = fmt::format("({}, {}, {})", point.x, point.y, point.z);
    if (collector.bad_points.size() >= kMaxBadPoints) {
      refuse_at(place, value,
                fmt::format("finite coordinates (more than {} points have none)", kMaxBadPoints));
    }
    collector.bad_points.push_back(
        {static_cast<std::uint32_t>(collector.mesh.points.size()), place, std::move(value)});
  }
  collector.mesh.points.push_back(point);
}

void add_polygon(Collector& collector, std::span<const std::uint32_t> corners, const Place& place) {
  for (const std::uint32_t corner : corners) {
    if (corner < collector.corners_end) continue;
    collector.corners_end = std::uint64_t{corner} + 1;
    collector.highest_place = place;
  }
  if (corners.size() < 3) {
    ++collector.counts.short_faces;
    return;
  }
  if (corners.size() > 3) ++collector.counts.polygons;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    collector.mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

ReadMesh finish(Collector&& collector) {
  Mesh& mesh = collector.mesh;
  require_points_of_corners(collector);
  if (mesh.triangles.empty()) {
    refuse("{}: {} points, no usable face: expected faces with at least 3 corners", collector.file,
           mesh.points.size());
  }
  std::vector<bool> used(mesh.points.size(), false);
  for (const Triangle& t : mesh.triangles) {
    // at: also of triangles that a reader put there itself, no corner may lie behind the points.
    for (const std::uint32_t corner : t) used.at(corner) = true;
  }
  for (const Collector::BadPoint& bad : collector.bad_points) {
    if (used[bad.point]) {
      refuse_at(bad.place, bad.value, "finite numbers in a point that a face uses");
    }
    ++collector.counts.unusable_points;
    mesh.points[bad.point] = {};
  }
  return {
      std::move(mesh), collector.counts, {}, collector.metres_per_unit, std::move(collector.notes)};
}

ReadMesh read_with(const MeshFormat& format, std::string_view file, std::string_view bytes) try {
  ReadMesh read = format.read(file, bytes);
  for (std::string& note : read.notes) note = fmt::format("{}: {}", file, note);
  return read;
} catch (const Refusal&) {
  throw;
} catch (const std::bad_alloc&) {
  refuse("{}: out of memory: expected a smaller file than {} bytes, or a larger --memory-limit",
         file, bytes.size());
} catch (const std::exception& error) {
  refuse("{}: the reader of {} files failed ({}): expected a valid file", file, format.ending,
         error.what());
}

}  // namespace stylet::offline
