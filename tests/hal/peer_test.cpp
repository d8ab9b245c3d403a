// SPDX-License-Identifier: Apache-2.0
// What is particular to a peer on a real socket: what it says of itself, and who it is not.
#include "device_bench.h"
#include "stylet/hal/link.h"
#include "stylet/hal/packet.h"

namespace stylet::hal {
namespace {

std::string here() {
  return "127.0.0.1:" + test_port();
}

// Sends `packet` again and again while a device is opened.
class Sender {
 public:
  explicit Sender(std::vector<std::byte> packet)
      : thread_([this, bytes = std::move(packet)] {
          const Link link = udp_connect(here());
          while (!stop_) {
            link.send(link.self, bytes);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
          link.close(link.self);
        }) {}
  ~Sender() {
    stop_ = true;
    thread_.join();
  }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

std::vector<std::byte> bytes_of(const RenderLimits& limits) {
  SamplePacket packet;
  packet.session = 7;
  packet.seq = 1;
  packet.limits = limits;
  const auto bytes = encode(packet);
  return {bytes.begin(), bytes.end()};
}

DeviceInfo info_told(const RenderLimits& limits) {
  const Sender sender(bytes_of(limits));
  const Device device = open_device("udp:" + here(), 5);
  device.close(device.self);
  return device.info;
}

TEST(Peer, LimitsAreThoseItTellsAndNonsenseIsNotBelieved) {
  const DeviceInfo touch = info_told({3.3F, 400, 0.88F, 0.05F});
  EXPECT_EQ(touch.max_force_n, 3.3F);
  EXPECT_EQ(touch.max_stiffness_n_per_m, 400);
  EXPECT_EQ(touch.continuous_force_n, 0.88F);
  EXPECT_EQ(touch.max_torque_nm, 0.05F);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float odd : {0.0F, -1.0F, kNan, std::numeric_limits<float>::infinity()}) {
    const DeviceInfo unknown = info_told({odd, odd, odd, odd});
    EXPECT_EQ(unknown.max_force_n, 8) << odd;
    EXPECT_EQ(unknown.max_stiffness_n_per_m, 0) << odd;
    EXPECT_EQ(unknown.continuous_force_n, 0) << odd;
    EXPECT_EQ(unknown.max_torque_nm, 0) << odd;
  }
}

TEST(Peer, NobodyAndAnotherVersionAreToldApart) {
  const auto refusal = [](double patience_s) {
    try {
      const Device device = open_device("udp:" + here(), patience_s);
      device.close(device.self);
    } catch (const DeviceError& error) {
      return std::string(error.what());
    }
    return std::string("opened");
  };
  EXPECT_NE(refusal(0.05).find("no sample came in 0.05 s: start the program"), std::string::npos);
  std::vector<std::byte> old = bytes_of({});
  old[4] = std::byte{1};
  const Sender sender(old);
  EXPECT_NE(refusal(0.3).find("packets of version 1 came: expected version 2"), std::string::npos);
}

}  // namespace
}  // namespace stylet::hal
