// SPDX-License-Identifier: Apache-2.0
// Any bytes as a snapshot, with the right header and checksum. They are refused and nothing
// changes; or a hundred ticks with moving hands are finite, or end in a fault without force.
//
// The first byte chooses kernel and moment. Then each change is a field, an element, a word in it,
// and what to write there: any number, or one that is nearly right. The last bytes move the hands.
// (Whole states as bytes would be refused for a wrong number long before a wrong index is met.)
#include <vector>

#include "base/math.h"
#include "session.h"
#include "state/snapshot.h"
#include "target.h"

namespace stylet::test {
namespace {

constexpr int kTicks = 100;
constexpr std::uint32_t kMoments = 4;

const Organ& block() {
  static const std::unique_ptr<OpenOrgan> organ = block_organ(4, 4, 5);
  return organ->organ;
}

// A kernel, and what it was at some moments of an insertion.
struct Kept {
  Session session;
  Script script;
  std::vector<std::vector<std::byte>> moments;
};

Kept keep(Setup setup, std::uint32_t needles) {
  Config config = config_of(setup);
  config.needle_count = needles;
  config.needle[0].rods = 8;
  config.needle[1].torsion_nm2 = 1e-4F;
  Kept kept = {make_session(block(), config), block_script(block(), config), {}};
  promise(set_obstacles(kept.session.kernel, obstacles_of(block(), setup)) == Status::kOk,
          "a good obstacle is refused");
  for (const std::uint64_t at :
       {0U, 530U, 1300U, 2700U}) {  // at rest, in contact, inside, on its way out
    while (stats(kept.session.kernel).ticks < at) {
      const Input input = scripted_input(kept.script, stats(kept.session.kernel).ticks);
      tick(kept.session.kernel, {&input, 1}, {});
    }
    kept.moments.emplace_back(snapshot_bytes(kept.session.kernel));
    promise(snapshot(kept.session.kernel, kept.moments.back()) == Status::kOk, "no snapshot");
  }
  return kept;
}

Kept& kept_of(std::uint8_t kind) {
  static Kept all[] = {keep(Setup::kPhysical, 1), keep(Setup::kElastic, 2), keep(Setup::kPaper, 1),
                       keep(Setup::kAddedMass, 2)};
  return all[kind % std::size(all)];
}

struct Span {
  std::size_t at, size, count;  // in the state block; of an element
};

std::vector<Span> fields_of(const Kernel& kernel) {
  const Counts& c = counts_of(kernel);
  State view = state_of(kernel.state, c);
  std::vector<Span> fields;
#define STYLET_FUZZ_FIELD(name, type, count)                                                       \
  fields.push_back(                                                                                \
      {static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&view.name[0]) - kernel.state), \
       sizeof(type), static_cast<std::size_t>(count)});
  STYLET_STATE_FIELDS(STYLET_FUZZ_FIELD)
#undef STYLET_FUZZ_FIELD
  std::erase_if(fields, [](const Span& field) { return field.count == 0; });
  return fields;
}

// Changes one word of one element: to anything, to a little more or less than it was, or to the
// largest number there is.
void change(Bytes& bytes, const std::vector<Span>& fields, std::byte* state) {
  const Span& field = fields[bytes.byte() % fields.size()];
  const std::size_t element = (bytes.byte() + 256U * bytes.byte()) % field.count;
  const std::size_t word = (bytes.byte() + 256U * bytes.byte()) % (field.size / 4);
  std::byte* const at = state + field.at + element * field.size + 4 * word;
  const std::uint8_t how = bytes.byte();
  std::uint32_t value = 0;
  std::memcpy(&value, at, sizeof value);
  float number = 0;
  std::memcpy(&number, at, sizeof number);
  switch (how & 3U) {
    case 0:
      number = bytes.any_float();
      std::memcpy(at, &number, sizeof number);
      return;
    case 1:
      value += how & 4U ? how >> 3U : 0U - (how >> 3U);
      std::memcpy(at, &value, sizeof value);
      return;
    case 2:
      number = (how & 4U ? 1 : -1) * kMaxRestored / static_cast<float>(1U << (how >> 3U));
      std::memcpy(at, &number, sizeof number);
      return;
    default:
      number *= (how & 4U ? 1.0F : -1.0F) * (1 + static_cast<float>(how >> 3U));
      std::memcpy(at, &number, sizeof number);
      return;
  }
}

void run_on(Kept& kept, Bytes& bytes) {
  const std::uint32_t needles = view_of(kept.session.kernel).model.head->counts.needles;
  Input inputs[kMaxNeedles] = {};
  Output outputs[kMaxNeedles] = {};
  const std::uint64_t from = 13U * bytes.byte();
  const Vec3 step = 1e-4F * Vec3{bytes.small(), bytes.small(), bytes.small()};
  for (std::uint64_t i = 0; i < kTicks; ++i) {
    for (std::uint32_t n = 0; n < needles; ++n) {
      inputs[n] = scripted_input(kept.script, from + i);
      Vec3& place = inputs[n].handle.position_m;
      place = place + static_cast<float>(n * i) * step;
    }
    tick(kept.session.kernel, std::span(inputs).first(needles), std::span(outputs).first(needles));
    for (const Output& out : std::span(outputs).first(needles)) {
      promise(is_finite(out.force_n) && is_finite(out.torque_nm), "a force that is not finite");
      const bool fault = (out.flags & kFlagFault) != 0;
      promise(!fault || norm(out.force_n) + norm(out.torque_nm) == 0, "a fault with a force");
    }
  }
}

// Functions that may be called between ticks use indices, too.
void report(const Kept& kept) {
  std::vector<Vec3> places(block().vertices.size());
  (void)surface(kept.session.kernel, places);
  ConstraintParticle particles[kMaxConstraintParticles + 1];
  (void)constraint_particles(kept.session.kernel, particles);
  ObstacleTouch touches[kMaxTouches];
  (void)obstacle_touches(kept.session.kernel, touches);
  Event happened[kMaxEvents];
  (void)events(kept.session.kernel, happened);
  (void)energy(kept.session.kernel);
  (void)hash(kept.session.kernel);
}

}  // namespace
}  // namespace stylet::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet;
  using namespace stylet::test;
  Bytes bytes{{data, size}};
  Kept& kept = kept_of(bytes.byte());
  Kernel& kernel = kept.session.kernel;
  const std::vector<std::byte>& moment = kept.moments[bytes.byte() % kMoments];
  promise(restore(kernel, moment) == Status::kOk, "what a kernel saved is refused");
  std::vector<std::byte> changed = moment;
  std::byte* const state = changed.data() + sizeof(SnapshotHeader);
  const std::vector<Span> fields = fields_of(kernel);
  const std::uint32_t changes = bytes.byte() % 8U;
  for (std::uint32_t i = 0; i < changes; ++i) change(bytes, fields, state);
  const SnapshotHeader header = snapshot_header(kernel, state);
  std::memcpy(changed.data(), &header, sizeof header);
  const std::uint64_t before = hash(kernel);
  if (restore(kernel, changed) != Status::kOk) {
    promise(hash(kernel) == before, "a refused snapshot changed the state");
    return 0;
  }
  report(kept);
  run_on(kept, bytes);
  report(kept);
  return 0;
}
