// SPDX-License-Identifier: Apache-2.0
// Choosing the voxel edge by the cost of a tick, and what is reported about the mass in the step.
#include "report/speed.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "base/refusal.h"
#include "meshes/phantom.h"
#include "offline_support.h"
#include "random_bodies.h"
#include "session.h"
#include "voxels/sweep.h"

namespace stylet::test {
namespace {

std::filesystem::path bench_of(const Scratch& scratch, const std::string& rows) {
  return scratch.write("box.csv", "measure,organ,voxels,substeps,passes,median_us,ns\n" + rows);
}

TEST(Machine, IsThePlaneThroughTheMeasuredTicks) {
  const Scratch scratch;
  // 30 us, plus 20 ns for each voxel and substep and 3 ns for each pass: with 2 substeps of added
  // mass 1000 voxels take 70 us and 20000 voxels 830 us; with one substep, 5 passes take 65 us and
  // 7 passes 850 us.
  const auto csv = bench_of(scratch,
                            "tissue,a,1000,1,0,1,0.5\ntick_elastic_added,a,1000,2,0,70,35\n"
                            "tick_elastic_added,b,20000,2,0,830,20.75\n"
                            "tick_elastic,a,1000,1,5,65,65\ntick_elastic,b,20000,1,7,850,42\n");
  const offline::Machine machine = offline::read_machine(csv);
  EXPECT_EQ(machine.name, "box");
  EXPECT_NEAR(machine.start_us, 30, 1e-9);
  EXPECT_NEAR(machine.us_per_voxel_substep, 0.020, 1e-9);
  EXPECT_NEAR(machine.us_per_voxel_pass, 0.003, 1e-9);
  EXPECT_NEAR(offline::tick_us(machine, 5000, 4, 0), 430, 1e-6);
  EXPECT_NEAR(offline::tick_us(machine, 5000, 2, 6), 410, 1e-6);
  const auto most = [&](std::uint32_t substeps, Inertia inertia) {
    return offline::most_voxels(machine, {1e-3, substeps, inertia});
  };
  EXPECT_NEAR(most(2, Inertia::kAddedMass), 11750, 1);  // (500 - 30) / 0.04
  EXPECT_NEAR(most(1, Inertia::kTrueMass), 11463, 1);   // (500 - 30) / 0.041: of seven passes
}

TEST(Machine, RefusesFilesThatStyletBenchDidNotWrite) {
  const Scratch scratch;
  EXPECT_THAT(refusal_of([&] { offline::read_machine(bench_of(scratch, "")); }),
              testing::HasSubstr("0 rows of tick_elastic"));
  const std::string good = "tick_elastic,a,1000,1,7,70,70\n";
  EXPECT_THAT(refusal_of([&] { offline::read_machine(bench_of(scratch, good + "x\n")); }),
              testing::HasSubstr("1 rows of tick_elastic"));
  EXPECT_THAT(refusal_of([&] { offline::read_machine(bench_of(scratch, good + good + good)); }),
              testing::HasSubstr("at least two organs, with added and with true mass"));
  // The CSV as it was written before it had a column of passes.
  EXPECT_THAT(
      refusal_of([&] { offline::read_machine(bench_of(scratch, "tick_elastic,a,1,70,35\n")); }),
      testing::HasSubstr("box.csv:2: expected measure"));
  EXPECT_THAT(refusal_of([&] { offline::read_machine(bench_of(scratch, "tick_elastic,a,b\n")); }),
              testing::HasSubstr("box.csv:2: expected measure"));
  for (const char* none : {"0,1,7,70,35", "9,0,7,70,35", "9,1,-1,70,35", "9,1,7,0,35"}) {
    const std::string row = std::string("tick_elastic,a,") + none + "\n";
    EXPECT_THAT(refusal_of([&] { offline::read_machine(bench_of(scratch, row)); }),
                testing::HasSubstr("box.csv:2: expected measure"));
  }
  const offline::Machine slow = {"slow", 600, 1, 0};
  EXPECT_THAT(refusal_of([&] { (void)offline::most_voxels(slow, {}); }),
              testing::HasSubstr("room for 0 voxels on slow"));
}

TEST(Rate, HasAUnitAndALimit) {
  EXPECT_DOUBLE_EQ(offline::period_of("1kHz"), 1e-3);
  EXPECT_DOUBLE_EQ(offline::period_of("500 Hz"), 2e-3);
  EXPECT_DOUBLE_EQ(offline::period_of("2.5kHz"), 0.4e-3);
  for (const char* bad : {"", "1", "kHz", "1MHz", "99Hz", "101kHz", "nan Hz", "-1kHz"}) {
    EXPECT_THAT(refusal_of([&] { (void)offline::period_of(bad); }),
                testing::HasSubstr("expected a rate from 100 Hz to 100 kHz"))
        << bad;
  }
}

// Edges below 2.03 mm are too fine for the format, whatever their cost.
TEST(Fit, EdgesThatTheFormatCannotStoreAreNotTaken) {
  offline::BuildOptions options;
  options.most_voxels = 1000;
  const auto swept = [](double edge_m) {
    if (edge_m < 2.03e-3) throw offline::TooFine("too fine");
    return 5.0;
  };
  EXPECT_DOUBLE_EQ(offline::choose_edge({{0, 0, 0}, {0.1, 0.1, 0.1}}, options, swept), 2.05e-3);
}

// It is the finest multiple of 0.05 mm within the number of voxels; the next finer one is beyond
// it.
TEST(Fit, TakesTheFinestEdgeWithinTheVoxels) {
  const offline::Mesh ball = offline::ball_phantom(0.06, 0.003);
  for (const std::uint32_t most : {100U, 3000U, 20000U}) {
    offline::BuildOptions options;
    options.most_voxels = most;
    const offline::Built fitted = build_quietly({input_of(ball, 1)}, options);
    EXPECT_LE(offline::swept_voxels(opened(fitted.bytes)), most);
    options.most_voxels = 0;
    options.voxel_edge_m = static_cast<double>(opened(fitted.bytes).voxel_edge_m) - 5e-5;
    const offline::Built finer = build_quietly({input_of(ball, 1)}, options);
    EXPECT_GT(offline::swept_voxels(opened(finer.bytes)), most);
  }
}

// For full voxels the mass in the step is that of the stability bound (filter.h): the fastest wave,
// of squared frequency 8 k (2 + 1.5 lambda / G) / (rho h^3) with the springs of constraint
// particles, stays below 4 / (dt (dt + 2 tau)).
TEST(Mass, FactorIsThatOfTheStabilityBound) {
  offline::BuildOptions options;
  options.voxel_edge_m = 2e-3;
  const offline::Mesh block = box_mesh({0, 0, 0}, {60, 60, 60});
  const auto bytes = build_quietly({input_of(block, 1e-3, "kidney")}, options).bytes;
  const Organ organ = opened(bytes);
  const auto facts = offline::speed_facts(organ, {}, nullptr);
  const double shear = 30000 / (2 * 1.45), lambda = 2 * shear * 0.45 / 0.1, tau = 0.25e-3;
  const double fastest = 8 * shear * 2e-3 * (2 + 1.5 * lambda / shear) / (1050 * 8e-9);
  const auto limit = [&](double dt) { return 4 / (dt * (dt + 2 * tau)); };
  for (const auto& row : facts["by_substeps"]) {
    const double dt = 1e-3 / row["substeps"].get<double>(), bound = fastest / limit(dt);
    EXPECT_NEAR(row["added_mass"]["mass_factor"]["kidney"].get<double>() / std::max(1.0, bound), 1,
                1e-3)
        << dt;
    EXPECT_EQ(row["added_mass"]["passes"], 0);
    // With true mass only what seven passes leave is added. They divide by (1 + w0) T_8'(w0) /
    // (1 + T_8(w0)) = 55.27 at w0 = 1 + 1 / 64.
    EXPECT_NEAR(row["true_mass"]["mass_factor"]["kidney"].get<double>(),
                std::max(1.0, bound / 55.27), 0.01)
        << dt;
    EXPECT_EQ(row["true_mass"]["passes"] > 0, bound > 1) << dt;
  }
  const std::string text = offline::speed_text(facts);
  EXPECT_THAT(text, testing::ContainsRegex("true mass      1 substeps, 7 passes  kidney x2.07"));
  EXPECT_THAT(text, testing::ContainsRegex("added mass     1 substeps  kidney x[1-9]"));
  EXPECT_EQ(offline::inertia_text(facts), "");  // without resonance: nothing holds the body
}

// A block held from below. With two substeps of added mass a slow hand feels the mass, and this is
// reported; with true mass only a fast hand does.
TEST(Mass, TellsFromWhichFrequencyOnAHandFeelsTheStep) {
  offline::BuildOptions options;
  options.voxel_edge_m = 5e-3;
  options.held = offline::parse_regions({"z<5%"}, {1});
  const offline::Mesh block = box_mesh({0, 0, 0}, {40, 60, 80});
  const auto bytes = build_quietly({input_of(block, 1e-3, "liver")}, options).bytes;
  const Organ organ = opened(bytes);
  const auto of_added = offline::speed_facts(organ, {1e-3, 2, Inertia::kAddedMass}, nullptr);
  const auto of_real = offline::speed_facts(organ, {}, nullptr);
  const auto &added = of_added["resonance"], &real = of_real["resonance"];
  EXPECT_LT(added["stepped_hz"].get<double>(), 0.9 * added["real_hz"].get<double>());
  EXPECT_GT(real["stepped_hz"].get<double>(), 0.95 * real["real_hz"].get<double>());
  EXPECT_LT(added["departs_hz"].get<double>(), added["stepped_hz"].get<double>());
  EXPECT_GT(real.value("departs_hz", 1e3), 5 * added["departs_hz"].get<double>());
  EXPECT_THAT(offline::inertia_text(of_added),
              testing::ContainsRegex("2 substeps of added mass: first resonance .*by a tenth"));
  EXPECT_THAT(offline::inertia_text(of_real),
              testing::HasSubstr("1 substep of true mass: first resonance "));
}

// From two timed blocks the ticks of a third one of a size in between are predicted, and compared
// with this test's clock. A factor of two is left for other work of the machine and for the needle.
TEST(FitTimed, PredictsTheTicksOfThisMachine) {
  const offline::Machine here = offline::measure_machine([](const char*, double) {});
  offline::BuildOptions options;
  options.voxel_edge_m = 5e-3;
  const offline::Mesh block = box_mesh({0, 0, 0}, {105, 95, 110});
  const auto bytes = build_quietly({input_of(block, 1e-3, "liver")}, options).bytes;
  const Organ organ = opened(bytes);
  Session session = make_session(organ, Config{});
  stylet::Input hand = {};
  hand.valid = 1;
  hand.handle = {{0.05F, 0.05F, 1.0F}, {1, 0, 0, 0}};
  std::vector<double> us;
  for (int i = 0; i < 201; ++i) {
    const std::clock_t start = std::clock();  // of this process, which has one thread
    for (int k = 0; k < 5; ++k) (void)tick(session.kernel, hand);
    us.push_back(1e6 / 5 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::nth_element(us.begin(), us.begin() + 100, us.end());
  const double foretold_us =
      offline::tick_us(here, organ.voxel_count, 1, filter_passes(session.kernel));
  EXPECT_GT(us[100], 0.5 * foretold_us);
  EXPECT_LT(us[100], 2 * foretold_us);
}

// An organ itself is timed as well, besides the line through two blocks.
TEST(Fit, TimesTheOrganOnThisMachine) {
  const offline::Machine here = {"here", 30, 0.02, 0.005, true};
  offline::BuildOptions options;
  double us[2] = {};
  for (const int fine : {0, 1}) {
    options.voxel_edge_m = fine == 1 ? 3e-3 : 8e-3;
    const auto bytes =
        build_quietly({input_of(offline::ball_phantom(0.12, 0.004), 1)}, options).bytes;
    const auto facts = offline::speed_facts(opened(bytes), {}, &here);
    us[fine] = facts["timed_us"].get<double>();
    EXPECT_THAT(offline::speed_text(facts), testing::HasSubstr("; timed on this organ "));
  }
  EXPECT_GT(us[1], 3 * us[0]);  // 19 times as many voxels
  const offline::Machine elsewhere = {"elsewhere", 30, 0.02, 0.005};
  const auto bytes = build_quietly({input_of(box_mesh({0, 0, 0}, {40, 40, 40}), 1e-3)}, {}).bytes;
  EXPECT_FALSE(offline::speed_facts(opened(bytes), {}, &elsewhere).contains("timed_us"));
  // In the gap between two blocks there is nothing to insert a needle into.
  const offline::Mesh apart =
      both(box_mesh({0, 0, 0}, {20, 20, 20}), box_mesh({60, 0, 0}, {80, 20, 20}));
  const auto two = build_quietly({input_of(apart, 1e-3)}, {}).bytes;
  EXPECT_FALSE(offline::time_tick(opened(two), {}).has_value());
}

}  // namespace
}  // namespace stylet::test
