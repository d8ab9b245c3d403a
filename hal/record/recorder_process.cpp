// SPDX-License-Identifier: Apache-2.0
#include "hal/record/recorder_process.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

#include "hal/base/packing.h"
#include "hal/record/recorder.h"
#include "hal/score/packing.h"

namespace stylet::hal {
namespace {

constexpr double kLookS = 0.1;

// ---- the memory that both processes see

struct Kept {
  alignas(kCacheLine) std::atomic<std::uint64_t> ticks;
};

constexpr std::size_t on_line(std::size_t bytes) {
  return (bytes + kCacheLine - 1) / kCacheLine * kCacheLine;
}
constexpr std::size_t kRecordsAt = sizeof(Kept);
constexpr std::size_t kRecordsBytes = Ring<TickRecord>::bytes(kRecordRing);
constexpr std::size_t kEventsAt = on_line(kRecordsAt + kRecordsBytes);
constexpr std::size_t kEventsBytes = Ring<Event>::bytes(kEventRing);
constexpr std::size_t kAllBytes = kEventsAt + kEventsBytes;

Kept& kept_in(std::span<std::byte> shared) {
  return *reinterpret_cast<Kept*>(shared.data());
}

// ---- the messages between them

// `Way` is a Packer's or an Unpacker's function.
template <typename Way>
void visit(Way way, RecorderTask& task) {
  RecordingInfo& info = task.info;
  for (std::string* each :
       {&info.stylet_version, &info.began, &info.trainee, &info.scene_file, &info.scene_text,
        &info.organ_file, &info.organ_name, &task.recording, &task.flight, &task.name.wanted}) {
    way(*each);
  }
  way(task.name.naming);
  way(info.organ_hash);
  way(info.config);
  way(info.course);
  way(info.obstacles);
}

Bytes copy_of(const Packer& packer) {
  return {packer.bytes().begin(), packer.bytes().end()};
}

Bytes packed(RecorderTask task) {
  Packer packer;
  visit([&packer](const auto& each) { packer.put(each); }, task);
  packer.put_each(task.targets, pack_target);
  return copy_of(packer);
}

RecorderTask task_of(const Bytes& greeting) {
  Unpacker unpacker(greeting);
  RecorderTask task;
  visit([&unpacker](auto& each) { unpacker.get(each); }, task);
  unpacker.get_each(task.targets, unpack_target);
  return task;
}

template <typename Way>
void visit(Way way, Flight& flight) {
  way(flight.path);
  way(flight.fault);
  way(flight.needle);
  way(flight.tick);
}

Bytes packed(Recorded recorded) {
  Packer packer;
  const auto put = [&packer](const auto& each) { packer.put(each); };
  packer.put_each(recorded.stages, [](Packer& to, const auto& rows) { to.put(rows); });
  packer.put(recorded.events);
  visit_score(put, recorded.score);
  packer.put_each(recorded.flights, [](Packer& to, const Flight& each) {
    Flight flight = each;
    visit([&to](const auto& part) { to.put(part); }, flight);
  });
  packer.put(recorded.error).put(recorded.flight_error).put(recorded.forgot);
  return copy_of(packer);
}

Recorded recorded_of(const Bytes& answer) {
  Unpacker unpacker(answer);
  Recorded recorded;
  const auto get = [&unpacker](auto& each) { unpacker.get(each); };
  unpacker.get_each(recorded.stages, [](Unpacker& from, auto& rows) { from.get(rows); });
  get(recorded.events);
  visit_score(get, recorded.score);
  unpacker.get_each(recorded.flights, [](Unpacker& from, Flight& flight) {
    visit([&from](auto& part) { from.get(part); }, flight);
  });
  get(recorded.error);
  get(recorded.flight_error);
  std::uint8_t forgot = 0;
  get(forgot);
  recorded.forgot = forgot != 0;
  return recorded;
}

// True if it fits the task, and has no number that would be unsafe as an index or a name.
bool sane(const Recorded& recorded, std::size_t needles, std::size_t targets) {
  const auto known = [needles](std::uint32_t needle) { return needle < needles; };
  const auto of_stage = [](const StageRow& row) { return row.stage <= Stage::kExit; };
  return recorded.stages.size() == needles && recorded.score.targets.size() == targets &&
         std::all_of(
             recorded.stages.begin(), recorded.stages.end(),
             [&](const auto& rows) { return std::all_of(rows.begin(), rows.end(), of_stage); }) &&
         std::all_of(recorded.events.begin(), recorded.events.end(),
                     [&](const Event& each) { return known(each.needle); }) &&
         std::all_of(recorded.flights.begin(), recorded.flights.end(), [&](const Flight& each) {
           return known(each.needle) && each.fault <= kLastFault;
         });
}

}  // namespace

// ---- on the loop's side

RecorderProcess::RecorderProcess(const RecorderTask& task)
    : process_(kRecorderRole, kAllBytes, packed(task)),
      records_(process_.shared().subspan(kRecordsAt, kRecordsBytes)),
      events_(process_.shared().subspan(kEventsAt, kEventsBytes)),
      needles_(task.info.config.needle_count),
      targets_(task.targets.size()) {}

std::uint64_t RecorderProcess::ticks_kept() const {
  return kept_in(process_.shared()).ticks.load(std::memory_order_relaxed);
}

bool RecorderProcess::takes_nothing(bool idle) {
  const std::uint64_t taken = records_.popped();
  if (idle || taken != taken_) took_ = Clock::now();
  taken_ = taken;
  return Clock::now() - took_ > std::chrono::duration<double>(kSidePatienceS);
}

bool RecorderProcess::hangs() {
  const auto full = [](const auto& ring) {
    return ring.pushed() - ring.popped() >= ring.capacity();
  };
  return takes_nothing(!full(records_) && !full(events_));
}

std::optional<Bytes> RecorderProcess::ask(const Packer& question) {
  if (!process_.ended().empty() || !process_.link().send(question.bytes())) return std::nullopt;
  took_ = Clock::now();
  while (!process_.link().gone() && !takes_nothing(false)) {
    if (std::optional<Bytes> answer = process_.link().receive(kLookS)) return answer;
  }
  process_.kill();
  return std::nullopt;
}

std::optional<Recorded> RecorderProcess::stop(std::span<const Fault> faults) {
  Packer question;
  question.put(std::vector<Fault>(faults.begin(), faults.end()));
  const std::optional<Bytes> answer = ask(question);
  if (!answer) return std::nullopt;
  try {
    Recorded recorded = recorded_of(*answer);
    if (sane(recorded, needles_, targets_)) return recorded;
  } catch (const PackingError&) {
  }
  process_.kill();
  return std::nullopt;
}

Completed RecorderProcess::finish(std::uint64_t state_hash, std::uint64_t lost_records,
                                  std::span<const Mark> marks) {
  Packer question;
  question.put(state_hash).put(lost_records);
  question.put_each(std::vector<Mark>(marks.begin(), marks.end()),
                    [](Packer& to, const Mark& mark) { to.put(mark.tick).put(mark.text); });
  const std::optional<Bytes> answer = ask(question);
  if (!answer) return {"", "the recording was not completed: its recorder has ended"};
  try {
    Unpacker unpacker(*answer);
    Completed completed;
    unpacker.get(completed.recording);
    unpacker.get(completed.error);
    return completed;
  } catch (const PackingError&) {
    return {"", "the recording was not completed: the answer of its recorder cannot be read"};
  }
}

// ---- in the process beside

namespace {

// nullopt: the loop's process has gone.
std::optional<Bytes> next_order(const SideSeat& seat, const Recorder& recorder) {
  while (!seat.link.gone()) {
    if (std::optional<Bytes> order = seat.link.receive(kLookS)) return order;
    if (recorder.failed()) throw std::runtime_error(recorder.error());
  }
  return std::nullopt;
}

Recorded outcome(const RecorderTask& task, const Recorder& recorder, const FlightRecorder& flight,
                 const Scorer& scorer) {
  Recorded recorded;
  const Config& config = task.info.config;
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    recorded.stages.push_back(find_stages(recorder.track(i), static_cast<double>(config.period_s),
                                          config.needle[i].unit_m));
  }
  recorded.events = recorder.events();
  recorded.score = scorer.score();
  recorded.flights = flight.flights();
  recorded.flight_error = flight.error();
  recorded.error = recorder.error();
  recorded.forgot = recorder.forgot();
  return recorded;
}

// The last words about a recording.
Completed complete(RecordingWriter& writer, const Bytes& order) {
  Unpacker unpacker(order);
  std::uint64_t state_hash = 0, lost_records = 0;
  std::vector<Mark> marks;
  unpacker.get(state_hash);
  unpacker.get(lost_records);
  unpacker.get_each(marks, [](Unpacker& from, Mark& mark) {
    from.get(mark.tick);
    from.get(mark.text);
  });
  try {
    return {writer.finish(state_hash, lost_records, marks), ""};
  } catch (const RecordingError& error) {
    return {"", error.what()};
  }
}

struct Desk {
  RecorderTask task;
  std::unique_ptr<RecordingWriter> writer;
  FlightRecorder flight;
  std::span<const Course> courses;
  Scorer scorer;

  explicit Desk(RecorderTask given)
      : task(std::move(given)),
        writer(task.recording.empty()
                   ? nullptr
                   : std::make_unique<RecordingWriter>(task.recording, task.info, task.name)),
        flight(task.flight, task.info),
        courses(std::span(task.info.course).first(task.info.config.needle_count)),
        scorer(task.targets, courses, static_cast<double>(task.info.config.period_s)) {}
};

// False: the loop's process has gone.
bool serve(SideSeat& seat, Desk& desk, Recorder& recorder) {
  const std::optional<Bytes> last = next_order(seat, recorder);
  std::vector<Fault> faults;
  if (last) Unpacker(*last).get(faults);
  recorder.stop(faults);
  if (recorder.failed()) throw std::runtime_error(recorder.error());
  if (!last) return false;
  (void)seat.link.send(packed(outcome(desk.task, recorder, desk.flight, desk.scorer)));
  if (desk.writer == nullptr || !recorder.error().empty()) {
    (void)next_order(seat, recorder);
    return true;
  }
  const std::optional<Bytes> order = next_order(seat, recorder);
  if (!order) return false;
  Packer said;
  Completed completed;
  if (recorder.ticks() > 0) completed = complete(*desk.writer, *order);
  desk.writer.reset();
  said.put(completed.recording).put(completed.error);
  (void)seat.link.send(said.bytes());
  return true;
}

}  // namespace

void recorder_beside(SideSeat& seat) {
  Desk desk(task_of(seat.greeting));
  Ring<TickRecord> records(seat.shared.subspan(kRecordsAt, kRecordsBytes));
  Ring<Event> events(seat.shared.subspan(kEventsAt, kEventsBytes));
  RecordingWriter* writer = desk.writer.get();
  Kept& kept = kept_in(seat.shared);
  const auto keep = [&kept](std::uint64_t ticks) {
    kept.ticks.store(ticks, std::memory_order_relaxed);
  };
  const Recorder::Tap note = [&](std::span<const TickRecord>, std::span<const Event>) {
    if (writer != nullptr) keep(writer->ticks_kept());
  };
  // Whatever happens, what has been recorded stays.
  try {
    Recorder recorder(records, events, writer, desk.courses, &desk.flight, &desk.scorer, note);
    seat.ready();
    if (!serve(seat, desk, recorder) && writer != nullptr) keep(writer->leave());
  } catch (...) {
    if (writer != nullptr) keep(writer->leave());
    throw;
  }
}

}  // namespace stylet::hal
