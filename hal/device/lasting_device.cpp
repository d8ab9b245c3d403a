// SPDX-License-Identifier: Apache-2.0
#include "hal/device/lasting_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "hal/base/contained.h"
#include "hal/device/devices.h"

namespace stylet::hal {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr Seconds kLookEvery(0.02);

struct Lasting {
  Reopening reopening;
  std::string name, identity;
  DeviceInfo info;
  // `lent` is the device that the loop may use now; `used` is the one it is calling right now.
  std::atomic<const Device*> lent{nullptr};
  std::atomic<const Device*> used{nullptr};
  std::atomic<std::uint32_t> opened{1};  // how many times
  // Used by the loop alone.
  std::uint32_t read_from = 1;
  std::uint64_t seq_base = 0, seq = 0;
  // Shared by the keeper and whoever asks for the trouble.
  std::mutex mutex;
  std::condition_variable wake;
  bool stop = false;
  std::string trouble, note;
  std::unique_ptr<Device> device;
  bool failed = false;  // though it may not be closed yet
  std::thread keeper;
};

// ==== The loop

// Null: there is no device, or it is being taken away.
const Device* borrow(Lasting& lasting) {
  const Device* device = lasting.lent.load();
  lasting.used.store(device);
  if (lasting.lent.load() == device) return device;
  lasting.used.store(nullptr);
  return nullptr;
}

bool read(void* self, std::int64_t now_ns, Sample& sample_out) {
  Lasting& lasting = *static_cast<Lasting*>(self);
  const Device* device = borrow(lasting);
  Sample sample = {};
  const bool answered = device != nullptr && device->read(device->self, now_ns, sample);
  const std::uint32_t opened = lasting.opened.load();
  lasting.used.store(nullptr);
  if (!answered) return false;
  if (opened != lasting.read_from) lasting.seq_base = lasting.seq;
  lasting.read_from = opened;
  sample.seq += lasting.seq_base;
  lasting.seq = sample.seq;
  sample_out = sample;
  return true;
}

void write(void* self, const Command& command) {
  Lasting& lasting = *static_cast<Lasting*>(self);
  if (const Device* device = borrow(lasting); device != nullptr) {
    device->write(device->self, command);
  }
  lasting.used.store(nullptr);
}

bool motor(void* self, MotorReport& report_out) {
  Lasting& lasting = *static_cast<Lasting*>(self);
  const Device* device = borrow(lasting);
  report_out = {};  // without a device there is no force
  const bool told = device == nullptr || device->motor(device->self, report_out);
  lasting.used.store(nullptr);
  return told;
}

// ==== The keeper

void retire(Lasting& lasting) {
  lasting.lent.store(nullptr);
  while (lasting.used.load() == lasting.device.get()) std::this_thread::yield();
  lasting.device->close(lasting.device->self);
  lasting.device.reset();
}

bool renders_less(const DeviceInfo& now, const DeviceInfo& first) {
  return now.max_force_n < first.max_force_n || now.max_torque_nm < first.max_torque_nm ||
         now.max_stiffness_n_per_m < first.max_stiffness_n_per_m ||
         now.continuous_force_n < first.continuous_force_n;
}

// Why the device that came is refused; empty: it is the same.
std::string stranger(const DeviceInfo& now, const Lasting& lasting) {
  if (now.identity != lasting.identity) {
    const auto called = [](const std::string& id) {
      return id.empty() ? "one without a name" : id;
    };
    return fmt::format(
        "{} is there instead of {}: connect that one again, or end the run and start it again",
        called(now.identity), called(lasting.identity));
  }
  if (!renders_less(now, lasting.info)) return "";
  return fmt::format(
      "{} is there instead, which renders less: connect the first one again, or end the run and "
      "start it again",
      now.name);
}

bool may_open(const Lasting& lasting) {
  return lasting.reopening.may_open == nullptr || lasting.reopening.may_open();
}

// Empty: the device is open and lent to the loop.
std::string open_again(Lasting& lasting) try {
  const Device device = lasting.reopening.open();
  if (std::string why = stranger(device.info, lasting); !why.empty()) {
    device.close(device.self);
    return why;
  }
  lasting.device = std::make_unique<Device>(device);
  lasting.failed = false;
  lasting.opened.fetch_add(1);
  lasting.lent.store(lasting.device.get());
  return "";
} catch (const std::exception& error) {
  const std::string why = error.what(), prefix = lasting.reopening.uri + ": ";
  return why.starts_with(prefix) ? why.substr(prefix.size()) : why;
}

void tell(Lasting& lasting, std::string& trouble, std::string& note) {
  const std::lock_guard lock(lasting.mutex);
  lasting.trouble.swap(trouble);
  lasting.note.swap(note);
}

// What is wrong with it; afterwards it may be open again. Sets the pause before the next look.
std::string look_after(Lasting& lasting, Seconds& wait, Seconds& pause) {
  if (!lasting.failed) {
    const std::string trouble = trouble_of(*lasting.device);
    wait = kLookEvery;
    if (trouble.empty()) return trouble;
    lasting.failed = true;
    std::string now = trouble, none;
    tell(lasting, now, none);  // told first: closing a device that hangs may take for ever
    if (may_open(lasting)) retire(lasting);
    wait = pause = Seconds(lasting.reopening.first_try_s);
    return trouble;
  }
  if (!may_open(lasting)) {  // not counted as a try: asked often, it comes back with the others
    wait = Seconds(lasting.reopening.first_try_s);
    return "it can be opened again only when no other of its kind is in use: end the run";
  }
  if (lasting.device != nullptr) retire(lasting);
  const std::string trouble = open_again(lasting);
  pause = std::min(2 * pause, Seconds(lasting.reopening.longest_try_s));
  wait = trouble.empty() ? kLookEvery : pause;
  return trouble;
}

void keep(Lasting& lasting) {
  name_thread("stylet-keeper");
  Seconds wait = kLookEvery, pause(lasting.reopening.first_try_s);
  std::unique_lock lock(lasting.mutex);
  while (!lasting.wake.wait_for(lock, wait, [&] { return lasting.stop; })) {
    lock.unlock();
    std::string trouble = "out of memory", note;  // short enough to need no memory
    (void)contained("device", [&] {
      trouble = look_after(lasting, wait, pause);
      if (lasting.device != nullptr) note = note_of(*lasting.device);
    });
    tell(lasting, trouble, note);
    lock.lock();
  }
}

void close(void* self) {
  const std::unique_ptr<Lasting> lasting(static_cast<Lasting*>(self));
  {
    const std::lock_guard lock(lasting->mutex);
    lasting->stop = true;
  }
  lasting->wake.notify_one();
  lasting->keeper.join();
  if (lasting->device != nullptr) retire(*lasting);
}

std::string trouble(void* self) {
  Lasting& lasting = *static_cast<Lasting*>(self);
  const std::lock_guard lock(lasting.mutex);
  return lasting.trouble;
}

std::string note(void* self) {
  Lasting& lasting = *static_cast<Lasting*>(self);
  const std::lock_guard lock(lasting.mutex);
  return lasting.note;
}

}  // namespace

Device lasting_device(const Device& first, const Reopening& reopening) {
  auto lasting = std::make_unique<Lasting>();
  lasting->reopening = reopening;
  lasting->name = first.info.name;  // the first device's own name goes with it
  lasting->info = first.info;
  lasting->info.name = lasting->name.c_str();
  lasting->identity = first.info.identity;
  lasting->info.identity = lasting->identity.c_str();
  lasting->device = std::make_unique<Device>(first);
  lasting->note = note_of(first);
  lasting->lent.store(lasting->device.get());
  lasting->keeper = std::thread([at = lasting.get()] { keep(*at); });
  Lasting* made = lasting.release();
  Device device = {made, made->info, read, write, close, trouble};
  if (first.motor != nullptr) device.motor = motor;
  device.note = note;
  return device;
}

}  // namespace stylet::hal
