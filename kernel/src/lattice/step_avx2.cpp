// SPDX-License-Identifier: Apache-2.0
#define STYLET_LATTICE_STEP lattice_step_avx2
#include "lattice/step.h"
