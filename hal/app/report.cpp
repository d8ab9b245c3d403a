// SPDX-License-Identifier: Apache-2.0
#include "hal/app/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "stylet/levels.h"

namespace stylet::app {
namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::pair<const char*, std::uint64_t>>;

std::string hex(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

// Sum over all guards.
hal::GuardCounters guard_counters(const RunReport& report) {
  constexpr std::size_t kCount = sizeof(hal::GuardCounters) / sizeof(std::uint64_t);
  using Numbers = std::array<std::uint64_t, kCount>;
  Numbers sum = {};
  for (const hal::HandState& hand : report.loop->hand) {
    const auto each = std::bit_cast<Numbers>(hand.guard.counters);
    for (std::size_t i = 0; i < kCount; ++i) sum[i] += each[i];
  }
  return std::bit_cast<hal::GuardCounters>(sum);
}

hal::Fault first_fault(const RunReport& report) {
  for (const hal::HandState& hand : report.loop->hand) {
    if (hand.guard.fault != hal::Fault::kNone) return hand.guard.fault;
  }
  return hal::Fault::kNone;
}

// Each counter once, for the table and for the JSON object.
Lines counters(const RunReport& report) {
  const hal::GuardCounters guard = guard_counters(report);
  const Stats& stats = report.stats;
  return {{"input_not_finite", stats.input_not_finite},
          {"input_clamped", stats.input_clamped},
          {"input_missing", stats.input_missing},
          {"cp_pool_full", stats.cp_pool_full},
          {"cp_voxel_pool_full", stats.cp_voxel_pool_full},
          {"contact_budget", stats.contact_budget},
          {"obstacle_pool_full", stats.obstacle_pool_full},
          {"needle_unstable", stats.needle_unstable},
          {"kernel_fault", stats.fault},
          {"samples_used", guard.samples_used},
          {"samples_missing", guard.samples_missing},
          {"samples_repeated", guard.samples_repeated},
          {"samples_lost", guard.samples_lost},
          {"samples_old", guard.samples_old},
          {"samples_not_finite", guard.samples_not_finite},
          {"samples_absurd", guard.samples_absurd},
          {"samples_jumped", guard.samples_jumped},
          {"force_not_finite", guard.force_not_finite},
          {"force_limited", guard.force_limited},
          {"slew_limited", guard.slew_limited},
          {"force_warm", guard.force_warm},
          {"force_damped", guard.force_damped},
          {"guard_faults", guard.faults},
          {"lost_records", report.loop->lost_records.load()},
          {"lost_events", report.loop->lost_events.load()},
          {"lost_processes", report.lost_processes}};
}

Json json_of(const hal::Histogram& histogram) {
  return {{"p50_us", hal::histogram_quantile_us(histogram, 0.5)},
          {"p99_us", hal::histogram_quantile_us(histogram, 0.99)},
          {"p99_9_us", hal::histogram_quantile_us(histogram, 0.999)},
          {"max_us", static_cast<double>(histogram.max_ns) * 1e-3}};
}

Json json_of(const Pool& pool) {
  return {{"used", pool.used}, {"high_water", pool.used_max}, {"capacity", pool.capacity}};
}

Json json_of(const hal::StageRow& row) {
  return {{"name", hal::stage_name(row.stage)},
          {"start_tick", row.start_tick},
          {"end_tick", row.end_tick},
          {"depth_m", json_number(row.depth_m)},
          {"travel_m", json_number(row.travel_m)},
          {"peak_force_n", json_number(row.peak_force_n)},
          {"mean_force_n", json_number(row.mean_force_n)},
          {"start_force_n", json_number(row.start_force_n)},
          {"end_force_n", json_number(row.end_force_n)},
          {"slope_n_per_mm", json_number(row.slope_n_per_mm)},
          {"presliding_m", json_number(row.presliding_m)}};
}

Json json_of(const std::vector<hal::StageRow>& rows) {
  Json list = Json::array();
  for (const hal::StageRow& row : rows) list.push_back(json_of(row));
  return list;
}

Json json_of(const Event& event) {
  return {{"tick", event.tick},
          {"kind", event_name(event.kind)},
          {"layer", event.layer == kNoLayer ? Json(nullptr) : Json(event.layer)},
          {"depth_m", json_number(event.depth_m)},
          {"force_n", json_number(event.force_n)},
          {"needle", event.needle}};
}

Json json_of(const NeedleConfig& needle) {
  return {{"length_m", json_number(needle.length_m)},
          {"outer_radius_m", json_number(needle.outer_radius_m)},
          {"unit_m", json_number(needle.unit_m)},
          {"bending_nm2", json_number(needle.bending_nm2)},
          {"bevel_per_m", json_number(needle.bevel_per_m)},
          {"bent_length_m", json_number(needle.bent_length_m)},
          {"bent_angle_rad", json_number(needle.bent_angle_rad)},
          {"torsion_nm2", json_number(needle.torsion_nm2)},
          {"tip_half_angle_rad", json_number(needle.tip_half_angle_rad)},
          {"torn_diameters", json_number(needle.torn_diameters)},
          {"hub", static_cast<std::uint32_t>(needle.hub)},
          {"bore_radius_m", json_number(needle.bore_radius_m)},
          {"opening_m", json_number(needle.opening_m)}};
}

Json json_of(std::size_t predicted, std::size_t used) {
  return {{"predicted_bytes", predicted}, {"used_bytes", used}};
}

// What a reader looks for in each stage.
std::string remark(std::span<const hal::StageRow> rows, std::size_t i) {
  const hal::StageRow& row = rows[i];
  const bool punctured = i + 1 < rows.size() && rows[i + 1].stage == hal::Stage::kPuncture;
  if (row.stage == hal::Stage::kContact && punctured) {
    return fmt::format("punctured at {:.3f} N, {:.2f} mm in", static_cast<double>(row.end_force_n),
                       static_cast<double>(row.travel_m) * 1e3);
  }
  constexpr float kWorthAWordM = 1e-3F;
  if (row.presliding_m > kWorthAWordM) {
    return std::isfinite(row.slope_n_per_mm)
               ? fmt::format("slides after {:.1f} mm", static_cast<double>(row.presliding_m) * 1e3)
               : "takes the tissue along";
  }
  const std::optional<double> fallen = hal::fallen_fraction(row);
  if (!fallen) return "";
  if (row.stage == hal::Stage::kPuncture) return fmt::format("drops {:.0f} %", 100 * *fallen);
  if (row.stage == hal::Stage::kHold) return fmt::format("relaxes {:.0f} %", 100 * *fallen);
  return "";
}

std::string stage_table(std::span<const hal::StageRow> stages, double period_s) {
  std::string text =
      fmt::format("{:<11}{:>9}{:>9}{:>11}{:>10}{:>9}{:>9}{:>11}  {}\n", "stage", "from s", "to s",
                  "travel mm", "depth mm", "peak N", "mean N", "slope N/mm", "");
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const hal::StageRow& row = stages[i];
    const std::string slope = std::isfinite(row.slope_n_per_mm)
                                  ? fmt::format("{:.5f}", static_cast<double>(row.slope_n_per_mm))
                                  : "";
    text += fmt::format(
        "{:<11}{:>9.3f}{:>9.3f}{:>11.2f}{:>10.2f}{:>9.3f}{:>9.3f}{:>11}  {}\n",
        hal::stage_name(row.stage), static_cast<double>(row.start_tick) * period_s,
        static_cast<double>(row.end_tick) * period_s, static_cast<double>(row.travel_m) * 1e3,
        static_cast<double>(row.depth_m) * 1e3, static_cast<double>(row.peak_force_n),
        static_cast<double>(row.mean_force_n), slope, remark(stages, i));
  }
  return text;
}

std::string phase_tables(const RunReport& report) {
  std::string text;
  for (std::size_t i = 0; i < report.stages.size(); ++i) {
    if (report.stages.size() > 1) text += fmt::format("{}needle {}\n", i > 0 ? "\n" : "", i);
    text += stage_table(report.stages[i], report.period_s);
  }
  return text;
}

// What the fluid told, and what went in or came out; empty for needles whose hub is closed.
std::string flow_text(const RunReport& report) {
  std::string text;
  for (const Event& event : report.events) {
    if (event.kind != EventKind::kFlashback && event.kind != EventKind::kLossOfResistance) continue;
    text += fmt::format("fluid       needle {}: {} at {:.3f} s, {:.2f} mm deep, in material {}\n",
                        event.needle, event_name(event.kind),
                        static_cast<double>(event.tick) * report.period_s,
                        static_cast<double>(event.depth_m) * 1e3, event.layer);
  }
  for (std::size_t i = 0; i < report.needles.size(); ++i) {
    if (report.needles[i].hub == Hub::kClosed) continue;
    const Flow& flow = report.loop->hand[i].output.flow;
    const double ml = static_cast<double>(flow.injected_m3) * 1e6;
    text += fmt::format("fluid       needle {}: {:.3f} ml {}, at the end {:.2f} kPa in the hub\n",
                        i, std::fabs(ml), ml < 0 ? "came out" : "went in",
                        static_cast<double>(flow.hub_pa) * 1e-3);
  }
  return text;
}

std::string score_text(const RunReport& report) {
  return report.score ? score_table(std::span(&*report.score, 1)) + "\n" : "";
}

std::string timing_row(const char* name, const hal::Histogram& histogram) {
  return fmt::format(
      "{:<20}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.1f}\n", name,
      hal::histogram_quantile_us(histogram, 0.5), hal::histogram_quantile_us(histogram, 0.99),
      hal::histogram_quantile_us(histogram, 0.999), static_cast<double>(histogram.max_ns) * 1e-3);
}

std::string timing_table(const RunReport& report) {
  const hal::LoopState& loop = *report.loop;
  std::string text =
      fmt::format("{:<20}{:>10}{:>10}{:>10}{:>10}\n", "timing, us", "p50", "p99", "p99.9", "max");
  text += timing_row("tick", loop.tick_time);
  if (!report.fast) text += timing_row("wake-up lateness", loop.lateness);
  text += fmt::format(
      "ticks {}, missed {}, page faults {}, preempted {} times; {:.2f} s for {:.2f} s simulated\n",
      loop.ticks, loop.missed_ticks.load(), report.thread.minor_faults + report.thread.major_faults,
      report.thread.involuntary_switches, report.wall_s,
      static_cast<double>(loop.ticks) * report.period_s);
  if (report.threads > 1) {
    text += fmt::format("threads {}, parts of the tissue step done by helpers {}\n", report.threads,
                        report.helped_parts);
  }
  return text;
}

std::string counter_table(const RunReport& report) {
  std::string text;
  for (const auto& [name, value] : counters(report)) {
    if (value != 0) text += fmt::format("  {:<20}{:>12}\n", name, value);
  }
  const auto pool = [](const char* name, const Pool& p) {
    return fmt::format("  {:<24}{:>6} of {}\n", name, p.used_max, p.capacity);
  };
  return "counters (those not zero)\n" + text + "pools, most ever used\n" +
         pool("constraint particles", report.stats.constraint_particles) +
         pool("coupled voxels", report.stats.coupled_voxels) + pool("tracks", report.stats.tracks) +
         pool("obstacle contacts", report.stats.obstacle_contacts);
}

// A warning if a device is too weak for its scene: then felt force and path of the needle are not
// those of the scene.
std::string strength_text(const RunReport& report) {
  std::string text;
  for (std::size_t i = 0; i < report.most_force_n.size(); ++i) {
    const std::uint64_t limited = report.loop->hand[i].guard.counters.force_limited;
    if (limited == 0) continue;
    double asked_n = 0;
    for (const hal::StageRow& row : report.stages[i]) {
      asked_n = std::max(asked_n, std::fabs(static_cast<double>(row.peak_force_n)));
    }
    text += fmt::format(
        "too weak    needle {}: in {} of {} ticks the force was cut to the {:g} N that the device "
        "may give; along the needle the tissue's force was up to {:.2f} N. The hand moves farther "
        "than with a stronger device, and the needle lags behind it: expected a stronger device, "
        "or mapping.force_scale below 1\n",
        i, limited, report.loop->ticks, static_cast<double>(report.most_force_n[i]), asked_n);
  }
  return text;
}

// The deepest dimple before a puncture of the surface, in voxels of this level.
double dimple_voxels(const RunReport& report, std::uint32_t level) {
  double most = 0;
  for (const auto& stages : report.stages) {
    for (const hal::StageRow& row : stages) {
      if (row.stage == hal::Stage::kContact) {
        most = std::max(most, static_cast<double>(row.travel_m / report.voxel_edge_m));
      }
    }
  }
  return most / static_cast<double>(edge_ratio(level));
}

// A warning if a moving hand feels mass that the tissue does not have.
std::string inertia_text(const Resonance& of) {
  if (!(of.departs_hz < kFastestHandHz)) return "";
  return fmt::format(
      "inertia     first resonance {:.3g} Hz instead of the tissue's {:.3g} Hz: above {:.2g} Hz "
      "the force on a moving hand may be off by a tenth\n",
      of.stepped_hz, of.real_hz, of.departs_hz);
}

// A warning if forces are softer than the materials say, or would be with finer voxels.
std::string resolution_text(const RunReport& report) {
  constexpr double kShallowVoxels = 1, kNoShortfall = 0.02;
  const double shortfall = static_cast<double>(report.stats.coupling_shortfall);
  const std::uint32_t finest = report.levels - 1;
  const double coarse = dimple_voxels(report, 0), fine = dimple_voxels(report, finest);
  std::string text;
  if (shortfall > kNoShortfall) {
    text += fmt::format(
        "softer      the lattice held a particle of the needle {:.0f} % more softly than the "
        "material would: voxels are small for the needle or its force, or a stiff layer is "
        "thinner than two of them\n",
        100 * shortfall);
  }
  const double unit = static_cast<double>(report.stats.unit_in_voxels);
  if (unit > 1) {
    text += fmt::format(
        "unit        the needle's unit is {:.2g} voxels long, so that the shaft is 10 to 26 % too "
        "soft sideways: expected a unit of at most {:.3g} mm\n",
        unit, 1e3 * static_cast<double>(report.voxel_edge_m * edge_ratio(finest)));
  }
  // Which voxels lie below it is not known here: the finest decide whether there is a warning.
  if (fine > kShallowVoxels) {
    const std::string depth =
        finest > 0
            ? fmt::format("as deep as {:.1f} of the finest voxels, or {:.1f} of the coarsest", fine,
                          coarse)
            : fmt::format("{:.1f} voxels deep", coarse);
    text += fmt::format(
        "dimple      {}: with finer voxels the tissue below it would be softer, and the force "
        "smaller by some per cent\n",
        depth);
  }
  return text;
}

}  // namespace

std::string json_text(const RunReport& report) {
  const hal::LoopState& loop = *report.loop;
  Json out = {{"scene", report.scene_file},
              {"mode", report.mode},
              {"organ", report.organ_file},
              {"recording", report.recording.empty() ? Json(nullptr) : Json(report.recording)},
              {"fast", report.fast},
              {"interrupted", report.interrupted},
              {"period_s", std::stod(fmt::format("{:.7g}", report.period_s))},
              {"needles", Json::array()},
              {"obstacles", report.obstacles},
              {"events", Json::array()}};
  for (std::size_t i = 0; i < report.needles.size(); ++i) {
    Json needle = json_of(report.needles[i]);
    const hal::GuardState& guard = loop.hand[i].guard;
    needle["fault"] = hal::fault_name(guard.fault);
    needle["least_energy_j"] = guard.energy.least_j;
    needle["least_received_j"] = report.least_received_j[i];
    needle["phases"] = json_of(report.stages[i]);
    out["needles"].push_back(needle);
  }
  out["phases"] = json_of(report.stages[0]);
  for (const Event& event : report.events) out["events"].push_back(json_of(event));
  out["score"] = report.score ? score_json(*report.score) : Json(nullptr);
  out["timing"] = {{"tick", json_of(loop.tick_time)},
                   {"wake_up_lateness", json_of(loop.lateness)},
                   {"ticks", loop.ticks},
                   {"missed_ticks", loop.missed_ticks.load()},
                   {"page_faults", report.thread.minor_faults + report.thread.major_faults},
                   {"involuntary_switches", report.thread.involuntary_switches},
                   {"threads", report.threads},
                   {"helped_parts", report.helped_parts},
                   {"wall_s", report.wall_s}};
  const Stats& stats = report.stats;
  out["memory"] = {{"model", json_of(report.predicted.model_bytes, report.used.model_bytes)},
                   {"state", json_of(report.predicted.state_bytes, report.used.state_bytes)},
                   {"scratch", json_of(report.predicted.scratch_bytes, report.used.scratch_bytes)},
                   {"pools",
                    {{"constraint_particles", json_of(stats.constraint_particles)},
                     {"coupled_voxels", json_of(stats.coupled_voxels)},
                     {"tracks", json_of(stats.tracks)},
                     {"obstacle_contacts", json_of(stats.obstacle_contacts)}}}};
  out["counters"] = Json::object();
  for (const auto& [name, value] : counters(report)) out["counters"][name] = value;
  out["coupling_shortfall"] = json_number(stats.coupling_shortfall);
  out["unit_in_voxels"] = json_number(stats.unit_in_voxels);
  out["dimple_voxels"] = json_number(static_cast<float>(dimple_voxels(report, 0)));
  out["dimple_finest_voxels"] =
      json_number(static_cast<float>(dimple_voxels(report, report.levels - 1)));
  out["first_resonance_hz"] = json_number(static_cast<float>(report.resonance.stepped_hz));
  out["real_first_resonance_hz"] = json_number(static_cast<float>(report.resonance.real_hz));
  out["inertia_departs_hz"] = json_number(static_cast<float>(report.resonance.departs_hz));
  out["fault"] = hal::fault_name(first_fault(report));
  out["host"] = {{"lacks", report.host.lacks}, {"notes", report.host.notes}};
  out["state_hash"] = hex(report.state_hash);
  out["organ_hash"] = hex(report.organ_hash);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string replay_json(const std::string& recording, const hal::ReplayResult& result,
                        bool unfinished) {
  Json out = {{"recording", recording},
              {"same", result.same},
              {"ticks", result.ticks},
              {"unfinished", unfinished}};
  if (result.same) {
    out["state_hash"] = fmt::format("{:016x}", result.state_hash);
  } else {
    out["differs"] = {{"tick", result.tick},
                      {"field", result.field},
                      {"recorded", result.recorded},
                      {"replayed", result.replayed}};
  }
  return out.dump(2);
}

std::string human_text(const RunReport& report) {
  std::string text = phase_tables(report) + "\n" + flow_text(report) + score_text(report) +
                     timing_table(report) + "\n" + counter_table(report);
  const auto row = [](const char* name, std::size_t predicted, std::size_t used) {
    return fmt::format("  {:<10}{:>14}{:>14}\n", name, predicted, used);
  };
  text += fmt::format("{:<12}{:>14}{:>14}\n", "memory, B", "predicted", "used");
  text += row("model", report.predicted.model_bytes, report.used.model_bytes) +
          row("state", report.predicted.state_bytes, report.used.state_bytes) +
          row("scratch", report.predicted.scratch_bytes, report.used.scratch_bytes);
  text += fmt::format("\nstate hash  {}\norgan hash  {}\norgan       {}\n", hex(report.state_hash),
                      hex(report.organ_hash), report.organ_file);
  text += strength_text(report) + resolution_text(report) + inertia_text(report.resonance);
  if (!report.recording.empty()) text += fmt::format("recording   {}\n", report.recording);
  if (report.interrupted) text += "interrupted before the end of the script\n";
  if (first_fault(report) != hal::Fault::kNone) {
    text += fmt::format("guard fault: {}: force was taken to zero and stayed there\n",
                        hal::fault_name(first_fault(report)));
  }
  return text;
}

}  // namespace stylet::app
