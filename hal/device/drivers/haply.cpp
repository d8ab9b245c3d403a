// SPDX-License-Identifier: Apache-2.0
#include "hal/device/drivers/haply.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <charconv>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <vector>

#include "hal/device/devices.h"
#include "hal/device/driver.h"
#include "hal/device/drivers/haply_connection.h"
#include "hal/device/drivers/haply_events.h"
#include "hal/device/drivers/haply_state.h"
#include "hal/device/model.h"
#include "hal/device/patience.h"
#include "hal/device/relay.h"
#include "hal/device/thread.h"

namespace stylet::hal {
namespace {

using namespace haply;
using boost::asio::ip::tcp;
using nlohmann::json;

constexpr std::int64_t kExchangeNs = 500'000;
constexpr std::uint32_t kNoAnswer = 1, kDeviceGone = 2, kBrake = 3;
constexpr const char* kExpected =
    "expected nothing, ID, or ID@ADDRESS:PORT, and then ,grip=ID ,gate=0.3 ,damping=0 or "
    ",events=10020";
// Options after the commas of a URI: what the service does to a force. The gate removes some of it
// when it sees oscillation, damping resists motion. Damping is the kernel's business, so there is
// none unless asked for; the gate is a safety net of the service and stays as it is.
struct Wishes {
  double gate = -1;  // negative: as the service has it
  double damping = 0;
  unsigned short events = 10020;
  std::string grip;  // an id, or "none"; empty: the only one
};

// Devices and grips that this program holds: no two needles share one, so that a button pressed for
// one hand never arms the other.
class Claim {
 public:
  Claim() = default;
  ~Claim() {
    const std::lock_guard lock(mutex());
    if (!key_.empty()) held().erase(key_);
  }
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  // False: somebody else holds it.
  bool take(const std::string& key) {
    const std::lock_guard lock(mutex());
    if (!held().insert(key).second) return false;
    key_ = key;
    return true;
  }
  static bool is_free(const std::string& key) {
    const std::lock_guard lock(mutex());
    return !held().contains(key);
  }

 private:
  // Never destroyed: a device may outlive static objects.
  static std::mutex& mutex() {
    static auto* const the_only = new std::mutex;
    return *the_only;
  }
  static std::set<std::string>& held() {
    static auto* const the_only = new std::set<std::string>;
    return *the_only;
  }
  std::string key_;
};

struct Haply {
  Relay relay;
  DeviceThread thread;
  HaplyConnection link;
  Wishes wishes;
  std::string service;  // its address
  HaplyIds ids;         // fixed for as long as it is open
  Claim device_claim, grip_claim;
  std::string identity;
  HaplyState state;
  std::atomic<float> asked_n{0}, rendered_n{0};
  std::mutex mutex;
  std::string warning;  // the newest event
  std::unique_ptr<HaplyEvents> events;
};

void exchange_once(Haply& haply) {
  if (!haply.link.socket.next_layer().is_open()) return;
  json message;
  const Vec3 force_n = haply.relay.order(monotonic_now_ns()).force_n;
  haply.asked_n = std::hypot(force_n.x, force_n.y, force_n.z);
  const bool answered = tell(haply.link, force_message(haply.ids, force_n), message);
  haply.relay.written(monotonic_now_ns());
  if (!answered) haply.relay.fail(kNoAnswer);
  if (haply.relay.failed()) return hang_up(haply.link);  // an event may have reported it, too
  if (message.is_discarded()) return;                    // not a message: the next may be one
  if (take_state(message, haply.ids, haply.state)) {
    haply.rendered_n = static_cast<float>(haply.state.rendered_n);
    haply.relay.publish(haply.state.pose, haply.state.buttons, monotonic_now_ns());
  } else if (message.contains("inverse3")) {
    haply.relay.fail(kDeviceGone);
    hang_up(haply.link);
  }
}

// No exception leaves the thread: what cannot be handled counts as a device that does not answer.
void exchange(Haply& haply) try { exchange_once(haply); } catch (const std::exception&) {
  haply.relay.fail(kNoAnswer);
}

// Runs in the thread of the events. What ends the device for the hand ends it for us, at once, with
// the event's name; other events are told when somebody asks.
void hear(Haply& haply, const HaplyEvent& event) {
  if (!event.device_id.empty() && event.device_id != haply.ids.device) return;
  if (event.warns) {  // first, because whoever sees the failure asks for its reason
    const std::lock_guard lock(haply.mutex);
    haply.warning = event.name + (event.message.empty() ? "" : ": " + event.message);
  }
  if (event.name == "device-disconnected") haply.relay.fail(kDeviceGone);
  if (event.safety == "ebrake_triggered") haply.relay.fail(kBrake);
}

void close(void* self) {
  const std::unique_ptr<Haply> haply(static_cast<Haply*>(self));
  haply->events.reset();
  haply->relay.end();
  std::this_thread::sleep_for(kFadeTime);
  haply->thread.stop();
  if (!haply->link.socket.next_layer().is_open()) return;
  json last;
  (void)tell(haply->link, force_message(haply->ids, {}), last);
  hang_up(haply->link);
}
std::string trouble(void* self) {
  Haply& haply = *static_cast<Haply*>(self);
  if (!haply.relay.failed()) return "";
  const std::lock_guard lock(haply.mutex);
  const std::string told = haply.warning.empty() ? "" : " (" + haply.warning + ")";
  switch (haply.relay.why()) {
    case kDeviceGone:
      return "the service does not list it any more: check its cable" + told;
    case kBrake:
      return "its emergency brake has locked it" + told;
    default:
      return "the service does not answer: systemctl restart haply-inverse-service" + told;
  }
}

std::string about(void* self) {
  Haply& haply = *static_cast<Haply*>(self);
  const auto said = [](double value) {
    return value < 0 ? "not told" : fmt::format("{:g}", value);
  };
  const float asked = haply.asked_n, rendered = haply.rendered_n;
  const std::lock_guard lock(haply.mutex);
  return fmt::format(
      "its service came with force gate {} and damping {}, now {} and {:g}; {:.2f} N asked, "
      "{:.2f} N rendered; {}; {}{}",
      said(haply.state.gate), said(haply.state.damping),
      said(haply.wishes.gate >= 0 ? haply.wishes.gate : haply.state.gate), haply.wishes.damping,
      asked, rendered, haply.ids.grip.empty() ? "no grip" : "grip " + haply.ids.grip,
      haply.events->connected() ? "events are heard" : "no events",
      haply.warning.empty() ? "" : ": " + haply.warning);
}

// Removes the options after the commas from the URI, and returns them.
Wishes wishes_of(std::string& rest) {
  Wishes wishes;
  const std::string whole = rest;
  for (std::size_t comma = rest.rfind(','); comma != std::string::npos; comma = rest.rfind(',')) {
    const std::string wish = rest.substr(comma + 1);
    const std::size_t equals = wish.find('=');
    const std::string key = wish.substr(0, equals);
    double value = -1;
    if (equals != std::string::npos) {
      const char* const end = wish.data() + wish.size();
      if (std::from_chars(wish.data() + equals + 1, end, value).ptr != end) value = -1;
    }
    const bool fraction = (key == "gate" || key == "damping") && value >= 0 && value <= 1;
    const bool whole_number = value == std::floor(value);
    const bool port = key == "events" && whole_number && value >= 1 && value <= 65535;
    const bool grip = key == "grip" && equals + 1 < wish.size();
    if (!fraction && !port && !grip)
      throw DeviceError(fmt::format("haply:{}: {}: {}", whole, wish, kExpected));
    if (key == "gate") wishes.gate = value;
    if (key == "damping") wishes.damping = value;
    if (port) wishes.events = static_cast<unsigned short>(value);
    if (grip) wishes.grip = wish.substr(equals + 1);
    rest.resize(comma);
  }
  return wishes;
}

tcp::endpoint endpoint_of(const std::string& rest, std::string& id) {
  const std::size_t at = rest.find('@');
  id = rest.substr(0, at);
  const std::string where = at == std::string::npos ? "127.0.0.1:10001" : rest.substr(at + 1);
  const std::size_t colon = where.rfind(':');
  boost::beast::error_code error;
  unsigned short port = 0;
  if (colon != std::string::npos) {
    std::from_chars(where.data() + colon + 1, where.data() + where.size(), port);
  }
  const auto address = boost::asio::ip::make_address(where.substr(0, colon), error);
  if (error || port == 0) throw DeviceError(fmt::format("haply:{}: {}", rest, kExpected));
  return {address, port};
}

std::string listed(const std::vector<std::string>& ids) {
  std::string all;
  for (const std::string& each : ids) all += (all.empty() ? "" : ", ") + each;
  return all.empty() ? "none" : all;
}

// Takes the wanted device, or the first that nobody here holds; from now on no other.
bool choose_device(Haply& haply, const json& message, const std::string& wanted) {
  for (const std::string& each : listed_devices(message)) {
    if (!wanted.empty() && each != wanted) continue;
    if (!haply.device_claim.take(haply.service + "/device/" + each)) continue;
    haply.ids.device = each;
    return true;
  }
  return false;
}

// Takes the wanted grip, or the only one. With several, nobody can know which is in which hand.
void choose_grip(Haply& haply, const json& message, const std::string& rest) {
  const std::string& wanted = haply.wishes.grip;
  const std::string prefix = haply.service + "/grip/";
  if (wanted == "none") return;
  std::vector<std::string> there;
  for (const std::string& each : listed_grips(message)) {
    const bool free = wanted.empty() && Claim::is_free(prefix + each);
    if (free || each == wanted) there.push_back(each);
  }
  if (wanted.empty() && there.empty()) return;
  if (there.size() == 1 && haply.grip_claim.take(prefix + there[0])) {
    haply.ids.grip = there[0];
    return;
  }
  throw DeviceError(
      fmt::format("haply:{}: grip: {}: expected ,grip=ID with a grip that no other needle holds, "
                  "or ,grip=none; the service lists {}",
                  rest, wanted.empty() ? "several" : wanted, listed(listed_grips(message))));
}

std::string not_ready(const Haply& haply, const json& last, const std::string& wanted) {
  if (!haply.ids.device.empty()) {
    return "not calibrated: put the handle into the holder, as the vendor's guide says";
  }
  const std::vector<std::string> all = listed_devices(last);
  const bool there = std::find(all.begin(), all.end(), wanted) != all.end();
  if (there || (wanted.empty() && !all.empty())) {
    return fmt::format("another needle holds it; the service lists {}", listed(all));
  }
  return fmt::format("the service lists no such Inverse3: check its cable and power; it lists {}",
                     listed(all));
}

const char* no_answer(const Haply& haply, const json& newest) {
  if (newest.is_null() || haply.link.ponged) {
    return "the service does not answer: systemctl restart haply-inverse-service";
  }
  return "the service does not answer pings: expected a pong to each, as RFC 6455 (5.5.2) demands";
}

// The first message is the inventory; then one answer comes to each of our messages, all of which
// are without force. The list that counts is that of the last whole message.
void wait_until_ready(Haply& haply, const std::string& wanted, const std::string& rest,
                      double patience_s) {
  const Patience patience(patience_s);
  json message, whole;
  bool answered = receive(haply.link, message, within(kOpeningTime));
  while (true) {
    if (!answered) {
      throw DeviceError(fmt::format("haply:{}: {}", rest, no_answer(haply, message)));
    }
    if (!message.is_discarded()) whole = std::move(message);
    if (haply.ids.device.empty() && choose_device(haply, whole, wanted)) {
      take_filters(whole, haply.ids, haply.state);
      choose_grip(haply, whole, rest);
    }
    const bool found = take_state(whole, haply.ids, haply.state);
    if (found && haply.state.calibrated) return;
    if (patience.over()) {
      throw DeviceError(fmt::format("haply:{}: {}", rest, not_ready(haply, whole, wanted)));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const bool known = !haply.ids.device.empty();
    answered = tell(haply.link, known ? force_message(haply.ids, {}) : "{}", message, kOpeningTime);
  }
}

void configure(Haply& haply, const std::string& rest) {
  json answer;
  const Wishes& wishes = haply.wishes;
  const std::string wanted = filter_message(haply.ids, wishes.gate, wishes.damping);
  if (tell(haply.link, wanted, answer, kOpeningTime)) return;
  throw DeviceError(fmt::format(
      "haply:{}: {}", rest,
      answer.is_null() ? "the service accepts no configuration: expected its version 3.1 or newer"
                       : no_answer(haply, answer)));
}

}  // namespace

Device open_haply(const std::string& rest, double patience_s) try {
  auto haply = std::make_unique<Haply>();
  std::string where = rest, wanted;
  haply->wishes = wishes_of(where);
  const tcp::endpoint endpoint = endpoint_of(where, wanted);
  haply->service = fmt::format("{}:{}", endpoint.address().to_string(), endpoint.port());
  connect(haply->link, endpoint, rest);
  wait_until_ready(*haply, wanted, rest, patience_s);
  configure(*haply, rest);
  haply->events = std::make_unique<HaplyEvents>(
      tcp::endpoint(endpoint.address(), haply->wishes.events),
      [at = haply.get()](const HaplyEvent& event) { hear(*at, event); });
  haply->identity = fmt::format("{},grip={}", haply->ids.device,
                                haply->ids.grip.empty() ? "none" : haply->ids.grip);
  // Limits from the vendor's pages, chosen low, because the service does not tell them. All else is
  // that of an unknown device.
  const DeviceInfo info = {.name = "Haply Inverse3",
                           .max_force_n = 5,
                           .max_slew_n_per_s = 1000,
                           .max_stiffness_n_per_m = 2000,
                           .identity = haply->identity.c_str(),
                           .model = &unknown_device_model()};
  haply->relay.limits = motor_limits(info);
  haply->thread.start(kExchangeNs, [at = haply.get()] { exchange(*at); });
  Device device = relayed(haply.release(), info, close, trouble);
  device.about = about;
  return device;
} catch (const DeviceError&) {
  throw;
} catch (const std::exception& error) {  // caused by a message that nobody foresaw
  throw DeviceError(fmt::format("haply:{}: {}", rest, error.what()));
}

std::string same_haply(const std::string& rest, const std::string& identity) {
  std::string where = rest, others;
  const std::size_t comma = rest.find(',');
  if (comma != std::string::npos) {
    where = rest.substr(0, comma);
    others = rest.substr(comma);
    if (const std::size_t grip = others.find(",grip="); grip != std::string::npos) {
      const std::size_t end = others.find(',', grip + 1);
      others.erase(grip, end == std::string::npos ? end : end - grip);
    }
  }
  const std::size_t at = where.find('@'), split = identity.find(",grip=");
  return identity.substr(0, split) + (at == std::string::npos ? "" : where.substr(at)) +
         identity.substr(split) + others;
}

namespace {

// Whether somebody listens on this port of this machine.
bool listens(std::uint16_t port) {
  const int probe = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const auto* at = reinterpret_cast<const sockaddr*>(&address);
  const bool good = connect(probe, at, sizeof address) == 0;
  ::close(probe);
  return good;
}

void search(const HostTree&, DeviceSighting& out) {
  constexpr std::uint16_t kPort = 10001;
  if (!listens(kPort)) {
    out.seen = "no service on 127.0.0.1:10001";
    out.remedy = "install haply-inverse-service and start it";
    return;
  }
  out.presence = Presence::kUnknown;  // the service runs without a device as well
  out.seen = "its service answers; the device shows itself only when it is opened";
}

}  // namespace

constinit const DriverDescriptor haply_driver = {
    .scheme = "haply",
    .uri = "haply:",
    .name = "Haply Inverse3",
    .open = open_haply,
    .search = search,
    .may_open_again = may_always_open_again,
    .same = same_haply,
    .row = {"`haply:`, `haply:ID@ADDRESS:PORT`, then `,grip=ID` `,gate=0.3` `,damping=0` "
            "`,events=10020`",
            "Haply Inverse3, rotation and buttons with a VerseGrip", "3 or 6 / 3",
            "`haply-inverse-service` 3.1, which answers pings as any WebSocket has to; its damping "
            "is switched off (the kernel renders it), its force gate stays as it is, its events "
            "name what ended"},
};

std::span<const DriverDescriptor* const> drivers_with_haply() {
  static constexpr std::array kAll = {
#define STYLET_DRIVER(file, descriptor) &descriptor,
#define STYLET_LIBRARY_DRIVER STYLET_DRIVER
#define STYLET_LINUX_DRIVER STYLET_DRIVER
#include "hal/device/drivers.inc"
#undef STYLET_DRIVER
#undef STYLET_LIBRARY_DRIVER
#undef STYLET_LINUX_DRIVER
  };
  return kAll;
}

}  // namespace stylet::hal
