// SPDX-License-Identifier: GPL-3.0-or-later
#include "mixed.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace stylet::bake {
namespace {

constexpr std::uint32_t kSamples = 64;
constexpr std::uint16_t kNoOwner = 0xFFFF;
using OfSamples = std::array<std::uint16_t, kSamples>;  // an owner or a material of each

// The shares of each cell that has any, weakest first: the strongest owner has the last word.
class SharesByCell {
 public:
  explicit SharesByCell(const std::vector<Claims::Share>& shares) : shares_(shares) {
    std::stable_sort(shares_.begin(), shares_.end(), [](const auto& a, const auto& b) {
      return std::make_tuple(a.cell, a.priority, std::popcount(a.inside)) <
             std::make_tuple(b.cell, b.priority, std::popcount(b.inside));
    });
  }
  template <typename Visit>
  void each_of(std::size_t cell, Visit visit) const {
    auto share =
        std::lower_bound(shares_.begin(), shares_.end(), cell,
                         [](const auto& each, std::size_t wanted) { return each.cell < wanted; });
    for (; share != shares_.end() && share->cell == cell; ++share) visit(*share);
  }

 private:
  std::vector<Claims::Share> shares_;
};

struct Finder {
  const Claims& claims;
  const SamplePlaces& places;
  const TissueNumbers& numbers;
  SharesByCell shares;
};

OfSamples owners_of(const Finder& find, std::size_t cell) {
  OfSamples owner{};
  owner.fill(kNoOwner);
  const std::uint64_t inside = find.claims.inside[cell];
  const auto take = [&](std::uint64_t samples, std::uint16_t of) {
    for (std::uint32_t s = 0; s < kSamples; ++s) {
      if ((samples >> s & 1U) != 0) owner[s] = of;
    }
  };
  take(inside, find.claims.owner[cell]);  // also what was filled in later, by no input
  find.shares.each_of(cell, [&](const auto& share) { take(share.inside & inside, share.owner); });
  return owner;
}

// `side` > limit for the places beyond it.
struct Plane {
  Vec normal;
  double limit = 0;
};
double side(const Plane& plane, Vec place) {
  return dot(plane.normal, place);
}

// Between the samples in `beyond` and the others: from the middle of these towards the middle of
// those, with as many samples on either side. None or all of them: everything lies on one side.
Plane fit_plane(const SamplePlaces& places, std::uint64_t beyond) {
  const int count = std::popcount(beyond);
  if (count == 0) return {{0, 0, 0}, 1};
  if (count == kSamples) return {{0, 0, 0}, -1};
  Vec there{}, here{};
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    Vec& sum = (beyond >> s & 1U) != 0 ? there : here;
    sum = sum + places[s];
  }
  const Vec way = there * (1.0 / count) - here * (1.0 / (static_cast<int>(kSamples) - count));
  constexpr double kTooNear = 1e-3;  // one lies in the midst of the other: any direction is as good
  const double distance = length(way);
  Plane plane = {distance > kTooNear ? way * (1 / distance) : Vec{0, 0, 1}, 0};
  std::array<double, kSamples> along{};
  for (std::uint32_t s = 0; s < kSamples; ++s) along[s] = side(plane, places[s]);
  std::sort(along.begin(), along.end());
  const auto first = static_cast<std::size_t>(static_cast<int>(kSamples) - count);
  plane.limit = 0.5 * (along[first - 1] + along[first]);
  return plane;
}

// How much of the way from `from` to `to` lies on this side of a plane.
double length_before(const Plane& plane, Vec from, Vec to) {
  const double a = side(plane, from) - plane.limit, b = side(plane, to) - plane.limit;
  const double whole = length(to - from);
  if (a <= 0 && b <= 0) return whole;
  if (a > 0 && b > 0) return 0;
  return whole * (a <= 0 ? a / (a - b) : b / (b - a));
}

// Where layers are: how deep the rows through each sample have come, in edges.
using Depths = std::array<double, kSamples>;

// What the samples of a cell lie in: an owner, and a layer where one replaces it.
struct CellHere {
  OfSamples owner{};
  std::array<std::uint8_t, kSamples> layer{};
};

// A voxel, and which of its cell's samples it has.
struct VoxelHere {
  std::uint64_t inside;
  std::uint16_t owner;
  std::uint8_t material, layer;
};

Vec with(Vec place, std::size_t axis, double value) {
  return {axis == 0 ? value : place.x, axis == 1 ? value : place.y, axis == 2 ? value : place.z};
}

// Depth of each sample; moves `depths` on through the cell.
Depths depths_in(const Finder& find, std::uint64_t layered, Depths& depths) {
  const LayerCourse& course = find.numbers.course;
  const Plane plane = fit_plane(find.places, ~layered);
  Depths at{};
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    const double start = course.backwards ? 1 : 0;
    const Vec in = with(find.places[s], course.axis, start);
    const Vec out = with(find.places[s], course.axis, 1 - start);
    at[s] = depths[s] + length_before(plane, in, find.places[s]);
    depths[s] = layered == 0 ? 0 : depths[s] + length_before(plane, in, out);
  }
  return at;
}

CellHere samples_of(const Finder& find, std::size_t cell, Depths& depths) {
  const TissueNumbers& numbers = find.numbers;
  CellHere here;
  here.owner = owners_of(find, cell);
  here.layer.fill(kNotLayered);
  if (numbers.layers.empty()) return here;
  std::uint64_t layered = 0;
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    const bool is = here.owner[s] != kNoOwner && numbers.is_layered[here.owner[s]] != 0;
    layered |= std::uint64_t{is} << s;
  }
  const Depths depth = depths_in(find, layered, depths);
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    if ((layered >> s & 1U) == 0) continue;
    here.layer[s] = layer_at(numbers, depth[s] * find.claims.grid.edge_m);
  }
  return here;
}

// From owners to materials.
OfSamples materials_of(const TissueNumbers& numbers, const CellHere& here, const VoxelHere& voxel) {
  OfSamples material{};
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    const std::uint16_t owner = here.owner[s];
    const std::uint8_t layer = here.layer[s];
    if (owner == kNoOwner || (voxel.inside >> s & 1U) == 0) {
      material[s] = kNoTissue;
    } else if (layer != kNotLayered) {
      material[s] = layer == voxel.layer ? voxel.material : numbers.layers[layer].material;
    } else {
      material[s] = owner == voxel.owner ? voxel.material : numbers.of_owner[owner];
    }
  }
  return material;
}

// The material that most samples have which are not the voxel's own, and the plane before it.
bool find_other(const Finder& find, const OfSamples& material, std::uint8_t own,
                OrganMixed& mixed_out) {
  OfSamples others{};
  const auto end = std::copy_if(material.begin(), material.end(), others.begin(),
                                [own](std::uint16_t m) { return m != own; });
  if (end == others.begin()) return false;
  std::ptrdiff_t most = 0;
  for (auto each = others.begin(); each != end; ++each) {
    const std::ptrdiff_t count = std::count(others.begin(), end, *each);
    if (count < most || (count == most && *each >= mixed_out.material)) continue;
    most = count;
    mixed_out.material = *each;
  }
  std::uint64_t beyond = 0;
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    beyond |= std::uint64_t{material[s] == mixed_out.material} << s;
  }
  const Plane plane = fit_plane(find.places, beyond);
  mixed_out.nx = static_cast<float>(plane.normal.x);
  mixed_out.ny = static_cast<float>(plane.normal.y);
  mixed_out.nz = static_cast<float>(plane.normal.z);
  mixed_out.limit = static_cast<float>(plane.limit);
  return true;
}

// Calls visit(voxel, its samples) for the voxels of a cell.
template <typename Visit>
void each_voxel(const Lattice& lattice, std::size_t cell, Visit visit) {
  const std::span<const SharedCell> shared = shared_in(lattice, cell);
  if (shared.empty()) visit(lattice.voxel_of_cell[cell], ~std::uint64_t{0});
  for (const SharedCell& each : shared) visit(each.voxel, each.inside);
}

}  // namespace

std::vector<OrganMixed> mixed_voxels(const Claims& claims, const SamplePlaces& places,
                                     const Lattice& lattice, const VoxelTissues& tissues,
                                     const TissueNumbers& numbers) {
  const Finder find = {claims, places, numbers, SharesByCell(claims.shares)};
  const Grid& grid = claims.grid;
  const std::size_t axis = numbers.course.axis, u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<OrganMixed> mixed;
  std::array<std::uint32_t, 3> at{};
  for (at[v] = 0; at[v] < grid.size[v]; ++at[v]) {
    for (at[u] = 0; at[u] < grid.size[u]; ++at[u]) {
      Depths depths{};
      for (std::uint32_t step = 0; step < grid.size[axis]; ++step) {
        at[axis] = numbers.course.backwards ? grid.size[axis] - 1 - step : step;
        const std::size_t cell = cell_index(grid, at[0], at[1], at[2]);
        if (!is_kept(claims, cell)) {
          depths = {};
          continue;
        }
        const CellHere here = samples_of(find, cell, depths);
        each_voxel(lattice, cell, [&](std::uint32_t voxel, std::uint64_t inside) {
          if (voxel == kNoVoxel) return;  // cut away
          const std::uint16_t owner = tissues.owner[voxel];
          const std::uint8_t own = tissues.material[voxel];
          const std::uint8_t layer = voxel_layer(numbers, tissues.layers, cell, owner);
          const OfSamples found = materials_of(numbers, here, {inside, owner, own, layer});
          OrganMixed two = {voxel, kNoTissue, 0, 0, 0, 0, 0};
          if (find_other(find, found, own, two)) mixed.push_back(two);
        });
      }
    }
  }
  std::sort(mixed.begin(), mixed.end(),
            [](const OrganMixed& a, const OrganMixed& b) { return a.voxel < b.voxel; });
  return mixed;
}

}  // namespace stylet::bake
