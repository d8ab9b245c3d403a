// SPDX-License-Identifier: GPL-3.0-or-later
#include "voxels/attach.h"

#include <charconv>
#include <string_view>

#include "base/refusal.h"

namespace stylet::offline {
namespace {

constexpr double kMetresPerMm = 1e-3;
constexpr std::string_view kBoxWord = "box:";
constexpr std::string_view kTouchingWord = "touching:";

// A region's text and the option it was given for, for messages.
struct Spelled {
  const std::string& option;
  const std::string& text;
};

[[noreturn]] void refuse_region(const Spelled& s) {
  refuse(
      "{} '{}': expected x>MM, x<MM (or y, z; MM may be N%), box:X0,Y0,Z0,X1,Y1,Z1, touching:MESH "
      "or none",
      s.option, s.text);
}

double parse(std::string_view digits, const Spelled& s) {
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) {
    refuse_region(s);
  }
  return value;
}

Region parse_half_space(const Spelled& s) {
  const std::string& text = s.text;
  if (text.size() < 3 || text[0] < 'x' || text[0] > 'z' || (text[1] != '<' && text[1] != '>')) {
    refuse_region(s);
  }
  Region region;
  region.kind = text[1] == '>' ? Region::Kind::kAbove : Region::Kind::kBelow;
  region.axis = static_cast<std::size_t>(text[0] - 'x');
  std::string_view digits = std::string_view(text).substr(2);
  region.is_fraction = digits.back() == '%';
  if (region.is_fraction) digits.remove_suffix(1);
  region.bound = parse(digits, s) * (region.is_fraction ? 0.01 : kMetresPerMm);
  return region;
}

Region parse_box(const Spelled& s) {
  double numbers[6];
  std::string_view rest = std::string_view(s.text).substr(kBoxWord.size());
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (i == 5)) refuse_region(s);
    numbers[i] = parse(rest.substr(0, comma), s) * kMetresPerMm;
    rest.remove_prefix(i == 5 ? rest.size() : comma + 1);
  }
  Region region;
  region.kind = Region::Kind::kBox;
  region.box_m = {{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (region.box_m.low[axis] > region.box_m.high[axis]) refuse_region(s);
  }
  return region;
}

Region parse_touching(const std::string& text, const MeshUnits& units) {
  Region region;
  region.kind = Region::Kind::kTouching;
  const std::string path = text.substr(kTouchingWord.size());
  ReadMesh read = read_mesh(path);
  const double metres_per_unit = take_metres(read, path, units);
  region.mesh_m = std::move(read.mesh);
  region.notes = std::move(read.notes);
  scale_to_metres(region.mesh_m, path, metres_per_unit);
  return region;
}

template <typename Test>
void hold_where(const Grid& grid, std::vector<std::uint8_t>& held, Test test) {
  for (std::uint32_t z = 0; z <= grid.size[2]; ++z) {
    for (std::uint32_t y = 0; y <= grid.size[1]; ++y) {
      for (std::uint32_t x = 0; x <= grid.size[0]; ++x) {
        const Vec corner = grid.origin_m + Vec{static_cast<double>(x), static_cast<double>(y),
                                               static_cast<double>(z)} *
                                               grid.edge_m;
        if (test(corner)) held[corner_index(grid, x, y, z)] = 1;
      }
    }
  }
}

void hold_touched(const Grid& grid, const Region& region, std::vector<std::uint8_t>& held) {
  const std::vector<std::uint8_t> touched = touched_cells(grid, region.mesh_m);
  for (std::uint32_t z = 0; z < grid.size[2]; ++z) {
    for (std::uint32_t y = 0; y < grid.size[1]; ++y) {
      for (std::uint32_t x = 0; x < grid.size[0]; ++x) {
        if (touched[cell_index(grid, x, y, z)] == 0) continue;
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
          held[corner_index(grid, x + (corner & 1U), y + (corner >> 1U & 1U), z + (corner >> 2U))] =
              1;
        }
      }
    }
  }
}

}  // namespace

std::vector<Region> parse_regions(const std::vector<std::string>& texts, const MeshUnits& units,
                                  const std::string& option) {
  std::vector<Region> regions;
  for (const std::string& text : texts) {
    if (text == "none") {
      if (texts.size() > 1) refuse("{0} none: expected no other {0} with it", option);
    } else if (text.starts_with(kBoxWord)) {
      regions.push_back(parse_box({option, text}));
    } else if (text.starts_with(kTouchingWord)) {
      regions.push_back(parse_touching(text, units));
    } else {
      regions.push_back(parse_half_space({option, text}));
    }
  }
  return regions;
}

bool holds(const Region& region, const Box& extent_m, Vec point_m, double slack_m) {
  if (region.kind == Region::Kind::kBox) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (point_m[axis] < region.box_m.low[axis] - slack_m ||
          point_m[axis] > region.box_m.high[axis] + slack_m) {
        return false;
      }
    }
    return true;
  }
  const double low = extent_m.low[region.axis];
  const double bound =
      region.is_fraction ? low + region.bound * (extent_m.high[region.axis] - low) : region.bound;
  return region.kind == Region::Kind::kAbove ? point_m[region.axis] >= bound - slack_m
                                             : point_m[region.axis] <= bound + slack_m;
}

std::vector<std::uint8_t> held_corners(const Grid& grid, const Box& extent_m,
                                       const std::vector<Region>& regions) {
  std::vector<std::uint8_t> held(
      std::size_t{grid.size[0] + 1} * (grid.size[1] + 1) * (grid.size[2] + 1), 0);
  for (const Region& region : regions) {
    if (region.kind == Region::Kind::kTouching) {
      hold_touched(grid, region, held);
    } else {
      hold_where(grid, held, [&](Vec corner) {
        return holds(region, extent_m, corner, grid.edge_m * kTouch * 2);
      });
    }
  }
  return held;
}

}  // namespace stylet::offline
