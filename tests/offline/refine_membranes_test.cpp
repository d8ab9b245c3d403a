// SPDX-License-Identifier: Apache-2.0
// Membranes in built organs with voxels of several sizes: each holds the needle where it lies,
// across whatever voxels it lies, and tents as it would if all voxels were fine; voxels of every
// level carry the area that lies in them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "asset/materials.h"
#include "laws/fracture.h"
#include "membrane_scenes.h"
#include "offline_support.h"
#include "organ_levels.h"

namespace stylet::test {
namespace {

using offline::BuildOptions;

// A block of 50 mm, held but for the side at which needles enter along x, with a membrane `dura`.
// Forces follow its modulus, so that all are reached a few millimetres behind the surface that is
// pressed.
struct Scene {
  double edge_mm, modulus_pa;
  Vec3 start_m;
  float depth_m;  // of the membrane on the needle's way
  Triangles membrane;
  double puncture_n, tension_n_per_m;
};

offline::Tissue gel_of(const Scene& scene, const char* name) {
  offline::Tissue tissue;
  tissue.name = name;
#define STYLET_OF_GEL(field, ...) tissue.field = static_cast<double>(kGel.field);
  STYLET_MATERIAL_NUMBERS(STYLET_OF_GEL)
#undef STYLET_OF_GEL
  tissue.youngs_modulus_pa = scene.modulus_pa;
  tissue.puncture_force_n = 5e-6 * scene.modulus_pa;
  tissue.cutting_force_n = 3e-6 * scene.modulus_pa;
  tissue.coulomb_friction_n_per_m = tissue.static_friction_n_per_m = 1e-4 * scene.modulus_pa;
  return tissue;
}

offline::Built build_of(const Scene& scene, double edge_mm, const std::vector<std::string>& where) {
  BuildOptions options = refined(edge_mm, where);
  options.held = offline::parse_regions({"x>49.9", "y<0.1", "y>49.9", "z<0.1", "z>49.9"}, {1e-3});
  offline::Tissue dura = gel_of(scene, "dura");
  dura.puncture_force_n = scene.puncture_n;
  dura.membrane_n_per_m = scene.tension_n_per_m;
  options.own_tissues = {gel_of(scene, "gel"), dura};
  offline::Membrane membrane;
  membrane.from = "drawn.off";
  membrane.tissue = "dura";
  for (const std::array<Vec3, 3>& t : scene.membrane) {
    const auto first = static_cast<std::uint32_t>(membrane.mesh_m.points.size());
    for (const Vec3& p : t) {
      membrane.mesh_m.points.push_back(
          {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    }
    membrane.mesh_m.triangles.push_back({first, first + 1, first + 2});
  }
  options.membranes = {membrane};
  return build_quietly({input_of(box_mesh({0, 0, 0}, {0.05, 0.05, 0.05}), 1, "gel")}, options);
}

Rig rig_of(const offline::Built& built, const Config& config = {}) {
  auto organ = open_organ(built.bytes);
  Session session = make_session(organ->organ, config);
  return {std::move(organ), std::move(session), config.needle[0].length_m};
}

std::uint32_t dura_of(Rig& rig) {
  return rig.organ->organ.membrane_cells.front().material;
}

Scene draw_scene(Chance& chance) {
  Scene scene = {};
  scene.edge_mm = static_cast<double>(chance.between(4, 7));
  scene.modulus_pa = static_cast<double>(chance.between(10000, 30000));
  scene.depth_m = chance.between(8e-3F, 20e-3F);
  scene.start_m = {-1e-3F, chance.between(0.02F, 0.03F), chance.between(0.02F, 0.03F)};
  scene.puncture_n = 1.6e-5 * scene.modulus_pa;
  return scene;
}

// Finer voxels on a part of the way, or in a box of which the membrane leaves.
std::string draw_refinement(Chance& chance, const Scene& scene) {
  const Vec3 at_mm = 1e3F * Vec3{scene.depth_m, scene.start_m.y, scene.start_m.z};
  const int levels = chance.between(0, 1) < 0.5F ? 1 : 2;
  if (chance.between(0, 1) < 0.5F) {
    const float end_mm = at_mm.x + chance.between(-6, 10);
    return fmt::format("way:0,{},{}:{},{},{}:{}:{}", at_mm.y, at_mm.z, end_mm, at_mm.y, at_mm.z,
                       chance.between(0.5F, 8), levels);
  }
  const auto away = [&] { return chance.between(0.5F, 9); };
  return fmt::format("box:{},{},{}:{},{},{}:{}", at_mm.x - away(), at_mm.y - away(),
                     at_mm.z - away(), at_mm.x + away(), at_mm.y + away(), at_mm.z + away(),
                     levels);
}

TEST(RefineMembranes, HoldTheTipWhereTheyLie) {
  Chance chance = {std::mt19937_64(81)};
  for (int i = 0; i < 20; ++i) {
    Scene scene = draw_scene(chance);
    Vec3 across = chance.direction();
    across.x = 1;  // up to 55 degrees beside the needle
    scene.membrane = sheet({scene.depth_m, scene.start_m.y, scene.start_m.z}, across, 0.02F);
    const std::string where = draw_refinement(chance, scene);
    SCOPED_TRACE(where);
    const offline::Built built = build_of(scene, scene.edge_mm, {where});
    EXPECT_GE(opened(built.bytes).levels, 2U);
    Rig rig = rig_of(built);
    Watch watch;
    push(rig, watch, scene.start_m, scene.depth_m + 12e-3F, chance.between(2e-3F, 50e-3F));
    const std::vector<Puncture> found = watch.of(dura_of(rig));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_NEAR(static_cast<double>(found[0].event.force_n) / scene.puncture_n, 1, 0.03);
    const Vec3 n = (1 / norm(across)) * across;
    const float off_m = dot(found[0].rest_m - scene.membrane[0][0], n);
    EXPECT_NEAR(static_cast<double>(off_m) * 1e3, 0, kPlaceMm);
  }
}

TEST(RefineMembranes, HoldTheTipWhereTheyLieIfTheyAreCurved) {
  Chance chance = {std::mt19937_64(82)};
  for (int i = 0; i < 10; ++i) {
    Scene scene = draw_scene(chance);
    const float radius_m = chance.between(2e-3F, 8e-3F);
    const Vec3 centre_m = {radius_m + scene.depth_m,
                           scene.start_m.y + radius_m * chance.between(-0.5F, 0.5F),
                           scene.start_m.z + radius_m * chance.between(-0.5F, 0.5F)};
    scene.membrane = sphere(centre_m, radius_m);
    const std::string where = draw_refinement(chance, scene);
    SCOPED_TRACE(where);
    Rig rig = rig_of(build_of(scene, scene.edge_mm, {where}));
    Watch watch;
    push(rig, watch, scene.start_m, scene.depth_m + 2 * radius_m + 12e-3F);
    const std::vector<Puncture> found = watch.of(dura_of(rig));
    ASSERT_EQ(found.size(), 2U);
    for (const Puncture& p : found) {
      EXPECT_NEAR(static_cast<double>(norm(p.rest_m - centre_m) - radius_m) * 1e3, 0, kPlaceMm);
    }
    EXPECT_LT(found[0].rest_m.x, centre_m.x);
    EXPECT_GT(found[1].rest_m.x, centre_m.x);
  }
}

// How far the tip goes from where it meets the membrane to where it goes through, had it begun
// without force.
double tent_m(Rig rig, const Scene& scene) {
  double met_m = 0, met_n = 0, last_m = 0, broke_m = 0;
  Watch watch;
  const std::uint32_t dura = dura_of(rig);
  drive(rig, scene.start_m, scene.depth_m + 20e-3F, 5e-3F, [&](const Output& out) {
    watch(rig);
    if (met_m == 0 && rig.view().state.membrane->held > 0) {
      met_m = static_cast<double>(out.tip_m.x);
      met_n = static_cast<double>(rig.view().state.tip->force_n.x);
    }
    if (broke_m == 0 && watch.of(dura).size() == 1) broke_m = last_m;
    last_m = static_cast<double>(out.tip_m.x);
  });
  EXPECT_GT(broke_m, 0);
  return (broke_m - met_m) / (1 - met_n / scene.puncture_n);
}

// A membrane with tension, carried by voxels of both sizes, gives way as it does among fine voxels
// alone: there as a film (insertion_membranes).
TEST(RefineMembranes, TentAsAmongFineVoxels) {
  Chance chance = {std::mt19937_64(83)};
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    Scene scene = draw_scene(chance);
    const Vec3 at_m = {scene.depth_m, scene.start_m.y, scene.start_m.z};
    scene.membrane = sheet(at_m, {1, 0, 0}, 0.0245F);
    scene.tension_n_per_m = static_cast<double>(chance.between(300, 4000));
    Material gel = kGel;
    gel.youngs_modulus_pa = static_cast<float>(scene.modulus_pa);
    const float film_m = chance.between(2e-3F, 5e-3F);
    scene.puncture_n = static_cast<double>(
        film_force_n(plane_modulus_pa(gel), static_cast<float>(scene.tension_n_per_m), film_m));
    const double y_mm = static_cast<double>(at_m.y) * 1e3, z_mm = static_cast<double>(at_m.z) * 1e3;
    const std::string way = fmt::format("way:0,{},{}:{},{},{}:{}", y_mm, z_mm,
                                        static_cast<double>(at_m.x) * 1e3 + 8, y_mm, z_mm, 9);
    const double some_m = tent_m(rig_of(build_of(scene, scene.edge_mm, {way})), scene);
    const double all_m = tent_m(rig_of(build_of(scene, scene.edge_mm / 2, {})), scene);
    EXPECT_GT(all_m, 1e-3);
    EXPECT_NEAR(some_m / all_m, 1, 0.05);
  }
}

// A plane through the whole organ has a square in each voxel, of any level, that it crosses.
TEST(RefineMembranes, VoxelsOfEveryLevelHaveTheirArea) {
  Chance chance = {std::mt19937_64(84)};
  for (int i = 0; i < 6; ++i) {
    Scene scene = draw_scene(chance);
    scene.membrane = sheet({scene.depth_m, 0.025F, 0.025F}, {1, 0, 0}, 0.04F);
    const std::string where = draw_refinement(chance, scene);
    SCOPED_TRACE(where);
    const offline::Built built = build_of(scene, scene.edge_mm, {where});
    const Organ organ = opened(built.bytes);
    std::map<std::array<std::uint32_t, 3>, double> area;
    for (const OrganMembraneCell& c : organ.membrane_cells) {
      area[{c.x, c.y, c.z}] = static_cast<double>(c.area);
    }
    const double depth_m = static_cast<double>(scene.depth_m);
    for (const Cube& cube : cubes_of(organ)) {
      const double low = low_m(organ, cube).x, edge = edge_m(organ, cube);
      const bool is_in = depth_m > low && depth_m < low + edge;
      const auto found = area.find(cube.place);
      EXPECT_NEAR(found == area.end() ? 0 : found->second, is_in ? 1 : 0, 1e-4);
    }
  }
}

}  // namespace
}  // namespace stylet::test
