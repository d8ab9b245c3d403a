// SPDX-License-Identifier: Apache-2.0
// A recording on the console: after a seek to a tick it shows the recorded force to the bit, and
// the tissue as the kernel has it there, whatever was sought before.
#include "hal/console/player.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <random>
#include <thread>

#include "hal/console/limits.h"
#include "hal/record/recording.h"
#include "served.h"

namespace stylet::console::test {
namespace {

using namespace std::chrono_literals;

// A recording of the rig, and the truth about each of its ticks.
struct Recorded : Served {
  Recorded() {
    path = (std::filesystem::temp_directory_path() /
            ("stylet-player-" + std::to_string(getpid()) + ".h5"))
               .string();
    hal::RecordingInfo info;
    info.config = scene.config;
    info.organ_hash = organ.hash;
    info.course[0] = course;
    hal::RecordingWriter writer(path, info);
    all = run(device());
    writer.append(all);
    writer.finish(hash(instance->kernel), 0);
  }
  ~Recorded() { std::filesystem::remove(path); }

  std::string path;
  std::vector<hal::TickRecord> all;
};

// The display's state once it shows that tick.
const hal::DisplayState* await(hal::Display& display, std::uint64_t tick) {
  const auto end = std::chrono::steady_clock::now() + 20s;
  while (std::chrono::steady_clock::now() < end) {
    const hal::DisplayState* state = display.take();
    if (state != nullptr && state->hand[0].output.tick == tick) return state;
    std::this_thread::sleep_for(1ms);
  }
  return nullptr;
}

TEST(Player, ShowsTheRecordedForceAtTheTickSought) {
  Recorded recorded;
  const hal::RecordingReader reader(recorded.path);
  const auto display = std::make_shared<hal::Display>(recorded.instance->kernel);
  Player player(reader, recorded.organ, display);
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i) {
    const std::uint64_t tick = 1 + random() % recorded.all.size();
    player.seek(tick);
    const hal::DisplayState* state = await(*display, tick);
    ASSERT_NE(state, nullptr) << tick;
    const hal::TickRecord& expected = recorded.all[tick - 1];
    EXPECT_EQ(std::memcmp(&state->hand[0].output, &expected.output, sizeof expected.output), 0);
  }
  EXPECT_EQ(player.differs_at(), 0U);
}

TEST(Player, TheTissueIsThatOfTheTickWhateverCameBefore) {
  Recorded recorded;
  const hal::RecordingReader reader(recorded.path);
  const auto display = std::make_shared<hal::Display>(recorded.instance->kernel);
  Player player(reader, recorded.organ, display);
  hal::KernelInstance fresh(recorded.organ, reader.info().config);
  for (const std::uint64_t tick : {200U, 130U, 131U, 5U, 240U, 1U}) {
    player.seek(tick);
    const hal::DisplayState* state = await(*display, tick);
    ASSERT_NE(state, nullptr);
    reset(fresh.kernel);
    for (std::uint64_t t = 0; t < tick; ++t) stylet::tick(fresh.kernel, recorded.all[t].input);
    std::vector<stylet::Vec3> expected(particle_count(fresh.kernel));
    particles(fresh.kernel, expected);
    ASSERT_EQ(state->moved_m.size(), expected.size());
    EXPECT_EQ(
        std::memcmp(state->moved_m.data(), expected.data(), expected.size() * sizeof(stylet::Vec3)),
        0)
        << tick;
  }
}

TEST(Player, PlaysBothWaysAndStopsAtTheEnds) {
  Recorded recorded;
  const hal::RecordingReader reader(recorded.path);
  const auto display = std::make_shared<hal::Display>(recorded.instance->kernel);
  Player player(reader, recorded.organ, display);
  player.play(4);
  EXPECT_NE(await(*display, recorded.all.size()), nullptr);
  player.play(-4);
  EXPECT_NE(await(*display, 1), nullptr);
  player.play(std::numeric_limits<float>::quiet_NaN());
  player.seek(1'000'000'000);
  EXPECT_NE(await(*display, recorded.all.size()), nullptr);
}

TEST(Player, BackwardsSnapshotsAreKeyFramesAfterALongWay) {
  Recorded recorded;
  const hal::RecordingReader reader(recorded.path);
  const auto display = std::make_shared<hal::Display>(recorded.instance->kernel);
  Player player(reader, recorded.organ, display, /*longest_way_s=*/0);
  const std::uint64_t last = recorded.all.size();
  ASSERT_GT(last, 2 * kLeastSnapshotTicks);
  player.seek(last);
  ASSERT_NE(await(*display, last), nullptr);
  std::this_thread::sleep_for(1s);  // the snapshots are taken meanwhile
  player.play(-0.2F);
  std::vector<std::uint64_t> shown;
  while (shown.empty() || shown.back() > 1) {
    const hal::DisplayState* state = display->take();
    if (state == nullptr) continue;
    shown.push_back(state->hand[0].output.tick);
    const auto& expected = recorded.all[shown.back() - 1].output;
    EXPECT_EQ(std::memcmp(&state->hand[0].output, &expected, sizeof expected), 0);
  }
  EXPECT_EQ(shown, (std::vector<std::uint64_t>{2 * kLeastSnapshotTicks, kLeastSnapshotTicks, 1}));
}

TEST(Player, OtherForcesThanRecordedAreNoticed) {
  Recorded recorded;
  recorded.all[99].output.force_n.x += 1e-6F;
  hal::RecordingInfo info = hal::RecordingReader(recorded.path).info();
  {
    hal::RecordingWriter writer(recorded.path, info);
    writer.append(recorded.all);
    writer.finish(0, 0);
  }
  const hal::RecordingReader reader(recorded.path);
  const auto display = std::make_shared<hal::Display>(recorded.instance->kernel);
  Player player(reader, recorded.organ, display);
  player.seek(150);
  ASSERT_NE(await(*display, 150), nullptr);
  EXPECT_EQ(player.differs_at(), 100U);
}

// From the page's seek to the page's frame.
TEST(Player, ThePageGetsTheForceExactly) {
  Recorded recorded;
  const hal::RecordingReader reader(recorded.path);
  recorded.server->show(read_curve(reader), {});  // before there is a player: see player.h
  Player player(reader, recorded.organ,
                std::shared_ptr<hal::Display>(recorded.display.get(), [](hal::Display*) {}));
  recorded.server->show(Activity::Playback);
  Client client(recorded.port);
  ASSERT_EQ(client.join(), 101U);
  for (const std::uint64_t tick : {180U, 77U, 222U}) {
    player.seek(tick);
    const Frame* frame =
        client.next_of<Frame>(Body::Frame, [tick](const Frame& f) { return f.tick() == tick; });
    ASSERT_NE(frame, nullptr);
    const stylet::Vec3& expected = recorded.all[tick - 1].output.force_n;
    const Vec3& force = *frame->needles()->Get(0)->force_n();
    EXPECT_EQ(force.x(), expected.x);
    EXPECT_EQ(force.y(), expected.y);
    EXPECT_EQ(force.z(), expected.z);
    EXPECT_EQ(frame->activity(), Activity::Playback);
  }
  client.say_message(page_message(
      Body::AskRows, [&](auto& b) { return CreateAskRows(b, 1, recorded.all.size(), 10'000); }));
  const Rows* rows = client.next_of<Rows>(Body::Rows);
  ASSERT_NE(rows, nullptr);
  ASSERT_EQ(rows->rows()->size(), recorded.all.size());
  for (const Row* row : *rows->rows()) {
    const Row expected = row_of(recorded.all[row->tick() - 1], recorded.course);
    EXPECT_EQ(std::memcmp(row, &expected, sizeof expected), 0) << row->tick();
  }
}

}  // namespace
}  // namespace stylet::console::test
