// SPDX-License-Identifier: Apache-2.0
// Callers whose structs are shorter than ours (compiled with an older header) or longer (a newer
// one): the shorter ones keep working and nothing is written behind them; the longer ones work if
// all that we do not know is zero, and are refused otherwise. Each struct is cut at every size from
// its first field.
#include <gtest/gtest.h>
#include <stylet/stylet.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace {

constexpr std::size_t kLeast = 8;  // the size, and the field beside it
constexpr std::size_t kStep = 4;   // size of most fields
// The input of 0.2.0: size, valid, pose. There was no shorter one, and none has a default pose.
constexpr std::size_t kFirstInput = 36;
constexpr std::size_t kBehind = 64;
constexpr unsigned char kCanary = 0xA5;

stylet_organ* organ() {
  stylet_organ* made = nullptr;
  stylet_refusal why = {};
  why.struct_bytes = sizeof why;
  const std::string path = STYLET_SEED_ORGAN;
  EXPECT_EQ(stylet_organ_read(path.c_str(), &made, &why), STYLET_OK) << why.text;
  return made;
}

// Memory of the caller's struct, with bytes behind it that must stay.
struct Room {
  explicit Room(std::size_t bytes) : size(bytes), block(bytes + kBehind, kCanary) {
    const auto said = static_cast<std::uint32_t>(bytes);
    std::memcpy(block.data(), &said, sizeof said);
  }
  template <typename T>
  T* as() {
    return reinterpret_cast<T*>(block.data());
  }
  bool behind_is_untouched() const {
    for (std::size_t i = size; i < block.size(); ++i) {
      if (block[i] != kCanary) return false;
    }
    return true;
  }
  std::size_t size;
  std::vector<unsigned char> block;
};

// Where the fields are that are larger than a number of four bytes.
struct Wide {
  std::size_t begin, bytes;
};
using Wides = std::vector<Wide>;

// No header had this size: a field begins before it and ends behind it, or it is no size of a
// struct.
bool cut_in_two(const Wides& wides, std::size_t bytes) {
  return bytes % kStep != 0 || std::any_of(wides.begin(), wides.end(), [&](const Wide& w) {
           return w.begin < bytes && bytes < w.begin + w.bytes;
         });
}

// A struct that a call fills, for callers with every size of it.
template <typename T>
void expect_any_size_is_filled(const Wides& wides, const std::function<stylet_status(T*)>& fill) {
  Room whole(sizeof(T));
  ASSERT_EQ(fill(whole.as<T>()), STYLET_OK);
  for (std::size_t bytes = kLeast; bytes <= sizeof(T) + 3 * kStep; ++bytes) {
    Room room(bytes);
    const bool cut = cut_in_two(wides, bytes);
    ASSERT_EQ(fill(room.as<T>()), cut ? STYLET_STRUCT_SIZE_UNKNOWN : STYLET_OK) << bytes;
    EXPECT_TRUE(room.behind_is_untouched()) << bytes;
    if (cut) continue;
    std::uint32_t said = 0;
    std::memcpy(&said, room.block.data(), sizeof said);
    EXPECT_EQ(said, bytes);
    const std::size_t known = std::min(bytes, sizeof(T));
    EXPECT_EQ(std::memcmp(room.block.data() + 4, whole.block.data() + 4, known - 4), 0) << bytes;
    for (std::size_t i = known; i < bytes; ++i) EXPECT_EQ(room.block[i], 0) << bytes;
  }
  Room unset(0);
  EXPECT_EQ(fill(unset.as<T>()), STYLET_STRUCT_SIZE_UNKNOWN);
}

// A struct that a call takes: `init` gives the defaults, `use` returns a hash of the result.
template <typename T>
void expect_any_size_is_taken(const Wides& wides,
                              const std::function<stylet_status(T*, std::size_t)>& init,
                              const std::function<stylet_status(const T*, std::uint64_t&)>& use,
                              std::size_t least = kLeast) {
  std::uint64_t expected = 0;
  Room whole(sizeof(T));
  ASSERT_EQ(init(whole.as<T>(), sizeof(T)), STYLET_OK);
  ASSERT_EQ(use(whole.as<T>(), expected), STYLET_OK);
  for (std::size_t bytes = least; bytes <= sizeof(T) + 3 * kStep; ++bytes) {
    Room room(bytes);
    std::uint64_t got = 0;
    if (cut_in_two(wides, bytes)) {
      (void)init(room.as<T>(), bytes);
      EXPECT_EQ(use(room.as<T>(), got), STYLET_STRUCT_SIZE_UNKNOWN) << bytes;
      continue;
    }
    ASSERT_EQ(init(room.as<T>(), bytes), STYLET_OK) << bytes;
    EXPECT_TRUE(room.behind_is_untouched()) << bytes;
    EXPECT_EQ(use(room.as<T>(), got), STYLET_OK) << bytes;
    EXPECT_EQ(got, expected) << bytes;
    EXPECT_TRUE(room.behind_is_untouched()) << bytes;
    if (bytes <= sizeof(T)) continue;
    room.block[bytes - 1] = 1;
    EXPECT_EQ(use(room.as<T>(), got), STYLET_STRUCT_SIZE_UNKNOWN) << bytes;
  }
  Room unset(0);
  EXPECT_EQ(use(unset.as<T>(), expected), STYLET_STRUCT_SIZE_UNKNOWN);
}

// An organ and a simulation with a needle in contact, so that filled structs are not all zero.
class Structs : public testing::Test {
 protected:
  Structs() : organ_(organ()) {
    EXPECT_EQ(stylet_simulation_create(organ_, nullptr, nullptr, 0, &simulation_, nullptr),
              STYLET_OK);
    push(200);
  }
  ~Structs() override {
    stylet_simulation_free(simulation_);
    stylet_organ_free(organ_);
  }
  Structs(const Structs&) = delete;
  Structs& operator=(const Structs&) = delete;

  static stylet_pose above(const stylet_organ* organ, float down_m) {
    stylet_organ_info info = {};
    info.struct_bytes = sizeof info;
    (void)stylet_organ_get_info(organ, &info);
    const stylet_vec3 tip = {(info.low_m.x + info.high_m.x) / 2, (info.low_m.y + info.high_m.y) / 2,
                             info.high_m.z - down_m};
    return stylet_pose_of_tip(tip, {0, 0, -1}, 0.15F);
  }
  void push(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      const stylet_input in = {sizeof in, 1, above(organ_, 1e-5F * static_cast<float>(i)), 0};
      ASSERT_EQ(stylet_simulation_tick(simulation_, &in, 1, nullptr, 0), STYLET_OK);
    }
  }

  stylet_organ* organ_;
  stylet_simulation* simulation_ = nullptr;
};

TEST_F(Structs, FilledForAnyCaller) {
  expect_any_size_is_filled<stylet_organ_info>(
      {{offsetof(stylet_organ_info, hash), sizeof stylet_organ_info::hash},
       {offsetof(stylet_organ_info, name), sizeof stylet_organ_info::name},
       {offsetof(stylet_organ_info, origin_m), sizeof stylet_organ_info::origin_m},
       {offsetof(stylet_organ_info, low_m), sizeof stylet_organ_info::low_m},
       {offsetof(stylet_organ_info, high_m), sizeof stylet_organ_info::high_m}},
      [this](stylet_organ_info* out) { return stylet_organ_get_info(organ_, out); });
  expect_any_size_is_filled<stylet_material>(
      {{offsetof(stylet_material, name), sizeof stylet_material::name},
       {offsetof(stylet_material, source), sizeof stylet_material::source}},
      [this](stylet_material* out) { return stylet_organ_get_material(organ_, 1, out); });
  expect_any_size_is_filled<stylet_stats>(
      {{offsetof(stylet_stats, ticks), sizeof stylet_stats::ticks},
       {offsetof(stylet_stats, constraint_particles), sizeof stylet_stats::constraint_particles},
       {offsetof(stylet_stats, coupled_voxels), sizeof stylet_stats::coupled_voxels},
       {offsetof(stylet_stats, tracks), sizeof stylet_stats::tracks},
       {offsetof(stylet_stats, obstacle_contacts), sizeof stylet_stats::obstacle_contacts},
       {offsetof(stylet_stats, input_not_finite), sizeof stylet_stats::input_not_finite},
       {offsetof(stylet_stats, input_clamped), sizeof stylet_stats::input_clamped},
       {offsetof(stylet_stats, input_missing), sizeof stylet_stats::input_missing},
       {offsetof(stylet_stats, cp_pool_full), sizeof stylet_stats::cp_pool_full},
       {offsetof(stylet_stats, cp_voxel_pool_full), sizeof stylet_stats::cp_voxel_pool_full},
       {offsetof(stylet_stats, contact_budget), sizeof stylet_stats::contact_budget},
       {offsetof(stylet_stats, fault), sizeof stylet_stats::fault},
       {offsetof(stylet_stats, obstacle_pool_full), sizeof stylet_stats::obstacle_pool_full},
       {offsetof(stylet_stats, needle_unstable), sizeof stylet_stats::needle_unstable}},
      [this](stylet_stats* out) { return stylet_simulation_get_stats(simulation_, out); });
  expect_any_size_is_filled<stylet_energy>(
      {{offsetof(stylet_energy, elastic_j), sizeof stylet_energy::elastic_j},
       {offsetof(stylet_energy, kinetic_j), sizeof stylet_energy::kinetic_j},
       {offsetof(stylet_energy, coupling_j), sizeof stylet_energy::coupling_j},
       {offsetof(stylet_energy, bending_j), sizeof stylet_energy::bending_j},
       {offsetof(stylet_energy, work_by_hand_j), sizeof stylet_energy::work_by_hand_j},
       {offsetof(stylet_energy, friction_j), sizeof stylet_energy::friction_j},
       {offsetof(stylet_energy, cutting_j), sizeof stylet_energy::cutting_j},
       {offsetof(stylet_energy, relaxation_j), sizeof stylet_energy::relaxation_j},
       {offsetof(stylet_energy, obstacles_j), sizeof stylet_energy::obstacles_j},
       {offsetof(stylet_energy, sliding_j), sizeof stylet_energy::sliding_j}},
      [this](stylet_energy* out) { return stylet_simulation_get_energy(simulation_, out); });
  expect_any_size_is_filled<stylet_output>(
      {{offsetof(stylet_output, tick), sizeof stylet_output::tick},
       {offsetof(stylet_output, force_n), sizeof stylet_output::force_n},
       {offsetof(stylet_output, torque_nm), sizeof stylet_output::torque_nm},
       {offsetof(stylet_output, stiffness_n), sizeof stylet_output::stiffness_n},
       {offsetof(stylet_output, cutting_n), sizeof stylet_output::cutting_n},
       {offsetof(stylet_output, friction_n), sizeof stylet_output::friction_n},
       {offsetof(stylet_output, clamping_n), sizeof stylet_output::clamping_n},
       {offsetof(stylet_output, obstacle_n), sizeof stylet_output::obstacle_n},
       {offsetof(stylet_output, tip_m), sizeof stylet_output::tip_m}},
      [this](stylet_output* out) {
        stylet_simulation* same = nullptr;
        (void)stylet_simulation_clone(simulation_, &same);
        const stylet_input in = {sizeof in, 1, above(organ_, 3e-3F), 0};
        const stylet_status status = stylet_simulation_tick(same, &in, 1, out, 1);
        stylet_simulation_free(same);
        return status;
      });
}

TEST_F(Structs, ConfigurationTakenFromAnyCaller) {
  expect_any_size_is_taken<stylet_config>(
      {{offsetof(stylet_config, breathing_amplitude_m),
        sizeof stylet_config::breathing_amplitude_m},
       {offsetof(stylet_config, gravity_m_per_s2), sizeof stylet_config::gravity_m_per_s2}},
      stylet_config_init, [this](const stylet_config* config, std::uint64_t& hash_out) {
        stylet_simulation* made = nullptr;
        const stylet_status status =
            stylet_simulation_create(organ_, config, nullptr, 0, &made, nullptr);
        hash_out = stylet_simulation_hash(made);
        stylet_simulation_free(made);
        return status;
      });
  expect_any_size_is_taken<stylet_needle>(
      {}, stylet_needle_init, [this](const stylet_needle* needle, std::uint64_t& hash_out) {
        stylet_simulation* made = nullptr;
        const stylet_status status =
            stylet_simulation_create(organ_, nullptr, needle, 1, &made, nullptr);
        hash_out = stylet_simulation_hash(made);
        stylet_simulation_free(made);
        return status;
      });
}

TEST_F(Structs, InputTakenFromAnyCaller) {
  const auto init = [this](stylet_input* in, std::size_t bytes) -> stylet_status {
    const stylet_input whole = {static_cast<std::uint32_t>(bytes), 0, above(organ_, 0), 0};
    std::memset(static_cast<void*>(in), 0, bytes);
    std::memcpy(static_cast<void*>(in), &whole, std::min(bytes, sizeof whole));
    return STYLET_OK;
  };
  expect_any_size_is_taken<stylet_input>(
      {{offsetof(stylet_input, handle), sizeof stylet_input::handle}}, init,
      [this](const stylet_input* in, std::uint64_t& hash_out) {
        stylet_simulation* same = nullptr;
        (void)stylet_simulation_clone(simulation_, &same);
        const stylet_status status = stylet_simulation_tick(same, in, 1, nullptr, 0);
        hash_out = stylet_simulation_hash(same);
        stylet_simulation_free(same);
        return status;
      },
      kFirstInput);
  Room shorter(kFirstInput - kStep);
  ASSERT_EQ(init(shorter.as<stylet_input>(), shorter.size), STYLET_OK);
  EXPECT_EQ(stylet_simulation_tick(simulation_, shorter.as<stylet_input>(), 1, nullptr, 0),
            STYLET_STRUCT_SIZE_UNKNOWN);
}

// The refusal is a struct of the caller's size, too.
TEST_F(Structs, RefusalGivenToAnyCaller) {
  stylet_needle needle;
  ASSERT_EQ(stylet_needle_init(&needle, sizeof needle), STYLET_OK);
  needle.length_m = -1;
  const Wides wides = {{offsetof(stylet_refusal, place), sizeof stylet_refusal::place},
                       {offsetof(stylet_refusal, index), sizeof stylet_refusal::index},
                       {offsetof(stylet_refusal, value), sizeof stylet_refusal::value},
                       {offsetof(stylet_refusal, least), sizeof stylet_refusal::least},
                       {offsetof(stylet_refusal, most), sizeof stylet_refusal::most},
                       {offsetof(stylet_refusal, expected), sizeof stylet_refusal::expected},
                       {offsetof(stylet_refusal, text), sizeof stylet_refusal::text}};
  for (std::size_t bytes = kLeast; bytes <= sizeof(stylet_refusal) + 8; ++bytes) {
    Room room(bytes);
    stylet_simulation* made = nullptr;
    EXPECT_EQ(
        stylet_simulation_create(organ_, nullptr, &needle, 1, &made, room.as<stylet_refusal>()),
        STYLET_CONFIG_VALUE_OUT_OF_RANGE);
    EXPECT_EQ(made, nullptr);
    EXPECT_TRUE(room.behind_is_untouched()) << bytes;
    stylet_status said = 0;
    std::memcpy(&said, room.block.data() + 4, sizeof said);
    if (cut_in_two(wides, bytes)) {
      EXPECT_EQ(said, kCanary | kCanary << 8U) << bytes;  // left untouched
    } else {
      EXPECT_EQ(said, STYLET_CONFIG_VALUE_OUT_OF_RANGE) << bytes;
    }
  }
}

// A value beyond its limits is reported with the name that the caller's struct has for it; for a
// vector the message says that its length is meant.
TEST_F(Structs, RefusalsNameVectors) {
  stylet_refusal why = {};
  why.struct_bytes = sizeof why;
  stylet_simulation* fresh_one = nullptr;
  ASSERT_EQ(stylet_simulation_create(organ_, nullptr, nullptr, 0, &fresh_one, nullptr), STYLET_OK);
  const auto expect = [&](const stylet_config* config, const stylet_obstacle* obstacle,
                          const char* place, const char* text) {
    stylet_simulation* made = nullptr;
    if (config != nullptr) {
      EXPECT_EQ(stylet_simulation_create(organ_, config, nullptr, 0, &made, &why),
                STYLET_CONFIG_VALUE_OUT_OF_RANGE);
    } else {
      EXPECT_EQ(stylet_simulation_set_obstacles(fresh_one, obstacle, 1, &why),
                STYLET_CONFIG_VALUE_OUT_OF_RANGE);
    }
    EXPECT_STREQ(why.place, place);
    EXPECT_EQ(std::string(why.text).rfind(text, 0), 0U) << why.text;
  };
  stylet_config config;
  ASSERT_EQ(stylet_config_init(&config, sizeof config), STYLET_OK);
  config.breathing_amplitude_m = {3, 0, 4};
  expect(&config, nullptr, "breathing_amplitude_m", "breathing_amplitude_m: length 5: expected");
  config.breathing_amplitude_m = {0, 0, 0};
  config.breathing_period_s = -2;
  expect(&config, nullptr, "breathing_period_s", "breathing_period_s: -2: expected");
  stylet_obstacle obstacle;
  const auto fresh = [&] {
    ASSERT_EQ(stylet_obstacle_init(&obstacle, sizeof obstacle), STYLET_OK);
  };
  fresh();
  ASSERT_EQ(stylet_obstacle_box(&obstacle, {0.01F, 0.01F, 0.01F}), STYLET_OK);
  obstacle.vertices_m[5] = {0, 3e8F, 4e8F};
  expect(nullptr, &obstacle, "obstacle.vertices_m",
         "obstacle.vertices_m [0]: vertex 5: length 5e+08: expected");
  fresh();
  obstacle.pose.position_m = {6e8F, 0, 8e8F};
  expect(nullptr, &obstacle, "obstacle.pose.position_m",
         "obstacle.pose.position_m [0]: length 1e+09: expected");
  fresh();
  obstacle.pose.rotation = {2, 0, 0, 0};
  expect(nullptr, &obstacle, "obstacle.pose.rotation",
         "obstacle.pose.rotation [0]: length squared 4: expected");
  stylet_simulation_free(fresh_one);
}

// Whatever is refused says where, what was given and what was expected.
TEST_F(Structs, RefusalsSayPlaceAndValue) {
  stylet_refusal why = {};
  why.struct_bytes = sizeof why;
  const auto expect = [&](stylet_status status, stylet_status expected, const char* place,
                          double value, std::uint64_t index, const std::string& text) {
    EXPECT_EQ(status, expected);
    EXPECT_EQ(why.status, expected);
    EXPECT_STREQ(why.place, place);
    EXPECT_EQ(why.value, value) << place;
    EXPECT_EQ(why.index, index) << place;
    EXPECT_STRNE(why.expected, "") << place;
    EXPECT_EQ(why.text, text);
  };
  stylet_simulation* made = nullptr;
  expect(stylet_simulation_create(nullptr, nullptr, nullptr, 0, &made, &why),
         STYLET_ARGUMENT_MISSING, "organ", 0, 0, "organ: null: expected a pointer");
  expect(stylet_simulation_create(organ_, nullptr, nullptr, 2, &made, &why),
         STYLET_ARGUMENT_MISSING, "needles", 0, 0, "needles: null: expected a pointer");

  stylet_config config = {};
  config.struct_bytes = 7;
  expect(
      stylet_simulation_create(organ_, &config, nullptr, 0, &made, &why),
      STYLET_STRUCT_SIZE_UNKNOWN, "config.struct_bytes", 7, 0,
      "config.struct_bytes: 7: expected sizeof the struct, here " + std::to_string(sizeof config));
  struct Longer {
    stylet_needle known;
    std::uint32_t beyond;
  };
  std::array<Longer, 2> needles = {};
  for (Longer& each : needles) {
    ASSERT_EQ(stylet_needle_init(&each.known, sizeof each), STYLET_OK);
  }
  needles[1].beyond = 1;
  expect(stylet_simulation_create(organ_, nullptr, &needles[0].known, 2, &made, &why),
         STYLET_STRUCT_SIZE_UNKNOWN, "needle.struct_bytes", sizeof(Longer), 1,
         "needle.struct_bytes [1]: " + std::to_string(sizeof(Longer)) +
             ": expected sizeof the struct, here " + std::to_string(sizeof(stylet_needle)) +
             ", and zeros behind that");

  std::array<char, 100> memory = {};
  expect(stylet_simulation_create_in(organ_, nullptr, nullptr, 0, memory.data(), memory.size(),
                                     &made, &why),
         STYLET_MEMORY_TOO_SMALL, "bytes", 100, 0,
         "bytes: 100: expected what stylet_simulation_bytes says, or more");

  ASSERT_EQ(stylet_simulation_create(organ_, nullptr, nullptr, 0, &made, &why), STYLET_OK);
  for (int i = 0; i < 3; ++i) (void)stylet_simulation_tick(made, nullptr, 0, nullptr, 0);
  expect(stylet_simulation_set_obstacles(made, nullptr, 0, &why), STYLET_OBSTACLES_TOO_LATE,
         "obstacles", 3, 0,
         "obstacles: 3: expected 0 ticks: obstacles are set before the first tick, or after a "
         "reset");
  stylet_simulation_free(made);
  expect(stylet_simulation_set_obstacles(nullptr, nullptr, 0, &why), STYLET_ARGUMENT_MISSING,
         "simulation", 0, 0, "simulation: null: expected a pointer");
}

// Elements are as far apart as the caller's struct is long, not as ours.
TEST_F(Structs, ArraysOfAnyCaller) {
  constexpr std::size_t kOld = 12;  // length and radius alone
  std::vector<unsigned char> needles(2 * kOld + kBehind, kCanary);
  for (std::size_t i = 0; i < 2; ++i) {
    auto* const each = reinterpret_cast<stylet_needle*>(needles.data() + i * kOld);
    ASSERT_EQ(stylet_needle_init(each, kOld), STYLET_OK);
    const float length_m = i == 0 ? 0.1F : 0.2F;
    std::memcpy(needles.data() + i * kOld + 4, &length_m, sizeof length_m);
  }
  stylet_simulation* old = nullptr;
  ASSERT_EQ(
      stylet_simulation_create(organ_, nullptr, reinterpret_cast<stylet_needle*>(needles.data()), 2,
                               &old, nullptr),
      STYLET_OK);
  std::vector<stylet_needle> whole(2);
  for (stylet_needle& each : whole) (void)stylet_needle_init(&each, sizeof each);
  whole[0].length_m = 0.1F;
  whole[1].length_m = 0.2F;
  stylet_simulation* now = nullptr;
  ASSERT_EQ(stylet_simulation_create(organ_, nullptr, whole.data(), 2, &now, nullptr), STYLET_OK);
  EXPECT_EQ(stylet_simulation_difference(old, now, nullptr), nullptr);
  stylet_simulation_free(old);
  stylet_simulation_free(now);
}

}  // namespace
