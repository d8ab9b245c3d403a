// SPDX-License-Identifier: Apache-2.0
// Fills a caller's refusal: what was wrong, in fields and as one line.
#pragma once

#include <cstdint>

#include "hal/hosts/c/sized.h"
#include "stylet/first_outside.h"
#include "stylet/kernel.h"
#include "stylet/stylet.h"

namespace stylet::c {

// Each returns `status`. A refusal that is null, or does not say its size, is left alone.
stylet_status refuse(stylet_refusal* refusal_out, stylet_status status);
stylet_status refuse_file(stylet_refusal* refusal_out, stylet_status status, const char* path,
                          const char* why);
stylet_status refuse_text(stylet_refusal* refusal_out, stylet_status status, const char* place,
                          const char* text);
// A value, with what was expected in words; `index`: of which element of an array; `given`: the
// value in words, if it is no number.
stylet_status refuse_value(stylet_refusal* refusal_out, stylet_status status, const char* place,
                           double value, const char* expected, std::uint64_t index = 0,
                           const char* given = nullptr);
// Null where a pointer is needed.
stylet_status refuse_missing(stylet_refusal* refusal_out, const char* place,
                             std::uint64_t index = 0);
// What ready() says of a simulation.
stylet_status refuse_unready(stylet_refusal* refusal_out, stylet_status status);
stylet_status refuse_size(stylet_refusal* refusal_out, const char* place, std::uint32_t bytes,
                          std::uint32_t known_bytes, std::uint64_t index);
// A struct of a size that none had, or with something where we know no field; in an array the first
// element says the size.
template <typename T>
stylet_status refuse_struct(stylet_refusal* refusal_out, const char* place, const T* array,
                            std::uint64_t index = 0) {
  return refuse_size(refusal_out, place, array->struct_bytes, sizeof(T), index);
}
stylet_status refuse_organ(stylet_refusal* refusal_out, const OrganRefusal& why);
stylet_status refuse_config(stylet_refusal* refusal_out, Status status, const ConfigRefusal& why);

// Refuses what is outside; leaves the refusal alone if nothing is.
stylet_status told(const FirstOutside& first, stylet_refusal* refusal_out);

}  // namespace stylet::c
