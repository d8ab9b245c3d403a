// SPDX-License-Identifier: Apache-2.0
// Collects the medians of all benchmarks, prints them as the table a person wants, and writes one
// CSV file per instruction set.
#pragma once

#include <benchmark/benchmark.h>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace stylet::test {

// Counters: the time of a step or tick, or these three, and what every benchmark sets.
constexpr const char* kMedian = "median_us";
constexpr const char* kAlone = "alone_us";
constexpr const char* kBeside = "beside_us";
constexpr const char* kShared = "shared_us";
constexpr const char* kVoxels = "voxels";
constexpr const char* kSubsteps = "substeps";
constexpr const char* kPasses = "passes";  // of the filter, in a substep

// Speed of two threads with nothing in common over that of one, if they really run at the same
// time: 1.94 to 2.02 in every committed result.
constexpr double kLeastBeside = 1.9;
constexpr double kMostBeside = 2.1;

class Summary : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;

  // Between ReportRuns and print: rows in order of organ and measure.
  void Finalize() override;
  // First what was refused and why; then one line for each benchmark: the median, the same per
  // voxel and substep, and how many times as long a peer, or one thread, takes.
  void print(std::ostream& out) const;
  void write(const std::string& folder) const;

 private:
  struct Row {
    std::string measure, organ, variant;
    double voxels, substeps, passes, median_us, ns_per_voxel;
  };
  std::vector<Row> rows_;
  std::vector<std::string> refused_;

  void add_row(const Run& run, const std::string& measure, double median_us);
  // Times of two threads say something of the kernel only while nobody else uses their processors,
  // which on a shared machine is only now and then. Two threads with nothing in common show when
  // that is: the medians are of the quarter of the repetitions in which these two were fastest. The
  // medians of all repetitions are in the rows *_any. If these two threads are not about twice as
  // fast as one, they did not run at the same time, and no figure is given.
  void add_threads(std::vector<const Run*> each);

  // Time of the benchmark `measure` on the same organ (and variant, if it has any) over the time of
  // this one; 0 if it was not run.
  double ratio(const std::string& measure, const std::string& variant, const Row& to) const;
};

}  // namespace stylet::test
