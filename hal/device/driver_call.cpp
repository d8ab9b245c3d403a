// SPDX-License-Identifier: Apache-2.0
#include "hal/device/driver_call.h"

#include "hal/base/contained.h"

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

std::vector<std::size_t> close_devices(std::span<const Device> devices,
                                       std::chrono::milliseconds longest) {
  std::vector<std::shared_ptr<std::atomic<bool>>> done;
  std::vector<std::thread> threads;
  for (const Device& device : devices) {
    done.push_back(std::make_shared<std::atomic<bool>>(false));
    threads.emplace_back([device, mine = done.back()] {
      (void)contained("closing a device", [&device] { device.close(device.self); });
      mine->store(true);
    });
  }
  const auto end = std::chrono::steady_clock::now() + longest;
  std::vector<std::size_t> hang;
  for (std::size_t i = 0; i < threads.size(); ++i) {
    while (!done[i]->load() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (done[i]->load()) {
      threads[i].join();
      continue;
    }
    threads[i].detach();
    count_given_up();
    hang.push_back(i);
  }
  return hang;
}

}  // namespace stylet::hal
