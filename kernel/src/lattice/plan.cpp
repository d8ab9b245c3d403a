// SPDX-License-Identifier: Apache-2.0
#include "lattice/plan.h"

#include <algorithm>
#include <bit>

#include "base/function.h"
#include "lattice/hanging.h"
#include "lattice/shadow.h"
#include "lattice/tiles.h"
#include "lattice/voxel.h"

namespace stylet {
namespace {

// Bound of slots, particles and windows: differences of two of them are signed 32-bit numbers.
constexpr std::uint64_t kMostOfACount = INT32_MAX - 64;
// Most places (y, z) per row in the table that finds a row: 256 bytes. An organ of any usual shape
// has fewer, and then each row has a place of its own.
constexpr std::uint64_t kPlacesPerRow = 64;

template <typename Count>
constexpr Count round_lanes(Count n) {
  return (n + kLanes - 1) / kLanes * kLanes;
}

// ---- windows ------------------------------------------------------------------------------------

// Which of a row's stretches a window reaches, and which of its lanes (a bit each) are its nodes.
struct Reach {
  std::uint32_t stretch;
  std::uint16_t lanes;
};

// The stretches of a row, as far as windows have come.
class Reached {
 public:
  explicit Reached(Runs row) : left_({row}) {
    here_ = left_.next(now_);
    more_ = left_.next(after_);
  }

  // Passes stretches that end before node `x`. Returns where the next stretch begins, or `end`.
  std::uint32_t go_to(std::uint32_t x, std::uint32_t end) {
    for (; here_ && now_.end < x; ++index_) {
      now_ = after_;
      here_ = more_;
      more_ = left_.next(after_);
    }
    return more_ && after_.begin < end ? after_.begin : end;
  }

  // For the nodes [x, end).
  Reach lanes(std::uint32_t x, std::uint32_t end) const {
    std::uint32_t bits = 0;
    for (std::uint32_t node = x; node < end && here_; ++node) {
      if (node >= now_.begin && node <= now_.end) bits |= 1U << (node - x);
    }
    return {index_, static_cast<std::uint16_t>(bits)};
  }

 private:
  Stretches left_;
  Extent now_ = {}, after_ = {};
  std::uint32_t index_ = 0;
  bool here_ = false, more_ = false;
};

// Calls visit(x, reach of the row before, reach of the row behind) for each window of `width` nodes
// between two voxel rows. Where another stretch begins, a new window begins: the old window's
// unused lanes write zeros there, and the new one overwrites them. Each window holds a node of
// either row: fewer than kGap nodes of neither row lie between two such nodes.
void for_each_window(Runs before, Runs behind, std::uint32_t width,
                     Function<void(std::uint32_t, Reach, Reach)> visit) {
  Reached one(before), other(behind);
  Stretches both({before, behind});
  std::uint32_t end = 0;
  for (Extent all; both.next(all);) {
    for (std::uint32_t x = all.begin; x <= all.end; x = end) {
      end = one.go_to(x, std::min(x + width, all.end + 1));
      end = other.go_to(x, end);
      visit(x, one.lanes(x, end), other.lanes(x, end));
    }
  }
}

// ---- counts -------------------------------------------------------------------------------------

struct Totals {
  std::uint64_t rows, slots, particles, windows[2];
  std::uint64_t slots_of_line, particles_of_plane;  // at most
  std::uint64_t coarse_particles;                   // of level 0
};

void count_voxels(Runs plane, Totals& totals) {
  std::uint64_t slots = 1;
  std::uint32_t y = 0;
  Lines lines({plane});
  for (Beside rows; lines.next(y, rows);) {
    const std::uint64_t before = slots;
    Stretches stretches({rows[0]});
    for (Extent e; stretches.next(e); ++totals.rows) slots += e.end - e.begin + 1;
    totals.slots_of_line = std::max(totals.slots_of_line, slots - before);
    for (std::uint32_t i = 0; i < 2; ++i) {
      for_each_window(rows[1], rows[0], 8U << i, [&](auto...) { ++totals.windows[i]; });
    }
  }
  slots = round_lanes(slots);
  totals.slots += slots;
}

// Counts the nodes between two voxel planes.
void count_nodes(Runs above, Runs below, Totals& totals) {
  std::uint64_t particles = kLanes;
  std::uint32_t y = 0;
  Lines lines({above, below});
  for (Beside rows; lines.next(y, rows);) {
    Stretches stretches(rows);
    for (Extent e; stretches.next(e);) particles += e.end - e.begin + 1;
  }
  particles = round_lanes(particles);
  totals.particles += particles;
  totals.particles_of_plane = std::max(totals.particles_of_plane, particles);
}

// Calls visit(y, z) for each row.
template <typename Visit>
void for_each_row(const Organ& organ, Visit visit) {
  Planes planes(organ);
  std::uint32_t y = 0, z = 0;
  for (Runs plane; planes.next(z, plane);) {
    Lines lines({plane});
    for (Beside rows; lines.next(y, rows);) {
      Stretches stretches({rows[0]});
      for (Extent e; stretches.next(e);) visit(y, z);
    }
  }
}

std::uint32_t place_of(const Organ& organ, const Counts& counts, std::uint32_t y, std::uint32_t z) {
  return (z * organ.size_y + y) >> counts.row_shift;
}

void count_places(const Organ& organ, Counts& c) {
  const std::uint64_t grid = std::uint64_t{organ.size_y} * organ.size_z;
  for (; grid >> c.row_shift > kPlacesPerRow * c.rows; ++c.row_shift) {
  }
  c.row_grid = static_cast<std::uint32_t>((grid - 1) >> c.row_shift) + 1;
  std::uint32_t here = 0, most = 1, last = 0;
  for_each_row(organ, [&](std::uint32_t y, std::uint32_t z) {
    const std::uint32_t place = place_of(organ, c, y, z);
    here = place == last ? here + 1 : 1;
    most = std::max(most, here);
    last = place;
  });
  c.row_bits = static_cast<std::uint32_t>(std::bit_width(most - 1));
}

// ---- filling ------------------------------------------------------------------------------------

// Rows of a plane in order, their slots from `slot` on; the first slot before them stays empty.
void fill_rows(Runs runs, std::uint32_t plane, Model& model, std::uint32_t& row,
               std::uint32_t& slot) {
  std::uint32_t y = 0;
  Lines lines({runs});
  ++slot;
  for (Beside rows; lines.next(y, rows);) {
    Stretches stretches({rows[0]});
    for (Extent e; stretches.next(e);) {
      model.row[row++] = {slot,
                          static_cast<std::uint16_t>(e.end - e.begin),
                          static_cast<std::uint16_t>(e.begin),
                          static_cast<std::uint16_t>(y),
                          static_cast<std::uint16_t>(plane),
                          {},
                          {}};
      slot += e.end - e.begin + 1;
    }
  }
  slot = round_lanes(slot);
}

// Places of the particles between two voxel planes, from `particle` on. Each row gets the place of
// its first node; `rows_end` is the end of the rows made so far.
void fill_nodes(Runs above, Runs below, std::uint32_t plane, Model& model, std::uint32_t rows_end,
                std::uint32_t& particle) {
  const std::uint32_t begin = model.plane[plane].row_begin;
  const std::uint32_t begin_below = plane > 0 ? model.plane[plane - 1].row_begin : begin;
  std::uint32_t next[4] = {begin, begin, begin_below, begin_below};
  const std::uint32_t end[4] = {rows_end, rows_end, begin, begin};
  std::uint32_t y = 0;
  Lines lines({above, below});
  particle += kLanes;
  for (Beside rows; lines.next(y, rows);) {
    Stretches stretches(rows);
    for (Extent e; stretches.next(e);) {
      for (std::uint32_t corner = 0; corner < 4; ++corner) {
        for (; next[corner] < end[corner]; ++next[corner]) {
          Row& row = model.row[next[corner]];
          if (row.y + (corner & 1U) != y || row.x0 >= e.end) break;
          row.node[corner] = particle + row.x0 - e.begin;
        }
      }
      particle += e.end - e.begin + 1;
    }
  }
  particle = round_lanes(particle);
}

// Slot at the low side of node `x`, in its plane; windows reach at most their own width before it.
std::int32_t slot_of(const Row& row, const Plane& plane, std::uint32_t x) {
  return static_cast<std::int32_t>(row.slot + x) -
         static_cast<std::int32_t>(plane.slot_begin + row.x0);
}

Window window_at(const Model& model, std::uint32_t plane_index, std::uint32_t x, const Row* before,
                 const Row* behind, std::uint16_t one, std::uint16_t other) {
  const Plane& plane = model.plane[plane_index];
  const Row& row = other != 0 ? *behind : *before;
  const std::uint32_t side = other != 0 ? 0 : 1;
  // If one row has no node here, the other row is read twice: its sums are available.
  return {{slot_of(one != 0 ? *before : row, plane, x), slot_of(row, plane, x)},
          {one, other},
          row.node[side] + x - row.x0 - plane.particle_begin,
          row.node[side + 2] + x - row.x0 - model.plane[plane_index + 1].particle_begin};
}

// Windows of a plane, in list `list`, from index `next` on.
void fill_windows(Runs runs, std::uint32_t plane, Model& model, std::uint32_t list,
                  std::uint32_t& next) {
  Window* const windows = list == 0 ? model.window8 : model.window16;
  Row* before = model.row + model.plane[plane].row_begin;
  Row* behind = before;
  std::uint32_t y = 0;
  Lines lines({runs});
  for (Beside rows; lines.next(y, rows);) {
    Stretches stretches({rows[0]});
    std::uint32_t count = 0;
    for (Extent e; stretches.next(e); ++count) behind[count].window[list] = next;
    for_each_window(rows[1], rows[0], 8U << list, [&](std::uint32_t x, Reach a, Reach b) {
      windows[next++] =
          window_at(model, plane, x, before + a.stretch, behind + b.stretch, a.lanes, b.lanes);
    });
    before = behind;
    behind += count;
  }
}

}  // namespace

Status count_lattice(const Organ& organ, const Config& config, Counts& counts_out) {
  Counts& c = counts_out = {};
  c.needles = config.needle_count;
  c.voxels = organ.voxel_count;
  c.sheets = organ.size_y / organ.sheet_rows;
  c.levels = organ.levels;
  count_hanging(organ, c);
  c.ties = static_cast<std::uint32_t>(organ.ties.size());
  Totals totals = {};
  Planes planes(organ);
  Runs below = {};
  std::uint32_t z = 0;
  for (Runs plane; planes.next(z, plane); ++c.planes, below = plane) {
    count_voxels(plane, totals);
    count_nodes(plane, below, totals);
    if (level_of(organ.level_planes, z) == 0) totals.coarse_particles = totals.particles;
  }
  count_nodes({}, below, totals);
  const std::uint64_t most =
      std::max({totals.slots, totals.particles, totals.windows[0], totals.windows[1]});
  if (most > kMostOfACount) return Status::kOrganTooLarge;
  c.rows = static_cast<std::uint32_t>(totals.rows);
  c.slots = static_cast<std::uint32_t>(totals.slots);
  c.windows[0] = static_cast<std::uint32_t>(totals.windows[0]);
  c.windows[1] = static_cast<std::uint32_t>(totals.windows[1]);
  // A chunk, the rest of the row where it ends, and two lines of rows kept from the chunk before.
  c.slots_at_once =
      static_cast<std::uint32_t>(round_lanes(kChunk + 3 * totals.slots_of_line + 2 * kLanes));
  // The sweep works in whole lanes, so it touches up to two groups behind the last row.
  c.particles = static_cast<std::uint32_t>(totals.particles) + 2 * kLanes;
  c.particles_per_plane = static_cast<std::uint32_t>(totals.particles_of_plane) + 2 * kLanes;
  if (config.inertia == Inertia::kTrueMass || c.levels > 1) {
    c.filtered_particles = c.particles;
    c.filtered_slots = c.slots + kLanes;  // pieces are read in whole lanes
    if (c.levels > 1 && config.inertia == Inertia::kTrueMass) {
      count_shadows(organ, c.particles - totals.coarse_particles, c);
    }
    count_tiles(organ, c);
  }
  count_places(organ, c);
  return Status::kOk;
}

void fill_lattice(const Organ& organ, Model& model) {
  const Counts& counts = model.head->counts;
  Planes planes(organ);
  Runs here = {}, below = {};
  std::uint32_t z = 0, row = 0, slot = 0, particle = 0, window[2] = {};
  for (std::uint32_t i = 0; i <= counts.planes; ++i, below = here) {
    Plane& plane = model.plane[i];
    const bool voxels = planes.next(z, here);  // not in the last
    plane.z = z;
    plane.level = level_of(organ.level_planes, z);
    plane.z_in_level = z - first_plane(organ.level_planes, plane.level);
    plane.row_begin = row;
    plane.slot_begin = slot;
    plane.particle_begin = particle;
    if (voxels) fill_rows(here, i, model, row, slot);
    fill_nodes(here, below, i, model, row, particle);
    plane.slot_end = slot;
    plane.particle_end = particle;
  }
  Planes again(organ);
  for (std::uint32_t i = 0; i < counts.planes; ++i) {
    Plane& plane = model.plane[i];
    (void)again.next(z, here);
    for (std::uint32_t list = 0; list < 2; ++list) {
      plane.window_begin[list] = window[list];
      fill_windows(here, i, model, list, window[list]);
      plane.window_end[list] = window[list];
    }
  }
  for (std::uint32_t i = 0; i < counts.row_grid; ++i) model.row_of[i] = kNoRow;
  for (std::uint32_t i = counts.rows; i-- > 0;) {
    const Row& each = model.row[i];
    model.row_of[place_of(organ, counts, each.y, model.plane[each.plane].z)] = i;
  }
}

}  // namespace stylet
