// SPDX-License-Identifier: Apache-2.0
// Organs and simulations of the C interface: each function gives what its C++ counterpart gives,
// bit for bit; mistakes are reported with field and limits; structs of other sizes do no harm.
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include "c_support.h"

namespace stylet::test {
namespace {

template <typename T>
void expect_same_bytes(const T& a, const T& b) {
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

ObstacleConfig ball(const Organ& organ) {
  ObstacleConfig out;
  make_sphere(out, 4e-3F);
  out.pose.position_m = block_script(organ, Config{}).entry_m;
  out.pose.position_m.z -= 0.018F;
  out.stiffness_n_per_m = 3000;
  out.largest_force_n = 20;
  out.friction = 0.2F;
  return out;
}

stylet_obstacle to_c(const ObstacleConfig& o) {
  stylet_obstacle out;
  EXPECT_EQ(stylet_obstacle_init(&out, sizeof out), STYLET_OK);
  EXPECT_EQ(stylet_obstacle_sphere(&out, o.rounding_m), STYLET_OK);
  out.pose.position_m = {o.pose.position_m.x, o.pose.position_m.y, o.pose.position_m.z};
  out.stiffness_n_per_m = o.stiffness_n_per_m;
  out.largest_force_n = o.largest_force_n;
  out.friction = o.friction;
  return out;
}

void expect_same_output(const stylet_output& c, const Output& cpp) {
  EXPECT_EQ(c.tick, cpp.tick);
  EXPECT_EQ(c.flags, cpp.flags);
  expect_same_bytes(std::bit_cast<Vec3>(c.force_n), cpp.force_n);
  expect_same_bytes(std::bit_cast<Vec3>(c.torque_nm), cpp.torque_nm);
  expect_same_bytes(std::bit_cast<Vec3>(c.cutting_n), cpp.cause.cutting_n);
  expect_same_bytes(std::bit_cast<Vec3>(c.friction_n), cpp.cause.friction_n);
  expect_same_bytes(std::bit_cast<Vec3>(c.clamping_n), cpp.cause.clamping_n);
  expect_same_bytes(std::bit_cast<Vec3>(c.obstacle_n), cpp.cause.obstacle_n);
  expect_same_bytes(std::bit_cast<Vec3>(c.stiffness_n), cpp.cause.stiffness_n);
  expect_same_bytes(std::bit_cast<Vec3>(c.tip_m), cpp.tip_m);
  EXPECT_EQ(c.phase, static_cast<std::uint32_t>(cpp.phase));
  EXPECT_EQ(c.layer, cpp.layer);
  EXPECT_EQ(c.constraint_particles, cpp.constraint_particles);
  EXPECT_EQ(c.events, cpp.events);
  expect_same_bytes(c.depth_m, cpp.depth_m);
  expect_same_bytes(c.stiffness_n_per_m, cpp.stiffness_n_per_m);
  expect_same_bytes(c.opening_pa, cpp.flow.opening_pa);
  expect_same_bytes(c.hub_pa, cpp.flow.hub_pa);
  expect_same_bytes(c.flow_m3_per_s, cpp.flow.flow_m3_per_s);
  expect_same_bytes(c.injected_m3, cpp.flow.injected_m3);
  expect_same_bytes(c.plunger_m, cpp.flow.plunger_m);
  expect_same_bytes(c.plunger_m_per_s, cpp.flow.plunger_m_per_s);
  expect_same_bytes(c.filled, cpp.flow.filled);
}

// Compares what both sides show between two ticks.
void expect_same_view(const stylet_simulation* c, const Kernel& cpp, const Organ& organ,
                      std::uint32_t needles) {
  EXPECT_EQ(stylet_simulation_hash(c), hash(cpp));
  const auto vertices = static_cast<std::uint32_t>(organ.vertices.size());
  std::vector<stylet_vec3> places(vertices);
  std::vector<Vec3> expected(vertices);
  ASSERT_EQ(stylet_simulation_surface(c, places.data(), vertices), vertices);
  ASSERT_EQ(surface(cpp, expected), vertices);
  EXPECT_EQ(std::memcmp(places.data(), expected.data(), vertices * sizeof(Vec3)), 0);

  std::vector<stylet_vec3> moved(stylet_simulation_particles(c, nullptr, 0));
  std::vector<Vec3> moved_expected(particle_count(cpp));
  ASSERT_EQ(moved.size(), moved_expected.size());
  (void)stylet_simulation_particles(c, moved.data(), static_cast<std::uint32_t>(moved.size()));
  (void)particles(cpp, moved_expected);
  EXPECT_EQ(std::memcmp(moved.data(), moved_expected.data(), moved.size() * sizeof(Vec3)), 0);

  for (std::uint32_t i = 0; i < needles; ++i) {
    std::array<stylet_vec3, kMaxRods + 1> shape = {};
    std::array<Vec3, kMaxRods + 1> shape_expected = {};
    const std::uint32_t nodes = needle_shape(cpp, i, shape_expected);
    ASSERT_EQ(stylet_simulation_needle_shape(c, i, shape.data(), kMaxRods + 1), nodes);
    EXPECT_EQ(std::memcmp(shape.data(), shape_expected.data(), nodes * sizeof(Vec3)), 0);
  }
  std::array<stylet_constraint_particle, kMaxNeedles*(kMaxConstraintParticles + 1)> cps = {};
  std::array<ConstraintParticle, cps.size()> cps_expected = {};
  const std::uint32_t count = constraint_particles(cpp, cps_expected);
  ASSERT_EQ(stylet_simulation_constraint_particles(c, cps.data(), cps.size()), count);
  EXPECT_EQ(std::memcmp(cps.data(), cps_expected.data(), count * sizeof cps[0]), 0);
  std::array<stylet_event, kMaxEvents> seen = {};
  std::array<Event, kMaxEvents> seen_expected = {};
  const std::uint32_t happened = events(cpp, seen_expected);
  ASSERT_EQ(stylet_simulation_events(c, seen.data(), kMaxEvents), happened);
  EXPECT_EQ(std::memcmp(seen.data(), seen_expected.data(), happened * sizeof seen[0]), 0);

  stylet_energy energy_c = {};
  energy_c.struct_bytes = sizeof energy_c;
  ASSERT_EQ(stylet_simulation_get_energy(c, &energy_c), STYLET_OK);
  const Energy e = energy(cpp);
  expect_same_bytes(energy_c.elastic_j, e.elastic);
  expect_same_bytes(energy_c.work_by_hand_j, e.work_by_hand);
  expect_same_bytes(energy_c.obstacles_j, e.obstacles);
  stylet_stats stats_c = {};
  stats_c.struct_bytes = sizeof stats_c;
  ASSERT_EQ(stylet_simulation_get_stats(c, &stats_c), STYLET_OK);
  const Stats s = stats(cpp);
  EXPECT_EQ(stats_c.ticks, s.ticks);
  EXPECT_EQ(stats_c.input_missing, s.input_missing);
  EXPECT_EQ(stats_c.constraint_particles.used_max, s.constraint_particles.used_max);
  expect_same_bytes(stats_c.unit_in_voxels, s.unit_in_voxels);
}

TEST(CSimulation, RandomSessionsAreThoseOfCpp) {
  Draw draw(20261);
  for (int session = 0; session < 8; ++session) {
    const auto opened = block_organ(5, 4, 5);
    const DrawnConfig config = drawn_config(draw);
    const OrganHandle organ = c_organ(*opened);
    const SimulationHandle simulation = c_simulation(organ.get(), config);
    ASSERT_NE(simulation, nullptr);
    Session cpp = make_session(opened->organ, config.cpp);
    const ObstacleConfig bone = ball(opened->organ);
    const stylet_obstacle bone_c = to_c(bone);
    ASSERT_EQ(set_obstacles(cpp.kernel, {&bone, 1}), Status::kOk);
    ASSERT_EQ(stylet_simulation_set_obstacles(simulation.get(), &bone_c, 1, nullptr), STYLET_OK);
    const std::uint32_t needles = config.cpp.needle_count;
    for (std::uint64_t i = 0; i < 1300; ++i) {
      const std::vector<Input> inputs = inputs_at(opened->organ, config.cpp, i);
      std::vector<stylet_input> inputs_c;
      for (const Input& each : inputs) inputs_c.push_back(test::to_c(each));
      std::array<stylet_output, kMaxNeedles> out = {};
      std::array<Output, kMaxNeedles> expected = {};
      out[0].struct_bytes = sizeof out[0];
      ASSERT_EQ(
          stylet_simulation_tick(simulation.get(), inputs_c.data(), needles, out.data(), needles),
          STYLET_OK);
      tick(cpp.kernel, inputs, std::span(expected).first(needles));
      for (std::uint32_t n = 0; n < needles; ++n) expect_same_output(out[n], expected[n]);
      if (HasFailure()) FAIL() << "session " << session << ", tick " << i;
    }
    expect_same_view(simulation.get(), cpp.kernel, opened->organ, needles);
  }
}

TEST(COrgan, ShowsWhatTheOrganContains) {
  const auto opened = block_organ(4, 3, 2);
  const OrganHandle organ = c_organ(*opened);
  stylet_organ_info info = {};
  info.struct_bytes = sizeof info;
  ASSERT_EQ(stylet_organ_get_info(organ.get(), &info), STYLET_OK);
  EXPECT_EQ(info.hash, opened->organ.hash);
  EXPECT_EQ(info.voxels, 24U);
  EXPECT_EQ(info.materials, 2U);
  // The block is 20 mm by 15 mm by 10 mm.
  EXPECT_NEAR(static_cast<double>(info.high_m.x - info.low_m.x), 0.02, 1e-6);
  EXPECT_NEAR(static_cast<double>(info.high_m.y - info.low_m.y), 0.015, 1e-6);
  EXPECT_NEAR(static_cast<double>(info.high_m.z - info.low_m.z), 0.01, 1e-6);

  std::vector<stylet_vec3> rest(info.vertices);
  ASSERT_EQ(stylet_organ_vertices(organ.get(), rest.data(), info.vertices), info.vertices);
  std::vector<Vec3> expected(info.vertices);  // a kernel that has not moved
  const Session cpp = make_session(opened->organ, Config{});
  ASSERT_EQ(surface(cpp.kernel, expected), info.vertices);
  for (std::uint32_t i = 0; i < info.vertices; ++i) {
    EXPECT_NEAR(static_cast<double>(rest[i].x), static_cast<double>(expected[i].x), 1e-7);
    EXPECT_NEAR(static_cast<double>(rest[i].y), static_cast<double>(expected[i].y), 1e-7);
    EXPECT_NEAR(static_cast<double>(rest[i].z), static_cast<double>(expected[i].z), 1e-7);
  }
  // The surface is closed: by the divergence theorem its volume is the block's.
  std::vector<std::uint32_t> corners(3 * std::size_t{info.triangles});
  ASSERT_EQ(stylet_organ_triangles(organ.get(), corners.data(), info.triangles), info.triangles);
  double six_volumes = 0;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const stylet_vec3 a = rest[corners[i]], b = rest[corners[i + 1]], c = rest[corners[i + 2]];
    six_volumes +=
        static_cast<double>(a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                            a.z * (b.x * c.y - b.y * c.x));
  }
  EXPECT_NEAR(six_volumes / 6, 0.02 * 0.015 * 0.01, 1e-9);

  float distance = 0;
  const stylet_vec3 above = {info.low_m.x + 7e-3F, info.low_m.y + 4e-3F, info.high_m.z + 0.03F};
  EXPECT_EQ(stylet_organ_raycast(organ.get(), above, {0, 0, -5}, &distance), 1);
  EXPECT_NEAR(static_cast<double>(distance), 0.03, 1e-6);
  EXPECT_EQ(stylet_organ_raycast(organ.get(), above, {0, 0, 1}, &distance), 0);
  EXPECT_EQ(stylet_organ_raycast(organ.get(), above, {0, 0, 0}, &distance), 0);

  std::vector<stylet_voxel> voxels(info.voxels);
  ASSERT_EQ(stylet_organ_voxels(organ.get(), voxels.data(), info.voxels), info.voxels);
  for (const stylet_voxel& v : voxels) {
    EXPECT_EQ(v.material, v.z == 1 ? 1 : 0);  // a layer of one voxel on top
    EXPECT_EQ(v.fill, 1.0F);
  }
  stylet_material material = {};
  material.struct_bytes = sizeof material;
  ASSERT_EQ(stylet_organ_get_material(organ.get(), 1, &material), STYLET_OK);
  EXPECT_STREQ(material.name, "capsule");
  EXPECT_EQ(material.youngs_modulus_pa, 200000.0F);
  // A number that stylet_material lacks does not compile here.
  const Material same = organ_material(opened->organ, 1);
#define STYLET_EXPECT_SAME(field, ...) EXPECT_EQ(material.field, same.field) << #field;
  STYLET_MATERIAL_NUMBERS(STYLET_EXPECT_SAME)
#undef STYLET_EXPECT_SAME
  EXPECT_EQ(stylet_organ_get_material(organ.get(), 2, &material), STYLET_ARGUMENT_OUT_OF_RANGE);
}

TEST(COrgan, DamagedBytesAreRefusedWithThePlace) {
  const auto opened = block_organ(4, 3, 2);
  Draw draw(7);
  for (int i = 0; i < 300; ++i) {
    std::vector<std::byte> bytes = opened->bytes;
    if (draw.chance(0.3)) bytes.resize(draw.below(static_cast<std::uint32_t>(bytes.size())));
    const std::uint32_t flips = 1 + draw.below(4);
    for (std::uint32_t f = 0; f < flips && !bytes.empty(); ++f) {
      const std::uint32_t at = draw.below(static_cast<std::uint32_t>(bytes.size()));
      bytes[at] ^= static_cast<std::byte>(1U << draw.below(8));
    }
    stylet_organ* organ = nullptr;
    stylet_refusal why = {};
    why.struct_bytes = sizeof why;
    const stylet_status status = stylet_organ_from_bytes(bytes.data(), bytes.size(), &organ, &why);
    EXPECT_EQ(why.status, status);
    EXPECT_EQ(organ == nullptr, status != STYLET_OK);
    EXPECT_EQ(why.text[0] == 0, status == STYLET_OK);
    stylet_organ_free(organ);
  }
}

// A field of the configuration with a value just outside.
struct Outside {
  const char* field;
  void (*set)(stylet_config&, stylet_needle&);
  double value, least, most;
};

TEST(CSimulation, AValueOutsideIsReportedWithFieldAndLimits) {
  const Outside outside[] = {
      {"mode", [](stylet_config& c, stylet_needle&) { c.mode = 2; }, 2, 0, 1},
      {"period_s", [](stylet_config& c, stylet_needle&) { c.period_s = 0.02F; }, 0.02, 1e-5, 1e-2},
      {"substeps", [](stylet_config& c, stylet_needle&) { c.substeps = 0; }, 0, 1, 32},
      {"inertia", [](stylet_config& c, stylet_needle&) { c.inertia = 9; }, 9, 0, 1},
      {"breathing_amplitude_m",
       [](stylet_config& c, stylet_needle&) {
         c.breathing_amplitude_m = {0, 0.3F, 0.4F};
       },
       0.5, 0, 0.1},
      {"gravity_m_per_s2",
       [](stylet_config& c, stylet_needle&) {
         c.gravity_m_per_s2 = {0, 300, -400};
       },
       500, 0, 100},
      {"needle.length_m", [](stylet_config&, stylet_needle& n) { n.length_m = 0.7F; }, 0.7, 1e-3,
       0.5},
      {"needle.rods", [](stylet_config&, stylet_needle& n) { n.rods = 129; }, 129, 1, 128},
      {"needle.bent_length_m", [](stylet_config&, stylet_needle& n) { n.bent_length_m = 0.2F; },
       0.2, 0, 0.15},
      {"needle.torn_diameters", [](stylet_config&, stylet_needle& n) { n.torn_diameters = 6; }, 6,
       0.1, 5},
      {"needle.hub", [](stylet_config&, stylet_needle& n) { n.hub = 3; }, 3, 0, 2},
      {"needle.bore_radius_m",
       [](stylet_config&, stylet_needle& n) {
         n.hub = 1;
         n.bore_radius_m = 7e-4F;
       },
       7e-4, 1e-5, 0.635e-3},
      {"needle.syringe_filled",
       [](stylet_config&, stylet_needle& n) {
         n.hub = 2;
         n.syringe_filled = 2;
       },
       2, 0, 1},
      {"needle.tip_half_angle_rad",
       [](stylet_config&, stylet_needle& n) { n.tip_half_angle_rad = 0; }, 0, 0.0872664626,
       1.3962634},
  };
  const auto opened = block_organ(3, 3, 3);
  const OrganHandle organ = c_organ(*opened);
  for (const Outside& each : outside) {
    stylet_config config;
    std::array<stylet_needle, 2> needles;
    ASSERT_EQ(stylet_config_init(&config, sizeof config), STYLET_OK);
    for (auto& n : needles) ASSERT_EQ(stylet_needle_init(&n, sizeof n), STYLET_OK);
    each.set(config, needles[1]);
    stylet_simulation* made = nullptr;
    stylet_refusal why = {};
    why.struct_bytes = sizeof why;
    EXPECT_EQ(stylet_simulation_create(organ.get(), &config, needles.data(), 2, &made, &why),
              STYLET_CONFIG_VALUE_OUT_OF_RANGE);
    EXPECT_EQ(made, nullptr);
    EXPECT_STREQ(why.place, each.field);
    EXPECT_EQ(why.index, std::strncmp(each.field, "needle.", 7) == 0 ? 1U : 0U);
    EXPECT_NEAR(why.value, each.value, 1e-7);
    EXPECT_NEAR(why.least, each.least, 1e-7);
    EXPECT_NEAR(why.most, each.most, 1e-6);
    EXPECT_NE(std::string(why.text).find(each.field), std::string::npos) << why.text;
  }
}

TEST(CSimulation, ObstaclesOutsideAreReportedAndChangeNothing) {
  const auto opened = block_organ(3, 3, 3);
  const OrganHandle organ = c_organ(*opened);
  Draw draw(3);
  const SimulationHandle simulation = c_simulation(organ.get(), drawn_config(draw));
  std::array<stylet_obstacle, 3> bones;
  for (auto& each : bones) ASSERT_EQ(stylet_obstacle_init(&each, sizeof each), STYLET_OK);
  ASSERT_EQ(stylet_simulation_set_obstacles(simulation.get(), bones.data(), 2, nullptr), STYLET_OK);
  const std::uint64_t before = stylet_simulation_hash(simulation.get());
  bones[2].friction = -1;
  stylet_refusal why = {};
  why.struct_bytes = sizeof why;
  EXPECT_EQ(stylet_simulation_set_obstacles(simulation.get(), bones.data(), 3, &why),
            STYLET_CONFIG_VALUE_OUT_OF_RANGE);
  EXPECT_STREQ(why.place, "obstacle.friction");
  EXPECT_EQ(why.index, 2U);
  bones[2].friction = 0;
  bones[1].vertices_m[0].y = std::nanf("");
  EXPECT_EQ(stylet_simulation_set_obstacles(simulation.get(), bones.data(), 3, &why),
            STYLET_CONFIG_VALUE_OUT_OF_RANGE);
  EXPECT_STREQ(why.place, "obstacle.vertices_m");
  EXPECT_EQ(stylet_simulation_set_obstacles(simulation.get(), bones.data(), 17, &why),
            STYLET_CONFIG_VALUE_OUT_OF_RANGE);
  EXPECT_STREQ(why.place, "obstacles");
  EXPECT_EQ(stylet_simulation_hash(simulation.get()), before);
  stylet_input in = test::to_c(inputs_at(opened->organ, Config{}, 0)[0]);
  ASSERT_EQ(stylet_simulation_tick(simulation.get(), &in, 1, nullptr, 0), STYLET_OK);
  EXPECT_EQ(stylet_simulation_set_obstacles(simulation.get(), bones.data(), 1, &why),
            STYLET_OBSTACLES_TOO_LATE);
}

// OD 0.5144 and ID 0.260 mm of steel, E pi (D^4 - d^4) / 64; a bevel tears as long as it is wide.
TEST(CNeedle, HasThePresetOfItsName) {
  stylet_needle needle;
  ASSERT_EQ(stylet_needle_init(&needle, sizeof needle), STYLET_OK);
  needle.unit_m = 3e-3F;
  needle.rods = 40;
  needle.hub = 2;
  ASSERT_EQ(stylet_needle_preset(&needle, "25G-quincke"), STYLET_OK);
  EXPECT_NEAR(static_cast<double>(needle.outer_radius_m), 0.2572e-3, 1e-9);
  EXPECT_NEAR(static_cast<double>(needle.bending_nm2) / 6.425e-4, 1, 1e-3);
  EXPECT_EQ(needle.torn_diameters, 1);
  EXPECT_EQ(needle.bevel_per_m, 5);
  EXPECT_EQ(needle.unit_m, 3e-3F);
  EXPECT_EQ(needle.rods, 40U);
  EXPECT_EQ(needle.hub, 2U);
  EXPECT_EQ(needle.bore_radius_m, 0.13e-3F);
  EXPECT_NEAR(static_cast<double>(needle.opening_m) / 0.605e-3, 1, 1e-3);  // half of 12 degrees'
  const stylet_needle before = needle;
  EXPECT_EQ(stylet_needle_preset(&needle, "25G-sharp"), STYLET_ARGUMENT_OUT_OF_RANGE);
  EXPECT_EQ(std::memcmp(&needle, &before, sizeof needle), 0);
  bool listed = false;
  std::uint32_t count = 0;
  for (; stylet_needle_preset_name(count) != nullptr; ++count) {
    const std::string name = stylet_needle_preset_name(count);
    EXPECT_EQ(stylet_needle_preset(&needle, name.c_str()), STYLET_OK);
    listed = listed || name == "25G-quincke";
  }
  EXPECT_TRUE(listed);
  EXPECT_GT(count, 30U);
}

// In memory of the caller at any address the bits are the same as in the library's own.
TEST(CSimulation, LivesInMemoryOfTheCaller) {
  const auto opened = block_organ(3, 3, 3);
  const OrganHandle organ = c_organ(*opened);
  Draw draw(4);
  const DrawnConfig config = drawn_config(draw);
  const auto needles = static_cast<std::uint32_t>(config.needles.size());
  const SimulationHandle own = c_simulation(organ.get(), config);
  std::size_t bytes = 0;
  ASSERT_EQ(stylet_simulation_bytes(organ.get(), &config.c, config.needles.data(), needles, &bytes,
                                    nullptr),
            STYLET_OK);
  for (std::size_t offset = 0; offset < 70; offset += 1 + draw.below(5)) {
    std::vector<std::byte> memory(bytes + offset + 16, std::byte{0xA5});
    stylet_simulation* made = nullptr;
    EXPECT_EQ(stylet_simulation_create_in(organ.get(), &config.c, config.needles.data(), needles,
                                          memory.data() + offset, bytes - 1, &made, nullptr),
              STYLET_MEMORY_TOO_SMALL);
    ASSERT_EQ(stylet_simulation_create_in(organ.get(), &config.c, config.needles.data(), needles,
                                          memory.data() + offset, bytes, &made, nullptr),
              STYLET_OK);
    for (std::uint64_t i = 600; i < 700; ++i) {
      std::vector<stylet_input> inputs;
      for (const Input& each : inputs_at(opened->organ, config.cpp, i)) {
        inputs.push_back(test::to_c(each));
      }
      ASSERT_EQ(stylet_simulation_tick(made, inputs.data(), needles, nullptr, 0), STYLET_OK);
      ASSERT_EQ(stylet_simulation_tick(own.get(), inputs.data(), needles, nullptr, 0), STYLET_OK);
    }
    EXPECT_EQ(stylet_simulation_hash(made), stylet_simulation_hash(own.get()));
    EXPECT_EQ(stylet_simulation_difference(made, own.get(), nullptr), nullptr);
    stylet_simulation_free(made);
    for (std::size_t i = 0; i < offset; ++i) ASSERT_EQ(memory[i], std::byte{0xA5});
    for (std::size_t i = offset + bytes; i < memory.size(); ++i) {
      ASSERT_EQ(memory[i], std::byte{0xA5});
    }
    ASSERT_EQ(stylet_simulation_reset(own.get()), STYLET_OK);
  }
}

TEST(CSimulation, CloneSnapshotAndRun) {
  const auto opened = block_organ(4, 4, 4);
  OrganHandle organ = c_organ(*opened);
  Draw draw(5);
  const DrawnConfig config = drawn_config(draw);
  const std::uint32_t needles = config.cpp.needle_count;
  const SimulationHandle first = c_simulation(organ.get(), config);
  organ.reset();  // the simulation keeps it
  std::vector<stylet_input> inputs;
  for (std::uint64_t i = 0; i < 1200; ++i) {
    for (const Input& each : inputs_at(opened->organ, config.cpp, i)) {
      inputs.push_back(test::to_c(each));
    }
  }
  const std::size_t half = inputs.size() / 2;
  std::vector<stylet_output> outputs(half);
  outputs[0].struct_bytes = sizeof outputs[0];
  ASSERT_EQ(stylet_simulation_run(first.get(), inputs.data(), outputs.data(), 600), STYLET_OK);
  EXPECT_EQ(outputs.back().tick, 600U);
  EXPECT_EQ(outputs[needles].tick, 2U);
  stylet_simulation* copy = nullptr;
  ASSERT_EQ(stylet_simulation_clone(first.get(), &copy), STYLET_OK);
  const SimulationHandle second(copy);
  std::vector<std::byte> saved(stylet_simulation_snapshot_bytes(first.get()));
  ASSERT_EQ(stylet_simulation_snapshot(first.get(), saved.data(), saved.size()), STYLET_OK);
  ASSERT_EQ(stylet_simulation_run(first.get(), &inputs[half], nullptr, 600), STYLET_OK);
  EXPECT_NE(stylet_simulation_difference(first.get(), second.get(), nullptr), nullptr);
  ASSERT_EQ(stylet_simulation_run(second.get(), &inputs[half], nullptr, 600), STYLET_OK);
  EXPECT_EQ(stylet_simulation_difference(first.get(), second.get(), nullptr), nullptr);
  const std::uint64_t end = stylet_simulation_hash(first.get());
  ASSERT_EQ(stylet_simulation_restore(first.get(), saved.data(), saved.size()), STYLET_OK);
  ASSERT_EQ(stylet_simulation_run(first.get(), &inputs[half], nullptr, 600), STYLET_OK);
  EXPECT_EQ(stylet_simulation_hash(first.get()), end);
  saved[saved.size() / 2] ^= std::byte{1};
  EXPECT_EQ(stylet_simulation_restore(first.get(), saved.data(), saved.size()),
            STYLET_SNAPSHOT_DAMAGED);
  EXPECT_EQ(stylet_simulation_hash(first.get()), end);
}

TEST(CPose, PutsTheTipWhereItIsAsked) {
  const auto opened = block_organ(3, 3, 3);
  const OrganHandle organ = c_organ(*opened);
  Draw draw(10);
  for (int i = 0; i < 50; ++i) {
    stylet_simulation* made = nullptr;
    ASSERT_EQ(stylet_simulation_create(organ.get(), nullptr, nullptr, 0, &made, nullptr),
              STYLET_OK);
    const SimulationHandle simulation(made);
    const stylet_vec3 tip = {draw.between(-0.1, 0.1), draw.between(-0.1, 0.1),
                             draw.between(0.1, 0.3)};
    const stylet_vec3 way = {draw.between(-1, 1), draw.between(-1, 1), draw.between(-1, 1)};
    const stylet_input in = {sizeof in, 1, stylet_pose_of_tip(tip, way, 0.15F), 0};
    stylet_output out = {};
    out.struct_bytes = sizeof out;
    ASSERT_EQ(stylet_simulation_tick(made, &in, 1, &out, 1), STYLET_OK);
    EXPECT_NEAR(static_cast<double>(out.tip_m.x), static_cast<double>(tip.x), 1e-6);
    EXPECT_NEAR(static_cast<double>(out.tip_m.y), static_cast<double>(tip.y), 1e-6);
    EXPECT_NEAR(static_cast<double>(out.tip_m.z), static_cast<double>(tip.z), 1e-6);
  }
}

}  // namespace
}  // namespace stylet::test
