// SPDX-License-Identifier: Apache-2.0
#include "state/layout.h"

#include <cstring>

namespace stylet {
namespace {

template <typename Bytes>
constexpr Bytes round_block(Bytes bytes) {
  return (bytes + kBlockAlignment - 1) / kBlockAlignment * kBlockAlignment;
}

// In 64 bits, where no sum of counts below 2^32 wraps; what a pointer cannot span is refused.
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
  view.name = reinterpret_cast<type*>(block); \
  block += round_block(sizeof(type) * static_cast<std::size_t>(count));
ModelView model_view(std::byte* block, const Counts& c) {
  ModelView view = {};
  STYLET_MODEL_FIELDS(STYLET_FIELD_PLACE)
  return view;
}
StateView state_view(std::byte* block, const Counts& c) {
  StateView view = {};
  STYLET_STATE_FIELDS(STYLET_FIELD_PLACE)
  view.tip = view.shaft + kMaxConstraintParticles;
  return view;
}
ScratchView scratch_view(std::byte* block, const Counts& c) {
  ScratchView view = {};
  STYLET_SCRATCH_FIELDS(STYLET_FIELD_PLACE)
  return view;
}
#undef STYLET_FIELD_PLACE

View view_of(const Kernel& kernel) {
  const Counts& c = counts_of(kernel);
  return {reinterpret_cast<const ModelHead*>(kernel.model)->organ, model_view(kernel.model, c),
          state_view(kernel.state, c), scratch_view(kernel.scratch, c), 0};
}

View needle_view(const View& view, std::uint32_t needle) {
  View out = view;
  const std::size_t n = needle;
  out.needle = needle;
  out.model.rod += n;
  out.state.needle += n;
  out.state.shaft += n * kNeedleParticles;
  out.state.tip = out.state.shaft + kMaxConstraintParticles;
  out.state.rod_shape += n;
  out.state.node += n * (kMaxRods + 1);
  out.state.touch += n * kMaxTouches;
  return out;
}

// Padding inside a struct is zero from reset on and never written apart from its fields, so bytes
// are as good as fields here; a test fills the block with a pattern before create to prove it.
std::uint64_t fnv1a(std::uint64_t hash, const void* data, std::size_t bytes) {
  const auto* p = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ p[i]) * 0x100000001b3ULL;
  return hash;
}

std::uint64_t hash_state(const Kernel& kernel) {
  const Counts& c = counts_of(kernel);
  const StateView view = state_view(kernel.state, c);
  std::uint64_t hash = 0xcbf29ce484222325ULL;
#define STYLET_FIELD_HASH(name, type, count) \
  hash = fnv1a(hash, view.name, sizeof(type) * static_cast<std::size_t>(count));
  STYLET_STATE_FIELDS(STYLET_FIELD_HASH)
#undef STYLET_FIELD_HASH
  return hash;
}

Difference first_difference(const Kernel& a, const Kernel& b) {
  const Counts& c = counts_of(a);
  const StateView va = state_view(a.state, c);
  const StateView vb = state_view(b.state, c);
#define STYLET_FIELD_COMPARE(name, type, count)                                      \
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {                \
    if (std::memcmp(&va.name[i], &vb.name[i], sizeof(type)) != 0) return {#name, i}; \
  }
  STYLET_STATE_FIELDS(STYLET_FIELD_COMPARE)
#undef STYLET_FIELD_COMPARE
  return {nullptr, 0};
}

}  // namespace stylet
