// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/slides.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <limits>
#include <unordered_map>

#include "base/most_off.h"
#include "base/refusal.h"
#include "meshes/refine_near.h"
#include "meshes/triangle_tree.h"
#include "stylet/limits.h"

namespace stylet::offline {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  std::size_t from = 0, colon = 0;
  do {
    colon = text.find(':', from);
    words.push_back(text.substr(from, colon - from));
    from = colon + 1;
  } while (colon != std::string::npos);
  return words;
}

double friction_of(const std::string& text, const std::string& word) {
  double friction = 0;
  const char* const end = word.data() + word.size();
  const auto [read, error] = std::from_chars(word.data(), end, friction);
  const bool is_one = error == std::errc{} && read == end && friction >= 0 &&
                      friction <= static_cast<double>(kMaxSlideFriction);
  if (!is_one) {
    refuse("--slide '{}': friction {}: expected a number from 0 to {}", text, word,
           kMaxSlideFriction);
  }
  return friction;
}

// The tissues that slide, in the order of their sides, which begin with 1.
std::vector<std::string> sliding_tissues(const std::vector<Slide>& slides) {
  std::vector<std::string> tissues;
  for (const Slide& slide : slides) {
    for (const std::string& tissue : {slide.tissue, slide.ground}) {
      if (std::ranges::find(tissues, tissue) == tissues.end()) tissues.push_back(tissue);
    }
  }
  return tissues;
}

std::size_t number_in(const std::vector<std::string>& tissues, const std::string& tissue) {
  return static_cast<std::size_t>(std::ranges::find(tissues, tissue) - tissues.begin());
}

void refuse_unknown(const Slide& slide, const std::string& tissue, const BuildOptions& options) {
  const bool is_layer = std::ranges::any_of(
      options.layers, [&](const Layer& layer) { return layer.tissue == tissue; });
  if (is_layer) {
    refuse(
        "{}: {} is a layer, and layers slide with the input that they divide: expected the input's "
        "tissue, {}",
        slide.from, tissue, options.layer_course.of);
  }
  refuse("{}: {}: expected the tissue of one of the inputs", slide.from, tissue);
}

// Refuses a slide of two tissues that an earlier one has.
void check_repeated(const Slide& slide, const Slide& earlier) {
  if (slide.tissue == earlier.tissue && slide.ground == earlier.ground) {
    refuse("{}: {} slides on {} already ({}): expected each pair of tissues once", slide.from,
           slide.tissue, slide.ground, earlier.from);
  }
  if (slide.tissue == earlier.ground && slide.ground == earlier.tissue) {
    refuse("{}: {} slides on {} already ({}): expected only one of two tissues to be the ground",
           slide.from, earlier.tissue, earlier.ground, earlier.from);
  }
}

// The surfaces of all inputs with a tissue.
Mesh surface_of(const Claimed& claimed, const std::string& tissue) {
  Mesh mesh;
  for (std::size_t i = 0; i < claimed.surface_m.size(); ++i) {
    if (claimed.tissues[i] == tissue) add_mesh(mesh, claimed.surface_m[i]);
  }
  return mesh;
}

int priority_of(const Claimed& claimed, const std::string& tissue) {
  int most = std::numeric_limits<int>::min();
  for (const Claims::Share& share : claimed.levels.front().shares) {
    if (claimed.tissues[share.owner] == tissue) most = std::max(most, share.priority);
  }
  return most;
}

// Whether a triangle of `mesh` lies inside the other surface; not if it only touches it.
std::vector<bool> inside(const Mesh& mesh, const TriangleTree& other) {
  constexpr double kTouchM = 1e-6;
  std::vector<bool> is_inside;
  for (const Triangle& t : mesh.triangles) {
    const Vec a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
    const Vec normal = cross(b - a, c - a);
    const double size = length(normal);
    const Vec below = size > 0 ? normal * (-kTouchM / size) : Vec{};
    is_inside.push_back(winding_number(other, (a + b + c) * (1.0 / 3) + below) > 0.5);
  }
  return is_inside;
}

// What a stronger input leaves of a weaker one, whose volume it takes: a body around an organ has
// the organ's surface as its inner one. Where the two cross, triangles are at most `finest_m` long,
// since each is taken whole or not at all.
Mesh left_of(const Mesh& whole_weak, const Mesh& whole_strong, double finest_m) {
  const Mesh weak = refined_near(whole_weak, whole_strong, finest_m);
  const Mesh strong = refined_near(whole_strong, whole_weak, finest_m);
  const std::vector<bool> taken =
      inside(weak, triangle_tree(whole_strong.points, whole_strong.triangles));
  const std::vector<bool> inner =
      inside(strong, triangle_tree(whole_weak.points, whole_weak.triangles));
  Mesh left = {weak.points, {}}, turned = {strong.points, {}};
  for (std::size_t i = 0; i < weak.triangles.size(); ++i) {
    if (!taken[i]) left.triangles.push_back(weak.triangles[i]);
  }
  for (std::size_t i = 0; i < strong.triangles.size(); ++i) {
    const Triangle& t = strong.triangles[i];
    if (inner[i]) turned.triangles.push_back({t[0], t[2], t[1]});
  }
  add_mesh(left, turned);
  return left;
}

// The volume that the inputs of two tissues both claim, without what is cut away.
double overlap_m3(const Claimed& claimed, const std::string& one, const std::string& other) {
  const Grid& grid = claimed.levels.front().grid;
  std::unordered_map<std::uint32_t, std::array<std::uint64_t, 2>> inside;  // by cell
  for (const Claims::Share& share : claimed.levels.front().shares) {
    if (!claimed.cut.empty() && claimed.cut[share.cell] != 0) continue;
    if (claimed.tissues[share.owner] == one) inside[share.cell][0] |= share.inside;
    if (claimed.tissues[share.owner] == other) inside[share.cell][1] |= share.inside;
  }
  double cells = 0;
  for (const auto& [cell, of] : inside) cells += std::popcount(of[0] & of[1]) / 64.0;
  return cells * grid.edge_m * grid.edge_m * grid.edge_m;
}

// Why no surface of a tissue faces its ground.
std::string why_none(const Slide& slide, const Claimed& claimed) {
  const double overlap_ml = overlap_m3(claimed, slide.tissue, slide.ground) * 1e6;
  if (overlap_ml > 0) {
    return fmt::format(
        "they overlap by {:.3g} ml: expected surfaces that touch, or nearly, or a higher priority "
        "for one of the two",
        overlap_ml);
  }
  return "they are apart there and nothing keeps one out of the other: expected surfaces that "
         "touch, or nearly";
}

void warn_of_area(const Slide& slide, const SlideArea& area, const Claimed& claimed,
                  std::vector<std::string>& warnings) {
  const double edge_m = claimed.levels.front().grid.edge_m;
  if (!(area.facing > 0)) {
    warnings.push_back(fmt::format("{}: no surface of {} faces {} within {:.3g} mm{}; {}",
                                   slide.from, slide.tissue, slide.ground, kSlideReachM * 1e3,
                                   claimed.cut.empty() ? "" : " in what --crop leaves",
                                   why_none(slide, claimed)));
    return;
  }
  const auto tell = [&](double part, const char* why) {
    if (part <= kMostOff * area.facing) return;
    warnings.push_back(fmt::format(
        "{}: {:.3g} of {:.3g} cm2 are left out, because {}: there they pass through each other",
        slide.from, part * edge_m * edge_m * 1e4, area.facing * edge_m * edge_m * 1e4, why));
  };
  tell(area.without_voxel,
       "another tissue joins both parts, or they overlap: expected a gap or "
       "surfaces that touch");
  tell(area.without_ground,
       "the ground has no voxel near them: expected a finer voxel edge, or a "
       "thicker ground");
}

// Whether both have voxels; else the user is told.
bool have_voxels(const Slide& slide, const std::vector<std::string>& sliding,
                 std::span<const Lattice> levels, std::vector<std::string>& warnings) {
  std::uint32_t all = 0;
  for (const Lattice& level : levels) {
    for (const std::uint32_t sides : level.sides) all |= sides;
  }
  bool have = true;
  for (const std::string& tissue : {slide.tissue, slide.ground}) {
    if ((all & 2U << number_in(sliding, tissue)) != 0) continue;
    have = false;
    warnings.push_back(
        fmt::format("{}: {} has no voxel, so that nothing slides: expected some of it that is "
                    "neither cropped away nor covered by a tissue of higher priority",
                    slide.from, tissue));
  }
  return have;
}

}  // namespace

std::vector<Slide> parse_slides(const std::vector<std::string>& texts) {
  std::vector<Slide> slides;
  for (const std::string& text : texts) {
    const std::vector<std::string> words = split(text);
    const bool has_names =
        (words.size() == 2 || words.size() == 3) && !words[0].empty() && !words[1].empty();
    if (!has_names) refuse("--slide '{}': expected TISSUE:GROUND or TISSUE:GROUND:FRICTION", text);
    slides.push_back({words[0], words[1], kUsualFriction, fmt::format("--slide '{}'", text)});
    if (words.size() == 3) slides.back().friction = friction_of(text, words[2]);
  }
  return slides;
}

std::string text_of(const Slide& slide) {
  return fmt::format("{}:{}:{}", slide.tissue, slide.ground, slide.friction);
}

void check_slides(const BuildOptions& options, const std::vector<std::string>& tissues) {
  const std::vector<Slide>& slides = options.slides;
  for (std::size_t i = 0; i < slides.size(); ++i) {
    for (const std::string& tissue : {slides[i].tissue, slides[i].ground}) {
      if (std::ranges::find(tissues, tissue) != tissues.end()) continue;
      refuse_unknown(slides[i], tissue, options);
    }
    if (slides[i].tissue == slides[i].ground) {
      refuse("{}: {} cannot slide on itself: expected two tissues", slides[i].from,
             slides[i].tissue);
    }
    for (std::size_t j = 0; j < i; ++j) check_repeated(slides[i], slides[j]);
  }
  const std::size_t sides = sliding_tissues(slides).size();
  if (sides > kMostSides) refuse("--slide: {} tissues: expected at most {}", sides, kMostSides);
}

ApartOwners apart_owners(const std::vector<Slide>& slides,
                         const std::vector<std::string>& tissues) {
  ApartOwners apart;
  if (slides.empty()) return apart;
  const std::vector<std::string> sliding = sliding_tissues(slides);
  for (const std::string& tissue : tissues) {
    const std::size_t at = number_in(sliding, tissue);
    apart.side.push_back(at < sliding.size() ? static_cast<std::uint32_t>(at + 1) : 0);
  }
  apart.apart_from.assign(sliding.size() + 1, 0);
  for (const Slide& slide : slides) {
    const std::size_t a = number_in(sliding, slide.tissue) + 1;
    const std::size_t b = number_in(sliding, slide.ground) + 1;
    apart.apart_from[a] |= 1U << b;
    apart.apart_from[b] |= 1U << a;
  }
  return apart;
}

SlideLists place_slides(const std::vector<Slide>& slides, const Claimed& claimed,
                        std::span<const Lattice> levels, std::vector<std::string>& warnings) {
  if (slides.empty()) return {};
  const ApartOwners apart = apart_owners(slides, claimed.tissues);
  const std::vector<std::string> sliding = sliding_tissues(slides);
  std::vector<SlidingPart> parts;
  for (std::size_t i = 0; i < sliding.size(); ++i) {
    parts.push_back({surface_of(claimed, sliding[i]), 2U << i, apart.apart_from[i + 1]});
  }
  std::vector<SlidingPair> pairs;
  for (const Slide& slide : slides) {
    pairs.push_back(
        {number_in(sliding, slide.tissue), number_in(sliding, slide.ground), slide.friction});
    Mesh& tissue_m = parts[pairs.back().part].surface_m;
    Mesh& ground_m = parts[pairs.back().ground].surface_m;
    if (tissue_m.triangles.empty() || ground_m.triangles.empty()) continue;
    const int of_tissue = priority_of(claimed, slide.tissue);
    const int of_ground = priority_of(claimed, slide.ground);
    const double finest_m = levels.back().grid.edge_m / 4;
    if (of_tissue > of_ground) ground_m = left_of(ground_m, tissue_m, finest_m);
    if (of_tissue < of_ground) tissue_m = left_of(tissue_m, ground_m, finest_m);
  }
  SlideLists lists = list_slides(parts, pairs, levels, claimed.cut);
  const double edge_m = levels.front().grid.edge_m;
  for (std::size_t i = 0; i < slides.size(); ++i) {
    if (!have_voxels(slides[i], sliding, levels, warnings)) continue;
    warn_of_area(slides[i], lists.areas[i], claimed, warnings);
  }
  if (lists.points.size() > kMaxSlidePoints) {
    refuse(
        "--slide: {} points of surfaces at a voxel edge of {:.3g} mm: expected at most {}: "
        "larger voxels, {}--crop",
        lists.points.size(), edge_m * 1e3, kMaxSlidePoints,
        levels.size() > 1 ? "less of them finer (--refine), or " : "or ");
  }
  return lists;
}

}  // namespace stylet::offline
