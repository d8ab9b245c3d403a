// SPDX-License-Identifier: Apache-2.0
// Fills a caller's refusal: what was wrong, in fields and as one line.
#pragma once

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
stylet_status refuse_organ(stylet_refusal* refusal_out, const OrganRefusal& why);
stylet_status refuse_config(stylet_refusal* refusal_out, Status status, const ConfigRefusal& why);

// Refuses what is outside; leaves the refusal alone if nothing is.
stylet_status told(const FirstOutside& first, stylet_refusal* refusal_out);

}  // namespace stylet::c
