// SPDX-License-Identifier: Apache-2.0
#include "hal/record/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

#include "hal/record/recorder.h"

namespace stylet::hal {
namespace {

namespace fs = std::filesystem;

class RecordingTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("stylet-recording-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const char* name = "r.h5") const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  fs::path folder_;
};

// Random bits in every column, NaN and denormals among them.
std::vector<TickRecord> any_records(std::size_t count) {
  std::mt19937 random(3);
  std::vector<TickRecord> records(count);
  for (TickRecord& record : records) {
    for (const Column& column : tick_columns()) {
      auto* at = reinterpret_cast<unsigned char*>(&record) + column.offset;
      const std::size_t bytes = column.width * column_bytes(column.type);
      for (std::size_t i = 0; i < bytes; ++i) at[i] = static_cast<unsigned char>(random());
    }
  }
  return records;
}

bool same(std::span<const Column> columns, const void* a, const void* b) {
  for (const Column& column : columns) {
    if (std::memcmp(static_cast<const char*>(a) + column.offset,
                    static_cast<const char*>(b) + column.offset,
                    column.width * column_bytes(column.type)) != 0) {
      return false;
    }
  }
  return true;
}

RecordingInfo some_info() {
  RecordingInfo info;
  info.stylet_version = "0.1.0";
  info.scene_file = "scene.toml";
  info.scene_text = std::string(100'000, 'x') + "\nkey = \"\xC3\xA9\"\n";
  info.organ_file = "/somewhere/liver.organ";
  info.organ_hash = 0xFEDCBA9876543210ULL;
  info.config.mode = Mode::kPaper;
  info.config.period_s = 5e-4F;
  info.config.needle[0].unit_m = 4e-3F;
  info.course[0] = {{1, 2, 3}, {0, 0, -1}};
  return info;
}

std::string refusal(const std::string& path) {
  try {
    const RecordingReader reader(path);
    std::vector<TickRecord> all(reader.ticks());
    reader.read(0, all);
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "not refused";
}

TEST_F(RecordingTest, EveryBitIsReadBack) {
  const auto records = any_records(10'000);  // more than two chunks, and no whole number of chunks
  const std::vector<Event> events = {{1, EventKind::kContact, 0, 0, 0.5F, 0, 0},
                                     {99, EventKind::kPuncture, 1, 0.25F, -1, 1, 0}};
  {
    RecordingWriter writer(path(), some_info());
    writer.append(std::span(records).first(17));
    writer.append(std::span(records).subspan(17, 8000));
    writer.append(events);
    writer.append(std::span(records).subspan(8017));
    EXPECT_FALSE(fs::exists(path()));
    writer.finish(42, 7);
  }
  EXPECT_EQ(files(), 1U);
  const RecordingReader reader(path());
  const RecordingInfo& info = reader.info();
  EXPECT_EQ(info.scene_text, some_info().scene_text);
  EXPECT_EQ(info.organ_file, "/somewhere/liver.organ");
  EXPECT_EQ(info.organ_name, "");
  EXPECT_EQ(info.organ_hash, 0xFEDCBA9876543210ULL);
  EXPECT_EQ(info.config.mode, Mode::kPaper);
  EXPECT_EQ(info.config.period_s, 5e-4F);
  EXPECT_EQ(info.config.needle[0].unit_m, 4e-3F);
  EXPECT_EQ(info.course[0].entry_m.y, 2);
  EXPECT_EQ(info.final_state_hash, 42U);
  EXPECT_EQ(info.lost_records, 7U);
  ASSERT_EQ(reader.ticks(), records.size());
  std::vector<TickRecord> back(records.size() - 5);
  reader.read(5, back);
  for (std::size_t i = 0; i < back.size(); ++i) {
    ASSERT_TRUE(same(tick_columns(), &records[i + 5], &back[i])) << i;
  }
  ASSERT_EQ(reader.event_count(), 2U);
  std::vector<Event> events_back(2);
  reader.read(0, events_back);
  EXPECT_TRUE(same(event_columns(), &events[1], &events_back[1]));
}

// The recorded fields of a struct are read back bit for bit; its bytes are all different.
template <typename T>
T with_bytes(unsigned char first) {
  T value;
  auto* at = reinterpret_cast<unsigned char*>(&value);
  for (std::size_t i = 0; i < sizeof(T); ++i) at[i] = static_cast<unsigned char>(first + 7 * i);
  return value;
}

TEST_F(RecordingTest, NeedlesObstaclesAndBreathingAreReadBack) {
  RecordingInfo info = some_info();
  info.config.needle_count = 2;
  info.config.needle[0] = with_bytes<NeedleConfig>(1);
  info.config.needle[1] = with_bytes<NeedleConfig>(2);
  info.course[1] = with_bytes<Course>(3);
  info.config.breathing = with_bytes<BreathingConfig>(4);
  info.config.gravity_m_per_s2 = with_bytes<Vec3>(5);
  info.obstacles = {with_bytes<ObstacleConfig>(5), with_bytes<ObstacleConfig>(6)};
  auto records = any_records(9000);
  for (std::size_t i = 0; i < records.size(); ++i) records[i].needle = i % 2;
  {
    RecordingWriter writer(path(), info);
    writer.append(records);
    writer.finish(1, 0);
  }
  const RecordingReader reader(path());
  const RecordingInfo& back = reader.info();
  ASSERT_EQ(back.config.needle_count, 2U);
  const auto equal = [](const auto& a, const auto& b) {
    return std::memcmp(&a, &b, sizeof(a)) == 0;
  };
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(equal(back.config.needle[i], info.config.needle[i])) << i;
    EXPECT_TRUE(equal(back.course[i], info.course[i])) << i;
  }
  EXPECT_TRUE(equal(back.config.breathing, info.config.breathing));
  EXPECT_TRUE(equal(back.config.gravity_m_per_s2, info.config.gravity_m_per_s2));
  ASSERT_EQ(back.obstacles.size(), 2U);
  EXPECT_TRUE(equal(back.obstacles[1], info.obstacles[1]));
  ASSERT_EQ(reader.ticks(), 4500U);
  std::vector<TickRecord> second(4500);
  reader.read(0, second, 1);
  for (std::size_t i = 0; i < second.size(); ++i) {
    ASSERT_TRUE(same(tick_columns(), &records[2 * i + 1], &second[i])) << i;
    ASSERT_EQ(second[i].needle, 1U);
  }
}

TEST_F(RecordingTest, MarksAreReadBackAlsoWhenThereAreNone) {
  const std::vector<Mark> marks = {{7, "too fast"}, {7, "tab\there, \xc3\xa9t\xc3\xa9"}, {900, ""}};
  for (const std::span<const Mark> kept : {std::span(marks), std::span<const Mark>()}) {
    RecordingWriter writer(path(), {});
    writer.finish(0, 0, kept);
    const RecordingReader reader(path());
    ASSERT_EQ(reader.marks().size(), kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
      EXPECT_EQ(reader.marks()[i].tick, kept[i].tick);
      EXPECT_EQ(reader.marks()[i].text, kept[i].text);
    }
  }
}

// A line break in a mark would begin a line without a tick.
TEST_F(RecordingTest, InvalidMarksAreRefused) {
  const std::vector<Mark> marks = {{7, "good"}, {8, "two\nlines"}};
  RecordingWriter writer(path(), {});
  writer.finish(0, 0, marks);
  EXPECT_THAT([&] { RecordingReader reader(path()); },
              testing::ThrowsMessage<RecordingError>(
                  testing::HasSubstr("marks: line 3: expected a tick, a tab and words")));
}

TEST_F(RecordingTest, AnOlderFormatIsRefusedByItsNumber) {
  {
    RecordingWriter writer(path(), some_info());
    writer.append(any_records(10));
    writer.finish(1, 0);
  }
  const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t version = H5Aopen(file, "format_version", H5P_DEFAULT);
  const std::uint32_t old = 1;
  ASSERT_GE(H5Awrite(version, H5T_NATIVE_UINT32, &old), 0);
  H5Aclose(version);
  H5Fclose(file);
  EXPECT_THAT(refusal(path()), testing::HasSubstr("r.h5: format_version: 1: expected 6: make"));
}

// A file that gets the name while a run records stays; with --force it is replaced.
TEST_F(RecordingTest, AFileThatComesMeanwhileStays) {
  const auto records = any_records(10);
  for (const Naming naming : {Naming::kKeep, Naming::kNumber, Naming::kReplace}) {
    const OutputName name = {path(), naming};
    const std::string first = free_name(name);
    RecordingWriter writer(first, some_info(), name);
    writer.append(records);
    std::ofstream(first) << "precious";
    const std::string expected = naming == Naming::kKeep     ? path("r-2.h5")
                                 : naming == Naming::kNumber ? path("r-3.h5")
                                                             : path();
    EXPECT_EQ(writer.finish(1, 0), expected);
    EXPECT_EQ(RecordingReader(expected).ticks(), records.size());
    EXPECT_EQ(fs::file_size(first) == 8, naming != Naming::kReplace);
  }
  EXPECT_EQ(files(), 4U);
}

// In containers processes have the same few numbers: what a killed process left stays, and so does
// the target of a link there.
TEST_F(RecordingTest, FilesOfAnotherProcessWithThisNumberStay) {
  const std::string begin = path() + "." + std::to_string(getpid()), other = path() + ".other";
  const auto put = [](const std::string& name) { std::ofstream(name) << "precious"; };
  const auto holds = [](const std::string& name) {
    std::string text;
    std::ifstream(name) >> text;
    return text == "precious";
  };
  put(other);
  put(begin + ".tmp");
  fs::create_symlink(other, begin + "-2.tmp");
  fs::create_symlink("nowhere", begin + "-3.tmp");
  { const RecordingWriter unfinished(path(), some_info()); }
  RecordingWriter writer(path(), some_info());
  writer.append(any_records(10));
  writer.finish(1, 0);
  EXPECT_TRUE(holds(other) && holds(begin + ".tmp") && holds(begin + "-2.tmp"));
  EXPECT_TRUE(fs::is_symlink(begin + "-3.tmp"));
  EXPECT_FALSE(fs::exists(begin + "-4.tmp"));
  EXPECT_TRUE(fs::is_regular_file(path()));
}

TEST_F(RecordingTest, UnfinishedLeavesNothing) {
  {
    RecordingWriter writer(path(), some_info());
    writer.append(any_records(5000));
    EXPECT_EQ(files(), 1U);
  }
  EXPECT_EQ(files(), 0U);
}

TEST_F(RecordingTest, UnwritableFolderIsNamed) {
  EXPECT_THROW(RecordingWriter("/nowhere/at/all.h5", some_info()), RecordingError);
}

// A separate process that writes the given records and is killed, whatever it is doing. Shared
// memory tells how far it got.
class Killed {
 public:
  explicit Killed(std::span<const TickRecord> records) : records_(records) {
    void* const shared =
        mmap(nullptr, sizeof *given_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    given_ = new (shared) std::atomic<std::size_t>(0);
  }
  ~Killed() { munmap(given_, sizeof *given_); }
  Killed(const Killed&) = delete;
  Killed& operator=(const Killed&) = delete;

  // Kills it `wait_us` after it was given `after` records. Returns how many it had been given by
  // then.
  std::size_t write(const std::string& path, const RecordingInfo& info, std::size_t each,
                    std::size_t after, unsigned wait_us) {
    given_->store(0);
    const pid_t writer = fork();
    if (writer == 0) {
      RecordingWriter to(path, info);
      for (std::size_t done = 0; done < records_.size(); done += each) {
        to.append(records_.subspan(done, std::min(each, records_.size() - done)));
        given_->store(std::min(done + each, records_.size()));
      }
      to.finish(42, 0);
      _exit(0);
    }
    while (given_->load() < after) usleep(100);
    usleep(wait_us);
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    return given_->load();
  }
  std::string temporary_of(const std::string& path) const {
    for (const auto& each : fs::directory_iterator(fs::path(path).parent_path())) {
      if (each.path().extension() == ".tmp") return each.path().string();
    }
    return path;
  }

 private:
  std::span<const TickRecord> records_;
  std::atomic<std::size_t>* given_;
};

// Every row in the file is the one that was written, for both needles.
void expect_rows(const RecordingReader& reader, std::span<const TickRecord> records) {
  std::vector<TickRecord> rows(reader.ticks());
  for (std::uint32_t needle = 0; needle < 2; ++needle) {
    reader.read(0, rows, needle);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_TRUE(same(tick_columns(), &records[2 * i + needle], &rows[i])) << needle << " " << i;
    }
  }
}

// In a separate process, because its exit is tested too.
TEST_F(RecordingTest, AFullDiskIsAnErrorAndKeepsWhatWasWhole) {
  RecordingInfo info = some_info();
  info.config.needle_count = 2;
  auto records = any_records(20000);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].needle = i % 2;
    records[i].output.tick = i / 2 + 1;
  }
  const auto record_too_much = [&](rlim_t most) {
    const rlimit limit = {most, most};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    std::string refused;
    try {
      RecordingWriter writer(path(), info);
      writer.append(records);
      writer.finish(1, 0);
    } catch (const RecordingError& error) {
      refused = error.what();
    }
    // If it could not even begin, nothing is left; otherwise the message says where the rest lies.
    const bool told = files() == 0 || (files() == 1 && refused.find(".tmp") != std::string::npos);
    std::exit(!refused.empty() && told ? 3 : 4);
  };
  std::mt19937 random(5);
  std::size_t longest = 0;
  for (int i = 0; i < 12; ++i) {
    const rlim_t most = 20'000 + random() % 1'500'000;
    EXPECT_EXIT(record_too_much(most), testing::ExitedWithCode(3), "") << most;
    if (files() == 0) continue;
    const std::string left = fs::directory_iterator(folder_)->path().string();
    {
      const RecordingReader reader(left);
      EXPECT_EQ(reader.ticks() % 1000, 0U) << most;  // blocks of half a second
      expect_rows(reader, records);
      longest = std::max(longest, static_cast<std::size_t>(reader.ticks()));
    }
    fs::remove(left);
  }
  EXPECT_GT(longest, 1000U);
}

TEST_F(RecordingTest, AWriterThatIsKilledAtAnyTimeLosesHalfASecondAtMost) {
  RecordingInfo info = some_info();
  info.config.needle_count = 2;
  const std::size_t block = 1000;  // half a second in ticks of 0.5 ms
  auto records = any_records(8000);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].needle = i % 2;
    records[i].output.tick = i / 2 + 1;
  }
  Killed killed(records);
  std::mt19937 random(11);
  std::size_t in_the_middle = 0;
  for (int i = 0; i < 24; ++i) {
    const std::size_t each = 2 + random() % 600, after = 1 + random() % records.size();
    const auto wait_us = static_cast<unsigned>(random() % 20000);
    const std::size_t given = killed.write(path(), info, each, after, wait_us);
    const bool whole = fs::exists(path());
    const std::string left = whole ? path() : killed.temporary_of(path());
    const RecordingReader reader(left);
    EXPECT_EQ(reader.info().scene_text, info.scene_text);
    EXPECT_GE(reader.ticks() + block, given / 2) << "of " << given / 2;
    EXPECT_EQ(reader.info().lost_records, 0U);
    expect_rows(reader, records);
    EXPECT_TRUE(!whole || reader.ticks() == records.size() / 2);
    in_the_middle += reader.info().unfinished && reader.ticks() > 0 ? 1 : 0;
    fs::remove(left);
  }
  EXPECT_GT(in_the_middle, 2U);
}

TEST_F(RecordingTest, ARecordingIsReadWhileItGrows) {
  const auto records = any_records(3000);
  RecordingWriter writer(path(), some_info());
  writer.append(std::span(records).first(1999));
  const std::string growing = fs::directory_iterator(folder_)->path().string();
  const RecordingReader reader(growing);
  EXPECT_TRUE(reader.info().unfinished);
  ASSERT_EQ(reader.ticks(), 1000U);
  writer.append(std::span(records).subspan(1999));
  writer.finish(42, 0);
  EXPECT_FALSE(RecordingReader(path()).info().unfinished);
  EXPECT_EQ(RecordingReader(path()).ticks(), 3000U);
}

// While blocks are written, ticks_kept() is the number that a reader finds in the file at that
// time. It is what a user is told when a recorder was killed.
TEST_F(RecordingTest, TicksKeptAreKnownAfterEachBlock) {
  const auto records = any_records(3700);
  Ring<TickRecord> ring(4096);
  Ring<Event> events(16);
  for (const TickRecord& each : records) ASSERT_TRUE(ring.push(each));
  RecordingWriter writer(path(), some_info());
  const std::string growing = fs::directory_iterator(folder_)->path().string();
  std::uint64_t most = 0;
  const std::array<Course, 1> courses = {};
  Recorder recorder(ring, events, &writer, courses, nullptr, nullptr,
                    [&](std::span<const TickRecord>, std::span<const Event>) {
                      EXPECT_EQ(writer.ticks_kept(), RecordingReader(growing).ticks());
                      most = std::max(most, writer.ticks_kept());
                    });
  recorder.stop();
  EXPECT_EQ(recorder.error(), "");
  EXPECT_EQ(most, 3000U);  // blocks of half a second: 1000 ticks
}

TEST_F(RecordingTest, AnUnfinishedOneHasAllButItsEnd) {
  RecordingInfo info = some_info();
  info.config.needle_count = 2;
  auto records = any_records(2468);  // not a whole number of blocks
  for (std::size_t i = 0; i < records.size(); ++i) records[i].needle = i % 2;
  RecordingWriter writer(path(), info);
  writer.append(std::span(records));
  const std::string left = fs::directory_iterator(folder_)->path().string();
  EXPECT_EQ(writer.leave(), records.size() / 2);
  EXPECT_FALSE(fs::exists(path()));
  const RecordingReader reader(left);
  EXPECT_TRUE(reader.info().unfinished);
  EXPECT_EQ(reader.ticks(), records.size() / 2);
  expect_rows(reader, records);
}

// The snapshots that a run keeps are bounded, whatever its length, and are the newest.
TEST(Kept, TheNewestStay) {
  std::vector<int> kept;
  bool all = true;
  for (int i = 0; i < 1000; ++i) {
    all = keep_newest(kept, i, 64) && all;
    ASSERT_LE(kept.size(), 64U);
    ASSERT_EQ(kept.back(), i);
    ASSERT_EQ(all, i < 64) << i;
    for (std::size_t k = 1; k < kept.size(); ++k) ASSERT_EQ(kept[k], kept[k - 1] + 1);
    ASSERT_GE(kept.size(), std::min<std::size_t>(static_cast<std::size_t>(i) + 1, 33));
  }
}

TEST_F(RecordingTest, OtherFilesAreRefused) {
  EXPECT_THAT(refusal(path("none.h5")), testing::HasSubstr("none.h5: file: no such file"));
  std::ofstream(path("text.h5")) << "hello";
  EXPECT_THAT(refusal(path("text.h5")), testing::HasSubstr("not an HDF5 file"));
  std::ofstream(path("empty.h5")).flush();
  EXPECT_THAT(refusal(path("empty.h5")), testing::HasSubstr("empty.h5: file: is empty"));
}

TEST_F(RecordingTest, CutShortIsRefused) {
  {
    RecordingWriter writer(path(), some_info());
    writer.append(any_records(9000));
    writer.finish(1, 0);
  }
  const auto size = fs::file_size(path());
  for (const double share : {0.999, 0.9, 0.5, 0.1, 0.01}) {
    fs::copy_file(path(), path("cut.h5"), fs::copy_options::overwrite_existing);
    fs::resize_file(path("cut.h5"), static_cast<std::uintmax_t>(static_cast<double>(size) * share));
    EXPECT_THAT(refusal(path("cut.h5")), testing::HasSubstr("cut.h5: ")) << share;
  }
}

// Makes every column with this many rows longer without writing numbers, and changes the count of
// ticks accordingly.
void claim(const std::string& path, std::span<const Column> columns, hsize_t rows,
           std::uint64_t ticks) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  for (const Column& each : columns) {
    const hid_t set = H5Dopen2(file, each.name, H5P_DEFAULT);
    const hsize_t size[2] = {rows, each.width};
    ASSERT_GE(H5Dset_extent(set, size), 0);
    H5Dclose(set);
  }
  const hid_t attribute = H5Aopen(file, "ticks", H5P_DEFAULT);
  ASSERT_GE(H5Awrite(attribute, H5T_NATIVE_UINT64, &ticks), 0);
  H5Aclose(attribute);
  H5Fclose(file);
}

// HDF5 stores nothing for a row that was never written: a small file could claim more rows than any
// memory holds.
TEST_F(RecordingTest, RowsThatAreClaimedButNotStoredAreRefused) {
  const std::vector<Event> events = {{1, EventKind::kContact, 0, 0, 0.5F, 0, 0}};
  {
    RecordingWriter writer(path(), some_info());
    writer.append(any_records(2500));
    writer.append(events);
    writer.finish(1, 0);
  }
  std::mt19937_64 random(21);
  for (int i = 0; i < 20; ++i) {
    // More than the 3 chunks of 1000 rows of the ticks, and the one chunk of 64 rows of the events.
    const hsize_t rows = 3001 + random() % 10'000'000'000;
    fs::copy_file(path(), path("c.h5"), fs::copy_options::overwrite_existing);
    const bool of_events = i % 2 == 0;
    claim(path("c.h5"), of_events ? event_columns() : tick_columns(), rows,
          of_events ? 2500 : rows);
    EXPECT_THAT(refusal(path("c.h5")),
                testing::HasSubstr(std::to_string(rows) + " rows, of which the file holds " +
                                   (of_events ? "64" : "3000")));
  }
  // Of an unfinished recording the rows that exist are read.
  claim(path(), tick_columns(), 10'000'000'000, 0);
  EXPECT_EQ(RecordingReader(path()).ticks(), 3000U);
}

// A chunk is unpacked as a whole, however little of it is read; numbers in other files are not
// read.
TEST_F(RecordingTest, ColumnsStoredInAnotherWayThanWrittenAreBounded) {
  const auto with_column = [&](hsize_t chunk_rows, const char* outside) {
    {
      RecordingWriter writer(path(), some_info());
      writer.append(any_records(100));
      writer.finish(1, 0);
    }
    const hid_t file = H5Fopen(path().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, "output/force_n", H5P_DEFAULT);
    const hsize_t size[2] = {100, 3}, limit[2] = {chunk_rows == 0 ? 100 : H5S_UNLIMITED, 3};
    const hsize_t chunk[2] = {chunk_rows, 3};
    const hid_t space = H5Screate_simple(2, size, limit);
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    if (chunk_rows > 0) {
      H5Pset_chunk(list, 2, chunk);
      H5Pset_deflate(list, 9);
    }
    if (outside != nullptr) H5Pset_external(list, outside, 0, H5F_UNLIMITED);
    const hid_t set =
        H5Dcreate2(file, "output/force_n", H5T_IEEE_F32LE, space, H5P_DEFAULT, list, H5P_DEFAULT);
    const std::vector<float> zeros(300);
    if (outside == nullptr) {
      EXPECT_GE(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros.data()), 0);
    }
    H5Dclose(set);
    H5Pclose(list);
    H5Sclose(space);
    H5Fclose(file);
    return refusal(path());
  };
  EXPECT_EQ(with_column(0, nullptr), "not refused");
  EXPECT_EQ(with_column(7, nullptr), "not refused");
  EXPECT_EQ(with_column(2 * 1024 * 1024 / 12, nullptr), "not refused");
  EXPECT_THAT(with_column(2 * 1024 * 1024 / 12 + 1, nullptr),
              testing::HasSubstr("output/force_n: chunks of 174763 x 3 numbers: expected at most "
                                 "2097152 bytes in a chunk"));
  EXPECT_THAT(with_column(0, "/dev/zero"),
              testing::HasSubstr("output/force_n: 100 rows, of which the file holds 0"));
}

TEST_F(RecordingTest, AFlippedBitInTheDataIsRefused) {
  {
    RecordingWriter writer(path(), some_info());
    writer.append(any_records(9000));
    writer.finish(1, 0);
  }
  std::ifstream in(path(), std::ios::binary);
  std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
  // Random records do not compress: nearly all of the file is column data.
  for (const double share : {0.4, 0.6, 0.8}) {
    std::vector<char> bad = bytes;
    char& byte = bad[static_cast<std::size_t>(static_cast<double>(bad.size()) * share)];
    byte = static_cast<char>(byte ^ 16);
    std::ofstream out(path("bad.h5"), std::ios::binary);
    out.write(bad.data(), static_cast<std::streamsize>(bad.size()));
    out.close();
    EXPECT_THAT(refusal(path("bad.h5")), testing::HasSubstr("damaged")) << share;
  }
}

}  // namespace
}  // namespace stylet::hal
