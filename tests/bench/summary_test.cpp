// SPDX-License-Identifier: Apache-2.0
// What the summary says of two threads: there are figures only if two threads with nothing in
// common were twice as fast as one.
#include "summary.h"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

namespace stylet::test {
namespace {

using OneRun = benchmark::BenchmarkReporter::Run;

// Repetitions in which two threads do `gain` times the steps of one, alone 100 us and some noise.
std::string summary_of(double gain, double noise_us) {
  std::mt19937 random(static_cast<unsigned>(1000 * gain));
  std::uniform_real_distribution<double> noise(0, noise_us);
  std::vector<OneRun> runs(15);
  for (OneRun& run : runs) {
    const double alone_us = 100 + noise(random);
    run.run_name.function_name = "threads/liver_1k/avx2";
    run.run_type = OneRun::RT_Iteration;
    run.counters[kAlone] = alone_us;
    run.counters[kBeside] = alone_us / gain;
    run.counters[kShared] = alone_us / 1.5;
    run.counters[kVoxels] = 1000;
    run.counters[kSubsteps] = 1;
  }
  Summary summary;
  summary.ReportRuns(runs);
  summary.Finalize();
  std::ostringstream out;
  summary.print(out);
  return out.str();
}

TEST(BenchSummary, TwoThreadsHaveAFigureIfTheyRanAtTheSameTime) {
  for (const double gain : {1.93, 2.0, 2.07}) {
    const std::string text = summary_of(gain, 10);
    EXPECT_NE(text.find("shared/liver_1k/avx2"), std::string::npos) << text;
    EXPECT_EQ(text.find("no figure"), std::string::npos) << text;
  }
}

TEST(BenchSummary, TwoThreadsThatTookTurnsHaveNoFigure) {
  for (const double gain : {1.0, 1.5, 1.85, 2.2}) {
    const std::string text = summary_of(gain, 10);
    EXPECT_EQ(text.find("shared/"), std::string::npos) << text;
    EXPECT_EQ(text.find("beside"), std::string::npos) << text;
    EXPECT_NE(text.find("threads/liver_1k/avx2: no figure"), std::string::npos) << text;
  }
}

TEST(BenchSummary, WhatCouldNotBeMeasuredIsSaidOnce) {
  std::vector<OneRun> runs(15);
  for (OneRun& run : runs) {
    run.run_name.function_name = "threads/liver_1k/avx2";
    run.error_occurred = true;
    run.error_message = "one processor only";
  }
  Summary summary;
  summary.ReportRuns(runs);
  std::ostringstream out;
  summary.print(out);
  EXPECT_EQ(out.str(), "threads/liver_1k/avx2: one processor only\n");
}

}  // namespace
}  // namespace stylet::test
