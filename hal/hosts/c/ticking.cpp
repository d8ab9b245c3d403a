// SPDX-License-Identifier: Apache-2.0
#include "hal/hosts/c/ticking.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "hal/hosts/c/plain.h"
#include "hal/hosts/c/sized.h"

namespace stylet::c {
namespace {

// Of the first version: its last field was the pose.
constexpr std::size_t kFirstInput = offsetof(stylet_input, handle) + sizeof(stylet_pose);

}  // namespace

Arrays Arrays::from(std::size_t element) const {
  Arrays out = *this;
  if (inputs != nullptr) out.inputs = c::element(inputs, input_stride, element);
  if (outputs != nullptr) out.outputs = c::element(outputs, output_stride, element);
  return out;
}

Arrays arrays(const stylet_input* inputs, stylet_output* outputs) {
  return {inputs, outputs, inputs == nullptr ? 0 : stride_of(inputs),
          outputs == nullptr ? 0 : stride_of(outputs)};
}

bool sizes_known(const Arrays& arrays, std::size_t input_count) {
  if (arrays.outputs != nullptr && arrays.output_stride == 0) return false;
  if (arrays.inputs == nullptr || arrays.input_stride == sizeof(stylet_input)) return true;
  if (arrays.input_stride < kFirstInput) return false;
  for (std::size_t i = 0; i < input_count; ++i) {
    if (has_unknown(arrays.from(i).inputs, arrays.input_stride)) return false;
  }
  return true;
}

stylet_status ready(const stylet_simulation* simulation) {
  if (simulation == nullptr) return STYLET_ARGUMENT_MISSING;
  return simulation->in_loop.load(std::memory_order_acquire) ? STYLET_LOOP_RUNS : STYLET_OK;
}

stylet_status refuse_outputs(stylet_status status, stylet_output* outputs, std::size_t count) {
  const Arrays arrays = c::arrays(nullptr, outputs);
  for (std::size_t i = 0; outputs != nullptr && arrays.output_stride != 0 && i < count; ++i) {
    (void)give(stylet_output{}, arrays.from(i).outputs, arrays.output_stride);
  }
  return status;
}

Input to_input(const stylet_input* in, std::uint32_t stride) {
  stylet_input own = {};
  std::memcpy(&own, in, std::min<std::size_t>(stride, sizeof own));
  return {pose(own.handle), own.valid, own.plunger_n};
}

stylet_output to_output(const Output& out) {
  return {sizeof(stylet_output),
          out.flags,
          out.tick,
          plain(out.force_n),
          plain(out.torque_nm),
          plain(out.cause.stiffness_n),
          plain(out.cause.cutting_n),
          plain(out.cause.friction_n),
          plain(out.cause.clamping_n),
          plain(out.cause.obstacle_n),
          plain(out.tip_m),
          out.depth_m,
          static_cast<std::uint32_t>(out.phase),
          out.layer,
          out.constraint_particles,
          out.events,
          out.stiffness_n_per_m,
          out.flow.opening_pa,
          out.flow.hub_pa,
          out.flow.flow_m3_per_s,
          out.flow.injected_m3,
          out.flow.plunger_m,
          out.flow.plunger_m_per_s,
          out.flow.filled,
          0};
}

void tick_plain(stylet_simulation& simulation, const Arrays& arrays, std::size_t input_count,
                std::size_t output_count) {
  Input in[kMaxNeedles];
  Output out[kMaxNeedles];
  for (std::size_t i = 0; i < input_count; ++i) {
    in[i] = to_input(arrays.from(i).inputs, arrays.input_stride);
  }
  tick(simulation.kernel, {in, input_count}, {out, output_count});
  for (std::size_t i = 0; i < output_count; ++i) {
    (void)give(to_output(out[i]), arrays.from(i).outputs, arrays.output_stride);
  }
}

void run_plain(stylet_simulation& simulation, Arrays arrays, std::uint32_t ticks) {
  const std::size_t needles = simulation.config.needle_count;
  const std::size_t shown = arrays.outputs == nullptr ? 0 : needles;
  for (std::uint32_t i = 0; i < ticks; ++i) {
    tick_plain(simulation, arrays, needles, shown);
    arrays = arrays.from(needles);
  }
}

}  // namespace stylet::c
