// SPDX-License-Identifier: Apache-2.0
// Exact geometry of CGAL's alpha wrap and of its mesher, against integers of 128 bits: random
// points of a lattice, some of them nearly or exactly flat, or nearly or exactly on one sphere.
#include <CGAL/Regular_triangulation_3.h>
#include <gtest/gtest.h>

#include "meshes/exact_duals.h"
#include "random_bodies.h"

namespace stylet::test {
namespace {

using offline::CgalBall;
using offline::CgalKernel;
using offline::CgalPoint;
using offline::MeshGeometry;
using offline::WrapGeometry;
__extension__ using Whole = __int128;
using Wholes = std::array<Whole, 3>;

constexpr double kUnit = 0x1p-16;  // of the lattice
constexpr double kRounding = 0x1p-52;
constexpr auto kWideRounding = static_cast<long double>(kRounding);
constexpr int kNear = 200, kFar = 150'000;  // so that sums fit in 128 bits, for 3 and 4 points
constexpr int kRuns = 2000;

struct Spot {
  Wholes at;
  Whole weight;
};
using Spots = std::vector<Spot>;

Whole dot(const Wholes& a, const Wholes& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Wholes minus(const Wholes& a, const Wholes& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Wholes cross(const Wholes& a, const Wholes& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
long double size(const Wholes& a) {
  return std::hypot(static_cast<long double>(a[0]), static_cast<long double>(a[1]),
                    static_cast<long double>(a[2]));
}
int sign(Whole value) {
  return (value > 0) - (value < 0);
}
Whole orientation(const Spots& s) {
  return dot(minus(s[1].at, s[0].at), cross(minus(s[2].at, s[0].at), minus(s[3].at, s[0].at)));
}

CgalPoint point(const Spot& spot) {
  return {static_cast<double>(spot.at[0]) * kUnit, static_cast<double>(spot.at[1]) * kUnit,
          static_cast<double>(spot.at[2]) * kUnit};
}
double area(Whole units) {
  return static_cast<double>(units) * kUnit * kUnit;
}
CgalBall ball(const Spot& spot) {
  return {point(spot), area(spot.weight)};
}

// The smallest sphere orthogonal to the first `count` balls, which are in general position: its
// centre is spots[0] + way / (2 * part). For each other ball, (centre - spots[0]) * edge = (edge^2
// + weights' difference) / 2; and the centre of two or three balls lies in their line or plane.
struct Sphere {
  Wholes way{};
  Whole part = 1;
  long double terms = 0, part_terms = 0;  // largest terms in both sums, for rounding
};

Sphere sphere_of(const Spots& spots, std::size_t count) {
  std::array<Wholes, 3> edges{};
  Wholes right{};
  for (std::size_t i = 1; i < count; ++i) {
    edges[i - 1] = minus(spots[i].at, spots[0].at);
    right[i - 1] = dot(edges[i - 1], edges[i - 1]) + spots[0].weight - spots[i].weight;
  }
  Sphere sphere;
  if (count == 1) return sphere;
  if (count == 2) {
    sphere.part = dot(edges[0], edges[0]);
    for (std::size_t k = 0; k < 3; ++k) sphere.way[k] = edges[0][k] * right[0];
    return sphere;
  }
  if (count == 3) edges[2] = cross(edges[0], edges[1]);
  sphere.part = dot(edges[0], cross(edges[1], edges[2]));
  sphere.part_terms = size(edges[0]) * size(edges[1]) * size(edges[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Wholes &one = edges[(i + 1) % 3], &other = edges[(i + 2) % 3];
    for (std::size_t k = 0; k < 3; ++k) sphere.way[k] += right[i] * cross(one, other)[k];
    sphere.terms += std::fabs(static_cast<long double>(right[i])) * size(one) * size(other);
  }
  return sphere;
}

// 1 if the last ball is nearer to the others' sphere than an orthogonal one, -1 if farther; for
// five balls times the orientation of the first four.
int side(const Spots& spots) {
  const Sphere sphere = sphere_of(spots, spots.size() - 1);
  const Wholes to = minus(spots.back().at, spots[0].at);
  const Whole power =
      sphere.part * (dot(to, to) + spots[0].weight - spots.back().weight) - dot(to, sphere.way);
  return -sign(power);
}

// Draws spots of a line, plane or space, with weights that are multiples of the reach. They are
// rotated by three orthogonal directions in whole numbers, each of length 3.
class Lattice {
 public:
  Lattice(Draw& draw, int reach) : draw_(draw), reach_(reach) {
    draw_.shuffle(frame_);
    middle_ = {whole(reach_), whole(reach_), whole(reach_)};
  }
  int whole(int most) {
    return static_cast<int>(draw_.below(2 * static_cast<std::size_t>(most) + 1)) - most;
  }
  Whole weight() { return Whole{whole(reach_)} * reach_; }

  // One in three draws is nearly flat in its last direction.
  Spots anywhere(std::size_t count, std::size_t dimension, bool weighted) {
    const bool flat = dimension > 1 && draw_.below(3) == 0;
    Spots spots;
    while (spots.size() < count) {
      std::array<int, 3> steps{};
      for (std::size_t k = 0; k < dimension; ++k) {
        steps[k] = whole(flat && k + 1 == dimension ? 1 : reach_);
      }
      spots.push_back({placed(steps), weighted ? weight() : 0});
    }
    return spots;
  }
  // Spots on one sphere around the middle.
  Spots on_sphere(std::size_t count, std::size_t dimension, Whole same_weight) {
    std::array<int, 3> steps{};
    for (std::size_t k = 0; k < dimension; ++k) steps[k] = 1 + std::abs(whole(reach_ - 1));
    square_ =
        9 * (Whole{steps[0]} * steps[0] + Whole{steps[1]} * steps[1] + Whole{steps[2]} * steps[2]);
    Spots spots;
    while (spots.size() < count) {
      for (std::size_t k = dimension; k > 1; --k) std::swap(steps[k - 1], steps[draw_.below(k)]);
      for (int& step : steps) step = draw_.coin() ? step : -step;
      spots.push_back({placed(steps), same_weight});
    }
    return spots;
  }
  Whole square() const { return square_; }  // square of that sphere's radius
  Spots either(std::size_t count, std::size_t dimension, bool weighted) {
    return draw_.coin() ? anywhere(count, dimension, weighted)
                        : on_sphere(count, dimension, weighted ? weight() : 0);
  }

 private:
  Wholes placed(const std::array<int, 3>& steps) const {
    Wholes at = middle_;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) at[k] += frame_[i][k] * steps[i];
    }
    return at;
  }

  Draw& draw_;
  int reach_;
  Whole square_ = 0;
  Wholes middle_;
  std::array<Wholes, 3> frame_{{{1, 2, 2}, {2, 1, -2}, {2, -2, 1}}};
};

// Whether the first spots span a line, plane or space, as they should.
bool spans(const Spots& spots, std::size_t dimension) {
  return dimension == 0 || sphere_of(spots, dimension + 1).part != 0;
}

void turn_positive(Spots& spots) {
  if (orientation(spots) < 0) std::swap(spots[0], spots[1]);
}

// Expects equality up to the rounding of sums in double precision. CGAL rounds its exact numbers in
// this way, too, unless that is more than 1e-5 of the number: Lazy_exact_nt::to_double.
void expect_centre(const CgalPoint& found, const Spots& spots, std::size_t count, bool exact) {
  constexpr long double kLazy = 1e-5L;
  const Sphere sphere = sphere_of(spots, count);
  const long double part = std::fabs(static_cast<long double>(sphere.part));
  const long double way = size(sphere.way) / part;
  const long double off = kWideRounding * (sphere.terms + way * sphere.part_terms) / part;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto from = static_cast<long double>(spots[0].at[i]);
    const long double expected =
        from + static_cast<long double>(sphere.way[i]) / static_cast<long double>(2 * sphere.part);
    const long double rounding = 16 * off + 4 * kWideRounding * (std::fabs(from) + way);
    const long double most = exact ? std::min(rounding, kLazy * std::fabs(expected)) : rounding;
    EXPECT_NEAR(found[k] / kUnit, static_cast<double>(expected), static_cast<double>(most));
  }
}

TEST(ExactGeometry, CentresOfFourPoints) {
  Draw draw(1);
  int flat = 0;
  for (int run = 0; run < kRuns; ++run) {
    const bool weighted = draw.coin(), exact = draw.coin();
    Lattice lattice(draw, exact ? kFar : kNear);
    Spots s = lattice.either(4, 3, weighted);
    if (!spans(s, 3)) continue;
    turn_positive(s);
    flat += orientation(s) < 27 * kNear * kNear;
    const MeshGeometry::Construct_weighted_circumcenter_3 centre;
    if (exact) {
      expect_centre(centre(ball(s[0]), ball(s[1]), ball(s[2]), ball(s[3]), true), s, 4, true);
      continue;
    }
    expect_centre(centre(ball(s[0]), ball(s[1]), ball(s[2]), ball(s[3])), s, 4, false);
    if (weighted) continue;
    const WrapGeometry::Construct_circumcenter_3 around;
    expect_centre(around(point(s[0]), point(s[1]), point(s[2]), point(s[3])), s, 4, false);
  }
  EXPECT_GT(flat, 20);
}

// The centre lies in the plane of the points, whichever of them comes first.
TEST(ExactGeometry, CentresOfThreePoints) {
  Draw draw(2);
  const MeshGeometry::Construct_weighted_circumcenter_3 centre;
  const WrapGeometry::Construct_circumcenter_3 around;
  int thin = 0, drawn = 0;
  for (int run = 0; run < kRuns; ++run) {
    const bool weighted = draw.coin();
    Lattice lattice(draw, kNear);
    const Spots s = lattice.either(3, draw.coin() ? 3 : 2, weighted);
    if (!spans(s, 2)) continue;
    ++drawn;
    const Wholes one = minus(s[1].at, s[0].at), other = minus(s[2].at, s[0].at);
    thin += size(cross(one, other)) < 0.01L * size(one) * size(other);
    expect_centre(centre(ball(s[0]), ball(s[1]), ball(s[2])), s, 3, false);
    if (!weighted) expect_centre(around(point(s[0]), point(s[1]), point(s[2])), s, 3, false);
  }
  EXPECT_GT(drawn, kRuns / 2);
  EXPECT_GT(thin, 20);
}

TEST(ExactGeometry, RadiiOfTwoPoints) {
  Draw draw(3);
  const MeshGeometry::Compute_squared_radius_smallest_orthogonal_sphere_3 radius;
  for (int run = 0; run < kRuns; ++run) {
    Lattice lattice(draw, kNear);
    const Spots s = lattice.either(2, 1, true);
    if (!spans(s, 1)) continue;
    const Sphere sphere = sphere_of(s, 2);
    const long double way = static_cast<long double>(dot(sphere.way, sphere.way)) /
                            (4 * static_cast<long double>(sphere.part * sphere.part));
    const auto weight = static_cast<long double>(s[0].weight);
    EXPECT_NEAR(radius(ball(s[0]), ball(s[1])) / kUnit / kUnit, static_cast<double>(way - weight),
                static_cast<double>(8 * (way + std::fabs(weight))) * kRounding);
  }
}

// Counts answers of each sign, so that a sample without ties would be noticed.
struct Tally {
  std::array<int, 3> seen{};
  void compare(int found, int expected) {
    EXPECT_EQ(found, expected);
    ++seen[static_cast<std::size_t>(expected + 1)];
  }
  ~Tally() {
    for (const int each : seen) EXPECT_GT(each, kRuns / 50);
  }
};

TEST(ExactGeometry, SidesOfSpheres) {
  Draw draw(4);
  std::array<Tally, 4> tallies;
  const MeshGeometry::Power_side_of_oriented_power_sphere_3 power;
  for (int run = 0; run < kRuns; ++run) {
    for (std::size_t dimension = 0; dimension <= 3; ++dimension) {
      Lattice lattice(draw, dimension == 3 ? kFar : kNear);
      Spots s = lattice.either(dimension + 2, dimension, true);
      s.back().weight += lattice.whole(1);
      if (!spans(s, dimension)) continue;
      std::vector<CgalBall> b;
      for (const Spot& each : s) b.push_back(ball(each));
      tallies[dimension].compare(dimension == 0   ? power(b[0], b[1])
                                 : dimension == 1 ? power(b[0], b[1], b[2])
                                 : dimension == 2 ? power(b[0], b[1], b[2], b[3])
                                                  : power(b[0], b[1], b[2], b[3], b[4]),
                                 side(s));
    }
  }
}

TEST(ExactGeometry, SidesOfSpheresAndCirclesWithoutWeights) {
  Draw draw(5);
  Tally sphere, circle;
  for (int run = 0; run < kRuns; ++run) {
    Spots s = Lattice(draw, kFar).either(5, 3, false);
    s[4].at[draw.below(3)] += Lattice(draw, 1).whole(1);
    if (spans(s, 3)) {
      sphere.compare(WrapGeometry::Side_of_oriented_sphere_3()(
                         point(s[0]), point(s[1]), point(s[2]), point(s[3]), point(s[4])),
                     side(s));
    }
    s = Lattice(draw, kNear).either(4, 2, false);
    if (spans(s, 2)) {
      circle.compare(WrapGeometry::Coplanar_side_of_bounded_circle_3()(point(s[0]), point(s[1]),
                                                                       point(s[2]), point(s[3])),
                     side(s));
    }
  }
}

TEST(ExactGeometry, ComparesDistances) {
  Draw draw(6);
  Tally tally;
  for (int run = 0; run < kRuns; ++run) {
    Lattice lattice(draw, kFar);
    Spots s = lattice.anywhere(3, 3, true);
    const auto far = [&s](std::size_t i) {
      const Wholes to = minus(s[i].at, s[0].at);
      return dot(to, to) - s[i].weight;
    };
    if (draw.coin()) s[2].weight += far(2) - far(1) + lattice.whole(1);
    tally.compare(MeshGeometry::Compare_power_distance_3()(point(s[0]), ball(s[1]), ball(s[2])),
                  sign(far(1) - far(2)));
  }
}

TEST(ExactGeometry, ComparesRadii) {
  Draw draw(7);
  std::array<Tally, 3> tallies;
  const MeshGeometry::Compare_weighted_squared_radius_3 compare;
  for (int run = 0; run < kRuns; ++run) {
    for (std::size_t dimension = 0; dimension <= 2; ++dimension) {
      Lattice lattice(draw, kNear);
      const bool tie = draw.coin();
      const Spots s = tie ? lattice.on_sphere(dimension + 1, dimension, lattice.weight())
                          : lattice.anywhere(dimension + 1, dimension, true);
      if (!spans(s, dimension)) continue;
      const Whole limit =
          tie ? lattice.square() - s[0].weight + lattice.whole(1) : lattice.weight();
      const Sphere sphere = sphere_of(s, dimension + 1);
      const int expected =
          sign(dot(sphere.way, sphere.way) - 4 * sphere.part * sphere.part * (limit + s[0].weight));
      const double w = area(limit);
      tallies[dimension].compare(dimension == 0   ? compare(ball(s[0]), w)
                                 : dimension == 1 ? compare(ball(s[0]), ball(s[1]), w)
                                                  : compare(ball(s[0]), ball(s[1]), ball(s[2]), w),
                                 expected);
    }
  }
}

TEST(ExactGeometry, DualRaysLeaveTheCentreAwayFromTheLastPoint) {
  Draw draw(8);
  for (int run = 0; run < kRuns; ++run) {
    Spots s = Lattice(draw, kFar).either(4, 3, true);
    if (!spans(s, 3)) continue;
    turn_positive(s);
    std::swap(s[0], s[1]);  // the last one is below the plane of the others
    const CgalKernel::Ray_3 ray =
        offline::exact_dual_ray(ball(s[0]), ball(s[1]), ball(s[2]), ball(s[3]));
    expect_centre(ray.source(), s, 4, true);
    const Wholes up = cross(minus(s[1].at, s[0].at), minus(s[2].at, s[0].at));
    const Whole most = std::max({up[0], -up[0], up[1], -up[1], up[2], -up[2]});
    const CgalKernel::Vector_3 normal(static_cast<double>(up[0]), static_cast<double>(up[1]),
                                      static_cast<double>(up[2]));
    // The ray's direction is kept as a second point, with the rounding of a point so far away.
    const CgalKernel::Vector_3 way = ray.second_point() - ray.source();
    const double rounding = kRounding * std::sqrt((ray.source() - CGAL::ORIGIN).squared_length() +
                                                  way.squared_length());
    const CgalKernel::Vector_3 off = CGAL::cross_product(way, normal);
    EXPECT_LE(std::sqrt(off.squared_length()), 8 * rounding * static_cast<double>(most));
    if (way.squared_length() <= 64 * rounding * rounding) continue;
    EXPECT_GT(way * normal, 0);
  }
}

// Both are rounded by Lazy_exact_nt::to_double, each by at most 1e-5 of the number.
void expect_near(const CgalPoint& found, const CgalPoint& expected) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], expected[k], 2e-5 * std::fabs(expected[k]));
}

// Triangulations of random balls have the same duals as CGAL's own.
TEST(ExactGeometry, DualsOfTriangulations) {
  using Regular = CGAL::Regular_triangulation_3<CgalKernel>;
  Draw draw(9);
  int rays = 0, segments = 0;
  for (int run = 0; run < 50; ++run) {
    offline::ExactDuals<Regular> all;
    for (const Spot& each : Lattice(draw, kFar).anywhere(5 + draw.below(8), 3, true)) {
      all.insert(ball(each));
    }
    if (all.dimension() < 3) continue;
    for (const Regular::Facet& given : all.finite_facets()) {
      const Regular::Facet facet = draw.coin() ? given : all.mirror_facet(given);
      if (all.is_infinite(facet.first) || all.is_infinite(facet.first->neighbor(facet.second))) {
        CgalKernel::Ray_3 ray, expected;
        all.dual_ray_exact(facet, ray);
        all.Regular::dual_ray_exact(facet, expected);
        expect_near(ray.source(), expected.source());
        expect_near(ray.second_point(), expected.second_point());
        ++rays;
      } else {
        std::array<CgalPoint, 2> ends, expected;
        all.dual_segment_exact(facet, ends[0], ends[1]);
        all.Regular::dual_segment_exact(facet, expected[0], expected[1]);
        for (std::size_t i = 0; i < 2; ++i) expect_near(ends[i], expected[i]);
        ++segments;
      }
    }
  }
  EXPECT_GT(rays, 100);
  EXPECT_GT(segments, 100);
}

// A box with some triangles turned at random encloses its volume again.
TEST(OutwardSurface, TurnsTriangles) {
  Draw draw(10);
  for (int run = 0; run < 50; ++run) {
    const auto frame = random_frame(draw);
    const offline::Vec size{draw.between(1, 2), draw.between(1, 2), draw.between(1, 2)};
    offline::SoupPoints points;
    for (unsigned i = 0; i < 8; ++i) {
      const offline::Vec p = frame[0] * ((i & 1U) != 0 ? size.x : 0) +
                             frame[1] * ((i & 2U) != 0 ? size.y : 0) +
                             frame[2] * ((i & 4U) != 0 ? size.z : 0);
      points.emplace_back(p.x, p.y, p.z);
    }
    offline::SoupTriangles triangles{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                     {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                     {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const bool all_in = draw.coin();
    for (auto& t : triangles) {
      if (all_in || (run > 5 && draw.coin())) std::swap(t[0], t[1]);
    }
    const offline::Mesh mesh = offline::outward_surface(points, triangles);
    ASSERT_EQ(mesh.triangles.size(), triangles.size());
    double volume = 0;
    for (const offline::Triangle& t : mesh.triangles) {
      volume += dot(mesh.points[t[0]], cross(mesh.points[t[1]], mesh.points[t[2]])) / 6;
    }
    EXPECT_NEAR(volume, size.x * size.y * size.z, 1e-12);
  }
}

}  // namespace
}  // namespace stylet::test
