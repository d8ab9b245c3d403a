// SPDX-License-Identifier: Apache-2.0
// Every capacity and bound of the kernel, and what happens when it is reached.
#pragma once

#include <cstdint>

namespace stylet {

// ---- organ: checked by organ_open, which refuses the file -------------------------------------
constexpr std::uint32_t kMaxVoxels = 4'000'000;
// Rows (y, z) of the lattice's extent, with or without voxels.
constexpr std::uint32_t kMaxRows = 16'000'000;
// Each voxel, wherever it lies, adds at most this many bytes to the memory of a kernel for an organ
// of one voxel. (Single voxels in one plane, with their corners in different tiles of the filter,
// come near this bound; in a body a voxel takes some 200 bytes.) sizes gives the exact number. No
// organ is refused for its memory, except if a block is too large for addresses of 32 bits:
// kOrganTooLarge.
constexpr std::uint32_t kMaxBytesPerVoxel = 24'576;
// Sheets of a lattice: how many voxels may lie in one cell of space. A look-up visits all sheets.
constexpr std::uint32_t kMaxSheets = 8;
// Levels of a graded lattice. A look-up of a place visits each.
constexpr std::uint32_t kMaxLevels = 4;
constexpr std::uint32_t kMaxMaterials = 64;
constexpr std::uint32_t kMaxVertices = 8'000'000;
constexpr std::uint32_t kMaxTriangles = 16'000'000;
// Points of membranes, and triangles in the lists of cells; triangles of all membranes in one cell.
// A needle's tip that comes through a cell tests each of its triangles.
constexpr std::uint32_t kMaxMembranePoints = 8'000'000;
constexpr std::uint32_t kMaxMembraneTriangles = 16'000'000;
constexpr std::uint32_t kMaxTrianglesPerCell = 256;
// Points of surfaces that slide: each is followed in every substep. A point stands for the surface
// in one voxel, which is no more than a plane cuts from it, and a fold's.
constexpr std::uint32_t kMaxSlidePoints = 65'536;
constexpr float kMaxSlideArea = 4.0F;        // squares of the edge
constexpr float kMaxSlideFriction = 2.0F;    // as of needles in tissue
constexpr float kMaxSlideDistance = 100.0F;  // edges from a ground's corner to its surface
// Largest coordinate of the lattice's origin. A needle stays within 2.5 m of that origin, so every
// place lies within 8 m of the origin of the world. There floats resolve 0.5 um, a fortieth of the
// 20 um by which contact is told from rounding (surface.cpp). At 100 m they would resolve 8 um.
constexpr float kMaxOriginM = 4.0F;
constexpr float kMinVoxelEdgeM = 1e-4F;
constexpr float kMaxVoxelEdgeM = 0.1F;
constexpr float kMaxPoissonRatio = 0.49F;
constexpr float kMinYoungsModulusPa = 1.0F;
constexpr float kMaxYoungsModulusPa = 1e9F;
constexpr float kMaxMembraneNPerM = 1e5F;     // 1 mm of 100 MPa
constexpr float kMaxStrainStiffening = 1e3F;  // a shear of 4.5 % doubles the modulus
// Puncture, cutting and friction as they are written in a material. Forces that follow from a
// toughness and a needle are clamped to the same limits.
constexpr float kMaxTipForceN = 1000.0F;
constexpr float kMaxFrictionNPerM = 1e4F;
// The fluid in a tissue. Pressure: from half the air's pressure below it to three times a
// tourniquet's; conductance: that of a hole of 1 cm for water; viscosity: that of honey.
constexpr float kMinFluidPa = -5e4F;
constexpr float kMaxFluidPa = 1e5F;
constexpr float kMaxConductanceM3PerPaS = 1e-4F;
constexpr float kMaxViscosityPaS = 10.0F;
constexpr float kMaxToughnessJPerM2 = 1e5F;  // three times that of skin torn without a blade

// ---- configuration: checked by sizes and create -------------------------------------------------
constexpr std::uint32_t kMaxSubsteps = 32;
constexpr float kMinPeriodS = 1e-5F;
// Most passes of the filter of true mass. If the organ is too stiff or the substep too long for
// them, mass is added where it is needed (mass_report says how much). Each pass costs a quarter to
// a third of a sweep.
constexpr std::uint32_t kMaxFilterPasses = 7;
constexpr float kMaxPeriodS = 1e-2F;
constexpr float kMaxNeedleLengthM = 0.5F;
constexpr float kMaxBendingNm2 = 1e3F;   // a steel bar of 15 mm
constexpr float kMaxTorsionNm2 = 1e3F;   // likewise
constexpr float kMaxBevelPerM = 100.0F;  // a path with 10 mm of radius
constexpr float kMaxBentAngleRad = 1.0F;
// Half angle of the tip, 5 to 80 degrees. Beyond: create refuses the configuration. A sharper tip
// would be as wide as the needle only 18 radii deep; a blunter one is almost a flat punch.
constexpr float kMinTipHalfAngleRad = 0.0872664626F;
constexpr float kMaxTipHalfAngleRad = 1.39626340F;
// Length of the crack that a tip tears, in outer diameters. Beyond: create refuses. No tip tears
// less than a tenth; a blunt one that punches out a ring tears pi.
constexpr float kMinTornDiameters = 0.1F;
constexpr float kMaxTornDiameters = 5.0F;
// Bore, filling and syringe. Beyond: create refuses. A bore is at most as wide as the needle.
constexpr float kMinBoreM = 1e-5F;
constexpr float kMaxOpeningM = 0.02F;
constexpr float kMinViscosityPaS = 1e-6F;  // any gas has more
constexpr float kMinPlungerM = 1e-3F;
constexpr float kMaxPlungerM = 0.05F;
constexpr float kMaxPlungerFrictionN = 100.0F;
constexpr float kMinSyringeM3 = 1e-8F;
constexpr float kMaxSyringeM3 = 1e-3F;  // a litre
constexpr float kMinSyringeGasM3 = 1e-10F;
constexpr float kMaxBreathM = 0.1F;
constexpr float kMaxGravityMPerS2 = 100.0F;  // tenfold
constexpr std::uint32_t kMaxNeedles = 4;
constexpr std::uint32_t kMaxObstacles = 16;
constexpr std::uint32_t kMaxHullVertices = 64;
// Threads that help with the tissue step. More: set_team refuses.
constexpr std::uint32_t kMaxHelpers = 15;

// ---- tick
// ----------------------------------------------------------------------------------------
// Constraint particles alive at once. Full: the needle advances without a new one, so the friction
// of that stretch of shaft is not felt; cp_pool_full is counted and flagged.
constexpr std::uint32_t kMaxConstraintParticles = 128;
// Support voxels of all constraint particles of one needle; the last eight are reserved for the
// tip. Full: a shaft particle loses the supports for which there is no room, and its other supports
// take over their weight at the same force. A particle without supports puts no force on needle or
// tissue, so that part of the shaft is not felt, until there is room again. cp_voxel_pool_full is
// counted.
constexpr std::uint32_t kMaxCoupledVoxels = 512;
// Support voxels of one constraint particle: the eight whose centres surround it.
constexpr std::uint32_t kSupportsPerParticle = 8;
// Constraint particles placed in one tick. Reached by a needle that jumps: the rest follow in the
// next ticks.
constexpr std::uint32_t kMaxDropsPerTick = 8;
// Needle units that a constraint particle slips in one tick in paper mode. Reached by a needle that
// jumps: the rest follow in the next ticks.
constexpr std::uint32_t kMaxUnitsPerTick = 64;
// Rods of the elastic needle. More: create refuses the configuration; longer rods bend less finely
// (deflections err by 1 / (2 n^2)).
constexpr std::uint32_t kMaxRods = 128;
// Places where a needle is near an obstacle. Full: the places that press least are left out and
// push nothing (obstacle_pool_full is counted).
constexpr std::uint32_t kMaxTouches = 16;
// Loads on the needle: one for each constraint particle. (The places for contacts are not used.)
constexpr std::uint32_t kMaxRodLoads = kMaxConstraintParticles + 1 + kMaxTouches;
// Newton steps of the needle's equilibrium in a tick. Reached: the next ticks solve the rest. A
// needle that snaps through takes tens of steps; with a moving hand this is not felt.
constexpr std::uint32_t kRodNewtonSteps = 2;
// Newton steps for each look at obstacles near the needle, and the number of looks before the step
// of the tissue; after it, a needle in the tissue looks once. Reached: later ticks solve the rest.
constexpr std::uint32_t kRodFaceSteps = 6;
constexpr std::uint32_t kRodFaceLooks = 2;
// Motion of a particle of tissue along an axis in one substep, in voxel edges. Beyond: clamped.
// Forces travel one voxel in a substep, so the step cannot follow a faster motion: without this
// bound, tissue that a needle tore along gained energy until its numbers overflowed.
constexpr float kMaxEdgesPerSubstep = 1.0F;
// How many times its modulus at rest the modulus of strain-stiffening tissue may gain. The gain
// approaches this bound, near which the tissue is linear again. With 10 the stiffest motion that
// changes a voxel's shape has 13.5 times its stiffness at rest (laws/stiffening.h). The stiffest
// motion that changes the volume has 14.5 times it at a Poisson's ratio of 0.45, so from that ratio
// on stiffening makes no step dearer.
constexpr float kMaxStiffer = 10.0F;
// Size of one load on the needle. Beyond: forces and places are clamped by component, a stiffness
// is scaled down by its trace; an obstacle stiffer than this is refused.
constexpr double kMaxRodForceN = 1e3;
constexpr double kMaxRodStiffnessNPerM = 1e6;
constexpr double kMaxRodPlaceM = 10;
// Largest angle by which the tip's roll may lag behind the hand's. Beyond: the shaft slips in the
// tissue.
constexpr float kMaxTwistRad = 3.0F;
// Length of the tip's path in a tick that is searched for membranes, in voxel edges. Reached: the
// tip stops there and moves on in the next ticks.
constexpr std::uint32_t kMaxMembraneSteps = 64;
// Holes in membranes that are remembered. Full: the oldest hole is closed again.
constexpr std::uint32_t kMaxOpenings = 64;
// Events kept for the reader. Full: the oldest is overwritten; sequence numbers show the gap.
constexpr std::uint32_t kMaxEvents = 64;
// Tracks remembered in the tissue. Full: the oldest is forgotten, and must be punctured again.
constexpr std::uint32_t kMaxTracks = 16;
// Sphere-tree nodes and triangles visited in one tick for a needle that touches nothing, nearest
// to its tip first. Reached before anything was found: the needle stays where it was
// (contact_budget is counted). 2048 triangles cover a disc of 26 mm radius, at one triangle per
// mm^2.
constexpr std::uint32_t kMaxTreeVisits = 8192;
// Largest distance of two vertices of one leaf of the tree, over their distance at rest. Beyond: a
// needle may pass without contact through tissue that is torn so far apart.
constexpr float kMaxSurfaceStretch = 3;
constexpr std::uint32_t kMaxTreeDepth = 64;
constexpr std::uint32_t kMaxTriangleTests = 2048;
// Passes over an obstacle's vertices for one distance. Reached: the nearest point found so far is
// used, which is never nearer than the true one.
constexpr std::uint32_t kMaxGjkSteps = 32;
// Additional passes for a needle that appears inside an obstacle. Reached: the needle is pushed out
// across its axis.
constexpr std::uint32_t kMaxEscapeSupports = 64;
// Largest turn of an obstacle contact's normal in one second. Reached: the rest follows in the next
// ticks.
constexpr float kMaxNormalTurnRadPerS = 100.0F;
// Time after reset in which gravity comes in, so that an organ sinks without swinging.
constexpr float kGravityFadeS = 1.0F;
// Motion of the handle accepted in one second; faster input is clamped, flagged and followed later.
constexpr float kMaxHandleSpeedMPerS = 5.0F;
constexpr float kMaxHandleSpinRadPerS = 60.0F;
// Force on a plunger; input beyond it is clamped. No thumb presses harder.
constexpr float kMaxPlungerN = 200.0F;
// Distance of the handle from the organ's origin; input beyond it is clamped.
constexpr float kMaxHandleDistanceM = 2.0F;

// ---- snapshots
// ----------------------------------------------------------------------------------
// Largest number in the state that restore accepts, in SI units: above what any session reaches
// (the stiffest material in the largest voxel has 1e10 N/m), below overflow. Beyond: refused.
constexpr float kMaxRestored = 1e12F;

// ---- the caller's thread
// ------------------------------------------------------------------------
// Stack of a tick, callees included: a thread that calls it must have this much left. A check of
// the call graph keeps this promise, not a check at run time.
constexpr std::uint32_t kTickStackBytes = 32'768;

}  // namespace stylet
