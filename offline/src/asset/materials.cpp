// SPDX-License-Identifier: GPL-3.0-or-later
#include "asset/materials.h"

#include <algorithm>

#include "asset/tissue_table.h"
#include "base/refusal.h"

namespace stylet::offline {
namespace {

std::string known_keys() {
  std::string text;
  for (const TissueNumber& number : tissue_numbers()) text += fmt::format("{}, ", number.key);
  return text + "source";
}

double read_number(const std::string& file, const TissueNumber& number, const toml::node& node) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value) {
    refuse("{}: {}: expected a number from {} to {}", place_of(file, node), number.key,
           number.least, number.most);
  }
  if (!(*value >= number.least && *value <= number.most)) {
    refuse("{}: {} = {}: expected {} to {}", place_of(file, node), number.key, *value, number.least,
           number.most);
  }
  return *value * number.si_per_unit;
}

Tissue read_tissue(const std::string& file, const std::string& name, const toml::table& table) {
  const auto& presets = preset_tissues();
  const auto base = std::find_if(presets.begin(), presets.end(),
                                 [&](const Tissue& preset) { return preset.name == name; });
  const bool has_base = base != presets.end();
  Tissue tissue = has_base ? *base : Tissue{};
  tissue.name = name;
  tissue.source = file;
  for (const auto& [toml_key, node] : table) {
    const std::string key_name(toml_key.str());
    if (key_name == "source") {
      if (!node.is_string()) refuse("{}: source: expected a string", place_of(file, node));
      tissue.source = *node.value<std::string>();
      continue;
    }
    const auto number =
        std::find_if(tissue_numbers().begin(), tissue_numbers().end(),
                     [&](const TissueNumber& each) { return key_name == each.key; });
    if (number == tissue_numbers().end()) {
      refuse("{}: {}: unknown key: expected one of {}", place_of(file, node), key_name,
             known_keys());
    }
    tissue.*(number->field) = read_number(file, *number, node);
  }
  for (const TissueNumber& number : tissue_numbers()) {
    if (!has_base && number.must_be_given && !table.contains(number.key)) {
      refuse("{}: {}: {} is missing: expected a number from {} to {}", place_of(file, table), name,
             number.key, number.least, number.most);
    }
  }
  if (tissue.static_friction_n_per_m < tissue.coulomb_friction_n_per_m) {
    refuse(
        "{}: {}: static_friction_n_per_mm = {}: expected at least coulomb_friction_n_per_mm = {}",
        place_of(file, table), name, tissue.static_friction_n_per_m * 1e-3,
        tissue.coulomb_friction_n_per_m * 1e-3);
  }
  return tissue;
}

// Numbers are in the order of Tissue's members, in SI units. A tissue without a surface that must
// be broken has its cutting force as puncture force.
std::vector<Tissue> organ_tissues() {
  return {
      {"liver",
       "parenchyma under its capsule; effective modulus at needle scale, G = 8 kPa (Gokgol 2012; "
       "small-strain G is 1.8 kPa); forces and friction for 18G within Okamura, Simone, O'Leary "
       "2004",
       1060, 23200, 0.45, 0.4, 1.0, 0.3, 0.3, 0.1, 10, 12, 1e-3, 20},
      {"liver_capsule",
       "liver under its capsule: 10 MPa times 0.1 mm of membrane spread over the voxel; puncture "
       "by 18G takes 0.5 to 3 N",
       1060, 23200, 0.45, 0.4, 1.0, 0.7, 0.3, 0.1, 10, 12, 1e-3, 20, 0, 1000},
      {"tumour",
       "hepatocellular carcinoma: G = 23.4 kPa (PMC6925591), within E 40 to 240 kPa of prostate "
       "cancer (Krouskop 1998); forces above those of liver by judgement",
       1060, 67900, 0.45, 0.3, 1.0, 1.0, 0.5, 0.1, 12, 15, 1e-3, 20},
      {"vessel",
       "hepatic artery: G = 210 kPa (PMC6925591); density of blood 1055 (Kaye and Laby); forces by "
       "judgement, below those of skin",
       1055, 609000, 0.45, 0.2, 1.0, 1.0, 0.3, 0.1, 10, 12, 1e-3, 10},
      {"kidney",
       "cortex E 5 to 15 kPa at small strain, scaled to needle scale as liver; density 1050 (Kaye "
       "and Laby); friction 0.005 to 0.05 N/mm for 17G to 18G",
       1050, 30000, 0.45, 0.5, 1.0, 1.0, 0.4, 0.1, 12, 15, 1e-3, 20},
      {"spleen",
       "liver's modulus at needle scale times 1.6, the ratio of the two by MR elastography at 60 "
       "Hz (3.6 kPa, Mannelli 2010; liver 2.2 to 2.3); density 1054 (Kaye and Laby); forces by "
       "judgement",
       1054, 37000, 0.45, 0.4, 1.0, 0.5, 0.3, 0.1, 10, 12, 1e-3, 20},
      {"pancreas",
       "liver's modulus at needle scale times 0.8, the ratio of the two by MR elastography at 40 "
       "and 60 Hz (An, Shi, Guo 2015; Xu 2020); forces by judgement, as liver's",
       1050, 18600, 0.45, 0.4, 1.0, 0.3, 0.3, 0.1, 10, 12, 1e-3, 20},
      {"stomach",
       "wall and content as one, by judgement as soft as relaxed muscle across its fibres; "
       "punctures and slides less than muscle",
       1050, 20000, 0.45, 0.4, 1.0, 0.6, 0.4, 0.1, 20, 25, 1e-3, 20},
      {"prostate",
       "E 15 to 70 kPa (Krouskop 1998), shaft friction 0.03 to 0.12 N/mm; 18G: less than the 8.9 N "
       "met at the perineum (Podder et al. 2006); density 1027 (PMC4201780)",
       1027, 40000, 0.45, 0.4, 1.0, 1.0, 1.0, 0.1, 50, 60, 1e-3, 30},
      {"prostate_capsule",
       "prostate under its capsule, a membrane and a puncture of it by judgement", 1027, 40000,
       0.45, 0.4, 1.0, 2.0, 1.0, 0.1, 50, 60, 1e-3, 30, 0, 2000},
  };
}

// Tissues on the way to organs, materials of phantoms, and bone.
std::vector<Tissue> other_tissues() {
  return {
      {"fat",
       "E 1 to 20 kPa, typical 3.3 (Samani 2007), doubled at needle scale; density 901 to 923 "
       "(Kaye and Laby); forces below those of muscle by judgement",
       911, 6600, 0.45, 0.4, 0.8, 0.1, 0.1, 0.1, 5, 6, 1e-3, 10},
      {"epidural_fat",
       "half liquid: E 3.3 kPa (fat, Samani 2007); a needle meets next to nothing, by judgement",
       911, 3300, 0.45, 0.4, 0.8, 0.05, 0.05, 0.1, 3, 4, 1e-3, 5},
      {"dura",
       "membrane in epidural fat: 0.3 mm of 10 MPa, between the 5 and 65 MPa across and along its "
       "fibres (Runza et al. 1999); punctured where it is tented by 4 mm, of 2 to 6 mm (Zarzur and "
       "Goncalves 1992); friction as epidural fat's",
       1100, 3300, 0.45, 0.2, 0.8, 0.25, 0.05, 0.1, 3, 4, 1e-3, 5, 0, 3000},
      {"muscle",
       "relaxed, across fibres: E 10 to 50 kPa; density 1047 (Kaye and Laby); shaft friction 0.03 "
       "to 0.12 N/mm",
       1047, 40000, 0.45, 0.4, 1.0, 0.6, 0.6, 0.1, 40, 50, 1e-3, 30},
      {"fascia",
       "muscle under its fascia, a membrane of 2 N/mm, and the puncture of it, by judgement", 1047,
       40000, 0.45, 0.4, 1.0, 1.2, 0.6, 0.1, 40, 50, 1e-3, 30, 0, 2000},
      {"ligament",
       "supraspinous and interspinous: 9.1 and 7.6 to 8 N on a Tuohy needle (layer table of "
       "epidural simulators after Brett); modulus across the fibres and friction by judgement",
       1100, 5e5, 0.45, 0.2, 1.0, 7.8, 4.0, 0.1, 50, 60, 1e-3, 30},
      {"ligamentum_flavum",
       "12.1 N on a Tuohy needle (same table), 11.1 to 11.8 N before loss of resistance in the "
       "pig (Vaughan et al. 2012); E across the fibres below the 2 to 10 MPa along them",
       1100, 1e6, 0.45, 0.2, 1.0, 12.1, 9.0, 0.1, 50, 60, 1e-3, 30},
      {"skin",
       "E 50 to 200 kPa in vivo by indentation, up to 20 MPa in tension, of which 1 MPa times 2 mm "
       "as membrane; density 1150 (Kaye and Laby); puncture by 21G to 27G 0.3 to 2 N, 18G at the "
       "upper end",
       1150, 100000, 0.45, 0.3, 1.0, 2.0, 0.8, 0.1, 40, 50, 1e-3, 30, 0, 2000},
      {"gel",
       "gelatin and PVC phantoms E 5 to 100 kPa; needle in agarose: mu 0.255, radial stress 248 Pa "
       "at 1.8 mm/s, so 0.25 N/m for 18G",
       1000, 10000, 0.45, 0.0, 1.0, 0.3, 0.2, 0.1, 0.25, 0.29, 1e-3, 5},
      {"bone",
       "a stop, not a model of bone: as stiff and as strong as the format carries comfortably",
       1900, 1e8, 0.3, 0.0, 1.0, 500, 500, 1.0, 1000, 1200, 1e-3, 1000},
  };
}

// Tissues of which a toughness is published, once more with it, under a name of their own: their
// forces follow from the needle. Coefficients of friction are those with which the friction on 18G
// is the written one of the same tissue.
struct Toughness {
  const char* tissue;
  double j_per_m2, friction_coefficient;
  const char* source;
};
constexpr Toughness kToughnesses[] = {
    {"liver", 164, 0.18,
     "toughness of bovine liver 164 +- 6 J/m2 (Gokgol, Basdogan, Canadinc 2012); porcine 76 to 185 "
     "by a needle (Azar and Hayward 2008), 187 to 225 by a blade"},
    {"liver_capsule", 164, 0.18,
     "toughness as of liver, whose insertions went through the capsule (Azar and Hayward 2008)"},
    {"vessel", 290, 0,
     "toughness of porcine aorta 290 +- 110 J/m2 by a blade, torn without one 1700; friction as "
     "written"},
    {"muscle", 550, 0.4,
     "toughness of porcine muscle 550 to 8000 J/m2 (notched strips): the lowest, as a needle cuts"},
    {"skin", 1136, 0.16,
     "toughness of porcine skin 1136 J/m2 by a needle; torn without an edge 17100 to 30400"},
};

std::vector<Tissue> with_toughness(const std::vector<Tissue>& tissues) {
  std::vector<Tissue> all;
  for (const Toughness& each : kToughnesses) {
    Tissue tissue = *std::find_if(tissues.begin(), tissues.end(),
                                  [&](const Tissue& other) { return other.name == each.tissue; });
    tissue.name += "_by_toughness";
    tissue.source += fmt::format("; {}", each.source);
    tissue.fracture_toughness_j_per_m2 = each.j_per_m2;
    tissue.needle_friction_coefficient = each.friction_coefficient;
    all.push_back(tissue);
  }
  return all;
}

}  // namespace

double shown(float value) {
  return std::stod(fmt::format("{}", value));
}

#define STYLET_FIELD_OF_TISSUE(field, ...) &Tissue::field,
const std::vector<TissueNumber>& tissue_numbers() {
  static const std::vector<TissueNumber> kNumbers = [] {
    constexpr double Tissue::*kFields[] = {STYLET_MATERIAL_NUMBERS(STYLET_FIELD_OF_TISSUE)};
    std::vector<TissueNumber> all;
    for (const MaterialNumber& number : kMaterialNumbers) {
      const double units_per_si = 1 / number.si_per_unit;
      all.push_back({number.key, kFields[all.size()], number.si_per_unit,
                     shown(number.least) * units_per_si, shown(number.most) * units_per_si,
                     number.must_be_given});
    }
    return all;
  }();
  return kNumbers;
}
#undef STYLET_FIELD_OF_TISSUE

const std::vector<Tissue>& preset_tissues() {
  static const std::vector<Tissue> kPresets = [] {
    std::vector<Tissue> all = organ_tissues();
    for (const Tissue& tissue : other_tissues()) all.push_back(tissue);
    for (const Tissue& tissue : with_toughness(all)) all.push_back(tissue);
    return all;
  }();
  return kPresets;
}

std::vector<Tissue> tissues_of(const toml::table& root, const std::string& file) {
  std::vector<Tissue> tissues;
  for (const auto& [name, node] : root) {
    if (!node.is_table()) {
      refuse("{}: {}: expected a table [{}] of tissue properties", place_of(file, node), name.str(),
             name.str());
    }
    tissues.push_back(read_tissue(file, std::string(name.str()), *node.as_table()));
  }
  return tissues;
}

std::vector<Tissue> read_tissues(const std::filesystem::path& toml_file) {
  return tissues_of(read_toml(toml_file), toml_file.string());
}

const Tissue& find_tissue(const std::vector<Tissue>& own, const std::string& name) {
  std::string known;
  for (const auto* list : {&own, &preset_tissues()}) {
    for (const Tissue& tissue : *list) {
      if (tissue.name == name) return tissue;
      known += (known.empty() ? "" : ", ") + tissue.name;
    }
  }
  refuse("tissue '{}': expected one of {}", name, known);
}

Tissue in_layer(Tissue tissue, double thickness_m, double edge_m) {
  if (thickness_m > edge_m) {
    tissue.youngs_modulus_pa += tissue.membrane_n_per_m / thickness_m;
    tissue.membrane_n_per_m = 0;
  }
  return tissue;
}

}  // namespace stylet::offline
