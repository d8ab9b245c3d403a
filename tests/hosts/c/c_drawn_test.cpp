// SPDX-License-Identifier: Apache-2.0
// Every function of the interface with random arguments: null, impossible sizes of structs, numbers
// that are not finite, counts beyond all bounds, handles of other objects. A call does its work or
// says why not; a refused call leaves everything as it was, and a sanitizer checks that no memory
// beyond what was given is touched. Handles that were freed are left out: the caller must know
// them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "c_support.h"

namespace stylet::test {
namespace {

constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();
constexpr std::int64_t kLatest = std::numeric_limits<std::int64_t>::max();

template <typename T>
T pick(Draw& draw, std::initializer_list<T> from) {
  return from.begin()[draw.below(static_cast<std::uint32_t>(from.size()))];
}

float odd(Draw& draw) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (draw.chance(0.3)) return draw.between(-0.2, 0.2);
  return pick(draw, {0.0F, -0.0F, NAN, kInfinity, -kInfinity, 3e38F, -3e38F, 1e-40F, 1.0F, -1.0F});
}
stylet_vec3 odd_vector(Draw& draw) {
  return {odd(draw), odd(draw), odd(draw)};
}
std::uint32_t odd_count(Draw& draw) {
  return pick(draw, {0U, 1U, 2U, 3U, 4U, 5U, 16U, 17U, 64U, 129U, 1U << 31U, kMost});
}
std::int64_t odd_time(Draw& draw) {
  if (draw.chance(0.6)) return static_cast<std::int64_t>(draw.below(50)) * 1'000'000;
  return pick<std::int64_t>(draw, {0, -1, 1, kLatest, -kLatest - 1, kLatest / 2, -kLatest / 2});
}
stylet_pose odd_pose(Draw& draw) {
  if (draw.chance(0.5)) return stylet_pose_of_tip({0, 0, draw.between(-0.02, 0.05)}, {}, 0.15F);
  return {odd_vector(draw), {odd(draw), odd(draw), odd(draw), odd(draw)}};
}
template <typename T>
T* or_null(Draw& draw, T* pointer) {
  return draw.chance(0.1) ? nullptr : pointer;
}

template <typename T>
std::uint32_t odd_size(Draw& draw) {
  constexpr auto kOwn = static_cast<std::uint32_t>(sizeof(T));
  if (draw.chance(0.7)) return kOwn;
  return pick(draw, {0U, 1U, 4U, 7U, 8U, 12U, kOwn - 4, kOwn - 1, kOwn + 1, kOwn + 4, kOwn + 16,
                     4 * draw.below(kOwn / 4), 65'536U, 65'540U, kMost});
}

// An array of structs with the size that its first one gives, in memory of exactly that size. Some
// words behind `first` are replaced by other numbers.
template <typename T>
class Rows {
 public:
  Rows(Draw& draw, std::uint32_t count, const T& like, std::size_t first = 4)
      : size_(odd_size<T>(draw)), count_(count), null_(draw.chance(0.08)) {
    const std::size_t stride = size_ > 65'536 ? 4 : std::max<std::size_t>(size_, 4);
    bytes_ = std::make_unique<unsigned char[]>(stride * std::max(count, 1U));
    for (std::uint32_t i = 0; i < count; ++i) {
      T each = like;
      each.struct_bytes = size_;
      for (std::size_t at = first; draw.chance(0.4) && at + 4 <= sizeof(T); at += 4) {
        if (draw.chance(0.7)) continue;
        const float number = odd(draw);
        const std::uint32_t whole = odd_count(draw);
        const void* const from = draw.chance(0.5) ? static_cast<const void*>(&number) : &whole;
        std::memcpy(reinterpret_cast<unsigned char*>(&each) + at, from, 4);
      }
      std::memcpy(&bytes_[i * stride], &each, std::min(stride, sizeof(T)));
    }
  }
  T* get() { return null_ ? nullptr : reinterpret_cast<T*>(bytes_.get()); }
  bool whole() const { return !null_ && size_ == sizeof(T); }
  // A struct that should have been filled and was not.
  void expect_empty() const {
    if (!whole()) return;
    for (std::size_t i = 0; i < sizeof(T) * count_; ++i) {
      ASSERT_TRUE(i % sizeof(T) < 4 || bytes_[i] == 0) << "byte " << i;
    }
  }

 private:
  std::uint32_t size_, count_;
  bool null_;
  std::unique_ptr<unsigned char[]> bytes_;
};

template <typename T>
Rows<T> to_fill(Draw& draw, std::uint32_t count = 1) {
  T like;
  std::memset(&like, 0x5A, sizeof like);
  return Rows<T>(draw, count, like, sizeof(T));
}

template <typename T, stylet_status (*kInit)(T*, std::size_t)>
T defaults() {
  T out;
  EXPECT_EQ(kInit(&out, sizeof out), STYLET_OK);
  return out;
}
stylet_guard_config guard_defaults() {
  return defaults<stylet_guard_config, stylet_guard_config_init>();
}

void expect_known(stylet_status status) {
  ASSERT_STRNE(stylet_status_name(status), stylet_status_name(9999)) << status;
}

void expect_ok(stylet_status status) {
  EXPECT_EQ(status, STYLET_OK) << stylet_status_name(status);
}

// A refusal that may be null or of another size. It must agree with the status.
class Why {
 public:
  explicit Why(Draw& draw) : rows_(to_fill<stylet_refusal>(draw)) {}
  stylet_refusal* out() { return rows_.get(); }
  void expect(stylet_status status) {
    expect_known(status);
    if (!rows_.whole()) return;
    EXPECT_EQ(rows_.get()->status, status);
    EXPECT_EQ(rows_.get()->text[0] == '\0', status == STYLET_OK);
  }

 private:
  Rows<stylet_refusal> rows_;
};

int read_hand(void* self, std::int64_t now_ns, stylet_sample* out) {
  Draw& draw = *static_cast<Draw*>(self);
  out->seq = draw.chance(0.9) ? static_cast<std::uint64_t>(now_ns) : draw.below(3);
  out->t_ns = draw.chance(0.9) ? now_ns : odd_time(draw);
  out->pose = draw.chance(0.9) ? stylet_pose{{0, 0, 0}, {1, 0, 0, 0}} : odd_pose(draw);
  out->buttons = draw.below(4);
  return draw.chance(0.95) ? 1 : 0;
}
void write_hand(void* /*self*/, const stylet_command* command) {
  ASSERT_TRUE(std::isfinite(command->force_n.x + command->force_n.y + command->force_n.z));
}

// Objects of all kinds, and a loop that has ended with what belongs to it.
struct World {
  explicit World(std::uint64_t seed) : draw(seed), hand(seed + 1) {
    organs = {nullptr, c_organ(*block_organ(4, 4, 4)).release(),
              c_organ(*block_organ(2, 3, 5)).release()};
    for (std::uint32_t needles : {1U, 2U}) {
      stylet_simulation* made = nullptr;
      const std::vector<stylet_needle> all(needles, defaults<stylet_needle, stylet_needle_init>());
      EXPECT_EQ(stylet_simulation_create(organs[1], nullptr, all.data(), needles, &made, nullptr),
                STYLET_OK);
      simulations.push_back(made);
    }
    simulations.push_back(nullptr);
    EXPECT_EQ(stylet_guard_create(nullptr, &guards[1], nullptr), STYLET_OK);
    EXPECT_EQ(stylet_batch_create(simulations.data(), 2, 2, &batches[1]), STYLET_OK);
    EXPECT_EQ(stylet_simulation_clone(simulations[0], &held), STYLET_OK);
    EXPECT_EQ(stylet_device_simulated(0.01F, 0.1F, 0, &taken), STYLET_OK);
    stylet_loop_config short_run = defaults<stylet_loop_config, stylet_loop_config_init>();
    short_run.virtual_time = 1;
    short_run.priority = 0;
    short_run.ticks = 30;
    EXPECT_EQ(stylet_loop_create(held, &short_run, &taken, nullptr, nullptr, &loops[1], nullptr),
              STYLET_OK);
    EXPECT_EQ(stylet_loop_run(loops[1]), STYLET_OK);
    simulations.push_back(held);
  }
  ~World() {
    stylet_loop_free(loops[1]);
    stylet_batch_free(batches[1]);
    stylet_guard_free(guards[1]);
    for (stylet_simulation* each : simulations) stylet_simulation_free(each);
    for (stylet_organ* each : organs) stylet_organ_free(each);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  template <typename T>
  T* any(const std::vector<T*>& from) {
    return from[draw.below(static_cast<std::uint32_t>(from.size()))];
  }
  stylet_organ* organ() { return any(organs); }
  stylet_simulation* simulation() { return any(simulations); }
  stylet_guard* guard() { return any(guards); }
  stylet_batch* batch() { return any(batches); }
  stylet_loop* loop() { return any(loops); }

  std::uint64_t hash() const {
    return stylet_simulation_hash(simulations[0]) ^ 3 * stylet_simulation_hash(simulations[1]);
  }
  // Judges a call that returns a status and may change a simulation.
  template <typename Call>
  stylet_status unless_refused(const Call& call) {
    const std::uint64_t before = hash();
    const stylet_status status = call();
    expect_known(status);
    if (status != STYLET_OK) {
      EXPECT_EQ(hash(), before);
    }
    return status;
  }
  // Judges an array of the caller: as many elements are filled as the call says, or none.
  template <typename T, typename Ask>
  void copy(const Ask& ask) {
    const std::uint32_t all = ask(static_cast<T*>(nullptr), 0U);
    const std::uint32_t fits = draw.chance(0.5) ? all : draw.below(all + 1);
    const std::unique_ptr<T[]> room(new T[fits]);
    EXPECT_LE(ask(room.get(), fits), std::max(all, fits));
    const std::unique_ptr<T[]> whole(new T[all]);
    EXPECT_LE(ask(whole.get(), all == 0 ? 0 : pick(draw, {all, kMost})), std::max(all, 64U));
  }

  Draw draw, hand;
  std::vector<stylet_organ*> organs;
  std::vector<stylet_simulation*> simulations;
  std::vector<stylet_guard*> guards = {nullptr, nullptr};
  std::vector<stylet_batch*> batches = {nullptr, nullptr};
  std::vector<stylet_loop*> loops = {nullptr, nullptr};
  stylet_simulation* held = nullptr;
  stylet_device* taken = nullptr;
};

using Call = std::function<void(World&)>;
using Calls = std::map<std::string, Call>;

template <typename T, typename Use>
void fill(World& w, const Use& use) {
  Rows<T> out = to_fill<T>(w.draw);
  const stylet_status status = use(out.get());
  expect_known(status);
  if (status != STYLET_OK) out.expect_empty();
}

void add_organs(Calls& calls) {
  calls["stylet_organ_read"] = [](World& w) {
    stylet_organ* made = w.organs[1];
    Why why(w.draw);
    const std::string longest(70'000, 'x');
    const char* const path = pick<const char*>(
        w.draw, {"", "/", "/dev/null", "/proc/self/mem", "no such file", longest.c_str(), nullptr});
    const stylet_status status = stylet_organ_read(path, or_null(w.draw, &made), why.out());
    EXPECT_NE(status, STYLET_OK);
    EXPECT_TRUE(made == nullptr || made == w.organs[1]);
    why.expect(status);
  };
  calls["stylet_organ_from_bytes"] = [](World& w) {
    std::vector<std::byte> bytes = block_organ(2, 2, 2)->bytes;
    if (w.draw.chance(0.3)) bytes.resize(w.draw.below(static_cast<std::uint32_t>(bytes.size())));
    for (int i = 0; i < 3 && !bytes.empty() && w.draw.chance(0.3); ++i) {
      bytes[w.draw.below(static_cast<std::uint32_t>(bytes.size()))] ^= std::byte{0x41};
    }
    const std::size_t count = pick(w.draw, {bytes.size(), bytes.size(), SIZE_MAX, SIZE_MAX - 63,
                                            SIZE_MAX / 2 + 1, std::size_t{0}});
    stylet_organ* made = nullptr;
    Why why(w.draw);
    why.expect(stylet_organ_from_bytes(or_null(w.draw, bytes.data()), count, or_null(w.draw, &made),
                                       why.out()));
    stylet_organ_free(made);
  };
  calls["stylet_organ_free"] = [](World&) { stylet_organ_free(nullptr); };
}

void add_what_organs_tell(Calls& calls) {
  calls["stylet_organ_get_info"] = [](World& w) {
    fill<stylet_organ_info>(w, [&](auto* out) { return stylet_organ_get_info(w.organ(), out); });
  };
  calls["stylet_organ_get_material"] = [](World& w) {
    fill<stylet_material>(
        w, [&](auto* out) { return stylet_organ_get_material(w.organ(), odd_count(w.draw), out); });
  };
  calls["stylet_organ_voxels"] = [](World& w) {
    const stylet_organ* const o = w.organ();
    w.copy<stylet_voxel>([&](auto* out, auto n) { return stylet_organ_voxels(o, out, n); });
  };
  calls["stylet_organ_cubes"] = [](World& w) {
    const stylet_organ* const o = w.organ();
    w.copy<stylet_cube>([&](auto* out, auto n) { return stylet_organ_cubes(o, out, n); });
  };
  calls["stylet_organ_triangles"] = [](World& w) {
    struct Triangle {
      std::uint32_t corner[3];
    };
    const stylet_organ* const o = w.organ();
    w.copy<Triangle>([&](auto* out, auto n) {
      return stylet_organ_triangles(o, out == nullptr ? nullptr : out->corner, n);
    });
  };
  calls["stylet_organ_vertices"] = [](World& w) {
    const stylet_organ* const o = w.organ();
    w.copy<stylet_vec3>([&](auto* out, auto n) { return stylet_organ_vertices(o, out, n); });
  };
  calls["stylet_organ_vertex_materials"] = [](World& w) {
    const stylet_organ* const o = w.organ();
    w.copy<std::uint8_t>(
        [&](auto* out, auto n) { return stylet_organ_vertex_materials(o, out, n); });
  };
  calls["stylet_organ_raycast"] = [](World& w) {
    float distance_m = NAN;
    const int hit = stylet_organ_raycast(w.organ(), odd_vector(w.draw), odd_vector(w.draw),
                                         w.draw.chance(0.9) ? &distance_m : nullptr);
    EXPECT_TRUE(std::isnan(distance_m) || (std::isfinite(distance_m) && (hit == 1 || hit == 0)));
  };
}

// Configuration and needles: the arguments of creation, and of the question how much memory it
// needs.
struct Wanted {
  explicit Wanted(Draw& draw)
      : config(draw, 1, defaults<stylet_config, stylet_config_init>()),
        count(draw.chance(0.8) ? draw.below(4) : odd_count(draw)),
        needles(draw, std::min(count, 5U), defaults<stylet_needle, stylet_needle_init>()) {}
  Rows<stylet_config> config;
  std::uint32_t count;
  Rows<stylet_needle> needles;
};

void add_needles(Calls& calls) {
  calls["stylet_needle_preset"] = [](World& w) {
    Rows<stylet_needle> of(w.draw, 1, defaults<stylet_needle, stylet_needle_init>());
    const std::array<const char*, 4> names = {"22G-quincke", "trocar-3mm", "", nullptr};
    expect_known(stylet_needle_preset(of.get(), names[w.draw.below(4)]));
  };
  calls["stylet_needle_preset_name"] = [](World& w) {
    const char* const name = stylet_needle_preset_name(w.draw.below(100));
    stylet_needle needle;
    ASSERT_EQ(stylet_needle_init(&needle, sizeof needle), STYLET_OK);
    EXPECT_EQ(stylet_needle_preset(&needle, name),
              name != nullptr ? STYLET_OK : STYLET_ARGUMENT_MISSING);
  };
}

void add_creation(Calls& calls) {
  calls["stylet_config_init"] = [](World& w) {
    Rows<stylet_config> of = to_fill<stylet_config>(w.draw);
    expect_known(stylet_config_init(of.get(), of.whole() ? sizeof(stylet_config) : SIZE_MAX));
  };
  calls["stylet_needle_init"] = [](World& w) {
    Rows<stylet_needle> of = to_fill<stylet_needle>(w.draw);
    expect_known(stylet_needle_init(of.get(), of.whole() ? sizeof(stylet_needle) : 65'540));
  };
  calls["stylet_obstacle_init"] = [](World& w) {
    Rows<stylet_obstacle> of = to_fill<stylet_obstacle>(w.draw);
    expect_known(stylet_obstacle_init(of.get(), of.whole() ? sizeof(stylet_obstacle) : 0));
  };
  calls["stylet_obstacle_box"] = [](World& w) {
    Rows<stylet_obstacle> of(w.draw, 1, defaults<stylet_obstacle, stylet_obstacle_init>());
    expect_known(stylet_obstacle_box(of.get(), odd_vector(w.draw)));
  };
  calls["stylet_obstacle_sphere"] = [](World& w) {
    Rows<stylet_obstacle> of(w.draw, 1, defaults<stylet_obstacle, stylet_obstacle_init>());
    expect_known(stylet_obstacle_sphere(of.get(), odd(w.draw)));
  };
  calls["stylet_simulation_create"] = [](World& w) {
    Wanted of(w.draw);
    Why why(w.draw);
    stylet_simulation* made = w.simulations[0];
    const stylet_status status = stylet_simulation_create(
        w.organ(), of.config.get(), of.needles.get(), of.count, or_null(w.draw, &made), why.out());
    why.expect(status);
    if (made == w.simulations[0]) return;
    EXPECT_EQ(made != nullptr, status == STYLET_OK);
    EXPECT_EQ(stylet_simulation_run(made, nullptr, nullptr, 0), made == nullptr ? 400 : 0);
    stylet_simulation_free(made);
  };
  calls["stylet_simulation_bytes"] = [](World& w) {
    Wanted of(w.draw);
    Why why(w.draw);
    std::size_t bytes = 7;
    const stylet_status status = stylet_simulation_bytes(
        w.organ(), of.config.get(), of.needles.get(), of.count, or_null(w.draw, &bytes), why.out());
    why.expect(status);
    EXPECT_TRUE(bytes == 7 || (bytes > 0) == (status == STYLET_OK));
  };
  calls["stylet_simulation_create_in"] = [](World& w) {
    Wanted of(w.draw);
    Why why(w.draw);
    stylet_organ* const organ = w.organ();
    std::size_t need = 0;
    (void)stylet_simulation_bytes(organ, of.config.get(), of.needles.get(), of.count, &need,
                                  nullptr);
    const std::size_t off = w.draw.below(70);
    const std::vector<unsigned char> memory(need + off);
    const std::size_t told = pick(w.draw, {need, need, need, need - 1, std::size_t{0}});
    stylet_simulation* made = nullptr;
    why.expect(stylet_simulation_create_in(
        organ, of.config.get(), of.needles.get(), of.count,
        or_null(w.draw, const_cast<unsigned char*>(memory.data() + off)), need == 0 ? 0 : told,
        &made, why.out()));
    stylet_simulation_free(made);
  };
  calls["stylet_simulation_clone"] = [](World& w) {
    stylet_simulation* made = nullptr;
    stylet_simulation* const from = w.simulation();
    const stylet_status status = stylet_simulation_clone(from, or_null(w.draw, &made));
    expect_known(status);
    EXPECT_EQ(stylet_simulation_hash(made), status == STYLET_OK ? stylet_simulation_hash(from) : 0);
    stylet_simulation_free(made);
  };
  calls["stylet_simulation_free"] = [](World&) { stylet_simulation_free(nullptr); };
}

void add_ticks(Calls& calls) {
  calls["stylet_simulation_set_obstacles"] = [](World& w) {
    const std::uint32_t count = w.draw.chance(0.8) ? w.draw.below(4) : odd_count(w.draw);
    Rows<stylet_obstacle> of(w.draw, std::min(count, 16U),
                             defaults<stylet_obstacle, stylet_obstacle_init>());
    Why why(w.draw);
    why.expect(w.unless_refused([&] {
      return stylet_simulation_set_obstacles(w.simulation(), of.get(), count, why.out());
    }));
  };
  calls["stylet_simulation_reset"] = [](World& w) {
    if (w.draw.chance(0.2))
      w.unless_refused([&] { return stylet_simulation_reset(w.simulation()); });
  };
  calls["stylet_simulation_tick"] = [](World& w) {
    const std::uint32_t in_count = w.draw.chance(0.8) ? w.draw.below(3) : odd_count(w.draw);
    const std::uint32_t out_count = w.draw.chance(0.8) ? w.draw.below(3) : odd_count(w.draw);
    Rows<stylet_input> in(w.draw, std::min(in_count, 4U),
                          {0, 1, odd_pose(w.draw), w.draw.between(-300, 300)});
    Rows<stylet_output> out = to_fill<stylet_output>(w.draw, std::min(out_count, 4U));
    const stylet_status status = w.unless_refused([&] {
      return stylet_simulation_tick(w.simulation(), in.get(), in_count, out.get(), out_count);
    });
    if (status != STYLET_OK) out.expect_empty();
  };
  calls["stylet_simulation_run"] = [](World& w) {
    stylet_simulation* const of = w.simulation();
    const std::uint32_t ticks = w.draw.below(5);
    const std::uint32_t rows = ticks * stylet_simulation_needles(of);
    Rows<stylet_input> in(w.draw, rows, {0, 1, odd_pose(w.draw), w.draw.between(-300, 300)});
    Rows<stylet_output> out = to_fill<stylet_output>(w.draw, rows);
    const stylet_status status =
        w.unless_refused([&] { return stylet_simulation_run(of, in.get(), out.get(), ticks); });
    if (status != STYLET_OK) out.expect_empty();
  };
  calls["stylet_pose_of_tip"] = [](World& w) {
    const stylet_pose p = stylet_pose_of_tip({0, 0, 0}, odd_vector(w.draw), odd(w.draw));
    const stylet_quat q = p.rotation;
    EXPECT_NEAR(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z, 1, 1e-5);
  };
}

void add_states(Calls& calls) {
  calls["stylet_simulation_hash"] = [](World& w) { (void)stylet_simulation_hash(w.simulation()); };
  calls["stylet_simulation_snapshot_bytes"] = [](World& w) {
    (void)stylet_simulation_snapshot_bytes(w.simulation());
  };
  calls["stylet_simulation_snapshot"] = [](World& w) {
    stylet_simulation* const of = w.simulation();
    std::vector<unsigned char> room(stylet_simulation_snapshot_bytes(of));
    const std::size_t told = pick(w.draw, {room.size(), SIZE_MAX, room.size() / 2, std::size_t{0}});
    w.unless_refused(
        [&] { return stylet_simulation_snapshot(of, or_null(w.draw, room.data()), told); });
  };
  calls["stylet_simulation_restore"] = [](World& w) {
    stylet_simulation* const of = w.simulation();
    std::vector<unsigned char> room(stylet_simulation_snapshot_bytes(w.simulation()));
    (void)stylet_simulation_snapshot(of, room.data(), room.size());
    for (int i = 0; i < 8 && !room.empty() && w.draw.chance(0.5); ++i) {
      room[w.draw.below(static_cast<std::uint32_t>(room.size()))] ^= 0xFF;
    }
    const std::size_t told = pick(w.draw, {room.size(), SIZE_MAX, room.size() / 2});
    if (told == SIZE_MAX && stylet_simulation_snapshot_bytes(of) == SIZE_MAX) return;
    w.unless_refused(
        [&] { return stylet_simulation_restore(of, or_null(w.draw, room.data()), told); });
  };
  calls["stylet_simulation_difference"] = [](World& w) {
    std::uint64_t index = 7;
    stylet_simulation *const a = w.simulation(), *const b = w.simulation();
    const char* const found = stylet_simulation_difference(a, b, or_null(w.draw, &index));
    EXPECT_EQ(found == nullptr, a == b && stylet_simulation_hash(a) != 0);
  };
  calls["stylet_simulation_set_helpers"] = [](World& w) {
    w.unless_refused(
        [&] { return stylet_simulation_set_helpers(w.simulation(), odd_count(w.draw)); });
    for (stylet_simulation* each : w.simulations) (void)stylet_simulation_set_helpers(each, 0);
  };
  calls["stylet_simulation_help"] = [](World& w) {
    EXPECT_EQ(stylet_simulation_help(w.simulation(), w.draw.below(3)), 0);
  };
}

void add_views(Calls& calls) {
  calls["stylet_simulation_needles"] = [](World& w) {
    EXPECT_LE(stylet_simulation_needles(w.simulation()), 2U);
  };
  calls["stylet_simulation_surface"] = [](World& w) {
    const stylet_simulation* const s = w.simulation();
    w.copy<stylet_vec3>([&](auto* out, auto n) { return stylet_simulation_surface(s, out, n); });
  };
  calls["stylet_simulation_needle_shape"] = [](World& w) {
    const stylet_simulation* const s = w.simulation();
    const std::uint32_t needle = odd_count(w.draw);
    w.copy<stylet_vec3>(
        [&](auto* out, auto n) { return stylet_simulation_needle_shape(s, needle, out, n); });
  };
  calls["stylet_simulation_particles"] = [](World& w) {
    const stylet_simulation* const s = w.simulation();
    w.copy<stylet_vec3>([&](auto* out, auto n) { return stylet_simulation_particles(s, out, n); });
  };
  calls["stylet_simulation_voxel_corners"] = [](World& w) {
    const stylet_simulation* const s = w.simulation();
    w.copy<std::uint32_t>(
        [&](auto* out, auto n) { return stylet_simulation_voxel_corners(s, out, n); });
  };
  calls["stylet_simulation_constraint_particles"] = [](World& w) {
    const stylet_simulation* const s = w.simulation();
    w.copy<stylet_constraint_particle>(
        [&](auto* out, auto n) { return stylet_simulation_constraint_particles(s, out, n); });
  };
  calls["stylet_simulation_obstacle_touches"] = [](World& w) {
    const stylet_simulation* const s = w.simulation();
    w.copy<stylet_obstacle_touch>(
        [&](auto* out, auto n) { return stylet_simulation_obstacle_touches(s, out, n); });
  };
  calls["stylet_simulation_events"] = [](World& w) {
    stylet_event room[STYLET_MAX_EVENTS];
    EXPECT_LE(stylet_simulation_events(w.simulation(), room, pick(w.draw, {0U, 1U, 64U, kMost})),
              64U);
    EXPECT_EQ(stylet_simulation_events(w.simulation(), nullptr, odd_count(w.draw)), 0U);
  };
  calls["stylet_simulation_get_stats"] = [](World& w) {
    fill<stylet_stats>(w, [&](auto* o) { return stylet_simulation_get_stats(w.simulation(), o); });
  };
  calls["stylet_simulation_get_energy"] = [](World& w) {
    fill<stylet_energy>(w,
                        [&](auto* o) { return stylet_simulation_get_energy(w.simulation(), o); });
  };
  calls["stylet_simulation_get_mass"] = [](World& w) {
    float real_kg = 7, stepped_kg = 7;
    const stylet_status status = stylet_simulation_get_mass(
        w.simulation(), odd_count(w.draw), or_null(w.draw, &real_kg), or_null(w.draw, &stepped_kg));
    expect_known(status);
    EXPECT_TRUE(real_kg == 7 || (real_kg > 0) == (status == STYLET_OK));
  };
}

void add_batches(Calls& calls) {
  calls["stylet_batch_create"] = [](World& w) {
    const std::uint32_t count = w.draw.below(5);
    std::vector<stylet_simulation*> of(count);
    for (stylet_simulation*& each : of) each = w.simulation();
    stylet_batch* made = w.batches[1];
    const stylet_status status =
        stylet_batch_create(or_null(w.draw, of.data()), count, pick(w.draw, {0U, 1U, 2U, kMost}),
                            or_null(w.draw, &made));
    expect_known(status);
    if (made == w.batches[1]) return;
    EXPECT_EQ(made != nullptr, status == STYLET_OK);
    stylet_batch_free(made);
  };
  calls["stylet_batch_free"] = [](World&) { stylet_batch_free(nullptr); };
  calls["stylet_batch_needles"] = [](World& w) {
    EXPECT_EQ(stylet_batch_needles(w.batches[1]), 3U);
    EXPECT_EQ(stylet_batch_needles(nullptr), 0U);
  };
  calls["stylet_batch_run"] = [](World& w) {
    const std::uint32_t ticks = w.draw.below(4);
    Rows<stylet_input> in(w.draw, 3 * ticks, {0, 1, odd_pose(w.draw), w.draw.between(-300, 300)});
    Rows<stylet_output> out = to_fill<stylet_output>(w.draw, 3 * ticks);
    stylet_batch* const of = w.batch();
    const stylet_status status =
        w.unless_refused([&] { return stylet_batch_run(of, in.get(), out.get(), ticks); });
    if (status != STYLET_OK && of != nullptr) out.expect_empty();
  };
}

stylet_sample odd_sample(Draw& draw) {
  return {
      0, draw.below(8), draw.below(1000), odd_time(draw), odd_pose(draw), draw.between(-300, 300)};
}

void add_guards(Calls& calls) {
  calls["stylet_guard_config_init"] = [](World& w) {
    Rows<stylet_guard_config> of = to_fill<stylet_guard_config>(w.draw);
    expect_known(stylet_guard_config_init(of.get(), of.whole() ? sizeof(stylet_guard_config) : 3));
  };
  calls["stylet_guard_config_for"] = [](World& w) {
    const char* const model = pick<const char*>(w.draw, {"touch", "omega.7", "", "%s%n", nullptr});
    fill<stylet_guard_config>(w, [&](auto* out) { return stylet_guard_config_for(out, model); });
  };
  calls["stylet_guard_create"] = [](World& w) {
    Rows<stylet_guard_config> of(w.draw, 1, guard_defaults());
    Why why(w.draw);
    stylet_guard* made = w.guards[1];
    const stylet_status status = stylet_guard_create(of.get(), or_null(w.draw, &made), why.out());
    why.expect(status);
    if (made == w.guards[1]) return;
    EXPECT_EQ(made != nullptr, status == STYLET_OK);
    stylet_guard_free(made);
  };
  calls["stylet_guard_free"] = [](World&) { stylet_guard_free(nullptr); };
  calls["stylet_guard_motor"] = [](World& w) {
    const stylet_motor_report of = {odd_vector(w.draw), odd_vector(w.draw), w.draw.below(4),
                                    w.draw.below(2)};
    expect_known(stylet_guard_motor(w.guard(), w.draw.chance(0.9) ? &of : nullptr));
  };
  calls["stylet_guard_sample"] = [](World& w) {
    Rows<stylet_sample> of(w.draw, 1, odd_sample(w.draw));
    (void)stylet_guard_sample(w.guard(), of.get(), odd_time(w.draw));
  };
  const auto within = [](stylet_vec3 v, double most) {
    EXPECT_LE(
        std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)),
        most * (1 + 1e-6));
  };
  calls["stylet_guard_force"] = [within](World& w) {
    within(stylet_guard_force(w.guard(), odd_vector(w.draw)),
           static_cast<double>(guard_defaults().max_force_n));
  };
  calls["stylet_guard_torque"] = [within](World& w) {
    within(stylet_guard_torque(w.guard(), odd_vector(w.draw)), 0);  // the guard's own default
  };
  calls["stylet_guard_end"] = [](World& w) {
    if (w.draw.chance(0.1)) (void)stylet_guard_end(w.guard(), odd_time(w.draw));
  };
  calls["stylet_guard_trip"] = [](World& w) {
    if (w.draw.chance(0.1)) expect_known(stylet_guard_trip(w.guard(), odd_count(w.draw)));
  };
  calls["stylet_guard_rearm"] = [](World& w) {
    (void)stylet_guard_rearm(w.guard(), w.draw.chance(0.5) ? w.draw.below(12) : odd_count(w.draw));
  };
  calls["stylet_guard_get_report"] = [](World& w) {
    fill<stylet_guard_report>(w, [&](auto* o) { return stylet_guard_get_report(w.guard(), o); });
  };
}

void add_devices(Calls& calls) {
  calls["stylet_device_open"] = [](World& w) {
    const std::string longest(70'000, ':');
    const char* const uri = pick<const char*>(
        w.draw, {"", ":", "none:", "hd", "udp:", "udp:127.0.0.1", "udp:127.0.0.1:99999999999",
                 "udp:300.1.1.1:1", "shm:", "shm:../a", "%n%s", longest.c_str(), nullptr});
    stylet_device* made = w.taken;
    Why why(w.draw);
    const stylet_status status = stylet_device_open(
        uri, pick(w.draw, {0.0, -1.0, 1e300, -1e300, 1e-300, static_cast<double>(NAN)}),
        or_null(w.draw, &made), why.out());
    why.expect(status);
    EXPECT_NE(status, STYLET_OK) << uri;
  };
  calls["stylet_device_from_functions"] = [](World& w) {
    stylet_device_functions like = {};
    like.self = &w.hand;
    like.read = w.draw.chance(0.9) ? read_hand : nullptr;
    like.write = w.draw.chance(0.9) ? write_hand : nullptr;
    like.max_force_n = 3;
    like.max_slew_n_per_s = 1000;
    Rows<stylet_device_functions> of(w.draw, 1, like,
                                     offsetof(stylet_device_functions, max_force_n));
    stylet_device* made = w.taken;
    Why why(w.draw);
    why.expect(stylet_device_from_functions(of.get(), or_null(w.draw, &made), why.out()));
    if (made != w.taken) stylet_device_close(made);
  };
  calls["stylet_device_simulated"] = [](World& w) {
    stylet_device* made = nullptr;
    expect_known(
        stylet_device_simulated(odd(w.draw), odd(w.draw), odd(w.draw), or_null(w.draw, &made)));
    stylet_device_close(made);
  };
  calls["stylet_device_close"] = [](World& w) {
    stylet_device_close(pick<stylet_device*>(w.draw, {nullptr, w.taken}));  // the loop's
  };
}

// A new loop with devices of all kinds, which runs for some ticks if it is accepted.
void live(World& w) {
  stylet_simulation* const of = w.any(w.simulations);
  stylet_loop_config like = defaults<stylet_loop_config, stylet_loop_config_init>();
  like.virtual_time = 1;
  like.priority = 0;
  like.ticks = 1 + w.draw.below(20);
  if (w.draw.chance(0.2)) like.processor = static_cast<std::int32_t>(odd_count(w.draw));
  if (w.draw.chance(0.2)) like.priority = static_cast<std::int32_t>(odd_count(w.draw));
  if (w.draw.chance(0.2)) like.helpers = odd_count(w.draw);
  const std::size_t first = offsetof(stylet_loop_config, show_every_ticks);
  Rows<stylet_loop_config> config(w.draw, 1, like, first);
  if (!config.whole()) return;  // the default is ticks without end
  std::vector<stylet_device*> devices(4);
  for (stylet_device*& each : devices) {
    if (w.draw.chance(0.9)) (void)stylet_device_simulated(0.01F, 0.1F, 0, &each);
  }
  std::vector<stylet_device*> given = devices;
  if (w.draw.chance(0.1)) given[w.draw.below(2)] = w.taken;
  if (w.draw.chance(0.1)) given[1] = given[0];
  Rows<stylet_hand> hands(w.draw, 4, defaults<stylet_hand, stylet_hand_init>());
  Rows<stylet_guard_config> guards(w.draw, 4, guard_defaults());
  Why why(w.draw);
  stylet_loop* made = w.loops[1];
  const stylet_status status = w.unless_refused([&] {
    return stylet_loop_create(of, config.get(), or_null(w.draw, given.data()), hands.get(),
                              guards.get(), or_null(w.draw, &made), why.out());
  });
  why.expect(status);
  if (status == STYLET_OK) {
    EXPECT_EQ(stylet_simulation_tick(of, nullptr, 0, nullptr, 0), STYLET_LOOP_RUNS);
    if (w.draw.chance(0.7)) expect_ok(stylet_loop_start(made));
    stylet_loop_free(made);
    EXPECT_NE(stylet_simulation_hash(of), 0U);
  }
  for (stylet_device* each : devices) {
    // The loop has closed the devices that it took.
    if (status != STYLET_OK ||
        std::find(given.begin(), given.begin() + stylet_simulation_needles(of), each) ==
            given.begin() + stylet_simulation_needles(of)) {
      stylet_device_close(each);
    }
  }
}

void add_loops(Calls& calls) {
  calls["stylet_loop_config_init"] = [](World& w) {
    Rows<stylet_loop_config> of = to_fill<stylet_loop_config>(w.draw);
    expect_known(stylet_loop_config_init(of.get(), of.whole() ? sizeof(stylet_loop_config) : 9));
  };
  calls["stylet_hand_init"] = [](World& w) {
    Rows<stylet_hand> of = to_fill<stylet_hand>(w.draw);
    expect_known(stylet_hand_init(of.get(), of.whole() ? sizeof(stylet_hand) : kMost));
  };
  calls["stylet_loop_create"] = live;
  calls["stylet_loop_start"] = [](World& w) { EXPECT_NE(stylet_loop_start(w.loop()), STYLET_OK); };
  calls["stylet_loop_run"] = [](World& w) { EXPECT_NE(stylet_loop_run(w.loop()), STYLET_OK); };
  calls["stylet_loop_wait"] = [](World& w) { expect_known(stylet_loop_wait(w.loop())); };
  calls["stylet_loop_ask_to_stop"] = [](World& w) { stylet_loop_ask_to_stop(w.loop()); };
  calls["stylet_loop_pause"] = [](World& w) { stylet_loop_pause(w.loop(), w.draw.chance(0.5)); };
  calls["stylet_loop_free"] = [](World&) { stylet_loop_free(nullptr); };
  calls["stylet_loop_take"] = [](World& w) { (void)stylet_loop_take(w.loop()); };
  calls["stylet_loop_get_output"] = [](World& w) {
    fill<stylet_output>(
        w, [&](auto* o) { return stylet_loop_get_output(w.loop(), odd_count(w.draw), o); });
  };
  calls["stylet_loop_get_hand"] = [](World& w) {
    fill<stylet_hand_report>(
        w, [&](auto* o) { return stylet_loop_get_hand(w.loop(), odd_count(w.draw), o); });
  };
  calls["stylet_loop_get_report"] = [](World& w) {
    fill<stylet_loop_report>(w, [&](auto* o) { return stylet_loop_get_report(w.loop(), o); });
  };
  calls["stylet_loop_surface"] = [](World& w) {
    const stylet_loop* const l = w.loop();
    w.copy<stylet_vec3>([&](auto* out, auto n) { return stylet_loop_surface(l, out, n); });
  };
  calls["stylet_loop_needle_shape"] = [](World& w) {
    const stylet_loop* const l = w.loop();
    const std::uint32_t needle = odd_count(w.draw);
    w.copy<stylet_vec3>(
        [&](auto* out, auto n) { return stylet_loop_needle_shape(l, needle, out, n); });
  };
  calls["stylet_loop_events"] = [](World& w) {
    stylet_event room[8];
    EXPECT_LE(stylet_loop_events(w.loop(), or_null(w.draw, &room[0]), w.draw.below(9)), 8U);
  };
  calls["stylet_loop_acknowledge"] = [](World& w) {
    expect_known(
        stylet_loop_acknowledge(w.loop(), odd_count(w.draw), odd_count(w.draw), odd_count(w.draw)));
  };
  calls["stylet_loop_lacks"] = [](World& w) { EXPECT_NE(stylet_loop_lacks(w.loop()), nullptr); };
  calls["stylet_loop_trouble"] = [](World& w) {
    EXPECT_NE(stylet_loop_trouble(w.loop(), odd_count(w.draw)), nullptr);
  };
}

void add_names(Calls& calls) {
  calls["stylet_version"] = [](World&) { EXPECT_GE(stylet_version(), 0x200U); };
  calls["stylet_version_text"] = [](World&) { EXPECT_NE(*stylet_version_text(), '\0'); };
  calls["stylet_build_text"] = [](World&) { EXPECT_NE(*stylet_build_text(), '\0'); };
  calls["stylet_state_layout"] = [](World&) { EXPECT_NE(stylet_state_layout(), 0U); };
  calls["stylet_status_name"] = [](World& w) {
    EXPECT_NE(*stylet_status_name(static_cast<stylet_status>(odd_count(w.draw))), '\0');
  };
  calls["stylet_event_name"] = [](World& w) {
    EXPECT_NE(*stylet_event_name(odd_count(w.draw)), '\0');
  };
  calls["stylet_fault_name"] = [](World& w) {
    EXPECT_NE(*stylet_fault_name(odd_count(w.draw)), '\0');
  };
  calls["stylet_guard_mode_name"] = [](World& w) {
    EXPECT_NE(*stylet_guard_mode_name(odd_count(w.draw)), '\0');
  };
  calls["stylet_device_model"] = [](World& w) {
    const char* const model = stylet_device_model(odd_count(w.draw));
    EXPECT_TRUE(model == nullptr || *model != '\0');
  };
}

Calls all_calls() {
  Calls calls;
  for (const auto add :
       {add_organs, add_what_organs_tell, add_needles, add_creation, add_ticks, add_states,
        add_views, add_batches, add_guards, add_devices, add_loops, add_names}) {
    add(calls);
  }
  return calls;
}

TEST(DrawnCalls, CoverAllFunctions) {
  std::set<std::string> listed, here;
  std::ifstream file(STYLET_SYMBOLS);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("stylet_")) listed.insert(line.substr(0, line.find(' ')));
  }
  for (const auto& [name, call] : all_calls()) here.insert(name);
  EXPECT_EQ(here, listed);
}

TEST(DrawnCalls, AreDoneOrRefused) {
  const Calls calls = all_calls();
  const int first = number_from("STYLET_SEED", 1), count = number_from("STYLET_DRAWS", 20);
  for (int seed = first; seed < first + count && !HasFailure(); ++seed) {
    World world(static_cast<std::uint64_t>(seed));
    for (int i = 0; i < 1500 && !HasFailure(); ++i) {
      const auto call =
          std::next(calls.begin(), world.draw.below(static_cast<std::uint32_t>(calls.size())));
      const testing::ScopedTrace trace(__FILE__, __LINE__,
                                       call->first + " seed " + std::to_string(seed));
      call->second(world);
    }
  }
}

}  // namespace
}  // namespace stylet::test
