// SPDX-License-Identifier: Apache-2.0
// What is sent over network or shared memory between Stylet and a device it does not know: samples
// one way, local models of the force the other. hal/device/packets.md has the layout.
//
// A force lives `life_ns` from the moment when the sample it answers was taken, on the clock of
// whoever took that sample. So no clocks are compared, and no force outlives that time, whatever is
// lost, late, doubled or out of order. In the second half of its life it fades. When the newest
// force's life is over, no force is felt until an acknowledgement, seen by a newer arming number.
// Promises: fixed size, little-endian, checked by CRC-32; no allocation; nothing is trusted.
// Units: SI, ns. Frame: the device's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "stylet/units.h"

namespace stylet::hal {

constexpr std::uint16_t kPacketVersion = 3;
constexpr std::int64_t kForceLifeNs = 20'000'000;

// The most the device renders. 0: not told; for torque: it renders none.
struct RenderLimits {
  float max_force_n = 0;
  float max_stiffness_n_per_m = 0;
  float continuous_force_n = 0;
  float max_torque_nm = 0;
  bool operator==(const RenderLimits&) const = default;
};

// Sent by the device.
struct SamplePacket {
  std::uint32_t session = 0;  // a new number each time the device's side is started
  std::uint32_t buttons = 0;
  std::uint64_t seq = 0;   // grows with every sample
  std::int64_t t_ns = 0;   // when it was taken, on any clock of the sender that runs evenly
  std::uint64_t echo = 0;  // seq of the newest force received; 0: none
  Pose pose = {{}, {1, 0, 0, 0}};
  RenderLimits limits;        // stays the same for a session
  std::uint32_t arming = 0;   // of the force that is obeyed; 0: the device does not tell
  std::uint32_t stopped = 0;  // 1: forces of that arming no longer move anything
  Vec3 force_n = {};          // on the hand, now; valid if `arming` is told
};

// The force at and around the place for which it was computed: force_n - stiffness (x - at_m),
// shortened to max_force_n; zero farther than radius_m from at_m. Radius 0: valid everywhere, which
// without stiffness is a plain wrench.
struct ForceModel {
  Vec3 force_n = {};  // on the hand
  Vec3 torque_nm = {};
  Vec3 at_m = {};
  std::array<float, 9> stiffness_n_per_m = {};  // row by row
  float radius_m = 0;
  float max_force_n = 0;
};
Vec3 force_at(const ForceModel& model, Vec3 position_m);

// Sent to the device.
struct ForcePacket {
  std::uint64_t seq = 0;       // grows with every packet, also from one run of Stylet to the next
  std::uint64_t echo = 0;      // seq of the sample it answers
  std::int64_t echo_t_ns = 0;  // t_ns of that sample
  std::int64_t life_ns = 0;    // counted from echo_t_ns
  ForceModel model;
  std::uint32_t arming = 0;  // grows with each acknowledgement, also from run to run; never 0
};
// Zero when the force has outlived its time. `now_ns` is on the clock of the samples. The torque is
// constant within the radius.
Vec3 force_at(const ForcePacket& packet, std::int64_t now_ns, Vec3 position_m);
Vec3 torque_at(const ForcePacket& packet, std::int64_t now_ns, Vec3 position_m);

// What the device's side obeys: the newest force, while it lives. Whoever renders forces must use
// obey() and obeyed_fraction(), and limit how fast the motors' force changes by a slew of its own,
// from nothing to the largest force in half of kForceLifeNs or less.
struct ObeyedForce {
  ForcePacket newest;  // without life: none came yet
  bool stopped = false;
};
// False: not newer, of an older arming, or its life is over or longer than allowed.
bool obey(ObeyedForce& obeyed, const ForcePacket& packet, std::int64_t now_ns);
// The fraction of it that is felt: 1, less in the second half of its life; 0 once it has stopped.
float obeyed_fraction(ObeyedForce& obeyed, std::int64_t now_ns);

constexpr std::size_t kSamplePacketBytes = 108;
constexpr std::size_t kForcePacketBytes = 128;
constexpr std::size_t kMaxPacketBytes = 128;

std::array<std::byte, kSamplePacketBytes> encode(const SamplePacket& packet);
std::array<std::byte, kForcePacketBytes> encode(const ForcePacket& packet);
// False, and `out` untouched: not such a packet, another version, or damaged.
bool decode(std::span<const std::byte> bytes, SamplePacket& out);
bool decode(std::span<const std::byte> bytes, ForcePacket& out);
// The version of a packet, which may be another than ours; 0: not one of our packets.
std::uint16_t packet_version(std::span<const std::byte> bytes);

}  // namespace stylet::hal
