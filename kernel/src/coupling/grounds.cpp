// SPDX-License-Identifier: Apache-2.0
#include "coupling/grounds.h"

#include <algorithm>

#include "base/math.h"
#include "base/sort.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// How far from its ground a point is followed, in edges. It may come to another piece of it.
constexpr float kFollowed = 64.0F;

// A cell of space at a level.
struct Cell {
  std::int32_t at[3];
  std::uint32_t level;
};

// The order of grounds; those that share it lie in one cell, in different sheets. With one level it
// is that of the file.
std::uint64_t order_of(const Model& model, const Cell& cell, std::uint32_t body) {
  const auto part = [](std::int32_t value) { return static_cast<std::uint64_t>(value); };
  const std::uint64_t z = model.head->level[cell.level].first_plane + part(cell.at[2]);
  return (z << 48U) | (std::uint64_t{body} << 32U) | (part(cell.at[1]) << 16U) | part(cell.at[0]);
}

Cell cell_of(const SlideGround& ground) {
  return {{ground.x, ground.y, ground.z}, ground.level};
}

std::uint64_t order_of(const Model& model, const SlideGround& ground) {
  return order_of(model, cell_of(ground), ground.body);
}

const SlideGround* end_of(const Model& model) {
  return model.ground + model.head->counts.grounds;
}

bool is_in_space(const Model& model, const Cell& cell) {
  const ModelHead& head = *model.head;
  return cell.at[0] >= 0 && cell.at[1] >= 0 && cell.at[2] >= 0 && cell.at[0] < head.size_x &&
         cell.at[1] < head.sheet_rows &&
         cell.at[2] < static_cast<std::int32_t>(head.level[cell.level].planes);
}

// The first ground of a body in a cell; the others follow it.
std::uint32_t ground_in(const Model& model, const Cell& cell, std::uint32_t body) {
  if (!is_in_space(model, cell)) return kNoGround;
  const std::uint64_t wanted = order_of(model, cell, body);
  const SlideGround* const found =
      std::lower_bound(static_cast<const SlideGround*>(model.ground), end_of(model), wanted,
                       [&](const SlideGround& ground, std::uint64_t order) {
                         return order_of(model, ground) < order;
                       });
  const bool is_one = found != end_of(model) && order_of(model, *found) == wanted;
  return is_one ? static_cast<std::uint32_t>(found - model.ground) : kNoGround;
}

// The ground beside another one at a side (0 to 5, see SlideGround): where several are in the cell,
// that which shares the particles between them.
std::uint32_t ground_beside(const Model& model, const SlideGround& from, std::uint32_t side) {
  const std::uint32_t axis = side / 2, corner = side % 2 != 0 ? 1U << axis : 0;
  Cell cell = cell_of(from);
  cell.at[axis] += side % 2 != 0 ? 1 : -1;
  const std::uint32_t first = ground_in(model, cell, from.body);
  if (first == kNoGround) return kNoGround;
  const std::uint32_t between = particle_of(model, from.node[corner]);
  for (const SlideGround* at = model.ground + first;
       at != end_of(model) && order_of(model, *at) == order_of(model, cell, from.body); ++at) {
    if (particle_of(model, at->node[corner ^ 1U << axis]) == between) {
      return static_cast<std::uint32_t>(at - model.ground);
    }
  }
  return first;
}

// Whole edges below a place; whatever is no number is far below.
std::int32_t whole(float at) {
  if (!(at > -kFollowed)) return -static_cast<std::int32_t>(kFollowed);
  const auto down = static_cast<std::int32_t>(min_of(at, kFollowed));
  return at < static_cast<float>(down) ? down - 1 : down;
}

// A place along one axis: the cell's number at a level, and where in it.
struct Along {
  std::int32_t cell;
  float place;
};
// Exact: cells of a level are halves of those of the one before.
Along at_level(Along from, std::uint32_t own, std::uint32_t wanted) {
  if (wanted >= own) {
    const std::int32_t ratio = 1 << (wanted - own);
    const float place = from.place * static_cast<float>(ratio);
    const std::int32_t more = whole(place);
    return {from.cell * ratio + more, place - static_cast<float>(more)};
  }
  const std::uint32_t shift = own - wanted;
  const std::int32_t cell = from.cell >> shift;  // rounds down
  const auto before = static_cast<float>(from.cell - (cell << shift));
  return {cell, (before + from.place) * edge_ratio(shift)};
}

// Of the cells in which a place of a ground lies, one of each level, that which has a ground of the
// same body: where there are finer voxels there are no coarser ones.
void enter_any_level(const Model& model, std::uint32_t& ground, Vec3& place) {
  const SlideGround& from = model.ground[ground];
  const float given[3] = {place.x, place.y, place.z};
  const std::int32_t cell_at[3] = {from.x, from.y, from.z};
  Along own[3];
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::int32_t by = whole(given[axis]);
    own[axis] = {cell_at[axis] + by, given[axis] - static_cast<float>(by)};
  }
  for (std::uint32_t level = 0; level < model.head->counts.levels; ++level) {
    Along there[3];
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      there[axis] = at_level(own[axis], from.level, level);
    }
    const Cell cell = {{there[0].cell, there[1].cell, there[2].cell}, level};
    const std::uint32_t other = ground_in(model, cell, from.body);
    if (other == kNoGround) continue;
    ground = other;
    place = {there[0].place, there[1].place, there[2].place};
  }
}

SlideGround ground_at(const Organ& organ, const Model& model, std::uint32_t in_file) {
  const ModelHead& head = *model.head;
  const OrganSlideGround& given = organ.slide_grounds[in_file];
  const Row& row = model.row[model.voxel_row[given.voxel]];
  const Plane& plane = model.plane[row.plane];
  const float edge_m = head.level[plane.level].edge_m;
  SlideGround out = {};
  out.slot = model.voxel_slot[given.voxel];
  out.x = static_cast<std::int32_t>(row.x0 + (out.slot - row.slot));
  out.y = row.y % head.sheet_rows;
  out.z = static_cast<std::int32_t>(plane.z_in_level);
  out.level = static_cast<std::uint16_t>(plane.level);
  out.body = organ.slide_bodies.empty() ? static_cast<std::uint16_t>(row.y / head.sheet_rows)
                                        : organ.slide_bodies[in_file];
  out.low_m = head.origin_m + edge_m * cell_of(model, out.slot, row);
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    out.node[corner] = corner_node(row, out.slot, corner);
    out.outside_m[corner] = edge_m * given.distance[corner];
  }
  return out;
}

bool comes_before(const Model& model, const SlideGround& a, const SlideGround& b) {
  const std::uint64_t of_a = order_of(model, a), of_b = order_of(model, b);
  return of_a != of_b ? of_a < of_b : a.slot < b.slot;
}

}  // namespace

void fill_grounds(const Organ& organ, Model& model) {
  const std::uint32_t count = model.head->counts.grounds;
  SlideGround* const first = model.ground;
  for (std::uint32_t i = 0; i < count; ++i) first[i] = ground_at(organ, model, i);
  sort(first, first + count,
       [&](const SlideGround& a, const SlideGround& b) { return comes_before(model, a, b); });
  for (std::uint32_t i = 0; i < count; ++i) {  // once all are there
    for (std::uint32_t side = 0; side < 6; ++side) {
      first[i].beside[side] = ground_beside(model, first[i], side);
    }
  }
}

std::uint32_t ground_of(const Organ& organ, const Model& model, std::uint32_t in_file) {
  const SlideGround* const found = std::lower_bound(
      static_cast<const SlideGround*>(model.ground), end_of(model),
      ground_at(organ, model, in_file),
      [&](const SlideGround& a, const SlideGround& b) { return comes_before(model, a, b); });
  return static_cast<std::uint32_t>(found - model.ground);
}

Vec3 within(Vec3 place, float low, float high) {
  return {clamp(place.x, low, high), clamp(place.y, low, high), clamp(place.z, low, high)};
}

void enter_ground(const Model& model, std::uint32_t& ground_io, Vec3& place_io) {
  float* const along[3] = {&place_io.x, &place_io.y, &place_io.z};
  bool inside = true;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    float& at = *along[axis];
    const std::uint32_t* const beside = model.ground[ground_io].beside;
    if (at < 0 && beside[2 * axis] != kNoGround) {
      ground_io = beside[2 * axis];
      at += 1;
    } else if (at > 1 && beside[2 * axis + 1] != kNoGround) {
      ground_io = beside[2 * axis + 1];
      at -= 1;
    }
    inside = inside && at >= 0 && at <= 1;
  }
  if (inside) return;
  enter_any_level(model, ground_io, place_io);
  place_io = within(place_io, -kFollowed, kFollowed);
}

}  // namespace stylet
