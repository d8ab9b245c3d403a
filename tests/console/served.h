// SPDX-License-Identifier: Apache-2.0
// A rig with a console: its loop in virtual time, its rows passed on as a recorder passes them on.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "client.h"
#include "hal/console/server.h"
#include "hal/record/recorder.h"
#include "tests/hal/rig.h"

namespace stylet::console::test {

struct Served : hal::Rig {
  explicit Served(const GateConfig& gate = {}) {
    config.hand[0].scripted = true;
    auto file = std::make_shared<hal::OrganFile>();
    file->bytes = bytes;
    EXPECT_EQ(organ_open(file->bytes, file->organ), Status::kOk);
    ServerEvents asked;
    asked.ordered = [this](const Order& order) {
      const std::lock_guard lock(mutex);
      orders.push_back(order);
      return std::string(order.verb == Verb::kReset ? "not now" : "");
    };
    asked.metrics = [](const ServerCounters& counters) {
      return "lost_frames " + std::to_string(counters.lost_frames) + "\n";
    };
    server = std::make_unique<Server>(ServerConfig{gate, {}}, std::move(asked));
    const std::string url = server->url();
    port = static_cast<std::uint16_t>(std::stoul(url.substr(url.find(':', 7) + 1)));
    show_view(file);
  }

  void show_view(const std::shared_ptr<const hal::OrganFile>& file) {
    course = hal::place_needle(scene, organ).course;
    auto view = std::make_shared<SceneView>();
    view->scene = "rig.toml";
    view->scenes = {"rig.toml"};
    view->period_s = 1e-3F;
    view->organ = file;
    view->lattice = make_lattice(organ, instance->kernel);
    view->needles = {{"simulated", 0.15F, 0.6e-3F, course, 2}};
    view->display = std::shared_ptr<hal::Display>(display.get(), [](hal::Display*) {});
    server->show(view);
  }

  // The whole attempt.
  void run_all() {
    hal::Recorder recorder(
        records, events, nullptr, std::span(&course, 1), nullptr, nullptr,
        [this](std::span<const hal::TickRecord> fresh, std::span<const stylet::Event> happenings) {
          for (const auto& each : fresh) {
            server->tell({false, row_of(each, course), {}});
          }
          for (const auto& each : happenings) {
            server->tell({true, {}, console::happened(each)});
          }
        });
    const hal::Device hand_device = device();
    hal::run_loop(config, instance->kernel, std::span(&hand_device, 1), hal::virtual_clock(time),
                  {&records, &events, display.get(), true}, state);
    recorder.stop();
  }

  std::size_t orders_taken() {
    const std::lock_guard lock(mutex);
    return orders.size();
  }

  hal::Course course;
  std::mutex mutex;
  std::vector<Order> orders;
  std::uint16_t port = 0;
  std::unique_ptr<Server> server;  // last: it uses all of the above
};

}  // namespace stylet::console::test
