// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/refinement.h"

#include <charconv>
#include <optional>
#include <string_view>

#include "base/refusal.h"

namespace stylet::offline {
namespace {

std::vector<std::string> split_at(std::string_view text, char mark) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t at = text.find(mark);
    parts.emplace_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

std::optional<double> number_in(const std::string& digits) {
  double value = 0;
  const char* const end = digits.data() + digits.size();
  const auto [read, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc{} || read != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<Vec> place_in(const std::string& text) {
  const std::vector<std::string> parts = split_at(text, ',');
  if (parts.size() != 3) return std::nullopt;
  const auto x = number_in(parts[0]), y = number_in(parts[1]), z = number_in(parts[2]);
  if (!x || !y || !z) return std::nullopt;
  return Vec{*x, *y, *z};
}

// Takes the two places of a way or a box.
bool take_places(const std::vector<std::string>& parts, Refinement& refinement) {
  const auto from = place_in(parts[1]), to = place_in(parts[2]);
  if (!from || !to) return false;
  refinement.from_mm = *from;
  refinement.to_mm = *to;
  return true;
}

bool take_way(const std::vector<std::string>& parts, Refinement& refinement) {
  const auto radius = number_in(parts[3]);
  refinement.kind = Refinement::Kind::kWay;
  refinement.radius_mm = radius.value_or(0);
  return refinement.radius_mm > 0 && take_places(parts, refinement);
}

bool take_box(const std::vector<std::string>& parts, Refinement& refinement) {
  refinement.kind = Refinement::Kind::kBox;
  if (!take_places(parts, refinement)) return false;
  const Vec low = refinement.from_mm, high = refinement.to_mm;
  return low.x < high.x && low.y < high.y && low.z < high.z;
}

bool take_labels(const std::vector<std::string>& parts, Refinement& refinement) {
  refinement.kind = Refinement::Kind::kLabels;
  refinement.tissues = split_at(parts[1], ',');
  return std::ranges::none_of(refinement.tissues, &std::string::empty);
}

bool take_surface(const std::vector<std::string>&, Refinement& refinement) {
  refinement.kind = Refinement::Kind::kSurface;
  return true;
}

struct Form {
  std::string_view word;
  std::size_t parts;  // without LEVELS
  bool (*take)(const std::vector<std::string>& parts, Refinement& refinement);
};
constexpr Form kForms[] = {{"way", 4, take_way},
                           {"box", 3, take_box},
                           {"labels", 2, take_labels},
                           {"surface", 1, take_surface}};

bool take(const std::vector<std::string>& parts, Refinement& refinement) {
  const auto form = std::ranges::find(kForms, std::string_view(parts.front()), &Form::word);
  if (form == std::end(kForms)) return false;
  if (parts.size() != form->parts && parts.size() != form->parts + 1) return false;
  if (parts.size() > form->parts) {
    const double levels = number_in(parts.back()).value_or(0);
    if (!(levels >= 1 && levels <= kMostHalvings) || levels != std::floor(levels)) return false;
    refinement.levels = static_cast<std::uint32_t>(levels);
  }
  return form->take(parts, refinement);
}

std::string shown(Vec place_mm) {
  return fmt::format("{},{},{}", place_mm.x, place_mm.y, place_mm.z);
}

}  // namespace

Refinement parse_refinement(const std::string& text, const std::string& place) {
  Refinement refinement;
  refinement.from = fmt::format("{} '{}'", place, text);
  if (!take(split_at(text, ':'), refinement)) {
    refuse(
        "{}: expected way:X,Y,Z:X,Y,Z:RADIUS_MM, box:X,Y,Z:X,Y,Z from low to high, "
        "labels:TISSUE[,TISSUE...] or surface, and after each :LEVELS, 1 to {}, or nothing",
        refinement.from, kMostHalvings);
  }
  return refinement;
}

std::string text_of(const Refinement& r) {
  switch (r.kind) {
    case Refinement::Kind::kWay:
      return fmt::format("way:{}:{}:{}:{}", shown(r.from_mm), shown(r.to_mm), r.radius_mm,
                         r.levels);
    case Refinement::Kind::kBox:
      return fmt::format("box:{}:{}:{}", shown(r.from_mm), shown(r.to_mm), r.levels);
    case Refinement::Kind::kLabels: {
      std::string tissues;
      for (const std::string& each : r.tissues) tissues += (tissues.empty() ? "" : ",") + each;
      return fmt::format("labels:{}:{}", tissues, r.levels);
    }
    case Refinement::Kind::kSurface:
      break;
  }
  return fmt::format("surface:{}", r.levels);
}

std::uint32_t most_halvings(const std::vector<Refinement>& refinements) {
  std::uint32_t most = 0;
  for (const Refinement& each : refinements) most = std::max(most, each.levels);
  return most;
}

}  // namespace stylet::offline
