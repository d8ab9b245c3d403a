// SPDX-License-Identifier: Apache-2.0
// Needles by name: tubes by gauge, what such needles are sold as, and what their tips tear.
//
// Diameters: tubes of regular wall from the usual gauge table, which lie in the ranges of ISO 9626.
// Moduli: steel 304/316 200 GPa (data sheets: 193 to 200), austenitic nitinol 75 GPa (quoted: 40 to
// 83). Lengths and angles of tips as these needles are sold; half of a bevel's angle is the half
// angle of its tip.
//
// A tip with edges (bevel, diamond) tears a straight crack as long as the needle is wide. One that
// has none (cone, pencil point) splits the tissue, for half as much again: by judgement, so that a
// flat punch takes 2 times the force of a sharp one, of the 2 to 3 times of Shergold and Fleck
// 2004. The curved edge of a Tuohy needle cuts a flap, half of the circumference. A blunt tip
// punches out a ring, all of it (the same authors).
//
// Promises: constant tables; no allocation. Units: in the names.
#pragma once

#include <span>
#include <string_view>

#include "stylet/kernel.h"

namespace stylet::hal {

struct TipKind {
  const char* name;
  double torn_diameters;
};

struct NeedleMaterial {
  const char* name;
  double youngs_modulus_gpa;
};

struct NeedlePreset {
  const char* name;
  double outer_mm, inner_mm;  // an inner diameter of 0: solid
  double length_mm;
  NeedleMaterial material;
  const char* tip;  // one of tip_kinds
  double half_angle_deg;
  const char* what;
};

// Curvature of the path that a bevel cuts in stiff tissue, unless a scene says it.
constexpr double kBevelPerM = 5;

std::span<const TipKind> tip_kinds();
std::span<const NeedleMaterial> needle_materials();
std::span<const NeedlePreset> needle_presets();
// Null: there is none of this name.
const TipKind* find_tip(std::string_view name);
const NeedleMaterial* find_needle_material(std::string_view name);
const NeedlePreset* find_needle(std::string_view name);

// E pi (OD^4 - ID^4) / 64.
double bending_nm2(double outer_mm, double inner_mm, double youngs_modulus_gpa);
// Where the middle of the opening is, from the tip: half of the length of a point of this angle.
double opening_m(double outer_mm, double half_angle_deg);
// All of it: diameters, length, stiffness (it bends), and its tip.
NeedleConfig needle_of(const NeedlePreset& preset);

}  // namespace stylet::hal
