// SPDX-License-Identifier: Apache-2.0
#include "hal/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hal/base/vector.h"
#include "hal/device/devices.h"
#include "hal/scene/bodies.h"
#include "hal/scene/guard.h"
#include "hal/scene/section.h"
#include "stylet/levels.h"
#include "stylet/limits.h"

namespace stylet::hal {
namespace {

void read_loop(Section loop, Scene& scene) {
  const double low_us = std::round(static_cast<double>(kMinPeriodS) * 1e6);
  const double high_us = std::round(static_cast<double>(kMaxPeriodS) * 1e6);
  scene.config.period_s = si(loop.number("period_us", 1000, low_us, high_us), 1e-6);
  const std::string inertia = loop.choice("inertia", "true_mass", {"added_mass", "true_mass"});
  scene.config.inertia = inertia == "true_mass" ? Inertia::kTrueMass : Inertia::kAddedMass;
  // Added mass grows with dt (dt + 2 tau) of the substep: with one substep it is three times that.
  const std::uint32_t substeps = scene.config.inertia == Inertia::kTrueMass ? Config{}.substeps : 2;
  scene.config.substeps =
      static_cast<std::uint32_t>(loop.integer("substeps", substeps, 1, kMaxSubsteps));
  scene.rt_priority = static_cast<int>(loop.integer("rt_priority", 80, 1, 98));
  scene.cpu = static_cast<int>(loop.integer("cpu", -1, -1, 1023));
  scene.threads = static_cast<std::uint32_t>(loop.integer("threads", 1, 1, kMaxHelpers + 1));
  scene.hash_every_ticks =
      static_cast<std::uint32_t>(loop.integer("hash_every_ticks", 1000, 0, 1'000'000));
  loop.finish();
}

void read_approach(Section section, Approach& approach) {
  const auto d = section.numbers<3>("direction", {1, 0, 0}, -1e3, 1e3);
  const double size = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (!(size > 1e-6)) section.fail("direction", "a direction that is not zero");
  approach.direction = si(d, 1 / size);
  if (section.has("through") && section.has("point_mm")) {
    section.fail("through", "either through or point_mm");
  }
  section.choice("through", "centroid", {"centroid"});
  if (section.has("point_mm")) {
    approach.through_m = si(section.numbers<3>("point_mm", {}, -2000, 2000), 1e-3);
  } else {
    (void)section.get("point_mm");
  }
  approach.start_m = si(section.number("start_mm", 10, 0, 500), 1e-3);
  section.finish();
}

// The needle's holder: one of our own kinds, or a device given by its URI.
void read_device_kind(Section& device, Hand& out) {
  if (device.has("uri") && device.has("kind")) device.fail("kind", "either kind or uri");
  out.device = device.choice("kind", "simulated", {"simulated", "steered", "replay"});
  out.replay_path = device.text("recording", "");
  if ((out.device == "replay") == out.replay_path.empty()) {
    device.fail("recording", "a recording to play if kind is \"replay\", and none otherwise");
  }
  const std::string uri = device.text("uri", "");
  if (!device.has("uri")) return;
  if (const std::string fault = device_uri_fault(uri); !fault.empty()) device.fail("uri", fault);
  attach(out, uri);
}

void read_device(Section& device, const Config& config, Hand& out) {
  read_device_kind(device, out);
  out.model = read_device_model(device, config.period_s);
  device.finish();
  out.limits = {out.model.name, out.model.max_force_n, out.model.max_slew_n_per_s,
                out.model.max_stiffness_n_per_m};
  out.hand.device = out.model.motion;
}

// The roll during the motion to `w`, whose position and speed are known.
void read_spin(Section& section, const Waypoint& last, Waypoint& w) {
  w.turns = static_cast<float>(section.number("turns", 0, -10000, 10000));
  w.duty = static_cast<float>(section.number("duty", 1, 0.05, 1));
  if (section.has("duty") && !section.has("turns"))
    section.fail("duty", "this key only with turns");
  const double turns = std::fabs(static_cast<double>(w.turns));
  if (w.duty < 1 && turns != std::floor(turns)) {
    section.fail("turns", "a whole number where duty is below 1");
  }
  const double most = static_cast<double>(kMaxHandleSpinRadPerS) / (2 * std::numbers::pi);
  if (turns > most * static_cast<double>(w.duty) * seconds_between(last, w)) {
    section.fail(
        "turns",
        fmt::format(
            "at most {:.2f} for each second of rolling, which is duty times the time of the motion",
            most));
  }
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
  const double most_n = static_cast<double>(kMaxPlungerN);
  w.plunger_n = static_cast<float>(
      section.number("plunger_n", static_cast<double>(last.plunger_n), -most_n, most_n));
  const bool moves = section.has("travel_mm") || section.has("lateral_mm") || section.has("turns");
  const int paces = (section.has("speed_mm_s") ? 1 : 0) + (section.has("time_s") ? 1 : 0);
  if (moves && paces != 1) {
    section.fail("speed_mm_s", "either speed_mm_s or time_s, because this waypoint moves");
  }
  if (!moves && paces != 0)
    section.fail("travel_mm", "a place to go to, because this waypoint has speed_mm_s or time_s");
  read_spin(section, last, w);
  section.finish();
  return w;
}

void read_hand(Section section, bool held, Hand& out) {
  out.hand.mass_kg = si(section.number("mass_g", 200, 1, 1e5), 1e-3);
  out.hand.stiffness_n_per_m =
      static_cast<float>(section.number("stiffness_n_per_m", 2000, 1, 1e7));
  out.hand.damping_n_s_per_m = static_cast<float>(section.number("damping_n_s_per_m", 30, 0, 1e5));
  Waypoint last;
  last.travel_m = -out.approach.start_m;
  for (Section& each : section.tables("waypoint")) {
    last = read_waypoint(each, last);
    out.waypoints.push_back(last);
  }
  if (out.device == "simulated" && out.waypoints.empty() && !held) {
    section.fail("waypoint", "at least one [[hand.waypoint]] for the simulated hand to follow");
  }
  section.finish();
}

// Read only for device "steered", which needs it.
void read_steering(Section section, const NeedleConfig& needle, Hand& out) {
  SteeringConfig& steering = out.steering;
  const bool steered = out.device == "steered";
  if (steered != section.has("target_mm")) {
    section.fail("target_mm",
                 "a point [x, y, z] to reach if device.kind is \"steered\", and none otherwise");
  }
  for (const auto& via : section.points("via_mm", 1, 16, -2000, 2000)) {
    steering.targets_m.push_back(si(via, 1e-3));
  }
  steering.targets_m.push_back(si(section.numbers<3>("target_mm", {}, -2000, 2000), 1e-3));
  steering.speed_m_per_s = si(section.number("speed_mm_per_s", 5, 0.01, 1000), 1e-3);
  const float bevel_per_m = needle.bevel_per_m;
  if (steered && !(bevel_per_m > 0) && !section.has("curvature_per_m")) {
    section.fail("curvature_per_m",
                 "a curvature of the path, because the needle's tip has no bevel that gives it");
  }
  steering.curvature_per_m = static_cast<float>(
      section.number("curvature_per_m", static_cast<double>(bevel_per_m), 0.01, 100));
  steering.lag_m = si(section.number("lag_mm", 30, 0, 200), 1e-3);
  steering.roll_rad_per_s =
      si(section.number("roll_deg_per_s", 720, 1, 3000), std::numbers::pi / 180);
  steering.hold_s = static_cast<float>(section.number("hold_s", 1, 0, 3600));
  section.finish();
}

void read_grip(Section section, const Config& config, const NeedleConfig& needle, Hand& out) {
  GripConfig& grip = out.grip;
  grip.enabled = grip.enabled || section.there();
  grip.period_s = config.period_s;
  grip.motion_scale = static_cast<float>(section.number("motion_scale", 1, 0.05, 20));
  grip.force_scale = static_cast<float>(section.number("force_scale", 1, 0.05, 20));
  grip.turn = turned(section.numbers<3>("turn_deg", {}, -360, 360));
  grip.clutch_button =
      static_cast<std::int32_t>(section.integer("clutch_button", kNoButton, kNoButton, 31));
  grip.plunger_button =
      static_cast<std::int32_t>(section.integer("plunger_button", kNoButton, kNoButton, 31));
  const double most_n = static_cast<double>(kMaxPlungerN);
  grip.plunger_n = static_cast<float>(section.number("plunger_n", 10, -most_n, most_n));
  const auto box = section.points("box_mm", 2, 2, -2000, 2000);
  if (!box.empty()) {
    grip.box_low_m = si(box[0], 1e-3);
    grip.box_high_m = si(box[1], 1e-3);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(box[0][i] <= 0 && box[1][i] >= 0)) {
        section.fail("box_mm",
                     "two corners [[low, low, low], [high, high, high]] with the start, "
                     "[0, 0, 0], between them");
      }
    }
  }
  grip.pivots = section.flag("pivot", false);
  grip.pivot_depth_m = out.approach.start_m + needle.length_m;
  section.finish();
}

// All tables except the needle's own, from the top of the file or from one of [[needles]].
Hand read_hand_of(Section& owner, const Config& config, const NeedleConfig& needle, bool held) {
  Hand hand;
  read_approach(owner.table("approach"), hand.approach);
  Section device = owner.table("device");
  read_device(device, config, hand);
  hand.guard = read_guard(owner.table("guard"), device, hand.model, config.period_s);
  const std::int32_t button = hand.guard.dead_man_button;
  if (button >= 0) hand.hand.held_buttons = 1U << static_cast<std::uint32_t>(button);
  read_grip(owner.table("mapping"), config, needle, hand);
  hand.coupling = read_coupling(owner.table("coupling"), hand.model, hand.guard, hand.grip);
  read_hand(owner.table("hand"), held, hand);
  read_steering(owner.table("steering"), needle, hand);
  return hand;
}

// Either one needle, with all its tables at the top, or [[needles]], each with its own tables.
void read_needles(Section& root, std::size_t held, Scene& scene) {
  if (!root.has("needles")) {
    Section needle = root.table("needle");
    scene.config.needle[0] = read_needle(needle);
    needle.finish();
    scene.hands = {read_hand_of(root, scene.config, scene.config.needle[0], held > 0)};
    return;
  }
  scene.hands.clear();
  for (Section& each : root.tables("needles")) {
    if (scene.hands.size() == kMaxNeedles) {
      each.fail("gauge", fmt::format("at most {} needles", kMaxNeedles));
    }
    NeedleConfig& needle = scene.config.needle[scene.hands.size()];
    needle = read_needle(each);
    const bool by_device = scene.hands.size() < held;
    scene.hands.push_back(read_hand_of(each, scene.config, needle, by_device));
    each.finish();
  }
  if (scene.hands.empty()) root.fail("needles", "at least one [[needles]]");
  scene.config.needle_count = static_cast<std::uint32_t>(scene.hands.size());
}

Vec3 voxel_centroid(const Organ& organ) {
  double sum[3] = {}, weight = 0;
  std::size_t voxel = 0;
  for (const OrganRun& run : organ.runs) {
    const std::uint32_t level = level_of(organ.level_planes, run.z);
    const std::uint32_t z = run.z - first_plane(organ.level_planes, level);
    const auto ratio = static_cast<double>(edge_ratio(level));
    for (std::uint32_t i = 0; i < run.count; ++i, ++voxel) {
      const double volume = organ.voxel_fill[voxel] * ratio * ratio * ratio;
      sum[0] += volume * (run.x + i + 0.5) * ratio;
      sum[1] += volume * (run.y % organ.sheet_rows + 0.5) * ratio;
      sum[2] += volume * (z + 0.5) * ratio;
      weight += volume;
    }
  }
  const double edge = static_cast<double>(organ.voxel_edge_m) / weight;
  return {organ.origin_m.x + si(sum[0], edge), organ.origin_m.y + si(sum[1], edge),
          organ.origin_m.z + si(sum[2], edge)};
}

}  // namespace

void attach(Hand& hand, const std::string& uri) {
  hand.device = "attached";
  hand.uri = uri;
  hand.grip.enabled = true;
}

Scene parse_scene(std::string_view text, const std::string& file, std::size_t held) {
  Scene scene;
  scene.file = file;
  scene.text = text;
  const toml::table root_table = parse_toml(text, file);
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
  scene.config.paper_alpha = static_cast<float>(paper.number("alpha", 0.5, 0.001, 1));
  paper.finish();
  scene.config.breathing = read_breathing(root.table("breathing"));
  scene.config.gravity_m_per_s2 = read_gravity(root.table("gravity"));
  scene.obstacles = read_obstacles(root.tables("obstacles"), file, scene.hulls);
  scene.targets = read_targets(root.tables("targets"));
  read_needles(root, held, scene);
  root.finish();
  return scene;
}

std::vector<Target> parse_targets(std::string_view text, const std::string& file) {
  const toml::table table = parse_toml(text, file);
  return read_targets(Section(file, &table, "").tables("targets"));
}

Scene read_scene(const std::string& path, std::size_t held) {
  return parse_scene(read_text(path, "a scene"), path, held);
}

Placement place_needle(const Scene& scene, const Organ& organ, std::uint32_t needle) {
  const Approach& approach = scene.hands[needle].approach;
  const Vec3 through = approach.through_m.value_or(voxel_centroid(organ));
  const Vec3 direction = approach.direction;
  // Far enough to be outside in every direction: farther than the lattice is wide.
  const float cells = static_cast<float>(organ.size_x) + static_cast<float>(organ.size_y) +
                      static_cast<float>(organ.level_planes << (organ.levels - 1U));
  const float finest_m = organ.voxel_edge_m * edge_ratio(organ.levels - 1U);
  const float away = cells * finest_m + std::fabs(through.x - organ.origin_m.x) +
                     std::fabs(through.y - organ.origin_m.y) +
                     std::fabs(through.z - organ.origin_m.z);
  const Vec3 outside = through - away * direction;
  float distance = 0;
  if (!organ_raycast(organ, outside, direction, distance)) {
    throw SceneError(fmt::format(
        "{}: approach: ({:g}, {:g}, {:g}) mm: expected a line along direction that meets the organ "
        "\"{}\"",
        scene.file, static_cast<double>(through.x) * 1e3, static_cast<double>(through.y) * 1e3,
        static_cast<double>(through.z) * 1e3, organ.name));
  }
  Placement placement;
  placement.course = {outside + distance * direction, direction};
  placement.mapping.rotation = needle_rotation(direction);
  const float back_m = approach.start_m + scene.config.needle[needle].length_m;
  placement.mapping.origin_m = placement.course.entry_m - back_m * direction;
  return placement;
}

}  // namespace stylet::hal
