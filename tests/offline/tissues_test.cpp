// SPDX-License-Identifier: Apache-2.0
// Tissues from a user's file: every number from the least to the largest that the kernel takes in
// an organ (kernel/src/organ/organ.cpp, in SI), in the unit that its key names.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "asset/materials.h"
#include "base/refusal.h"
#include "offline_support.h"

namespace stylet::test {
namespace {

using offline::Tissue;
using testing::HasSubstr;

struct Number {
  const char* key;
  double Tissue::*member;
  double unit;  // in SI
  double least, most;
};

// One of a key's units in SI, by the unit's name.
double unit_of(std::string_view key) {
  if (key.ends_with("_mm3_per_s_kpa")) return 1e-12;
  if (key.ends_with("_mpa_s")) return 1e-3;
  if (key.ends_with("_kpa")) return 1e3;
  if (key.ends_with("_per_mm")) return 1e3;
  if (key.ends_with("_mm_per_s")) return 1e-3;
  return 1;
}

double wide(float value) {
  return std::stod(fmt::format("{}", value));  // 0.1F is a tenth, as in the file
}

std::vector<Number> numbers() {
  std::vector<Number> all;
#define STYLET_NUMBER(field, least, most, expected, key, ...) \
  all.push_back({key, &Tissue::field, unit_of(key), wide(least), wide(most)});
  STYLET_MATERIAL_NUMBERS(STYLET_NUMBER)
#undef STYLET_NUMBER
  return all;
}

// The other kind of friction, with a value with which any value of this kind is accepted.
std::string beside(const std::string& key) {
  if (key == "coulomb_friction_n_per_mm") return "static_friction_n_per_mm = 10\n";
  if (key == "static_friction_n_per_mm") return "coulomb_friction_n_per_mm = 0\n";
  return "";
}

std::string tissue_text(const Number& number, double value) {
  return fmt::format("[gel]\n{} = {}\n{}", number.key, value, beside(number.key));
}

std::string refusal_of(const std::filesystem::path& file) {
  try {
    (void)offline::read_tissues(file);
  } catch (const offline::Refusal& refused) {
    return refused.what();
  }
  return "";
}

TEST(Tissues, AcceptWhatTheKernelAccepts) {
  const Scratch scratch;
  for (const Number& number : numbers()) {
    for (const double wanted :
         {number.least, number.most, 0.3 * number.least + 0.7 * number.most}) {
      const auto tissues = offline::read_tissues(
          scratch.write("own.toml", tissue_text(number, wanted / number.unit)));
      ASSERT_EQ(tissues.size(), 1U);
      EXPECT_DOUBLE_EQ(tissues[0].*number.member, wanted) << number.key;
      offline::BuildOptions options;
      options.voxel_edge_m = 0.01;
      options.own_tissues = tissues;
      const auto built =
          build_quietly({input_of(box_mesh({0, 0, 0}, {20, 20, 20}), 1e-3, "gel")}, options);
      EXPECT_EQ(opened(built.bytes).material_count, 1U) << number.key;
    }
  }
}

TEST(Tissues, RefuseWhatTheKernelRefuses) {
  const Scratch scratch;
  for (const Number& number : numbers()) {
    const double least = number.least / number.unit, most = number.most / number.unit;
    for (const double wanted : {least - 1e-3 * (std::abs(least) + 1), most * 1.001}) {
      EXPECT_THAT(refusal_of(scratch.write("own.toml", tissue_text(number, wanted))),
                  HasSubstr(fmt::format("own.toml:2: {} = {}: expected {} to {}", number.key,
                                        wanted, least, most)));
    }
  }
}

// If no preset has the tissue's name, every number must be there, except for those that most
// tissues do not have.
TEST(Tissues, WithoutAPresetNeedEveryNumber) {
  const Scratch scratch;
  const auto without = [&](const std::string& key) {
    std::string text = "[jelly]\n";
    for (const Number& number : numbers()) {
      if (number.key != key)
        text += fmt::format("{} = {}\n", number.key, number.most / number.unit);
    }
    return scratch.write("own.toml", text);
  };
  EXPECT_EQ(refusal_of(without("")), "");
  for (const Number& number : numbers()) {
    const std::string key = number.key;
    const bool may_miss = key == "membrane_n_per_mm" || key == "puncture_velocity_exponent" ||
                          key == "strain_stiffening" || key == "fracture_toughness_j_per_m2" ||
                          key == "toughness_velocity_exponent" ||
                          key == "needle_friction_coefficient" || key.starts_with("fluid_");
    const std::string said = refusal_of(without(key));
    if (may_miss) {
      EXPECT_EQ(said, "") << key;
    } else {
      EXPECT_THAT(said, HasSubstr(fmt::format(
                            "own.toml:1: jelly: {} is missing: expected a number from", key)));
    }
  }
}

}  // namespace
}  // namespace stylet::test
