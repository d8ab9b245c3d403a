// SPDX-License-Identifier: Apache-2.0
// The flight recorder keeps the second before a fault and what followed, and keeps nothing without
// a fault.
#include "hal/record/flight.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "hal/record/recorder.h"
#include "rig.h"

namespace stylet::hal {
namespace {

namespace fs = std::filesystem;

class FlightTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("stylet-flight-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path() const { return (folder_ / "fault.h5").string(); }
  std::string file(int number) const {
    return (folder_ / ("fault-" + std::to_string(number) + ".h5")).string();
  }

  static RecordingInfo info(std::uint32_t needles = 1) {
    RecordingInfo all;
    all.config.needle_count = needles;
    return all;
  }

  fs::path folder_;
};

// Tick `tick` of `needles`; needle `faulty` has a latched fault from tick `from` to the one before
// `to`.
std::vector<TickRecord> tick_of(std::uint64_t tick, std::uint32_t needles, std::uint32_t faulty,
                                std::uint64_t from, std::uint64_t to = ~0ULL) {
  std::vector<TickRecord> records(needles);
  for (std::uint32_t i = 0; i < needles; ++i) {
    records[i].needle = i;
    records[i].output.tick = tick;
    if (i == faulty && tick >= from && tick < to) records[i].fault = Fault::kDeviceSilent;
  }
  return records;
}

std::vector<std::uint64_t> ticks_in(const RecordingReader& recording, std::uint32_t needle = 0) {
  std::vector<TickRecord> records(recording.ticks());
  recording.read(0, records, needle);
  std::vector<std::uint64_t> ticks;
  for (const TickRecord& each : records) ticks.push_back(each.output.tick);
  return ticks;
}

TEST_F(FlightTest, WithoutAFaultNothingIsWritten) {
  FlightRecorder flight(path(), info());
  for (std::uint64_t t = 1; t <= 5000; ++t) flight.add(tick_of(t, 1, 0, 9999), {});
  flight.finish();
  EXPECT_TRUE(flight.flights().empty());
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(FlightTest, HoldsTheSecondBeforeAndATenthAfter) {
  FlightRecorder flight(path(), info());
  for (std::uint64_t t = 1; t <= 5000; ++t) flight.add(tick_of(t, 1, 0, 3000), {});
  ASSERT_EQ(flight.flights().size(), 1U);
  EXPECT_EQ(flight.flights()[0].path, file(1));
  EXPECT_EQ(flight.flights()[0].fault, Fault::kDeviceSilent);
  EXPECT_EQ(flight.flights()[0].tick, 3000U);
  const RecordingReader recording(file(1));
  const auto ticks = ticks_in(recording);
  ASSERT_EQ(ticks.size(), 1100U);
  EXPECT_EQ(ticks.front(), 2001U);
  EXPECT_EQ(ticks.back(), 3100U);
  EXPECT_EQ(recording.info().lost_records, 2000U);  // so that it cannot be replayed
}

TEST_F(FlightTest, AFaultAtTheStartOrTheEndKeepsTheTicksThereAre) {
  FlightRecorder flight(path(), info());
  for (std::uint64_t t = 1; t <= 20; ++t) flight.add(tick_of(t, 1, 0, 5), {});
  EXPECT_TRUE(flight.flights().empty());
  flight.finish();
  flight.finish();
  ASSERT_EQ(flight.flights().size(), 1U);
  EXPECT_EQ(ticks_in(RecordingReader(file(1))).size(), 20U);
}

TEST_F(FlightTest, AFaultAfterTheLastTickIsWritten) {
  FlightRecorder flight(path(), info(2));
  for (std::uint64_t t = 1; t <= 2000; ++t) flight.add(tick_of(t, 2, 0, 9999), {});
  const Fault faults[] = {Fault::kNone, Fault::kTooLate};
  flight.finish(faults);
  flight.finish(faults);
  ASSERT_EQ(flight.flights().size(), 1U);
  EXPECT_EQ(flight.flights()[0].fault, Fault::kTooLate);
  EXPECT_EQ(flight.flights()[0].needle, 1U);
  EXPECT_EQ(flight.flights()[0].tick, 2000U);
  const auto ticks = ticks_in(RecordingReader(file(1)));
  EXPECT_GE(ticks.size(), 1000U);
  EXPECT_EQ(ticks.back(), 2000U);
}

TEST_F(FlightTest, AFaultThatWasSeenIsNotWrittenAgainAtTheEnd) {
  FlightRecorder flight(path(), info());
  for (std::uint64_t t = 1; t <= 2000; ++t) flight.add(tick_of(t, 1, 0, 500), {});
  flight.finish(std::array{Fault::kDeviceSilent});
  EXPECT_EQ(flight.flights().size(), 1U);
  FlightRecorder nothing(path(), info());
  nothing.finish(std::array{Fault::kTooLate});
  EXPECT_TRUE(nothing.flights().empty()) << "no tick was run";
}

TEST_F(FlightTest, ALatchedFaultIsWrittenOnceAndANewFaultAgain) {
  FlightRecorder flight(path(), info());
  for (std::uint64_t t = 1; t <= 9000; ++t) {
    flight.add(tick_of(t, 1, 0, t < 4000 ? 2000 : 6000, t < 4000 ? 3000 : 7000), {});
  }
  ASSERT_EQ(flight.flights().size(), 2U);
  EXPECT_EQ(flight.flights()[1].path, file(2));
  EXPECT_EQ(flight.flights()[1].tick, 6000U);
}

TEST_F(FlightTest, EarlierFilesStay) {
  std::ofstream(file(1)) << "evidence";
  FlightRecorder flight(path(), info());
  for (std::uint64_t t = 1; t <= 20; ++t) flight.add(tick_of(t, 1, 0, 5), {});
  flight.finish();
  ASSERT_EQ(flight.flights().size(), 1U);
  EXPECT_EQ(flight.flights()[0].path, file(2));
  EXPECT_EQ(fs::file_size(file(1)), 8U);
}

// Several programs in one folder have faults at once: each keeps its evidence, in the file that it
// names.
TEST_F(FlightTest, FaultsOfSeveralProgramsAtOnceAreAllKept) {
  std::vector<pid_t> programs;
  for (std::uint64_t i = 0; i < 6; ++i) {
    programs.push_back(fork());
    if (programs.back() != 0) continue;
    FlightRecorder flight(path(), info());
    for (std::uint64_t t = 1; t <= 20 + i; ++t) flight.add(tick_of(t, 1, 0, 5), {});
    flight.finish();
    const bool mine =
        flight.flights().size() == 1 && RecordingReader(flight.flights()[0].path).ticks() == 20 + i;
    _exit(mine ? 0 : 1);
  }
  for (const pid_t each : programs) {
    int status = 1;
    waitpid(each, &status, 0);
    EXPECT_EQ(status, 0);
  }
  std::set<std::size_t> lengths;
  for (int number = 1; number <= 6; ++number) {
    lengths.insert(RecordingReader(file(number)).ticks());
  }
  EXPECT_EQ(lengths, (std::set<std::size_t>{20, 21, 22, 23, 24, 25}));
}

TEST_F(FlightTest, SeveralNeedlesKeepWholeTicksAndTheirEvents) {
  FlightRecorder flight(path(), info(3));
  for (std::uint64_t t = 1; t <= 4000; ++t) {
    Event event = {};
    event.tick = t;
    flight.add(tick_of(t, 3, 1, 3000), std::span(&event, t % 100 == 0 ? 1 : 0));
  }
  ASSERT_EQ(flight.flights().size(), 1U);
  EXPECT_EQ(flight.flights()[0].needle, 1U);
  const RecordingReader recording(file(1));
  const auto ticks = ticks_in(recording);
  EXPECT_EQ(ticks, ticks_in(recording, 1));
  EXPECT_EQ(ticks, ticks_in(recording, 2));
  EXPECT_GE(ticks.size(), 1099U);
  EXPECT_LE(ticks.front(), 2001U);
  std::vector<Event> events(recording.event_count());
  recording.read(0, events);
  EXPECT_EQ(events.front().tick, 2100U);
  EXPECT_EQ(events.back().tick, 3100U);
}

TEST_F(FlightTest, AFileThatCannotBeWrittenIsReported) {
  FlightRecorder flight((folder_ / "nowhere" / "fault.h5").string(), info());
  for (std::uint64_t t = 1; t <= 20; ++t) flight.add(tick_of(t, 1, 0, 5), {});
  flight.finish();
  EXPECT_TRUE(flight.flights().empty());
  EXPECT_NE(flight.error().find("nowhere"), std::string::npos) << flight.error();
}

// The machine stalls in the last tick: the loop notices it when no tick is left in which to record
// it.
TEST_F(FlightTest, AStallInTheLastTickLeavesItsLastSecond) {
  Rig rig;
  rig.config.ticks = 100;
  struct Stalling {
    VirtualTime time;
    const LoopState& state;
  } stalling = {{}, rig.state};
  const Clock clock = {&stalling,
                       [](void* self) {
                         const auto& s = *static_cast<Stalling*>(self);
                         return s.time.now_ns + (s.state.ticks == 100 ? 1'000'000'000 : 0);
                       },
                       [](void* self, std::int64_t until_ns) {
                         static_cast<Stalling*>(self)->time.now_ns = until_ns;
                       }};
  const Device device = rig.device();
  const Course course = {{}, {1, 0, 0}};
  FlightRecorder flight(path(), info());
  Recorder recorder(rig.records, rig.events, nullptr, std::span(&course, 1), &flight);
  run_loop(rig.config, rig.instance->kernel, std::span(&device, 1), clock,
           {&rig.records, &rig.events, nullptr, true}, rig.state);
  recorder.stop(std::array{rig.state.hand[0].guard.fault});
  ASSERT_EQ(rig.state.hand[0].guard.fault, Fault::kTooLate);
  ASSERT_EQ(flight.flights().size(), 1U) << flight.error();
  EXPECT_EQ(flight.flights()[0].fault, Fault::kTooLate);
  EXPECT_EQ(flight.flights()[0].tick, 100U);
}

// A device that stops answering in the middle of a loop, through ring and recorder.
TEST_F(FlightTest, ALostDeviceLeavesItsLastSecond) {
  Rig rig;
  Device device = rig.device();
  struct Mute {
    Device inner;
    std::uint64_t reads;
  } mute = {device, 0};
  device.self = &mute;
  device.read = [](void* self, std::int64_t now_ns, Sample& sample) {
    Mute& m = *static_cast<Mute*>(self);
    return ++m.reads <= 120 && m.inner.read(m.inner.self, now_ns, sample);
  };
  device.write = [](void* self, const Command& command) {
    const Mute& m = *static_cast<Mute*>(self);
    m.inner.write(m.inner.self, command);
  };
  const Course course = {{}, {1, 0, 0}};
  FlightRecorder flight(path(), info());
  Recorder recorder(rig.records, rig.events, nullptr, std::span(&course, 1), &flight);
  run_loop(rig.config, rig.instance->kernel, std::span(&device, 1), virtual_clock(rig.time),
           {&rig.records, &rig.events, nullptr, true}, rig.state);
  recorder.stop();
  ASSERT_EQ(rig.state.hand[0].guard.fault, Fault::kDeviceSilent);
  ASSERT_EQ(flight.flights().size(), 1U) << flight.error();
  EXPECT_EQ(flight.flights()[0].fault, Fault::kDeviceSilent);
  const RecordingReader recording(file(1));
  std::vector<TickRecord> records(recording.ticks());
  recording.read(0, records);
  EXPECT_EQ(records.front().output.tick, 1U);
  const TickRecord& at_fault = records[flight.flights()[0].tick - 1];
  EXPECT_EQ(at_fault.fault, Fault::kDeviceSilent);
  EXPECT_EQ(at_fault.answered, 0U);
  EXPECT_NEAR(static_cast<double>(at_fault.output.tick), 123, 1);
  EXPECT_GE(recording.event_count(), 1U);
}

}  // namespace
}  // namespace stylet::hal
