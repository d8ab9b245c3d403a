// SPDX-License-Identifier: Apache-2.0
#include "summary.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>
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

// What to compare a measure of two threads with; none for others.
std::string one_thread(const std::string& measure) {
  if (measure == "shared" || measure == "beside") return "alone";
  return measure == "shared_any" || measure == "beside_any" ? "alone_any" : "";
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

// Gets the repetitions of a benchmark first, and then, in another call, their aggregates.
void Summary::ReportRuns(const std::vector<Run>& runs) {
  std::vector<const Run*> of_threads;
  for (const Run& run : runs) {
    if (run.error_occurred) {
      const std::string text = run.run_name.function_name + ": " + run.error_message;
      if (refused_.empty() || refused_.back() != text) refused_.push_back(text);
      continue;
    }
    if (counter(run, kBeside) > 0) {
      if (run.run_type == Run::RT_Iteration) of_threads.push_back(&run);
    } else if (run.aggregate_name == "median") {
      add_row(run, parts_of(run.run_name.function_name)[0], counter(run, kMedian));
    }
  }
  if (!of_threads.empty()) add_threads(std::move(of_threads));
}

void Summary::add_row(const Run& run, const std::string& measure, double median_us) {
  const std::vector<std::string> parts = parts_of(run.run_name.function_name);
  Row row{measure,
          parts.size() > 1 ? parts[1] : "",
          parts.size() > 2 ? parts[2] : "",
          counter(run, kVoxels),
          counter(run, kSubsteps),
          counter(run, kPasses),
          median_us,
          0};
  row.ns_per_voxel = 1e3 * row.median_us / (row.voxels * row.substeps);
  rows_.push_back(row);
}

void Summary::add_threads(std::vector<const Run*> each) {
  const auto by = [](const char* name) {
    return [name](const Run* a, const Run* b) { return counter(*a, name) < counter(*b, name); };
  };
  const auto median_us = [&](std::vector<const Run*> of, const char* name) {
    const auto at = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
    std::nth_element(of.begin(), at, of.end(), by(name));
    return counter(**at, name);
  };
  std::sort(each.begin(), each.end(), by(kBeside));
  const std::vector<const Run*> quiet(
      each.begin(), each.begin() + static_cast<std::ptrdiff_t>((each.size() + 3) / 4));
  const double times = median_us(quiet, kAlone) / median_us(quiet, kBeside);
  if (!(times >= kLeastBeside && times <= kMostBeside)) {
    std::ostringstream text;
    text << each[0]->run_name.function_name << ": no figure: two threads with nothing in common "
         << "were " << std::fixed << std::setprecision(2) << times << " x as fast as one, not 2: "
         << "they had no processor each";
    refused_.push_back(text.str());
    return;
  }
  for (const auto& [measure, name] :
       {std::pair("alone", kAlone), std::pair("beside", kBeside), std::pair("shared", kShared)}) {
    add_row(*each[0], measure, median_us(quiet, name));
    add_row(*each[0], std::string(measure) + "_any", median_us(each, name));
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
  for (const std::string& text : refused_) out << text << "\n";
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
    const bool is_step = row.measure == "tissue" || row.measure == "tissue_added";
    times(is_step ? ratio("bullet", "", row) : 0, 9);
    times(is_step ? ratio("eigen", "", row) : 0, 9);
    times(ratio(one_thread(row.measure), row.variant, row), 11);
    out << "\n";
  }
}

void Summary::write(const std::string& folder) const {
  std::filesystem::create_directories(folder);
  std::map<std::string, std::ofstream> files;
  for (const Row& row : rows_) {
    std::ofstream& file = files[row.variant.empty() ? "peers" : row.variant];
    if (!file.is_open()) {
      file.open(folder + "/" + file_name(processor_name()) + "-" +
                (row.variant.empty() ? "peers" : row.variant) + ".csv");
      file << "measure,organ,voxels,substeps,passes,median_us,ns_per_voxel_substep\n";
    }
    file << row.measure << "," << row.organ << "," << std::setprecision(8) << row.voxels << ","
         << row.substeps << "," << row.passes << "," << std::setprecision(5) << row.median_us << ","
         << row.ns_per_voxel << "\n";
  }
}

}  // namespace stylet::test
