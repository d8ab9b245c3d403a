// SPDX-License-Identifier: Apache-2.0
// Another program as a device, over UDP and shared memory: a thread that sends a sample every
// millisecond and feels the force of the newest packet.
#include <sys/stat.h>

#include <atomic>
#include <cstdio>
#include <mutex>

#include "device_bench.h"
#include "hal/device/link.h"
#include "hal/device/packet.h"

namespace stylet::hal {
namespace {

class PeerBench : public Bench {
 public:
  PeerBench(std::string uri_text, Link (*connect)()) : uri_(std::move(uri_text)) {
    latches = false;  // only the guard latches; the peer's forces end by age
    thread_ = std::thread([this, connect] { run(connect); });
  }
  ~PeerBench() override {
    stop_ = true;
    thread_.join();
  }
  std::string uri() const override { return uri_; }
  void move(const Pose& pose) override {
    const std::lock_guard lock(mutex_);
    sample_.pose = pose;
  }
  void press(std::uint32_t mask) override {
    const std::lock_guard lock(mutex_);
    sample_.buttons = mask;
  }
  Vec3 felt() override {
    const std::lock_guard lock(mutex_);
    return force_at(force_, monotonic_now_ns(), sample_.pose.position_m);
  }
  Vec3 felt_torque() override {
    const std::lock_guard lock(mutex_);
    return torque_at(force_, monotonic_now_ns(), sample_.pose.position_m);
  }
  void trouble(test::Trouble trouble) override { trouble_ = trouble; }

 private:
  // The shared memory's number; 0: there is none, as with UDP.
  static ino_t memory() {
    struct stat there = {};
    return stat(("/dev/shm/stylet.test" + test_port()).c_str(), &there) == 0 ? there.st_ino : 0;
  }
  void run(Link (*connect)()) {
    Link link = {};
    ino_t mine = 0;
    while (!stop_) {
      if (link.self != nullptr && memory() != mine) {  // the run is over, or another has begun
        exchange(link);                                // its last packet stays to be read
        link.close(link.self);
        link = {};
      }
      try {
        if (link.self == nullptr) link = connect();
        mine = memory();
        exchange(link);
      } catch (const DeviceError&) {  // shared memory that Stylet has not made yet
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (link.self != nullptr) link.close(link.self);
  }

  void exchange(const Link& link) {
    const std::lock_guard lock(mutex_);
    std::array<std::byte, kMaxPacketBytes> room;
    ForcePacket packet;
    while (const auto got = link.receive(link.self, room)) {
      if (decode(std::span(room).first(*got), packet) && packet.seq > force_.seq) force_ = packet;
    }
    if (trouble_.load() != test::Trouble::kNone) return;
    ++sample_.seq;
    sample_.session = 77;
    sample_.limits = {.max_force_n = 6, .max_torque_nm = 0.2F};
    sample_.t_ns = monotonic_now_ns();
    link.send(link.self, encode(sample_));
  }

  std::string uri_;
  std::mutex mutex_;
  SamplePacket sample_;
  ForcePacket force_;
  std::atomic<test::Trouble> trouble_{test::Trouble::kNone};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace

std::unique_ptr<Bench> udp_bench() {
  return std::make_unique<PeerBench>("udp:127.0.0.1:" + test_port(),
                                     [] { return udp_connect("127.0.0.1:" + test_port()); });
}
std::unique_ptr<Bench> shm_bench() {
  return std::make_unique<PeerBench>(
      "shm:test" + test_port(), [] { return shared_memory("test" + test_port(), Side::kDevice); });
}

}  // namespace stylet::hal
