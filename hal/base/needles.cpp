// SPDX-License-Identifier: Apache-2.0
#include "hal/base/needles.h"

#include <array>
#include <numbers>

#include "hal/base/angle.h"

namespace stylet::hal {
namespace {

constexpr double kPi = std::numbers::pi;

constexpr std::array kTips = {
    TipKind{"conical", 1.5}, TipKind{"diamond", 1},     TipKind{"bevel", 1},  TipKind{"bent", 1.5},
    TipKind{"pencil", 1.5},  TipKind{"tuohy", kPi / 2}, TipKind{"blunt", kPi}};

constexpr NeedleMaterial kSteel = {"steel", 200}, kNitinol = {"nitinol", 75};
constexpr std::array kMaterials = {kSteel, kNitinol};

constexpr double kConeDeg = 15;
constexpr double kHypodermicDeg = 6;  // a bevel of 12 degrees
constexpr double kSpinalDeg = 12;     // Quincke's medium bevel, Whitacre's pencil point

constexpr NeedlePreset tube(const char* name, double outer_mm, double inner_mm, double length_mm) {
  return {name, outer_mm, inner_mm, length_mm, kSteel, "conical", kConeDeg, "tube of its gauge"};
}

constexpr NeedlePreset like(NeedlePreset tube, const char* name, double length_mm, const char* tip,
                            double half_angle_deg, const char* what) {
  tube.name = name;
  tube.length_mm = length_mm;
  tube.tip = tip;
  tube.half_angle_deg = half_angle_deg;
  tube.what = what;
  return tube;
}

constexpr NeedlePreset hypodermic(NeedlePreset tube, const char* name) {
  return like(tube, name, tube.length_mm, "bevel", kHypodermicDeg, "hypodermic bevel, 12 degrees");
}

constexpr NeedlePreset wire(const char* name, double outer_mm) {
  return {name, outer_mm, 0, 200, kNitinol, "conical", kConeDeg, "nitinol wire"};
}

constexpr NeedlePreset k17 = tube("17G", 1.473, 1.067, 90);
constexpr NeedlePreset k18 = tube("18G", 1.270, 0.838, 150);
constexpr NeedlePreset k19 = tube("19G", 1.067, 0.686, 90);
constexpr NeedlePreset k20 = tube("20G", 0.9081, 0.603, 150);
constexpr NeedlePreset k21 = tube("21G", 0.8192, 0.514, 150);
constexpr NeedlePreset k22 = tube("22G", 0.7176, 0.413, 150);
constexpr NeedlePreset k23 = tube("23G", 0.6414, 0.337, 150);
constexpr NeedlePreset k24 = tube("24G", 0.5652, 0.311, 90);
constexpr NeedlePreset k25 = tube("25G", 0.5144, 0.260, 90);
constexpr NeedlePreset k26 = tube("26G", 0.4636, 0.260, 90);
constexpr NeedlePreset k27 = tube("27G", 0.4128, 0.210, 90);
constexpr const char* kQuincke = "spinal, Quincke's bevel";
constexpr const char* kWhitacre = "spinal, Whitacre's pencil point";
constexpr const char* kTuohy = "epidural, Tuohy's curved tip";
constexpr const char* kBiopsy = "core biopsy, as a gun fires it; without its stylet";

constexpr std::array kNeedles = {
    k17, k18, k19, k20, k21, k22, k23, k24, k25, k26, k27, hypodermic(k17, "17G-bevel"),
    hypodermic(k18, "18G-bevel"), hypodermic(k19, "19G-bevel"), hypodermic(k20, "20G-bevel"),
    hypodermic(k21, "21G-bevel"), hypodermic(k22, "22G-bevel"), hypodermic(k23, "23G-bevel"),
    hypodermic(k24, "24G-bevel"), hypodermic(k25, "25G-bevel"), hypodermic(k26, "26G-bevel"),
    hypodermic(k27, "27G-bevel"), like(k22, "22G-quincke", 90, "bevel", kSpinalDeg, kQuincke),
    like(k25, "25G-quincke", 90, "bevel", kSpinalDeg, kQuincke),
    like(k27, "27G-quincke", 90, "bevel", kSpinalDeg, kQuincke),
    like(k22, "22G-whitacre", 90, "pencil", kSpinalDeg, kWhitacre),
    like(k25, "25G-whitacre", 90, "pencil", kSpinalDeg, kWhitacre),
    like(k27, "27G-whitacre", 90, "pencil", kSpinalDeg, kWhitacre),
    like(k17, "17G-tuohy", 90, "tuohy", kConeDeg, kTuohy),
    like(k18, "18G-tuohy", 90, "tuohy", kConeDeg, kTuohy),
    like(k18, "18G-biopsy", 200, "bevel", 10, kBiopsy),
    like(tube("14G", 2.108, 1.600, 160), "14G-biopsy", 160, "bevel", 10, kBiopsy),
    // Thin wall, for seeds of 0.8 mm.
    like(tube("18G", 1.270, 1.000, 200), "18G-brachytherapy", 200, "bevel", 10,
         "brachytherapy, for seeds of 0.8 mm"),
    like(tube("trocar", 3.0, 0, 100), "trocar-3mm", 100, "diamond", 20,
         "trocar with its obturator, a pyramid"),
    wire("nitinol-0.46", 0.46), wire("nitinol-0.58", 0.58), wire("nitinol-0.70", 0.70),
    wire("nitinol-1.0", 1.0)};

template <typename Table>
auto* found(const Table& table, std::string_view name) {
  for (const auto& each : table) {
    if (name == each.name) return &each;
  }
  return static_cast<decltype(table.data())>(nullptr);
}

}  // namespace

std::span<const TipKind> tip_kinds() {
  return kTips;
}
std::span<const NeedleMaterial> needle_materials() {
  return kMaterials;
}
std::span<const NeedlePreset> needle_presets() {
  return kNeedles;
}
const TipKind* find_tip(std::string_view name) {
  return found(kTips, name);
}
const NeedleMaterial* find_needle_material(std::string_view name) {
  return found(kMaterials, name);
}
const NeedlePreset* find_needle(std::string_view name) {
  return found(kNeedles, name);
}

double bending_nm2(double outer_mm, double inner_mm, double youngs_modulus_gpa) {
  const double outer_m = outer_mm * 1e-3, inner_m = inner_mm * 1e-3;
  const double outer_m2 = outer_m * outer_m, inner_m2 = inner_m * inner_m;
  return youngs_modulus_gpa * 1e9 * kPi / 64 * (outer_m2 * outer_m2 - inner_m2 * inner_m2);
}

double opening_m(double outer_mm, double half_angle_deg) {
  const SineCosine half = sine_cosine(half_angle_deg / 360);
  return 0.25e-3 * outer_mm * half.cosine / half.sine;
}

NeedleConfig needle_of(const NeedlePreset& preset) {
  NeedleConfig config;
  config.length_m = static_cast<float>(preset.length_mm * 1e-3);
  config.outer_radius_m = static_cast<float>(preset.outer_mm * 0.5e-3);
  config.bending_nm2 = static_cast<float>(
      bending_nm2(preset.outer_mm, preset.inner_mm, preset.material.youngs_modulus_gpa));
  config.tip_half_angle_rad = static_cast<float>(preset.half_angle_deg * (kPi / 180));
  config.torn_diameters = static_cast<float>(find_tip(preset.tip)->torn_diameters);
  config.bore_radius_m = static_cast<float>(preset.inner_mm * 0.5e-3);
  config.opening_m = static_cast<float>(opening_m(preset.outer_mm, preset.half_angle_deg));
  if (preset.tip == std::string_view("bevel")) config.bevel_per_m = static_cast<float>(kBevelPerM);
  return config;
}

}  // namespace stylet::hal
