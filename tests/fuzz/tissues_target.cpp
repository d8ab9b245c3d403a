// SPDX-License-Identifier: Apache-2.0
// Any text as a file of tissues. It is refused with one line that names the file, or gives tissues
// whose numbers are finite.
#include <cmath>

#include "asset/materials.h"
#include "base/refusal.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace stylet;
  const test::InputFile file({data, size}, ".toml");
  try {
    for (const offline::Tissue& tissue : offline::read_tissues(file.path())) {
      test::promise(!tissue.name.empty(), "a tissue without a name");
      for (const double value :
           {tissue.density_kg_per_m3, tissue.youngs_modulus_pa, tissue.poisson_ratio,
            tissue.relaxing_fraction, tissue.relaxation_time_s, tissue.puncture_force_n,
            tissue.cutting_force_n, tissue.recut_fraction, tissue.coulomb_friction_n_per_m,
            tissue.static_friction_n_per_m, tissue.stribeck_velocity_m_per_s,
            tissue.viscous_friction_n_s_per_m2, tissue.membrane_n_per_m,
            tissue.puncture_velocity_exponent}) {
        test::promise(std::isfinite(value), "a tissue with a number that is not finite");
      }
    }
  } catch (const offline::Refusal& refused) {
    test::promise_one_line(refused.what());
    test::promise(std::string_view(refused.what()).find(file.path()) == 0,
                  "a refusal that does not name the file");
  }
  return 0;
}
