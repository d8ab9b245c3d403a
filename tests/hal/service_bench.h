// SPDX-License-Identifier: Apache-2.0
// Stand-ins of services: the one of Haply on a WebSocket, and spacenavd on its socket.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "device_bench.h"

namespace stylet::hal {

// Behaves as the vendor's service: first an inventory, then one state for each message. Frames come
// in pieces with pings between them, every fiftieth answer is cut short, and buttons have either of
// their two names. A silent service keeps the last force until the connection ends. It starts with
// force gate 0.3 and damping 0.5, and renders 0.8 of a force while its gate is below 1.
class HaplyService : public Bench {
 public:
  explicit HaplyService(int clients = 1);  // at the same time
  ~HaplyService() override;
  std::string uri() const override { return uri_with(""); }
  std::string uri_with(const std::string& wishes) const;
  std::string address(const std::string& id = "049D") const;
  // Sends on the channel of events, to the client that listens or, if there is none, to the next
  // one.
  void tell(const std::string& event);
  void move(const Pose& pose) override;
  void press(std::uint32_t mask) override;
  Vec3 felt() override;
  int writes() override { return messages; }
  void trouble(test::Trouble trouble) override { trouble_ = trouble; }
  std::atomic<int> messages{0};
  std::atomic<int> unasked{0};         // every so many answers one is sent twice; 0: none
  std::atomic<int> cut{50};            // every so many answers one is cut short
  std::atomic<int> answer_time_us{0};  // from a message to its answer; it reads nothing meanwhile
  std::atomic<std::uint64_t> most_waiting_bytes{0};  // unread at an answer
  std::atomic<bool> lists_ours{true}, grip_awake{true};
  std::atomic<bool> ours_first{false};          // otherwise after AAAA, which is at another place
  std::atomic<bool> other_grip{false};          // lists grip 2 first, awake, with all buttons held
  std::atomic<int> told_others{0};              // commands and settings for others than 049D
  std::function<void(nlohmann::json&)> change;  // set it before a client opens
  std::atomic<double> gate{0.3}, damping{0.5};

 private:
  struct Connection;
  struct Listener;
  void serve();
  void serve_events();
  void talk(Connection& connection);
  void answer(Connection& connection);
  std::string state(bool inventory);
  void obey(const std::string& message);

  std::unique_ptr<Listener> listener_, events_;
  std::mutex mutex_;
  std::vector<std::string> untold_;
  Pose pose_ = {{}, {1, 0, 0, 0}};
  std::uint32_t buttons_ = 0;
  Vec3 force_n_ = {};
  std::atomic<test::Trouble> trouble_{test::Trouble::kNone};
  std::atomic<bool> stop_{false};
  std::thread thread_, event_thread_;
  std::vector<std::thread> more_;
};

class Spacenavd : public Bench {
 public:
  // Old services do not answer the greeting.
  explicit Spacenavd(bool old_version = false);
  ~Spacenavd() override;
  std::string uri() const override { return "spacemouse:"; }
  void move(const Pose&) override {}
  void press(std::uint32_t mask) override;
  Vec3 felt() override { return {}; }
  void trouble(test::Trouble trouble) override { trouble_ = trouble; }
  // Deflections as the daemon reports them, sent every 8 ms in two pieces until others are set. If
  // all are zero, nothing is sent.
  void deflect(const std::array<int, 6>& deflection);
  void unplug();

 private:
  void serve();
  void send(const std::array<std::int32_t, 8>& packet);

  bool old_;
  std::string path_;
  int listener_ = -1;
  std::atomic<int> socket_{-1};
  std::mutex mutex_;
  std::array<int, 6> deflection_ = {};
  std::uint32_t buttons_ = 0;
  std::atomic<test::Trouble> trouble_{test::Trouble::kNone};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace stylet::hal
