// SPDX-License-Identifier: Apache-2.0
// Any sequence of poses for one to four needles, rigid or not, with obstacles and breathing: every
// promise holds after every tick, no tick costs more than the worst case of tests/rt, and the same
// inputs give the same state whatever the scratch memory contained.
//
// The first bytes choose what is simulated. Then each operation is a byte (needle, kind, repeats)
// and its numbers. Small moves reach the tissue and its rules; raw floats are what a broken device
// sends.
#include <vector>

#include "promises.h"
#include "session.h"
#include "state/attachment.h"
#include "target.h"
#include "tick_work.h"

namespace stylet::test {
namespace {

constexpr int kMostTicks = 300;
constexpr float kStepM = 0.1e-3F;

const Organ& block() {
  static const std::unique_ptr<OpenOrgan> organ = block_organ(4, 4, 4);
  return organ->organ;
}

Config config_from(Bytes& bytes) {
  const std::uint8_t kind = bytes.byte(), tip = bytes.byte();
  Config config;
  config.mode = (kind & 1U) != 0 ? Mode::kPaper : Mode::kPhysical;
  config.substeps = 1 + ((kind >> 1U) & 3U);
  config.inertia = (kind & 128U) != 0 ? Inertia::kTrueMass : Inertia::kAddedMass;
  config.needle_count = 1 + ((kind >> 3U) & 3U);
  if ((kind & 32U) != 0) config.breathing = {{1e-3F, 0, 3e-3F}, 1};
  for (NeedleConfig& needle : config.needle) {
    needle.length_m = 0.1F;
    needle.unit_m = (kind & 64U) != 0 ? 1e-3F : 5e-3F;
    if ((tip & 1U) != 0) needle.bending_nm2 = (tip & 2U) != 0 ? 2e-4F : 2e-2F;
    needle.rods = (tip & 4U) != 0 ? 8 : 32;
    if ((tip & 8U) != 0) needle.bevel_per_m = 20;
    if ((tip & 4U) != 0) needle.torsion_nm2 = 1e-4F;
    if ((tip & 32U) != 0) {
      needle.tip_half_angle_rad = (tip & 64U) != 0 ? kMinTipHalfAngleRad : kMaxTipHalfAngleRad;
    }
    if ((tip & 128U) != 0) needle.hub = (tip & 64U) != 0 ? Hub::kSyringe : Hub::kOpen;
    if ((tip & 16U) != 0) {
      needle.bent_length_m = 0.02F;
      needle.bent_angle_rad = 0.3F;
    }
  }
  return config;
}

std::vector<ObstacleConfig> obstacles_from(Bytes& bytes, const Config& config) {
  std::vector<ObstacleConfig> obstacles(bytes.byte() % 4U);
  const Vec3 entry = block_script(block(), config).entry_m;
  for (ObstacleConfig& each : obstacles) {
    const std::uint8_t shape = bytes.byte();
    if ((shape & 1U) != 0) {
      make_sphere(each, 1e-3F * static_cast<float>(1 + (shape >> 4U)));
    } else {
      make_box(each, {3e-3F, 1e-3F * static_cast<float>(1 + (shape >> 4U)), 2e-3F});
    }
    each.pose.position_m = entry + 0.2e-3F * Vec3{bytes.small(), bytes.small(), bytes.small()};
    each.stiffness_n_per_m = (shape & 2U) != 0 ? 1e5F : 2e3F;
    each.largest_force_n = 20;
    each.friction = (shape & 4U) != 0 ? 0.5F : 0;
  }
  return obstacles;
}

// A needle's hand between operations.
struct Hand {
  Input input;
  Vec3 tip_m;
};

Hand start_hand(const Config& config, std::uint32_t needle) {
  Vec3 tip = block_script(block(), config).entry_m;
  tip.x += 4e-3F * (static_cast<float>(needle) - 1.5F);
  tip.z += 1e-3F;
  return {{{tip + Vec3{0, 0, config.needle[0].length_m}, {1, 0, 0, 0}}, 1}, tip};
}

float& field_of(Pose& pose, std::uint32_t index) {
  float* fields[7] = {&pose.position_m.x, &pose.position_m.y, &pose.position_m.z, &pose.rotation.w,
                      &pose.rotation.x,   &pose.rotation.y,   &pose.rotation.z};
  return *fields[index % 7];
}

// What an operation does to its hand in each of its ticks.
struct Operation {
  std::uint32_t needle, kind, repeats;
  Vec3 step;
  float value;
  std::uint32_t field;
};

Operation operation_from(Bytes& bytes) {
  const std::uint8_t code = bytes.byte();
  Operation op = {code & 3U, (code >> 2U) & 7U, 1U + (code >> 5U), {}, 0, 0};
  switch (op.kind) {
    case 0:
      op.step.z = -kStepM * bytes.small() / 16;
      op.repeats *= 4;
      break;
    case 1:
      op.step = 0.25F * kStepM * Vec3{bytes.small(), bytes.small(), 0};
      break;
    case 2:
    case 3:
      op.step = 1e-4F * Vec3{bytes.small(), bytes.small(), bytes.small()};
      break;
    case 4:
      op.field = bytes.byte();
      op.value = bytes.any_float();
      break;
    case 7:
      op.repeats *= 16;
      break;
    default:
      break;
  }
  return op;
}

// The input of one tick: the hand moves (0, 1), turns (2, 3), sends a wrong number (4) or nothing
// (5), jumps back to its start (6) or rests (7).
Input apply(const Operation& op, const Config& config, Hand& hand) {
  Input sent = hand.input;
  Pose& handle = hand.input.handle;
  switch (op.kind) {
    case 0:
    case 1:
      handle.position_m = handle.position_m + op.step;
      return hand.input;
    case 2:
    case 3:
      handle.rotation.x += op.step.x;
      handle.rotation.y += op.step.y;
      handle.rotation.z += 10 * op.step.z;
      return hand.input;
    case 4:
      (op.field == 255 ? sent.plunger_n : field_of(sent.handle, op.field)) = op.value;
      return sent;
    case 5:
      sent.valid = 0;
      return sent;
    case 6:
      hand = start_hand(config, op.needle);
      return hand.input;
    default:  // a long rest presses the plunger, a short one draws it
      hand.input.plunger_n = 3 * static_cast<float>(op.repeats / 16U) - 12;
      return sent;
  }
}

void check(const Kernel& kernel, std::span<const Output> outputs, TickWork& work) {
  const char* broken = broken_promise(kernel, outputs);
  promise(broken == nullptr, broken);
  const View view = view_of(kernel);
  count_work(kernel, attachment_shift(view.model, view.state), work);
  promise(bound_of(work.amount) <= kDearestTick, "a tick may cost more than the worst case");
}

std::uint64_t run_all(Bytes bytes, std::byte scratch_fill) {
  const Config config = config_from(bytes);
  Session session = make_session(block(), config);
  promise(set_obstacles(session.kernel, obstacles_from(bytes, config)) == Status::kOk,
          "a good obstacle is refused");
  const std::uint32_t needles = config.needle_count;
  Hand hands[kMaxNeedles];
  Input inputs[kMaxNeedles];
  Output outputs[kMaxNeedles];
  TickWork work;
  for (std::uint32_t i = 0; i < kMaxNeedles; ++i) {
    hands[i] = start_hand(config, i);
    inputs[i] = hands[i].input;
  }
  for (int ticks = 0; !bytes.empty() && ticks < kMostTicks;) {
    const Operation op = operation_from(bytes);
    const std::uint32_t needle = op.needle % needles;
    for (std::uint32_t i = 0; i < op.repeats; ++i, ++ticks) {
      inputs[needle] = apply(op, config, hands[needle]);
      std::fill_n(session.scratch.bytes.get(), session.scratch.size, scratch_fill);
      tick(session.kernel, std::span(inputs).first(needles), std::span(outputs).first(needles));
      check(session.kernel, std::span(outputs).first(needles), work);
      inputs[needle] = hands[needle].input;
    }
  }
  return hash(session.kernel);
}

}  // namespace
}  // namespace stylet::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet::test;
  const Bytes bytes{{data, size}};
  const std::uint64_t first = run_all(bytes, std::byte{0});
  if (size % 4 != 0) return 0;  // only one in four, because it doubles the time
  promise(run_all(bytes, std::byte{0xFF}) == first, "scratch or chance matters");
  return 0;
}
