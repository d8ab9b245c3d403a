// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/steered.h"

#include <algorithm>
#include <cmath>

namespace stylet::hal {
namespace {

constexpr double kReserve = 0.5;       // fraction of the opposite arc's reach that is kept
constexpr double kDeadBandM = 0.3e-3;  // a smaller miss is not worth a roll

struct Vec {
  double x, y, z;
};
Vec minus(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec times(double s, const Vec& v) {
  return {s * v.x, s * v.y, s * v.z};
}
double dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
double size(const Vec& v) {
  return std::sqrt(dot(v, v));
}
Vec wide(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// The side that the bevel faces now. roll() turns it by one step towards the wanted side.
Vec side_of(const Steered& s) {
  return {s.roll_w * s.roll_w - s.roll_z * s.roll_z, 2 * s.roll_w * s.roll_z, 0};
}

void roll(Steered& s) {
  const Vec side = side_of(s);
  const double along = side.x * s.wanted_x + side.y * s.wanted_y;
  const double across = side.x * s.wanted_y - side.y * s.wanted_x;
  // Half of the angle: exact if within reach, else one step at the highest rate.
  const double most = 0.5 * static_cast<double>(s.config.roll_rad_per_s) * s.period_s;
  const double half = along > 0 ? across / (1 + along) : (across < 0 ? -1.0 : 1.0);
  const double step = std::clamp(half, -most, most);
  const double w = s.roll_w - step * s.roll_z, z = s.roll_z + step * s.roll_w;
  const double length = std::sqrt(w * w + z * z);
  s.roll_w = w / length;
  s.roll_z = z / length;
}

void face(Steered& s, const Vec& miss) {
  const double length = std::sqrt(miss.x * miss.x + miss.y * miss.y);
  if (!(length > 0)) return;
  s.wanted_x = miss.x / length;
  s.wanted_y = miss.y / length;
  ++s.rolls;
}

// The target seen from the tip: `ahead` along the tip's direction, `off` across it.
void aim(Steered& s) {
  const Vec direction = wide(s.last.tip_direction), tip = wide(s.last.tip_m);
  if (!(size(direction) > 0.5)) return;  // not known yet
  Vec way = minus(wide(s.config.targets_m[s.next]), tip);
  double ahead = dot(way, direction);
  while (ahead <= 0 && s.next + 1 < s.config.targets_m.size()) {
    ++s.next;
    way = minus(wide(s.config.targets_m[s.next]), tip);
    ahead = dot(way, direction);
  }
  if (ahead <= 0) {
    s.next = s.config.targets_m.size();
    return;
  }
  const Vec off = minus(way, times(ahead, direction));
  const Vec wanted = {s.wanted_x, s.wanted_y, 0};
  const Vec bevel = minus(wanted, times(dot(wanted, direction), direction));
  const double along = dot(off, bevel) / size(bevel);
  const double across = size(minus(off, times(along / size(bevel), bevel)));
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
  Vec at = {0, 0, -static_cast<double>(needle_length_m)};
  double way_m = 0;
  for (const Vec3& target : config.targets_m) {
    way_m += size(minus(wide(target), at));
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
