// SPDX-License-Identifier: Apache-2.0
#define STYLET_LATTICE_STEP lattice_step_baseline
#include "lattice/step.h"
