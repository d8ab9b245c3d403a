// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/steered.h"

#include <algorithm>
#include <cmath>

#include "hal/base/wide.h"

namespace stylet::hal {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double kReserve = 0.5;       // fraction of the opposite arc's reach that is kept
constexpr double kDeadBandM = 0.3e-3;  // a smaller miss is not worth a roll

// The side that the bevel faces now. roll() turns it by one step towards the wanted side.
Vector2d side_of(const Steered& s) {
  return {s.roll_w * s.roll_w - s.roll_z * s.roll_z, 2 * s.roll_w * s.roll_z};
}

void roll(Steered& s) {
  const Vector2d side = side_of(s);
  const double along = side.x() * s.wanted_x + side.y() * s.wanted_y;
  const double across = side.x() * s.wanted_y - side.y() * s.wanted_x;
  // Half of the angle: exact if within reach, else one step at the highest rate.
  const double most = 0.5 * static_cast<double>(s.config.roll_rad_per_s) * s.period_s;
  const double half = along > 0 ? across / (1 + along) : (across < 0 ? -1.0 : 1.0);
  const double step = std::clamp(half, -most, most);
  const double w = s.roll_w - step * s.roll_z, z = s.roll_z + step * s.roll_w;
  const double length = std::sqrt(w * w + z * z);
  s.roll_w = w / length;
  s.roll_z = z / length;
}

void face(Steered& s, const Vector3d& miss) {
  const double length = std::sqrt(miss.x() * miss.x() + miss.y() * miss.y());
  if (!(length > 0)) return;
  s.wanted_x = miss.x() / length;
  s.wanted_y = miss.y() / length;
  ++s.rolls;
}

// The target seen from the tip: `ahead` along the tip's direction, `off` across it.
void aim(Steered& s) {
  const Vector3d direction = wide(s.last.tip_direction), tip = wide(s.last.tip_m);
  if (!(length(direction) > 0.5)) return;  // not known yet
  Vector3d way = wide(s.config.targets_m[s.next]) - tip;
  double ahead = dot(way, direction);
  while (ahead <= 0 && s.next + 1 < s.config.targets_m.size()) {
    ++s.next;
    way = wide(s.config.targets_m[s.next]) - tip;
    ahead = dot(way, direction);
  }
  if (ahead <= 0) {
    s.next = s.config.targets_m.size();
    return;
  }
  const Vector3d off = way - ahead * direction;
  const Vector3d wanted = {s.wanted_x, s.wanted_y, 0};
  const Vector3d bevel = wanted - dot(wanted, direction) * direction;
  const double along = dot(off, bevel) / length(bevel);
  const double across = length(off - along / length(bevel) * bevel);
  const double free_m = std::max(ahead - static_cast<double>(s.config.lag_m), 0.0);
  const double reach = 0.5 * static_cast<double>(s.config.curvature_per_m) * free_m * free_m;
  const double allowed = std::max(kReserve * reach, kDeadBandM);
  if (!s.aimed || along < -allowed || across > allowed) face(s, off);
  s.aimed = true;
}

bool read(void* self, std::int64_t now_ns, Sample& sample_out) {
  Steered& s = *static_cast<Steered*>(self);
  if (s.next < s.config.targets_m.size()) aim(s);
  if (s.next < s.config.targets_m.size()) {
    s.depth_m += static_cast<double>(s.config.speed_m_per_s) * s.period_s;
    roll(s);
  }
  ++s.tick;
  sample_out = {s.tick,
                now_ns,
                {{0, 0, static_cast<float>(-s.depth_m)},
                 {static_cast<float>(s.roll_w), 0, 0, static_cast<float>(s.roll_z)}},
                0};
  return true;
}

void write(void* self, const Command& command) {
  static_cast<Steered*>(self)->last = command;
}

void close(void* /*self*/) {}

}  // namespace

std::uint64_t steered_ticks(const SteeringConfig& config, float needle_length_m, double period_s) {
  constexpr double kSpare = 1.1;
  Vector3d at = {0, 0, -static_cast<double>(needle_length_m)};
  double way_m = 0;
  for (const Vec3& target : config.targets_m) {
    way_m += length(wide(target) - at);
    at = wide(target);
  }
  const double time_s = kSpare * way_m / static_cast<double>(config.speed_m_per_s) +
                        static_cast<double>(config.hold_s);
  return static_cast<std::uint64_t>(std::ceil(time_s / period_s));
}

Device steered_device(Steered& steered, const DeviceInfo& info) {
  return {&steered, info, read, write, close};
}

}  // namespace stylet::hal
