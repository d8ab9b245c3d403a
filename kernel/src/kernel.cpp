// SPDX-License-Identifier: Apache-2.0
// Life of a kernel: sizes, creation (derives everything from organ and config), reset, comparison.
// What happens in a tick is in tick.cpp.

#include "stylet/kernel.h"

#include <cmath>
#include <cstring>

#include "base/math.h"
#include "config.h"
#include "coupling/bend.h"
#include "coupling/return_map.h"
#include "coupling/slides.h"
#include "lattice/hanging.h"
#include "lattice/lattice.h"
#include "lattice/plan.h"
#include "lattice/shadow.h"
#include "lattice/tiles.h"
#include "lattice/voxel.h"
#include "laws/cone.h"
#include "laws/stiffening.h"
#include "needle/obstacle.h"
#include "needle/rod.h"
#include "state/layout.h"
#include "state/snapshot.h"
#include "stylet/first_outside.h"

namespace stylet {
namespace {

// Shear modulus of a material from its modulus in tension and lambda (Lame's first): the root of
// 2 G^2 + (3 lambda - E) G - E lambda = 0, written so that no digits cancel.
float shear_modulus_pa(float youngs_modulus_pa, float lambda_pa) {
  const float apart = youngs_modulus_pa - 3 * lambda_pa;
  const float product = youngs_modulus_pa * lambda_pa;
  const float root = std::sqrt(apart * apart + 8 * product);
  return apart < 0 ? 2 * product / (root - apart) : (apart + root) / 4;
}

// In paper mode every voxel has the stiffness that the averaged goals with factor alpha have at
// this step, and no volume term (Mueller et al. 2005). `skin_area` is that of the skin in a voxel,
// in squares of its edge, over how full the voxel is.
LatticeMaterial lattice_material(const Material& m, const Config& config, float edge_m,
                                 float substep_s, float skin_area = 1) {
  if (config.mode == Mode::kPaper) {
    const float mass_share = m.density_kg_per_m3 * edge_m * edge_m * edge_m / 8;
    return {config.paper_alpha * mass_share / (substep_s * substep_s) / edge_m, 0};
  }
  const float per_shear = 2 * (1 + m.poisson_ratio);
  // A thin skin is spread over its voxels: its stiffness in tension does not depend on the voxel.
  // It can become thinner: it adds to the voxel's modulus in tension, not to lambda. (If it were as
  // incompressible as the tissue, its pressure waves, which no hand feels, would be the fastest of
  // all: for a liver's capsule five times as fast, squared.)
  const float lambda_pa =
      2 * (m.youngs_modulus_pa / per_shear) * m.poisson_ratio / (1 - 2 * m.poisson_ratio);
  const float skin_pa = skin_area * (m.membrane_n_per_m / edge_m);
  const float shear_pa = shear_modulus_pa(m.youngs_modulus_pa + skin_pa, lambda_pa);
  return {shear_pa, lambda_pa / (2 * shear_pa)};
}

// What the sweep and the needle need to know of a material.
MaterialModel material_model(const Material& m, const ModelHead& head) {
  MaterialModel out = {};
  for (std::uint32_t i = 0; i < kMaxLevels; ++i) {
    out.lattice[i] = lattice_material(m, head.config, head.level[i].edge_m, head.substep_s);
  }
  if (head.config.mode == Mode::kPaper) {
    out.shear_pa = out.lattice[0].shear_pa;
  } else {
    const float per_shear = 2 * (1 + m.poisson_ratio);
    out.shear_pa = m.youngs_modulus_pa / per_shear;
    out.poisson_ratio = m.poisson_ratio;
    out.skin_shear_n_per_m = m.membrane_n_per_m / per_shear;
    out.stiffening = m.strain_stiffening;
  }
  out.puncture_exponent = m.puncture_velocity_exponent;
  out.relaxing_fraction = m.relaxing_fraction;
  out.relaxation_time_s = m.relaxation_time_s;
  return out;
}

Rules rules_of(Mode mode) {
  const bool paper = mode == Mode::kPaper;
  Rules rules = {};
  rules.one_support = rules.voxel_springs = paper;
  rules.unit_punctures = rules.unit_slips = paper;
  rules.relaxes = rules.contact_law = rules.layer_punctures = !paper;
  rules.slips_again = rules.planes_in_voxels = !paper;
  return rules;
}

void fill_head(const Organ& organ, const Config& config, const Counts& counts, ModelHead& head) {
  head.organ = organ;
  head.config = canonical(config);
  head.counts = counts;
  head.organ_hash = organ.hash;
  head.edge_m = organ.voxel_edge_m;
  head.inverse_edge_per_m = 1 / organ.voxel_edge_m;
  for (std::uint32_t i = 0; i < kMaxLevels; ++i) {
    const float edge_m = organ.voxel_edge_m * edge_ratio(i);
    head.level[i] = {edge_m, 1 / edge_m, first_plane(organ.level_planes, i),
                     std::uint32_t{organ.level_planes} << i};
  }
  head.origin_m = organ.origin_m;
  head.size_x = organ.size_x;
  head.size_y = organ.size_y;
  head.size_z = organ.size_z;
  head.sheet_rows = organ.sheet_rows;
  head.rules = rules_of(config.mode);
  head.substep_s = config.period_s / static_cast<float>(config.substeps);
  head.hourglass_weight = config.mode == Mode::kPaper ? 1.0F : config.hourglass_weight;
  head.velocity_keep = exp_minus(config.period_s / kSlipFilterS);
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    head.cone_length_m[i] = cone_length_m(config.needle[i]);
  }
  head.material_count = organ.material_count;
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    head.material[i] = material_model(organ_material(organ, i), head);
  }
}

// What each needle meets in each material. The paper knows no skins.
void fill_forces(const Organ& organ, const Config& config, Model& model) {
  const ModelHead& head = *model.head;
  for (std::uint32_t needle = 0; needle < config.needle_count; ++needle) {
    for (std::uint32_t i = 0; i < organ.material_count; ++i) {
      NeedleForces& forces = model.forces[needle * kMaxMaterials + i];
      Material material = organ_material(organ, i);
      if (config.mode == Mode::kPaper) material.strain_stiffening = 0;  // as in its lattice
      forces = needle_forces(material, config.needle[needle], head.cone_length_m[needle]);
      if (config.mode == Mode::kPaper) forces.film = {};
    }
  }
}

// Each needle's bore, and what its opening meets in each material.
void fill_fluids(const Organ& organ, const Config& config, Model& model) {
  for (std::uint32_t needle = 0; needle < model.head->counts.fluids; ++needle) {
    const Bore bore = bore_of(config.needle[needle]);
    model.bore[needle] = bore;
    for (std::uint32_t i = 0; i < organ.material_count; ++i) {
      model.opening[needle * kMaxMaterials + i] =
          opening_of(organ_material(organ, i), bore.filling_pa_s);
    }
  }
}

void fill_sheets(const Organ& organ, Model& model, const Counts& counts) {
  std::uint32_t tie = 0;
  for (std::uint32_t z = 0; z <= counts.planes; ++z) {
    model.plane[z].tie_begin = tie;
    for (; tie < counts.ties && organ.ties[tie].z == model.plane[z].z; ++tie) {
      const OrganTie& t = organ.ties[tie];
      model.tie[tie] = {node_at(model, t.x, t.y, t.z), node_at(model, t.x, t.to_y, t.z)};
    }
    model.plane[z].tie_end = tie;
  }
  if (counts.sheets == 1) return;
  for (std::uint32_t i = 0; i < counts.particles; ++i) model.representative[i] = i;
  for (std::uint32_t i = 0; i < counts.ties; ++i) {
    model.representative[model.tie[i].node] = model.tie[i].representative;
  }
  for (std::uint32_t i = 0; i < counts.slots; ++i) model.quarters[i] = ~std::uint64_t{0};
  for (const OrganPart& part : organ.parts) {
    const Row& row = model.row[row_at(model, part.x, part.y, part.z)];
    model.quarters[row.slot + part.x - row.x0] = part.quarters;
  }
}

// Bound on the stiffness of a voxel's motions at each corner (PHYSICS 3.2). Those that change the
// volume are one family, those that stiffen the other. Without either the bound has a margin:
// there every motion of every voxel is at it, and a beam of 2.5 mm voxels, 200 kPa, swung for ever
// with seven passes. Why is not known; at a Poisson's ratio of 0.01, where volume makes it 0.03, it
// comes to rest.
float corner_bound(const Model& model, std::uint32_t slot) {
  constexpr float kMargin = 0.05F;
  const bool stiff = stiffens(model) && model.slot_stiffening[slot] > 0;
  const float shape = stiff ? kStiffestMotion * kMaxStiffer : kMargin;
  return model.slot_k[slot] * (1 + max_of(3 * model.slot_volume[slot], shape));
}

// A membrane stretches with its voxels: as stiff as a skin that covers as much of them
// (MaterialModel). Parts that share a cell of space share what lies in it.
void add_membranes(const Organ& organ, Model& model) {
  const ModelHead& head = *model.head;
  for (const OrganMembraneCell& cell : organ.membrane_cells) {
    std::uint32_t slots[kMaxSheets] = {}, found = 0;
    for (std::uint32_t y = cell.y; y < organ.size_y && found < kMaxSheets; y += organ.sheet_rows) {
      const std::uint32_t row = row_at(model, cell.x, y, cell.z);
      if (row == kNoRow) continue;
      slots[found++] = model.row[row].slot + cell.x - model.row[row].x0;
    }
    const float added_n_per_m = head.material[cell.material].skin_shear_n_per_m * cell.area;
    for (std::uint32_t i = 0; i < found; ++i) {
      float& k = model.slot_k[slots[i]];
      if (!(k > 0)) continue;  // a hole in the row
      const float before = k;
      k += added_n_per_m / static_cast<float>(found);
      model.slot_volume[slots[i]] *= before / k;
    }
  }
}

// Stiffness of the slots.
void fill_slots(const Organ& organ, Model& model, const Counts& counts) {
  const ModelHead& head = *model.head;
  for (std::uint32_t i = 0; i < counts.slots; ++i) {
    model.slot_k[i] = model.slot_volume[i] = model.slot_fill[i] = 0;
    model.slot_material[i] = 0;
    model.slot_mixed[i] = kNotMixed;
  }
  std::uint32_t voxel = 0;
  std::size_t skin = 0;
  for (const OrganRun& run : organ.runs) {
    const std::uint32_t row_index = row_at(model, run.x, run.y, run.z);
    const Row& row = model.row[row_index];
    const std::uint32_t level = model.plane[row.plane].level;
    for (std::uint32_t x = run.x; x < static_cast<std::uint32_t>(run.x) + run.count; ++x, ++voxel) {
      const std::uint32_t slot = row.slot + x - row.x0;
      const std::uint8_t material = organ.voxel_material[voxel];
      const MaterialModel& m = head.material[material];
      const float fill = max_of(static_cast<float>(organ.voxel_fill[voxel]) / 255.0F, kMinFill);
      model.voxel_slot[voxel] = slot;
      model.voxel_row[voxel] = row_index;
      LatticeMaterial lattice = m.lattice[level];
      if (skin < organ.skins.size() && organ.skins[skin].voxel == voxel) {
        lattice =
            lattice_material(organ_material(organ, material), head.config, head.level[level].edge_m,
                             head.substep_s, organ.skins[skin++].area / fill);
      }
      model.slot_k[slot] = lattice.shear_pa * head.level[level].edge_m * fill;
      model.slot_volume[slot] = lattice.volume_ratio;
      if (stiffens(model)) model.slot_stiffening[slot] = m.stiffening;
      model.slot_fill[slot] = fill;
      model.slot_material[slot] = material;
    }
  }
  if (has_membranes(model)) add_membranes(organ, model);
}

// Mass and stiffness of the particles, as sums.
void fill_particles(const Organ& organ, Model& model, const Counts& counts) {
  const ModelHead& head = *model.head;
  for (std::uint32_t i = 0; i < counts.particles; ++i) {
    model.particle_kg[i] = model.hourglass_n_per_m[i] = model.step_per_mass[i] = 0;
  }
  for (std::uint32_t voxel = 0; voxel < counts.voxels; ++voxel) {
    const Row& row = model.row[model.voxel_row[voxel]];
    const std::uint32_t slot = model.voxel_slot[voxel];
    const float density = organ_material(organ, organ.voxel_material[voxel]).density_kg_per_m3;
    const float edge_m = level_of(model, row).edge_m, corner_m3 = edge_m * edge_m * edge_m / 8;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const std::uint32_t p = row.node[corner >> 1U] + slot - row.slot + (corner & 1U);
      model.particle_kg[p] += density * model.slot_fill[slot] * corner_m3;
      model.hourglass_n_per_m[p] += model.slot_k[slot] * head.hourglass_weight;
      model.step_per_mass[p] += corner_bound(model, slot);
    }
  }
  float* const sums[] = {model.particle_kg, model.hourglass_n_per_m, model.step_per_mass};
  for (float* of_particles : sums) sum_tied(model, of_particles);
}

// Voxels in which two tissues meet.
void fill_mixed(const Organ& organ, Model& model) {
  if (!model.head->rules.planes_in_voxels) return;
  for (std::uint32_t i = 0; i < organ.mixed.size(); ++i) {
    model.slot_mixed[model.voxel_slot[organ.mixed[i].voxel]] = i;
  }
}

// The passes of the filter. On entry step_per_mass has the bounds on stiffness (filter.h), with all
// that constraint particles may add.
void fill_filter(Model& model, const Counts& counts, float limit) {
  ModelHead& head = *model.head;
  const float most = most_filtered_per_s2(limit);
  float fastest = 0;
  for (std::uint32_t i = 0; i < counts.particles; ++i) {
    const float kg = max_of(model.particle_kg[i], model.step_per_mass[i] / most);
    if (kg > 0) fastest = max_of(fastest, model.step_per_mass[i] / kg);
  }
  head.filter = choose_filter(limit, fastest);
}

// Attached particles do not move.
void hold_attached(const Organ& organ, Model& model, const Counts& counts) {
  for (std::uint32_t voxel = 0; voxel < organ.voxel_fixed.size(); ++voxel) {
    const Row& row = model.row[model.voxel_row[voxel]];
    const std::uint32_t slot = model.voxel_slot[voxel];
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      if (((organ.voxel_fixed[voxel] >> corner) & 1U) == 0) continue;
      const std::uint32_t p = row.node[corner >> 1U] + slot - row.slot + (corner & 1U);
      if (!hangs(model, p)) model.step_per_mass[p] = 0;  // else its masters say where it is
    }
  }
  for (std::uint32_t i = 0; i < counts.ties; ++i) {  // if one node is attached, the particle is
    const TiedNode& tie = model.tie[i];
    if (!(model.step_per_mass[tie.node] > 0)) model.step_per_mass[tie.representative] = 0;
  }
  for (std::uint32_t i = 0; i < counts.ties; ++i) {
    model.step_per_mass[model.tie[i].node] = model.step_per_mass[model.tie[i].representative];
  }
}

// The mass of the step: real mass, or what keeps the explicit step stable, whichever is more. On
// entry step_per_mass has the bounds on the tissue's stiffness.
void fill_masses(const Organ& organ, Model& model, const Counts& counts) {
  ModelHead& head = *model.head;
  const float dt = head.substep_s;
  const float limit = wave_limit_per_s2(dt, head.config.tissue_damping_s);
  add_slide_room(model, model.step_per_mass);
  for (std::uint32_t i = 0; i < counts.filtered_particles; ++i) {
    model.bound[i] = model.step_per_mass[i];
  }
  for (std::uint32_t i = 0; i < counts.particles; ++i) {
    // For constraint particles.
    model.step_per_mass[i] += model.hourglass_n_per_m[i] / head.hourglass_weight;
  }
  add_to_masters(model, model.step_per_mass);
  add_to_masters(model, model.particle_kg);
  for (std::uint32_t i = 0; counts.filtered_slots > 0 && i < counts.slots; ++i) {
    // Per corner: the mean is over eight.
    model.slot_bound[i] = 0.125F * corner_bound(model, i);
  }
  const bool filtered = head.config.inertia == Inertia::kTrueMass, graded = counts.levels > 1;
  const bool cascade = filtered && graded && bound_coarse(model, limit);
  if (filtered && !graded) fill_filter(model, counts, limit);
  const float of_passes = cascade ? coarse_limit_per_s2(limit, counts.levels) : limit;
  const float most = filtered ? most_filtered_per_s2(of_passes) : limit;
  for (std::uint32_t i = 0; i < counts.particles; ++i) {
    const float least_kg = model.step_per_mass[i] / most;
    const float real_kg = model.particle_kg[i];
    const float kg = max_of(real_kg, least_kg);
    model.step_per_mass[i] = kg > 0 ? dt / kg : 0;
  }
  // For the report; sums in float would be off by a part in a hundred in a large organ.
  double real_sum_kg[kMaxMaterials] = {}, stepped_sum_kg[kMaxMaterials] = {};
  for (std::uint32_t voxel = 0; voxel < counts.voxels; ++voxel) {
    const Row& row = model.row[model.voxel_row[voxel]];
    const std::uint32_t slot = model.voxel_slot[voxel];
    const std::uint32_t material = model.slot_material[slot];
    const float density = organ_material(organ, material).density_kg_per_m3;
    const float edge_m = level_of(model, row).edge_m;
    const float share_kg = density * model.slot_fill[slot] * edge_m * edge_m * edge_m / 8;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      const std::uint32_t p = row.node[corner >> 1U] + slot - row.slot + (corner & 1U);
      const float factor = dt / (model.step_per_mass[p] * model.particle_kg[p]);
      real_sum_kg[material] += static_cast<double>(share_kg);
      stepped_sum_kg[material] += static_cast<double>(share_kg * factor);
    }
  }
  for (std::uint32_t i = 0; i < head.material_count; ++i) {
    head.material[i].real_kg = static_cast<float>(real_sum_kg[i]);
    head.material[i].stepped_kg = static_cast<float>(stepped_sum_kg[i]);
  }
  hold_attached(organ, model, counts);
  fill_shares(model);
  if (cascade) fill_shadows(organ, model, limit);
}

Status count(const Organ& organ, const Config& config, Counts& counts_out) {
  const Status status = count_lattice(organ, config, counts_out);
  for (std::uint32_t i = 0; i < config.needle_count; ++i) {
    if (config.needle[i].hub != Hub::kClosed) counts_out.fluids = config.needle_count;
  }
  if (status != Status::kOk) return status;
  count_slides(organ, counts_out);
  if (config.mode == Mode::kPaper) return status;
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    const bool stiffens = organ_material(organ, i).strain_stiffening > 0;
    if (stiffens) counts_out.stiffening_slots = counts_out.slots;
  }
  if (!organ.membrane_cells.empty()) {
    counts_out.membrane_needles = counts_out.needles;
    counts_out.membranes = 1;
  }
  return status;
}

bool aligned(std::span<const std::byte> block) {
  return reinterpret_cast<std::uintptr_t>(block.data()) % kBlockAlignment == 0;
}

}  // namespace

Status sizes(const Organ& organ, const Config& config, Sizes& sizes_out,
             ConfigRefusal* refusal_out) {
  if (refusal_out != nullptr) *refusal_out = {"organ", 0, 0, 1, 1};
  if (organ.root == nullptr) return Status::kConfigValueOutOfRange;
  if (refusal_out != nullptr) *refusal_out = {};
  Status status = check_config(config, refusal_out);
  Counts counts;
  if (status == Status::kOk) status = count(organ, config, counts);
  return status == Status::kOk ? block_sizes(counts, sizes_out) : status;
}

Status create(const Organ& organ, const Config& config, const Memory& memory, Kernel& kernel_out,
              ConfigRefusal* refusal_out) {
  Sizes need = {};
  const Status status = sizes(organ, config, need, refusal_out);
  if (status != Status::kOk) return status;
  if (memory.model.size() < need.model_bytes || memory.state.size() < need.state_bytes ||
      memory.scratch.size() < need.scratch_bytes) {
    return Status::kMemoryTooSmall;
  }
  if (!aligned(memory.model) || !aligned(memory.state) || !aligned(memory.scratch)) {
    return Status::kMemoryNotAligned;
  }
  Counts counts;
  (void)count(organ, config, counts);  // succeeds, as it did in sizes
  std::memset(memory.model.data(), 0, need.model_bytes);
  Model model = model_of(memory.model.data(), counts);
  fill_head(organ, config, counts, *model.head);
  fill_forces(organ, config, model);
  fill_fluids(organ, config, model);
  fill_lattice(organ, model);
  fill_sheets(organ, model, counts);
  fill_hanging(organ, model);
  if (counts.filtered_particles != 0) fill_tiles(organ, model);
  fill_slots(organ, model, counts);
  fill_particles(organ, model, counts);
  fill_mixed(organ, model);
  fill_slides(organ, model);
  fill_masses(organ, model, counts);
  kernel_out = {memory.model.data(), memory.state.data(), memory.scratch.data(), need,
                lattice_step_for_this_processor()};
  View view = view_of(kernel_out);
  // Read before its first write, but not trusted (match.cpp); memory checkers cannot know that.
  for (std::uint32_t i = 0; i < counts.slots; ++i) view.scratch.slot_mark[i] = 0;
  for (std::uint32_t i = 0; i < counts.needles; ++i) {
    make_needle(config.needle[i], view.model.rod[i]);
  }
  reset(kernel_out);
  return Status::kOk;
}

Status set_obstacles(Kernel& kernel, std::span<const ObstacleConfig> obstacles,
                     ConfigRefusal* refusal_out) {
  View view = view_of(kernel);
  if (refusal_out != nullptr) *refusal_out = {};
  if (view.state.head->tick != 0) return Status::kObstaclesTooLate;
  FirstOutside count(0);
  count.check("obstacles", static_cast<double>(obstacles.size()), 0, kMaxObstacles);
  if (!count.good()) return count.status(refusal_out);
  for (std::uint32_t i = 0; i < obstacles.size(); ++i) {
    const Status status = check_obstacle(obstacles[i], i, refusal_out);
    if (status != Status::kOk) return status;
  }
  std::memset(static_cast<void*>(view.model.obstacle), 0, sizeof(Obstacle) * kMaxObstacles);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    (void)obstacle_prepare(canonical(obstacles[i]), view.model.obstacle[i]);
  }
  view.model.head->obstacle_count = static_cast<std::uint32_t>(obstacles.size());
  return Status::kOk;
}

void reset(Kernel& kernel) {
  std::memset(kernel.state, 0, kernel.sizes.state_bytes);
  View view = view_of(kernel);
  const Counts& counts = view.model.head->counts;
  for (std::uint32_t i = 0; i < counts.slots; ++i) view.state.qw[i] = 1;
  for (std::uint32_t i = 0; i < counts.needles; ++i) {
    NeedleState& needle = view.state.needle[i];
    needle.handle.rotation = {1, 0, 0, 0};
    needle.layer = kNoLayer;
    needle.track_current = kNoTrack;
    relax_rod(view.model.rod[i], view.state.rod_shape[i]);
  }
  reset_slides(view.model, view.state);
}

std::uint64_t hash(const Kernel& kernel) {
  return hash_state(kernel);
}

Difference difference(const Kernel& a, const Kernel& b) {
  const auto organ_hash = [](const Kernel& kernel) {
    return reinterpret_cast<const ModelHead*>(kernel.model)->organ_hash;
  };
  if (organ_hash(a) != organ_hash(b)) return {"organ", 0};
  if (config_hash(a) != config_hash(b)) return {"config", 0};
  return first_difference(a, b);
}

MassReport mass_report(const Kernel& kernel, std::uint32_t material) {
  const auto& head = *reinterpret_cast<const ModelHead*>(kernel.model);
  if (material >= head.material_count) return {0, 0};
  return {head.material[material].real_kg, head.material[material].stepped_kg};
}

std::uint32_t filter_passes(const Kernel& kernel) {
  return reinterpret_cast<const ModelHead*>(kernel.model)->filter.passes;
}

}  // namespace stylet
