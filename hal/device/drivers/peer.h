// SPDX-License-Identifier: Apache-2.0
// A device at the other end of a link: another program, or another machine with a device of its
// own (station.h).
//
// The time of a sample is the sender's, moved by the smallest difference to the arrival seen so
// far: what was held up on the way is old when it comes, and the guard sees it. A clock that was
// set shows: time went back while numbers grew, or a sample's time lies before that of the force it
// has seen. When that lasts for kClockDoubtNs the difference is the smallest one since; till then,
// samples are as old as they say, and a delay alone never shows so. A new session of
// the sender, started anew, is taken up when the old one has been silent for kSilenceNs, if its
// device renders what the first one did: the guard's limits are those.
// The motors are at the other end: samples tell what the hand has there, and that forces of this
// arming have ended; of a device that does not tell, the force is taken as the model gives it where
// it is. A force of a fade lives no longer than 25 ms from the fade's beginning on.
// Promises: read looks at no more than kMostPerRead packets; no allocation, no lock.
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
constexpr float kModelRadiusM = 0.02F;        // 2 m/s for half the life of a force
constexpr std::int64_t kGoneNs = 25'000'000;  // from the beginning of a fade to no force
// Two clocks drift apart by at most so small a part: a crystal by 100 millionths, and one that is
// being set by NTP by 500 more (adjtimex(2)).
constexpr std::int64_t kDriftPart = 1000;
// A clock that was set is recognised after this time. Its peer may take the time of a sample so
// long before it looks for forces: no clock is doubted for that.
constexpr std::int64_t kClockDoubtNs = 100'000'000;
constexpr std::int64_t kClockSlackNs = 2'000'000;
constexpr std::size_t kSentKept = 64;  // forces whose time is known; one echoed later tells nothing

struct PeerDevice {
  Link link;
  Clock clock = monotonic_clock();  // of arrivals: the loop's time is that of its grid
  DeviceInfo info = {.name = "a peer",
                     .max_force_n = 8,
                     .max_slew_n_per_s = 2000,
                     .force_life_s = static_cast<float>(kForceLifeNs) * 1e-9F};
  bool heard = false;
  std::int64_t heard_ns = 0;               // arrival of the newest sample
  std::int64_t looked_ns = 0;              // when
  std::int64_t offset_ns = 0;              // our clock less the sender's
  std::int64_t doubt_ns = 0;               // since when that cannot be; 0: it can
  std::int64_t doubt_offset_ns = 0;        // what it would be by the samples since
  std::uint64_t seq = 0;                   // of the samples handed on, over all sessions
  std::uint64_t sent = 0, first_sent = 0;  // numbers of packets: the newest, before the first
  std::uint32_t arming_base = 0;           // of this run: armings grow from run to run
  Command given = {};                      // in the newest packet
  ForceModel model = {};                   // likewise
  std::int64_t falls_ns = 0;               // since when what is given only falls; 0: it does not
  std::int64_t echo_ns = 0;  // when a newer one of ours was last told to have come; 0: never
  std::array<std::int64_t, kSentKept> sent_ns = {};  // of the newest packets, no later than sent
  SamplePacket newest;
  std::uint16_t other_version = 0;        // of packets that are not read
  std::atomic<bool> other_device{false};  // a session with other limits wants to join
  std::atomic<std::uint32_t> clock_sets{0};
};

// `peer` must outlive the device, unless close_frees: then it was made by new.
Device peer_device(PeerDevice& peer, bool close_frees = false);

// "udp:" and "shm:" devices: wait up to patience_s for a first sample.
Device open_udp(const std::string& rest, double patience_s);
Device open_shared_memory(const std::string& rest, double patience_s);

}  // namespace stylet::hal
