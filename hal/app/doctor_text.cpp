// SPDX-License-Identifier: Apache-2.0
#include "hal/app/doctor_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

namespace stylet::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kColumns = 96;

// Wraps words into lines indented by `indent` columns; the first line has its indent already.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::istringstream stream(text);
  std::string all;
  std::size_t column = indent;
  for (std::string word; stream >> word;) {
    if (column > indent && column + 1 + word.size() > kColumns) {
      all += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      all += " ";
      ++column;
    }
    all += word;
    column += word.size();
  }
  return all;
}

// Text such as "ok       swap                   none  /proc/swaps", and the remedy below.
std::string finding_text(const hal::Finding& finding) {
  constexpr std::size_t kValue = 32;
  const std::string value = wrapped(finding.value, kValue);
  std::string text =
      fmt::format("{:<9}{:<23}{}", hal::verdict_name(finding.verdict), finding.name, value);
  const bool fits = value.find('\n') == std::string::npos &&
                    kValue + value.size() + 2 + finding.source.size() <= kColumns;
  text += fits ? "  " : "\n" + std::string(kValue, ' ');
  text += fmt::format("{}\n", finding.source);
  if (!finding.remedy.empty()) {
    text += fmt::format("{:>{}}{}\n", "-> ", kValue, wrapped(finding.remedy, kValue));
  }
  return text;
}

std::size_t count_of(const DoctorReport& report, hal::Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(report.findings.begin(), report.findings.end(),
                    [&](const hal::Finding& each) { return each.verdict == verdict; }));
}

// ---- histograms ---------------------------------------------------------------------------------

// Upper edges of the rows, us; the last row has everything longer.
constexpr std::array<std::size_t, 13> kEdges = {1,   2,   5,   10,   20,   50,  100,
                                                200, 450, 650, 1000, 2000, 5000};

std::array<std::uint64_t, kEdges.size() + 1> rows_of(const hal::Histogram& histogram) {
  std::array<std::uint64_t, kEdges.size() + 1> rows{};
  std::size_t row = 0;
  for (std::size_t us = 0; us < hal::Histogram::kBins; ++us) {
    while (row < kEdges.size() && us >= kEdges[row]) ++row;
    rows[row] += histogram.count[us];
  }
  return rows;
}

struct Series {
  std::string name;
  const hal::Spread* spread;
};

std::vector<Series> series_of(const DoctorReport& report) {
  std::vector<Series> all;
  for (const Measurement& each : report.measurements) {
    all.push_back({std::string(each.name) + " wake-up", &each.measured.wake_up});
    if (each.has_body) all.push_back({std::string(each.name) + " tick", &each.measured.body});
  }
  return all;
}

std::string spread_table(const std::vector<Series>& all) {
  std::string text = fmt::format("{:<22}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "us", "min", "mean",
                                 "p50", "p99", "p99.9", "max");
  for (const auto& [name, spread] : all) {
    const hal::Histogram& h = spread->histogram;
    text += fmt::format("{:<22}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}\n", name,
                        static_cast<double>(spread->min_ns) * 1e-3, spread->mean_ns * 1e-3,
                        hal::histogram_quantile_us(h, 0.5), hal::histogram_quantile_us(h, 0.99),
                        hal::histogram_quantile_us(h, 0.999), static_cast<double>(h.max_ns) * 1e-3);
  }
  return text;
}

std::string histogram_table(const std::vector<Series>& all) {
  std::string text = fmt::format("{:<13}", "us");
  for (const Series& each : all) text += fmt::format("{:>16}", each.name);
  text += "\n";
  for (std::size_t row = 0; row <= kEdges.size(); ++row) {
    std::string counts;
    std::uint64_t any = 0;
    for (const Series& each : all) {
      const std::uint64_t count = rows_of(each.spread->histogram)[row];
      any += count;
      counts += fmt::format("{:>16}", count);
    }
    const std::size_t from = row == 0 ? 0 : kEdges[row - 1];
    const std::string label = row < kEdges.size() ? fmt::format("{} to {}", from, kEdges[row])
                                                  : fmt::format("{} and more", from);
    if (any > 0) text += fmt::format("{:<13}{}\n", label, counts);
  }
  return text;
}

std::string measured_text(const DoctorReport& report) {
  const std::vector<Series> all = series_of(report);
  std::string text = fmt::format("\n{}\n{}\n", spread_table(all), histogram_table(all));
  for (const Measurement& each : report.measurements) {
    const hal::Measured& m = each.measured;
    text += fmt::format("{}: {} cycles, {} missed, {} page faults, preempted {} times\n", each.name,
                        m.cycles, m.missed, m.use.minor_faults + m.use.major_faults,
                        m.use.involuntary_switches);
  }
  text += fmt::format(
      "\nOther programs that measure the same:\n"
      "  cyclictest -m -p {1} -a {0} -i 1000 -D 60\n"
      "  rtla timerlat hist -c {0} -T 100\n"
      "A machine is qualified when the ticks, quiet and loaded, miss nothing for 8 hours:\n"
      "  stylet doctor --cpu {0} --measure 28800 --replay RECORDING\n",
      report.cpu, report.priority);
  return text;
}

// ---- JSON ---------------------------------------------------------------------------------------

Json json_of(const hal::Spread& spread) {
  const hal::Histogram& h = spread.histogram;
  Json bins = Json::array();
  for (std::size_t us = 0; us < hal::Histogram::kBins; ++us) {
    if (h.count[us] != 0) bins.push_back({us, h.count[us]});
  }
  return {{"min_us", static_cast<double>(spread.min_ns) * 1e-3},
          {"mean_us", spread.mean_ns * 1e-3},
          {"p50_us", hal::histogram_quantile_us(h, 0.5)},
          {"p99_us", hal::histogram_quantile_us(h, 0.99)},
          {"p99_9_us", hal::histogram_quantile_us(h, 0.999)},
          {"max_us", static_cast<double>(h.max_ns) * 1e-3},
          {"counts_from_us", bins}};
}

Json json_of(const Measurement& each) {
  const hal::Measured& m = each.measured;
  Json out = {{"name", each.name},
              {"cycles", m.cycles},
              {"missed", m.missed},
              {"page_faults", m.use.minor_faults + m.use.major_faults},
              {"involuntary_switches", m.use.involuntary_switches},
              {"wake_up", json_of(m.wake_up)}};
  if (each.has_body) out["tick"] = json_of(m.body);
  return out;
}

}  // namespace

std::string json_text(const DoctorReport& report) {
  Json out = {{"verdict", hal::fitness_name(hal::fitness(report.findings))},
              {"root", report.root},
              {"cpu", report.cpu},
              {"priority", report.priority},
              {"findings", Json::array()},
              {"measurements", Json::array()}};
  for (const hal::Finding& each : report.findings) {
    out["findings"].push_back({{"name", each.name},
                               {"verdict", hal::verdict_name(each.verdict)},
                               {"severity", hal::verdict_name(each.severity)},
                               {"value", each.value},
                               {"source", each.source},
                               {"remedy", each.remedy}});
  }
  for (const Measurement& each : report.measurements) out["measurements"].push_back(json_of(each));
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string human_text(const DoctorReport& report) {
  std::string text;
  for (const hal::Finding& each : report.findings) text += finding_text(each);
  if (!report.measurements.empty()) text += measured_text(report);
  text +=
      fmt::format("\n{}: {} ok, {} info, {} warn, {} fail, {} unknown; processor {}, priority {}\n",
                  hal::fitness_name(hal::fitness(report.findings)),
                  count_of(report, hal::Verdict::kOk), count_of(report, hal::Verdict::kInfo),
                  count_of(report, hal::Verdict::kWarn), count_of(report, hal::Verdict::kFail),
                  count_of(report, hal::Verdict::kUnknown), report.cpu, report.priority);
  return text;
}

}  // namespace stylet::app
