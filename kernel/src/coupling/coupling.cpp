// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling.h"

#include "coupling/roll.h"
#include "coupling/stiffness.h"
#include "coupling/surface.h"

namespace stylet {
namespace {

// Part of the way to its rest that the give along the needle goes in a tick.
constexpr float kGiveRate = 0.5F;
// Slower than this a CP sticks.
constexpr float kSlidingMPerS = 1e-4F;
// The tip must be this far behind a shaft CP to have passed it: a tip that re-enters a track starts
// beside the first one.
constexpr float kTrackSkinM = 1e-5F;
// The tip finds the material at its goal within this distance of travel.
constexpr float kMaterialPullM = 1e-3F;
// A voxel's deformation is known this far from its centre, in voxel edges.
constexpr float kVoxelReach = 0.5F;
// Places at which the friction of a stretch of shaft is taken that the tip passes in a tick.
constexpr std::uint32_t kFrictionSamples = 4;
// In a gap a place for a shaft CP is looked for in steps of this many units.
constexpr float kGapStep = 0.25F;
// Just behind the entry all of a voxel counts as tissue, this far along the track, in voxel edges.
constexpr float kEntrySkin = 0.5F;
// Speed at which the puncture force of a material is given.
constexpr float kPunctureSpeedMPerS = 0.01F;
// The tip must go this far to come back to the layer it has just left, or for the log to tell it.
constexpr float kLayerSkinM = 5e-4F;
// A tip in contact must come this far clear of its goal to leave it: one that only slides sideways
// is not in and out with every rounding.
constexpr float kReleaseSkinM = 2e-5F;
// A hole's mouth, in the needle's outer radii: a contact so near an entry is at that entry, and a
// tip that has left its hole lies no deeper in it.
constexpr float kMouthInRadii = 3;
// At a tick's end CPs may carry so many times what they may where the needle has just moved.
constexpr float kLoose = 2.0F;
// Pressed on by more than this in a tick, a contact's spring is the law's chord, not its tangent.
constexpr float kChordM = 1e-5F;
// In a bend in contact, whose spring is the tangent from before it, the tip of an elastic needle
// takes tissue aside no farther than kChordM and this share of what it is off already: the
// tangent's force is 0.8 % below that of a law that goes with the square. A choice, no sensitivity.
constexpr float kAsideShare = 0.1F;
// Where all of a tick's creep would gain energy, at least this part of it is tried: with short
// times the spring gives way faster than the lattice follows.
constexpr float kLeastCreep = 1.0F / 16;
// A shaft CP keeps at least this part of its spring, so that forces can be divided by it.
constexpr float kLeastPart = 0.002F;
// Tissue pressed to less than this part of its volume, or turned inside out, has no direction that
// is better than another.
constexpr float kCrushed = 0.05F;
// Speeds over kPunctureSpeedMPerS between which pressing faster makes a puncture easier.
constexpr float kSlowestPress = 0.01F, kFastestPress = 100.0F;
// A needle at the mouth of a hole goes into it if it points as the hole does, within 18 degrees.
constexpr float kSameWayCosine = 0.95F;

// ---- residuals and forces
// -------------------------------------------------------------------------

// Mean square of how the shares' residuals differ from their mean.
float spread_of(const Particle& p, Vec3 mean_m) {
  float sum = 0;
  for (std::uint32_t i = 0; i < p.share_count; ++i) {
    const Vec3 off = (p.position_m - p.share[i].goal_m) - mean_m;
    sum += p.share[i].weight * dot(off, off);
  }
  return sum;
}

// Energy in the Maxwell branch; of one CP, see creep.
double memory_energy(const Particle& p) {
  const float share = p.memory_share * (1 - p.memory_share);
  return 0.5 * static_cast<double>(share * max_of(dot(p.memory_n, p.memory_m), 0));
}

// How the shares of a CP lie: their mean residual, and how much they differ from it.
struct Drawn {
  Vec3 residual_m;
  float spread_m2;
};
Drawn drawn(const Particle& p) {
  const Vec3 mean = residual(p);
  return {mean, spread_of(p, mean)};
}

// Energy in a CP's spring, Maxwell branch and give; for the tip in contact see contact_energy.
double spring_energy(const Particle& p, const Drawn& d) {
  const Vec3 lasting = d.residual_m - p.slack_m;
  const float give =
      p.give_share > 0 ? (1 - p.give_share) / p.give_share * dot(p.give_m, p.give_m) : 0.0F;
  const float sum = dot(lasting, lasting) + d.spread_m2 + give;
  return 0.5 * static_cast<double>(p.stiffness_n_per_m * sum) + memory_energy(p);
}
double spring_energy(const Particle& p) {
  return spring_energy(p, drawn(p));
}

// The residual is the give, the relaxed part of the spring, and what pulls.
void set_slack(Particle& p) {
  p.slack_m = p.memory_share * p.memory_m + p.give_m;
}

// Fresh tissue, which has relaxed nothing yet.
void forget(Particle& p) {
  p.memory_m = p.memory_n = {};
  p.memory_spread = 0;
  set_slack(p);
}

void shift_goal(Share& share, Vec3 step_m) {
  share.offset_m = share.offset_m + transposed_times(rotation_matrix(share.turn), step_m);
  share.goal_m = share.goal_m + step_m;
}

// Lets a CP hold tissue that lies `step_m` farther on: its goals move by that.
void shift_goals(Particle& p, Vec3 step_m) {
  for (std::uint32_t i = 0; i < p.share_count; ++i) shift_goal(p.share[i], step_m);
}

// Draws each goal a part of the way to the needle.
void draw_goals(Particle& p, float part) {
  for (std::uint32_t i = 0; i < p.share_count; ++i) {
    shift_goal(p.share[i], part * (p.position_m - p.share[i].goal_m));
  }
}

// Draws the shares of a CP together, so that its residual is `residual_m` and their spread at most
// `spread_m2`: new weights must neither be felt nor bring energy along.
void gather_goals(Particle& p, Vec3 residual_m, float spread_m2) {
  const auto [mean, spread] = drawn(p);
  const float part = spread > spread_m2 ? 1 - std::sqrt(spread_m2 / spread) : 0.0F;
  for (std::uint32_t i = 0; i < p.share_count; ++i) {
    const Vec3 off = (p.position_m - p.share[i].goal_m) - mean;
    shift_goal(p.share[i], (mean - residual_m) + part * off);
  }
}

std::uint32_t heaviest(const Particle& p) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < p.share_count; ++i) {
    if (p.share[i].weight > p.share[best].weight) best = i;
  }
  return best;
}

// Takes the voxels around the CP's rest place. A voxel that is kept keeps its offset; a new one is
// given the residual the CP has. The force does not change, and the energy does not rise.
void renew_shares(const View& view, Particle& p, Sharing sharing = Sharing::kTent) {
  const auto [residual_m, spread_m2] = drawn(p);
  Share found[kSharesPerParticle];
  const std::uint32_t count = find_shares(view, p.rest_m, found, sharing);
  for (std::uint32_t i = 0; i < count; ++i) {
    Share& share = found[i];
    bool kept = false;
    for (std::uint32_t old = 0; old < p.share_count; ++old) {
      if (p.share[old].slot != share.slot) continue;
      share.offset_m = p.share[old].offset_m;
      share.goal_m = p.share[old].goal_m;
      share.turn = p.share[old].turn;
      kept = true;
    }
    if (kept) continue;
    const FitFrame frame = fit_frame(view, share.slot, share.row);
    share.turn = frame.turn;
    share.goal_m = p.position_m - residual_m;
    share.offset_m = transposed_times(rotation_matrix(frame.turn), share.goal_m - frame.centre_m);
  }
  for (std::uint32_t i = 0; i < count; ++i) p.share[i] = found[i];
  p.share_count = count;
  gather_goals(p, residual_m, spread_m2);
  if (count == 0) return;
  const std::uint32_t there = material_at(view, p.rest_m);
  p.material = there != kNoTissue ? there : view.model.slot_material[p.share[heaviest(p)].slot];
}

// Where the goal of a share lies in unloaded tissue; that of a CP, the mean of them.
Vec3 unloaded_place(const View& view, const Share& share) {
  return rest_centre(view, share.slot, view.model.row[share.row]) + share.offset_m;
}
Vec3 unloaded_place(const View& view, const Particle& p) {
  Vec3 sum = {};
  for (std::uint32_t i = 0; i < p.share_count; ++i) {
    sum = sum + p.share[i].weight * unloaded_place(view, p.share[i]);
  }
  return sum;
}

// For a CP that keeps its voxels: each of those around it holds the needle alike, so that a row of
// CPs is as stiff and as thick wherever it runs between voxel centres.
void share_evenly(const View& view, Particle& p) {
  const std::uint32_t material = p.material;
  renew_shares(view, p, Sharing::kEven);
  p.material = material;
  if (p.share_count > 0) p.rest_m = unloaded_place(view, p);
}

// For the tip in contact: the voxels around the place one edge deeper hold it, at a face those of
// two layers, each as much as it is stiff (fat does not carry what presses on skin). Held by the
// outer layer alone it presses the lattice in by an amount that no formula of Poisson's ratio and
// place gave.
void share_deeper(const View& view, Particle& p, Vec3 direction) {
  if (p.share_count == 0) return;
  const VoxelFrame frame = voxel_frame(view, p.share[heaviest(p)].slot, p.share[heaviest(p)].row);
  const Particle before = p;
  const float edge_m = view.model.head->edge_m;
  p.rest_m = p.rest_m + edge_m * transposed_times(frame.rotation, direction);
  renew_shares(view, p, Sharing::kStiff);
  if (p.share_count == 0) p = before;
  p.rest_m = before.rest_m;
  p.material = before.material;
}

// Puts a CP at a rest place with its goals at `place_m` (rigid pull-back: fits, goals and energy of
// all voxels stay as they are when the needle holds it there).
Particle new_particle(const View& view, const Needle& needle, Vec3 rest_m, Vec3 place_m,
                      float track_m, float arc_m, Place place) {
  Particle p = {};
  p.rest_m = rest_m;
  p.position_m = place_m;
  p.track_m = track_m;
  p.arc_m = arc_m;
  renew_shares(view, p);
  const bool physical = view.model.head->config.mode == Mode::kPhysical;
  if (place == Place::kShaft && physical) share_evenly(view, p);
  if (place == Place::kSurface && physical) share_deeper(view, p, needle.tip_direction);
  set_stiffness(view, p, place);
  // No depth yet: the law's spring is soft there, and a stiff one would hold an elastic needle back
  // until the next tick lets it go.
  if (place == Place::kSurface && physical) {
    p.stiffness_n_per_m = kLeastPart * p.full_stiffness_n_per_m;
  }
  return p;
}

// A CP whose voxels found no room (keep_shares) takes those around it again: next time there may
// be.
void refill_shares(const View& view, Particle& p) {
  StateHead& state = *view.state.head;
  if (state.cp_voxel_pool_full == 0 || p.share_count == kSharesPerParticle) return;
  const std::uint32_t material = p.material;
  const double before = spring_energy(p);
  renew_shares(view, p, Sharing::kEven);  // a voxel a CP, as in paper mode, fills no pool
  p.material = material;
  state.friction_j += before - spring_energy(p);
}

// Deformation of the tissue around a CP: displacement gradient, averaged over its shares.
struct Gradient {
  Vec3 c0, c1, c2;  // columns of I + gradient
  float det;
};

Gradient gradient_around(const View& view, const Particle& p) {
  float f[9] = {};
  for (std::uint32_t i = 0; i < p.share_count; ++i) {
    const Corners corners = sum_corners(view, p.share[i].slot, p.share[i].row);
    for (int j = 0; j < 9; ++j) f[j] += p.share[i].weight * corners.gradient[j];
  }
  Gradient g = {{1 + f[0], f[3], f[6]}, {f[1], 1 + f[4], f[7]}, {f[2], f[5], 1 + f[8]}, 0};
  g.det = dot(g.c0, cross(g.c1, g.c2));
  return g;
}

// Rest-frame image of a step in deformed tissue. Rest places must follow the material, not the
// rotation alone: else a needle that leaves strained tissue does not find its way back to its
// entry.
Vec3 pull_back(const Gradient& g, Vec3 step) {
  if (!(g.det > kCrushed)) return step;
  return (1 / g.det) * Vec3{dot(step, cross(g.c1, g.c2)), dot(step, cross(g.c2, g.c0)),
                            dot(step, cross(g.c0, g.c1))};
}

// The same for a step of some length. A voxel's deformation says nothing about the next one: in
// tissue pressed to a fraction of its length (the dimple of a puncture) the image ends within the
// voxel.
Vec3 pull_back_step(const View& view, const Gradient& g, Vec3 step_m) {
  const Vec3 image = pull_back(g, step_m);
  const float length = norm(image);
  const float most = max_of(kVoxelReach * view.model.head->edge_m, norm(step_m));
  return length > most ? (most / length) * image : image;
}

// Moves the tissue that the tip holds forward by `move_m` along the needle. The step is integrated
// in the rest frame; while it moves, or when they are voxels apart, the tip's rest place is drawn
// to the material that really lies at its goal, so that errors of the integration do not pile up.
void advance_tip(const View& view, Particle& tip, Vec3 direction, float move_m) {
  const Gradient g = gradient_around(view, tip);
  const Vec3 step = move_m * direction;
  const Vec3 image = tip.share_count > 0 ? pull_back_step(view, g, step) : step;
  shift_goals(tip, step);
  tip.rest_m = tip.rest_m + image;
  tip.track_m += move_m < 0 ? -norm(image) : norm(image);
  Vec3 present = {};
  if (tip.share_count == 0 || !present_place(view, tip.rest_m, present)) return;
  const Vec3 off = (tip.position_m - residual(tip)) - present;
  const float size = move_m < 0 ? -move_m : move_m;
  const Vec3 miss = (size / (size + kMaterialPullM)) * pull_back_step(view, g, off);
  tip.rest_m = tip.rest_m + miss;
  const Vec3 along = pull_back(g, direction);
  tip.track_m += dot(miss, along) / norm(along);
}

// ---- the return map
// -------------------------------------------------------------------------------

// How far the CP must move for its axial force to come back between the limits. Paper mode: whole
// needle units, once the point is more than one unit away from its goal.
float overshoot(const View& view, const Particle& p, float axial_n, float low_n, float high_n) {
  const ModelHead& head = *view.model.head;
  if (head.config.mode == Mode::kPaper) {
    const float unit = view.needle_config().unit_m;
    const float away = axial_n / p.stiffness_n_per_m;
    constexpr auto kMost = static_cast<float>(kMaxUnitsPerTick);
    const float units = clamp(away / unit, -kMost, kMost);
    return is_finite(units) ? whole_part(units) * unit : 0;  // else a fault, at the tick's end
  }
  const float excess =
      axial_n > high_n ? axial_n - high_n : (axial_n < low_n ? axial_n - low_n : 0);
  return excess / p.stiffness_n_per_m;
}

// A slip brings fresh tissue to the needle, which has relaxed nothing yet. The force stays: returns
// how much farther the CP slips for that, and books what the branch loses.
float renew(const View& view, Particle& p, Vec3 direction, float slip_m, double& booked_j) {
  const float size = slip_m < 0 ? -slip_m : slip_m;
  if (!(size > kSlidingMPerS * view.model.head->config.period_s)) return 0;
  const double before = memory_energy(p);
  const float along = dot(p.slack_m, direction);
  const float part = size / (kRenewalLengthM + size);
  p.memory_m = settle(p.memory_m - part * dot(p.memory_m, direction) * direction);
  p.memory_n = settle(p.memory_n - part * dot(p.memory_n, direction) * direction);
  p.memory_spread = (1 - part) * p.memory_spread;
  set_slack(p);
  const double after = memory_energy(p);
  // It would rise where what is forgotten was negative.
  if (after > before) p.memory_n = settle(static_cast<float>(before / after) * p.memory_n);
  booked_j += before - memory_energy(p);
  return along - dot(p.slack_m, direction);
}

// All of the force must relax, not the part that the CP's own spring has in it. With d the way of
// the needle's point from where its tissue lies unloaded, all CPs' forces are F = K d: K is the
// springs and the lattice behind them, whatever that is. So each spring ends phi m behind that
// point, m' = (d - m) / tau, and all of F relaxes by the part phi in the time tau. (d is the
// needle's way alone: no swing of the tissue feeds back. Nor is it how far others had moved the
// tissue that this one came to, by which it is not pulled.) That takes a Maxwell branch with the
// energy phi (1 - phi) m n / 2 summed over all CPs, n = K m, which needs no K: n' = (F + phi n - n)
// / tau. Where one CP's m n is below 0 it stores nothing.
//
// A CP's shares hold the tissue as it was deformed when the CP took hold of it. So their d differ;
// as these do not change, the places where they lie unloaded are drawn together by that part.
//
// The branch goes this part of its way; `residual_m` is the CP's.
void creep(const View& view, Particle& p, Vec3 residual_m, float part) {
  const Vec3 rest_m = unloaded_place(view, p);
  const Vec3 d = (p.position_m - rest_m) - view.state.needle->moved_m;
  const Vec3 f = force_on_tissue(p, residual_m) + p.memory_share * p.memory_n;
  p.memory_m = settle(p.memory_m + part * (d - p.memory_m));
  p.memory_n = settle(p.memory_n + part * (f - p.memory_n));
  set_slack(p);
  const float before = p.memory_spread;
  p.memory_spread = before + part * (p.memory_share - before);
  if (p.memory_spread == before) return;
  const float drawn = (p.memory_spread - before) / max_of(1 - before, kLeastPart);
  for (std::uint32_t i = 0; i < p.share_count; ++i) {
    Share& share = p.share[i];
    const Vec3 step = drawn * (rest_m - unloaded_place(view, share));
    share.offset_m = share.offset_m + step;
    share.goal_m = share.goal_m + rotation_matrix(share.turn) * step;
  }
}

// The Maxwell branch creeps by this part of its way; what it dissipates is booked, and may be spent
// by others (`spare_j`). Energy must not rise by more than that: else nothing changes, and how much
// it would have risen is returned.
double try_creep(const View& view, Particle& p, Drawn& shares, float part, double& spare_j) {
  if (p.memory_share == 0 || p.share_count == 0) return 0;
  const Particle before = p;
  const double before_j = spring_energy(p, shares);
  creep(view, p, shares.residual_m, part);
  const Drawn crept = drawn(p);
  const double rise_j = spring_energy(p, crept) - before_j;
  if (rise_j <= spare_j) {
    spare_j -= rise_j;
    view.state.head->relaxation_j -= rise_j;
    shares = crept;
    return 0;
  }
  p = before;
  return rise_j;
}

// The Maxwell branch creeps for a tick. False: it did not, for energy would rise.
bool relax(const View& view, Particle& p, Drawn& shares, double& spare_j) {
  return try_creep(view, p, shares, 1 - p.memory_keep, spare_j) == 0;
}

// The same for one that has to be paid by the others: as far as they do.
void relax_late(const View& view, Particle& p, Drawn& shares, double& spare_j) {
  const float all = 1 - p.memory_keep;
  const double rise_j = try_creep(view, p, shares, all, spare_j);
  if (rise_j == 0) return;
  const float part = all * max_of(kLeastCreep, static_cast<float>(spare_j / rise_j));
  (void)try_creep(view, p, shares, part, spare_j);
}

// The give follows the force along the needle, as over a damper. Only what lies along: to take back
// what lies across would take work against the force there.
void give_way(StateHead& state, Particle& p, const Drawn& shares, Vec3 direction) {
  if (p.give_share == 0) return;
  const double before_j = spring_energy(p, shares);
  const float pull_m = dot(force_on_tissue(p, shares.residual_m), direction) / p.stiffness_n_per_m;
  const float to_go_m = p.give_share * pull_m - (1 - p.give_share) * dot(p.give_m, direction);
  p.give_m = settle(p.give_m + kGiveRate * to_go_m * direction);
  set_slack(p);
  state.relaxation_j += before_j - spring_energy(p, shares);
}

void note_slip(const ModelHead& head, Particle& p, float slip_m) {
  const float speed = (slip_m < 0 ? -slip_m : slip_m) / head.config.period_s;
  p.slip_m_per_s = settle(speed + head.velocity_keep * (p.slip_m_per_s - speed));
}

// A part of that slip was none.
void note_no_slip(const ModelHead& head, Particle& p, float slip_m) {
  const float speed = (slip_m < 0 ? -slip_m : slip_m) / head.config.period_s;
  p.slip_m_per_s = settle(max_of(p.slip_m_per_s - (1 - head.velocity_keep) * speed, 0));
}

// Shaft length a CP stands for.
float length_of(const View& view, const Particle& p) {
  return clamp(view.state.needle->tissue_track_m - p.track_m, 0, view.needle_config().unit_m);
}

// Gives a CP the spring of the shaft it stands for: that and friction vanish when the tip comes
// back to it, so that neither friction nor clamping jumps when it is added or removed. What that
// costs is booked as friction.
void stand_for(const View& view, Particle& p) {
  const bool paper = view.model.head->config.mode == Mode::kPaper;
  const float part =
      paper ? 1.0F : max_of(length_of(view, p) / view.needle_config().unit_m, kLeastPart);
  const float stiffness = part * p.full_stiffness_n_per_m;
  if (stiffness == p.stiffness_n_per_m) return;
  const double before = spring_energy(p);
  // What is added holds its tissue where it lies, without force.
  if (stiffness > p.stiffness_n_per_m) {
    const float old = p.stiffness_n_per_m / stiffness;
    draw_goals(p, 1 - old);
    p.memory_m = old * p.memory_m;
    p.give_m = old * p.give_m;
    p.slack_m = old * p.slack_m;
  } else {
    p.memory_n = (stiffness / p.stiffness_n_per_m) * p.memory_n;
  }
  p.stiffness_n_per_m = stiffness;
  view.state.head->friction_j += before - spring_energy(p);
}

// Friction per metre of shaft at a slip speed: Coulomb, static (Stribeck), viscous.
float friction_n_per_m(const Friction& f, float speed_m_per_s) {
  const float s = speed_m_per_s * f.inverse_stribeck_s_per_m;
  return f.coulomb_n_per_m +
         (f.static_n_per_m - f.coulomb_n_per_m) * exp_minus(min_of(s * s, 80.0F)) +
         f.viscous_n_s_per_m2 * speed_m_per_s;
}

float drawn_to(float mean, float value, float part) {
  return mean + part * (value - mean);
}

void meet(Particle& p, const Friction& met, float part) {
  Friction& f = p.friction;
  f = {drawn_to(f.coulomb_n_per_m, met.coulomb_n_per_m, part),
       drawn_to(f.static_n_per_m, met.static_n_per_m, part),
       drawn_to(f.inverse_stribeck_s_per_m, met.inverse_stribeck_s_per_m, part),
       drawn_to(f.viscous_n_s_per_m2, met.viscous_n_s_per_m2, part)};
}

// None in a gap.
Friction friction_at(const View& view, Vec3 rest_m) {
  const std::uint32_t there = material_at(view, rest_m);
  return there == kNoTissue ? Friction{} : view.model.head->material[there].friction;
}

// The stretch a CP stands for may lie in several materials: its friction is their mean, taken on
// the way on which the tip passed it in this tick, from `from_m` in the rest frame and
// `from_track_m` on the track. (The CP's own place would be one sample of a unit of shaft.)
void meet_friction(const View& view, Vec3 from_m, float from_track_m) {
  const Particle& tip = *view.state.tip;
  for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
    Particle& p = view.state.shaft[i];
    const float length = length_of(view, p), grown = length - p.met_m;
    if (!(grown > 0)) continue;
    const float step = grown * (1.0F / kFrictionSamples), all = tip.track_m - from_track_m;
    for (std::uint32_t k = 0; k < kFrictionSamples; ++k) {
      const float at = p.track_m + p.met_m + 0.5F * step - from_track_m;
      const float part = all > 0 ? clamp(at / all, 0, 1) : 1.0F;
      p.met_m += step;
      meet(p, friction_at(view, from_m + part * (tip.rest_m - from_m)), step / p.met_m);
    }
    p.met_m = length;  // exactly, or rounding is met again and again
  }
}

// By how much the needle's motion in this tick pulls the spring of a CP of the shaft, or of the
// tip, the last: substep by substep (place_members).
Vec3& stretch_of(const View& view, std::uint32_t index) {
  return view.scratch.stretch[view.needle * kNeedleParticles + index];
}

void slip_shaft(const View& view, const Needle& needle) {
  const ModelHead& head = *view.model.head;
  StateHead& state = *view.state.head;
  NeedleState& own = *view.state.needle;
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    Particle& p = view.state.shaft[i];
    // All that changes the spring comes before the return map, which has the last word on the
    // force.
    stand_for(view, p);
    const float limit = friction_limit_n(view, p);
    const Vec3 direction = needle_point(needle, p.arc_m).direction;
    const Vec3 residual_m = residual(p), force = force_on_tissue(p, residual_m);
    const float slip = overshoot(view, p, dot(force, direction), -limit, limit);
    stretch_of(view, i) = (1 / p.stiffness_n_per_m) * (force - p.force_n) - slip * direction;
    const float all = slip + renew(view, p, direction, slip, state.friction_j);
    p.arc_m += all;
    p.position_m = needle_place(needle, p.arc_m);
    note_slip(head, p, all);
    p.slip_m = slip * direction;
  }
}

// Force that breaks a surface: less when pressed faster (Mahvash and Dupont 2010).
float puncture_force(const View& view, const MaterialModel& m) {
  const float v =
      clamp(view.state.needle->press_m_per_s / kPunctureSpeedMPerS, kSlowestPress, kFastestPress);
  return m.puncture_n * power(v, -m.puncture_exponent);
}

// Takes the spring the tip has against the material it has come to: a stiffer one holds at the same
// force, and fresh tissue has relaxed nothing yet. What is lost counts as cutting.
void enter_material(const View& view, Particle& tip) {
  const double before = spring_energy(tip);
  const float old = tip.stiffness_n_per_m;
  shift_goals(tip, tip.slack_m);
  forget(tip);
  set_stiffness(view, tip, Place::kTip);
  if (tip.stiffness_n_per_m > old) draw_goals(tip, 1 - old / tip.stiffness_n_per_m);
  view.state.head->cutting_j += before - spring_energy(tip);
}

// What the log last told of this needle's layer. Only there: the tip's forces follow where it is.
struct Told {
  bool known, crossed;          // known: it is still in the log; crossed: by a layer's event
  std::uint32_t layer, before;  // and the one told before that
  float track_m;
};

bool tells_layer(const Event& e, std::uint32_t needle) {
  return e.needle == needle && (e.kind == EventKind::kLayer || e.kind == EventKind::kPuncture ||
                                e.kind == EventKind::kReentry);
}

Told told_layer(const View& view) {
  const std::uint32_t all = view.state.head->event_count;
  const std::uint32_t kept = all < kMaxEvents ? all : kMaxEvents;
  Told told = {};
  for (std::uint32_t i = 1; i <= kept; ++i) {
    const Event& e = view.state.event[(all - i) % kMaxEvents];
    if (!tells_layer(e, view.needle)) continue;
    told.before = e.layer;
    if (told.known) return told;
    told = {true, e.kind == EventKind::kLayer, e.layer, kNoLayer, e.depth_m};
  }
  return told;
}

bool is_near(const Told& told, float track_m) {
  const float since = track_m - told.track_m;
  return since < kLayerSkinM && since > -kLayerSkinM;
}

// The needle's layer has changed, at this force: told, unless it only comes back to the layer told
// before the last one, near where it left that.
void tell_layer(const View& view, float force_n) {
  const Told told = told_layer(view);
  const bool back = told.known && told.crossed && view.state.needle->layer == told.before &&
                    is_near(told, view.state.tip->track_m);
  if (!back) add_event(view, EventKind::kLayer, force_n);
}

// What was not told there is told from here, where it has stayed.
void tell_layer_late(const View& view) {
  const Told told = told_layer(view);
  if (!told.known || told.layer == view.state.needle->layer) return;
  if (!is_near(told, view.state.tip->track_m)) add_event(view, EventKind::kLayer, 0);
}

// The tip has come to another material. A layer that must be punctured holds it until it is pressed
// on hard enough, but for one it has been through before: in a track, or on the way back.
void enter_layer(const View& view, Particle& tip, Vec3 direction, bool in_track) {
  NeedleState& own = *view.state.needle;
  const ModelHead& head = *view.model.head;
  if (tip.material == own.layer) return;
  const float axial = dot(force_on_tissue(tip), direction);
  if (own.spring_layer != tip.material) enter_material(view, tip);
  own.spring_layer = tip.material;
  // A tip at the face between two layers is not in and out of them with every tremor.
  const float since = tip.track_m - own.layer_track_m;
  if (tip.material == own.layer_before && since < kLayerSkinM && since > -kLayerSkinM) return;
  const MaterialModel& m = head.material[tip.material];
  const bool must = m.puncture_n > m.cutting_n && !in_track && own.phase != Phase::kRetracting &&
                    head.config.mode == Mode::kPhysical;
  if (must && axial < puncture_force(view, m)) return;
  own.layer_before = own.layer;
  own.layer_track_m = tip.track_m;
  own.layer = tip.material;
  if (must) {
    add_event(view, EventKind::kPuncture, max_of(axial, 0));
  } else {
    tell_layer(view, max_of(axial, 0));
  }
}

// Force the tip may carry: nothing when pulled, the cutting force when pushed into new tissue, a
// fraction of it in a track that exists, the puncture force before a layer that holds it.
float tip_limit(const View& view, const Particle& tip, bool in_track) {
  const MaterialModel& m = view.model.head->material[tip.material];
  if (in_track) return m.cutting_n * m.recut_fraction;
  if (tip.material == view.state.needle->layer) return m.cutting_n;
  return max_of(puncture_force(view, m), m.cutting_n);
}

// Where the tip cuts after `advance_m` more; an unbevelled one cuts where it points.
Vec3 turn_cut(const View& view, const Needle& needle, float advance_m) {
  const float bevel = view.needle_config().bevel_per_m;
  if (!(bevel > 0)) return needle.tip_direction;
  return turn_cut(view.state.needle->cut, needle, bevel, advance_m);
}

// The tip moves on to other tissue as far as it is pressed or pulled beyond its limits, along the
// way it cuts: a bevel that is pushed aside against the tissue's force has to be paid for by the
// hand that pushes.
void cut_tip(const View& view, const Needle& needle, float moved_m) {
  const ModelHead& head = *view.model.head;
  StateHead& state = *view.state.head;
  NeedleState& own = *view.state.needle;
  Particle& tip = *view.state.tip;
  const Vec3 direction = turn_cut(view, needle, 0);
  float move = moved_m;  // outside the tissue the tip carries nothing and follows the needle
  float all = move;
  if (tip.share_count > 0) {
    const bool in_track = tip.track_m < own.track_end_m;
    enter_layer(view, tip, direction, in_track);
    const float axial = dot(force_on_tissue(tip), direction);
    move = overshoot(view, tip, axial, 0, tip_limit(view, tip, in_track));
    all = move + renew(view, tip, direction, move, state.cutting_j);
  }
  const Vec3 cut = turn_cut(view, needle, 0.5F * all);
  advance_tip(view, tip, cut, all);
  own.cut = cut;  // half of the turn is behind the tip
  own.cut = turn_cut(view, needle, 0.5F * all);
  note_slip(head, tip, all);
  tip.slip_m = move * cut;
  if (move > 0) own.phase = Phase::kInserted;
  if (move < 0) own.phase = Phase::kRetracting;
}

// Whether a place of the track lies in tissue. Just behind the entry the surface has the word: the
// planes of mixed voxels lie a little beside it.
bool holds_track(const View& view, Vec3 rest_m, float track_m) {
  if (track_m < kEntrySkin * view.model.head->edge_m) return inside_lattice(view, rest_m);
  return material_at(view, rest_m) != kNoTissue;
}

// Takes the voxels where the tip now is. Shares that fade take along what their goals differ from
// the others'; a tip that leaves, all.
void rehome_tip(const View& view) {
  NeedleState& own = *view.state.needle;
  Particle& tip = *view.state.tip;
  const double before = spring_energy(tip);
  renew_shares(view, tip);
  if (!holds_track(view, tip.rest_m, tip.track_m)) {
    tip.share_count = 0;
    forget(tip);
  }
  view.state.head->cutting_j += before - spring_energy(tip);
  if (tip.share_count > 0) own.tissue_track_m = tip.track_m;
  own.track_end_m = max_of(own.track_end_m, tip.track_m);
}

// ---- adding and removing
// --------------------------------------------------------------------------

std::uint32_t push_shaft(const View& view, Particle p) {
  StateHead& state = *view.state.head;
  NeedleState& own = *view.state.needle;
  if (own.shaft_count == kMaxConstraintParticles) {
    ++state.cp_pool_full;
    return kFlagCpPoolFull;
  }
  stand_for(view, p);
  stretch_of(view, own.shaft_count) = {};
  view.state.shaft[own.shaft_count++] = p;
  own.shaft_max = own.shaft_count > own.shaft_max ? own.shaft_count : own.shaft_max;
  return 0;
}

// Where on the needle a point of the tissue near the tip is: the arc length from the tip.
float arc_at(const View& view, const Needle& needle, Vec3 rest_m, float otherwise_m) {
  Vec3 present = {};
  if (!present_place(view, rest_m, present)) return otherwise_m;
  return max_of(dot(needle.tip_m - present, needle.tip_direction), 0);
}

// One shaft CP for each unit of track the tip has left behind, but for gaps between organs. The
// track is as long as the tissue at rest: so near the tip it is straight there, and the needle
// holds what was on it. Tissue that the tip pushes before it may end before that: there the needle
// holds what the tip has passed.
std::uint32_t drop_shaft(const View& view, const Needle& needle) {
  NeedleState& own = *view.state.needle;
  const Particle& tip = *view.state.tip;
  const float unit = view.needle_config().unit_m;
  if (tip.share_count == 0) return 0;  // the stretch lies outside the tissue
  if (own.drop_track_m > tip.track_m) {
    own.drop_track_m = view.state.shaft[own.shaft_count - 1].track_m;
  }
  if (tip.track_m - (own.drop_track_m + unit) < 0) return 0;
  const Gradient g = gradient_around(view, tip);
  const Vec3 image = pull_back(g, needle.tip_direction);
  const Vec3 along = (1 / norm(image)) * image;
  const Vec3 point = tip.rest_m + pull_back_step(view, g, residual(tip));  // at the needle's tip
  for (std::uint32_t drop = 0; drop < kMaxDropsPerTick; ++drop) {
    const float track = own.drop_track_m + unit, behind = tip.track_m - track;
    if (behind < 0) return 0;
    Vec3 rest = point - behind * along;
    if (!holds_track(view, rest, track)) rest = tip.rest_m - behind * along;
    const float arc = arc_at(view, needle, rest, behind);
    const Particle p =
        new_particle(view, needle, rest, needle_place(needle, arc), track, arc, Place::kShaft);
    if (p.share_count == 0 || !holds_track(view, rest, track)) {
      own.drop_track_m += kGapStep * unit;
      continue;
    }
    const std::uint32_t flags = push_shaft(view, p);
    if (flags != 0) return flags;
    own.drop_track_m = track;
  }
  return 0;
}

// The tip has come back past a shaft CP: along the track, or, when a violent hand has made the
// track unreliable, by the needle's own length.
bool is_behind(const View& view, const Particle& p) {
  return view.state.tip->track_m < p.track_m - kTrackSkinM ||
         p.arc_m < -view.needle_config().unit_m;
}

void end_insertion(const View& view) {
  NeedleState& own = *view.state.needle;
  add_event(view, EventKind::kExit, 0);
  if (own.track_current != kNoTrack) {
    view.state.track[own.track_current].length_m = own.track_end_m;
  }
  own.track_current = kNoTrack;
  own.shaft_count = 0;
  own.tip_alive = 0;
  own.phase = Phase::kFree;
  own.layer = kNoLayer;
  own.leaving = 1;
}

float mouth_m(const View& view) {
  return kMouthInRadii * view.needle_config().outer_radius_m;
}

// The track this contact enters, if the tissue remembers one here.
std::uint32_t find_track(const View& view, Vec3 rest_m, Vec3 rest_direction) {
  const StateHead& state = *view.state.head;
  const float reach = mouth_m(view);
  for (std::uint32_t i = 0; i < state.track_count; ++i) {
    const Track& track = view.state.track[i];
    const Vec3 gap = track.entry_rest_m - rest_m;
    if (dot(gap, gap) < reach * reach &&
        dot(track.direction_rest, rest_direction) > kSameWayCosine) {
      return i;
    }
  }
  return kNoTrack;
}

std::uint32_t remember_track(const View& view, Vec3 rest_m, Vec3 rest_direction) {
  StateHead& state = *view.state.head;
  const std::uint32_t index = state.track_next;
  view.state.track[index] = {rest_m, rest_direction, 0};
  state.track_next = (index + 1) % kMaxTracks;
  if (state.track_count < kMaxTracks) ++state.track_count;
  state.track_max = state.track_count;
  return index;
}

// The spread of the shares about their mean is carried by the spring of the moment.
double contact_energy(const View& view, const Particle& p) {
  if (view.model.head->config.mode == Mode::kPaper) return spring_energy(p);
  const Vec3 d = residual(p);
  return contact_energy(law_of(view), d, p.full_stiffness_n_per_m * p.memory_m) +
         0.5 * static_cast<double>(p.stiffness_n_per_m * spread_of(p, d));
}

// The spring of the coming fit: the law's tangent. Where the needle has just pressed on, tissue
// gives way until the depth is about what it was, and there the tangent would lie far below the
// law: the hand would press for less than is stored. So there it is the chord to that depth.
float contact_spring(const ContactLaw& law, float depth_m, float before_m) {
  const float tangent = cone_tangent(law.now, depth_m);
  if (!(depth_m - before_m > kChordM)) return tangent;
  const float change =
      contact_secant(law, depth_m) * depth_m - contact_secant(law, before_m) * before_m;
  return min_of(tangent, change / (depth_m - before_m));
}

// Creep of the contact, whose needle has moved by `step_m`; then its spring. Tissue that has crept
// can let go of the tip but not pull it: what is missing is bounded by that.
void relax_contact(const View& view, Vec3 direction, Vec3 step_m) {
  StateHead& state = *view.state.head;
  Particle& p = *view.state.tip;
  const ContactLaw law = law_of(view);
  const double before = contact_energy(view, p);
  const Vec3 d = residual(p);
  const float depth = norm(d), period_s = view.model.head->config.period_s;
  const Vec3 force = contact_secant(law, depth) * d;
  const Vec3 all = missing_secant(law, depth) * d;
  const float k = p.full_stiffness_n_per_m;
  const float time_s =
      view.model.head->material[p.material].relaxation_time_s * relaxation_pace(law, depth);
  const float keep = exp_minus(period_s / max_of(time_s, period_s));
  Vec3 missing = all + keep * (k * p.memory_m - all);
  const float pull = dot(missing - force, direction);
  if (pull > 0 && law.fraction > 0) missing = missing - pull * direction;
  p.memory_m = settle((1 / k) * missing);
  state.relaxation_j += before - contact_energy(view, p);
  const float old = p.stiffness_n_per_m;
  p.stiffness_n_per_m = max_of(contact_spring(law, depth, norm(d - step_m)), kLeastPart * k);
  gather_goals(p, d, spread_of(p, d) * min_of(old / p.stiffness_n_per_m, 1));
  p.slack_m = settle(d - (1 / p.stiffness_n_per_m) * (force - missing));
}

// From the spring of contact to that of cutting, at the same force along the needle and across; the
// difference of their energies is spent on the rupture.
void change_spring(const View& view, const Needle& needle, float force_n) {
  StateHead& state = *view.state.head;
  Particle& tip = *view.state.tip;
  const double before = contact_energy(view, tip);
  const Vec3 direction = needle.tip_direction, pressed = force_on_tissue(tip);
  const Vec3 across = pressed - dot(pressed, direction) * direction;
  const float old = tip.stiffness_n_per_m, spread = spread_of(tip, residual(tip));
  tip.tissue_compliance = 0;  // of the contact only
  set_stiffness(view, tip, Place::kTip);
  forget(tip);
  const float k = tip.stiffness_n_per_m;
  gather_goals(tip, (1 / k) * (across + force_n * direction), spread * min_of(old / k, 1));
  state.cutting_j += before - spring_energy(tip);
}

// The needle is in a track, its tip `depth_m` along it and its first shaft CP at the entry.
void enter_track(const View& view, const Needle& needle, std::uint32_t track, float depth_m,
                 const Particle& entry) {
  NeedleState& own = *view.state.needle;
  Particle& tip = *view.state.tip;
  own.track_current = track;
  own.track_end_m = max_of(view.state.track[track].length_m, depth_m);
  tip.track_m = own.tissue_track_m = own.layer_track_m = depth_m;
  own.drop_track_m = 0;
  own.shaft_count = 0;
  (void)push_shaft(view, entry);
  own.layer = own.spring_layer = own.layer_before = tip.material;
  own.cut = needle.tip_direction;
}

// Contact -> inserted: the entry becomes the first shaft CP, the tip starts to cut.
void begin_insertion(const View& view, const Needle& needle, std::uint32_t track, float force_n) {
  NeedleState& own = *view.state.needle;
  const Particle& tip = *view.state.tip;
  const VoxelFrame frame =
      voxel_frame(view, tip.share[heaviest(tip)].slot, tip.share[heaviest(tip)].row);
  const Vec3 rest_direction = transposed_times(frame.rotation, needle.tip_direction);
  const bool again = track != kNoTrack;
  // The entry is held where the surface is now, behind the tip by the depth of the dimple's cone.
  const float behind = dot(residual(tip), needle.tip_direction);
  const Vec3 place = tip.position_m - behind * needle.tip_direction;
  enter_track(view, needle, again ? track : remember_track(view, tip.rest_m, rest_direction), 0,
              new_particle(view, needle, tip.rest_m, place, 0, behind, Place::kShaft));
  change_spring(view, needle, force_n);
  own.phase = Phase::kInserted;
  add_event(view, again ? EventKind::kReentry : EventKind::kPuncture, force_n);
}

std::uint32_t track_of(const View& view, const Needle& needle, const Particle& entry) {
  if (entry.share_count == 0) return kNoTrack;
  const VoxelFrame frame =
      voxel_frame(view, entry.share[heaviest(entry)].slot, entry.share[heaviest(entry)].row);
  return find_track(view, entry.rest_m, transposed_times(frame.rotation, needle.tip_direction));
}

// The tissue has come over a tip that had left its hole, or never came clear of it: it lies in the
// hole again, as deep as it is now, without force, and what friction there is holds the shaft.
void take_in(const View& view, const Needle& needle, std::uint32_t track, const Particle& entry) {
  enter_track(view, needle, track, view.state.tip->track_m, entry);
  view.state.needle->phase = Phase::kRetracting;
  (void)drop_shaft(view, needle);
  meet_friction(view, entry.rest_m, 0);
  add_event(view, EventKind::kReentry, 0);
}

// The tip of a needle that lies this deep under a place of the surface: it holds the tissue it lies
// in, without force. Where the deformation at the surface says nothing of the tissue there, it
// holds the surface.
Particle tip_under(const View& view, const Needle& needle, Vec3 rest_m, Vec3 place_m,
                   float buried_m, Place place) {
  Particle tip = new_particle(view, needle, rest_m, place_m, 0, 0, place);
  if (tip.share_count > 0 && buried_m > 0) {
    const Vec3 step = buried_m * needle.tip_direction;
    const Vec3 image = pull_back_step(view, gradient_around(view, tip), step);
    const Particle under = new_particle(view, needle, rest_m + image, place_m + step, 0, 0, place);
    if (under.share_count > 0) {
      tip = under;
    } else {
      shift_goals(tip, step);
    }
    if (place == Place::kTip) tip.track_m = norm(image);
  }
  tip.position_m = needle.tip_m;
  return tip;
}

// A tip in contact that holds the tissue it lies in now, without force.
Particle tip_here(const View& view, const Needle& needle) {
  const Particle& before = *view.state.tip;
  const Vec3 step = pull_back_step(view, gradient_around(view, before), residual(before));
  return new_particle(view, needle, before.rest_m + step, needle.tip_m, 0, 0, Place::kSurface);
}

// A contact the tip is drawn back from: where tissue has come over the tip from elsewhere, or it
// has come in from the side, the tip is not clear yet, and holds what it lies in now, without
// force. The surface may be anywhere behind it.
bool hold_on(const View& view, const Needle& needle, std::uint32_t& flags_out) {
  Vec3 rest = {}, place = {};
  const Contact contact = find_contact(view, needle.tip_m, needle.tip_direction,
                                       view.needle_config().length_m, {}, rest, place, flags_out);
  if (contact != Contact::kFound) return false;
  Particle tip = tip_here(view, needle);
  if (tip.share_count == 0) {
    const float buried = dot(needle.tip_m - place, needle.tip_direction);
    tip = tip_under(view, needle, rest, place, buried, Place::kSurface);
  }
  if (tip.share_count == 0) return false;
  *view.state.tip = tip;
  view.state.needle->layer = tip.material;
  return true;
}

void end_contact(const View& view) {
  add_event(view, EventKind::kRelease, 0);
  view.state.needle->phase = Phase::kFree;
  view.state.needle->tip_alive = 0;
}

// Contact holds, ends, or becomes a puncture.
void update_contact(const View& view, const Needle& needle, Vec3 step_m, std::uint32_t& flags_out) {
  const ModelHead& head = *view.model.head;
  Particle& tip = *view.state.tip;
  const float felt = dot(tip.force_n, needle.tip_direction);
  const float away = dot(residual(tip), needle.tip_direction);
  if (away < -kReleaseSkinM) {
    if (!hold_on(view, needle, flags_out)) end_contact(view);
    return;
  }
  if (head.config.mode == Mode::kPhysical) relax_contact(view, needle.tip_direction, step_m);
  const std::uint32_t track = track_of(view, needle, tip);
  const bool node_inside = away > view.needle_config().unit_m;
  const bool through = head.config.mode == Mode::kPaper
                           ? node_inside
                           : felt >= puncture_force(view, head.material[tip.material]);
  if (through || track != kNoTrack) begin_insertion(view, needle, track, felt);
}

// Outside the tissue there is no layer.
void leave_layers(const View& view) {
  NeedleState& own = *view.state.needle;
  if (view.state.tip->share_count > 0 || own.layer == kNoLayer) return;
  own.layer = kNoLayer;
  tell_layer(view, 0);
}

}  // namespace

void keep_shares(StateHead& state, Particle& p, std::uint32_t kept) {
  const double before = spring_energy(p);
  const auto [residual_m, spread_m2] = drawn(p);
  std::uint32_t count = 0;
  float sum = 0;
  for (std::uint32_t i = 0; i < p.share_count; ++i) {
    if (((kept >> i) & 1U) == 0) continue;
    p.share[count++] = p.share[i];
    sum += p.share[i].weight;
  }
  p.share_count = count;
  for (std::uint32_t i = 0; i < count; ++i) p.share[i].weight = p.share[i].weight / sum;
  gather_goals(p, residual_m, spread_m2);
  if (count == 0) {
    p.give_m = {};
    forget(p);
  }
  state.friction_j += before - spring_energy(p);
}

void turn_give(Particle& p, Vec3 direction) {
  if (p.give_share == 0) return;
  const float size_m = norm(p.give_m);
  p.give_m = settle((dot(p.give_m, direction) < 0 ? -size_m : size_m) * direction);
  set_slack(p);
}

float friction_limit_n(const View& view, const Particle& p) {
  return friction_n_per_m(p.friction, p.slip_m_per_s) * length_of(view, p);
}

void begin_contact(const View& view, const Needle& needle, Vec3 rest_m, Vec3 place_m,
                   float came_m) {
  NeedleState& own = *view.state.needle;
  const float depth = dot(needle.tip_m - place_m, needle.tip_direction);
  const float buried = depth - max_of(came_m, 0);
  if (own.leaving != 0 && buried <= mouth_m(view)) return;
  own.leaving = 0;
  own.moved_m = view.model.head->counts.needles > 1 ? place_m - rest_m : Vec3{};
  const Particle entry = new_particle(view, needle, rest_m, place_m, 0, buried, Place::kShaft);
  const std::uint32_t track = buried > mouth_m(view) ? track_of(view, needle, entry) : kNoTrack;
  const Place place = track != kNoTrack ? Place::kTip : Place::kSurface;
  const Particle tip = tip_under(view, needle, rest_m, place_m, buried, place);
  if (tip.share_count == 0) return;
  *view.state.tip = tip;
  own.tip_alive = 1;
  if (track != kNoTrack) {
    take_in(view, needle, track, entry);
    return;
  }
  // couple_needle presses it in, as far as it is then: see contact_spring.
  view.state.tip->position_m = needle.tip_m - residual(tip);
  own.phase = Phase::kContact;
  own.layer = tip.material;
  add_event(view, EventKind::kContact, 0);
}

namespace {

// A CP of the shaft goes with the needle.
void follow(const View& view, const Needle& needle, Particle& p, const Drawn& shares) {
  const NeedlePoint point = needle_point(needle, p.arc_m);
  give_way(*view.state.head, p, shares, point.direction);
  p.position_m = point.place_m;
  turn_give(p, point.direction);
}

// The CPs creep at the last tick's forces; then those of the shaft go with the needle. As they load
// the tissue together, one may gain energy where others lose more: those come last.
void relax_and_follow(const View& view, const Needle& needle) {
  const NeedleState& own = *view.state.needle;
  Particle& tip = *view.state.tip;
  bool late[kMaxConstraintParticles] = {};
  double spare_j = 0;
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    Particle& p = view.state.shaft[i];
    refill_shares(view, p);
    Drawn shares = drawn(p);
    late[i] = !relax(view, p, shares, spare_j);
    if (!late[i]) follow(view, needle, p, shares);
  }
  Drawn tip_shares = drawn(tip);
  if (!relax(view, tip, tip_shares, spare_j)) relax_late(view, tip, tip_shares, spare_j);
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    if (!late[i]) continue;
    Particle& p = view.state.shaft[i];
    Drawn shares = drawn(p);
    relax_late(view, p, shares, spare_j);
    follow(view, needle, p, shares);
  }
}

std::uint32_t carry_particles(const View& view, const Needle& needle) {
  NeedleState& own = *view.state.needle;
  Particle& tip = *view.state.tip;
  if (own.tip_alive == 0) {
    tip.position_m = needle.tip_m;  // seek_contact measures from here
    return 0;
  }
  if (own.phase != Phase::kContact) relax_and_follow(view, needle);
  const Vec3 step = needle.tip_m - tip.position_m;
  const float moved = dot(step, needle.tip_direction);
  tip.position_m = needle.tip_m;
  const float speed = moved / view.model.head->config.period_s;
  own.press_m_per_s = settle(speed + view.model.head->velocity_keep * (own.press_m_per_s - speed));
  std::uint32_t flags = 0;
  if (own.phase == Phase::kContact) update_contact(view, needle, step, flags);
  if (own.phase == Phase::kFree || own.phase == Phase::kContact) return flags;
  const Vec3 from_m = tip.rest_m;
  const float from_track_m = tip.track_m;
  cut_tip(view, needle, moved);
  rehome_tip(view);
  slip_shaft(view, needle);
  while (own.shaft_count > 0 && is_behind(view, view.state.shaft[own.shaft_count - 1])) {
    --own.shaft_count;
  }
  if (own.shaft_count == 0) {
    end_insertion(view);
    return flags;
  }
  leave_layers(view);
  tell_layer_late(view);
  flags |= drop_shaft(view, needle);
  meet_friction(view, from_m, from_track_m);
  return flags;
}

}  // namespace

std::uint32_t couple_needle(const View& view, const Needle& needle) {
  const std::uint32_t flags = carry_particles(view, needle);
  const NeedleState& own = *view.state.needle;
  const Particle& tip = *view.state.tip;
  // In contact, too: with the needle moved before the first substep the tissue would be pushed by
  // more than the hand feels, which sees the forces of the last one.
  stretch_of(view, kMaxConstraintParticles) = {};
  if (own.tip_alive == 0) return flags;
  const Vec3 change_n = force_on_tissue(tip) - tip.force_n;
  stretch_of(view, kMaxConstraintParticles) = (1 / tip.stiffness_n_per_m) * change_n;
  return flags;
}

namespace {

// The tissue may pull at the tip as hard as the tip may press. One that has slipped back in this
// tick, without force, takes back as much of that as the tissue it has let go comes after it: it
// would press at the tick's end and not while it slipped, and the hand would have that for nothing.
// One that has just come to another material enters it with the next cut.
void let_cut(const View& view) {
  NeedleState& own = *view.state.needle;
  Particle& tip = *view.state.tip;
  if (own.phase == Phase::kFree || own.phase == Phase::kContact || tip.share_count == 0) return;
  if (tip.material != own.spring_layer) return;
  const float limit = kLoose * tip_limit(view, tip, tip.track_m < own.track_end_m);
  const float before_n = dot(tip.force_n, own.cut);
  const float back_m = max_of(-dot(tip.slip_m, own.cut), 0);
  const float high_n = clamp(before_n - back_m * tip.stiffness_n_per_m, 0, limit);
  const float move = overshoot(view, tip, before_n, -limit, high_n);
  if (move == 0) return;
  advance_tip(view, tip, own.cut, move);
  tip.slip_m = tip.slip_m + move * own.cut;
  tip.force_n = force_on_tissue(tip);
  const float work = 0.5F * move * (before_n + dot(tip.force_n, own.cut));
  view.state.head->cutting_j += static_cast<double>(work);
}

// Any CP may carry the friction of a whole unit, and one that has met none yet what it has. But
// friction does not push the needle on the way it slips: one that has slipped in this tick takes
// back as much of that as the tissue has come after the needle since, until it carries nothing. At
// the next slip it would be at its limit again, and the hand would have the push for nothing.
void let_slip(const View& view, const Needle& needle, Particle& p) {
  const float loose_m = kLoose * view.needle_config().unit_m;
  const float least = loose_m * p.friction.coulomb_n_per_m;
  const bool pushes = dot(p.force_n, p.slip_m) < 0;
  if (!(p.met_m > 0) || (!pushes && dot(p.force_n, p.force_n) <= least * least)) return;
  const float limit = loose_m * friction_n_per_m(p.friction, p.slip_m_per_s);
  const Vec3 direction = needle_point(needle, p.arc_m).direction;
  const float before_n = dot(p.force_n, direction), slipped_m = dot(p.slip_m, direction);
  const float stuck_n = before_n + slipped_m * p.stiffness_n_per_m;  // had it not slipped
  const float low_n = slipped_m > 0 ? clamp(stuck_n, -limit, 0) : -limit;
  const float high_n = slipped_m < 0 ? clamp(stuck_n, 0, limit) : limit;
  const float slip = overshoot(view, p, before_n, low_n, high_n);
  if (slip == 0) return;
  p.arc_m += slip;
  p.position_m = needle_place(needle, p.arc_m);
  if (pushes) {
    // It still slides (slip_m): how far is for the next tick to say.
    note_no_slip(*view.model.head, p, slip);
  } else {
    p.slip_m = p.slip_m + slip * direction;
  }
  p.force_n = force_on_tissue(p);
  const float work = 0.5F * slip * (before_n + dot(p.force_n, direction));
  view.state.head->friction_j += static_cast<double>(work);
}

}  // namespace

void let_slip(const View& view, const Needle& needle) {
  if (view.model.head->config.mode == Mode::kPaper) return;
  let_cut(view);
  for (std::uint32_t i = 0; i < view.state.needle->shaft_count; ++i) {
    let_slip(view, needle, view.state.shaft[i]);
  }
}

void throw_aside(const View& view, const Needle& needle, Vec3 moved_m) {
  Particle& tip = *view.state.tip;
  if (view.state.needle->phase != Phase::kContact || tip.share_count == 0) return;
  if (view.model.head->config.mode == Mode::kPaper) return;
  const Vec3 aside = moved_m - dot(moved_m, needle.tip_direction) * needle.tip_direction;
  const float before_m = max_of(norm(residual(tip) - moved_m), needle.off_m);
  const float held_m = kChordM + kAsideShare * before_m;
  if (!(norm(residual(tip)) > before_m + held_m && dot(aside, aside) > held_m * held_m)) return;
  tip = tip_here(view, needle);
  stretch_of(view, kMaxConstraintParticles) = {};
  if (tip.share_count == 0) end_contact(view);
}

void stretch_tip(const View& view, Vec3 moved_m) {
  Vec3& stretch = stretch_of(view, kMaxConstraintParticles);
  stretch = stretch + moved_m;
}

double shaft_energy(const Particle& particle) {
  return spring_energy(particle);
}

double tip_energy(const View& view, const Particle& tip) {
  const bool contact = view.state.needle->phase == Phase::kContact;
  return contact ? contact_energy(view, tip) : spring_energy(tip);
}

namespace {

void add_torque(const Needle& needle, Vec3 at_m, Vec3 on_needle_n, Output& out) {
  out.torque_nm = out.torque_nm + cross(at_m - needle.base_m, on_needle_n);
}

void add_particle(const Needle& needle, const Particle& p, Vec3& along_out_n, Output& out) {
  const Vec3 on_needle = -1.0F * p.force_n;
  const Vec3 direction = needle_point(needle, p.arc_m).direction;
  const Vec3 axial = dot(on_needle, direction) * direction;
  along_out_n = along_out_n + axial;
  out.cause.clamping_n = out.cause.clamping_n + (on_needle - axial);
  out.stiffness_n_per_m = out.stiffness_n_per_m + p.stiffness_n_per_m;
  add_torque(needle, grip(p), on_needle, out);
}

}  // namespace

void sum_forces(const View& view, const Needle& needle, Output& out) {
  const NeedleState& own = *view.state.needle;
  ForceByCause& cause = out.cause;
  for (std::uint32_t i = 0; i < own.shaft_count; ++i) {
    add_particle(needle, view.state.shaft[i], cause.friction_n, out);
  }
  if (own.tip_alive != 0 && own.phase != Phase::kContact) {
    add_particle(needle, *view.state.tip, cause.cutting_n, out);
  } else if (own.tip_alive != 0) {
    const Particle& tip = *view.state.tip;
    cause.stiffness_n = -1.0F * tip.force_n;
    out.stiffness_n_per_m = tip.stiffness_n_per_m;
    add_torque(needle, tip.position_m, cause.stiffness_n, out);
  }
  const Vec3 shift = attachment_shift(view);
  for (std::uint32_t i = 0; i < own.touch_count; ++i) {
    const Touch& touch = view.state.touch[i];
    const Mat3& k = touch.stiffness_n_per_m;
    cause.obstacle_n = cause.obstacle_n + touch.force_n;
    out.stiffness_n_per_m = out.stiffness_n_per_m + (k.m[0][0] + k.m[1][1] + k.m[2][2]);
    add_torque(needle, touch.at_m - shift, touch.force_n, out);
  }
  // Of the causes, not beside them: contacts may push against each other a hundred times as hard.
  out.force_n = ((cause.stiffness_n + cause.cutting_n) + (cause.friction_n + cause.clamping_n)) +
                cause.obstacle_n;
  out.torque_nm = out.torque_nm + roll_torque_nm(view);
}

void add_event(const View& view, EventKind kind, float force_n) {
  StateHead& state = *view.state.head;
  NeedleState& own = *view.state.needle;
  const float depth = own.tip_alive != 0 ? view.state.tip->track_m : 0;
  view.state.event[state.event_count % kMaxEvents] = {state.tick, kind,        own.layer, depth,
                                                      force_n,    view.needle, 0};
  ++state.event_count;
}

}  // namespace stylet
