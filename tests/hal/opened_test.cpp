// SPDX-License-Identifier: Apache-2.0
// What the doctor says of a device in a network. A program sends samples over UDP and a way with
// given faults lies between, in a process in virtual time: the numbers expected are those of the
// faults. What only a real machine shows is judged from made-up measurements.
#include "hal/doctor/opened.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "device_bench.h"
#include "hal/base/clock.h"
#include "hal/device/devices.h"
#include "hal/device/link.h"
#include "hal/device/packet.h"
#include "virtual_process.h"

namespace stylet::hal {

void PrintTo(const Verdict verdict, std::ostream* out) {
  *out << verdict_name(verdict);
}

namespace {

using Findings = std::map<std::string, Finding>;
using Verdicts = std::map<std::string, Verdict>;
constexpr std::int64_t kMs = 1'000'000;

// What lies between the program that sends and Stylet.
struct Way {
  std::int64_t period_ns = kMs;
  std::uint64_t drop_every = 0, spoil_every = 0;  // packets; 0: none
  std::int64_t pause_every_ns = 0, pause_ns = 0;  // in which nothing is sent
  std::function<std::int64_t(std::int64_t now_ns)> delay_ns = {};
  bool deaf = false;  // nothing comes back
};

// A program that sends samples by that way, and answers the newest force.
class Sender {
 public:
  Sender(const std::string& port, Way way)
      : way_(std::move(way)), link_(udp_connect("127.0.0.1:" + port)), thread_([this] { run(); }) {}
  ~Sender() {
    stop_ = true;
    thread_.join();
    link_.close(link_.self);
  }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

 private:
  void run() {
    const std::int64_t start_ns = test::virtual_now_ns();
    for (std::int64_t next_ns = start_ns; !stop_; next_ns += way_.period_ns) {
      test::sleep_until_virtual(next_ns);
      hear();
      const std::int64_t passed_ns = next_ns - start_ns;
      const bool pauses =
          way_.pause_every_ns > 0 && passed_ns % way_.pause_every_ns < way_.pause_ns;
      if (!pauses) send(next_ns);
      flush(next_ns);
    }
  }
  void hear() {
    std::array<std::byte, kMaxPacketBytes> room;
    ForcePacket force;
    while (const auto got = link_.receive(link_.self, room)) {
      if (!way_.deaf && decode(std::span(room).first(*got), force)) sample_.echo = force.seq;
    }
  }
  void send(std::int64_t now_ns) {
    ++sample_.seq;
    sample_.session = 3;
    sample_.t_ns = now_ns;
    sample_.pose = {{}, {1, 0, 0, 0}};
    sample_.limits = {.max_force_n = 3};
    const auto bytes = encode(sample_);
    Packet packet = {now_ns + (way_.delay_ns ? way_.delay_ns(now_ns) : 0),
                     {bytes.begin(), bytes.end()}};
    if (way_.spoil_every > 0 && sample_.seq % way_.spoil_every == 0) {
      packet.second[60] ^= std::byte{1};
    }
    if (way_.drop_every == 0 || sample_.seq % way_.drop_every != 0) going_.push_back(packet);
  }
  void flush(std::int64_t now_ns) {
    for (std::size_t i = 0; i < going_.size();) {
      if (going_[i].first > now_ns) {
        ++i;
        continue;
      }
      link_.send(link_.self, going_[i].second);
      going_.erase(going_.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  using Packet = std::pair<std::int64_t, std::vector<std::byte>>;  // when it comes
  Way way_;
  Link link_;
  SamplePacket sample_ = {};
  std::vector<Packet> going_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

Findings by_name(const std::vector<Finding>& findings) {
  Findings all;
  for (const Finding& each : findings) all[each.name] = each;
  return all;
}

struct Judged {
  Findings findings;
  std::unique_ptr<DeviceProbe> probe = std::make_unique<DeviceProbe>();

  Verdicts verdicts() const {
    Verdicts all;
    for (const auto& [name, finding] : findings) all[name] = finding.verdict;
    return all;
  }
  std::string value(const std::string& name) const { return findings.at(name).value; }
};

// Opens and watches the device for a second, as `stylet doctor --device` does.
Judged watched(const Way& way) {
  test::enter_virtual_time() = {};
  Judged judged;
  const Sender sender(test_port(), way);
  const std::string uri = "udp:" + test_port();
  const Device device = open_device(uri);
  const std::atomic<bool> stop{false};
  probe_device(device, 1, false, monotonic_clock(), stop, *judged.probe);
  judged.findings = by_name(judge_opened(uri, device, *judged.probe));
  device.close(device.self);
  for (const auto& [name, finding] : judged.findings) {
    EXPECT_EQ(finding.source, uri) << name;
    EXPECT_EQ(finding.remedy.empty(), finding.verdict == Verdict::kOk) << name;
  }
  return judged;
}

const Verdicts kAllOk = {{"device opens", Verdict::kOk},   {"device samples", Verdict::kOk},
                         {"device packets", Verdict::kOk}, {"device forces", Verdict::kOk},
                         {"device gaps", Verdict::kOk},    {"device delay", Verdict::kOk},
                         {"device state", Verdict::kOk}};

Verdicts all_ok_but(const std::string& name, Verdict verdict) {
  Verdicts all = kAllOk;
  all[name] = verdict;
  return all;
}

TEST(OpenedDevice, OnAGoodWayEverythingIsOk) {
  const Judged good = watched({});
  EXPECT_EQ(good.verdicts(), kAllOk);
  EXPECT_THAT(good.value("device opens"), testing::HasSubstr("at most 3 N"));
  EXPECT_NEAR(static_cast<double>(good.probe->samples), 1000, 2);
  EXPECT_EQ(good.probe->packets->lost + good.probe->packets->late, 0U);
  EXPECT_NEAR(static_cast<double>(good.probe->packets->came), 1000, 2);
}

TEST(OpenedDevice, LostPacketsAreCountedAndTooManyFail) {
  const Judged some = watched({.drop_every = 20}), many = watched({.drop_every = 5});
  EXPECT_EQ(some.verdicts(), all_ok_but("device packets", Verdict::kWarn));
  EXPECT_NEAR(static_cast<double>(some.probe->packets->lost), 1000.0 / 20, 1);
  EXPECT_EQ(many.verdicts(), all_ok_but("device packets", Verdict::kFail));
  EXPECT_NEAR(static_cast<double>(many.probe->packets->lost), 1000.0 / 5, 1);
}

TEST(OpenedDevice, SpoiltPacketsAreUselessAndTheirSamplesLost) {
  const Judged spoilt = watched({.spoil_every = 25});
  EXPECT_EQ(spoilt.verdicts(), all_ok_but("device packets", Verdict::kWarn));
  EXPECT_NEAR(static_cast<double>(spoilt.probe->packets->useless), 1000.0 / 25, 1);
  EXPECT_NEAR(static_cast<double>(spoilt.probe->packets->lost), 1000.0 / 25, 1);
}

// Every tenth packet takes 4 ms longer than the others.
TEST(OpenedDevice, OvertakenPacketsAreLateAndNotLost) {
  std::int64_t packet = 0;
  const Judged late =
      watched({.delay_ns = [&packet](std::int64_t) { return ++packet % 10 == 0 ? 4 * kMs : 0; }});
  EXPECT_EQ(late.verdicts(), all_ok_but("device packets", Verdict::kWarn));
  EXPECT_NEAR(static_cast<double>(late.probe->packets->late), 1000.0 / 10, 1);
  EXPECT_LE(late.probe->packets->lost, 1U);
}

// A gap of n periods of 1 ms without a sample: n + 1 ms from sample to sample. A fault is at 15 ms.
TEST(OpenedDevice, GapsAreComparedWithTheWatchdog) {
  for (const auto& [pause_ms, verdict] :
       {std::pair{5, Verdict::kOk}, std::pair{10, Verdict::kWarn}, std::pair{16, Verdict::kFail}}) {
    const Judged judged = watched({.pause_every_ns = 100 * kMs, .pause_ns = pause_ms * kMs});
    EXPECT_EQ(judged.findings.at("device gaps").verdict, verdict) << pause_ms;
    EXPECT_NEAR(static_cast<double>(judged.probe->longest_gap_ns) * 1e-6, pause_ms + 1, 1);
    EXPECT_EQ(judged.findings.at("device packets").verdict, Verdict::kOk) << pause_ms;
  }
}

// The way becomes longer and shorter again, so slowly that no packet overtakes another. The guard
// refuses what is 15 ms older than the shortest way allows.
TEST(OpenedDevice, DelaysAreComparedWithTheWatchdog) {
  for (const auto& [most_ms, verdict] :
       {std::pair{5, Verdict::kOk}, std::pair{10, Verdict::kWarn}, std::pair{20, Verdict::kFail}}) {
    const auto delay_ns = [most = most_ms * kMs](std::int64_t now_ns) {
      const double phase = static_cast<double>(now_ns % (400 * kMs)) / (400.0 * kMs);
      return static_cast<std::int64_t>((1 - std::fabs(2 * phase - 1)) * static_cast<double>(most));
    };
    const Judged judged = watched({.delay_ns = delay_ns});
    EXPECT_EQ(judged.findings.at("device delay").verdict, verdict) << most_ms;
    EXPECT_NEAR(static_cast<double>(judged.probe->age.max_ns) * 1e-6, most_ms, 1.5);
    EXPECT_EQ(judged.findings.at("device packets").verdict, Verdict::kOk) << most_ms;
  }
}

TEST(OpenedDevice, ASlowDeviceIsWarnedOf) {
  EXPECT_EQ(watched({.period_ns = 2 * kMs}).verdicts(), kAllOk);
  EXPECT_EQ(watched({.period_ns = 4 * kMs}).verdicts(),
            all_ok_but("device samples", Verdict::kWarn));
}

TEST(OpenedDevice, AWayThatLeadsOnlyOneWayIsNamed) {
  EXPECT_EQ(watched({.deaf = true}).verdicts(), all_ok_but("device forces", Verdict::kInfo));
}

TEST(OpenedDevice, SaysWhyItCouldNotBeOpenedAndWhatToDo) {
  test::enter_virtual_time() = {};
  const std::string uri = "udp:" + test_port();
  const auto refused = [&uri] {
    try {
      const Device device = open_device(uri, 0.2);
      device.close(device.self);
    } catch (const DeviceError& error) {
      return judge_refused(uri, error.what());
    }
    return Finding{};
  };
  const Finding silent = refused();
  EXPECT_EQ(silent.verdict, Verdict::kFail);
  EXPECT_EQ(silent.value, "no sample came in 0.2 s");
  EXPECT_EQ(silent.remedy, "start the program that sends them");
  const Link taken = udp_listen(test_port());
  const Finding second = refused();
  taken.close(taken.self);
  EXPECT_EQ(second.value, "Address already in use");
  EXPECT_THAT(second.remedy, testing::StartsWith("expected a port that is free"));
  const Finding bare = judge_refused("hd:", "no reason");
  EXPECT_EQ(bare.value, "no reason");
  EXPECT_THAT(bare.remedy, testing::HasSubstr("hal/device/README.md"));
}

// ---- made-up measurements -----------------------------------------------------------------------

struct MadeUp {
  Device device = {};
  std::unique_ptr<DeviceProbe> probe = std::make_unique<DeviceProbe>();
  MadeUp() {
    device.info.name = "made up";
    probe->seconds = 1;
    probe->samples = 1000;
  }
  Findings judged() const { return by_name(judge_opened("hd:", device, *probe)); }
  Finding state() const { return judged().at("device state"); }
};

TEST(OpenedDevice, TheSerialNumberIsToldWhereItIsKnown) {
  MadeUp made;
  made.device.info.max_force_n = 3;
  EXPECT_EQ(made.judged().at("device opens").value, "made up, at most 3 N");
  made.device.info.identity = "40915001";
  EXPECT_EQ(made.judged().at("device opens").value, "made up, serial number 40915001, at most 3 N");
}

// Without packets the watchdog is 3 ms.
TEST(OpenedDevice, WhereThisMachineWasLateTheDeviceIsNotBlamed) {
  MadeUp made;
  EXPECT_FALSE(made.judged().contains("device packets"));
  made.probe->longest_gap_ns = 4 * kMs;
  EXPECT_EQ(made.judged().at("device gaps").verdict, Verdict::kFail);
  made.probe->latest_tick_ns = 2 * kMs;
  EXPECT_EQ(made.judged().at("device gaps").verdict, Verdict::kUnknown);
  EXPECT_THAT(made.judged().at("device gaps").value,
              testing::HasSubstr("this machine itself was up to 2.0 ms late"));
}

// What a device without sample times loses before its driver gets them, nobody can measure.
TEST(OpenedDevice, TheDelayOfADeviceWithoutSampleTimesIsNotKnown) {
  MadeUp made;
  histogram_add(made.probe->age, kMs / 4);
  const Finding unknown = made.judged().at("device delay");
  EXPECT_EQ(unknown.verdict, Verdict::kInfo);
  EXPECT_THAT(unknown.value,
              testing::StartsWith("not known: the device sends no sample times; the way from its "
                                  "driver to the loop takes 0.25 (p50)"));
  EXPECT_THAT(made.judged().at("device samples").value, testing::HasSubstr("got by the driver"));
  made.device.info.sends_times = true;
  const Finding known = made.judged().at("device delay");
  EXPECT_EQ(known.verdict, Verdict::kOk);
  EXPECT_THAT(known.value, testing::StartsWith("samples come 0.25 (p50)"));
  EXPECT_THAT(made.judged().at("device samples").value, testing::HasSubstr("taken"));
  made.device.info.sends_times = false;
  histogram_add(made.probe->age, 4 * kMs);  // late after all: the watchdog's time is 3 ms
  EXPECT_EQ(made.judged().at("device delay").verdict, Verdict::kFail);
}

TEST(OpenedDevice, FaultTroubleAndNoteAreTold) {
  MadeUp made;
  EXPECT_EQ(made.state().verdict, Verdict::kOk);
  made.device.note = [](void*) { return std::string("its clock was set"); };
  EXPECT_EQ(made.state().verdict, Verdict::kWarn);
  EXPECT_EQ(made.state().value, "its clock was set");
  made.probe->fault = Fault::kStaleSamples;
  made.probe->refused = Refusal::kLate;
  EXPECT_EQ(made.state().verdict, Verdict::kFail);
  EXPECT_EQ(made.state().value, "fault: no usable sample (late)");
  made.device.trouble = [](void*) { return std::string("its cable is out"); };
  EXPECT_EQ(made.state().value, "its cable is out");
}

}  // namespace
}  // namespace stylet::hal
