// SPDX-License-Identifier: Apache-2.0
#include "organ/check_levels.h"

#include <algorithm>

#include "organ/runs.h"
#include "stylet/levels.h"
#include "stylet/limits.h"

namespace stylet {
namespace {

bool check_header(Checker& check, const Organ& organ) {
  return check.require(organ.format_version >= 5, Status::kOrganVersionUnknown, "levels", 0,
                       organ.format_version, "format version 5 where there are levels") &&
         check.require(organ.levels >= 2 && organ.levels <= kMaxLevels,
                       Status::kOrganValueOutOfRange, "levels.count", 0, organ.levels, "2 to 4") &&
         check.require(organ.level_planes > 0 &&
                           organ.size_z == first_plane(organ.level_planes, organ.levels) - 1,
                       Status::kOrganSizesDisagree, "levels.planes", 0, organ.level_planes,
                       "planes of level 0: size_z is count - 1 + planes (2^count - 1)");
}

// Each level's runs are within its own planes and within the space of all.
bool check_planes(Checker& check, const Organ& organ) {
  for (std::size_t i = 0; i < organ.runs.size(); ++i) {
    const OrganRun& run = organ.runs[i];
    const std::uint32_t end_x = std::uint32_t{run.x} + run.count;
    if (!check.require(!is_between_levels(organ, run.z), Status::kOrganIndexOutOfRange, "runs", i,
                       run.z, "the plane between two levels empty") ||
        !check.require(is_in_space(organ, end_x, run.y % organ.sheet_rows + 1U, run.z),
                       Status::kOrganIndexOutOfRange, "runs", i, end_x,
                       "a run inside the space of the finest level")) {
      return false;
    }
  }
  return true;
}

bool is_tied(const Organ& organ, const OrganHanging& h) {
  const auto before = [](const OrganTie& tie, std::uint64_t place) {
    return order_of(tie) < place;
  };
  const std::uint64_t place = order_of(h);
  const auto at = std::lower_bound(organ.ties.begin(), organ.ties.end(), place, before);
  return at != organ.ties.end() && order_of(*at) == place;
}

bool hangs(const Organ& organ, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  const auto before = [](const OrganHanging& h, std::uint64_t place) {
    return order_of(h) < place;
  };
  const std::uint64_t place = order_of(x, y, z);
  const auto at = std::lower_bound(organ.hanging.begin(), organ.hanging.end(), place, before);
  return at != organ.hanging.end() && order_of(*at) == place;
}

// The node lies in the voxel, all of it closed, and on its surface.
bool is_on_surface(const Organ& organ, const OrganHanging& h) {
  const std::uint32_t planes = organ.level_planes;
  const std::uint32_t own = level_of(planes, h.z), other = level_of(planes, h.voxel_z);
  if (own != other + 1) return false;
  const std::uint32_t ratio = 2;
  const std::uint32_t node[3] = {h.x, line_in_space(organ, h.y), h.z - first_plane(planes, own)};
  const std::uint32_t voxel[3] = {h.voxel_x, line_in_space(organ, h.voxel_y),
                                  h.voxel_z - first_plane(planes, other)};
  bool on_face = false;
  for (std::uint32_t a = 0; a < 3; ++a) {
    const std::uint32_t low = voxel[a] * ratio;
    if (node[a] < low || node[a] > low + ratio) return false;
    on_face = on_face || node[a] == low || node[a] == low + ratio;
  }
  return on_face;
}

bool check_hanging(Checker& check, const Organ& organ) {
  for (std::size_t i = 0; i < organ.hanging.size(); ++i) {
    const OrganHanging& h = organ.hanging[i];
    const std::uint64_t place = order_of(h);
    const OrganHanging& last = organ.hanging[i > 0 ? i - 1 : 0];
    if (!check.require(i == 0 || place > order_of(last), Status::kOrganOrderWrong, "levels.hanging",
                       i, h.x, "nodes sorted by z, y, x, each once") ||
        !check.require(has_node(organ, h.x, h.y, h.z) &&
                           has_voxel(organ, {h.voxel_x, h.voxel_x + 1U}, h.voxel_y, h.voxel_z),
                       Status::kOrganIndexOutOfRange, "levels.hanging", i, h.x,
                       "a node and a voxel of the lattice") ||
        !check.require(is_on_surface(organ, h), Status::kOrganIndexOutOfRange, "levels.hanging", i,
                       h.x, "a node on the surface of a voxel of the next coarser level") ||
        !check.require(!is_tied(organ, h), Status::kOrganOrderWrong, "levels.hanging", i, h.x,
                       "a node that is not tied")) {
      return false;
    }
  }
  // Nodes that are tied to it would not move with it.
  for (std::size_t i = 0; i < organ.ties.size(); ++i) {
    const OrganTie& tie = organ.ties[i];
    if (!check.require(!hangs(organ, tie.x, tie.to_y, tie.z), Status::kOrganOrderWrong,
                       "sheets.ties", i, tie.to_y, "a node that does not hang")) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool is_between_levels(const Organ& organ, std::uint32_t z) {
  return z + 1 >= first_plane(organ.level_planes, level_of(organ.level_planes, z) + 1);
}

bool is_in_space(const Organ& organ, std::uint32_t end_x, std::uint32_t end_y, std::uint32_t z) {
  const std::uint32_t finer = organ.levels - 1U - level_of(organ.level_planes, z);
  return end_x << finer <= organ.size_x && end_y << finer <= organ.sheet_rows;
}

bool check_levels(Checker& check, const Organ& organ) {
  return check_header(check, organ) && check_planes(check, organ) && check_hanging(check, organ);
}

}  // namespace stylet
