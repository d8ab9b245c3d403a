// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/wrapping.h"

#include "base/most_off.h"
#include "base/refusal.h"
#include "meshes/distance.h"
#include "meshes/holes.h"
#include "meshes/triangle_tree.h"
#include "meshes/wrap.h"
#include "voxels/sample_cell.h"

namespace stylet::offline {
namespace {

// Enough to know a volume to 2 % and what a skin lacks to 0.3 %. (The error is half a point on each
// face of a box that holds this many points.)
constexpr std::size_t kEnoughInside = 4096;
constexpr std::uint32_t kMostPoints = 1U << 17U;  // a few seconds where faces do not tell sides

// Points that fill a cube evenly however many there are: multiples of powers of the root of
// x^4 = x + 1 (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018).
Vec spread_point(std::uint32_t i) {
  constexpr double kRoot = 1.2207440846057596;
  const auto part = [&](double step) { return std::fmod(0.5 + i / step, 1.0); };
  return {part(kRoot), part(kRoot * kRoot), part(kRoot * kRoot * kRoot)};
}

// The fraction of all directions in which the surface lies around the point.
double enclosed(const TriangleTree& tree, bool closed, Vec point) {
  const double winding = winding_number(tree, point);
  return closed || winding > 0.5 ? winding : std::max(winding, odd_rays(tree, point));
}

// Which part of the points is not in the skin.
double missing(const Solid& skin, const std::vector<Vec>& points) {
  const TriangleTree tree = triangle_tree(skin.surface.points, skin.boundary);
  const auto outside =
      std::ranges::count_if(points, [&](Vec p) { return winding_number(tree, p) <= 0.5; });
  return static_cast<double>(outside) / static_cast<double>(points.size());
}

double volume_of(const Solid& solid) {
  const Box box = bounds(solid.surface);
  return signed_volume(solid.surface.points, solid.boundary, (box.low + box.high) * 0.5);
}

Solid skin_around(const Mesh& mesh, double step_m, double offset_m) {
  return repair(alpha_wrap(mesh, step_m, offset_m));
}

std::string place_of(Vec at_m) {
  const auto mm = [](double m) { return std::round(m * 1e4) / 10 + 0.0; };  // and no -0
  return fmt::format("({}, {}, {}) mm", mm(at_m.x), mm(at_m.y), mm(at_m.z));
}

// A skin, and from what it was made.
struct Skin {
  Mesh mesh;
  double step_m = 0;
  Solid solid;
};

// Makes steps larger until the skin stays outside. With steps as long as the surface it does,
// except around points that the surface encloses only in few directions.
void widen(Skin& skin, const Content& content, double offset_m, const std::string& name,
           std::vector<std::string>& warnings) {
  constexpr double kWider = 1.25;
  const double step_m = skin.step_m, most_m = longest_side(bounds(skin.mesh));
  while (missing(skin.solid, content.points) > kMostOff && skin.step_m < most_m) {
    skin.step_m *= kWider;
    skin.solid = skin_around(skin.mesh, skin.step_m, offset_m);
  }
  const double lacks = missing(skin.solid, content.sure);
  if (lacks > kMostOff) {
    refuse(
        "{}: even in steps of {:.4g} mm the skin lacks {:.2g} % of what the surface encloses: "
        "expected a surface with narrower gaps",
        name, skin.step_m * 1e3, lacks * 100);
  }
  const Deviation gap = deviation(skin.solid.surface, skin.mesh);
  warnings.push_back(fmt::format(
      "in steps of {:.4g} mm the skin went in through gaps of up to {:.3g} mm, as at {}; in steps "
      "of {:.3g} mm it does not, but is coarser everywhere, and fills what is hollow outside: "
      "expected a surface with narrower gaps, or a larger voxel edge; look at the result before "
      "use",
      step_m * 1e3, 2e3 * gap.most_m, place_of(gap.where_m), skin.step_m * 1e3));
}

// A skin that is not hollow where the input is not. No skin enters a closed surface, and a sheet
// has no inside to compare with: these are not checked.
Skin sealed(const Solid& solid, const Content& content, double step_m, double offset_m,
            const std::string& name, std::vector<std::string>& warnings) {
  Skin skin{solid.surface, step_m, skin_around(solid.surface, step_m, offset_m)};
  if (solid.closed || !content.encloses) return skin;
  if (missing(skin.solid, content.points) <= kMostOff) return skin;
  Patched patched = patch_holes(solid);
  skin.mesh = std::move(patched.mesh);
  skin.solid = skin_around(skin.mesh, step_m, offset_m);
  if (missing(skin.solid, content.sure) > kMostOff) {
    widen(skin, content, offset_m, name, warnings);
  } else {
    const Hole& widest = patched.holes.front();
    warnings.push_back(fmt::format(
        "in steps of {:.4g} mm the skin went in through holes; now flat patches close them, the "
        "widest {:.3g} mm across at {}: expected a surface without such holes; look at the result "
        "before use",
        step_m * 1e3, widest.across * 1e3, place_of(widest.middle)));
  }
  return skin;
}

void tell_volume(const Solid& skin, const Content& content, double offset_m,
                 std::vector<std::string>& warnings) {
  const double skin_m3 = volume_of(skin), off = skin_m3 / content.volume_m3 - 1;
  if (!content.encloses) {
    warnings.push_back(
        fmt::format("encloses nothing; its skin, {:.3g} mm thick, is {:.3g} ml: expected a surface "
                    "with an inside; look at the result before use",
                    2e3 * offset_m, skin_m3 * 1e6));
  } else if (std::abs(off) > kMostOff) {
    warnings.push_back(fmt::format(
        "its skin holds {:.3g} ml, {:.3g} % {} than the {:.3g} ml that it encloses itself: "
        "expected a closed surface without --wrap, or a finer voxel edge",
        skin_m3 * 1e6, std::abs(off) * 100, off > 0 ? "more" : "less", content.volume_m3 * 1e6));
  }
}

}  // namespace

Content content_of(const Solid& solid) {
  constexpr double kSure = 0.75, kMore = 0.5;
  constexpr std::size_t kFewest = 64;  // fewer are the neighbourhood of a sheet
  constexpr std::size_t kFew = 1024;   // with fewer a volume is not known to 3 %
  constexpr double kSame = 0.05;       // pieces that overlap count twice in a mesh's own volume
  const TriangleTree tree = triangle_tree(solid.surface.points, solid.boundary);
  const Box box = bounds(solid.surface);
  const Vec size = box.high - box.low;
  Content content;
  std::uint32_t count = 0;
  while (count < kMostPoints && content.points.size() < kEnoughInside) {
    const Vec part = spread_point(count++);
    const Vec point = box.low + Vec{part.x * size.x, part.y * size.y, part.z * size.z};
    const double all_around = enclosed(tree, solid.closed, point);
    if (all_around > kMore) content.points.push_back(point);
    if (all_around > kSure) content.sure.push_back(point);
  }
  content.volume_m3 = size.x * size.y * size.z * static_cast<double>(content.points.size()) / count;
  const double own_m3 = volume_of(solid);
  const bool same = std::abs(own_m3 - content.volume_m3) < kSame * own_m3;
  if (solid.closed && (same || content.points.size() < kFew)) content.volume_m3 = own_m3;
  content.encloses = solid.closed ? own_m3 > 0 : content.sure.size() >= kFewest;
  return content;
}

Wrapped wrap(const Solid& solid, const Content& content, double step_m, const std::string& name) {
  constexpr double kOffsetOfStep = 0.1, kLess = 0.1;
  double offset_m = step_m * kOffsetOfStep;
  Wrapped wrapped;
  Skin skin = sealed(solid, content, step_m, offset_m, name, wrapped.warnings);
  if (content.encloses && volume_of(skin.solid) > content.volume_m3 * (1 + kMostOff)) {
    offset_m *= kLess;
    skin.solid = skin_around(skin.mesh, skin.step_m, offset_m);
    // A skin that lies closer may go in where the first one just did not.
    if (!solid.closed && missing(skin.solid, content.sure) > kMostOff) {
      wrapped.warnings.clear();
      skin = sealed(solid, content, step_m, offset_m, name, wrapped.warnings);
    }
  }
  tell_volume(skin.solid, content, offset_m, wrapped.warnings);
  for (std::string& each : wrapped.warnings) each = name + ": " + each;
  wrapped.solid = std::move(skin.solid);
  wrapped.solid.counts = solid.counts;
  return wrapped;
}

}  // namespace stylet::offline
