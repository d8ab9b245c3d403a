// SPDX-License-Identifier: Apache-2.0
#include "coupling/stiffness.h"

#include "coupling/spring.h"
#include "laws/stiff_tip.h"

namespace stylet {
namespace {

constexpr float kPi = 3.14159265F;
// Compliance of the lattice under a tip inside, in 1 / (G h): at Poisson ratio 0, how much less at
// 1, and how much more where one voxel holds all of it (measured in an endless block:
// tests/fidelity/coupling/stiffness_test.cpp). The tip keeps its spring while it passes through a
// tissue, so the spring is for a mean place: the sum of the supports' squares is (2/3)^3.
constexpr float kInsideGive = 0.104F, kInsideGiveSlope = 0.040F, kInsideGiveSquares = 0.076F;
constexpr float kMeanSquares = 8.0F / 27.0F;
// What voxels that hold a membrane give besides, because it lies in one layer of them, in 1 / (G h)
// of the tissue (measured: tests/fidelity/insertion/membranes_test.cpp; 0.026 to 0.044 in 20 drawn
// cases).
constexpr float kMembraneGive = 0.034F;
// The same under a tip in contact, which two layers of voxels hold: at Poisson ratio 0, how much
// less at 1, how much more where one voxel holds all of it, and how much more where it acts an edge
// beside that voxel's middle. Then the growth: by what part of itself for each G h^2 of force, how
// much less where one voxel holds all, and up to what force (all measured:
// tests/fidelity/coupling/contact_test.cpp).
constexpr float kSurfaceGive = 0.170F, kSurfaceGiveSlope = 0.101F, kSurfaceGiveSquares = 0.097F;
constexpr float kSurfaceGiveBeside = 0.281F;
constexpr float kGiveGrowth = 0.06F, kGiveGrowthSquares = 0.1F, kGiveGrowthEnd = 5.0F;
// Mean of what squares and places add, for tissue as stiff as the tissue below. Under a stiffer
// layer of voxels only a part of it is left, by the logarithm of the ratio of stiffness
// (10: none). The whole falls with a power of how such a layer spreads the force, which follows the
// root of the ratio (same test: within 6 % between a tenth and 50 times, 14 % too much at 230).
constexpr float kPlaceMean = 0.03F, kPlaceSlope = 0.43F, kUpperPart = 2.3F, kUpperPower = 0.58F;
// A layer with less than this part of the tip's weights does not count.
constexpr float kLeastLayer = 0.01F;
// The tip's own spring has at least this part of the lattice's compliance: with less, tissue
// dragged far gained energy.
constexpr float kLeastOwnPart = 0.25F;
// Under a thin skin less is enough: random sessions with skins gain no energy (tests/simulator).
constexpr float kLeastUnderSkin = 0.05F;
// A row of CPs with even weights moves like a cylinder of this radius, in voxel edges: at Poisson
// ratio 0, and how much less at 1. The compliance of its springs counts this many times: they also
// let the voxels slip across each other (measured: tests/fidelity/coupling/stiffness_test.cpp).
constexpr float kRowRadius = 0.58F, kRowRadiusSlope = 0.33F, kRowSlack = 1.2F;
// Along its axis that row moves like a cylinder of this radius.
constexpr float kRowRadiusAlong = 0.78F;
// Radius at which the far field of a needle ends: half of an organ's usual thickness.
constexpr float kFarFieldM = 0.025F;

// Lateral stiffness per length of a rigid cylinder of radius a in an elastic annulus, over G.
float line_stiffness(float radius_m, float poisson) {
  const float a2 = radius_m * radius_m, b2 = kFarFieldM * kFarFieldM;
  const float n = 3 - 4 * poisson;
  const float ratio = max_of(kFarFieldM / radius_m, 1.5F);
  return 8 * kPi * (1 - poisson) * n / (n * n * natural_log(ratio) - (b2 - a2) / (b2 + a2));
}

// Compliance per length of that annulus, times G, when the cylinder moves along its axis.
float line_compliance_along(float radius_m) {
  return natural_log(max_of(kFarFieldM / radius_m, 1.5F)) / (2 * kPi);
}

// Shear modulus around a needle inside. A thin skin holds the needle over its own thickness; the
// one CP in the skin's voxels carries that, or several CPs where units are shorter than edges.
float shear_inside_pa(const MaterialModel& m, float edge_m, float unit_m) {
  return m.shear_pa + m.skin_shear_n_per_m / max_of(unit_m, edge_m);
}

// The voxels around a CP: their edge, and the shear modulus of its material in them.
struct Site {
  float edge_m, shear_pa;
};
Site site_of(const Model& model, const Particle& p) {
  const Level& level = level_of(model, p);
  const auto index = &level - model.head->level;
  return {level.edge_m, model.head->material[p.material].lattice[index].shear_pa};
}

// Tissue is more compliant along a needle than across, but a match holds one spring, as stiff as
// across. A second one behind it adds the axial compliance; its way is axial_way_m. This function
// gives its part of both. (Two stiffnesses in one match would have no rotation in closed form.)
float axial_fraction_of(const MaterialModel& m, const Site& site, float radius_m, float unit_m,
                        float own_compliance, float slack) {
  const float shear_pa = shear_inside_pa(m, site.edge_m, unit_m);
  const float row = line_compliance_along(kRowRadiusAlong * site.edge_m);
  const float along = line_compliance_along(radius_m) - row * (shear_pa / site.shear_pa);
  return 1 - min_of(1, own_compliance * slack * (shear_pa * unit_m) / max_of(along, 1e-6F));
}

// A CP's force relaxes as its material does: see creep.
void set_relaxation(const ModelHead& head, Particle& p) {
  if (!head.rules.relaxes) return;
  const MaterialModel& m = head.material[p.material];
  p.relaxing_fraction = m.relaxing_fraction;
  p.memory_keep =
      exp_minus(head.config.period_s / max_of(m.relaxation_time_s, head.config.period_s));
}

// Tissue under the tip in contact: the deeper of the two layers of voxels that hold it, and how
// many times stiffer the upper one is; the sum of the squares of the weights if all were one
// tissue; and that sum times how far beside the voxel's middle they act. The mean offset of the
// supports is along the needle, because the place they surround lies below the tip. Under a thin
// skin the upper layer are the voxels with the skin, as stiff as they are filled.
struct Footing {
  float deep_pa, upper_ratio, squares, beside;
  float edge_m;  // of its voxels
};

// A voxel of them: the modulus of what fills it, that over all of its cell, and how much of it
// belongs to the upper layer. `along` is the needle's direction, over edges.
struct Layered {
  float filled_pa, whole_pa, upper;
};

Layered layered(const Model& model, const Support& support, Vec3 along, bool under_skin) {
  const Row& row = model.row[support.row];
  if (under_skin) {
    const float whole_pa = model.slot_k[support.slot] / level_of(model, row).edge_m;
    return {whole_pa / model.slot_fill[support.slot], whole_pa,
            has_skin(model, support.slot) ? 1.0F : 0.0F};
  }
  const MaterialModel& m = model.head->material[model.slot_material[support.slot]];
  const float shear_pa = m.lattice[model.plane[row.plane].level].shear_pa;
  return {shear_pa, shear_pa, clamp(1.5F - dot(support.offset_m, along), 0, 1)};
}

Footing ground_under(const Model& model, const Particle& p) {
  const ModelHead& head = *model.head;
  const float edge_m = level_of(model, p).edge_m;
  const bool under_skin = model.forces[p.material].film.force_n > 0;
  Vec3 mean = {};
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    mean = mean + p.support[i].weight * p.support[i].offset_m;
  }
  const Vec3 along = (1 / (max_of(norm(mean), 1e-6F) * edge_m)) * mean;
  float all = 0, upper = 0, upper_pa = 0, deep_pa = 0, squares = 0, beside = 0;
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    const Support& support = p.support[i];
    const Layered of = layered(model, support, along, under_skin);
    const float part =
        support.weight / std::sqrt(max_of(of.filled_pa, 1));  // support_deeper took the root
    const float above = part * of.upper;
    const Vec3 arm = cross(support.offset_m, along);
    all += part;
    upper += above;
    upper_pa += above * of.whole_pa;
    deep_pa += (part - above) * of.whole_pa;
    squares += part * part;
    beside += part * part * dot(arm, arm);
  }
  const float deep = all - upper, few = kLeastLayer * all, all2 = max_of(all * all, 1e-30F);
  const float upper_mean = upper_pa / max_of(upper, 1e-30F);
  const float below_pa = under_skin ? head.material[p.material].shear_pa : upper_mean;
  const float deep_mean = max_of(deep > few ? deep_pa / deep : below_pa, 1);
  const float ratio = upper > few ? clamp(upper_mean / deep_mean, 0.01F, 1000) : 1;
  return {deep_mean, ratio, squares / all2, beside / all2, edge_m};
}

// What yields under a small force, and how much more under a larger one: one tissue like the tip's,
// so that layers below add what they really yield. Below a thin skin it is the layers: the skin's
// law covers all that is under it.
Footing footing_of(const Model& model, const Particle& p) {
  Footing footing = ground_under(model, p);
  if (model.forces[p.material].film.force_n > 0) return footing;
  footing.deep_pa = site_of(model, p).shear_pa;
  footing.upper_ratio = 1;
  return footing;
}

// Effect of the tip's place among voxels: the stiffer the upper layer, the less of it is felt.
float place_part(const Footing& g) {
  return clamp(1 - kPlaceSlope * natural_log(g.upper_ratio), 0, 2);
}

// Compliance of the lattice under the tip in contact: that of the deeper layer, less below a
// stiffer layer.
float surface_compliance(const Footing& g, float poisson) {
  const float place = kSurfaceGiveSquares * g.squares + kSurfaceGiveBeside * g.beside;
  const float give = kSurfaceGive - kSurfaceGiveSlope * poisson + kPlaceMean +
                     place_part(g) * (place - kPlaceMean);
  const float spread = (1 + kUpperPart * std::sqrt(g.upper_ratio)) / (1 + kUpperPart);
  return give * power(spread, -kUpperPower) / (g.deep_pa * g.edge_m);
}

// The required law of contact (cone.h): that of the needle's point on the tissue, steeper where
// that stiffens, or that of the thin skin over it (film.h) if the skin is stiffer.
struct Punch {
  float stiffness_n_per_m;
  Widening widening;
};

// Of the half angle of the needle's tip.
float cotangent_of(const Model& model, const State& state) {
  return cone_cotangent(model.needle_config().outer_radius_m,
                        model.head->cone_length_m[state.needle_index]);
}

// Depth at which a cone and cylinder on bare tissue carry this force.
float bare_depth_m(float force_n, float punch_n_per_m, float cone_m) {
  const float press_m = 2 * force_n / punch_n_per_m;
  return press_m < cone_m ? std::sqrt(press_m * cone_m) : 0.5F * (press_m + cone_m);
}

// A skin whose tissue would carry its force at a smaller depth, because it stiffens, is punctured
// there.
Punch wanted_punch(const Model& model, const State& state, std::uint32_t material) {
  const MaterialModel& m = model.head->material[material];
  const Film& film = model.forces[material].film;
  const float radius_m = model.needle_config().outer_radius_m;
  const StifferTip stiffer = stiffer_tip(m.stiffening, cotangent_of(model, state), m.poisson_ratio);
  const float cone_m = model.head->cone_length_m[state.needle_index];
  const float punch_n_per_m = 4 * m.shear_pa * radius_m / (1 - m.poisson_ratio);
  const float stiff_cone_m = cone_m * (stiffer.deep / stiffer.shallow);
  const float stiff_n_per_m = punch_n_per_m * stiffer.deep;
  if (!(film.depth_m < bare_depth_m(film.force_n, punch_n_per_m, cone_m))) {
    return {stiff_n_per_m, straight(stiff_cone_m)};
  }
  const float depth_m =
      min_of(film.depth_m, bare_depth_m(film.force_n, stiff_n_per_m, stiff_cone_m));
  const Film reached = {depth_m, film.force_n, film.first_width};
  return {film_punch_n_per_m(reached), film_widening(reached)};
}

// Compliance of the lattice under a tip inside, times G h.
float inside_compliance(float poisson) {
  return kInsideGive - kInsideGiveSlope * poisson + kInsideGiveSquares * kMeanSquares;
}

// The least compliance of the spring of a tip in contact, over the lattice's.
float least_own_part(const Model& model, const Particle& p) {
  return model.forces[p.material].film.force_n > 0 ? kLeastUnderSkin : kLeastOwnPart;
}

// Stiffness of the voxels that hold a CP, membranes in them included.
float held_n_per_m(const Model& model, const Particle& p) {
  float sum = 0;
  for (std::uint32_t i = 0; i < p.support_count; ++i) {
    sum += p.support[i].weight * model.slot_k[p.support[i].slot];
  }
  return max_of(sum, 1e-6F);
}

}  // namespace

void set_stiffness(const Model& model, State& state, Particle& particle, Role role) {
  const ModelHead& head = *model.head;
  const MaterialModel& m = head.material[particle.material];
  const Site site = site_of(model, particle);
  const float k = site.shear_pa * site.edge_m;
  const float a = model.needle_config().outer_radius_m;
  const float nu = m.poisson_ratio;
  const float unit = model.needle_config().unit_m;
  const Film& film = model.forces[particle.material].film;
  float target = 0, lattice_compliance = 0, slack = 1;
  // A skin's contact does not stiffen, nor does what holds a tip in it.
  const float stiffening = m.skin_shear_n_per_m > 0 ? 0 : m.stiffening;
  const float deep = stiffer_tip(stiffening, cotangent_of(model, state), nu).deep;
  float least = 1 / (kMaxCpWeight * k);
  switch (role) {
    case Role::kSurface:
      target = wanted_punch(model, state, particle.material).stiffness_n_per_m;
      lattice_compliance = surface_compliance(footing_of(model, particle), nu);
      least = least_own_part(model, particle) * lattice_compliance;
      break;
    case Role::kTip:
      // As stiff as in contact, where tissue stiffens: what a puncture finds stored must not be
      // less than the spring inside stores at the same force.
      target =
          24 * kPi * shear_inside_pa(m, site.edge_m, unit) * a * (1 - nu) / (5 - 6 * nu) * deep;
      lattice_compliance = inside_compliance(nu) / k;
      break;
    case Role::kMembrane:
      // A spring, as far as it may come: from nothing to the depth and force of the puncture.
      target = film.force_n / film.depth_m;
      lattice_compliance = inside_compliance(nu) / held_n_per_m(model, particle) +
                           kMembraneGive / (m.shear_pa * site.edge_m);
      least = kLeastOwnPart * lattice_compliance;
      break;
    case Role::kShaft:
      target = shear_inside_pa(m, site.edge_m, unit) * unit * line_stiffness(a, nu);
      lattice_compliance =
          1 / (site.shear_pa * unit *
               line_stiffness((kRowRadius - kRowRadiusSlope * nu) * site.edge_m, nu));
      slack = kRowSlack;
      least = least * site.edge_m / unit;
      break;
  }
  const float own_compliance = max_of((1 / target - lattice_compliance) / slack, least);
  particle.stiffness_n_per_m = head.rules.voxel_springs ? k : 1 / own_compliance;
  particle.full_stiffness_n_per_m = particle.stiffness_n_per_m;
  if (role == Role::kShaft && head.rules.relaxes) {
    particle.axial_fraction = axial_fraction_of(m, site, a, unit, own_compliance, slack);
  }
  // A tip in tissue that stiffens hardly ever comes so far that it is as stiff as its target.
  const float asked = role == Role::kShaft ? target : target / deep;
  const float reached = 1 / (slack * own_compliance + lattice_compliance);
  state.head->coupling_shortfall = max_of(state.head->coupling_shortfall, 1 - reached / asked);
  if (role == Role::kSurface) particle.tissue_compliance = lattice_compliance / own_compliance;
  set_relaxation(head, particle);
}

ContactLaw law_of(const Model& model, const State& state) {
  const ModelHead& head = *model.head;
  const Particle& tip = *state.tip;
  const MaterialModel& m = head.material[tip.material];
  // A snapshot may contain any number.
  const float least = least_own_part(model, tip);
  const float tissue = min_of(tip.tissue_compliance, 1 / least);
  const float whole = 1 + tissue, part = tissue / whole;  // over the spring's own; of all
  const Footing footing = footing_of(model, tip);
  const float unit_n = footing.deep_pa * footing.edge_m * footing.edge_m;
  const float most_part = 1 / (1 + least);
  // Where tissue stiffens, the lattice does, too: it gives no faster under larger forces.
  const float faster = m.stiffening > 0 ? 0 : kGiveGrowth - kGiveGrowthSquares * footing.squares;
  const float growth = max_of(faster * place_part(footing), 1e-3F);
  const float end = (most_part / max_of(part, 1e-3F) - 1) / (2 * growth);
  const float punch_n_per_m = tip.full_stiffness_n_per_m / whole;
  const Punch wanted = wanted_punch(model, state, tip.material);
  const float most = min_of(punch_n_per_m / wanted.stiffness_n_per_m, 1);
  return contact_law({punch_n_per_m, narrower(wanted.widening, most), part, growth / unit_n,
                      unit_n * clamp(end, 0, kGiveGrowthEnd)},
                     m.relaxing_fraction);
}

}  // namespace stylet
