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
      for (const offline::TissueNumber& number : offline::tissue_numbers()) {
        test::promise(std::isfinite(tissue.*number.field),
                      "a tissue with a number that is not finite");
      }
    }
  } catch (const offline::Refusal& refused) {
    test::promise_one_line(refused.what());
    test::promise(std::string_view(refused.what()).find(file.path()) == 0,
                  "a refusal that does not name the file");
  }
  return 0;
}
