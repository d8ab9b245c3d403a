// SPDX-License-Identifier: Apache-2.0
#include "hal/scene/bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "hal/base/angle.h"
#include "hal/base/needles.h"
#include "hal/base/rotation.h"
#include "stylet/limits.h"

namespace stylet::hal {
namespace {

double in_mm(float metres) {
  return std::round(static_cast<double>(metres) * 1e3);
}

template <typename Table>
std::vector<const char*> names_of(const Table& table) {
  std::vector<const char*> names;
  for (const auto& each : table) names.push_back(each.name);
  return names;
}

// A needle by its name, with the scene's own diameters and modulus where it has any.
NeedlePreset read_gauge(Section& needle) {
  const char* key = needle.has("preset") ? "preset" : "gauge";  // two names of one key
  if (needle.has("gauge") && needle.has("preset")) needle.fail("preset", "either gauge or preset");
  (void)needle.get("gauge");
  (void)needle.get("preset");
  if (needle.has("od_mm") && needle.has(key)) needle.fail(key, "either gauge or od_mm");
  if (!needle.has("od_mm") && needle.has("id_mm")) {
    needle.fail("id_mm", "this key only with od_mm, because a gauge has its own");
  }
  NeedlePreset gauge = *find_needle(needle.choice(key, "18G", names_of(needle_presets())));
  if (needle.has("od_mm")) gauge.inner_mm = 0;
  gauge.outer_mm = needle.number("od_mm", gauge.outer_mm, 0.05, 10);
  gauge.inner_mm = needle.number("id_mm", gauge.inner_mm, 0, 0.99 * gauge.outer_mm);
  if (needle.has("material")) {
    gauge.material = *find_needle_material(
        needle.choice("material", gauge.material.name, names_of(needle_materials())));
  }
  (void)needle.get("material");
  double& modulus_gpa = gauge.material.youngs_modulus_gpa;
  modulus_gpa = needle.number("e_gpa", modulus_gpa, 0.01, 500);
  return gauge;
}

// Keys for one kind of tip are refused with another kind, as they would do nothing.
void read_tip(Section& needle, const NeedlePreset& preset, NeedleConfig& config) {
  config.tip_half_angle_rad =
      si(needle.number("half_angle_deg", preset.half_angle_deg, 5, 80), std::numbers::pi / 180);
  const std::string tip = needle.choice("tip", preset.tip, names_of(tip_kinds()));
  config.torn_diameters = static_cast<float>(needle.number(
      "torn_diameters", find_tip(tip)->torn_diameters, static_cast<double>(kMinTornDiameters),
      static_cast<double>(kMaxTornDiameters)));
  if (tip != "bevel" && needle.has("curvature_per_m")) {
    needle.fail("curvature_per_m", "this key only with tip = \"bevel\"");
  }
  for (const char* key : {"bent_length_mm", "bent_angle_deg"}) {
    if (tip != "bent" && needle.has(key)) needle.fail(key, "this key only with tip = \"bent\"");
    (void)needle.get(key);
  }
  const double curvature =
      needle.number("curvature_per_m", kBevelPerM, 0.01, static_cast<double>(kMaxBevelPerM));
  if (tip == "bevel") config.bevel_per_m = static_cast<float>(curvature);
  if (tip != "bent") return;
  config.bent_length_m =
      si(needle.needed_number("bent_length_mm", 0.1, in_mm(config.length_m)), 1e-3);
  config.bent_angle_rad =
      si(needle.needed_number("bent_angle_deg", 0.1, 57), std::numbers::pi / 180);
}

// What flows through the needle. Keys of a part that it does not have are refused.
void read_hub(Section& needle, const NeedlePreset& gauge, NeedleConfig& config) {
  const std::string hub = needle.choice("hub", "closed", {"closed", "open", "syringe"});
  config.hub = hub == "closed" ? Hub::kClosed : hub == "open" ? Hub::kOpen : Hub::kSyringe;
  for (const char* key : {"opening_mm", "filling_mpa_s"}) {
    if (hub == "closed" && needle.has(key)) needle.fail(key, "this key only with an open hub");
  }
  if (hub != "closed" && !(gauge.inner_mm > 0)) {
    needle.fail("hub", "\"closed\", because the needle is solid: id_mm gives it a bore");
  }
  config.bore_radius_m = si(gauge.inner_mm, 0.5e-3);
  const double half_angle_deg =
      static_cast<double>(config.tip_half_angle_rad) * 180 / std::numbers::pi;
  config.opening_m =
      si(needle.number("opening_mm", 1e3 * opening_m(gauge.outer_mm, half_angle_deg), 0, 20), 1e-3);
  config.filling_pa_s = si(needle.number("filling_mpa_s", 1, 0.01, 1000), 1e-3);
  Section syringe = needle.table("syringe");
  if (hub != "syringe" && syringe.there()) needle.fail("hub", "\"syringe\", as there is a syringe");
  config.plunger_radius_m = si(syringe.number("plunger_mm", 15, 2, 100), 0.5e-3);
  config.plunger_friction_n = static_cast<float>(syringe.number("friction_n", 0.5, 0, 100));
  const double barrel_ml = syringe.number("barrel_ml", 10, 0.01, 1000);
  config.syringe_m3 = si(barrel_ml, 1e-6);
  config.syringe_filled =
      static_cast<float>(syringe.number("filled_ml", 0.5 * barrel_ml, 0, barrel_ml) / barrel_ml);
  config.syringe_gas_m3 = si(syringe.number("gas_ml", 0.05, 0.001, 1000), 1e-6);
  syringe.finish();
}

void read_hull(const std::string& path, ObstacleConfig& config) {
  const std::string text = read_text(path, "a hull that stylet-organ hull made");
  const toml::table root = parse_toml(text, path);
  Section hull(path, &root, "");
  for (const char* key : {"source", "sha256"}) (void)hull.text(key, "");
  (void)hull.number("deviation_mm", 0, 0, 1e6);
  const auto points = hull.points("vertices_m", 1, kMaxHullVertices, -2, 2);
  if (points.empty()) hull.fail("vertices_m", "the hull's vertices");
  hull.finish();
  config.vertex_count = static_cast<std::uint32_t>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) config.vertices_m[i] = si(points[i], 1);
}

void read_shape(Section& section, const std::string& scene_file, ObstacleConfig& config,
                std::vector<std::string>& hulls_out) {
  const std::string shape = section.choice("shape", "", {"box", "sphere", "hull"});
  const std::array<std::array<const char*, 2>, 3> sizes = {
      {{"box", "size_mm"}, {"sphere", "radius_mm"}, {"hull", "hull"}}};
  for (const auto& [of, key] : sizes) {
    if (shape != of && section.has(key)) {
      section.fail(key, fmt::format("this key only with shape = \"{}\"", of));
    }
    if (shape == of && !section.has(key)) {
      section.fail(key, fmt::format("this key, as shape is \"{}\"", of));
    }
    (void)section.get(key);
  }
  if (shape == "box") make_box(config, si(section.numbers<3>("size_mm", {}, 0.1, 1000), 0.5e-3));
  if (shape == "sphere") make_sphere(config, si(section.number("radius_mm", 0, 0.05, 1000), 1e-3));
  if (shape == "hull") {
    const std::filesystem::path folder = std::filesystem::path(scene_file).parent_path();
    hulls_out.push_back((folder / section.text("hull", "")).string());
    read_hull(hulls_out.back(), config);
  }
}

ObstacleConfig read_obstacle(Section section, const std::string& scene_file,
                             std::vector<std::string>& hulls_out) {
  ObstacleConfig config;
  read_shape(section, scene_file, config, hulls_out);
  if (!section.has("at_mm")) section.fail("at_mm", "a list of 3 numbers: where the body is");
  config.pose.position_m = si(section.numbers<3>("at_mm", {}, -1000, 1000), 1e-3);
  config.pose.rotation = turned(section.numbers<3>("turn_deg", {}, -360, 360));
  const auto number = [&](const char* key, double unit, float& value, double low, double high) {
    value = si(section.number(key, static_cast<double>(value) / unit, low, high), unit);
  };
  number("stiffness_n_per_mm", 1e3, config.stiffness_n_per_m, 1e-3, 1000);
  number("largest_force_n", 1, config.largest_force_n, 0.01, 1000);
  number("friction", 1, config.friction, 0, 2);
  section.finish();
  return config;
}

Target read_target(Section section) {
  constexpr std::size_t kLongestName = 40;
  Target target;
  target.name = section.text("name", "");
  const auto control = [](unsigned char c) { return c < ' ' || c == 127; };
  if (target.name.empty() || target.name.size() > kLongestName ||
      std::any_of(target.name.begin(), target.name.end(), control)) {
    section.fail("name", fmt::format("a text of 1 to {} bytes in one line", kLongestName));
  }
  if (!section.has("at_mm")) section.fail("at_mm", "a list of 3 numbers: where its middle is");
  target.position_m = si(section.numbers<3>("at_mm", {}, -2000, 2000), 1e-3);
  target.radius_m = si(section.needed_number("radius_mm", 0.1, 1000), 1e-3);
  target.forbidden = section.flag("forbidden", false);
  section.finish();
  return target;
}

}  // namespace

Quat turned(const std::array<double, 3>& degrees) {
  Quat result = {1, 0, 0, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const SineCosine half = sine_cosine(degrees[axis] / 720);
    const float s = static_cast<float>(half.sine);
    result = product(
        {static_cast<float>(half.cosine), axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0},
        result);
  }
  return result;
}

NeedleConfig read_needle(Section& needle) {
  NeedleConfig config;
  const NeedlePreset gauge = read_gauge(needle);
  const double stiffness_nm2 =
      bending_nm2(gauge.outer_mm, gauge.inner_mm, gauge.material.youngs_modulus_gpa);
  config.outer_radius_m = si(gauge.outer_mm, 0.5e-3);
  config.length_m =
      si(needle.number("length_mm", gauge.length_mm, 1, in_mm(kMaxNeedleLengthM)), 1e-3);
  config.unit_m = si(needle.number("unit_mm", 5, 0.1, 50), 1e-3);
  if (needle.flag("flexible", false)) config.bending_nm2 = static_cast<float>(stiffness_nm2);
  // GJ = E 2 I / (2 (1 + nu)), nu 0.3 for steel and nitinol.
  if (needle.flag("roll_lag", false)) {
    config.torsion_nm2 = static_cast<float>(stiffness_nm2 / 1.3);
  }
  config.rods = static_cast<std::uint32_t>(needle.integer("rods", config.rods, 1, kMaxRods));
  read_tip(needle, gauge, config);
  read_hub(needle, gauge, config);
  return config;
}

std::vector<ObstacleConfig> read_obstacles(std::vector<Section> sections,
                                           const std::string& scene_file,
                                           std::vector<std::string>& hulls_out) {
  std::vector<ObstacleConfig> obstacles;
  for (Section& each : sections) {
    if (obstacles.size() == kMaxObstacles) {
      each.fail("shape", fmt::format("at most {} obstacles", kMaxObstacles));
    }
    obstacles.push_back(read_obstacle(each, scene_file, hulls_out));
  }
  return obstacles;
}

std::vector<Target> read_targets(std::vector<Section> sections) {
  std::vector<Target> targets;
  for (Section& each : sections) {
    if (targets.size() == kMaxTargets) {
      each.fail("name", fmt::format("at most {} targets", kMaxTargets));
    }
    targets.push_back(read_target(each));
    const std::string& name = targets.back().name;
    const auto same = [&name](const Target& other) { return other.name == name; };
    if (std::count_if(targets.begin(), targets.end(), same) > 1) {
      each.fail("name", "a name that no target before it has");
    }
  }
  return targets;
}

BreathingConfig read_breathing(Section breathing) {
  BreathingConfig config;
  const double most = in_mm(kMaxBreathM);
  const auto a = breathing.numbers<3>("amplitude_mm", {}, -most, most);
  if (a[0] * a[0] + a[1] * a[1] + a[2] * a[2] > most * most) {
    breathing.fail("amplitude_mm", fmt::format("a way of at most {} mm", most));
  }
  config.amplitude_m = si(a, 1e-3);
  config.period_s = static_cast<float>(breathing.number("period_s", 4, 0.1, 1000));
  if (breathing.has("period_s") && !breathing.has("amplitude_mm")) {
    breathing.fail("amplitude_mm", "a list of 3 numbers: how far the attachments move");
  }
  breathing.finish();
  return config;
}

Vec3 read_gravity(Section gravity) {
  constexpr double kMost = static_cast<double>(kMaxGravityMPerS2);
  const auto now = gravity.numbers<3>("now_m_per_s2", {}, -kMost, kMost);
  const auto at_rest = gravity.numbers<3>("at_rest_m_per_s2", {}, -kMost, kMost);
  if (gravity.has("at_rest_m_per_s2") && !gravity.has("now_m_per_s2")) {
    gravity.fail("now_m_per_s2", "a list of 3 numbers: the gravity that acts");
  }
  std::array<double, 3> change = now;
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    change[i] -= at_rest[i];
    square += change[i] * change[i];
  }
  if (square > kMost * kMost) {
    gravity.fail("now_m_per_s2", fmt::format("at most {} from at_rest_m_per_s2", kMost));
  }
  gravity.finish();
  return si(change, 1);
}

}  // namespace stylet::hal
