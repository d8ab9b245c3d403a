// SPDX-License-Identifier: Apache-2.0
#include "peers.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "BulletSoftBody/btSoftBody.h"

namespace stylet::test {
namespace {

constexpr float kPeriodS = 5e-4F;
constexpr std::size_t kDragged = 8;  // particles, the last ones
constexpr float kHandHz = 2;

struct Lattice {
  std::vector<Eigen::Vector3f> rest;  // in voxel edges
  std::vector<std::array<int, 8>> cluster;
  std::vector<bool> held;
  int steps = 0;

  // Displacement of the dragged particles from rest: sideways to and fro, and 1.2 deep.
  Eigen::Vector3f drag() const {
    const float phase =
        2 * std::numbers::pi_v<float> * kHandHz * kPeriodS * static_cast<float>(steps);
    return {0.5F * std::sin(phase), 0, -0.6F * (1 - std::cos(phase))};
  }
  // Where a held particle is kept.
  Eigen::Vector3f place(std::size_t i) const {
    return i < rest.size() - kDragged ? rest[i] : Eigen::Vector3f(rest[i] + drag());
  }
};

Lattice lattice_of(const Organ& organ) {
  Lattice lattice;
  std::map<std::tuple<int, int, int>, int> index;
  std::size_t voxel = 0;
  for (const OrganRun& run : organ.runs) {
    for (int x = run.x; x < run.x + run.count; ++x, ++voxel) {
      std::array<int, 8> corners{};
      for (int c = 0; c < 8; ++c) {
        const std::tuple at(run.z + (c >> 2), run.y + ((c >> 1) & 1), x + (c & 1));
        const auto [found, added] = index.try_emplace(at, static_cast<int>(lattice.rest.size()));
        if (added) {
          lattice.rest.emplace_back(std::get<2>(at), std::get<1>(at), std::get<0>(at));
          lattice.held.push_back(false);
        }
        corners[static_cast<std::size_t>(c)] = found->second;
        const bool fixed = !organ.voxel_fixed.empty() && ((organ.voxel_fixed[voxel] >> c) & 1) != 0;
        if (fixed) lattice.held[static_cast<std::size_t>(found->second)] = true;
      }
      lattice.cluster.push_back(corners);
    }
  }
  for (std::size_t i = 1; i <= kDragged; ++i) lattice.held[lattice.held.size() - i] = true;
  return lattice;
}

struct EigenBody {
  Lattice lattice;
  std::vector<Eigen::Vector3f> place, velocity, goal;
  std::vector<float> clusters_of;

  explicit EigenBody(const Organ& organ) : lattice(lattice_of(organ)) {
    for (std::size_t i = 0; i < lattice.rest.size(); ++i) place.push_back(lattice.place(i));
    velocity.assign(place.size(), Eigen::Vector3f::Zero());
    goal = velocity;
    clusters_of.assign(place.size(), 0);
    for (const auto& cluster : lattice.cluster) {
      for (const int i : cluster) ++clusters_of[static_cast<std::size_t>(i)];
    }
  }

  void match(const std::array<int, 8>& cluster) {
    Eigen::Vector3f centre = Eigen::Vector3f::Zero(), rest_centre = centre;
    for (const int i : cluster) {
      centre += place[static_cast<std::size_t>(i)] / 8;
      rest_centre += lattice.rest[static_cast<std::size_t>(i)] / 8;
    }
    Eigen::Matrix3f a = Eigen::Matrix3f::Zero();
    for (const int i : cluster) {
      const auto at = static_cast<std::size_t>(i);
      a += (place[at] - centre) * (lattice.rest[at] - rest_centre).transpose();
    }
    const Eigen::JacobiSVD<Eigen::Matrix3f> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3f u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);
    const Eigen::Matrix3f rotation = u * svd.matrixV().transpose();
    for (const int i : cluster) {
      const auto at = static_cast<std::size_t>(i);
      goal[at] += rotation * (lattice.rest[at] - rest_centre) + centre;
    }
  }

  void step() {
    for (Eigen::Vector3f& g : goal) g.setZero();
    for (const auto& cluster : lattice.cluster) match(cluster);
    ++lattice.steps;
    for (std::size_t i = 0; i < place.size(); ++i) {
      if (lattice.held[i]) {
        place[i] = lattice.place(i);
        continue;
      }
      velocity[i] = 0.95F * velocity[i] + 0.5F / kPeriodS * (goal[i] / clusters_of[i] - place[i]);
      place[i] += kPeriodS * velocity[i];
    }
  }
};

struct BulletBody {
  btSoftBodyWorldInfo world;
  std::unique_ptr<btSoftBody> body;
  Lattice lattice;
  std::vector<std::size_t> held;

  explicit BulletBody(const Organ& organ) : lattice(lattice_of(organ)) {
    std::vector<btVector3> rest;
    for (const Eigen::Vector3f& p : lattice.rest) rest.emplace_back(p.x(), p.y(), p.z());
    world.m_gravity.setValue(0, 0, 0);
    body =
        std::make_unique<btSoftBody>(&world, static_cast<int>(rest.size()), rest.data(), nullptr);
    body->m_cfg.piterations = 1;
    body->m_cfg.collisions = 0;
    for (const auto& corners : lattice.cluster) {
      auto* cluster = new (btAlignedAlloc(sizeof(btSoftBody::Cluster), 16)) btSoftBody::Cluster();
      cluster->m_collide = true;  // as Bullet's generateClusters makes them
      for (const int i : corners) cluster->m_nodes.push_back(&body->m_nodes[i]);
      body->m_clusters.push_back(cluster);
    }
    body->initializeClusters();
    for (int i = 0; i < body->m_clusters.size(); ++i) body->m_clusters[i]->m_matching = 0.5F;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (!lattice.held[i]) continue;
      body->setMass(static_cast<int>(i), 0);
      held.push_back(i);
    }
  }

  void step() {
    ++lattice.steps;
    for (const std::size_t i : held) {  // matching moves nodes without mass too
      const Eigen::Vector3f p = lattice.place(i);
      btSoftBody::Node& node = body->m_nodes[static_cast<int>(i)];
      node.m_x = node.m_q = btVector3(p.x(), p.y(), p.z());
    }
    body->predictMotion(kPeriodS);
    body->solveConstraints();
  }
};

}  // namespace

std::function<void()> bullet_step(const Organ& organ) {
  const auto body = std::make_shared<BulletBody>(organ);
  return [body] { body->step(); };
}

std::function<void()> eigen_step(const Organ& organ) {
  const auto body = std::make_shared<EigenBody>(organ);
  return [body] { body->step(); };
}

}  // namespace stylet::test
