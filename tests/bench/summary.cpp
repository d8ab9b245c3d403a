// SPDX-License-Identifier: Apache-2.0
#include "summary.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <tuple>

#include "machine.h"

namespace stylet::test {
namespace {

std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts(1);
  for (const char c : name) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::string file_name(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!plain && !name.empty() && name.back() != '-') name += '-';
  }
  return name;
}

// Whether others use the machine: then what passes on the clock says nothing about two threads.
bool busy() {
  double load = 0;
  return getloadavg(&load, 1) != 1 || load > 1.5;
}

bool of_two_threads(const std::string& measure) {
  return measure == "shared" || measure == "beside";
}

double counter(const benchmark::BenchmarkReporter::Run& run, const char* name) {
  const auto found = run.counters.find(name);
  return found == run.counters.end() ? 0 : found->second.value;
}

}  // namespace

bool Summary::ReportContext(const Context& context) {
  PrintBasicContext(&GetErrorStream(), context);
  return true;
}

void Summary::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.aggregate_name != "median" || run.error_occurred) continue;
    const std::vector<std::string> parts = parts_of(run.run_name.function_name);
    Row row{parts[0],
            parts.size() > 1 ? parts[1] : "",
            parts.size() > 2 ? parts[2] : "",
            counter(run, kVoxels),
            counter(run, kMedian),
            0};
    row.ns_per_voxel = 1e3 * row.median_us / (row.voxels * counter(run, kSubsteps));
    rows_.push_back(row);
  }
}

void Summary::Finalize() {
  std::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) {
    return std::tie(a.voxels, a.organ, a.measure, a.variant) <
           std::tie(b.voxels, b.organ, b.measure, b.variant);
  });
}

double Summary::ratio(const std::string& measure, const std::string& variant, const Row& to) const {
  for (const Row& row : rows_) {
    if (row.measure == measure && row.organ == to.organ && row.variant == variant) {
      return row.median_us / to.median_us;
    }
  }
  return 0;
}

void Summary::print(std::ostream& out) const {
  if (rows_.empty()) return;
  out << "\n"
      << processor_name() << "\n"
      << std::left << std::setw(34) << "" << std::right << std::setw(12) << "median us"
      << std::setw(12) << "ns a voxel" << std::setw(9) << "bullet" << std::setw(9) << "eigen"
      << std::setw(11) << "1 thread"
      << "\n"
      << std::fixed;
  for (const Row& row : rows_) {
    out << std::left << std::setw(34) << row.measure + "/" + row.organ + "/" + row.variant
        << std::right << std::setprecision(1) << std::setw(12) << row.median_us << std::setw(12)
        << std::setprecision(2) << row.ns_per_voxel;
    const auto times = [&](double value, int width) {
      out << std::setw(width - 2);
      if (value > 0) {
        out << std::setprecision(value < 10 ? 2 : 0) << value << " x";
      } else {
        out << ""
            << "  ";
      }
    };
    times(row.measure == "tissue" ? ratio("bullet", "", row) : 0, 9);
    times(row.measure == "tissue" ? ratio("eigen", "", row) : 0, 9);
    times(of_two_threads(row.measure) ? ratio("tissue", row.variant, row) : 0, 11);
    out << "\n";
  }
}

void Summary::write(const std::string& folder) const {
  std::filesystem::create_directories(folder);
  std::map<std::string, std::ofstream> files;
  const bool crowded = busy();
  for (const Row& row : rows_) {
    if (crowded && of_two_threads(row.measure)) continue;
    std::ofstream& file = files[row.variant.empty() ? "peers" : row.variant];
    if (!file.is_open()) {
      file.open(folder + "/" + file_name(processor_name()) + "-" +
                (row.variant.empty() ? "peers" : row.variant) + ".csv");
      file << "measure,organ,voxels,median_us,ns_per_voxel_substep\n";
    }
    file << row.measure << "," << row.organ << "," << std::setprecision(8) << row.voxels << ","
         << std::setprecision(5) << row.median_us << "," << row.ns_per_voxel << "\n";
  }
}

}  // namespace stylet::test
