// SPDX-License-Identifier: Apache-2.0
#pragma GCC diagnostic ignored "-Wdouble-promotion"
// Parts that slide on each other, against the statics and dynamics of blocks: weight on a floor,
// a slope with friction, momentum and energy of two free bodies.
#include "coupling/slides.h"

#include <gtest/gtest.h>

#include <random>

#include "set_speed.h"
#include "state/layout.h"
#include "two_parts.h"

namespace stylet::test {
namespace {

struct Bodies {
  std::unique_ptr<OpenOrgan> organ;
  Session session;
};
Bodies make(const TwoParts& parts, const Config& config) {
  Bodies out = {packed(*two_parts(parts)), {}};
  out.session = make_session(out.organ->organ, config);
  return out;
}

Bodies make_with_surface(const TwoParts& parts, const Config& config) {
  Bodies out = {packed(*two_parts_with_surface(parts)), {}};
  out.session = make_session(out.organ->organ, config);
  return out;
}

void wait(Session& session, int ticks) {
  for (int i = 0; i < ticks; ++i) (void)tick(session.kernel, Input{});
}

struct Sum {
  double kg = 0, x = 0, y = 0, z = 0;      // mass, mean place (moved) times mass
  double px = 0, py = 0, pz = 0;           // momentum
  double lx = 0, ly = 0, lz = 0;           // about the origin
};
// Of one part (sheet 0 or 1), or of both (2).
Sum sum_of(const View& view, std::uint32_t part) {
  Sum sum;
  const ModelHead& head = *view.model.head;
  std::vector<bool> seen(head.counts.particles);
  for (std::uint32_t r = 0; r < head.counts.rows; ++r) {
    const Row& row = view.model.row[r];
    if (part < 2 && row.y / head.sheet_rows != part) continue;
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      for (std::uint32_t i = 0; i <= row.count; ++i) {
        const std::uint32_t p = row.node[corner] + i;
        if (seen[p]) continue;
        seen[p] = true;
        const double m = static_cast<double>(view.model.particle_kg[p]);
        const double h = static_cast<double>(head.edge_m);
        const double x = h * (row.x0 + i) + static_cast<double>(view.state.ux[p]);
        const double y = h * (row.y % head.sheet_rows + (corner & 1U)) + static_cast<double>(view.state.uy[p]);
        const double z = h * (view.model.plane[row.plane].z + (corner >> 1U)) + static_cast<double>(view.state.uz[p]);
        const double px = m * static_cast<double>(view.state.wx[p]);
        const double py = m * static_cast<double>(view.state.wy[p]);
        const double pz = m * static_cast<double>(view.state.wz[p]);
        sum.kg += m;
        sum.x += m * static_cast<double>(view.state.ux[p]);
        sum.y += m * static_cast<double>(view.state.uy[p]);
        sum.z += m * static_cast<double>(view.state.uz[p]);
        sum.px += px;
        sum.py += py;
        sum.pz += pz;
        sum.lx += y * pz - z * py;
        sum.ly += z * px - x * pz;
        sum.lz += x * py - y * px;
      }
    }
  }
  return sum;
}

TEST(Slides, RestIsRest) {
  for (const float plane : {4.0F, 3.3F, 4.62F}) {
    TwoParts parts;
    parts.plane = plane;
    parts.friction = 0.3F;
    Bodies bodies = make(parts, Config{});
    const View view = view_of(bodies.session.kernel);
    wait(bodies.session, 50);
    EXPECT_EQ(view.state.head->max_displacement_m, 0) << plane;
  }
}

TEST(Slides, Weight) {
  for (const float plane : {4.0F, 3.3F, 4.62F}) {
    TwoParts parts;
    parts.plane = plane;
    Config config;
    config.gravity_m_per_s2 = {0, 0, -9.81F};
    Bodies bodies = make(parts, config);
    const View view = view_of(bodies.session.kernel);
    for (int i = 0; i < 8; ++i) {
      wait(bodies.session, 500);
      const Sum lid = sum_of(view, 1), floor = sum_of(view, 0);
      double force = 0, deep = 0;
      for (std::uint32_t p = 0; p < view.model.head->counts.slide_points; ++p) {
        force += static_cast<double>(view.state.slide[p].stiffness_n_per_m * view.scratch.slide_contact[p].depth_m);
        deep = std::max(deep, static_cast<double>(view.scratch.slide_contact[p].depth_m));
      }
      std::printf("plane %g t %d lid kg %g z %g mm p %g floor z %g force %g weight %g deep %g mm passes %u k %g of %g\n", plane, i, lid.kg, 1e3*lid.z/lid.kg, lid.pz,
        1e3*floor.z/floor.kg, force, lid.kg*9.81, 1e3*deep, view.model.head->filter.passes, view.state.slide[0].stiffness_n_per_m, view.model.slide_point[0].stiffness_n_per_m);
    }
  }
}

TEST(Slides, Slope) {
  for (const float angle : {0.1F, 0.2F, 0.4F}) {
    TwoParts parts;
    parts.floor_x = 30;
    parts.friction = 0.25F;
    parts.plane = 4.62F;
    Config config;
    config.surround_drag_per_s = 0;
    config.gravity_m_per_s2 = {9.81F * angle, 0, -9.81F};
    Bodies bodies = make(parts, config);
    const View view = view_of(bodies.session.kernel);
    for (int i = 0; i < 8; ++i) {
      wait(bodies.session, 200);
      const Sum lid = sum_of(view, 1);
      std::printf("angle %g t %d lid x %g mm v %g z %g\n", angle, i, 1e3*lid.x/lid.kg, lid.px/lid.kg, 1e3*lid.z/lid.kg);
    }
  }
}

TEST(Slides, Free) {
  TwoParts parts;
  parts.plane = 4.62F;
  parts.held = false;
  parts.friction = 0.2F;
  Config config;
  config.surround_drag_per_s = 0;
  Bodies bodies = make(parts, config);
  View view = view_of(bodies.session.kernel);
  const ModelHead& head = *view.model.head;
  for (std::uint32_t r = 0; r < head.counts.rows; ++r) {
    const Row& row = view.model.row[r];
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      for (std::uint32_t i = 0; i <= row.count; ++i) {
        const std::uint32_t p = row.node[corner] + i;
        const bool lid = row.y >= head.sheet_rows;
        set_speed(view, p, lid ? Vec3{0.05F, 0.03F, -0.2F - 0.01F * static_cast<float>(row.x0 + i)} : Vec3{});
      }
    }
  }
  for (int i = 0; i < 30; ++i) {
    const Sum all = sum_of(view, 2), lid = sum_of(view, 1);
    const Energy e = energy(bodies.session.kernel);
    std::printf("t %d p %.9g %.9g %.9g l %.9g %.9g %.9g lid pz %g  e %g (el %g kin %g slide %g)\n", i, all.px, all.py, all.pz, all.lx, all.ly, all.lz, lid.pz, e.elastic + e.kinetic, e.elastic, e.kinetic, e.sliding);
    wait(bodies.session, 5);
  }
}

TEST(Slides, NeedleCrosses) {
  for (const float shove : {0.0F, 0.007F, 0.012F}) {
    TwoParts parts;
    parts.floor_x = 16; parts.floor_y = 8; parts.lid_x = 12; parts.lid_y = 8;
    parts.plane = 5.37F; parts.height = 10; for (TinyMaterial* m : {&parts.floor, &parts.lid}) { m->puncture_force_n = 0.02F; m->cutting_force_n = 0.01F; m->coulomb_friction_n_per_m = m->static_friction_n_per_m = 2; }
    Config config;
    config.needle[0].length_m = 0.1F;
    Bodies bodies = make_with_surface(parts, config);
    View view = view_of(bodies.session.kernel);
    const ModelHead& head = *view.model.head;
    // Shift the lid as a rigid body along x.
    for (std::uint32_t r = 0; r < head.counts.rows; ++r) {
      const Row& row = view.model.row[r];
      if (row.y < head.sheet_rows) continue;
      for (std::uint32_t corner = 0; corner < 4; ++corner)
        for (std::uint32_t i = 0; i <= row.count; ++i) {
          const std::uint32_t p = row.node[corner] + i;
          view.state.ux[p] = view.state.ex[p] = shove;
        }
    }
    for (std::uint32_t i = 0; i < head.counts.slide_points; ++i) view.state.slide[i].place.x += shove / head.edge_m - std::floor(shove/head.edge_m), view.state.slide[i].ground += 0;
    const float x = 0.0287F, y = 0.0213F, length = 0.1F;
    for (int t = 0; t < 2200; ++t) {
      const float tip_z = 0.055F - 0.00002F * static_cast<float>(t);
      Input in{};
      in.handle = {{x, y, tip_z + length}, {1, 0, 0, 0}};
      in.valid = 1;
      const Output out = tick(bodies.session.kernel, in);
      if (t % 60 == 0) std::printf("shove %g t %d tip %g mm force %g %g %g depth %g layer %d flags %x cps %u lid x %g\n", shove, t, 1e3*tip_z, out.force_n.x, out.force_n.y, out.force_n.z, 1e3*out.depth_m, (int)out.layer, out.flags, out.constraint_particles, 1e3*sum_of(view,1).x/sum_of(view,1).kg);
    }
  }
}

}  // namespace
}  // namespace stylet::test
