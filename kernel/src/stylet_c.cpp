// SPDX-License-Identifier: Apache-2.0
// The C API: same bytes, other names. Every struct is checked to equal the C++ one, byte for byte.

#include "stylet/stylet_c.h"

#include <bit>
#include <cstring>
#include <new>

#include "stylet/kernel.h"

namespace {

using namespace stylet;

static_assert(sizeof(stylet_config) == sizeof(Config));
static_assert(offsetof(stylet_config, needle) == offsetof(Config, needle));
static_assert(offsetof(stylet_config, breathing) == offsetof(Config, breathing));
static_assert(sizeof(stylet_needle_config) == sizeof(NeedleConfig));
static_assert(offsetof(stylet_needle_config, tip_half_angle_rad) ==
              offsetof(NeedleConfig, tip_half_angle_rad));
static_assert(sizeof(stylet_obstacle_config) == sizeof(ObstacleConfig));
static_assert(STYLET_MAX_NEEDLES == kMaxNeedles && STYLET_MAX_HULL_VERTICES == kMaxHullVertices);
static_assert(sizeof(stylet_sizes) == sizeof(Sizes));
static_assert(sizeof(stylet_input) == sizeof(Input));
static_assert(sizeof(stylet_output) == sizeof(Output));
static_assert(offsetof(stylet_output, cause) == offsetof(Output, cause));
static_assert(offsetof(stylet_output, events) == offsetof(Output, events));
static_assert(sizeof(stylet_event) == sizeof(Event));
static_assert(sizeof(stylet_vec3) == sizeof(Vec3));
static_assert(sizeof(stylet_organ) >= sizeof(Organ) && alignof(stylet_organ) >= alignof(Organ));
static_assert(sizeof(stylet_kernel) >= sizeof(Kernel) && alignof(stylet_kernel) >= alignof(Kernel));

const Organ& in(const stylet_organ* organ) {
  return *reinterpret_cast<const Organ*>(organ);
}
const Kernel& in(const stylet_kernel* kernel) {
  return *reinterpret_cast<const Kernel*>(kernel);
}
Kernel& in(stylet_kernel* kernel) {
  return *reinterpret_cast<Kernel*>(kernel);
}

std::span<std::byte> block(void* data, std::size_t bytes) {
  return {static_cast<std::byte*>(data), bytes};
}
std::uint16_t number(Status status) {
  return static_cast<std::uint16_t>(status);
}

}  // namespace

extern "C" {

std::uint32_t stylet_c_version(void) {
  return STYLET_C_VERSION;
}

const char* stylet_status_name(std::uint16_t status) {
  return status_name(static_cast<Status>(status));
}

const char* stylet_event_name(std::uint32_t kind) {
  return event_name(static_cast<EventKind>(kind));
}

void stylet_default_config(stylet_config* config_out) {
  *config_out = std::bit_cast<stylet_config>(Config{});
}

std::uint16_t stylet_organ_open(const void* bytes, std::size_t count, stylet_organ* organ_out) {
  Organ organ;
  const Status status = organ_open({static_cast<const std::byte*>(bytes), count}, organ);
  // In the caller's storage, like the kernel below: nothing is allocated.
  if (status == Status::kOk) new (organ_out) Organ(organ);
  return number(status);
}

std::uint16_t stylet_kernel_sizes(const stylet_organ* organ, const stylet_config* config,
                                  stylet_sizes* sizes_out) {
  Sizes need = {};
  const Status status = sizes(in(organ), std::bit_cast<Config>(*config), need);
  *sizes_out = std::bit_cast<stylet_sizes>(need);
  return number(status);
}

std::uint16_t stylet_kernel_create(const stylet_organ* organ, const stylet_config* config,
                                   void* model, std::size_t model_bytes, void* state,
                                   std::size_t state_bytes, void* scratch,
                                   std::size_t scratch_bytes, stylet_kernel* kernel_out) {
  Kernel kernel;
  const Memory memory = {block(model, model_bytes), block(state, state_bytes),
                         block(scratch, scratch_bytes)};
  const Status status = create(in(organ), std::bit_cast<Config>(*config), memory, kernel);
  if (status == Status::kOk) new (kernel_out) Kernel(kernel);
  return number(status);
}

void stylet_kernel_reset(stylet_kernel* kernel) {
  reset(in(kernel));
}

void stylet_kernel_tick(stylet_kernel* kernel, const stylet_input* input,
                        stylet_output* output_out) {
  const Output out = tick(in(kernel), std::bit_cast<Input>(*input));
  std::memcpy(output_out, &out, sizeof(out));
}

void stylet_kernel_tick_all(stylet_kernel* kernel, const stylet_input* inputs,
                            stylet_output* outputs_out, std::uint32_t count) {
  tick(in(kernel), {reinterpret_cast<const Input*>(inputs), count},
       {reinterpret_cast<Output*>(outputs_out), count});
}

std::uint16_t stylet_kernel_set_obstacles(stylet_kernel* kernel,
                                          const stylet_obstacle_config* obstacles,
                                          std::uint32_t count) {
  return number(
      set_obstacles(in(kernel), {reinterpret_cast<const ObstacleConfig*>(obstacles), count}));
}

std::uint32_t stylet_kernel_events(const stylet_kernel* kernel, stylet_event* out,
                                   std::uint32_t capacity) {
  return events(in(kernel), {reinterpret_cast<Event*>(out), capacity});
}

std::uint32_t stylet_kernel_surface(const stylet_kernel* kernel, stylet_vec3* out,
                                    std::uint32_t capacity) {
  return surface(in(kernel), {reinterpret_cast<Vec3*>(out), capacity});
}

std::uint64_t stylet_kernel_hash(const stylet_kernel* kernel) {
  return hash(in(kernel));
}

std::size_t stylet_kernel_snapshot_bytes(const stylet_kernel* kernel) {
  return snapshot_bytes(in(kernel));
}

std::uint16_t stylet_kernel_snapshot(const stylet_kernel* kernel, void* out, std::size_t bytes) {
  return number(snapshot(in(kernel), block(out, bytes)));
}

std::uint16_t stylet_kernel_restore(stylet_kernel* kernel, const void* in_bytes,
                                    std::size_t bytes) {
  return number(restore(in(kernel), {static_cast<const std::byte*>(in_bytes), bytes}));
}

}  // extern "C"
