// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/pointer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>

#include "hal/base/channel.h"
#include "hal/base/rotation.h"
#include "hal/base/wide.h"
#include "hal/device/devices.h"
#include "hal/device/driver.h"
#include "stylet/limits.h"

namespace stylet::hal {
namespace {

using Eigen::Vector3d;

constexpr double kRate = 1 / kPointerFollowS;
constexpr double kLongestStepS = 0.01;  // after a stall of the loop: one tick of the longest period
constexpr double kUnitTolerance = 0.01;

struct Posted {
  Pose pose;
  std::uint32_t buttons;
  std::uint32_t session;  // grows when a page leaves
  std::uint32_t present;
};

// Shared by the page's threads and the loop.
struct Mailbox {
  std::mutex writers;
  std::uint32_t session = 0;
  Posted last = {};  // if `present`, the page is there
  Latest<Posted> posts;
  std::atomic<bool> held{false};  // by an open device
};
std::array<Mailbox, kMaxNeedles> g_mailboxes;
std::atomic<bool> g_served{false};

struct Pointer {
  Mailbox* mailbox;
  Posted newest = {{{}, {1, 0, 0, 0}}, 0, 0, 0};
  bool heard = false;  // there is a newest post that counts
  bool gone = false;
  std::int64_t heard_ns = 0, last_ns = 0;
  std::uint64_t seq = 0;
  Vector3d offset_m = Vector3d::Zero();  // from the page's position to the device's
  Quat turn = {1, 0, 0, 0};              // the same for the rotation
  Vector3d place_m = Vector3d::Zero(), velocity_m_per_s = Vector3d::Zero();
  Vector3d spin_rad_per_s = Vector3d::Zero();
  Quat rotation = {1, 0, 0, 0};
};

bool usable(const Pose& pose) {
  const Quat& q = pose.rotation;
  const double imaginary = wide_length({q.x, q.y, q.z});
  const double norm = std::hypot(static_cast<double>(q.w), imaginary);
  return wide_length(pose.position_m) <= kPointerReachM && std::fabs(norm - 1) <= kUnitTolerance;
}

// One step towards rest at distance `error`: critically damped, speed at most `most`.
void pull(Vector3d& velocity, const Vector3d& error, double most, double dt_s) {
  velocity += kRate * (kRate * error - 2 * velocity) * dt_s;
  const double speed = length(velocity);
  if (speed > most) velocity *= most / speed;
}

void follow(Pointer& p, double dt_s) {
  const Vector3d told = wide(p.newest.pose.position_m);
  pull(p.velocity_m_per_s, told + p.offset_m - p.place_m, kPointerSpeedMPerS, dt_s);
  p.place_m += p.velocity_m_per_s * dt_s;

  const Quat& now = p.rotation;
  const Quat way = product(product(p.turn, p.newest.pose.rotation), inverse(now));
  const double twice = way.w < 0 ? -2 : 2;  // the shorter way round
  pull(p.spin_rad_per_s, twice * wide({way.x, way.y, way.z}), kPointerTurnRadPerS, dt_s);
  const Vec3 step = narrow(0.5 * dt_s * p.spin_rad_per_s);
  p.rotation = unit(product({1, step.x, step.y, step.z}, now));
}

// The needle continues from where it is.
void take_up(Pointer& p, const Posted& post) {
  p.offset_m = p.place_m - wide(post.pose.position_m);
  p.turn = product(p.rotation, inverse(post.pose.rotation));
  p.velocity_m_per_s = p.spin_rad_per_s = Vector3d::Zero();
}

void listen(Pointer& p, std::int64_t now_ns) {
  Posted post;
  if (p.mailbox->posts.take(post)) {
    if (post.present == 0) {
      p.gone = true;
    } else {
      if (!p.heard || p.gone || post.session != p.newest.session) take_up(p, post);
      p.newest = post;
      p.heard = true;
      p.gone = false;
      p.heard_ns = now_ns;
    }
  }
  if (p.heard && now_ns - p.heard_ns > kPointerGoneNs) p.gone = true;
}

bool read(void* self, std::int64_t now_ns, Sample& sample_out) {
  Pointer& p = *static_cast<Pointer*>(self);
  listen(p, now_ns);
  const double since_s = static_cast<double>(now_ns - p.last_ns) * 1e-9;
  const double dt_s = p.last_ns == 0 ? 0 : std::clamp(since_s, 0.0, kLongestStepS);
  if (since_s > kPointerAnewS) take_up(p, p.newest);
  p.last_ns = now_ns;
  if (p.gone) return false;
  if (p.heard) follow(p, dt_s);
  sample_out = {++p.seq, now_ns, {narrow(p.place_m), p.rotation}, p.newest.buttons};
  return true;
}

void write(void* /*self*/, const Command& /*command*/) {}

void close(void* self) {
  const std::unique_ptr<Pointer> pointer(static_cast<Pointer*>(self));
  pointer->mailbox->held.store(false);
}

std::string trouble(void* self) {
  const bool gone = static_cast<Pointer*>(self)->gone;
  return gone ? "the console's page has gone, or shows something else: open it again" : "";
}

}  // namespace

bool pointer_post(std::uint32_t number, const Pose& pose, std::uint32_t buttons) {
  if (number >= g_mailboxes.size() || !usable(pose)) return false;
  Mailbox& mailbox = g_mailboxes[number];
  const std::lock_guard lock(mailbox.writers);
  mailbox.last = {pose, buttons, mailbox.session, 1};
  mailbox.posts.publish(mailbox.last);
  return true;
}

void pointer_stay() {
  for (Mailbox& mailbox : g_mailboxes) {
    const std::lock_guard lock(mailbox.writers);
    if (mailbox.last.present != 0) mailbox.posts.publish(mailbox.last);
  }
}

void pointer_leave(std::uint32_t number) {
  if (number >= g_mailboxes.size()) return;
  Mailbox& mailbox = g_mailboxes[number];
  const std::lock_guard lock(mailbox.writers);
  mailbox.last = {{{}, {1, 0, 0, 0}}, 0, ++mailbox.session, 0};
  mailbox.posts.publish(mailbox.last);
}

void pointer_serve(bool served) {
  g_served.store(served);
}

std::optional<std::uint32_t> pointer_number(const std::string& uri) {
  const std::string scheme = "pointer:";
  if (!uri.starts_with(scheme)) return std::nullopt;
  const std::string rest = uri.substr(scheme.size());
  if (rest.empty()) return 0;
  const auto number = static_cast<std::uint32_t>(rest[0] - '0');
  if (rest.size() != 1 || rest[0] < '0' || number >= kMaxNeedles) return std::nullopt;
  return number;
}

Device open_pointer(const std::string& rest, double /*patience_s*/) {
  const auto number = pointer_number("pointer:" + rest);
  if (!number) {
    throw DeviceError(fmt::format("pointer:{}: expected a number from 0 to {}, or nothing", rest,
                                  kMaxNeedles - 1));
  }
  if (!g_served.load()) {
    throw DeviceError(
        fmt::format("pointer:{}: expected --console: it is the mouse or finger on its page", rest));
  }
  Mailbox& mailbox = g_mailboxes[*number];
  if (mailbox.held.exchange(true)) {
    throw DeviceError(fmt::format("pointer:{}: this pointer holds another needle already", rest));
  }
  auto pointer = std::make_unique<Pointer>();
  pointer->mailbox = &mailbox;
  Posted old;
  (void)mailbox.posts.take(old);  // left over from before
  return {pointer.release(),
          {.name = "pointer on the page", .max_force_n = 0, .max_slew_n_per_s = 0},
          read,
          write,
          close,
          trouble};
}

namespace {

void search(const HostTree&, DeviceSighting& out) {
  out.presence = Presence::kReady;
  out.seen = "with --console";
}

}  // namespace

constinit const DriverDescriptor pointer_driver = {
    .scheme = "pointer",
    .uri = "pointer:",
    .name = "mouse or finger on the console's page",
    .open = open_pointer,
    .search = search,
    .renders = false,
    .row = {"`pointer:`, `pointer:NUMBER`", "mouse or finger on the console's page",
            "6 / 0: the page draws the force", "`--console`; a number from 0 to 3 for each needle"},
};

}  // namespace stylet::hal
