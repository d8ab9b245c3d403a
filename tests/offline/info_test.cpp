// SPDX-License-Identifier: Apache-2.0
// What `stylet-organ info` says of an organ file, whoever wrote it, against what the file was made
// of.
#include "report/info.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "asset/write_organ.h"
#include "base/refusal.h"
#include "offline_support.h"
#include "organ_objects.h"

namespace stylet::test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::byte> bytes_of(const format::OrganT& organ) {
  flatbuffers::FlatBufferBuilder builder;
  format::FinishOrganBuffer(builder, format::Organ::Pack(builder, &organ));
  const auto* bytes = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return {bytes, bytes + builder.GetSize()};
}

// A box of 6 x 4 x 2 voxels of 5 mm in the smallest file that the format allows: without anything
// that a file may leave out, and of version 1, which has no checksum.
format::OrganT barest() {
  offline::BuildOptions options;
  options.voxel_edge_m = 5e-3;
  const auto bytes =
      build_quietly({input_of(box_mesh({0, 0, 0}, {30, 20, 10}), 1e-3, "gel")}, options).bytes;
  format::OrganT organ;
  format::GetOrgan(bytes.data())->UnPackTo(&organ);
  organ.format_version = 1;
  organ.name.clear();
  organ.voxel_fixed.clear();
  organ.vertices.clear();
  organ.triangles.clear();
  organ.sphere_nodes.clear();
  organ.provenance.reset();
  organ.mixed.clear();
  organ.content_sha256.clear();
  return organ;
}

TEST(Info, OfTheBarestFileSaysWhatItContains) {
  const auto bytes = bytes_of(barest());
  const Organ organ = offline::open_organ("bare.organ", bytes);
  const auto facts = offline::organ_facts(organ, bytes);
  EXPECT_EQ(facts["name"], "");
  EXPECT_EQ(facts["content_sha256"], "");
  EXPECT_EQ(facts["voxels"], 6 * 4 * 2);
  EXPECT_NEAR(facts["volume_ml"].get<double>(), 6, 1e-6);
  EXPECT_EQ(facts["held_corners"], 0);
  for (const char* none : {"surface_vertices", "surface_triangles", "sphere_nodes"}) {
    EXPECT_EQ(facts[none], 0) << none;
  }
  EXPECT_EQ(facts["bytes"]["per_vertex"], 0);
  EXPECT_TRUE(facts["provenance"].is_null());
  const std::string text = offline::organ_text(facts);
  EXPECT_THAT(text, HasSubstr("48 voxels of 5 mm in 6 x 4 x 2, 6 ml"));
  EXPECT_THAT(text, Not(HasSubstr("made by")));
}

// By their keys in tables of tissues.
TEST(Info, NumbersOfFrictionAndThoseThatNotEveryTissueHasAreShownUnlessTheyAreZero) {
  format::OrganT organ = barest();
  const auto text_of = [](const format::OrganT& shown) {
    const auto bytes = bytes_of(shown);
    return offline::organ_text(offline::organ_facts(offline::open_organ("a.organ", bytes), bytes));
  };
  auto& material = *organ.materials[0];
  material.coulomb_friction_n_per_m = 8;
  material.static_friction_n_per_m = 12;
  material.stribeck_velocity_m_per_s = 0.25F;
  material.viscous_friction_n_s_per_m2 = 0;
  EXPECT_THAT(text_of(organ), HasSubstr("\n              coulomb_friction_n_per_mm 0.008  "
                                        "static_friction_n_per_mm 0.012  "
                                        "stribeck_velocity_mm_per_s 250\n"));
  EXPECT_THAT(text_of(organ), HasSubstr("  puncture "));
  material.strain_stiffening = 37.5F;
  material.fracture_toughness_j_per_m2 = 90;
  EXPECT_THAT(text_of(organ), HasSubstr("stribeck_velocity_mm_per_s 250  strain_stiffening 37.5  "
                                        "fracture_toughness_j_per_m2 90\n"));
  EXPECT_THAT(text_of(organ), Not(HasSubstr("  puncture ")));
}

TEST(Info, EmptyOriginsAreShownEmpty) {
  format::OrganT organ = barest();
  organ.provenance = std::make_unique<format::ProvenanceT>();
  const auto unsaid = bytes_of(organ);
  const auto facts =
      offline::organ_facts(offline::open_organ("a.organ", unsaid), unsaid)["provenance"];
  EXPECT_EQ(facts["tool_version"], "");
  EXPECT_EQ(facts["options"], "");
  EXPECT_TRUE(facts["sources"].empty());
  organ.provenance->sources.push_back(std::make_unique<format::SourceT>());
  organ.provenance->sources.back()->priority = -7;
  const auto one = bytes_of(organ);
  const auto all = offline::organ_facts(offline::open_organ("a.organ", one), one);
  const auto& source = all["provenance"]["sources"][0];
  for (const char* empty : {"path", "tissue", "sha256"}) EXPECT_EQ(source[empty], "") << empty;
  EXPECT_THAT(offline::organ_text(all), HasSubstr("priority -7) as , sha256 \n"));
}

TEST(Info, AFileOfVersionTwoHasTheChecksumOfItsBytes) {
  format::OrganT organ = barest();
  organ.format_version = 2;
  const auto bytes = bytes_of(organ);
  try {
    (void)offline::open_organ("a.organ", bytes);
    ADD_FAILURE() << "opened";
  } catch (const offline::Refusal& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("a.organ: content_sha256: none: expected "));
  }
}

TEST(Info, WhatTheKernelWouldNotOpenIsNotWritten) {
  try {
    (void)offline::write_organ({});
    ADD_FAILURE() << "written";
  } catch (const offline::Refusal& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("the organ does not pass the kernel's check: "));
  }
}

// A box, and beside it a Moebius band.
TEST(Info, OfASurfaceWithOneSideSaysThatRaysVote) {
  offline::Mesh mesh = box_mesh({0, 0, 0}, {40, 40, 40});
  constexpr std::uint32_t kParts = 24;
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (std::uint32_t i = 0; i < kParts; ++i) {
    const double around = 2 * std::numbers::pi * i / kParts, half = around / 2;
    for (const double across : {-4.0, 4.0}) {
      const double out = 15 + across * std::cos(half);
      mesh.points.push_back(
          {80 + out * std::cos(around), 20 + out * std::sin(around), 20 + across * std::sin(half)});
    }
  }
  for (std::uint32_t i = 0; i < kParts; ++i) {
    const std::uint32_t a = first + 2 * i, b = a + 1;
    const bool last = i + 1 == kParts;
    const std::uint32_t c = last ? first + 1 : a + 2, d = last ? first : b + 2;
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  const offline::Built built = build_quietly({input_of(mesh, 1e-3)}, {});
  EXPECT_THAT(offline::build_text(offline::build_facts(built.report)),
              HasSubstr("2 pieces, open, not orientable (rays vote)"));
  EXPECT_NEAR(volume_m3(opened(built.bytes)) * 1e6, 64, 0.02 * 64);
}

}  // namespace
}  // namespace stylet::test
