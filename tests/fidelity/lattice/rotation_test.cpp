// SPDX-License-Identifier: Apache-2.0
// V1, V2: the rotation of a cluster against singular value decomposition.

#include "lattice/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "reference_cluster.h"

namespace stylet::test {
namespace {

constexpr int kSamples = 20000;

template <typename T>
struct Turn {
  T w = 1, x = 0, y = 0, z = 0;
};

template <int Refinements, typename T>
void follow(const Mat& a, Turn<T>& q) {
  const auto at = [&](int i, int j) { return static_cast<T>(a(i, j)); };
  rotation_step<Refinements>(at(0, 0), at(0, 1), at(0, 2), at(1, 0), at(1, 1), at(1, 2), at(2, 0),
                             at(2, 1), at(2, 2), q.w, q.x, q.y, q.z);
}

template <typename T>
Eigen::Quaterniond quaternion(const Turn<T>& q) {
  return {static_cast<double>(q.w), static_cast<double>(q.x), static_cast<double>(q.y),
          static_cast<double>(q.z)};
}

template <typename T>
double angle_to(const Turn<T>& q, const Mat& rotation) {
  const Eigen::Quaterniond gap =
      quaternion(q).normalized().conjugate() * Eigen::Quaterniond(rotation);
  return 2 * std::atan2(gap.vec().norm(), std::abs(gap.w()));
}

// Random clusters A = R0 S; the iteration starts `start_rad` away from R0.
struct Draw {
  std::mt19937_64 random{20140911};

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  }
  Vec direction() {
    std::normal_distribution<double> normal;
    return Vec(normal(random), normal(random), normal(random)).normalized();
  }
  Mat rotation(double most_rad) {
    return Eigen::AngleAxisd(between(0, most_rad), direction()).toRotationMatrix();
  }
  Mat stretch(const Vec& values) {
    const Mat axes = rotation(3.14);
    return axes * values.asDiagonal() * axes.transpose();
  }
};

template <typename T>
Turn<T> start_near(Draw& draw, const Mat& rotation, double away_rad) {
  const Eigen::Quaterniond q(rotation * Eigen::AngleAxisd(away_rad, draw.direction()));
  return {static_cast<T>(q.w()), static_cast<T>(q.x()), static_cast<T>(q.y()),
          static_cast<T>(q.z())};
}

// Largest angle to the SVD rotation after two refined steps from 0.1 rad.
template <typename T, typename Stretch>
double worst_of_two_refined_steps(Stretch stretch) {
  Draw draw;
  double worst = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Mat turned = draw.rotation(3.0);
    const Mat a = turned * draw.stretch(stretch(draw));
    Turn<T> q = start_near<T>(draw, turned, 0.1);
    follow<1>(a, q);
    follow<1>(a, q);
    worst = std::max(worst, angle_to(q, reference_rotation(a)));
  }
  return worst;
}

Vec ordinary(Draw& draw) {
  return {draw.between(0.2, 2), draw.between(0.2, 2), draw.between(0.2, 2)};
}
Vec flat(Draw& draw) {
  return {draw.between(0.2, 2), draw.between(0.2, 2), 1e-6};
}
// Inverted along one axis, with clearly less stretch than along the other two: otherwise there is
// no best rotation.
Vec inverted(Draw& draw) {
  return {draw.between(0.7, 1.4), draw.between(0.7, 1.4), draw.between(-0.5, -0.05)};
}

TEST(FidelityV1, TwoRefinedRotationStepsAgreeWithSvdInDouble) {
  EXPECT_LT(worst_of_two_refined_steps<double>(ordinary), 1e-9);
}

TEST(FidelityV1, TwoRefinedRotationStepsAgreeWithSvdInFloat) {
  EXPECT_LT(worst_of_two_refined_steps<float>(ordinary), 1e-6);
}

// What rotation.h says of the single step of the lattice sweep: 9e-5 rad after one step (median),
// 1e-7 rad after two.
TEST(FidelityV1, PlainRotationStepIsAsAccurateAsItsHeaderSays) {
  Draw draw;
  std::vector<double> once, twice;
  for (int i = 0; i < kSamples; ++i) {
    const Mat turned = draw.rotation(3.0);
    const Mat a = turned * draw.stretch(ordinary(draw));
    const Mat best = reference_rotation(a);
    Turn<float> q = start_near<float>(draw, turned, 0.1);
    follow<0>(a, q);
    once.push_back(angle_to(q, best));
    follow<0>(a, q);
    twice.push_back(angle_to(q, best));
  }
  const auto median = [](std::vector<double>& v) {
    std::nth_element(v.begin(), v.begin() + kSamples / 2, v.end());
    return v[kSamples / 2];
  };
  EXPECT_LT(median(once), 9.5e-5);
  EXPECT_LT(median(twice), 1.5e-7);
}

TEST(FidelityV1, PlainRotationStepRecoversFromHalfARadian) {
  Draw draw;
  double worst = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Mat turned = draw.rotation(3.0);
    const Mat a = turned * draw.stretch(ordinary(draw));
    Turn<float> q = start_near<float>(draw, turned, 0.5);
    for (int n = 0; n < 6; ++n) follow<0>(a, q);
    worst = std::max(worst, angle_to(q, reference_rotation(a)));
  }
  EXPECT_LT(worst, 2e-6);
}

TEST(FidelityV2, FlatClustersAreAsAccurateAsOrdinaryOnes) {
  EXPECT_LT(worst_of_two_refined_steps<double>(flat), 1e-9);
  EXPECT_LT(worst_of_two_refined_steps<float>(flat), 1e-6);
}

TEST(FidelityV2, InvertedClustersAreAsAccurateAsOrdinaryOnes) {
  EXPECT_LT(worst_of_two_refined_steps<double>(inverted), 1e-9);
  EXPECT_LT(worst_of_two_refined_steps<float>(inverted), 2e-6);
}

// Largest deviation from orthonormal on the way through flat, line, point, inverted and exploded
// clusters. What is not a number counts as infinite, a reflection as 2.
template <typename T>
double worst_of_degenerate() {
  Draw draw;
  const Vec shapes[] = {{1, 1, 0},    {1, 0, 0},        {0, 0, 0},    {1, 1, -1},
                        {-1, -1, -1}, {1, -1, -1},      {1e-6, 0, 0}, {30, 30, 30},
                        {30, 0, -30}, {1, 1e-6, -1e-6}, {1e-9, 0, 0}, {1e-20, 0, 1e-9}};
  double worst = 0;
  const auto look = [&](const Turn<T>& q) {
    const Mat r = quaternion(q).toRotationMatrix();
    const double off = (r.transpose() * r - Mat::Identity()).cwiseAbs().maxCoeff();
    worst = std::isfinite(off) ? std::max(worst, off) : HUGE_VAL;
    if (r.determinant() < 0) worst = std::max(worst, 2.0);
  };
  for (const Vec& shape : shapes) {
    for (int i = 0; i < 500; ++i) {
      const Mat turned = draw.rotation(3.14);
      const Mat a = turned * draw.stretch(shape);
      Turn<T> plain = start_near<T>(draw, turned, draw.between(0, 3));
      Turn<T> refined = plain;
      for (int n = 0; n < 4; ++n) {
        follow<0>(a, plain);
        follow<1>(a, refined);
        look(plain);
        look(refined);
      }
    }
  }
  return worst;
}

TEST(FidelityV2, DegenerateClustersStillGiveARotationInDouble) {
  EXPECT_LT(worst_of_degenerate<double>(), 1e-6);
}

TEST(FidelityV2, DegenerateClustersStillGiveARotationInFloat) {
  EXPECT_LT(worst_of_degenerate<float>(), 1e-6);
}

// Clusters collapsed to a line, found by a search over random ones: finite in, finite out.
TEST(FidelityV2, ClustersCollapsedToALineStayFiniteInFloat) {
  struct Case {
    Turn<float> start;
    double a[9];
  };
  const Case cases[] = {
      {{0.311957538F, -0.675445676F, -0.137217849F, 0.653931975F},
       {0.466186166, 0.18526797, -0.413611501, 0.0427505262, 0.016989572, -0.037929289,
        -0.543097198, -0.215833336, 0.481848806}},
      {{0.976665318F, -0.0645532012F, 0.0374173224F, 0.201389924F},
       {0.205283538, 0.162930921, -0.211068526, 0.359532833, 0.285354078, -0.369663864,
        -0.448045552, -0.355606019, 0.460673004}},
      {{-0.29135409F, 0.759670019F, 0.362422884F, 0.454602987F},
       {5.5744348e-10, 3.59918456e-10, 5.42316525e-10, 2.83451956e-10, 1.83013341e-10,
        2.75760109e-10, 1.79002368e-10, 1.15574508e-10, 1.74144907e-10}}};
  for (const Case& c : cases) {
    Turn<float> q = c.start;
    follow<1>(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(c.a), q);
    EXPECT_TRUE(std::isfinite(q.w + q.x + q.y + q.z)) << "first entry " << c.a[0];
  }
}

}  // namespace
}  // namespace stylet::test
