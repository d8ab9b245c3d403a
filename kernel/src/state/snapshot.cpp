// SPDX-License-Identifier: Apache-2.0
#include "state/snapshot.h"

#include <cstring>
#include <string_view>

#include "base/math.h"

namespace stylet {
namespace {

constexpr std::uint64_t kMagic = 0x32504E5354595453ULL;  // "STYTSNP2"
constexpr std::uint64_t kHashStart = 0xcbf29ce484222325ULL, kHashPrime = 0x100000001b3ULL;

// Hash of names and sizes of all fields: it changes with every field that is added, removed or
// resized. If only the meaning of a field changes, the magic number must change.
consteval std::uint64_t layout_hash() {
  std::uint64_t hash = kHashStart;
  const auto add = [&](std::string_view name, std::size_t size) {
    for (const char letter : name) {
      hash = (hash ^ static_cast<unsigned char>(letter)) * kHashPrime;
    }
    hash = (hash ^ size) * kHashPrime;
  };
#define STYLET_FIELD_LAYOUT(name, type, count) add(#name, sizeof(type));
  STYLET_STATE_FIELDS(STYLET_FIELD_LAYOUT)
#undef STYLET_FIELD_LAYOUT
  return hash;
}

// Eight bytes at a time: one at a time, a snapshot of 100 000 voxels took seven times as long.
// Blocks are whole lines.
std::uint64_t checksum(const std::byte* bytes, std::size_t count) {
  static_assert(kBlockAlignment % sizeof(std::uint64_t) == 0);
  std::uint64_t sum = kHashStart;
  for (std::size_t i = 0; i < count; i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, sizeof word);
    sum = (sum ^ word) * kHashPrime;
    sum ^= sum >> 29U;  // a product carries only upwards
  }
  return sum;
}

// What the numbers of a state are checked against. A kernel that has latched a fault computes
// nothing until reset. Its numbers may be anything, but not its indices: reports still use them.
struct Limits {
  const Model& model;
  bool faulted;

  const ModelHead& head() const { return *model.head; }
  bool number(float v) const { return faulted || (v >= -kMaxRestored && v <= kMaxRestored); }
  bool number(double v) const {
    constexpr double kMost = static_cast<double>(kMaxRestored);
    return faulted || (v >= -kMost && v <= kMost);
  }
  bool number(Vec3 v) const { return number(v.x) && number(v.y) && number(v.z); }
  bool number(Vec3d v) const { return number(v.x) && number(v.y) && number(v.z); }
  bool number(Quat q) const { return number(q.w) && number(Vec3{q.x, q.y, q.z}); }
  bool no_less(float v, float least) const { return number(v) && (faulted || v >= least); }
  // Sums that should end at 0 or 1 end near it: a spring's relaxing part at -2e-7.
  bool part(float v) const { return faulted || (v >= -kRounding && v <= 1 + kRounding); }
  bool part(double v) const { return faulted || (v >= 0 && v <= 1); }
  bool one(double v) const { return faulted || (v >= 1 - kLength && v <= 1 + kLength); }
  bool material(std::uint32_t v) const { return v < head().material_count; }
  bool layer(std::uint32_t v) const { return v == kNoLayer || material(v); }

  static constexpr float kRounding = 1e-4F;
  static constexpr double kLength = 1e-3;  // how far a tick's units differ
};

// Overloads: an element of a field, and its index in the field.

bool sound(const Limits& is, float v, std::size_t) {
  return is.number(v);
}

bool sound(const Limits& is, const Vec3& v, std::size_t) {
  return is.number(v);
}

bool sound(const Limits& is, const StateHead& s, std::size_t) {
  return s.latched_fault <= 1 && s.track_count <= kMaxTracks && s.track_next < kMaxTracks &&
         is.no_less(s.max_displacement_m, 0) && is.part(s.coupling_shortfall) &&
         s.coupled_max <= kMaxCoupledVoxels * is.head().counts.needles &&
         s.track_max <= kMaxTracks && is.number(s.work_by_hand_j) && is.number(s.friction_j) &&
         is.number(s.cutting_j) && is.number(s.relaxation_j) && is.number(s.obstacles_j);
}

bool sound(const Limits& is, const Pose& handle) {
  const Quat q = handle.rotation;
  const float length2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  return is.number(handle.position_m) && is.number(q) && is.one(static_cast<double>(length2));
}

// A needle is inside exactly if it has shaft particles, and its tip holds tissue in every phase
// except the free one.
bool sound_phase(const NeedleState& own) {
  const bool inside = own.phase == Phase::kInserted || own.phase == Phase::kRetracting;
  return own.phase <= Phase::kRetracting && own.tip_alive <= 1 &&
         (own.phase == Phase::kFree) == (own.tip_alive == 0) && inside == (own.shaft_count > 0);
}

bool sound(const Limits& is, const NeedleState& own, std::size_t) {
  const float twist = own.twist_rad / kMaxTwistRad;
  return sound(is, own.handle) && is.number(own.base_m) && own.handle_known <= 1 &&
         sound_phase(own) && is.layer(own.layer) && is.layer(own.spring_layer) &&
         is.layer(own.layer_before) && own.shaft_count <= kMaxConstraintParticles &&
         own.shaft_max <= kMaxConstraintParticles && own.shaft_max >= own.shaft_count &&
         own.leaving <= 1 && (own.track_current == kNoTrack || own.track_current < kMaxTracks) &&
         is.number(own.layer_track_m) && is.number(own.press_m_per_s) &&
         is.number(own.track_end_m) && is.number(own.drop_track_m) &&
         is.number(own.tissue_track_m) && is.part(twist * twist) &&
         is.no_less(own.twist_nm_per_rad, 0) && is.number(own.cut) && is.number(own.moved_m) &&
         is.number(own.last_force_n) && is.number(own.last_torque_nm) &&
         own.touch_count <= kMaxTouches && own.touch_max <= kMaxTouches &&
         own.touch_max >= own.touch_count;
}

// The voxel exists: `slot` lies in `row`, and is not a hole in it.
bool sound(const Limits& is, const Support& support, bool used) {
  const Counts& counts = is.head().counts;
  if (support.slot >= counts.slots || support.row >= counts.rows) return false;
  if (used) {
    const Row& row = is.model.row[support.row];
    if (support.slot - row.slot >= row.count || !(is.model.slot_k[support.slot] > 0)) return false;
    // The next match starts from it.
    const Quat& q = support.turn;
    const float length2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    if (!is.faulted && !is.one(static_cast<double>(length2))) return false;
  }
  return is.part(support.weight) && is.number(support.offset_m) && is.number(support.goal_m) &&
         is.number(support.turn);
}

bool sound(const Limits& is, const Friction& f) {
  for (const auto number : kFrictionNumbers) {
    if (!is.no_less(f.*number, 0)) return false;
  }
  return true;
}

bool sound_shares(const Limits& is, const Particle& p) {
  if (p.support_count > kSupportsPerParticle) return false;
  float sum = p.support_count > 0 ? 0.0F : 1.0F;
  for (std::uint32_t i = 0; i < kSupportsPerParticle; ++i) {
    const bool used = i < p.support_count;
    if (!sound(is, p.support[i], used)) return false;
    if (used) sum += p.support[i].weight;
  }
  const bool springs = p.stiffness_n_per_m > 0 && p.full_stiffness_n_per_m > 0;
  return is.one(static_cast<double>(sum)) && (p.support_count == 0 || is.faulted || springs);
}

// Of the shaft; the last one is the tip.
bool sound(const Limits& is, const Particle& p, std::size_t) {
  return is.number(p.rest_m) && is.number(p.position_m) && is.number(p.memory_m) &&
         is.number(p.memory_n) && is.number(p.axial_way_m) && is.number(p.slack_m) &&
         is.number(p.force_n) && is.number(p.track_m) && is.number(p.arc_m) &&
         is.no_less(p.stiffness_n_per_m, 0) && is.no_less(p.full_stiffness_n_per_m, 0) &&
         is.no_less(p.tissue_compliance, 0) && is.part(p.relaxing_fraction) &&
         is.part(p.memory_keep) && is.part(p.memory_spread) && is.part(p.axial_fraction) &&
         is.number(p.slip_m_per_s) && sound(is, p.friction) && is.number(p.friction_length_m) &&
         is.number(p.slip_m) && is.material(p.material) && sound_shares(is, p);
}

bool sound(const Limits& is, const RodShape& shape, std::size_t needle) {
  for (std::uint32_t j = 0; j < kMaxRods; ++j) {
    const Vec3d t = shape.direction[j];
    if (!is.number(t) || (j < is.model.rod[needle].rods && !is.one(dot(t, t)))) return false;
  }
  return is.part(shape.compression_fraction) && is.part(shape.step_length);
}

bool sound(const Limits& is, const ObstacleContact& c) {
  return is.number(c.normal) && is.number(c.bristle_m) && is.number(c.at_m) && is.part(c.place) &&
         is.number(c.limit_n);
}

bool sound(const Limits& is, const Touch& t, std::size_t index) {
  bool good = t.obstacle < kMaxObstacles && t.rod < is.model.rod[index / kMaxTouches].rods &&
              sound(is, t.contact) && is.number(t.at_m) && is.number(t.force_n) &&
              is.number(t.arc_m) && is.number(t.normal) && is.number(t.depth_m);
  for (const auto& row : t.stiffness_n_per_m.m) {
    good = good && is.number(row[0]) && is.number(row[1]) && is.number(row[2]);
  }
  return good;
}

// No pressure is below that of nothing, and what is in the bore resists.
bool sound(const Limits& is, const FluidState& s, std::size_t) {
  const double thinnest = s.filled > 0 ? kThinnestPaS / 2 : 0;  // a mean may be rounded
  return is.number(s.hub_pa) && (is.faulted || s.hub_pa >= kLeastHubPa) &&
         is.number(s.injected_m3) && is.number(s.swept_m3) && is.number(s.flow_m3_per_s) &&
         is.part(s.filled) && is.number(s.entered_pa_s) &&
         (is.faulted || s.entered_pa_s >= thinnest) && is.number(s.plunger_n) && s.resisted <= 1 &&
         s.shown <= 1;
}

bool sound(const Limits& is, const Track& t, std::size_t) {
  return is.number(t.entry_rest_m) && is.number(t.direction_rest) && is.number(t.length_m);
}

bool sound(const Limits& is, const MembraneState& m, std::size_t) {
  return is.number(m.clear_m) && m.held <= is.head().material_count && is.number(m.held_at_m) &&
         is.number(m.held_normal);
}

bool sound(const Limits& is, const MembraneHoles& holes, std::size_t) {
  bool good = holes.count <= kMaxOpenings && holes.next < kMaxOpenings;
  for (const MembraneOpening& hole : holes.opening) {
    good = good && is.number(hole.at_m) && is.number(hole.normal) &&
           (hole.material == 0 || is.material(hole.material));
  }
  return good;
}

bool sound(const Limits& is, const SlideState& s, std::size_t) {
  return is.number(s.place) && is.number(s.stretch_m) && is.no_less(s.stiffness_n_per_m, 0) &&
         s.ground < is.head().counts.grounds;
}

bool sound(const Limits& is, const SlideBooks& books, std::size_t) {
  return is.number(books.friction_j);
}

bool sound(const Limits& is, const Event& e, std::size_t) {
  return e.kind <= EventKind::kLossOfResistance && is.layer(e.layer) && is.number(e.depth_m) &&
         is.number(e.force_n) && e.needle < is.head().counts.needles && e.reserved == 0;
}

// An element of a field, at any address.
template <typename Type>
Type element(const std::byte* field, std::size_t index) {
  Type out;
  std::memcpy(&out, field + index * sizeof(Type), sizeof(Type));
  return out;
}

template <typename Type>
bool all_sound(const Limits& is, const std::byte* field, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!sound(is, element<Type>(field, i), i)) return false;
  }
  return true;
}

// The check of each field.
#define STYLET_FIELD_SOUND(name, type, count) all_sound<type>,
constexpr bool (*kAllSound[])(const Limits&, const std::byte*,
                              std::size_t) = {STYLET_STATE_FIELDS(STYLET_FIELD_SOUND)};
#undef STYLET_FIELD_SOUND

}  // namespace

std::uint64_t config_hash(const Kernel& kernel) {
  const View view = view_of(kernel);
  const std::uint64_t hash = fnv1a(kHashStart, &view.model.head->config, sizeof(Config));
  return fnv1a(hash, view.model.obstacle, sizeof(Obstacle) * kMaxObstacles);
}

SnapshotHeader snapshot_header(const Kernel& kernel, const std::byte* state) {
  const auto& head = *reinterpret_cast<const ModelHead*>(kernel.model);
  return {kMagic,
          layout_hash(),
          head.organ_hash,
          config_hash(kernel),
          kernel.sizes.state_bytes,
          checksum(state, kernel.sizes.state_bytes)};
}

bool state_sound(const Kernel& kernel, const std::byte* state) {
  const View view = view_of(kernel);
  const Counts& c = view.model.head->counts;
  const auto theirs = [&](const auto& field) {
    return state + (reinterpret_cast<const std::byte*>(&field[0]) - kernel.state);
  };
  const auto head = element<StateHead>(theirs(view.state.head), 0);
  const Limits is = {view.model, head.latched_fault == 1};
  const StateFields fields = fields_of_state(c);
  for (std::size_t i = 0; i < kStateFields; ++i) {
    if (!kAllSound[i](is, state + fields[i].at, fields[i].count)) return false;
  }
  for (std::uint32_t n = 0; n < c.needles; ++n) {
    const auto own = element<NeedleState>(theirs(view.state.needle), n);
    const std::size_t at = std::size_t{n} * kNeedleParticles + kMaxConstraintParticles;
    const auto tip = element<Particle>(theirs(view.state.shaft), at);
    if (own.phase == Phase::kContact && tip.support_count == 0) return false;
    if (own.track_current != kNoTrack && own.track_current >= head.track_count) return false;
  }
  return true;
}

std::uint64_t state_layout() {
  return layout_hash();
}

std::size_t snapshot_bytes(const Kernel& kernel) {
  return sizeof(SnapshotHeader) + kernel.sizes.state_bytes;
}

Status snapshot(const Kernel& kernel, std::span<std::byte> out) {
  if (out.size() < snapshot_bytes(kernel)) return Status::kMemoryTooSmall;
  const SnapshotHeader header = snapshot_header(kernel, kernel.state);
  std::memcpy(out.data(), &header, sizeof(header));
  std::memcpy(out.data() + sizeof(header), kernel.state, kernel.sizes.state_bytes);
  return Status::kOk;
}

Status restore(Kernel& kernel, std::span<const std::byte> in) {
  if (in.size() < snapshot_bytes(kernel)) return Status::kSnapshotDoesNotMatch;
  const std::byte* const state = in.data() + sizeof(SnapshotHeader);
  const SnapshotHeader mine = snapshot_header(kernel, state);
  constexpr std::size_t kOfKernel = offsetof(SnapshotHeader, checksum);
  if (std::memcmp(in.data(), &mine, kOfKernel) != 0) return Status::kSnapshotDoesNotMatch;
  if (std::memcmp(in.data(), &mine, sizeof mine) != 0 || !state_sound(kernel, state)) {
    return Status::kSnapshotDamaged;
  }
  std::memcpy(kernel.state, state, kernel.sizes.state_bytes);
  return Status::kOk;
}

}  // namespace stylet
