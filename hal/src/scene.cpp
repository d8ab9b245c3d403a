// SPDX-License-Identifier: Apache-2.0
#include "stylet/hal/scene.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <set>
#include <sstream>

#include "stylet/limits.h"

namespace stylet::hal {
namespace {

struct Preset {
  const char* name;
  double outer_diameter_mm;
};
// Regular wall, from the usual gauge table.
constexpr std::array kPresets = {Preset{"17G", 1.473}, Preset{"18G", 1.270}, Preset{"20G", 0.9081},
                                 Preset{"22G", 0.7176}, Preset{"25G", 0.5144}};

std::string value_text(const toml::node& node) {
  std::ostringstream out;
  node.visit([&out](const auto& n) { out << n; });
  return out.str();
}

// One table of the file. Reads keys by name and remembers them, so that finish() finds the others.
class Section {
 public:
  Section(const std::string& file, const toml::table* table, std::string name)
      : file_(file), table_(table), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string& key, const std::string& allowed) const {
    const toml::node* node = find(key);
    const auto line = node != nullptr     ? node->source().begin.line
                      : table_ != nullptr ? table_->source().begin.line
                                          : 1U;
    throw SceneError(fmt::format("{}:{}: {}: {}: {}", file_, line, full(key),
                                 node != nullptr ? value_text(*node) : "missing", allowed));
  }

  bool has(const std::string& key) const { return find(key) != nullptr; }

  const toml::node* get(const std::string& key) {
    known_.insert(key);
    return find(key);
  }

  double number(const std::string& key, double fallback, double low, double high) {
    const toml::node* node = get(key);
    if (node == nullptr) return fallback;
    return checked(key, *node, low, high);
  }

  std::int64_t integer(const std::string& key, std::int64_t fallback, std::int64_t low,
                       std::int64_t high) {
    const toml::node* node = get(key);
    if (node == nullptr) return fallback;
    const auto value = node->value_exact<std::int64_t>();
    if (!value || *value < low || *value > high) {
      fail(key, fmt::format("a whole number from {} to {}", low, high));
    }
    return *value;
  }

  std::string text(const std::string& key, const std::string& fallback) {
    const toml::node* node = get(key);
    if (node == nullptr) return fallback;
    const auto value = node->value_exact<std::string>();
    if (!value) fail(key, "a text in quotes");
    return *value;
  }

  std::string choice(const std::string& key, const std::string& fallback,
                     std::initializer_list<const char*> allowed) {
    const std::string value = text(key, fallback);
    std::string all;
    for (const char* each : allowed) {
      if (value == each) return value;
      all += fmt::format("{}\"{}\"", all.empty() ? "" : " or ", each);
    }
    fail(key, all);
  }

  template <std::size_t N>
  std::array<double, N> numbers(const std::string& key, std::array<double, N> fallback, double low,
                                double high) {
    const toml::node* node = get(key);
    if (node == nullptr) return fallback;
    const toml::array* list = node->as_array();
    if (list == nullptr || list->size() != N) fail(key, fmt::format("a list of {} numbers", N));
    std::array<double, N> values{};
    for (std::size_t i = 0; i < N; ++i) values[i] = checked(key, *list->get(i), low, high);
    return values;
  }

  Section table(const std::string& key) {
    const toml::node* node = get(key);
    if (node != nullptr && !node->is_table()) fail(key, "a table");
    return {file_, node != nullptr ? node->as_table() : nullptr, full(key)};
  }

  std::vector<Section> tables(const std::string& key) {
    std::vector<Section> list;
    const toml::node* node = get(key);
    if (node == nullptr) return list;
    if (!node->is_array_of_tables())
      fail(key, fmt::format("tables, each headed [[{}]]", full(key)));
    for (const toml::node& each : *node->as_array()) {
      list.emplace_back(file_, each.as_table(), full(key));
    }
    return list;
  }

  // Every key of the table must have been asked for.
  void finish() const {
    if (table_ == nullptr) return;
    for (const auto& [key, node] : *table_) {
      if (known_.count(std::string(key.str())) == 0) {
        std::string all;
        for (const std::string& each : known_) all += (all.empty() ? "" : ", ") + each;
        fail(std::string(key.str()), "unknown key; allowed here: " + all);
      }
    }
  }

 private:
  const toml::node* find(const std::string& key) const {
    return table_ != nullptr ? table_->get(key) : nullptr;
  }
  std::string full(const std::string& key) const { return name_.empty() ? key : name_ + "." + key; }

  double checked(const std::string& key, const toml::node& node, double low, double high) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= low && *value <= high)) {
      fail(key, fmt::format("a number from {} to {}", low, high));
    }
    return *value;
  }

  const std::string& file_;
  const toml::table* table_;
  std::string name_;
  std::set<std::string> known_;
};

float si(double value, double unit) {
  return static_cast<float>(value * unit);
}

void read_loop(Section loop, Scene& scene) {
  const double low_us = std::round(static_cast<double>(kMinPeriodS) * 1e6);
  const double high_us = std::round(static_cast<double>(kMaxPeriodS) * 1e6);
  scene.config.period_s = si(loop.number("period_us", 1000, low_us, high_us), 1e-6);
  scene.config.substeps =
      static_cast<std::uint32_t>(loop.integer("substeps", Config{}.substeps, 1, kMaxSubsteps));
  scene.rt_priority = static_cast<int>(loop.integer("rt_priority", 80, 1, 98));
  scene.cpu = static_cast<int>(loop.integer("cpu", -1, -1, 1023));
  scene.hash_every_ticks =
      static_cast<std::uint32_t>(loop.integer("hash_every_ticks", 1000, 0, 1'000'000));
  loop.finish();
}

void read_needle(Section needle, NeedleConfig& config) {
  if (needle.has("preset") && needle.has("outer_diameter_mm")) {
    needle.fail("preset", "either preset or outer_diameter_mm");
  }
  const std::string preset = needle.choice("preset", "18G", {"17G", "18G", "20G", "22G", "25G"});
  double outer_mm = 0;
  for (const Preset& each : kPresets) {
    if (preset == each.name) outer_mm = each.outer_diameter_mm;
  }
  outer_mm = needle.number("outer_diameter_mm", outer_mm, 0.05, 10);
  config.outer_radius_m = si(outer_mm, 0.5e-3);
  const double max_mm = std::round(static_cast<double>(kMaxNeedleLengthM) * 1e3);
  config.length_m = si(needle.number("length_mm", 150, 1, max_mm), 1e-3);
  config.unit_m = si(needle.number("unit_mm", 5, 0.1, 100), 1e-3);
  needle.finish();
}

void read_approach(Section section, Approach& approach) {
  const auto d = section.numbers<3>("direction", {1, 0, 0}, -1e3, 1e3);
  const double size = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (!(size > 1e-6)) section.fail("direction", "a direction that is not zero");
  approach.direction = {si(d[0], 1 / size), si(d[1], 1 / size), si(d[2], 1 / size)};
  if (section.has("through") && section.has("point_mm")) {
    section.fail("through", "either through or point_mm");
  }
  section.choice("through", "centroid", {"centroid"});
  if (section.has("point_mm")) {
    const auto p = section.numbers<3>("point_mm", {}, -2000, 2000);
    approach.through_m = Vec3{si(p[0], 1e-3), si(p[1], 1e-3), si(p[2], 1e-3)};
  } else {
    (void)section.get("point_mm");
  }
  approach.start_m = si(section.number("start_mm", 10, 0, 500), 1e-3);
  section.finish();
}

void read_guard(Section device, Section guard, Scene& scene) {
  scene.device = device.choice("kind", "simulated", {"simulated", "replay"});
  scene.replay_path = device.text("recording", "");
  if ((scene.device == "replay") == scene.replay_path.empty()) {
    device.fail("recording", "a recording to play, with kind = \"replay\" and only there");
  }
  const double device_force = device.number("max_force_n", 8, 0.01, 100);
  const double device_slew = device.number("max_slew_n_per_s", 2000, 1, 1e6);
  device.finish();
  const double force = std::min(device_force, guard.number("max_force_n", device_force, 0.01, 100));
  const double slew = std::min(device_slew, guard.number("max_slew_n_per_s", device_slew, 1, 1e6));
  const double slew_needed = force / static_cast<double>(kDecayS);
  if (slew < slew_needed) {
    Section& named = guard.has("max_slew_n_per_s") ? guard : device;
    named.fail("max_slew_n_per_s",
               fmt::format("at least {:g} (max_force_n / {:g} s, so that a fault can fade in time)",
                           slew_needed, static_cast<double>(kDecayS)));
  }
  scene.limits = {"device", static_cast<float>(device_force), static_cast<float>(device_slew)};
  scene.guard.period_s = scene.config.period_s;
  scene.guard.max_force_n = static_cast<float>(force);
  scene.guard.max_slew_n_per_s = static_cast<float>(slew);
  scene.guard.ramp_s = si(guard.number("ramp_ms", 500, 0, 10000), 1e-3);
  scene.guard.watchdog_s = si(guard.number("watchdog_ms", 3, 1, 5), 1e-3);
  guard.finish();
}

Waypoint read_waypoint(Section section, const Waypoint& last) {
  Waypoint w;
  w.travel_m =
      si(section.number("travel_mm", static_cast<double>(last.travel_m) * 1e3, -500, 500), 1e-3);
  const auto lateral = section.numbers<2>(
      "lateral_mm", {static_cast<double>(last.right_m) * 1e3, static_cast<double>(last.up_m) * 1e3},
      -500, 500);
  w.right_m = si(lateral[0], 1e-3);
  w.up_m = si(lateral[1], 1e-3);
  w.speed_m_per_s = si(section.number("speed_mm_s", 0, 0.001, 5000), 1e-3);
  w.time_s = static_cast<float>(section.number("time_s", 0, 0, 3600));
  w.hold_s = static_cast<float>(section.number("hold_s", 0, 0, 3600));
  const bool moves = section.has("travel_mm") || section.has("lateral_mm");
  const int paces = (section.has("speed_mm_s") ? 1 : 0) + (section.has("time_s") ? 1 : 0);
  if (moves && paces != 1) {
    section.fail("speed_mm_s", "a waypoint that moves has either speed_mm_s or time_s");
  }
  if (!moves && paces != 0) section.fail("travel_mm", "a waypoint with a pace needs a place to go");
  section.finish();
  return w;
}

void read_hand(Section section, Scene& scene) {
  scene.hand.mass_kg = si(section.number("mass_g", 200, 1, 1e5), 1e-3);
  scene.hand.stiffness_n_per_m =
      static_cast<float>(section.number("stiffness_n_per_m", 2000, 1, 1e7));
  scene.hand.damping_n_s_per_m =
      static_cast<float>(section.number("damping_n_s_per_m", 30, 0, 1e5));
  Waypoint last;
  last.travel_m = -scene.approach.start_m;
  for (Section& each : section.tables("waypoint")) {
    last = read_waypoint(each, last);
    scene.waypoints.push_back(last);
  }
  if (scene.device == "simulated" && scene.waypoints.empty()) {
    section.fail("waypoint", "at least one [[hand.waypoint]] for the simulated hand to follow");
  }
  section.finish();
}

Vec3 voxel_centroid(const Organ& organ) {
  double sum[3] = {}, weight = 0;
  std::size_t voxel = 0;
  for (const OrganRun& run : organ.runs) {
    for (std::uint32_t i = 0; i < run.count; ++i, ++voxel) {
      const double fill = organ.voxel_fill[voxel];
      sum[0] += fill * (run.x + i + 0.5);
      sum[1] += fill * (run.y + 0.5);
      sum[2] += fill * (run.z + 0.5);
      weight += fill;
    }
  }
  const double edge = static_cast<double>(organ.voxel_edge_m) / weight;
  return {organ.origin_m.x + si(sum[0], edge), organ.origin_m.y + si(sum[1], edge),
          organ.origin_m.z + si(sum[2], edge)};
}

Vec3 along(Vec3 start, Vec3 direction, float distance) {
  return {start.x + distance * direction.x, start.y + distance * direction.y,
          start.z + distance * direction.z};
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& file) {
  Scene scene;
  scene.file = file;
  scene.text = text;
  toml::table root_table;
  try {
    root_table = toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw SceneError(
        fmt::format("{}:{}: not TOML: {}", file, error.source().begin.line, error.description()));
  }
  Section root(file, &root_table, "");
  const std::string mode = root.choice("mode", "physical", {"physical", "paper"});
  scene.config.mode = mode == "paper" ? Mode::kPaper : Mode::kPhysical;
  Section organ = root.table("organ");
  scene.organ_path = organ.text("path", "");
  organ.finish();
  read_loop(root.table("loop"), scene);
  Section tissue = root.table("tissue");
  scene.config.tissue_damping_s = si(tissue.number("damping_ms", 0.25, 0, 1000), 1e-3);
  scene.config.surround_drag_per_s =
      static_cast<float>(tissue.number("surround_drag_per_s", 12, 0, 100));
  tissue.finish();
  Section paper = root.table("paper");
  scene.config.paper_alpha = static_cast<float>(paper.number("alpha", 0.5, 0, 1));
  paper.finish();
  read_needle(root.table("needle"), scene.config.needle[0]);
  read_approach(root.table("approach"), scene.approach);
  read_guard(root.table("device"), root.table("guard"), scene);
  read_hand(root.table("hand"), scene);
  root.finish();
  return scene;
}

Scene read_scene(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) {
    throw SceneError(fmt::format("{}: cannot be read: expected a scene (TOML)", path));
  }
  return parse_scene(text.str(), path);
}

Placement place_needle(const Scene& scene, const Organ& organ) {
  const Vec3 through = scene.approach.through_m.value_or(voxel_centroid(organ));
  const Vec3 direction = scene.approach.direction;
  // Far enough out to be outside whatever the direction: further than the lattice is wide.
  const float cells = static_cast<float>(organ.size_x) + static_cast<float>(organ.size_y) +
                      static_cast<float>(organ.size_z);
  const float away = cells * organ.voxel_edge_m + std::fabs(through.x - organ.origin_m.x) +
                     std::fabs(through.y - organ.origin_m.y) +
                     std::fabs(through.z - organ.origin_m.z);
  const Vec3 outside = along(through, direction, -away);
  float distance = 0;
  if (!organ_raycast(organ, outside, direction, distance)) {
    throw SceneError(fmt::format(
        "{}: approach: ({:g}, {:g}, {:g}) mm: a line along direction that meets the organ \"{}\"",
        scene.file, static_cast<double>(through.x) * 1e3, static_cast<double>(through.y) * 1e3,
        static_cast<double>(through.z) * 1e3, organ.name));
  }
  Placement placement;
  placement.entry_m = along(outside, direction, distance);
  placement.direction = direction;
  placement.mapping.rotation = needle_rotation(direction);
  placement.mapping.origin_m = along(placement.entry_m, direction,
                                     -(scene.approach.start_m + scene.config.needle[0].length_m));
  return placement;
}

}  // namespace stylet::hal
