// SPDX-License-Identifier: Apache-2.0
#include "hal/device/driver_call.h"

#include <algorithm>
#include <array>

#include "hal/base/contained.h"
#include "stylet/limits.h"

namespace stylet::hal {
namespace {

std::atomic<int> given_up{0};

}  // namespace

int driver_calls_given_up() {
  return given_up.load();
}

void count_given_up() {
  given_up.fetch_add(1);
}

namespace {

struct Closing {
  std::shared_ptr<std::atomic<bool>> done;
  std::thread thread;
};

void close_now(const Device& device) noexcept {
  (void)contained("closing a device", [&device] { device.close(device.self); });
}

// Without memory or threads, the caller closes the device itself, and waits even if it hangs.
Closing begin_closing(const Device& device) {
  try {
    auto done = std::make_shared<std::atomic<bool>>(false);
    std::thread thread([device, done] {
      close_now(device);
      done->store(true);
    });
    return {std::move(done), std::move(thread)};
  } catch (const std::exception&) {
    close_now(device);
    return {};
  }
}

// False: it still hangs at `end`, and is given up.
bool closes(Closing& closing, std::chrono::steady_clock::time_point end) {
  if (!closing.thread.joinable()) return true;
  while (!closing.done->load() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (closing.done->load()) {
    closing.thread.join();
    return true;
  }
  closing.thread.detach();
  count_given_up();
  return false;
}

}  // namespace

std::vector<std::size_t> close_devices(std::span<const Device> devices,
                                       std::chrono::milliseconds longest) {
  std::array<Closing, kMaxNeedles> closing;  // a list that needs no memory
  std::vector<std::size_t> hang;
  for (std::size_t first = 0; first < devices.size(); first += closing.size()) {
    const auto some = devices.subspan(first, std::min(closing.size(), devices.size() - first));
    std::ranges::transform(some, closing.begin(), begin_closing);
    const auto end = std::chrono::steady_clock::now() + longest;
    for (std::size_t i = 0; i < some.size(); ++i) {
      if (!closes(closing[i], end)) hang.push_back(first + i);
    }
  }
  return hang;
}

}  // namespace stylet::hal
