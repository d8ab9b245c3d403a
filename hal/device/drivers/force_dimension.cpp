// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/force_dimension.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <initializer_list>
#include <memory>
#include <optional>
#include <thread>

#include "hal/device/devices.h"
#include "hal/device/driver.h"
#include "hal/device/model.h"
#include "hal/device/patience.h"
#include "hal/device/relay.h"
#include "hal/device/supervisor.h"
#include "hal/device/thread.h"
#include "hal/device/usb.h"
#include "hal/device/vendor_library.h"
#include "hal/device/vendor_pose.h"

namespace stylet::hal {
namespace {

// ==== The part of the vendor's interface that is used: negative values are errors, others are not

constexpr int kTimeGuard = 1;  // uses what was read a moment ago, without asking the device
constexpr int kStatusReset = 3, kStatusForce = 5, kStatusForceOffCause = 14;
constexpr std::size_t kStatusRoom = 64;  // the array has grown over the years
constexpr unsigned char kWatchdog = 80;  // times 125 us
constexpr int kTypeFalcon = 60;

struct Api {
  int (*open)();
  int (*open_id)(char);
  int (*close)(char);
  const char* (*system_name)(char);
  int (*system_type)(char);
  int (*position)(double*, double*, double*, char);
  int (*frame)(double[3][3], char);
  int (*position_and_frame)(double*, double*, double*, double[3][3], char);
  int (*set_force)(double, double, double, char);
  int (*set_all)(double, double, double, double, double, double, double, char);
  int (*enable_force)(unsigned char, char);
  int (*set_gravity)(int, char);
  int (*button)(int, char);
  unsigned (*buttons)(char);
  int (*status)(int*, char);
  const char* (*last_error)();
  bool (*has_active_wrist)(char);
  int (*expert)();
  int (*set_watchdog)(unsigned char, char);
  int (*emulate_button)(unsigned char, char);
  int (*serial)(unsigned short*, char);
};

#ifdef _WIN32
constexpr std::initializer_list<const char*> kFiles = {"dhd64.dll", "drd64.dll"};
#else
constexpr std::initializer_list<const char*> kFiles = {"libdhd.so.3", "libdhd.so", "libdrd.so.3"};
#endif

// Of the other functions, each version has a different selection.
Api load() {
  const VendorLibrary library("dhd", "STYLET_LIBDHD", kFiles);
  Api api = {};
  library.need("dhdOpen", api.open);
  library.need("dhdOpenID", api.open_id);
  library.need("dhdClose", api.close);
  library.need("dhdGetPosition", api.position);
  library.need("dhdSetForce", api.set_force);
  library.need("dhdEnableForce", api.enable_force);
  library.need("dhdGetButton", api.button);
  library.need("dhdGetStatus", api.status);
  library.find("dhdErrorGetLastStr", api.last_error);
  library.find("dhdGetSystemName", api.system_name);
  library.find("dhdGetSystemType", api.system_type);
  library.find("dhdGetOrientationFrame", api.frame);
  if (api.frame == nullptr) library.find("dhdGetRotatorMatrix", api.frame);  // until 3.2
  library.find("dhdGetPositionAndOrientationFrame", api.position_and_frame);
  library.find("dhdSetForceAndTorqueAndGripperForce", api.set_all);
  library.find("dhdSetGravityCompensation", api.set_gravity);
  library.find("dhdGetButtonMask", api.buttons);
  library.find("dhdHasActiveWrist", api.has_active_wrist);
  library.find("dhdEnableExpertMode", api.expert);
  library.find("dhdSetWatchdog", api.set_watchdog);
  library.find("dhdEmulateButton", api.emulate_button);
  library.find("dhdGetSerialNumber", api.serial);
  return api;
}

const Api& dhd() {
  static const Api* const the_only = new Api(load());
  return *the_only;
}

// Which of our models the vendor's numbers mean, left-handed ones too. Beyond sigma.7 the numbers
// belong to newer arms, none of which is weaker.
struct Kind {
  int lowest_type, highest_type;
  const char* model;
};
constexpr std::array kKinds = {Kind{33, 33, "omega.3"}, Kind{34, 34, "omega.6"},
                               Kind{35, 35, "omega.7"}, Kind{36, 36, "omega.6"},
                               Kind{37, 37, "omega.7"}, Kind{60, 60, "falcon"},
                               Kind{63, 64, "delta.6"}, Kind{104, 206, "sigma.7"}};
constexpr float kShare = 0.9F;
constexpr float kTorqueNm = 0.1F;  // a cautious guess

// Why the relay failed: the device's own causes as numbered there, and ours.
constexpr std::uint32_t kNoAnswer = 100, kStalled = 101;
constexpr int kMostErrorsInARow = 5;
constexpr std::int64_t kPollNs = 500'000;
constexpr std::chrono::milliseconds kThreadTime(200);  // a poll takes less time, unless it hangs
constexpr std::uint64_t kPollsBetweenStatus = 20;

struct DhdDevice {
  Relay relay;
  DeviceThread thread;
  Supervisor supervisor;
  char id = -1;
  bool watchdog = false;  // its firmware ends the force if our thread is late
  bool has_frame = false;
  std::string name, serial;
  DeviceInfo info = {};
  int errors_in_a_row = 0;
  std::atomic<std::uint64_t> polls{0};
  std::atomic<bool> force_was_on{false};
};

std::string last_error() {
  return dhd().last_error != nullptr ? dhd().last_error() : "no reason given";
}

int measure(const Api& api, DhdDevice& device, Pose& pose) {
  double x = 0, y = 0, z = 0;
  double m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  int result = 0;
  if (api.position_and_frame != nullptr) {
    result = api.position_and_frame(&x, &y, &z, m, device.id);
  } else {
    result = api.position(&x, &y, &z, device.id);
    if (result >= 0 && device.has_frame && api.frame(m, device.id) < 0) result = -1;
  }
  pose = {from_user_first(x, y, z), from_user_first(rotation_of(m))};
  return result;
}

std::uint32_t pressed(const Api& api, char id) {
  if (api.buttons != nullptr) return api.buttons(id);
  return api.button(0, id) == 1 ? 1 : 0;
}

int apply(const Api& api, const DhdDevice& device, const MotorReport& order) {
  const UserFirst f = to_user_first(order.force_n);
  if (api.set_all == nullptr || device.info.max_torque_nm == 0) {
    return api.set_force(f.x, f.y, f.z, device.id);
  }
  const UserFirst t = to_user_first(order.torque_nm);
  return api.set_all(f.x, f.y, f.z, t.x, t.y, t.z, 0, device.id);
}

// If forces were on and now are off there is a cause; they must not come back by themselves.
void look_at_status(const Api& api, DhdDevice& device) {
  std::array<int, kStatusRoom> status = {};
  if (api.status(status.data(), device.id) < 0) return;
  if (status[kStatusForce] != 0) {
    device.force_was_on = true;
  } else if (device.force_was_on) {
    device.relay.fail(static_cast<std::uint32_t>(status[kStatusForceOffCause]));
  }
}

void poll(DhdDevice& device) {
  const Api& api = dhd();
  Pose pose;
  const int read = measure(api, device, pose);
  const std::int64_t now_ns = monotonic_now_ns();
  if (read >= 0 && read != kTimeGuard) {
    device.relay.publish(pose, pressed(api, device.id), now_ns);
  }
  const int written = apply(api, device, device.relay.order(now_ns));
  device.relay.written(monotonic_now_ns());
  device.errors_in_a_row = read < 0 || written < 0 ? device.errors_in_a_row + 1 : 0;
  if (device.errors_in_a_row >= kMostErrorsInARow) {
    device.relay.fail(kNoAnswer);
    (void)api.enable_force(0, device.id);  // one of its calls may succeed
  }
  const std::uint64_t polls = 1 + device.polls.fetch_add(1, std::memory_order_relaxed);
  if (polls % kPollsBetweenStatus == 0) look_at_status(api, device);
}

// ==== Opening

void describe(const Api& api, DhdDevice& device) {
  const int type = api.system_type != nullptr ? api.system_type(device.id) : 0;
  const DeviceModel* model = &unknown_device_model();
  for (const Kind& each : kKinds) {
    const bool is = type >= each.lowest_type && type <= each.highest_type;
    if (is) model = find_device_model(each.model);
  }
  const char* name = api.system_name != nullptr ? api.system_name(device.id) : nullptr;
  device.name = name != nullptr ? name : "DHD device";
  device.has_frame = api.frame != nullptr && type != kTypeFalcon;
  const bool torque = api.has_active_wrist != nullptr && api.has_active_wrist(device.id);
  unsigned short serial = 0;
  const bool told = api.serial != nullptr && api.serial(&serial, device.id) >= 0;
  if (told) device.serial = fmt::format("{}", serial);
  device.info = {
      .name = device.name.c_str(),
      .max_force_n = kShare * model->max_force_n,
      .max_slew_n_per_s = 2000,
      .max_stiffness_n_per_m = model->max_stiffness_n_per_m,
      .max_torque_nm = torque ? kTorqueNm : 0,
      .continuous_force_n = std::min(model->continuous_force_n, kShare * model->max_force_n),
      .identity = device.serial.c_str(),
      .model = model};
}

void wait_for_calibration(const Api& api, char id, double patience_s) {
  const Patience patience(patience_s);
  std::array<int, kStatusRoom> status = {};
  while (true) {
    if (api.status(status.data(), id) >= 0 && status[kStatusReset] == 0) return;
    if (patience.over()) {
      throw DeviceError(
          "dhd: not calibrated: put the end-effector into its rest position, or run the vendor's "
          "HapticInit; Stylet never moves the arm by itself");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void wait_for_sample(const DhdDevice& device, double patience_s) {
  const Patience patience(patience_s);
  while (!device.relay.measured()) {
    if (device.relay.failed() || patience.over()) {
      throw DeviceError(
          "dhd: the device was opened, but gives no sample: check its cable and power");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// After we enable forces they stay off until the device's button is pressed: a run without forces
// would look like one in air.
void wait_for_forces(const DhdDevice& device, const std::string& index, double patience_s) {
  const Patience patience(patience_s);
  while (!device.force_was_on.load()) {
    if (device.relay.failed() || patience.over()) {
      throw DeviceError(
          fmt::format("dhd:{}: its forces are off, or it does not say: press the force button on "
                      "its base (its light shows whether forces are on) and start again",
                      index));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void close(void* self) {
  const std::unique_ptr<DhdDevice> device(static_cast<DhdDevice*>(self));
  device->relay.end();
  std::this_thread::sleep_for(kFadeTime);
  // If it hangs, the motors are cut from here, before we hang as well.
  if (!device->thread.stops_within(kThreadTime)) (void)dhd().enable_force(0, device->id);
  device->supervisor.stop();
  device->thread.stop();
  (void)apply(dhd(), *device, {});
  (void)dhd().enable_force(0, device->id);
  (void)dhd().close(device->id);
}

std::string trouble(void* self) {
  const Relay& relay = static_cast<DhdDevice*>(self)->relay;
  if (!relay.failed()) return "";
  constexpr std::array kCauses = {"forces went off without a cause",
                                  "its button was pressed",
                                  "it was moved too fast",
                                  "its watchdog: our thread was late",
                                  "software",
                                  "its cable was pulled",
                                  "its dead-man switch"};
  if (relay.why() == kStalled) return "a call of its driver hangs: forces were switched off";
  if (relay.why() < kCauses.size()) return fmt::format("forces are off: {}", kCauses[relay.why()]);
  return "it does not answer: check cable and power";
}

std::string note(void* self) {
  if (static_cast<DhdDevice*>(self)->watchdog) return "";
  return "its firmware refuses the watchdog: if a call of the driver hangs, only this program can "
         "switch the forces off; keep a hand at the force button on its base";
}

bool set_watchdog(const Api& api, char id, unsigned char periods) {
  const bool expert = api.expert != nullptr && api.expert() >= 0;
  return expert && api.set_watchdog != nullptr && api.set_watchdog(periods, id) >= 0;
}

// Thread-safe, says the vendor's manual: the one call that reaches motors whose thread hangs.
void supervise(DhdDevice& device) {
  device.supervisor.start(
      device.polls, [] { return false; },
      [&device] {
        device.relay.fail(kStalled);
        (void)dhd().enable_force(0, device.id);
      });
}

char open_index(const Api& api, const std::string& index) {
  int number = -1;
  const auto [end, error] = std::from_chars(index.data(), index.data() + index.size(), number);
  const bool good = error == std::errc() && end == index.data() + index.size() && number >= 0;
  if (!index.empty() && (!good || number > 31)) {
    throw DeviceError(
        fmt::format("dhd:{}: expected nothing, or the number of the device from 0", index));
  }
  const int id = index.empty() ? api.open() : api.open_id(static_cast<char>(number));
  if (id < 0) {
    throw DeviceError(
        fmt::format("dhd:{}: {}: check cable, power, the right to use it (stylet "
                    "devices), and that no other program has it",
                    index, last_error()));
  }
  return static_cast<char>(id);
}

}  // namespace

std::string force_dimension_missing() try {
  (void)dhd();
  return "";
} catch (const DeviceError& error) {
  return error.what();
}

Device open_force_dimension(const std::string& index, double patience_s) {
  const Api& api = dhd();
  auto device = std::make_unique<DhdDevice>();
  device->id = open_index(api, index);
  try {
    describe(api, *device);
    device->relay.limits = motor_limits(device->info);
    wait_for_calibration(api, device->id, patience_s);
    if (api.set_gravity != nullptr) (void)api.set_gravity(1, device->id);
    // The seventh axis: a closed gripper counts as button 0. Refused if there is no gripper.
    if (api.emulate_button != nullptr) (void)api.emulate_button(1, device->id);
    device->watchdog = set_watchdog(api, device->id, kWatchdog);
    if (api.enable_force(1, device->id) < 0) {
      throw DeviceError(fmt::format("dhd:{}: forces cannot be enabled: {}", index, last_error()));
    }
    supervise(*device);
    device->thread.start(kPollNs, [polled = device.get()] { poll(*polled); });
    wait_for_sample(*device, patience_s);
    wait_for_forces(*device, index, patience_s);
  } catch (...) {
    close(device.release());
    throw;
  }
  DhdDevice* opened = device.release();
  Device made = relayed(opened, opened->info, close, trouble);
  made.note = note;
  return made;
}

std::optional<bool> force_dimension_watchdog() try {
  const Api& api = dhd();
  if (api.expert == nullptr || api.set_watchdog == nullptr) return false;
  const int id = api.open();
  if (id < 0) return std::nullopt;
  const bool taken = set_watchdog(api, static_cast<char>(id), kWatchdog);
  (void)set_watchdog(api, static_cast<char>(id), 0);
  (void)api.close(static_cast<char>(id));
  return taken;
} catch (const DeviceError&) {
  return std::nullopt;
}

namespace {

constexpr std::array kUsb = {UsbId{.vendor = "1451", .product = "", .name = "Force Dimension"},
                             UsbId{.vendor = "0403", .product = "cb48", .name = "Novint Falcon"}};

// name; largest force, continuous force; slew; stiffness; damping; workspace; mass, (damping),
// friction, resolution, delay.
constexpr std::array kModels = {
    with_arm_damping({"falcon",
                      8,
                      2,
                      kAssumedSlewNPerS,
                      3000,
                      20,
                      mm(100, 100, 100),
                      {0.2F, 0, 0, 0.06e-3F, kUsbS}}),
    with_arm_damping({"omega.3",
                      12,
                      12,
                      kAssumedSlewNPerS,
                      5000,
                      30,
                      mm(160, 160, 110),
                      {0.2F, 0, 0, 0.01e-3F, kPolledUsbS}}),
    with_arm_damping({"omega.6",
                      12,
                      12,
                      kAssumedSlewNPerS,
                      5000,
                      30,
                      mm(160, 160, 110),
                      {0.2F, 0, 0, 0.01e-3F, kPolledUsbS}}),
    with_arm_damping({"omega.7",
                      12,
                      12,
                      kAssumedSlewNPerS,
                      5000,
                      30,
                      mm(160, 160, 110),
                      {0.2F, 0, 0, 0.01e-3F, kPolledUsbS}}),
    with_arm_damping({"sigma.7",
                      12,
                      12,
                      kAssumedSlewNPerS,
                      4000,
                      30,
                      mm(190, 190, 130),
                      {0.2F, 0, 0, 0.01e-3F, kPolledUsbS}}),
    with_arm_damping({"delta.6",
                      20,
                      20,
                      kAssumedSlewNPerS,
                      5000,
                      30,
                      mm(400, 400, 260),
                      {0.25F, 0, 0, 0.03e-3F, kPolledUsbS}}),
};

void search(const HostTree& tree, DeviceSighting& out) {
  const Attached device = find_usb(tree, kUsb);
  if (const std::string missing = force_dimension_missing(); !missing.empty()) {
    out.seen = (device.place.empty() ? "" : device.place + ", but ") + missing;
    out.remedy = "install the vendor's SDK (libdhd.so.3 and libusb-1.0)";
    return;
  }
  if (device.place.empty()) {
    out.seen = "library, but no such device on USB";
    out.remedy = "check cable and power";
    return;
  }
  if (!may_use(tree, device, out)) return;
  out.presence = Presence::kReady;
  out.seen = "library, " + device.place;
}

}  // namespace

constinit const DriverDescriptor dhd_driver = {
    .scheme = "dhd",
    .uri = "dhd:",
    .name = "Force Dimension, Novint Falcon",
    .open = open_force_dimension,
    .search = search,
    .may_open_again = may_always_open_again,
    .usb = kUsb,
    .models = kModels,
    .row = {"`dhd:`, `dhd:INDEX`", "Force Dimension, Novint Falcon",
            "3 to 7 / 3 to 6; a gripper that is closed is button 0",
            "SDK 3.x (`libdhd.so.3`, or `STYLET_LIBDHD`); its forces on: the button on its base"},
};

}  // namespace stylet::hal
