// SPDX-License-Identifier: Apache-2.0
// V12: indentation of a half-space by a punch, a point load and a sphere.
//
// The half-space is a half ball: nodes beyond its radius R are fixed. Seen from there, a load F at
// the middle is a point load, so the boundary reduces the indentation by F beta / R, with one beta
// for every load: results are extrapolated linearly in 1 / R.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

constexpr double kEdge = 0.005, kShear = 2000;
constexpr std::uint32_t kNear = 12, kFar = 20;     // radii in voxel edges
constexpr float kPlain = 1, kWeighted = 1.0F / 3;  // hourglass weights

Rig half_ball(std::uint32_t radius, float poisson, float hourglass) {
  const auto n = static_cast<std::uint16_t>(radius);
  const auto across = static_cast<std::uint16_t>(2 * radius);
  Rig rig = make_rig(block_of(across, across, n, elastic(static_cast<float>(kShear), poisson)),
                     resting_config(hourglass, poisson, radius));
  fix_beyond(rig, Vec(n, n, n), radius);
  return rig;
}

// Position of a surface node relative to the middle of the surface, in voxel edges.
struct Spot {
  std::uint32_t node;
  double x, y;
};

std::vector<Spot> surface_nodes(const View& view) {
  std::vector<Spot> spots;
  const std::uint32_t radius = view.model.head->size_z;
  for_each_node(view, [&](Node node) {
    const Vec p = in_edges(node) - Vec::Constant(radius);
    const std::uint32_t i = node_index(view, node);
    if (node.z == radius && view.model.step_per_mass[i] > 0) spots.push_back({i, p.x(), p.y()});
  });
  return spots;
}

double pushed_with(const Rig& rig) {
  double force = 0;
  for (const Hold& held : rig.holds) force += held.force_n;
  return force;
}

// ---- V12

// Compliance of a frictionless flat square punch of half width `half`, m/N.
double punch_compliance(std::uint32_t radius, double half, float poisson, float hourglass) {
  Rig rig = half_ball(radius, poisson, hourglass);
  const double depth = 1e-2 * kEdge;
  for (const Spot& spot : surface_nodes(rig.view())) {
    if (std::abs(spot.x) > half || std::abs(spot.y) > half) continue;
    hold(rig, spot.node, 2, -depth);
  }
  settle(rig);
  return depth / pushed_with(rig);
}

// beta in c(R) = c - beta / R: what the half-space's compliance has beyond the ball's; R in voxel
// edges.
double boundary_of(double near, double far) {
  return (far - near) / (1.0 / kNear - 1.0 / kFar);
}

struct PunchCase {
  double half;
  float poisson, hourglass;
  double wanted;  // stiffness over that of the continuum
};

void PrintTo(const PunchCase& c, std::ostream* out) {
  *out << "half width " << c.half << ", nu " << c.poisson << ", chi " << c.hourglass;
}

class FidelityV12 : public testing::TestWithParam<PunchCase> {};

TEST_P(FidelityV12, FlatSquarePunchOnAHalfSpace) {
  const PunchCase& c = GetParam();
  const double near = punch_compliance(kNear, c.half, c.poisson, c.hourglass);
  const double far = punch_compliance(kFar, c.half, c.poisson, c.hourglass);
  const double stiffness = 1 / (far + boundary_of(near, far) / kFar);
  const double continuum = 4.54 * kShear * c.half * kEdge / (1 - static_cast<double>(c.poisson));
  EXPECT_NEAR(stiffness / continuum / c.wanted, 1, 0.03);
}

INSTANTIATE_TEST_SUITE_P(
    Table, FidelityV12,
    testing::Values(PunchCase{1, 0, kPlain, 1.44}, PunchCase{2, 0, kPlain, 1.23},
                    PunchCase{4, 0, kPlain, 1.15}, PunchCase{1, 0, kWeighted, 1.27},
                    PunchCase{2, 0, kWeighted, 1.15}, PunchCase{4, 0, kWeighted, 1.11},
                    PunchCase{1, 0.45F, kPlain, 1.30}, PunchCase{2, 0.45F, kPlain, 1.17},
                    PunchCase{4, 0.45F, kPlain, 1.17}),
    [](const testing::TestParamInfo<PunchCase>& row) {
      return "Half" + std::to_string(static_cast<int>(row.param.half)) + "Nu" +
             std::to_string(static_cast<int>(row.param.poisson * 100)) +
             (row.param.hourglass < 1 ? "Weighted" : "Plain");
    });

// ---- V12b

// u = F (1 - nu) / (2 pi G r) + what the fixed boundary adds: a field without a pole, so a constant
// and a term with r^2. Fitted over 5 h <= r <= R / 2.
TEST(FidelityV12b, FarFieldOfASurfacePointLoadIsBoussinesq) {
  for (const float poisson : {0.0F, 0.45F}) {
    constexpr std::uint32_t kRadius = 30;
    Rig rig = half_ball(kRadius, poisson, kWeighted);
    constexpr double kForce = 1e-3;
    View view = rig.view();
    std::vector<Spot> ring;
    for (const Spot& spot : surface_nodes(view)) {
      const double r = std::hypot(spot.x, spot.y);
      if (r <= 0) rig.loads.push_back({spot.node, 2, -static_cast<float>(kForce)});
      if (r >= 5 && r <= kRadius / 2) ring.push_back(spot);
    }
    settle(rig);
    const auto rows = static_cast<Eigen::Index>(ring.size());
    Eigen::MatrixXd terms(rows, 3);
    Eigen::VectorXd sunk(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      const Spot& spot = ring[static_cast<std::size_t>(i)];
      const double r = std::hypot(spot.x, spot.y);
      terms.row(i) << 1 / r, 1, r * r;
      sunk(i) = -static_cast<double>(view.state.uz[spot.node]);
    }
    const Eigen::Vector3d fit = terms.colPivHouseholderQr().solve(sunk);
    const double wanted = kForce * (1 - static_cast<double>(poisson)) / (2 * M_PI * kShear * kEdge);
    EXPECT_NEAR(fit(0) / wanted, 1, 0.04) << "nu " << poisson;
    double worst = 0;
    for (Eigen::Index i = 0; i < rows; ++i) {
      const double own = sunk(i) - fit(1) - fit(2) / (terms(i, 0) * terms(i, 0));
      worst = std::max(worst, std::abs(own / (terms(i, 0) * wanted) - 1));
    }
    EXPECT_LT(worst, 0.08) << "nu " << poisson;
  }
}

// ---- V12c

struct Indent {
  double depth_m, force_n, contact_radius;
};

// Presses in a frictionless rigid sphere; no surface node may be inside it. Returns the depth,
// extrapolated to the half-space.
Indent press_sphere(double sphere_radius_m, double depth_m, float poisson, double beta) {
  Rig rig = half_ball(kFar, poisson, kWeighted);
  View view = rig.view();
  const std::vector<Spot> spots = surface_nodes(view);
  Indent out = {};
  const auto keep_below = [&] {
    out.force_n = out.contact_radius = 0;
    for (const Spot& spot : spots) {
      const double r = std::hypot(spot.x, spot.y);
      const auto most = static_cast<float>(0.5 * r * r * kEdge * kEdge / sphere_radius_m - depth_m);
      const float u = view.state.uz[spot.node];
      if (most > 0 || u < most) continue;
      out.force_n +=
          static_cast<double>(view.state.vz[spot.node] / view.model.step_per_mass[spot.node]);
      out.contact_radius = std::max(out.contact_radius, r);
      place(view, spot.node, 2, most);
    }
  };
  settle(rig, 1e-6, keep_below);
  out.depth_m = depth_m + out.force_n * beta / kFar;
  return out;
}

TEST(FidelityV12c, SphereFollowsHertz) {
  constexpr double kSphere = 100 * kEdge;
  for (const float poisson : {0.0F, 0.45F}) {
    const double beta = boundary_of(punch_compliance(kNear, 2, poisson, kWeighted),
                                    punch_compliance(kFar, 2, poisson, kWeighted));
    const double modulus = 2 * kShear / (1 - static_cast<double>(poisson));  // E / (1 - nu^2)
    std::vector<Indent> indents;
    for (const double depth : {0.12, 0.24, 0.48}) {
      indents.push_back(press_sphere(kSphere, depth * kEdge, poisson, beta));
      const Indent& in = indents.back();
      const double wanted = 4.0 / 3 * modulus * std::sqrt(kSphere) * std::pow(in.depth_m, 1.5);
      EXPECT_GE(in.contact_radius, 3);
      EXPECT_NEAR(in.force_n / wanted, 1, 0.04) << "nu " << poisson << ", depth " << depth;
    }
    const double exponent = std::log(indents.back().force_n / indents.front().force_n) /
                            std::log(indents.back().depth_m / indents.front().depth_m);
    EXPECT_NEAR(exponent, 1.5, 0.02);
  }
}

}  // namespace
}  // namespace stylet::test
