// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/spacemouse.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>

#include "hal/base/rotation.h"
#include "hal/device/devices.h"
#include "hal/device/driver.h"
#include "hal/device/relay.h"
#include "hal/device/thread.h"
#include "hal/device/usb.h"

namespace stylet::hal {
namespace {

// Packets are eight numbers; the answer to the greeting is one number, if the daemon is new enough
// to send it.
using Packet = std::array<std::int32_t, 8>;
constexpr std::int32_t kGreeting = 0x7faa5501;
constexpr std::int32_t kMotion = 0, kPress = 1, kRelease = 2, kDevice = 3, kDeviceRemoved = 1;

constexpr double kFullDeflection = 350;
constexpr double kSpeedMPerS = 0.05, kTurnRadPerS = 1;
constexpr std::int64_t kHoldNs = 50'000'000;
constexpr int kWaitMs = 1;
constexpr std::uint32_t kDaemonGone = 1;

struct SpaceMouse {
  Relay relay;
  DeviceThread thread;
  int socket = -1;
  std::array<char, sizeof(Packet)> partial = {};
  std::size_t have = 0;
  bool greeted = false;  // the answer has come, or a packet instead of it
  Packet motion = {};
  std::int64_t moved_ns = 0, now_ns = 0;
  std::uint32_t buttons = 0;
  double position_m[3] = {};
  Quat rotation = {1, 0, 0, 0};
};

void take(SpaceMouse& mouse, const Packet& packet) {
  switch (packet[0]) {
    case kMotion:
      mouse.motion = packet;
      mouse.moved_ns = mouse.now_ns;
      break;
    case kPress:
      if (packet[1] >= 0 && packet[1] < 32) mouse.buttons |= 1U << packet[1];
      break;
    case kRelease:
      if (packet[1] >= 0 && packet[1] < 32) mouse.buttons &= ~(1U << packet[1]);
      break;
    case kDevice:
      if (packet[1] != kDeviceRemoved) break;
      mouse.motion = {};
      mouse.buttons = 0;
      break;
    default:
      break;
  }
}

// Packets may come in fragments.
void take_bytes(SpaceMouse& mouse, const char* bytes, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    mouse.partial[mouse.have++] = bytes[i];
    if (!mouse.greeted && mouse.have == sizeof(std::int32_t)) {
      std::int32_t first = 0;
      std::memcpy(&first, mouse.partial.data(), sizeof first);
      mouse.greeted = true;
      if ((first & ~0xff) == (kGreeting & ~0xff)) mouse.have = 0;
    }
    if (mouse.have < sizeof(Packet)) continue;
    Packet packet;
    std::memcpy(packet.data(), mouse.partial.data(), sizeof packet);
    mouse.have = 0;
    take(mouse, packet);
  }
}

void listen(SpaceMouse& mouse) {
  pollfd wanted = {mouse.socket, POLLIN, 0};
  if (::poll(&wanted, 1, kWaitMs) <= 0) return;
  std::array<char, 1024> room;
  const ssize_t got = recv(mouse.socket, room.data(), room.size(), MSG_DONTWAIT);
  if (got > 0) {
    take_bytes(mouse, room.data(), static_cast<std::size_t>(got));
  } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
    mouse.relay.fail(kDaemonGone);
  }
}

// The daemon has x right, y up, z away from the operator, and rotations about these three.
void move(SpaceMouse& mouse, double dt_s) {
  if (mouse.now_ns - mouse.moved_ns > kHoldNs) mouse.motion = {};
  const auto deflection_s = [&](std::size_t i, double sign) {
    return sign * std::clamp(static_cast<double>(mouse.motion[i]) / kFullDeflection, -1.0, 1.0) *
           dt_s;
  };
  const double sign[3] = {1, 1, -1};
  float half[3];
  for (std::size_t i = 0; i < 3; ++i) {
    mouse.position_m[i] += kSpeedMPerS * deflection_s(i + 1, sign[i]);
    half[i] = static_cast<float>(0.5 * kTurnRadPerS * deflection_s(i + 4, sign[i]));
  }
  mouse.rotation = unit(product({1, half[0], half[1], half[2]}, mouse.rotation));
}

void work(SpaceMouse& mouse) {
  if (mouse.relay.failed()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(kWaitMs));
    return;
  }
  listen(mouse);
  const std::int64_t last_ns = mouse.now_ns;
  mouse.now_ns = monotonic_now_ns();
  const double longest_s = 0.01;
  move(mouse, std::min(static_cast<double>(mouse.now_ns - last_ns) * 1e-9, longest_s));
  const Vec3 position = {static_cast<float>(mouse.position_m[0]),
                         static_cast<float>(mouse.position_m[1]),
                         static_cast<float>(mouse.position_m[2])};
  mouse.relay.publish({position, mouse.rotation}, mouse.buttons, mouse.now_ns);
}

void close(void* self) {
  const std::unique_ptr<SpaceMouse> mouse(static_cast<SpaceMouse*>(self));
  mouse->thread.stop();
  ::close(mouse->socket);
}
std::string trouble(void* self) {
  const bool gone = static_cast<SpaceMouse*>(self)->relay.failed();
  return gone ? "spacenavd has ended the connection: systemctl restart spacenavd" : "";
}

}  // namespace

std::string spacenavd_socket() {
  if (const char* named = std::getenv("SPNAV_SOCKET"); named != nullptr) return named;
  std::ifstream settings("/etc/spnavrc");
  for (std::string line; std::getline(settings, line);) {
    const std::size_t equals = line.find('=');
    if (!line.starts_with("socket") || equals == std::string::npos) continue;
    const std::size_t path = line.find_first_not_of(" \t", equals + 1);
    if (path != std::string::npos) return line.substr(path);
  }
  return "/var/run/spnav.sock";
}

Device open_spacemouse(const std::string& rest, double /*patience_s*/) {
  if (!rest.empty())
    throw DeviceError(fmt::format("spacemouse:{}: expected nothing after the colon", rest));
  const std::string path = spacenavd_socket();
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    throw DeviceError(fmt::format("spacemouse: {}: expected a shorter path", path));
  }
  std::copy(path.begin(), path.end(), address.sun_path);
  auto mouse = std::make_unique<SpaceMouse>();
  mouse->socket = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (connect(mouse->socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const int error = errno;
    ::close(mouse->socket);
    throw DeviceError(
        fmt::format("spacemouse: {}: {}: install spacenavd and start it (systemctl "
                    "start spacenavd)",
                    path, std::strerror(error)));
  }
  (void)send(mouse->socket, &kGreeting, sizeof kGreeting, MSG_NOSIGNAL);
  mouse->now_ns = monotonic_now_ns();
  mouse->thread.start(0, [at = mouse.get()] { work(*at); });
  while (!mouse->relay.measured()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const DeviceInfo info = {.name = "SpaceMouse", .max_force_n = 0, .max_slew_n_per_s = 0};
  return relayed(mouse.release(), info, close, trouble);
}

namespace {

constexpr std::array kUsb = {
    UsbId{.vendor = "256f", .product = "", .name = "3Dconnexion SpaceMouse", .has_raw_hid = true},
    UsbId{.vendor = "046d", .product = "c626", .name = "3Dconnexion SpaceNavigator"}};

void search(const HostTree& tree, DeviceSighting& out) {
  const Attached mouse = find_usb(tree, kUsb);
  const std::string path = spacenavd_socket();
  if (!exists(tree, path)) {
    out.seen = (mouse.place.empty() ? "" : mouse.place + ", but ") + ("no socket " + path);
    out.remedy = "apt install spacenavd; systemctl start spacenavd";
    return;
  }
  const bool on_usb = !mouse.place.empty();
  if (access((tree.root + path).c_str(), R_OK | W_OK) != 0) {
    out.seen = path + " may not be used by this user" + (on_usb ? ", " + mouse.place : "");
    out.remedy = "chmod 666 " + path;
    return;
  }
  out.presence = on_usb ? Presence::kReady : Presence::kUnknown;
  out.seen = path + ", " +
             (on_usb ? mouse.place : "none on USB (others are on Bluetooth or a serial line)");
}

}  // namespace

constinit const DriverDescriptor spacemouse_driver = {
    .scheme = "spacemouse",
    .uri = "spacemouse:",
    .name = "3Dconnexion SpaceMouse",
    .open = open_spacemouse,
    .search = search,
    .may_open_again = may_always_open_again,
    .renders = false,
    .usb = kUsb,
    .row = {"`spacemouse:`", "3Dconnexion SpaceMouse", "6 / 0: deflection is speed", "`spacenavd`"},
};

}  // namespace stylet::hal
