// SPDX-License-Identifier: Apache-2.0
// Graded lattices: levels of voxels with half the edge of the one before, joined by hanging nodes.
#include "graded.h"

#pragma GCC diagnostic ignored "-Wdouble-promotion"
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "lattice/hanging.h"
#include "lattice/voxel.h"
#include "set_speed.h"
#include "state/layout.h"
#include "step_energy.h"

namespace stylet::test {
namespace {

struct Body {
  std::unique_ptr<OpenOrgan> organ;
  Session session;
};
Body make(const Graded& graded, const Config& config) {
  {
    const auto bytes = bytes_of(*graded_organ(graded));
    Organ organ;
    OrganRefusal why;
    if (organ_open(bytes, organ, &why) != Status::kOk) std::printf("%s %u %g %s\n", why.place, (unsigned)why.index, why.value, why.expected);
    std::fflush(stdout);
  }
  Body out = {packed(*graded_organ(graded)), {}};
  out.session = make_session(out.organ->organ, config);
  return out;
}

void let_go(Session& session, int ticks) {
  for (int i = 0; i < ticks; ++i) (void)tick(session.kernel, Input{});
}

// Calls visit(place at rest, particle) once for each node of the lattice.
template <typename Visit>
void each_node(const View& view, Visit visit) {
  const ModelHead& head = *view.model.head;
  std::vector<bool> seen(head.counts.particles);
  for (std::uint32_t r = 0; r < head.counts.rows; ++r) {
    const Row& row = view.model.row[r];
    const Plane& plane = view.model.plane[row.plane];
    for (std::uint32_t i = 0; i < row.count; ++i) {
      if (!(view.model.slot_k[row.slot + i] > 0)) continue;
      for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::uint32_t p = row.node[corner >> 1U] + i + (corner & 1U);
        if (seen[p]) continue;
        seen[p] = true;
        const float h = head.level[plane.level].edge_m;
        visit(h * Vec3{static_cast<float>(row.x0 + i + (corner & 1U)),
                       static_cast<float>(row.y + ((corner >> 1U) & 1U)),
                       static_cast<float>(plane.z_in_level + (corner >> 2U))},
              p);
      }
    }
  }
}

// Splits each cell with this probability, the same for the same cell.
std::function<bool(std::uint32_t, int, int, int)> at_random(unsigned seed, double probability) {
  return [=](std::uint32_t level, int x, int y, int z) {
    std::seed_seq place = {seed, level, static_cast<unsigned>(x), static_cast<unsigned>(y),
                           static_cast<unsigned>(z)};
    std::mt19937 random(place);
    return std::bernoulli_distribution(probability)(random);
  };
}

// A linear displacement is a state of no force within, whatever the levels.
TEST(Graded, PatchTest) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Graded graded;
    graded.levels = 2 + seed % 3;
    graded.nx = graded.levels == 4 ? 3 : 4;
    graded.split = at_random(seed, 0.4);
    Config config;
    config.surround_drag_per_s = 0;
    Body body = make(graded, config);
    View view = view_of(body.session.kernel);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> part(-1e-2F, 1e-2F);
    float a[9];
    for (float& each : a) each = part(random);
    each_node(view, [&](Vec3 at, std::uint32_t p) {
      view.state.ux[p] = view.state.ex[p] = a[0] * at.x + a[1] * at.y + a[2] * at.z;
      view.state.uy[p] = view.state.ey[p] = a[3] * at.x + a[4] * at.y + a[5] * at.z;
      view.state.uz[p] = view.state.ez[p] = a[6] * at.x + a[7] * at.y + a[8] * at.z;
    });
    let_go(body.session, 1);
    const float size_m[3] = {graded.nx * graded.voxel_edge_m, graded.ny * graded.voxel_edge_m,
                             graded.nz * graded.voxel_edge_m};
    double inside = 0, outside = 0;
    std::uint32_t free_inside = 0;
    each_node(view, [&](Vec3 at, std::uint32_t p) {
      const float per_mass = view.model.step_per_mass[p];
      if (hangs(view.model, p)) return;
      const float f = norm(Vec3{view.state.wx[p], view.state.wy[p], view.state.wz[p]}) / per_mass;
      const float x[3] = {at.x, at.y, at.z};
      bool within = true;
      for (int i = 0; i < 3; ++i) within = within && x[i] > 1e-5F && x[i] < size_m[i] - 1e-5F;
      (within ? inside : outside) = std::max(within ? inside : outside, static_cast<double>(f));
      free_inside += within ? 1 : 0;
    });
    std::printf("seed %u levels %u: voxels %u hanging %u, free inside %u, force %g of %g\n", seed,
                graded.levels, view.model.head->counts.voxels, view.model.head->counts.hanging,
                free_inside, inside, outside);
    EXPECT_LT(inside, 1e-5 * outside);
  }
}

struct Sum {
  double px = 0, py = 0, pz = 0, lx = 0, ly = 0, lz = 0, kg = 0;
};
Sum sum_of(const View& view) {
  Sum sum;
  each_node(view, [&](Vec3 at, std::uint32_t p) {
    if (hangs(view.model, p)) return;
    const double m =
        static_cast<double>(view.model.head->substep_s / view.model.step_per_mass[p]);
    const double x = static_cast<double>(at.x + view.state.ux[p]);
    const double y = static_cast<double>(at.y + view.state.uy[p]);
    const double z = static_cast<double>(at.z + view.state.uz[p]);
    const double px = m * static_cast<double>(view.state.wx[p]);
    const double py = m * static_cast<double>(view.state.wy[p]);
    const double pz = m * static_cast<double>(view.state.wz[p]);
    sum.kg += m;
    sum.px += px;
    sum.py += py;
    sum.pz += pz;
    sum.lx += y * pz - z * py;
    sum.ly += z * px - x * pz;
    sum.lz += x * py - y * px;
  });
  return sum;
}

TEST(Graded, MomentumAndEnergy) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Graded graded;
    graded.levels = 2 + seed % 2;
    graded.split = at_random(seed, 0.4);
    Config config;
    config.surround_drag_per_s = 0;
    Body body = make(graded, config);
    View view = view_of(body.session.kernel);
    std::mt19937 random(seed);
    std::normal_distribution<float> speed(0, 0.02F);
    each_node(view, [&](Vec3, std::uint32_t p) {
      if (hangs(view.model, p)) return;
      set_speed(view, p, {speed(random), speed(random), speed(random)});
    });
    const Sum before = sum_of(view);
    std::printf("seed %u passes %u kg %g p %.8g %.8g %.8g l %.8g %.8g %.8g\n", seed,
                view.model.head->filter.passes, before.kg, before.px, before.py, before.pz,
                before.lx, before.ly, before.lz);
    let_go(body.session, 1);
    double last = tissue_energy(body.session.kernel, energy(body.session.kernel));
    const double first = last;
    for (int i = 0; i < 300; ++i) {
      let_go(body.session, 1);
      const double now = tissue_energy(body.session.kernel, energy(body.session.kernel));
      EXPECT_LT(now, last + 1e-6 * first) << i;
      last = now;
    }
    const Sum after = sum_of(view);
    std::printf("       passes %u kg %g p %.8g %.8g %.8g l %.8g %.8g %.8g  energy %g to %g\n",
                view.model.head->filter.passes, after.kg, after.px, after.py, after.pz, after.lx,
                after.ly, after.lz, first, last);
  }
}

// What a bar that is held at one end sinks by under weight.
double deflection(const Graded& graded, float gravity) {
  Config config;
  config.gravity_m_per_s2 = {0, 0, -gravity};
  config.surround_drag_per_s = 30;
  Body body = make(graded, config);
  View view = view_of(body.session.kernel);
  let_go(body.session, 3000);
  double lowest = 0;
  each_node(view, [&](Vec3, std::uint32_t p) {
    lowest = std::min(lowest, static_cast<double>(view.state.uz[p]));
  });
  std::printf("voxels %u passes %u: %g mm\n", view.model.head->counts.voxels,
              view.model.head->filter.passes, 1e3 * lowest);
  return lowest;
}

TEST(Graded, Bar) {
  Graded graded;
  graded.nx = 12;
  graded.ny = graded.nz = 3;
  graded.fixed_faces = kLowX;
  graded.split = [](std::uint32_t, int, int, int) { return false; };
  const double coarse = deflection(graded, 0.5F);
  graded.split = [](std::uint32_t, int, int, int) { return true; };
  const double fine = deflection(graded, 0.5F);
  graded.split = [](std::uint32_t, int x, int y, int) { return x < 4 || (x > 6 && y == 1); };
  const double mixed = deflection(graded, 0.5F);
  std::printf("%g %g %g\n", coarse, fine, mixed);
}


// A block that hangs on its low face; `levels` and `split` say how fine it is where.
Graded block() {
  Graded graded;
  graded.nx = graded.ny = graded.nz = 8;
  graded.fixed_faces = kLowZ;
  graded.materials[0].puncture_force_n = 0.05F;
  graded.materials[0].cutting_force_n = 0.03F;
  graded.split = [](std::uint32_t, int, int, int) { return false; };
  return graded;
}

struct Felt {
  std::vector<Vec3> force_n;
  std::vector<float> depth_m;
};
Felt insert(const Graded& graded, float unit_m, Vec3 beside_m) {
  Config config;
  config.needle[0].unit_m = unit_m;
  Body body = make(graded, config);
  const float top = graded.voxel_edge_m * graded.nz, length = config.needle[0].length_m;
  Script script;
  script.needle_length_m = length;
  script.entry_m = Vec3{top / 2, top / 2, top} + beside_m;
  Felt felt;
  for (std::uint64_t i = 0; i < kCycleTicks; ++i) {
    const Output out = tick(body.session.kernel, scripted_input(script, i));
    felt.force_n.push_back(out.force_n);
    felt.depth_m.push_back(out.depth_m);
  }
  return felt;
}

double off(const Felt& a, const Felt& b) {
  double sum = 0, all = 0;
  for (std::size_t i = 0; i < a.force_n.size(); ++i) {
    const Vec3 d = a.force_n[i] - b.force_n[i];
    sum += static_cast<double>(dot(d, d));
    all += static_cast<double>(dot(a.force_n[i], a.force_n[i]));
  }
  return std::sqrt(sum / all);
}

TEST(Graded, Needle) {
  Graded coarse = block(), mixed = block(), fine = block();
  fine.split = [](std::uint32_t, int, int, int) { return true; };
  mixed.split = [](std::uint32_t, int x, int y, int) { return x > 0 && x < 5 && y > 2 && y < 6; };
  for (const float unit_m : {5e-3F, 2.5e-3F}) {
    for (const Vec3 beside : {Vec3{-4e-3F, 0, 0}, Vec3{-4.7e-3F, 1.3e-3F, 0}, Vec3{-5.2e-3F, -0.6e-3F, 0}}) {
      const Felt of_coarse = insert(coarse, unit_m, beside), of_fine = insert(fine, unit_m, beside);
      const Felt of_mixed = insert(mixed, unit_m, beside);
      std::printf("unit %g: coarse to fine %g, mixed to fine %g\n", unit_m, off(of_fine, of_coarse),
                  off(of_fine, of_mixed));
      for (std::size_t i = 0; i < kCycleTicks; i += 250) {
        std::printf("  %zu: %.4f %.4f %.4f | %.4f %.4f %.4f | %.4f %.4f %.4f  depth %.2f %.2f %.2f\n", i, of_coarse.force_n[i].x, of_coarse.force_n[i].y,
                    of_coarse.force_n[i].z, of_mixed.force_n[i].x, of_mixed.force_n[i].y,
                    of_mixed.force_n[i].z, of_fine.force_n[i].x, of_fine.force_n[i].y,
                    of_fine.force_n[i].z, 1e3 * of_coarse.depth_m[i], 1e3 * of_mixed.depth_m[i],
                    1e3 * of_fine.depth_m[i]);
      }
    }
  }
}


TEST(Graded, NeedleAcrossLevels) {
  Graded mixed = block(), fine = block();
  fine.split = [](std::uint32_t, int, int, int) { return true; };
  for (const int below : {0, 1}) {
    mixed.split = [=](std::uint32_t, int, int, int z) { return (z < 6) == (below == 1); };
    const Felt of_fine = insert(fine, 2.5e-3F, {-4e-3F, 0, 0});
    const Felt of_mixed = insert(mixed, 2.5e-3F, {-4e-3F, 0, 0});
    std::printf("mixed to fine %g\n", off(of_fine, of_mixed));
    for (std::size_t i = 700; i < 3400; i += 100) {
        std::printf("  %zu: %.4f %.4f %.4f | %.4f %.4f %.4f  depth %.2f %.2f\n", i, of_mixed.force_n[i].x, of_mixed.force_n[i].y,
                    of_mixed.force_n[i].z, of_fine.force_n[i].x, of_fine.force_n[i].y,
                    of_fine.force_n[i].z, 1e3 * of_mixed.depth_m[i],
                    1e3 * of_fine.depth_m[i]);
    }
  }
}

// Any materials, any levels: what moves comes to rest.
TEST(Graded, RandomTissueComesToRest) {
  for (unsigned seed = 1; seed <= (std::getenv("SEEDS") ? (unsigned)std::atoi(std::getenv("SEEDS")) : 40U); ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> part(0, 1);
    Graded graded;
    graded.levels = 2 + seed % 3;
    graded.nx = graded.ny = 3;
    graded.nz = 3;
    graded.voxel_edge_m = 0.002F + 0.006F * part(random);
    graded.fixed_faces = seed % 2 == 0 ? kLowZ : 0U;
    graded.split = at_random(seed, 0.2 + 0.5 * static_cast<double>(part(random)));
    if (std::getenv("FINE")) graded.split = at_random(seed, 1);
    graded.materials.clear();
    for (int i = 0; i < 5; ++i) {
      TinyMaterial m;
      m.youngs_modulus_pa = std::pow(10.0F, 3 + 3 * part(random));
      m.poisson_ratio = 0.49F * part(random);
      m.density_kg_per_m3 = 500 + 1000 * part(random);
      m.strain_stiffening = seed % 4 == 0 ? 50 * part(random) : 0;
      graded.materials.push_back(m);
    }
    graded.material_at = [=](std::uint32_t level, int x, int y, int z) {
      std::seed_seq place = {seed, level, static_cast<unsigned>(x), static_cast<unsigned>(y),
                             static_cast<unsigned>(z), 7U};
      return static_cast<std::uint8_t>(std::mt19937(place)() % 5);
    };
    Config config;
    config.surround_drag_per_s = 0;
    config.inertia = seed % 5 == 0 ? Inertia::kAddedMass : Inertia::kTrueMass;
    Body body = make(graded, config);
    View view = view_of(body.session.kernel);
    std::normal_distribution<float> speed(0, std::getenv("SPEED") ? static_cast<float>(std::atof(std::getenv("SPEED"))) : 0.3F);
    each_node(view, [&](Vec3 at, std::uint32_t p) {
      if (hangs(view.model, p) || !(view.model.step_per_mass[p] > 0)) return;
      if (std::getenv("SMOOTH")) {
        const auto near = [&](float x) { return static_cast<unsigned>(std::lround(x / graded.voxel_edge_m)); };
        std::seed_seq place = {seed, near(at.x), near(at.y), near(at.z), 9U};
        random.seed(place);
        speed.reset();
      }
      set_speed(view, p, {speed(random), speed(random), speed(random)});
    });
    let_go(body.session, 1);
    const double first = tissue_energy(body.session.kernel, energy(body.session.kernel));
    double last = first, gained = 0;
    for (int i = 0; i < 400; ++i) {
      let_go(body.session, 1);
      const double now = tissue_energy(body.session.kernel, energy(body.session.kernel));
      gained = std::max(gained, now - last);
      last = now;
    }
    const Energy rest = energy(body.session.kernel);
    const MassReport mass = mass_report(body.session.kernel, 0);
    std::printf("seed %u levels %u edge %g passes %u: energy %g to %g (elastic %g), gained %g, mass %g of %g\n", seed, graded.levels, graded.voxel_edge_m, view.model.head->filter.passes, first, last, rest.elastic, gained, mass.stepped_kg, mass.real_kg);
  }
}

}  // namespace
}  // namespace stylet::test
