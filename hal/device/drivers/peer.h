// SPDX-License-Identifier: Apache-2.0
// A device at the other end of a link: another program, or another machine with a device of its
// own (station.h).
//
// The time of a sample is the sender's, shifted by the smallest difference to arrival seen so far:
// so a sample held up on the way is old when it comes, and the guard sees that. A clock that was
// set is noticed: time went back while numbers grew, or a sample is older than the force that it
// says it has seen. If this lasts for kClockDoubtNs, the difference becomes the smallest one since;
// until then samples are as old as they say, and a mere delay never looks like it. A new session of
// the sender, after a restart, is accepted once the old one has been silent for kSilenceNs, if its
// device renders the same as the first one's, because the guard's limits are made for that.
// The motors are at the other end: samples tell what force the hand has there, and that forces of
// this arming have ended. If the device does not tell, the force is taken from the model at its
// place. A force in a fade lives no longer than 25 ms from the beginning of the fade.
// Promises: read handles at most kMostPerRead packets; no allocation, no lock.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "hal/base/clock.h"
#include "hal/device/device.h"
#include "hal/device/link.h"
#include "hal/device/packet.h"

namespace stylet::hal {

constexpr int kMostPerRead = 512;
constexpr std::int64_t kSilenceNs = 100'000'000;
constexpr float kModelRadiusM = 0.02F;        // way at 2 m/s in half the life of a force
constexpr std::int64_t kGoneNs = 25'000'000;  // from the beginning of a fade until no force is left
// Two clocks drift apart by less than this part of the time: a crystal by 100 millionths, and one
// that NTP is adjusting by 500 more (adjtimex(2)).
constexpr std::int64_t kDriftPart = 1000;
// A set clock is recognised after this time. A peer may take the time of a sample this long before
// it looks for forces without its clock being doubted.
constexpr std::int64_t kClockDoubtNs = 100'000'000;
constexpr std::int64_t kClockSlackNs = 2'000'000;
constexpr std::size_t kSentKept = 64;  // forces whose time is kept; older echoes tell nothing

struct PeerDevice {
  Link link;
  Clock clock = monotonic_clock();  // of arrivals: the loop's own time is that of its grid
  DeviceInfo info = {.name = "a peer",
                     .max_force_n = 8,
                     .max_slew_n_per_s = 2000,
                     .force_life_s = static_cast<float>(kForceLifeNs) * 1e-9F,
                     .sends_times = true};
  bool heard = false;
  std::int64_t heard_ns = 0;               // arrival of the newest sample
  std::int64_t looked_ns = 0;              // when packets were last looked for
  std::int64_t offset_ns = 0;              // our clock less the sender's
  std::int64_t doubt_ns = 0;               // since when that cannot be; 0: it can
  std::int64_t doubt_offset_ns = 0;        // the offset according to the samples since then
  std::uint64_t seq = 0;                   // of the samples passed on, over all sessions
  std::uint64_t sent = 0, first_sent = 0;  // packet numbers: newest, and the one before the first
  std::uint32_t arming_base = 0;           // of this run: arming numbers grow from run to run
  Command given = {};                      // the command in the newest packet
  ForceModel model = {};                   // the model in the newest packet
  std::int64_t falls_ns = 0;               // since when the command only falls; 0: it does not
  std::int64_t echo_ns = 0;  // when an echo last showed a newer packet of ours; 0: never
  std::array<std::int64_t, kSentKept> sent_ns = {};  // of the newest packets; or a time before
  SamplePacket newest;
  PacketCount packets = {};
  std::uint16_t other_version = 0;        // of packets that cannot be read
  std::atomic<bool> other_device{false};  // a session with other limits has tried to join
  std::atomic<std::uint32_t> clock_sets{0};
};

// `peer` must outlive the device. With close_frees it must come from new, and close deletes it.
Device peer_device(PeerDevice& peer, bool close_frees = false);

// "udp:" and "shm:" devices: wait up to patience_s for the first sample.
Device open_udp(const std::string& rest, double patience_s);
Device open_shared_memory(const std::string& rest, double patience_s);

}  // namespace stylet::hal
