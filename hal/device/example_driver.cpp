// SPDX-License-Identifier: Apache-2.0
// A driver to copy: a device of force in a network, with packets of its own over UDP. It pushes
// along x, y and z, measures its position and has no rotation. Its URI is plumb:ADDRESS:PORT.
// hal/device/own_driver.md says what to change.
//
// All waiting is in a thread of the driver's own, which takes samples and sends forces once a
// millisecond; the relay lies between that thread and the loop. The device ends each force 20 ms
// after it took the sample that the force answers, so a force carries the number of that sample.
// Promises: those of device.h. Units: SI, ns. Frame: x right, y up, z toward the operator.
#include "hal/device/example_driver.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "hal/base/clock.h"
#include "hal/device/driver.h"
#include "hal/device/link.h"
#include "hal/device/patience.h"
#include "hal/device/relay.h"
#include "hal/device/thread.h"

namespace stylet::hal {
namespace {

constexpr std::int64_t kTurnNs = 1'000'000;  // a sample and a force in each
// Without a sample for so long the device has failed: before it ends the force by itself, if there
// was one; until then there is nothing to end.
constexpr std::int64_t kLongestGapNs = 15'000'000, kLongestGapBeforeForceNs = 100'000'000;
constexpr std::int64_t kDriftPart = 1000;  // two clocks drift apart by less than this part
constexpr int kMostPerTurn = 64;           // packets
constexpr std::uint32_t kSilent = 1;       // a reason for Relay::fail

struct Plumb {
  Relay relay;  // relayed() looks for a member of this name
  DeviceThread thread;
  Link link;
  DeviceInfo info = {.name = "Plumb",
                     .max_force_n = 3,
                     .max_slew_n_per_s = 1000,
                     .force_life_s = 1e-9F * static_cast<float>(kPlumbLifeNs),
                     .sends_times = true};
  std::uint64_t newest = 0;   // number of the newest sample
  std::uint64_t sent = 0;     // number of the newest force
  std::int64_t heard_ns = 0;  // when that sample came
  std::int64_t looked_ns = 0;
  // Our clock less the device's: the smallest difference at an arrival. A sample that was held up
  // on its way then counts as old, as it should.
  std::int64_t offset_ns = std::numeric_limits<std::int64_t>::max();
};

void take(Plumb& plumb, const PlumbPacket& packet, std::int64_t now_ns) {
  if (packet.number <= plumb.newest) return;  // late, doubled, or of an earlier start
  plumb.newest = packet.number;
  plumb.heard_ns = now_ns;
  plumb.offset_ns = std::min(plumb.offset_ns, now_ns - packet.time_or_answered);
  const auto& [x, y, z] = packet.vector_xyz;
  // As it came, even if it is no number: the guard refuses it and says so.
  plumb.relay.publish({{x, y, z}, {1, 0, 0, 0}}, packet.buttons,
                      packet.time_or_answered + plumb.offset_ns);
}

void listen(Plumb& plumb, std::int64_t now_ns) {
  if (plumb.heard_ns != 0) plumb.offset_ns += (now_ns - plumb.looked_ns) / kDriftPart;
  plumb.looked_ns = now_ns;
  std::array<std::byte, 2 * sizeof(PlumbPacket)> room;  // a longer packet is seen to be too long
  PlumbPacket packet;
  for (int i = 0; i < kMostPerTurn; ++i) {
    const std::optional<std::size_t> size = plumb.link.receive(plumb.link.self, room);
    if (!size) return;  // nothing more is there; 0 would be a packet that is useless
    if (plumb_decode(std::span(room).first(*size), kPlumbSample, packet)) {
      take(plumb, packet, now_ns);
    }
  }
}

void send(Plumb& plumb, Vec3 force_n) {
  plumb.link.send(plumb.link.self,
                  plumb_encode({.kind = kPlumbForce,
                                .number = ++plumb.sent,
                                .time_or_answered = static_cast<std::int64_t>(plumb.newest),
                                .vector_xyz = {force_n.x, force_n.y, force_n.z}}));
}

// Called once a turn, in the driver's thread. Forces are sent even after a failure: they are zero.
void turn(Plumb& plumb) {
  const std::int64_t now_ns = monotonic_now_ns();
  listen(plumb, now_ns);
  const std::int64_t longest_ns = plumb.relay.used() ? kLongestGapNs : kLongestGapBeforeForceNs;
  if (plumb.heard_ns != 0 && now_ns - plumb.heard_ns > longest_ns) plumb.relay.fail(kSilent);
  send(plumb, plumb.relay.order(now_ns).force_n);
  plumb.relay.written(monotonic_now_ns());
}

// The force fades before the thread stops, and the last packet has none.
void close(void* self) {
  const std::unique_ptr<Plumb> plumb(static_cast<Plumb*>(self));
  plumb->relay.end();
  std::this_thread::sleep_for(kFadeTime);
  plumb->thread.stop();
  send(*plumb, {});
  plumb->link.close(plumb->link.self);
}

std::string trouble(void* self) {
  Plumb& plumb = *static_cast<Plumb*>(self);
  if (!plumb.relay.failed()) return "";
  const std::string refused = plumb.link.trouble(plumb.link.self);
  return refused.empty() ? "no sample comes any more: check its power and the network" : refused;
}

// `rest` is what stands behind "plumb:". The thread greets the device with its first force, from
// which the device learns our address, so it starts before we wait for a sample.
Device open(const std::string& rest, double patience_s) {
  auto plumb = std::make_unique<Plumb>();
  plumb->link = udp_connect(rest, "plumb");
  plumb->relay.limits = motor_limits(plumb->info);
  // Larger than in any earlier run, whose packets may still be on their way.
  plumb->sent = static_cast<std::uint64_t>(std::chrono::system_clock::now().time_since_epoch() /
                                           std::chrono::microseconds(1));
  plumb->thread.start(kTurnNs, [at = plumb.get()] { turn(*at); });
  const Patience patience(patience_s);
  while (!plumb->relay.measured() && !patience.over()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  Plumb* const opened = plumb.release();
  if (!opened->relay.measured()) {
    const std::string refused = opened->link.trouble(opened->link.self);
    close(opened);
    throw DeviceError(fmt::format("plumb:{}: no sample came in {:g} s: {}", rest, patience_s,
                                  refused.empty() ? "check its power and address" : refused));
  }
  return relayed(opened, opened->info, close, trouble);
}

void search(const HostTree&, DeviceSighting& out) {
  out.presence = Presence::kUnknown;
  out.seen = "shows itself only when it is opened";
}

}  // namespace

constinit const DriverDescriptor plumb_driver = {
    .scheme = "plumb",
    .uri = "plumb:ADDRESS:PORT",
    .name = "the example of a device in a network",
    .open = open,
    .search = search,
    .may_open_again = may_always_open_again,
    .row = {"`plumb:ADDRESS:PORT`", "the example of a device in a network", "3 / 3",
            "a device that sends the packets of `example_driver.h`"},
};

}  // namespace stylet::hal
