// SPDX-License-Identifier: Apache-2.0
// The program with its console, steered as a page steers it: attempts one after the other, paused
// and reset, give the same bits as without any of that.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "client.h"
#include "hal/record/recording.h"
#include "tiny_organ.h"

namespace stylet::console::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = R"([organ]
path = "tiny.organ"
[loop]
hash_every_ticks = 10
[approach]
start_mm = 1
[guard]
ramp_ms = 0
[[hand.waypoint]]
travel_mm = 15
speed_mm_s = 50
[[targets]]
name = "middle"
at_mm = [10, 10, 10]
radius_mm = 3
)";

// The program in a folder of its own, until the end of the test.
class Program {
 public:
  Program() {
    folder_ = fs::temp_directory_path() / ("stylet-program-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    write_organ("tiny.organ", 4);
    std::ofstream(folder_ / "first.toml") << kScene;
    std::ofstream(folder_ / "second.toml") << kScene;
    std::ofstream(folder_ / "tissues.toml") << "[gel]\n";
  }
  ~Program() {
    end();
    fs::remove_all(folder_);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void write_organ(const std::string& name, std::uint16_t voxels_x) const {
    stylet::test::TinyOrgan tiny;
    tiny.nx = voxels_x;
    tiny.ny = tiny.nz = 4;
    tiny.fixed_faces = stylet::test::kHighX;
    tiny.materials[0].puncture_force_n = 0.2F;
    const auto bytes = stylet::test::tiny_organ(tiny);
    std::ofstream(folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  // Starts it; its output goes to a file.
  void start(std::vector<std::string> words) {
    words.insert(words.begin(), STYLET_PROGRAM);
    std::vector<char*> argv;
    for (std::string& each : words) argv.push_back(each.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, at("out").c_str(), O_CREAT | O_WRONLY | O_TRUNC,
                                     0600);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    ASSERT_EQ(posix_spawn(&pid_, STYLET_PROGRAM, &actions, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }

  // From the address that it prints; 0: it printed none in time.
  std::uint16_t port() {
    for (int i = 0; i < 1000; ++i) {
      const std::string text = output();
      const auto begin = text.find("http://127.0.0.1:");
      if (begin != std::string::npos && text.find('\n', begin) != std::string::npos) {
        return static_cast<std::uint16_t>(std::stoul(text.substr(begin + 17)));
      }
      usleep(20'000);
    }
    return 0;
  }

  std::string output() const {
    std::ifstream in(at("out"));
    return {std::istreambuf_iterator<char>(in), {}};
  }

  // Ctrl-C; the exit code.
  int end() {
    if (pid_ == 0) return -1;
    kill(pid_, SIGINT);
    return wait();
  }

  // Its process of this role; 0: none.
  pid_t beside(const std::string& role) const {
    const std::string proc = "/proc/" + std::to_string(pid_);
    std::ifstream children(proc + "/task/" + std::to_string(pid_) + "/children");
    for (pid_t child = 0; children >> child;) {
      std::ifstream in("/proc/" + std::to_string(child) + "/cmdline");
      const std::string words{std::istreambuf_iterator<char>(in), {}};
      if (words.find(std::string("beside\0", 7) + role) != std::string::npos) return child;
    }
    return 0;
  }

  // Stops it for so long, as a busy machine would.
  void stall(useconds_t us) const {
    kill(pid_, SIGSTOP);
    usleep(us);
    kill(pid_, SIGCONT);
  }

  std::set<pid_t> threads() const {
    std::set<pid_t> found;
    for (const auto& each : fs::directory_iterator("/proc/" + std::to_string(pid_) + "/task")) {
      found.insert(std::stoi(each.path().filename()));
    }
    return found;
  }

  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  fs::path folder_;
  pid_t pid_ = 0;
};

auto verb(Body type) {
  return page_message(type, [type](auto& b) -> flatbuffers::Offset<void> {
    if (type == Body::Pause) return CreatePause(b).Union();
    if (type == Body::Resume) return CreateResume(b).Union();
    if (type == Body::Reset) return CreateReset(b).Union();
    if (type == Body::End) return CreateEnd(b).Union();
    return CreateStart(b, b.CreateString("A. Trainee")).Union();
  });
}

auto pointer_at(float z_m) {
  return page_message(Body::Pointer, [z_m](auto& b) {
    const Vec3 place(0, 0, z_m);
    const Quaternion straight(1, 0, 0, 0);
    return CreatePointer(b, 0, &place, &straight, 1);
  });
}

bool await(Client& client, Activity activity) {
  return client.next_of<Frame>(Body::Frame, [activity](const Frame& frame) {
    return frame.activity() == activity;
  }) != nullptr;
}

std::uint64_t final_hash(const std::string& recording) {
  return hal::RecordingReader(recording).info().final_state_hash;
}

TEST(Program, AttemptsGiveTheBitsOfARunWithoutConsole) {
  Program program;
  program.start({"run", program.at("first.toml"), "--fast", "--record", program.at("plain.h5"),
                 "--flight", program.at("flight.h5")});
  ASSERT_EQ(program.wait(), 0) << program.output();
  program.start({"run", program.at("first.toml"), "--fast", "--record", program.at("out.h5"),
                 "--flight", program.at("flight.h5"), "--console=0"});
  const std::uint16_t port = program.port();
  ASSERT_NE(port, 0) << program.output();
  Client client(port);
  ASSERT_EQ(client.join(), 101U);
  const Hello* hello = client.next_of<Hello>(Body::Hello);
  ASSERT_NE(hello, nullptr);
  EXPECT_EQ(hello->scene()->str(), "first.toml");
  ASSERT_EQ(hello->scenes()->size(), 2U);  // tissues.toml is not a scene
  ASSERT_EQ(hello->targets()->size(), 1U);
  EXPECT_EQ(hello->targets()->Get(0)->name()->str(), "middle");
  for (std::uint32_t attempt = 1; attempt <= 2; ++attempt) {
    client.say_message(verb(Body::Start));
    const Score* score = client.next_of<Score>(Body::Score);
    ASSERT_NE(score, nullptr) << program.output();
    EXPECT_EQ(score->attempt(), attempt);
    EXPECT_EQ(score->recording()->str(), "out-" + std::to_string(attempt) + ".h5");
    EXPECT_EQ(score->targets()->size(), 1U);
    EXPECT_GT(score->path_m(), 0.01F);
    EXPECT_TRUE(await(client, Activity::Ended));
  }
  EXPECT_EQ(program.end(), 0) << program.output();
  const std::uint64_t expected = final_hash(program.at("plain.h5"));
  EXPECT_EQ(final_hash(program.at("out-1.h5")), expected);
  EXPECT_EQ(final_hash(program.at("out-2.h5")), expected);
}

// A run that ends only by --duration-s: some seconds of real time, fewer than hal::kSidePatienceS,
// after which the process of a page that does not move is ended. With the thread sanitizer each of
// them takes longer.
#if defined(__SANITIZE_THREAD__)
constexpr const char* kLongRunS = "4";
#else
constexpr const char* kLongRunS = "30";
#endif
std::vector<std::string> long_run(const Program& program, const std::string& record) {
  return {"run",      program.at("first.toml"), "--fast",       "--record", program.at(record),
          "--flight", program.at("flight.h5"),  "--duration-s", kLongRunS};
}

// Killed, crashed, starved or stopped at any time: the same bits, one line, one counter.
TEST(Program, ThePageMayEndInAnyWay) {
  Program program;
  program.start(long_run(program, "plain.h5"));
  ASSERT_EQ(program.wait(), 0) << program.output();
  const std::uint64_t expected = final_hash(program.at("plain.h5"));
  std::mt19937 random(28);
  for (const int way : {SIGKILL, SIGABRT, SIGSTOP, 0}) {
    auto words = long_run(program, "out" + std::to_string(way) + ".h5");
    words.push_back("--console=0");
    program.start(words);
    const std::uint16_t port = program.port();
    ASSERT_NE(port, 0) << program.output();
    Client client(port);
    ASSERT_EQ(client.join(), 101U);
    client.say_message(verb(Body::Start));
    ASSERT_TRUE(await(client, Activity::Running)) << program.output();
    const pid_t page = program.beside("console");
    ASSERT_GT(page, 0);
    usleep(static_cast<useconds_t>(random() % 400'000));
    const rlimit little = {1U << 20U, 1U << 20U};
    if (way == 0) {
      ASSERT_EQ(prlimit(page, RLIMIT_AS, &little, nullptr), 0);
      for (int i = 0; i < 30; ++i) Client(port).get("/organ");
    } else {
      ASSERT_EQ(kill(page, way), 0);
    }
    const std::string recording = program.at("out" + std::to_string(way) + "-1.h5");
    for (int i = 0; i < 3000 && !fs::exists(recording); ++i) usleep(20'000);
    EXPECT_EQ(final_hash(recording), expected) << way;
    const bool lost = way == SIGKILL || way == SIGABRT;
    // What the program says of a lost console is complete when it ends, but perhaps not yet when
    // its recording is there. Of a console that is ended together with the run it may say anything.
    std::string told = program.output();
    const int code = lost ? program.wait() : program.end();
    if (lost) told = program.output();
    EXPECT_TRUE(code == 3 || (!lost && code == 0)) << code << program.output();
    EXPECT_EQ(told.find("the console ended: signal") != std::string::npos, lost) << way << told;
  }
}

// In real time, so that there is something to hold; the machine may refuse the rights for it.
TEST(Program, APauseIsNotInTheRecording) {
  Program program;
  program.start({"run", program.at("first.toml"), "--fast", "--record", program.at("plain.h5"),
                 "--flight", program.at("flight.h5")});
  ASSERT_EQ(program.wait(), 0) << program.output();
  program.start({"run", program.at("first.toml"), "--allow-non-rt", "--record",
                 program.at("out.h5"), "--flight", program.at("flight.h5"), "--console=0"});
  const std::uint16_t port = program.port();
  ASSERT_NE(port, 0) << program.output();
  Client client(port);
  ASSERT_EQ(client.join(), 101U);
  client.say_message(verb(Body::Start));
  client.say_message(verb(Body::Pause));
  ASSERT_TRUE(await(client, Activity::Paused)) << program.output();
  client.say_message(verb(Body::Start));  // is refused while one is held
  EXPECT_NE(client.next_of<Refused>(Body::Refused), nullptr);
  client.say_message(verb(Body::Resume));
  const Score* score = client.next_of<Score>(Body::Score);
  ASSERT_NE(score, nullptr) << program.output();
  const std::uint32_t faults = score->faults();
  EXPECT_TRUE(await(client, Activity::Ended));
  client.say_message(verb(Body::Reset));
  EXPECT_TRUE(await(client, Activity::Ready));
  program.end();
  const hal::RecordingReader plain(program.at("plain.h5")), held(program.at("out-1.h5"));
  EXPECT_EQ(held.ticks(), plain.ticks());
  if (faults > 0) GTEST_SKIP() << "the machine was too slow for real time: the guard let go";
  EXPECT_EQ(held.info().final_state_hash, plain.info().final_state_hash);
}

// A run whose hand is the pointer of a page; gives the page's port.
std::uint16_t run_with_pointer(Program& program) {
  program.start({"run", program.at("first.toml"), "--device", "pointer:", "--allow-non-rt",
                 "--record", program.at("out.h5"), "--flight", program.at("flight.h5"),
                 "--console=0"});
  return program.port();
}

// A teacher's page sets marks in what the trainee's page does; the recording keeps them.
TEST(Program, MarksAreInTheRecordingAndOnItsPage) {
  Program program;
  const std::uint16_t port = run_with_pointer(program);
  ASSERT_NE(port, 0) << program.output();
  Client trainee(port);
  ASSERT_EQ(trainee.join(), 101U);
  ASSERT_NE(trainee.next_of<Hello>(Body::Hello), nullptr) << program.output();
  Client teacher(port);
  ASSERT_EQ(teacher.join(), 101U);
  trainee.say_message(verb(Body::Start));
  ASSERT_NE(teacher.next_of<Frame>(Body::Frame, [](const Frame& f) { return f.tick() > 100; }),
            nullptr)
      << program.output();
  teacher.say_message(page_message(
      Body::Mark, [](auto& b) { return CreateMark(b, b.CreateString("slower,\tplease")); }));
  const Marked* mark = trainee.next_of<Marked>(Body::Marked);
  ASSERT_NE(mark, nullptr);
  EXPECT_EQ(mark->text()->str(), "slower, please");
  const std::uint64_t tick = mark->tick();
  EXPECT_GT(tick, 100U);
  EXPECT_EQ(mark->attempt(), 1U);
  const std::time_t before = std::time(nullptr);
  trainee.say_message(verb(Body::End));
  ASSERT_NE(trainee.next_of<Score>(Body::Score), nullptr);
  EXPECT_TRUE(await(trainee, Activity::Ended));  // its end stays to be seen
  program.end();
  const hal::RecordingReader recording(program.at("out-1.h5"));
  EXPECT_EQ(recording.info().trainee, "A. Trainee");
  std::tm began = {};
  ASSERT_NE(strptime(recording.info().began.c_str(), "%Y-%m-%dT%H:%M:%S", &began), nullptr);
  began.tm_isdst = -1;
  EXPECT_NEAR(static_cast<double>(std::mktime(&began)), static_cast<double>(before), 60);
  ASSERT_EQ(recording.marks().size(), 1U);
  EXPECT_EQ(recording.marks()[0].tick, tick);
  EXPECT_EQ(recording.marks()[0].text, "slower, please");
  program.start({"console", program.at("out-1.h5"), "--port", "0"});
  Client reader(program.port());
  ASSERT_EQ(reader.join(), 101U);
  const Marked* kept = reader.next_of<Marked>(Body::Marked);
  ASSERT_NE(kept, nullptr) << program.output();
  EXPECT_EQ(kept->tick(), tick);
}

// Forward by a pointer until the tissue is felt.
constexpr float kFeltN = 0.02F;  // of 0.2 that break through
struct Touched {
  float place_m = 0, force_n = 0, depth_m = 0;
};
Touched touch(Client& client) {
  Touched out;
  for (int step = 0; step <= 100 && out.force_n < kFeltN; ++step) {
    out.place_m = -1e-4F * static_cast<float>(step);
    client.say_message(pointer_at(out.place_m));
    const Frame* frame = client.next_of<Frame>(Body::Frame);
    if (frame == nullptr) break;
    const NeedleFrame& needle = *frame->needles()->Get(0);
    out.force_n = std::abs(needle.force_n()->x());
    out.depth_m = needle.depth_m();
  }
  return out;
}

// The whole way, from the pointer's messages through guard and kernel to the force that the page
// draws; and the counters of the attempt while it runs.
TEST(Program, APointerOnAPageFeelsTheTissue) {
  Program program;
  const std::uint16_t port = run_with_pointer(program);
  ASSERT_NE(port, 0) << program.output();
  Client client(port);
  ASSERT_EQ(client.join(), 101U);
  client.say_message(verb(Body::Start));
  ASSERT_TRUE(await(client, Activity::Running)) << program.output();
  const Touched touched = touch(client);
  EXPECT_GE(touched.force_n, kFeltN) << program.output();
  EXPECT_GE(touched.depth_m, 0);
  std::string body;
  Client counters(port);
  counters.get("/metrics");
  EXPECT_EQ(counters.answer(&body), 200U);
  EXPECT_NE(body.find("stylet_running 1\n"), std::string::npos);
  EXPECT_NE(body.find("stylet_console_lost_frames_total "), std::string::npos);
  EXPECT_EQ(body.find("stylet_ticks_total 0\n"), std::string::npos);
  client.say_message(verb(Body::Reset));
  const Score* score = client.next_of<Score>(Body::Score);
  ASSERT_NE(score, nullptr) << program.output();
  EXPECT_GE(score->peak_force_n(), kFeltN);
}

// What a frame told of a fault.
struct Told {
  std::string fault;
  std::uint32_t number;
  std::int64_t time_ns;

  auto acknowledgement() const {
    return page_message(Body::Acknowledge, [this](auto& b) {
      return CreateAcknowledge(b, 0, b.CreateString(fault), number, time_ns);
    });
  }
};
// The next frame with a fault of another number than `last`, while the pointer stays.
Told next_fault(Client& client, float place_m, std::uint32_t last) {
  for (int i = 0; i < 1000; ++i) {
    client.say_message(pointer_at(place_m));
    const Frame* frame = client.next_of<Frame>(Body::Frame);
    if (frame == nullptr) break;
    const NeedleFrame& needle = *frame->needles()->Get(0);
    if (needle.fault() == nullptr || needle.fault_number() == last) continue;
    return {needle.fault()->str(), needle.fault_number(), frame->time_ns()};
  }
  return {};
}

// An acknowledgement is for one fault, the one that was seen, and holds for one second: if it is
// held up on its way, it brings no force back after the next fault. A busy machine adds faults of
// its own.
TEST(Program, AnAcknowledgementIsForTheFaultThatWasSeen) {
  Program program;
  const std::uint16_t port = run_with_pointer(program);
  ASSERT_NE(port, 0) << program.output();
  Client client(port);
  ASSERT_EQ(client.join(), 101U);
  client.say_message(verb(Body::Start));
  ASSERT_TRUE(await(client, Activity::Running)) << program.output();
  const Touched touched = touch(client);  // before any force a fault clears itself
  ASSERT_GE(touched.force_n, kFeltN) << program.output();
  std::vector<Told> seen;
  for (int round = 0; round < 3; ++round) {
    program.stall(60'000);
    const Told told = next_fault(client, touched.place_m, seen.empty() ? 0 : seen.back().number);
    ASSERT_FALSE(told.fault.empty()) << program.output();
    seen.push_back(told);
    const Told other = {told.fault, told.number + 1, told.time_ns};
    const Told early = {told.fault, told.number, told.time_ns - 2'000'000'000};
    const Told late = {told.fault, told.number, told.time_ns + 60'000'000'000};
    for (const Told& wrong : {other, early, late, Told{"buzz", told.number, told.time_ns},
                              Told{told.fault, seen.front().number, told.time_ns}}) {
      if (wrong.number == told.number && wrong.time_ns == told.time_ns &&
          wrong.fault == told.fault) {
        continue;  // the first one itself
      }
      client.say_message(wrong.acknowledgement());
      const Refused* refused = client.next_of<Refused>(Body::Refused);
      ASSERT_NE(refused, nullptr) << program.output();
      EXPECT_NE(refused->what()->str().find("acknowledge: "), std::string::npos);
    }
    bool cleared = false;
    for (int attempt = 0; attempt < 100 && !cleared; ++attempt) {
      const Told now = next_fault(client, touched.place_m, 0);
      ASSERT_FALSE(now.fault.empty()) << program.output();
      seen.back() = now;
      client.say_message(now.acknowledgement());
      const Frame* frame = nullptr;
      for (int i = 0; i < 30 && !cleared; ++i) {
        client.say_message(pointer_at(touched.place_m));
        ASSERT_NE(frame = client.next_of<Frame>(Body::Frame), nullptr) << program.output();
        // A slow machine may have latched the next one before this frame.
        const NeedleFrame& needle = *frame->needles()->Get(0);
        cleared = needle.fault() == nullptr || needle.fault_number() != now.number;
      }
    }
    EXPECT_TRUE(cleared) << round;
  }
}

TEST(Program, ARecordingIsPlayedAndAnotherSceneChosen) {
  Program program;
  program.start({"run", program.at("first.toml"), "--fast", "--record", program.at("plain.h5"),
                 "--flight", program.at("flight.h5"), "--console=0"});
  {
    Client client(program.port());
    ASSERT_EQ(client.join(), 101U);
    client.say_message(page_message(
        Body::Choose, [](auto& b) { return CreateChoose(b, b.CreateString("../first.toml")); }));
    EXPECT_NE(client.next_of<Refused>(Body::Refused), nullptr);
    client.say_message(page_message(
        Body::Choose, [](auto& b) { return CreateChoose(b, b.CreateString("second.toml")); }));
    EXPECT_NE(client.next_of<Hello>(
                  Body::Hello, [](const Hello& h) { return h.scene()->str() == "second.toml"; }),
              nullptr);
    client.say_message(verb(Body::Start));
    EXPECT_NE(client.next_of<Score>(Body::Score), nullptr) << program.output();
  }
  EXPECT_EQ(program.end(), 0) << program.output();
  program.start({"console", program.at("plain-1.h5"), "--port", "0"});
  Client client(program.port());
  ASSERT_EQ(client.join(), 101U);
  client.say_message(page_message(Body::Seek, [](auto& b) { return CreateSeek(b, 200); }));
  const Score* score = client.next_of<Score>(Body::Score);
  ASSERT_NE(score, nullptr);
  EXPECT_EQ(score->recording()->str(), "plain-1.h5");
  EXPECT_GT(score->path_m(), 0.01F);
  EXPECT_GT(score->rows()->size(), 100U);
  const Frame* frame =
      client.next_of<Frame>(Body::Frame, [](const Frame& f) { return f.tick() == 200; });
  ASSERT_NE(frame, nullptr) << program.output();
  std::vector<hal::TickRecord> row(1);
  hal::RecordingReader(program.at("plain-1.h5")).read(199, row);
  EXPECT_EQ(frame->needles()->Get(0)->force_n()->x(), row[0].output.force_n.x);
  EXPECT_EQ(program.end(), 0);
  fs::remove(program.at("tiny.organ"));
  program.start({"console", program.at("plain-1.h5"), "--port", "0"});
  EXPECT_EQ(program.wait(), 1);
  EXPECT_NE(program.output().find("give it with --organ"), std::string::npos) << program.output();
}

// --organ is for the scene with which it was given: the next scene's targets lie in an organ of its
// own.
TEST(Program, AnotherSceneHasAnOrganOfItsOwn) {
  Program program;
  program.write_organ("given.organ", 5);
  program.start({"run", program.at("first.toml"), "--organ", program.at("given.organ"), "--fast",
                 "--flight", program.at("flight.h5"), "--console=0"});
  Client client(program.port());
  ASSERT_EQ(client.join(), 101U);
  const auto voxels = [&client](const char* scene) {
    const Hello* hello = client.next_of<Hello>(
        Body::Hello, [scene](const Hello& h) { return h.scene()->str() == scene; });
    return hello == nullptr ? 0 : hello->corners()->size() / 8;
  };
  EXPECT_EQ(voxels("first.toml"), 5 * 4 * 4U) << program.output();
  for (const auto& each : {std::pair("second.toml", 64U), {"first.toml", 80U}}) {
    client.say_message(page_message(
        Body::Choose, [&](auto& b) { return CreateChoose(b, b.CreateString(each.first)); }));
    EXPECT_EQ(voxels(each.first), each.second) << program.output();
  }
}

// systemd's end of sd_notify: counts the messages that say that the program is alive.
class Notified {
 public:
  static constexpr int kWatchdogMs = 400;

  explicit Notified(const std::string& address) {
    sockaddr_un here{};
    here.sun_family = AF_UNIX;
    address.copy(here.sun_path, sizeof here.sun_path - 1);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here), 0) << address;
    setenv("NOTIFY_SOCKET", address.c_str(), 1);
    setenv("WATCHDOG_USEC", std::to_string(1000 * kWatchdogMs).c_str(), 1);
  }
  ~Notified() {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
    close(socket_);
  }
  Notified(const Notified&) = delete;
  Notified& operator=(const Notified&) = delete;

  int lives() const {
    int count = 0;
    char word[64];
    for (ssize_t size = 0; (size = recv(socket_, word, sizeof word, 0)) > 0;) {
      count += std::string_view(word, static_cast<std::size_t>(size)) == "WATCHDOG=1" ? 1 : 0;
    }
    return count;
  }
  int lives_within_ms(int ms) const {
    (void)lives();
    usleep(static_cast<useconds_t>(1000 * ms));
    return lives();
  }

 private:
  int socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
};

// Stops only these threads, as a debugger does. False: this machine does not allow it.
bool halt(const std::set<pid_t>& threads) {
  return std::ranges::all_of(threads, [](pid_t thread) {
    if (ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) != 0) return false;
    ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr);
    return waitpid(thread, nullptr, __WALL) == thread;
  });
}

// If the loop of an attempt stands still, systemd's watchdog is told nothing and ends the program,
// although the session's thread and the page still run.
TEST(Program, TellsTheWatchdogOnlyWhileAnAttemptTicks) {
  Program program;
  const Notified systemd(program.at("notify"));
  const std::uint16_t port = run_with_pointer(program);
  ASSERT_NE(port, 0) << program.output();
  Client client(port);
  ASSERT_EQ(client.join(), 101U);
  const std::set<pid_t> before = program.threads();
  EXPECT_GE(systemd.lives_within_ms(5 * Notified::kWatchdogMs), 2) << "ready";
  client.say_message(verb(Body::Start));
  ASSERT_TRUE(await(client, Activity::Running)) << program.output();
  EXPECT_GE(systemd.lives_within_ms(5 * Notified::kWatchdogMs), 2) << "running";

  std::set<pid_t> attempt;
  std::ranges::set_difference(program.threads(), before, std::inserter(attempt, attempt.end()));
  ASSERT_FALSE(attempt.empty());
  if (!halt(attempt)) GTEST_SKIP() << "this user may not stop a thread of his own program";
  (void)systemd.lives_within_ms(Notified::kWatchdogMs);  // what was under way
  EXPECT_EQ(systemd.lives_within_ms(5 * Notified::kWatchdogMs), 0) << "halted";
  for (const pid_t thread : attempt) ptrace(PTRACE_DETACH, thread, nullptr, nullptr);
  EXPECT_GE(systemd.lives_within_ms(5 * Notified::kWatchdogMs), 2) << "goes on";
  program.end();
}

}  // namespace
}  // namespace stylet::console::test
