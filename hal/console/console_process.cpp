// SPDX-License-Identifier: Apache-2.0
#include "hal/console/console_process.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "hal/base/packing.h"
#include "hal/console/limits.h"
#include "hal/score/packing.h"

namespace stylet::console {
namespace {

using hal::Packer;
using hal::Unpacker;

constexpr double kLookS = 0.005;  // pause between looks at rows and messages

// ---- the memory that both processes see

struct Beats {
  alignas(hal::kCacheLine) std::atomic<std::uint64_t> count;
};
using Numbers = hal::SharedLatest<hal::MetricNumbers>;
constexpr std::size_t on_line(std::size_t bytes) {
  return (bytes + hal::kCacheLine - 1) / hal::kCacheLine * hal::kCacheLine;
}
constexpr std::size_t kNumbersAt = sizeof(Beats);
constexpr std::size_t kToldAt = on_line(kNumbersAt + Numbers::bytes());
constexpr std::size_t kAllBytes = kToldAt + hal::Ring<Told>::bytes(kRowRing);

Beats& beats_in(std::span<std::byte> shared) {
  return *reinterpret_cast<Beats*>(shared.data());
}

// ---- the messages between them

enum class Word : std::uint8_t { kStage, kActivity, kScore, kRefuse, kOrder, kPointer, kLeft };

hal::Bytes packed(const ServerConfig& config) {
  Packer packer;
  packer.put(config.gate.address).put(config.gate.port).put(config.gate.token);
  packer.put(config.spared_processors);
  return {packer.bytes().begin(), packer.bytes().end()};
}

ServerConfig config_of(const hal::Bytes& greeting) {
  Unpacker from(greeting);
  ServerConfig config;
  from.get(config.gate.address);
  from.get(config.gate.port);
  from.get(config.gate.token);
  from.get(config.spared_processors);
  return config;
}

// `Way` is a function of a Packer or an Unpacker for any number of values. Visits all but shared
// names and the display.
template <typename Way>
void visit(Way way, SceneView& view) {
  way(view.scene, view.period_s, view.recording_ticks, view.lattice.rest_m, view.lattice.corners,
      view.lattice.of_kernel, view.obstacles);
}

template <typename Way>
void visit(Way way, ShownNeedle& needle) {
  way(needle.device, needle.length_m, needle.outer_radius_m, needle.course, needle.max_force_n);
}

template <typename Way>
void visit(Way way, ScoredAttempt& attempt) {
  way(attempt.attempt, attempt.trainee, attempt.began, attempt.recording);
  hal::visit_score(way, attempt.score);
}

template <typename Way>
void visit(Way way, Order& order) {
  way(order.verb, order.text, order.tick, order.speed, order.needle, order.fault_number,
      order.seen_ns);
}

Packer packed(const SceneView& given) {
  Packer packer;
  SceneView view = given;
  visit([&packer](const auto&... each) { (packer.put(each), ...); }, view);
  packer.put_each(view.scenes, [](Packer& to, const std::string& name) { to.put(name); });
  packer.put_each(view.needles, [](Packer& to, const ShownNeedle& each) {
    ShownNeedle needle = each;
    visit([&to](const auto&... part) { (to.put(part), ...); }, needle);
  });
  packer.put_each(view.targets, hal::pack_target);
  packer.put(view.organ->path).put(view.organ->bytes);
  return packer;
}

std::shared_ptr<SceneView> view_of(std::span<const std::byte> bytes, int display) {
  Unpacker from(bytes);
  auto view = std::make_shared<SceneView>();
  auto organ = std::make_shared<hal::OrganFile>();
  visit([&from](auto&... each) { (from.get(each), ...); }, *view);
  from.get_each(view->scenes, [](Unpacker& part, std::string& name) { part.get(name); });
  from.get_each(view->needles, [](Unpacker& part, ShownNeedle& needle) {
    visit([&part](auto&... each) { (part.get(each), ...); }, needle);
  });
  from.get_each(view->targets, hal::unpack_target);
  from.get(organ->path);
  from.get(organ->bytes);
  if (organ_open(organ->bytes, organ->organ) != Status::kOk) throw hal::PackingError();
  view->organ = std::move(organ);
  view->display = std::make_shared<hal::Display>(display);
  return view;
}

// True if the order is one that the server would pass on from a page.
bool sane(const Order& order) {
  const auto control = [](unsigned char c) { return c < ' ' || c == 0x7F; };
  const std::string& text = order.text;
  switch (order.verb) {
    case Verb::kMark:
      return text.size() <= kMaxMarkBytes && std::none_of(text.begin(), text.end(), control);
    case Verb::kChoose:
      return text.size() <= kMaxMessageBytes;
    default:
      return order.verb >= Verb::kStart && order.verb <= Verb::kAcknowledge &&
             text.size() <= kMaxNameBytes;
  }
}

}  // namespace

hal::Bytes wish_message(const Wish& wish) {
  Packer packer;
  if (std::holds_alternative<PointerLeft>(wish)) {
    packer.put(Word::kLeft);
  } else if (const auto* moved = std::get_if<PointerMoved>(&wish); moved != nullptr) {
    packer.put(Word::kPointer).put(*moved);
  } else {
    packer.put(Word::kOrder);
    Order order = std::get<Order>(wish);
    visit([&packer](const auto&... each) { (packer.put(each), ...); }, order);
  }
  return {packer.bytes().begin(), packer.bytes().end()};
}

Wish wish_of(std::span<const std::byte> message) {
  Unpacker from(message);
  Word word = {};
  from.get(word);
  if (word == Word::kLeft) return PointerLeft{};
  if (word == Word::kPointer) {
    PointerMoved moved = {};
    from.get(moved);
    return moved;
  }
  Order order = {Verb::kEnd};
  visit([&from](auto&... each) { (from.get(each), ...); }, order);
  if (word != Word::kOrder || !sane(order)) throw hal::PackingError();
  return order;
}

// ---- on the loop's side

ConsoleProcess::ConsoleProcess(const ServerConfig& config)
    : process_(kConsoleRole, kAllBytes, packed(config)),
      numbers_(process_.shared().subspan(kNumbersAt)),
      told_(process_.shared().subspan(kToldAt)) {
  try {
    Unpacker(process_.answer()).get(url_);
  } catch (const hal::PackingError& error) {
    throw hal::SideError(error.what());
  }
}

void ConsoleProcess::send(const Packer& message, std::span<const int> descriptors) {
  hal::SideLink& link = process_.link();
  if (!link.gone() && !link.send(message.bytes(), kShowPatienceS, descriptors)) process_.kill();
}

void ConsoleProcess::show(const SceneView& view) {
  // A view may have any size, so it is not sent through the socket.
  const Packer all = packed(view);
  const hal::SharedMemory parcel(all.bytes().size());
  std::copy(all.bytes().begin(), all.bytes().end(), parcel.bytes().begin());
  const std::array descriptors = {parcel.descriptor(), view.display->descriptor()};
  send(Packer().put(Word::kStage), descriptors);
}

void ConsoleProcess::show(Activity activity) {
  send(Packer().put(Word::kActivity).put(activity));
}

void ConsoleProcess::show(const ScoredAttempt& attempt) {
  Packer packer;
  packer.put(Word::kScore);
  ScoredAttempt copy = attempt;
  visit([&packer](const auto&... each) { (packer.put(each), ...); }, copy);
  send(packer);
}

void ConsoleProcess::refuse(const std::string& what) {
  send(Packer().put(Word::kRefuse).put(what));
}

void ConsoleProcess::publish(const hal::MetricNumbers& numbers) {
  numbers_.draft() = numbers;
  numbers_.publish();
}

std::optional<Wish> ConsoleProcess::next(double patience_s) try {
  const std::optional<hal::Bytes> message = process_.link().receive(patience_s);
  if (!message) return std::nullopt;
  return wish_of(*message);
} catch (const hal::PackingError&) {
  process_.kill();
  return std::nullopt;
}

bool ConsoleProcess::alive_within(double seconds) {
  const std::uint64_t beats = beats_in(process_.shared()).count.load(std::memory_order_relaxed);
  if (beats != beats_) beat_ = Clock::now();
  beats_ = beats;
  return Clock::now() - beat_ < std::chrono::duration<double>(seconds);
}

// ---- in the process beside

namespace {

// What a page asks for. Orders that find no room in the socket are refused as too many.
ServerEvents events_to(hal::SideLink& link, Numbers& numbers,
                       std::shared_ptr<hal::Metrics> metrics) {
  ServerEvents events;
  events.ordered = [&link](const Order& order) -> std::string {
    return link.send(wish_message(order), 0) ? "" : "too many orders at once";
  };
  events.pointed = [&link](const PointerMoved& moved) { (void)link.send(wish_message(moved), 0); };
  events.pointer_left = [&link] { (void)link.send(wish_message(PointerLeft{}), kShowPatienceS); };
  events.metrics = [&numbers, metrics = std::move(metrics)](const ServerCounters& counters) {
    if (const hal::MetricNumbers* newest = numbers.take(); newest != nullptr) {
      static_cast<hal::MetricNumbers&>(*metrics) = *newest;
    }
    metrics->version = STYLET_VERSION;
    metrics->scene = counters.scene;
    metrics->connections = static_cast<std::uint32_t>(counters.connections);
    metrics->lost_frames = counters.lost_frames;
    return metrics_text(*metrics);
  };
  return events;
}

void obey(Server& server, const hal::Bytes& message, std::vector<int>& descriptors) {
  Unpacker from(message);
  Word word = {};
  from.get(word);
  if (word == Word::kStage && descriptors.size() == 2) {
    const hal::SharedMemory parcel = hal::SharedMemory::of(descriptors[0]);
    server.show(view_of(parcel.bytes(), descriptors[1]));
    descriptors.clear();
  } else if (word == Word::kActivity) {
    Activity activity = {};
    from.get(activity);
    server.show(activity);
  } else if (word == Word::kScore) {
    ScoredAttempt attempt;
    visit([&from](auto&... each) { (from.get(each), ...); }, attempt);
    server.show(attempt);
  } else if (word == Word::kRefuse) {
    std::string what;
    from.get(what);
    server.refuse(what);
  }
}

}  // namespace

void console_beside(hal::SideSeat& seat) {
  Beats& beats = beats_in(seat.shared);
  Numbers numbers(seat.shared.subspan(kNumbersAt));
  hal::Ring<Told> told(seat.shared.subspan(kToldAt));
  const auto metrics = std::make_shared<hal::Metrics>();
  Server server(config_of(seat.greeting), events_to(seat.link, numbers, metrics));
  seat.ready(Packer().put(server.url()).bytes());
  std::vector<int> descriptors;
  while (!seat.link.gone()) {
    const std::optional<hal::Bytes> message = seat.link.receive(kLookS, &descriptors);
    // Rows first, because they were told before the message.
    for (Told each; told.pop(each);) (void)server.tell(each);
    if (message) obey(server, *message, descriptors);
    beats.count.fetch_add(1, std::memory_order_relaxed);
  }
}

}  // namespace stylet::console
