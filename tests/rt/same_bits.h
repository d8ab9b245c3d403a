// SPDX-License-Identifier: Apache-2.0
// A scripted session with the same bits by every instruction set, alone, with helpers, and with
// scratch memory that holds anything before each tick.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <vector>

#include "felt.h"
#include "helper_threads.h"
#include "session.h"
#include "state/layout.h"
#include "variants.h"

namespace stylet::test {

// `make()` gives a new body with a `session`; ticks 300 to `end` of the script are driven, at whose
// end the needle is in the tissue.
template <typename Make>
void expect_same_bits(Make make, const Script& script, std::uint64_t end) {
  const auto hash_of = [&](const Variant& variant, std::uint32_t helpers, bool spoil) {
    auto body = make();
    Kernel& kernel = body.session.kernel;
    kernel.step = variant.step;
    const Block memory = make_block(team_bytes(kernel, helpers), std::byte{0x7F});
    EXPECT_EQ(set_team(kernel, helpers, memory.span()), Status::kOk);
    const Helpers threads(kernel, helpers);
    for (std::uint64_t i = 300; i < end; ++i) {
      if (spoil) std::memset(kernel.scratch, static_cast<int>(i), kernel.sizes.scratch_bytes);
      tick(kernel, scripted_input(script, i));
    }
    EXPECT_GT(view_of(kernel).state.needle->shaft_count, 0U);
    return hash(kernel);
  };
  const std::vector<Variant> variants = variants_here();
  const std::uint64_t one = hash_of(variants[0], 0, false);
  for (const Variant& variant : variants) {
    EXPECT_EQ(hash_of(variant, 0, true), one) << variant.name;
    EXPECT_EQ(hash_of(variant, 2, false), one) << variant.name;
  }
}

}  // namespace stylet::test
