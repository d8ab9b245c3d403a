// SPDX-License-Identifier: Apache-2.0
#include "state/layout.h"

#include <cstring>

namespace stylet {
namespace {

template <typename Bytes>
constexpr Bytes round_block(Bytes bytes) {
  return (bytes + kBlockAlignment - 1) / kBlockAlignment * kBlockAlignment;
}

// In 64 bits, where sums of counts below 2^32 cannot wrap; sizes that no pointer spans are refused.
#define STYLET_FIELD_SIZE(name, type, count) \
  bytes += round_block(sizeof(type) * static_cast<std::uint64_t>(count));
std::uint64_t model_bytes(const Counts& c) {
  std::uint64_t bytes = 0;
  STYLET_MODEL_FIELDS(STYLET_FIELD_SIZE)
  return bytes;
}
std::uint64_t state_bytes(const Counts& c) {
  std::uint64_t bytes = 0;
  STYLET_STATE_FIELDS(STYLET_FIELD_SIZE)
  return bytes;
}
std::uint64_t scratch_bytes(const Counts& c) {
  std::uint64_t bytes = 0;
  STYLET_SCRATCH_FIELDS(STYLET_FIELD_SIZE)
  return bytes;
}
#undef STYLET_FIELD_SIZE

}  // namespace

Status block_sizes(const Counts& counts, Sizes& sizes_out) {
  const std::uint64_t bytes[] = {model_bytes(counts), state_bytes(counts), scratch_bytes(counts)};
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

#define STYLET_FIELD_PLACE(name, type, count) \
  out.name = reinterpret_cast<type*>(block);  \
  block += round_block(sizeof(type) * static_cast<std::size_t>(count));
Model model_of(std::byte* block, const Counts& c) {
  Model out = {};
  STYLET_MODEL_FIELDS(STYLET_FIELD_PLACE)
  return out;
}
State state_of(std::byte* block, const Counts& c) {
  State out = {};
  STYLET_STATE_FIELDS(STYLET_FIELD_PLACE)
  out.tip = out.shaft + kMaxConstraintParticles;
  return out;
}
Scratch scratch_of(std::byte* block, const Counts& c) {
  Scratch out = {};
  STYLET_SCRATCH_FIELDS(STYLET_FIELD_PLACE)
  return out;
}
#undef STYLET_FIELD_PLACE

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

std::uint64_t hash_state(const Kernel& kernel) {
  const Counts& c = counts_of(kernel);
  const State view = state_of(kernel.state, c);
  std::uint64_t hash = 0xcbf29ce484222325ULL;
#define STYLET_FIELD_HASH(name, type, count) \
  hash = fnv1a(hash, view.name, sizeof(type) * static_cast<std::size_t>(count));
  STYLET_STATE_FIELDS(STYLET_FIELD_HASH)
#undef STYLET_FIELD_HASH
  return hash;
}

namespace {

// Of two arrays of as many elements: the first that differs, or `count`. (Called for each field: as
// a loop in each it took 2 kB of a page's library.)
std::size_t first_unequal(const void* a, const void* b, std::size_t bytes, std::size_t count) {
  const auto *p = static_cast<const std::byte*>(a), *q = static_cast<const std::byte*>(b);
  for (std::size_t i = 0; i < count; ++i) {
    if (std::memcmp(p + i * bytes, q + i * bytes, bytes) != 0) return i;
  }
  return count;
}

}  // namespace

Difference first_difference(const Kernel& a, const Kernel& b) {
  const Counts& c = counts_of(a);
  const State va = state_of(a.state, c);
  const State vb = state_of(b.state, c);
#define STYLET_FIELD_COMPARE(name, type, count)                \
  if (const auto most = static_cast<std::size_t>(count),       \
      i = first_unequal(va.name, vb.name, sizeof(type), most); \
      i < most) {                                              \
    return {#name, i};                                         \
  }
  STYLET_STATE_FIELDS(STYLET_FIELD_COMPARE)
#undef STYLET_FIELD_COMPARE
  return {nullptr, 0};
}

}  // namespace stylet
