// SPDX-License-Identifier: Apache-2.0
// A page that posts the pointer's pose 60 times a second.
#include <atomic>
#include <mutex>

#include "device_bench.h"
#include "hal/device/drivers/pointer.h"

namespace stylet::hal {
namespace {

class Page : public Bench {
 public:
  Page() {
    places = feels = kNoAxis;  // it measures the way since the first post
    fails = false;
    pointer_serve(true);
    thread_ = std::thread([this] { post(); });
  }
  ~Page() override {
    stop_ = true;
    thread_.join();
    pointer_serve(false);
  }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;

  std::string uri() const override { return "pointer:1"; }
  void move(const Pose& pose) override {
    const std::lock_guard lock(mutex_);
    pose_ = pose;
  }
  void press(std::uint32_t mask) override {
    const std::lock_guard lock(mutex_);
    buttons_ = mask;
  }
  Vec3 felt() override { return {}; }
  void trouble(test::Trouble trouble) override { silent_ = trouble != test::Trouble::kNone; }

 private:
  void post() {
    while (!stop_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(16));
      const std::lock_guard lock(mutex_);
      if (silent_) continue;
      EXPECT_TRUE(pointer_post(1, pose_, buttons_));
    }
  }

  std::mutex mutex_;
  Pose pose_ = {{}, {1, 0, 0, 0}};
  std::uint32_t buttons_ = 0;
  std::atomic<bool> silent_{false}, stop_{false};
  std::thread thread_;
};

}  // namespace

std::unique_ptr<Bench> pointer_bench() {
  return std::make_unique<Page>();
}

}  // namespace stylet::hal
