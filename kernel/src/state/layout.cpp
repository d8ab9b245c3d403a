// SPDX-License-Identifier: Apache-2.0
#include "state/layout.h"

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace stylet {
namespace {

template <typename Bytes>
constexpr Bytes round_block(Bytes bytes) {
  return (bytes + kBlockAlignment - 1) / kBlockAlignment * kBlockAlignment;
}

// Loops over the tables, not a statement for every field: those took 5 kB of a page's library.
#define STYLET_FIELD_NAME(name, type, count) #name,
constexpr const char* kStateName[] = {STYLET_STATE_FIELDS(STYLET_FIELD_NAME)};
#undef STYLET_FIELD_NAME

// Bytes of an element of each field.
#define STYLET_FIELD_ELEMENT(name, type, count) sizeof(type),
constexpr std::uint32_t kModelElement[] = {STYLET_MODEL_FIELDS(STYLET_FIELD_ELEMENT)};
constexpr std::uint32_t kStateElement[] = {STYLET_STATE_FIELDS(STYLET_FIELD_ELEMENT)};
constexpr std::uint32_t kScratchElement[] = {STYLET_SCRATCH_FIELDS(STYLET_FIELD_ELEMENT)};
#undef STYLET_FIELD_ELEMENT

// The fields of a block: how many elements each has, and how large they are. In 64 bits, where sums
// of counts below 2^32 cannot wrap; sizes that no pointer spans are refused.
template <std::size_t kFields>
struct Fields {
  std::uint64_t count[kFields];
  const std::uint32_t (&element)[kFields];
};
#define STYLET_FIELD_COUNT(name, type, count) static_cast<std::uint64_t>(count),
Fields<kModelFields> model_fields(const Counts& c) {
  return {{STYLET_MODEL_FIELDS(STYLET_FIELD_COUNT)}, kModelElement};
}
Fields<kStateFields> state_fields(const Counts& c) {
  return {{STYLET_STATE_FIELDS(STYLET_FIELD_COUNT)}, kStateElement};
}
Fields<kScratchFields> scratch_fields(const Counts& c) {
  return {{STYLET_SCRATCH_FIELDS(STYLET_FIELD_COUNT)}, kScratchElement};
}
#undef STYLET_FIELD_COUNT

template <std::size_t kFields>
std::uint64_t bytes_of(const Fields<kFields>& fields) {
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < kFields; ++i) {
    bytes += round_block(fields.element[i] * fields.count[i]);
  }
  return bytes;
}

// A view begins with the pointers to its fields, in the order of the table.
static_assert(offsetof(Model, needle_index) == kModelFields * sizeof(std::byte*));
static_assert(offsetof(State, tip) == kStateFields * sizeof(std::byte*));
static_assert(sizeof(Scratch) == kScratchFields * sizeof(std::byte*));
template <typename View, std::size_t kFields>
View view_in(std::byte* block, const Fields<kFields>& fields) {
  static_assert(std::is_trivially_copyable_v<View>);
  View out = {};
  for (std::size_t i = 0; i < kFields; ++i) {
    std::memcpy(reinterpret_cast<std::byte*>(&out) + i * sizeof block, &block, sizeof block);
    block += round_block(fields.element[i] * static_cast<std::size_t>(fields.count[i]));
  }
  return out;
}

}  // namespace

Status block_sizes(const Counts& counts, Sizes& sizes_out) {
  const std::uint64_t bytes[] = {bytes_of(model_fields(counts)), bytes_of(state_fields(counts)),
                                 bytes_of(scratch_fields(counts))};
  for (const std::uint64_t block : bytes) {
    if (block > static_cast<std::uint64_t>(PTRDIFF_MAX)) return Status::kOrganTooLarge;
  }
  sizes_out = {static_cast<std::size_t>(bytes[0]), static_cast<std::size_t>(bytes[1]),
               static_cast<std::size_t>(bytes[2])};
  return Status::kOk;
}

const Counts& counts_of(const Kernel& kernel) {
  return reinterpret_cast<const ModelHead*>(kernel.model)->counts;
}

Model model_of(std::byte* block, const Counts& c) {
  return view_in<Model>(block, model_fields(c));
}
State state_of(std::byte* block, const Counts& c) {
  State out = view_in<State>(block, state_fields(c));
  out.tip = out.shaft + kMaxConstraintParticles;
  return out;
}
Scratch scratch_of(std::byte* block, const Counts& c) {
  return view_in<Scratch>(block, scratch_fields(c));
}

View view_of(const Kernel& kernel) {
  const Counts& c = counts_of(kernel);
  return {model_of(kernel.model, c), state_of(kernel.state, c), scratch_of(kernel.scratch, c)};
}

Model needle_model(const Model& model, std::uint32_t needle) {
  Model out = model;
  const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(needle) - model.needle_index;
  out.rod += n;
  out.forces += n * kMaxMaterials;
  out.bore += n;
  out.opening += n * kMaxMaterials;
  out.needle_index = needle;
  return out;
}

State needle_state(const State& state, std::uint32_t needle) {
  State out = state;
  const std::ptrdiff_t n = static_cast<std::ptrdiff_t>(needle) - state.needle_index;
  out.needle_index = needle;
  out.needle += n;
  out.shaft += n * kNeedleParticles;
  out.tip = out.shaft + kMaxConstraintParticles;
  out.rod_shape += n;
  out.node += n * (kMaxRods + 1);
  out.touch += n * kMaxTouches;
  out.membrane += n;
  out.fluid += n;
  return out;
}

View needle_view(const View& view, std::uint32_t needle) {
  return {needle_model(view.model, needle), needle_state(view.state, needle), view.scratch};
}

// Padding inside a struct is zero from reset on and is written only together with its fields. So
// bytes can be hashed like fields; a test fills the block with a pattern before create to prove it.
std::uint64_t fnv1a(std::uint64_t hash, const void* data, std::size_t bytes) {
  const auto* p = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ p[i]) * 0x100000001b3ULL;
  return hash;
}

StateFields fields_of_state(const Counts& counts) {
  const Fields fields = state_fields(counts);
  StateFields out = {};
  std::size_t at = 0;
  for (std::size_t i = 0; i < kStateFields; ++i) {
    const std::size_t bytes = fields.element[i], count = static_cast<std::size_t>(fields.count[i]);
    out[i] = {kStateName[i], at, bytes, count};
    at += round_block(bytes * count);
  }
  return out;
}

std::uint64_t hash_state(const Kernel& kernel) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const StateField& field : fields_of_state(counts_of(kernel))) {
    hash = fnv1a(hash, kernel.state + field.at, field.element_bytes * field.count);
  }
  return hash;
}

Difference first_difference(const Kernel& a, const Kernel& b) {
  for (const StateField& field : fields_of_state(counts_of(a))) {
    for (std::size_t i = 0; i < field.count; ++i) {
      const std::size_t at = field.at + i * field.element_bytes;
      if (std::memcmp(a.state + at, b.state + at, field.element_bytes) != 0) return {field.name, i};
    }
  }
  return {nullptr, 0};
}

}  // namespace stylet
