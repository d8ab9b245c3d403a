// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/openhaptics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <clocale>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "hal/base/clock.h"
#include "hal/device/devices.h"
#include "hal/device/driver.h"
#include "hal/device/drivers/openhaptics_api.h"
#include "hal/device/lasting_device.h"
#include "hal/device/model.h"
#include "hal/device/patience.h"
#include "hal/device/relay.h"
#include "hal/device/supervisor.h"
#include "hal/device/thread.h"
#include "hal/device/usb.h"
#include "hal/device/vendor_pose.h"

namespace stylet::hal {
namespace {

using namespace openhaptics;

// ==== One library, one scheduler, several devices

constexpr std::uint32_t kStalled = 1;  // besides the vendor's numbers
constexpr std::uint64_t kTicksBetweenCalibrations = 100;
constexpr int kLastTurns = 20;  // of a device that has failed, with zero force
// Devices that failed together come back together: the first waits until the others were tried as
// well. Their next try is at most kLongestTryS away; one more second is for opening.
constexpr double kTogetherS = kLongestTryS + 1;
constexpr auto kTogetherNs = static_cast<std::int64_t>(kTogetherS * 1e9);

struct HdDevice {
  Relay relay;
  std::string called;  // the name it was opened with
  bool again = false;  // it is opened again after a failure
  std::atomic<bool> ready{false};
  int last_turns = kLastTurns;
  HdHandle handle = kInvalidHandle;
  SchedulerHandle callback = 0;
  std::string model, serial;
  DeviceInfo info = {};
  Enum calibration_style = 0;
  std::atomic<Enum> calibration{0};  // as last seen; asked for until it is good
  std::atomic<std::uint64_t> ticks{0};
  Supervisor supervisor;
};

struct Away {
  std::int64_t last_ns = 0;  // last try to open it again; before the first, its closing
  bool tried = false;
};

constexpr std::size_t kMaxDevices = 4;

struct Hd {
  Api api = load();
  std::mutex mutex;                 // for opening and closing; never the servo
  std::atomic<bool> paused{false};  // the scheduler stands by our own order
  std::array<std::atomic<HdDevice*>, kMaxDevices> open{};
  std::map<std::string, Away> away;  // devices closed after they had failed
};

Hd& hd() {
  static Hd* const the_only = new Hd;  // outlives every thread of the vendor
  return *the_only;
}

template <typename Do>
void for_each_open(const Hd& all, Do act) {
  for (const auto& slot : all.open) {
    if (HdDevice* each = slot.load(std::memory_order_acquire); each != nullptr) act(*each);
  }
}

// The scheduler serves all devices, and accepts no new one while it runs. Before it stops, forces
// fade, in every hand, and come back when somebody has acknowledged, because the vendor's manual
// does not say what stopped motors do. The guard of another hand latches this silence as well.
void pause(Hd& all) {
  bool any = false;
  for_each_open(all, [&any](HdDevice& each) {
    each.relay.rest(true);
    any = true;
  });
  if (any) std::this_thread::sleep_for(kFadeTime);
  all.paused.store(true);
  all.api.stop_scheduler();
}
void resume(Hd& all) {
  all.api.start_scheduler();
  all.paused.store(false);
  for_each_open(all, [](HdDevice& each) { each.relay.rest(false); });
}
bool any_open(const Hd& all) {
  return std::any_of(all.open.begin(), all.open.end(),
                     [](const auto& slot) { return slot.load() != nullptr; });
}

// All devices share one stack of errors; an error that names none of them is taken for `mine`.
void drain_errors(HdDevice& mine) {
  Hd& all = hd();
  for (int i = 0; i < 16; ++i) {
    const ErrorInfo error = all.api.get_error();
    if (error.code == 0) return;
    if (error.code >= kFirstHarmless && error.code <= kLastHarmless) continue;
    HdDevice* meant = &mine;
    for_each_open(all, [&](HdDevice& each) {
      if (each.handle == error.device) meant = &each;
    });
    meant->relay.fail(error.code);
  }
}

// Auto styles settle by themselves; an inkwell needs the stylus in it. Runs in the vendor's thread:
// the device may be asked nowhere else.
void calibrate(const Api& api, HdDevice& device) {
  api.make_current(device.handle);
  const Enum state = api.check_calibration();
  if (state == kCalibrationNeedsUpdate) api.update_calibration(device.calibration_style);
  device.calibration.store(state);
}

// Runs in the vendor's thread, once a tick.
unsigned int servo(void* self) {
  HdDevice& device = *static_cast<HdDevice*>(self);
  const Api& api = hd().api;
  // A failed device is left alone: handling its errors may take time from another hand.
  if (device.relay.failed() && (device.relay.why() == kStalled || --device.last_turns < 0)) {
    device.last_turns = 0;
    device.ticks.fetch_add(1, std::memory_order_relaxed);
    return kContinue;
  }
  api.begin_frame(device.handle);
  double transform[16] = {};
  int buttons = 0;
  api.get_doubles(kCurrentTransform, transform);
  api.get_integers(kCurrentButtons, &buttons);
  const std::int64_t now_ns = monotonic_now_ns();
  const Vec3 f = device.relay.order(now_ns).force_n;
  const double force[3] = {static_cast<double>(f.x), static_cast<double>(f.y),
                           static_cast<double>(f.z)};
  api.set_doubles(kCurrentForce, force);
  api.end_frame(device.handle);
  device.relay.written(monotonic_now_ns());
  const std::uint64_t tick = device.ticks.fetch_add(1, std::memory_order_relaxed);
  if (tick == 0) rise_above_the_loop();  // the vendor did not set its thread's priority by ours
  if (device.calibration.load() != kCalibrationOk && tick % kTicksBetweenCalibrations == 0) {
    calibrate(api, device);
  }
  drain_errors(device);
  if (device.relay.failed()) return kContinue;
  const double* t = transform;  // column by column
  const double rows[3][3] = {{t[0], t[4], t[8]}, {t[1], t[5], t[9]}, {t[2], t[6], t[10]}};
  const Vec3 position = {static_cast<float>(t[12] * 1e-3), static_cast<float>(t[13] * 1e-3),
                         static_cast<float>(t[14] * 1e-3)};
  device.relay.publish({position, rotation_of(rows)}, static_cast<std::uint32_t>(buttons), now_ns);
  return kContinue;
}

// ==== Opening

// The vendor parses numbers with a decimal point, but would follow the user's language.
struct PointForNumbers {
  PointForNumbers() { std::setlocale(LC_NUMERIC, "C"); }
  ~PointForNumbers() { std::setlocale(LC_NUMERIC, before.c_str()); }
  PointForNumbers(const PointForNumbers&) = delete;
  PointForNumbers& operator=(const PointForNumbers&) = delete;
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
};

void read_capability(const Api& api, HdDevice& device) {
  double force = 0, stiffness = 0, continuous = 0;
  api.get_doubles(kNominalMaxForce, &force);
  api.get_doubles(kNominalMaxStiffness, &stiffness);
  api.get_doubles(kNominalMaxContinuousForce, &continuous);
  device.model = string_of(api, kModelType);
  device.serial = string_of(api, kSerialNumber);
  const DeviceModel* known = recognise_device_model(device.model);
  if (device.model.empty()) device.model = "OpenHaptics device";
  // A value that cannot be read, or exceeds what its model can do, is replaced by the model's; for
  // an unknown model by the most careful of all known ones.
  const DeviceModel& model = known != nullptr ? *known : unknown_device_model();
  const auto read = [known](double value, double possible, float models) {
    const double most = known != nullptr ? static_cast<double>(models) : possible;
    if (!(value > 0 && value <= possible)) return static_cast<double>(models);
    return std::min(value, most);
  };
  force = read(force, 40, model.max_force_n);
  stiffness = read(stiffness, 10, 1e-3F * model.max_stiffness_n_per_m);
  continuous = std::min(force, read(continuous, 40, model.continuous_force_n));
  constexpr double kShare = 0.9;  // of the most it can do
  device.info = {.name = device.model.c_str(),
                 .max_force_n = static_cast<float>(kShare * force),
                 .max_slew_n_per_s = 1000,
                 .max_stiffness_n_per_m = static_cast<float>(stiffness * 1e3),
                 .continuous_force_n = static_cast<float>(continuous),
                 .identity = device.serial.c_str(),
                 .model = &model};
  forget_errors(api);
}

// The vendor's thread may hang for good with a force in the motors; then only disabling the device
// removes it.
void supervise(HdDevice& device) {
  device.supervisor.start(
      device.ticks, [] { return hd().paused.load(); },
      [&device] {
        device.relay.fail(kStalled);
        hd().api.disable_device(device.handle);
      });
}

void wait_until_ready(const HdDevice& device, const std::string& name, double patience_s) {
  const Patience patience(patience_s);
  while (!device.relay.measured() || device.calibration.load() != kCalibrationOk) {
    const bool late = patience.over();
    if (device.relay.failed() || (late && !device.relay.measured())) {
      throw DeviceError(
          fmt::format("hd:{}: the device was opened, but gives no sample (error 0x{:04x}): check "
                      "its cable and power",
                      name, device.relay.why()));
    }
    if (late) {
      throw DeviceError(fmt::format("hd:{}: not calibrated (0x{:04x}): {}", name,
                                    device.calibration.load(),
                                    device.calibration_style == kStyleInkwell
                                        ? "put the stylus into the inkwell and try again"
                                        : "move the stylus through its range, or run the vendor's "
                                          "set-up program"));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// Nobody can acknowledge this device before the others were tried: once it is in use, the others
// cannot be opened any more. A device that fails meanwhile waits no longer: the others wait for it.
void wait_for_the_others(Hd& all, const HdDevice& mine) {
  const auto some_come = [&all, back_ns = monotonic_now_ns()] {
    const std::lock_guard lock(all.mutex);
    bool come = false;
    for_each_open(all, [&come](const HdDevice& each) {
      come = come || each.relay.failed() || !each.ready.load();
    });
    for (const auto& [name, away] : all.away) {
      const bool dropped = monotonic_now_ns() - away.last_ns > kTogetherNs;  // none tries any more
      come = come || (!dropped && (!away.tried || away.last_ns < back_ns));
    }
    return come;
  };
  const Patience patience(kTogetherS);
  while (!mine.relay.failed() && some_come() && !patience.over()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void shut(HdDevice* device) {
  Hd& all = hd();
  device->relay.end();
  const std::lock_guard lock(all.mutex);
  pause(all);
  device->supervisor.stop();
  const Away away = {monotonic_now_ns(), !device->ready.load()};
  if (away.tried ? device->again : device->relay.failed()) all.away[device->called] = away;
  if (device->callback != 0) all.api.unschedule(device->callback);
  for (auto& slot : all.open) {
    HdDevice* expected = device;
    (void)slot.compare_exchange_strong(expected, nullptr);
  }
  all.api.disable_device(device->handle);
  if (any_open(all)) resume(all);
  delete device;
}

void close(void* self) {
  shut(static_cast<HdDevice*>(self));
}
std::string trouble(void* self) {
  const Relay& relay = static_cast<HdDevice*>(self)->relay;
  if (!relay.failed()) return "";
  if (relay.why() == kStalled) return "the vendor's servo has stopped";
  return fmt::format("error 0x{:04x} ({}): {}", relay.why(), hd().api.get_error_string(relay.why()),
                     remedy(relay.why()));
}

// The scheduler starts last: with it the forces become live.
void start(Hd& all, HdDevice& device, int style) {
  const Api& api = all.api;
  api.make_current(device.handle);
  if ((style & (kStyleAuto | kStyleInkwell)) == 0 && (style & kStyleEncoderReset) != 0 &&
      api.check_calibration() != kCalibrationOk) {
    api.update_calibration(kStyleEncoderReset);
  }
  for (Enum net : {kForceOutput, kMaxForceClamping, kForceRamping, kSoftwareForceLimit}) {
    api.enable(net);
  }
  forget_errors(api);
  device.calibration_style =
      static_cast<Enum>((style & kStyleInkwell) != 0 ? kStyleInkwell : kStyleAuto);
  supervise(device);
  device.callback = api.schedule(servo, &device, kMaxPriority);
  resume(all);
  if (const ErrorInfo error = api.get_error(); error.code != 0 && error.code != kInvalidInputType) {
    throw DeviceError(fmt::format("hd: the vendor's servo did not start: error 0x{:04x} ({})",
                                  error.code, api.get_error_string(error.code)));
  }
}

}  // namespace

std::string openhaptics_missing() try {
  (void)hd();
  return "";
} catch (const DeviceError& error) {
  return error.what();
}

bool openhaptics_in_use() {
  Hd& all = hd();
  const std::lock_guard lock(all.mutex);
  bool used = false;
  for_each_open(all, [&used](const HdDevice& each) {
    used = used || (!each.relay.failed() && (!each.again || each.relay.used()));
  });
  return used;
}

Device open_openhaptics(const std::string& name, double patience_s) {
  Hd& all = hd();
  const PointForNumbers point;
  std::unique_lock lock(all.mutex);
  pause(all);
  auto made = std::make_unique<HdDevice>();
  made->called = name;
  const auto away = all.away.find(name);
  made->again = away != all.away.end();
  const auto restart = [&all] {
    if (any_open(all)) resume(all);
  };
  try {
    made->handle = init(all.api, name);
  } catch (const DeviceError&) {
    if (made->again) away->second = {monotonic_now_ns(), true};
    restart();
    throw;
  }
  if (made->again) all.away.erase(away);
  const auto free_slot = std::find_if(all.open.begin(), all.open.end(),
                                      [](auto& slot) { return slot.load() == nullptr; });
  if (free_slot == all.open.end()) {
    all.api.disable_device(made->handle);
    restart();
    throw DeviceError(fmt::format("hd:{}: expected at most {} devices", name, kMaxDevices));
  }
  HdDevice* device = made.release();
  free_slot->store(device);
  try {
    read_capability(all.api, *device);
    device->relay.limits = motor_limits(device->info);
    int style = 0;
    all.api.get_integers(kCalibrationStyle, &style);
    start(all, *device, style);
    lock.unlock();
    wait_until_ready(*device, name, patience_s);
    device->ready.store(true);
    if (device->again) wait_for_the_others(all, *device);
  } catch (...) {
    if (lock.owns_lock()) lock.unlock();
    shut(device);
    throw;
  }
  return relayed(device, device->info, close, trouble);
}

namespace {

constexpr std::array kUsb = {UsbId{.vendor = "2988",
                                   .product = "",
                                   .name = "3D Systems Touch",
                                   .has_terminal = true,
                                   .has_raw_hid = true}};

// name; largest force, continuous force; slew; stiffness; damping; workspace; mass, (damping),
// friction, resolution, delay.
constexpr std::array kModels = {
    with_arm_damping({"touch",
                      3.3F,
                      0.88F,
                      kAssumedSlewNPerS,
                      400,
                      4,
                      mm(160, 120, 70),
                      {0.045F, 0, 0.26F, 0.055e-3F, kUsbS}}),
    with_arm_damping({"omni",
                      3.3F,
                      0.88F,
                      kAssumedSlewNPerS,
                      700,
                      5,
                      mm(160, 120, 70),
                      {0.045F, 0, 0.26F, 0.055e-3F, kUsbS}}),
    with_arm_damping({"touch-x",
                      7.9F,
                      1.75F,
                      kAssumedSlewNPerS,
                      1000,
                      5,
                      mm(160, 120, 120),
                      {0.045F, 0, 0.06F, 0.023e-3F, kUsbS}}),
    with_arm_damping({"premium-1.5",
                      8.5F,
                      1.4F,
                      kAssumedSlewNPerS,
                      800,
                      5,
                      mm(381, 267, 191),
                      {0.075F, 0, 0.04F, 0.03e-3F, kUsbS}}),
    with_arm_damping({"premium-3.0",
                      22,
                      3,
                      kAssumedSlewNPerS,
                      1000,
                      5,
                      mm(838, 584, 406),
                      {0.159F, 0, 0.2F, 0.02e-3F, kUsbS}}),
};

bool modem_manager_runs(const HostTree& tree) {
  for (const std::string& process : names_in(tree, "/proc")) {
    if (!parse_number(process)) continue;
    if (read_text(tree, "/proc/" + process + "/comm") == "ModemManager") return true;
  }
  return false;
}

void search(const HostTree& tree, DeviceSighting& out) {
  Attached touch = find_usb(tree, kUsb);
  touch.nodes.clear();  // the driver talks to a terminal or a raw HID instead
  add_nodes(tree, "tty", kUsb, touch);
  add_nodes(tree, "hidraw", kUsb, touch);
  if (const std::string missing = openhaptics_missing(); !missing.empty()) {
    out.seen = (touch.place.empty() ? "" : touch.place + ", but ") + missing;
    out.remedy =
        "install the vendor's OpenHaptics and Touch driver; a library it lacks, such as "
        "libncurses.so.5, is in Debian (apt install libncurses5)";
    return;
  }
  if (!touch.place.empty() && !may_use(tree, touch, out)) return;
  const bool terminal = !touch.nodes.empty() && touch.nodes[0].find("tty") != std::string::npos;
  if (terminal && !has_rules(tree) && modem_manager_runs(tree)) {
    out.seen = touch.place + ": ModemManager takes it for a modem";
    out.remedy = kUdevRemedy;
    return;
  }
  const bool on_usb = !touch.place.empty();
  out.presence = on_usb ? Presence::kReady : Presence::kUnknown;
  out.seen = on_usb ? "library, " + touch.place
                    : "library; none on USB (older ones are on Ethernet or FireWire)";
}

}  // namespace

constinit const DriverDescriptor hd_driver = {
    .scheme = "hd",
    .uri = "hd:",
    .name = "3D Systems Touch and relatives",
    .open = open_openhaptics,
    .search = search,
    .may_open_again = [] { return !openhaptics_in_use(); },
    .usb = kUsb,
    .models = kModels,
    .row = {"`hd:`, `hd:NAME`", "3D Systems Touch, Touch X, Omni, Premium", "6 / 3",
            "OpenHaptics 3.x (`libHD.so`, or its path in `STYLET_LIBHD`), the Touch driver, "
            "`libncurses5`; NAME as in the vendor's set-up (`$GTDD_HOME/config`). Stylet hides "
            "your locale from it, because it reads numbers with a decimal point"},
};

}  // namespace stylet::hal
