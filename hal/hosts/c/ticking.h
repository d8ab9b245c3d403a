// SPDX-License-Identifier: Apache-2.0
// Ticks of one simulation with a caller's inputs and outputs, which simulation and batch share.
#pragma once

#include "hal/hosts/c/handles.h"

namespace stylet::c {

// A caller's arrays from one element on; the first elements say how far apart all are.
struct Arrays {
  const stylet_input* inputs = nullptr;  // null: there are none
  stylet_output* outputs = nullptr;      // likewise
  std::uint32_t input_stride = 0, output_stride = 0;

  Arrays from(std::size_t element) const;
};
Arrays arrays(const stylet_input* inputs, stylet_output* outputs);
// Whether the sizes are known, and none of `input_count` inputs holds what we do not know. An input
// that is older than a field has 0 there; none is older than that of the first version.
bool sizes_known(const Arrays& arrays, std::size_t input_count);

// STYLET_OK: nobody else ticks it.
stylet_status ready(const stylet_simulation* simulation);
// inputs[tick][needle], outputs likewise. Sizes were checked before. Promises of a tick.
void run_plain(stylet_simulation& simulation, Arrays arrays, std::uint32_t ticks);
void tick_plain(stylet_simulation& simulation, const Arrays& arrays, std::size_t input_count,
                std::size_t output_count);

// Of a call that was refused: nobody takes what lay there for a force.
stylet_status refuse_outputs(stylet_status status, stylet_output* outputs, std::size_t count);

Input to_input(const stylet_input* in, std::uint32_t stride);
stylet_output to_output(const Output& out);

}  // namespace stylet::c
