// SPDX-License-Identifier: Apache-2.0
// The kernel: the tissue of one organ and the needles in it, stepped with one fixed period. A
// picture is in kernel/README.md.
//
// Promises, from create to the end of the process: no allocation, lock, system call, exception or
// log; a bounded number of operations per tick that does not depend on the data; the same bits for
// every compiler, instruction set and optimisation level. One kernel belongs to one thread at a
// time; any number of kernels may share an organ. Units: SI. Frame: world, the organ's rest frame.
// Source: Tian et al., HAVE 2014 ("the paper").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "stylet/limits.h"
#include "stylet/organ.h"
#include "stylet/status.h"
#include "stylet/units.h"

namespace stylet {

// ==== Configuration
// ================================================================================

enum class Mode : std::uint32_t {
  kPhysical = 0,  // every parameter a physical quantity
  kPaper = 1,     // the paper's rules: its stiffness, node puncture, whole-unit re-association
};

// How the explicit step is kept stable for any material. Forces at rest are the same with both.
enum class Inertia : std::uint32_t {
  // Mass is added where the step needs it: liver in 5 mm voxels is 5 times too heavy with two
  // substeps. A hand that swings at 4 Hz feels 0.6 to 1.3 times the right force, near a resonance
  // many times it.
  kAddedMass = 0,
  // Tissue keeps its true mass. Short waves, which no hand feels, are slowed instead (filter.h):
  // in as many passes as the stiffest tissue needs (filter_passes).
  kTrueMass = 1,
};

// What is at the end of the needle outside of the body.
enum class Hub : std::uint32_t {
  kClosed = 0,   // nothing flows, and fluid costs nothing
  kOpen = 1,     // open to the air
  kSyringe = 2,  // Input::plunger_n is the force on its plunger
};

// The needle leaves the handle along its -z; unbent, tip = position + rotation * (0, 0, -length).
// Bevel and bend face the handle's +x and turn with it.
struct NeedleConfig {
  float length_m = 0.15F;
  float outer_radius_m = 0.635e-3F;  // 18G
  // Needle unit: the shaft length that one constraint particle carries. If it is longer than a
  // voxel's edge, the shaft is 10 to 26 % too soft sideways (Stats::unit_in_voxels).
  float unit_m = 5e-3F;
  float bending_nm2 = 0;    // EI of the shaft; 0 is rigid
  std::uint32_t rods = 32;  // of the elastic chain
  float bevel_per_m = 0;    // curvature of the path a bevelled tip cuts in stiff tissue
  float bent_length_m = 0;  // pre-bent tip: its length, and its angle to the shaft at rest
  float bent_angle_rad = 0;
  float torsion_nm2 = 0;  // GJ of the shaft; 0: the tip rolls with the hand
  // Half of the tip's included angle, between its axis and its surface; contact widens with its
  // tangent. 15 degrees.
  float tip_half_angle_rad = 0.261799388F;
  // Length of the crack that the tip tears, in outer diameters: 1 for a tip with edges, more for a
  // tip without (hal/base/needles.h). Only felt in tissues that have a toughness.
  float torn_diameters = 1.5F;
  // Fluid in the bore (PHYSICS 9.9). The fields below are read only if the hub is not closed.
  Hub hub = Hub::kClosed;
  float bore_radius_m = 0.419e-3F;  // 18G
  float opening_m = 0;              // from the tip to the middle of the bore's opening
  float filling_pa_s = 1e-3F;       // viscosity of the liquid in needle and syringe: saline
  float plunger_radius_m = 7.5e-3F;
  float plunger_friction_n = 0.5F;
  float syringe_m3 = 10e-6F;     // of the whole barrel
  float syringe_filled = 0.5F;   // part of it that is full at the start
  float syringe_gas_m3 = 5e-8F;  // the bubble, or any other elasticity: 0.05 ml
};

// The prescribed motion of all attachments together, A sin^4(pi t / T): a breath that rests at its
// start (Lujan et al. 1999). The kernel works in the frame of the attachments and leaves out the
// inertial force of that frame's motion, which for a breath is a hundredth of gravity.
struct BreathingConfig {
  Vec3 amplitude_m = {0, 0, 0};
  float period_s = 4;
};

struct Config {
  Mode mode = Mode::kPhysical;
  float period_s = 1e-3F;
  std::uint32_t substeps = 1;  // better 2 with added mass: 1 adds three times as much
  Inertia inertia = Inertia::kTrueMass;
  float tissue_damping_s = 0.25e-3F;  // Kelvin-Voigt time constant of the tissue
  float surround_drag_per_s =
      8.0F;  // drag of what surrounds the organ, per mass; 0 for a free body
  float hourglass_weight = 1.0F / 3.0F;  // physical mode; paper mode uses 1
  float paper_alpha = 0.5F;              // paper mode: stiffness factor of goals, 0..1
  std::uint32_t needle_count = 1;        // needles in this tissue, each with its own hand
  NeedleConfig needle[kMaxNeedles];
  BreathingConfig breathing;
  // Gravity now, less the gravity under which the organ's shape was taken: zero if the organ still
  // lies as it lay then; all of gravity if the shape is one without weight. It comes in over the
  // first kGravityFadeS, and the organ sinks to where it hangs.
  Vec3 gravity_m_per_s2 = {0, 0, 0};
};

// A body that no needle enters: the convex hull of the vertices, grown by `rounding_m` on all
// sides. One vertex makes a sphere.
struct ObstacleConfig {
  Pose pose = {{0, 0, 0}, {1, 0, 0, 0}};  // of the body in the world
  std::uint32_t vertex_count = 0;
  Vec3 vertices_m[kMaxHullVertices] = {};
  float rounding_m = 0;
  // The contact. The defaults, which scenes and hosts take from here, are chosen, not measured,
  // because real bone is stiffer and bears more than any device renders. The loop is tested with
  // this stiffness, and the largest force is more than any device has (hal/device/model.h).
  float stiffness_n_per_m = 20e3F;  // along and across; at most kMaxRodStiffnessNPerM
  float largest_force_n = 50;       // what the normal force approaches as the needle is pressed in
  float friction = 0.3F;            // Coulomb coefficient
};

// Why a configuration was refused: the first field outside its limits. For a vector `value` is its
// length, for a quaternion its squared length. `field` is static text, written as in the structs
// above: "needle.length_m", "obstacle.friction"; `index` says which needle or obstacle. An empty
// `field` means that the configuration was not the reason.
struct ConfigRefusal {
  const char* field = "";
  std::uint32_t index = 0;
  double value = 0;
  double least = 0, most = 0;  // that is accepted
  std::uint32_t vertex = 0;    // of "obstacle.vertices_m": which of them
};

void make_box(ObstacleConfig& config, Vec3 half_m);
void make_sphere(ObstacleConfig& config, float radius_m);

// ==== Memory and life
// ===============================================================================

struct Sizes {
  std::size_t model_bytes;    // derived from organ and config at creation, constant afterwards
  std::size_t state_bytes;    // all that changes and matters
  std::size_t scratch_bytes;  // its content between ticks never influences a result
};
constexpr std::size_t kBlockAlignment = 64;

struct Memory {
  std::span<std::byte> model;
  std::span<std::byte> state;
  std::span<std::byte> scratch;
};

// Handle to the blocks; plain and copyable: a copy is the same kernel. Only the kernel's own
// functions look inside. The blocks and the organ's bytes must outlive it; the Organ need not.
struct Kernel {
  std::byte* model = nullptr;
  std::byte* state = nullptr;
  std::byte* scratch = nullptr;
  Sizes sizes = {};
  void (*step)(const Kernel&) = nullptr;  // tissue step for this processor
};

// The sizes are exact: create uses these bytes and no others. kOrganTooLarge: this machine cannot
// count the bytes of a block (32 bits).
Status sizes(const Organ& organ, const Config& config, Sizes& sizes_out,
             ConfigRefusal* refusal_out = nullptr);
// On kMemoryTooSmall or kMemoryNotAligned nothing was written. On success the kernel is as after
// reset.
Status create(const Organ& organ, const Config& config, const Memory& memory, Kernel& kernel_out,
              ConfigRefusal* refusal_out = nullptr);
// Back to tick 0: tissue at rest, needles away, no track. Obstacles stay.
void reset(Kernel& kernel);

// Sets the bodies that no needle enters, fixed in the world: at most kMaxObstacles, in place of all
// earlier ones. Call it after create or reset and before the next tick (later: kObstaclesTooLate).
// On an error nothing changes.
Status set_obstacles(Kernel& kernel, std::span<const ObstacleConfig> obstacles,
                     ConfigRefusal* refusal_out = nullptr);

// ==== One tick
// ======================================================================================

struct Input {
  Pose handle;          // pose of the needle's base
  std::uint32_t valid;  // 0: no sample this tick; the last input is kept and counted
  float plunger_n = 0;  // on a syringe's plunger, towards the needle; below 0: it is drawn
};

enum class Phase : std::uint32_t { kFree = 0, kContact = 1, kInserted = 2, kRetracting = 3 };

struct ForceByCause {  // each on the needle, world frame; their sum is Output::force_n
  Vec3 stiffness_n;    // tip against a surface not yet punctured
  Vec3 cutting_n;      // tip in the tissue, along the shaft
  Vec3 friction_n;     // shaft, along the shaft
  Vec3 clamping_n;     // tip and shaft, across the shaft
  Vec3 obstacle_n;     // contact with obstacles
};

// The flow through a needle; zero if its hub is closed. Pressures are above that of the air; flow
// and volumes are positive towards the tissue.
struct Flow {
  float opening_pa, hub_pa;
  float flow_m3_per_s;  // mean of this tick
  float injected_m3;    // since reset; below 0: more was drawn than injected
  float plunger_m;      // displacement of the plunger since reset, towards the needle
  float plunger_m_per_s;
  float filled;  // part of the bore that the tissue's fluid fills
};

enum OutputFlag : std::uint32_t {
  kFlagInputNotFinite = 1U << 0,  // a field was NaN or infinite; the last one was kept
  kFlagInputClamped = 1U << 1,    // too fast, too far or too strong; followed at the limit
  kFlagInputMissing = 1U << 2,
  kFlagCpPoolFull = 1U << 3,
  kFlagCpVoxelPoolFull = 1U << 4,
  kFlagContactBudget = 1U << 5,
  kFlagObstaclePoolFull = 1U << 6,
  kFlagNeedleUnstable = 1U << 7,  // no stable shape of the needle was found in this tick
  kFlagFault = 1U << 31,          // latched: force is zero until reset
};

struct Output {
  std::uint64_t tick;  // number of ticks since reset, this one included
  Vec3 force_n;        // on the hand, at the handle
  Vec3 torque_nm;      // about the handle's position
  ForceByCause cause;
  Vec3 tip_m;
  float depth_m;  // of the tip along its track, in the tissue at rest, including gaps
  Phase phase;
  std::uint32_t layer;  // material under the tip; kNoLayer outside
  std::uint32_t constraint_particles;
  std::uint32_t flags;
  std::uint32_t events;     // number of events since reset, of all needles
  float stiffness_n_per_m;  // upper bound of the stiffness felt between two ticks
  Flow flow;
};
constexpr std::uint32_t kNoLayer = 0xFFFFFFFFU;

// Input i moves needle i. A needle without input keeps its pose (counted as missing). Writes one
// output for each needle, as long as `outputs` has room.
void tick(Kernel& kernel, std::span<const Input> inputs, std::span<Output> outputs);
// The same for one needle.
Output tick(Kernel& kernel, const Input& input);

// ==== Helper threads
// ================================================================================
// Threads of the caller may take part in the tissue step. The bits depend neither on the number of
// helpers nor on when they come: tick does every part that no helper has begun. But it waits for a
// part that a helper has begun, so helpers need the priority and the floating-point mode of the
// thread that ticks. The kernel starts no thread, takes no lock and makes no system call.

// Exact number of bytes that set_team needs for this kernel's organ.
std::size_t team_bytes(const Kernel& kernel, std::uint32_t helpers);
// Call between ticks while no thread is in help(). Divides the step among the helpers and tick's
// thread. The memory must outlive the team; 0 helpers end it. On an error nothing changes.
Status set_team(Kernel& kernel, std::uint32_t helpers, std::span<std::byte> memory);
bool has_team(const Kernel& kernel);
// The thread of a helper calls this again and again, with any copy of the kernel. The call looks up
// to `looks` times (about 40 ns each) for a part of the step, does the first that it finds, and
// returns whether it found one. Without a team it finds none.
bool help(const Kernel& kernel, std::uint32_t looks);

// ==== What happened
// =================================================================================

enum class EventKind : std::uint32_t {
  kContact = 0,
  kRelease = 1,  // contact lost without puncture
  kPuncture = 2,
  kReentry = 3,  // entered an existing track
  kExit = 4,
  kLayer = 5,      // tip crossed into another material
  kObstacle = 6,   // needle touched an obstacle
  kFlashback = 7,  // fluid of the tissue has filled the bore: it shows at the hub
  // While a plunger is pressed, the resistance of the tissue falls below that of the bore.
  kLossOfResistance = 8,
};
const char* event_name(EventKind kind);

struct Event {
  std::uint64_t tick;
  EventKind kind;
  std::uint32_t layer;
  float depth_m;
  float force_n;  // magnitude along the shaft; for the last two kinds the force on the plunger
  std::uint32_t needle;
  std::uint32_t reserved;
};

// Copies the newest events, oldest first; returns how many. Event i of the result has sequence
// number (Output::events - returned + i).
std::uint32_t events(const Kernel& kernel, std::span<Event> events_out);

struct Pool {
  std::uint32_t used, used_max, capacity;
};
struct Stats {
  std::uint64_t ticks;
  Pool constraint_particles;  // of all needles; capacity and used_max are per needle
  Pool coupled_voxels;        // of all needles; `used` is 0, because a tick frees them at its end
  Pool tracks;
  Pool obstacle_contacts;
  std::uint64_t input_not_finite, input_clamped, input_missing;
  std::uint64_t cp_pool_full, cp_voxel_pool_full, contact_budget, fault;
  std::uint64_t obstacle_pool_full, needle_unstable;
  float coupling_shortfall;  // largest missing part of the stiffness asked of a constraint particle
  float unit_in_voxels;      // the longest needle unit, in voxel edges: see NeedleConfig::unit_m
};
Stats stats(const Kernel& kernel);

// Real mass and mass in the step of the voxels of a material, kg. The difference is the mass that
// keeps the step stable. With true mass there is none as long as kMaxFilterPasses are enough.
struct MassReport {
  float real_kg, stepped_kg;
};
MassReport mass_report(const Kernel& kernel, std::uint32_t material);
// The instructions that the tissue step uses on this processor: "avx512", "avx2" or "baseline". The
// bits do not depend on it.
const char* instruction_set();
// Passes of the filter in a substep, 0 to kMaxFilterPasses (with levels: of the coarsest); 0 with
// added mass.
std::uint32_t filter_passes(const Kernel& kernel);

struct ConstraintParticle {
  Vec3 position_m, goal_m, force_on_needle_n;
  float arc_length_m;  // from the tip
  std::uint32_t is_tip;
  std::uint32_t needle;
};
std::uint32_t constraint_particles(const Kernel& kernel, std::span<ConstraintParticle> out);

// Contacts of a needle with obstacles in the last tick. Returns the number written.
struct ObstacleTouch {
  Vec3 position_m, normal, force_on_needle_n;
  std::uint32_t obstacle, needle;
};
std::uint32_t obstacle_touches(const Kernel& kernel, std::span<ObstacleTouch> out);

// Shape of a needle from handle to tip: rods + 1 places, so two for a rigid needle. Returns the
// number written; 0 before the first pose.
std::uint32_t needle_shape(const Kernel& kernel, std::uint32_t needle, std::span<Vec3> out);

// Deformed surface: one position per organ vertex. Returns the number written.
std::uint32_t surface(const Kernel& kernel, std::span<Vec3> positions_out);

// The lattice's particles, for a display that deforms the surface itself (trilinear in the voxels,
// as surface() does). Corner dx + 2 dy + 4 dz of voxel i of the organ is particle
// corners_out[8 i + dx + 2 dy + 4 dz]; cold path. Some of the kernel's particles are padding: no
// voxel names them as a corner, and they carry nothing.
std::uint32_t particle_count(const Kernel& kernel);
std::uint32_t voxel_corners(const Kernel& kernel, std::span<std::uint32_t> corners_out);
// The displacement of each particle from its place at rest: particle_count vectors. The function
// only copies, so the loop may call it between two ticks. Returns the number written.
std::uint32_t particles(const Kernel& kernel, std::span<Vec3> moved_out_m);

// Energies of tissue and needles, J (cold path, double precision inside).
struct Energy {
  double elastic, kinetic, coupling;
  double bending;                        // of elastic needles
  double work_by_hand;                   // since reset
  double friction, cutting, relaxation;  // dissipated since reset, by constraint particles
  double obstacles;                      // dissipated since reset, by contacts with obstacles
  double sliding;                        // the same by parts of the organ that slide on each other
};
Energy energy(const Kernel& kernel);

// ==== Save, restore, compare
// ========================================================================

// A snapshot is a header followed by the state block. It can be restored into any kernel whose
// organ, config, obstacles and layout of the state are the same (config bytes without effect, such
// as needles beyond needle_count, may differ). restore refuses all other bytes and then changes
// nothing: kSnapshotDoesNotMatch if the header differs; kSnapshotDamaged for a wrong checksum, and
// for an index, a count or a number that no tick can leave (such as a number that is not finite
// without a latched fault). An accepted state does no harm in any number of ticks: forces are
// finite, or the fault latches.
std::size_t snapshot_bytes(const Kernel& kernel);
// A number for the layout of the state: programs with the same number can exchange snapshots.
std::uint64_t state_layout();
Status snapshot(const Kernel& kernel, std::span<std::byte> out);
Status restore(Kernel& kernel, std::span<const std::byte> in);

// Canonical 64-bit hash of the state, field by field.
std::uint64_t hash(const Kernel& kernel);

struct Difference {
  const char* field;  // nullptr: equal
  std::uint64_t index;
};
// The first field of the state that differs; "organ" or "config" (which includes obstacles) if the
// two kernels were not made alike.
Difference difference(const Kernel& a, const Kernel& b);

}  // namespace stylet
