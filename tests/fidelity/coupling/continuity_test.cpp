// SPDX-License-Identifier: Apache-2.0
// Events must not be felt: where a CP is added or removed, the force changes by no more than the
// needle's own motion explains, K v dt, with K the springs of all CPs. And tracks are remembered.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "rig.h"

namespace stylet::test {
namespace {

TinyOrgan gel() {
  TinyOrgan tiny;
  tiny.nx = 10;
  tiny.ny = tiny.nz = 7;
  tiny.fixed_faces = kHighX | kLowY | kHighY | kLowZ | kHighZ;
  tiny.materials[0].youngs_modulus_pa = 20000;
  tiny.materials[0].puncture_force_n = 0.4F;
  tiny.materials[0].recut_fraction = 0.25F;
  return tiny;
}
constexpr Vec3 kStart = {-1e-3F, 16.5e-3F, 18.1e-3F};

// Mean square of how the residuals of a CP's voxels differ from their mean.
double spread_of(const Particle& p) {
  double sum = 0;
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    const double off = norm_of((p.position_m - p.support[i].goal_m) - residual(p));
    sum += static_cast<double>(p.support[i].weight) * off * off;
  }
  return sum;
}

std::uint32_t count_of(const Kernel& kernel, EventKind kind) {
  Event list[kMaxEvents];
  const std::uint32_t count = events(kernel, list);
  return static_cast<std::uint32_t>(
      std::count_if(list, list + count, [kind](const Event& e) { return e.kind == kind; }));
}

double all_springs(const View& view) {
  double sum = static_cast<double>(view.state.tip->stiffness_n_per_m);
  for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
    sum += static_cast<double>(view.state.shaft[i].full_stiffness_n_per_m);
  }
  return sum;
}

struct Jumps {
  double axial = 0, lateral = 0;  // largest, as parts of K v dt
  int events = 0;
};

// Watches the ticks in which the number of CPs changes while the needle stays in the tissue. A jump
// is the difference between the force in that tick and the mean of the ticks before and after, so
// that the recoil of a puncture, which goes on through all three, does not count.
class Watch {
 public:
  explicit Watch(double step_m) : step_m_(step_m) {}
  void see(const Rig& rig, const Output& out) {
    const Vec3 change = out.force_n - last_force_;
    if (pending_n_ > 0) {
      const Vec3 jump = event_change_ - 0.5F * (change_before_ + change);
      jumps.axial = std::max(jumps.axial, std::fabs(static_cast<double>(jump.x)) / pending_n_);
      jumps.lateral = std::max(jumps.lateral, norm_of({0, jump.y, jump.z}) / pending_n_);
      ++jumps.events;
      pending_n_ = 0;
    }
    const bool inside = out.constraint_particles > 2 && last_count_ > 2;
    if (inside && out.constraint_particles != last_count_) {
      pending_n_ = all_springs(rig.view()) * step_m_;
      event_change_ = change;
      change_before_ = last_change_;
    }
    last_count_ = out.constraint_particles;
    last_change_ = change;
    last_force_ = out.force_n;
  }
  Jumps jumps;

 private:
  double step_m_, pending_n_ = 0;  // allowed for a step; by the last event
  std::uint32_t last_count_ = 0;
  Vec3 last_force_ = {}, last_change_ = {}, event_change_ = {}, change_before_ = {};
};

TEST(Continuity, AddingAndRemovingParticlesIsNotFelt) {
  for (const float speed : {5e-3F, 20e-3F}) {
    for (const float side : {0.0F, 2e-3F}) {  // the needle bears on the tissue to the side
      Rig rig = make_rig(gel(), Config{});
      Watch watch(static_cast<double>(speed) * 1e-3);
      const auto see = [&](const Output& out) { watch.see(rig, out); };
      drive(rig, kStart, 17e-3F, speed, see);
      for (int i = 0; i < 400; ++i) {
        see(move_tip(rig, {17e-3F, kStart.y + side * static_cast<float>(i) / 400, kStart.z}));
      }
      const Vec3 aside = {17e-3F, kStart.y + side, kStart.z};
      for (int i = 0; i < 500; ++i) see(move_tip(rig, aside));
      drive(rig, aside, 41e-3F, speed, see);
      drive(rig, {41e-3F, aside.y, aside.z}, 8e-3F, speed, see);
      EXPECT_GT(watch.jumps.events, 7) << speed << " m/s, " << side << " m aside";
      EXPECT_LT(watch.jumps.axial, 0.2) << speed << " m/s, " << side << " m aside";
      EXPECT_LT(watch.jumps.lateral, 0.2) << speed << " m/s, " << side << " m aside";
    }
  }
}

// The spring of the inserted tip is stiffer than that of contact, and takes over its force. (Tissue
// that recoils in the same tick changes a part of it. When the spring did not take over the force,
// the force tripled.)
TEST(Continuity, PunctureKeepsTheForceAcross) {
  Rig rig = make_rig(gel(), Config{});
  Vec3 tip = {4e-3F, kStart.y, kStart.z};
  drive(rig, kStart, tip.x, 10e-3F);
  for (int i = 0; i < 200; ++i) {
    tip.y += 5e-6F;
    (void)move_tip(rig, tip);
  }
  Output before = {}, now = {};
  for (int i = 0; i < 2000 && now.phase != Phase::kInserted; ++i) {
    tip.x += 10e-6F;
    before = now;
    now = move_tip(rig, tip);
  }
  ASSERT_EQ(now.phase, Phase::kInserted);
  const Vec3 across = {0, before.force_n.y, before.force_n.z};
  const Vec3 change = {0, now.force_n.y - before.force_n.y, now.force_n.z - before.force_n.z};
  EXPECT_GT(norm_of(across), 0.01);
  EXPECT_LT(norm_of(change), 0.5 * norm_of(across));
}

TEST(Continuity, FirstTouchStartsFromZero) {
  Rig rig = make_rig(gel(), Config{});
  Vec3 last = {};
  bool touched = false;
  drive(rig, kStart, 2e-3F, 10e-3F, [&](const Output& out) {
    if (out.phase != Phase::kContact) return;
    // Contact may be found one step late, so the needle may press in by its way of two steps, with
    // one spring.
    const double allowed = 2 * 10e-6 * static_cast<double>(rig.view().state.tip->stiffness_n_per_m);
    ASSERT_LT(norm_of(out.force_n - last), allowed);
    last = out.force_n;
    touched = true;
  });
  EXPECT_TRUE(touched);
}

// If nothing relaxes, no memory can take the force away. When a contact ends, the force that is
// left within its skin is a pull, at most as large as the skin allows.
TEST(Continuity, AContactThatDoesNotRelaxEndsWithoutAPull) {
  constexpr double kSkinM = 2e-5;
  TinyOrgan tiny = gel();
  tiny.materials[0].relaxing_fraction = 0;
  Rig rig = make_rig(tiny, Config{});
  const Output pressed = drive(rig, kStart, 1.5e-3F, 10e-3F);
  ASSERT_EQ(pressed.phase, Phase::kContact);
  ASSERT_LT(pressed.force_n.x, 0);
  double pull_n = 0, allowed_n = 0;
  const Output last =
      drive(rig, {1.5e-3F, kStart.y, kStart.z}, -1e-3F, 2e-3F, [&](const Output& out) {
        if (out.phase != Phase::kContact) return;
        pull_n = std::max(pull_n, static_cast<double>(out.force_n.x));
        allowed_n = kSkinM * static_cast<double>(rig.view().state.tip->full_stiffness_n_per_m);
      });
  EXPECT_EQ(last.phase, Phase::kFree);
  EXPECT_LE(pull_n, allowed_n);
}

// Insertions are compared by depth, not by time: the puncture's recoil makes the first one run
// through some depths faster than others.
struct Insertion {
  double entry_peak;                       // largest before 6 mm of depth
  std::array<std::vector<double>, 11> at;  // forces, by millimetre of depth from 14 mm on
};

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Insertion insert_and_leave(Rig& rig) {
  Insertion result = {};
  drive(rig, kStart, 32e-3F, 10e-3F, [&](const Output& out) {
    const double force = -static_cast<double>(out.force_n.x);
    if (out.depth_m < 6e-3F) result.entry_peak = std::max(result.entry_peak, force);
    const int bin = static_cast<int>(out.depth_m * 1e3F) - 14;
    if (bin >= 0 && bin < 11) result.at[static_cast<std::size_t>(bin)].push_back(force);
  });
  drive(rig, {32e-3F, kStart.y, kStart.z}, -15e-3F, 20e-3F);
  hold(rig, {-15e-3F, kStart.y, kStart.z}, 2000);
  return result;
}

TEST(Continuity, ASecondInsertionFollowsTheTrack) {
  Rig rig = make_rig(gel(), Config{});
  const Insertion first = insert_and_leave(rig);
  EXPECT_EQ(count_of(rig.kernel(), EventKind::kPuncture), 1U);
  EXPECT_EQ(count_of(rig.kernel(), EventKind::kExit), 1U);
  const Insertion second = insert_and_leave(rig);
  EXPECT_EQ(count_of(rig.kernel(), EventKind::kPuncture), 1U) << "no second puncture";
  EXPECT_EQ(count_of(rig.kernel(), EventKind::kReentry), 1U);
  EXPECT_NEAR(first.entry_peak, 0.4, 0.02);
  EXPECT_LT(second.entry_peak, 0.2);
  // At the same depth the friction is the same and the tip carries a quarter: the force is 0.15 N
  // less.
  for (std::size_t i = 0; i < first.at.size(); ++i) {
    EXPECT_NEAR(mean_of(first.at[i]) - mean_of(second.at[i]), 0.15, 0.01) << 14 + i << " mm";
  }
}

TEST(Continuity, ATrackElsewhereIsPuncturedAgain) {
  Rig rig = make_rig(gel(), Config{});
  insert_and_leave(rig);
  const Vec3 elsewhere = {-1e-3F, kStart.y + 4e-3F, kStart.z};
  drive(rig, elsewhere, 25e-3F, 10e-3F);
  EXPECT_EQ(count_of(rig.kernel(), EventKind::kPuncture), 2U);
  EXPECT_EQ(count_of(rig.kernel(), EventKind::kReentry), 0U);
}

// Two voxels hold the tip with different forces. As it cuts towards the plane between them and
// their weights become more alike, each of them must keep its force.
TEST(Continuity, VoxelsThatHoldTheTipDifferentlyGoOnDoingSo) {
  TinyOrgan tiny;
  tiny.nx = 2;
  tiny.ny = tiny.nz = 1;
  tiny.materials[0].cutting_force_n = 1e-3F;
  Rig rig = make_rig(tiny, Config{}, Tissue::kFixed);
  const float edge_m = rig.view().model.head->edge_m;
  const Vec3 from_m = {0.6F * edge_m, 0.5F * edge_m, 0.5F * edge_m};
  Vec3 tip_m = hold_tip(rig, from_m, 100);
  Particle& tip = *rig.view().state.tip;
  ASSERT_EQ(tip.support_count, 2U);
  for (std::uint32_t i = 0; i < 2; ++i) {
    const Vec3 aside = {0, i == 0 ? 1e-4F : -1e-4F, 0};
    tip.support[i].goal_m = tip.support[i].goal_m + aside;
    tip.support[i].offset_m = tip.support[i].offset_m + aside;
  }
  move_tip(rig, tip_m);
  const double before = spread_of(tip);
  ASSERT_GT(before, 1e-9);
  for (int i = 0; i < 1000; ++i) {
    tip_m.x += 1e-6F;
    move_tip(rig, tip_m);
  }
  EXPECT_GT(tip.rest_m.x, from_m.x + 0.5e-3F);
  EXPECT_GT(spread_of(tip), before);
}

}  // namespace
}  // namespace stylet::test
