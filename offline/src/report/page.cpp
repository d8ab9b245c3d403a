// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/page.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <nlohmann/json.hpp>

#include "report/picture.h"
#include "report/speed.h"

namespace stylet::offline {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kStyle =
    "body{font:16px/1.5 sans-serif;color:#222;max-width:1080px;margin:2em auto;padding:0 1em}"
    "h1{margin-bottom:0}h2{margin-top:2em;border-bottom:1px solid #ccc}"
    "table{border-collapse:collapse;margin:1em 0}td,th{padding:.3em .9em;text-align:right;"
    "border-bottom:1px solid #e4e4e4}td:first-child,th:first-child{text-align:left}"
    "figure{display:inline-block;width:32%;margin:0 .5% 1em 0;vertical-align:top}"
    "figure.view{width:48%}figure.cut svg{display:none}figure.cut svg.on{display:block}"
    "figure.cut input{width:100%}figure svg,figure img{width:100%;height:auto;background:#f4f4f2;"
    "border:1px solid #ddd}path{fill:none}figcaption{font-size:.85em;color:#555}"
    ".note{background:#fff6dc;border-left:4px solid #e0a100;padding:.6em 1em}"
    ".good{background:#e9f6ea;border-left:4px solid #3c9a46;padding:.6em 1em}"
    ".key i{display:inline-block;width:1em;height:1em;margin:0 .4em 0 1em;vertical-align:-.1em;"
    "border:1px solid #999}.small{font-size:.85em;color:#555;overflow-wrap:anywhere}";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return out;
}

std::string base64(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

std::string number(const Json& value, int digits = 1) {
  return fmt::format("{:.{}f}", value.get<double>(), digits);
}

std::string percent(double part, double whole) {
  return whole > 0 ? fmt::format("{:+.2f} %", (part / whole - 1) * 100) : "";
}

// ---- text ---------------------------------------------------------------------------------------

std::string heading(const Json& facts) {
  const Json& organ = facts["organ"];
  std::string from;
  for (const Json& source : organ["provenance"]["sources"]) {
    from += (from.empty() ? "" : ", ") + source["path"].get<std::string>();
  }
  const Json& levels = organ["levels"];
  return fmt::format(
      "<h1>{}</h1><p>Made from {}. {} voxels with an edge of {:.4g} mm{}, {:.4g} ml in all, in {} "
      "piece{}.</p>",
      escaped(organ["name"]), escaped(from), organ["voxels"].get<std::size_t>(),
      organ["voxel_edge_mm"].get<double>(),
      levels.size() > 1 ? fmt::format(" to {:.4g} mm", levels.back()["voxel_edge_mm"].get<double>())
                        : "",
      organ["volume_ml"].get<double>(), facts["quality"]["piece_count"].get<std::size_t>(),
      facts["quality"]["piece_count"] == 1 ? "" : "s");
}

std::string findings(const Json& quality) {
  if (quality["findings"].empty()) {
    return "<p class='good'>Nothing was found that needs a second look.</p>";
  }
  std::string list;
  for (const Json& each : quality["findings"]) list += "<li>" + escaped(each) + "</li>";
  return "<div class='note'><b>Please look at this before use:</b><ul>" + list + "</ul></div>";
}

std::string tissues(const Json& quality) {
  std::string rows;
  for (const Json& t : quality["tissues"]) {
    const double input = t["input_ml"].get<double>();
    rows += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{} of "
        "{}</td></tr>",
        escaped(t["from"]), escaped(t["tissue"]), number(t["input_ml"], 2),
        number(t["sampled_ml"], 2), percent(t["sampled_ml"].get<double>(), input),
        number(t["given_ml"], 2),
        t["input_pieces"].get<int>() - t["pieces_without_voxel"].get<int>(),
        t["input_pieces"].get<int>());
  }
  return "<h2>Volumes</h2><table><tr><th>from</th><th>tissue</th><th>input, ml</th><th>in the "
         "organ, ml</th><th>difference</th><th>in voxels of its own, ml</th><th>pieces "
         "kept</th></tr>" +
         rows +
         "</table><p class='small'>A voxel behaves as the tissue that fills most of it (or has the "
         "highest priority), also in the part of it that another tissue fills.</p>";
}

std::string distance_row(const char* what, const Json& d, const char* most) {
  if (d.is_null()) return "";
  return fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>", what, number(d["mean_mm"], 3),
                     number(d[most], 2));
}

std::string distances(const Json& quality) {
  return "<h2>Distance from the input's surface</h2><table><tr><th></th><th>mean, "
         "mm</th><th>largest, mm</th></tr>" +
         distance_row("surface that the needle meets and the eye sees", quality["surface"],
                      "hausdorff_mm") +
         distance_row("voxels, where they stick out", quality["voxel_faces_to_input"], "most_mm") +
         "</table><p class='small'>Measured at sample points; of the surface, the larger of both "
         "directions (Hausdorff).</p>";
}

std::string repairs(const Json& facts) {
  std::string rows;
  for (const Json& input : facts["inputs"]) {
    std::string what;
    for (const auto& [name, count] : input["repaired"].items()) {
      if (count.get<std::size_t>() == 0) continue;
      std::string words = name;
      std::replace(words.begin(), words.end(), '_', ' ');
      what += fmt::format("{}{} {}", what.empty() ? "" : ", ", count.get<std::size_t>(), words);
    }
    rows += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>", escaped(input["path"]),
                        input["closed"].get<bool>() ? "closed" : "open",
                        what.empty() ? "nothing" : what);
  }
  if (rows.empty()) return "";
  return "<h2>Repaired</h2><table><tr><th>mesh</th><th>is</th><th>repaired</th></tr>" + rows +
         "</table>";
}

std::string inertia(const Json& speed) {
  const Json& of = speed["resonance"];
  if (!(of["real_hz"].get<double>() > 0)) return "";
  return fmt::format(
      "<p>With {} the organ's first resonance is at {} Hz; that of the tissue itself is at {} "
      "Hz{}.</p>",
      stepping_text(speed), number(of["stepped_hz"], 1), number(of["real_hz"], 1),
      of.contains("departs_hz") ? "; the force on a moving hand may be off by a tenth above " +
                                      number(of["departs_hz"], 1) + " Hz"
                                : "");
}

std::string speed(const Json& facts) {
  const Json& speed = facts["speed"];
  const bool timed = speed.contains("machine");
  std::string head = "<tr><th>substeps</th><th>passes</th>", rows;
  if (timed) head += "<th>tick, us</th>";
  for (const auto& [name, factor] : speed["by_substeps"][0]["true_mass"]["mass_factor"].items()) {
    head += "<th>" + escaped(name) + "</th>";
  }
  for (const auto& [inertia, name] :
       {std::pair("true_mass", "true mass"), std::pair("added_mass", "added mass")}) {
    for (const Json& row : speed["by_substeps"]) {
      const Json& of = row[inertia];
      rows += fmt::format("<tr><td>{}, {}</td><td>{}</td>", row["substeps"].get<std::uint32_t>(),
                          name, of["passes"].get<std::uint32_t>());
      if (timed) rows += "<td>" + number(of["tick_us"], 0) + "</td>";
      for (const auto& [material, factor] : of["mass_factor"].items()) {
        rows += fmt::format("<td>x {}</td>", number(factor, factor < 10 ? 2 : 0));
      }
      rows += "</tr>";
    }
  }
  std::string on = timed
                       ? fmt::format(" on {}: a tick of {} us, half of the period at most",
                                     escaped(speed["machine"]["name"]), number(speed["tick_us"], 0))
                       : "";
  if (speed.contains("timed_us")) {
    on += fmt::format("; timed on this organ {} us", number(speed["timed_us"], 0));
  }
  return fmt::format("<h2>Speed and inertia</h2><p>Period {} us, {}{}.</p>{}<table>",
                     number(speed["period_us"], 0), stepping_text(speed), on, inertia(speed)) +
         head + "</tr>" + rows +
         "</table><p class='small'>Where tissue is too stiff, or voxels are too small, for the "
         "step: with true mass a filter slows its short waves, which no hand feels, in several "
         "passes, and mass is added only where these are not enough. With added mass, which may "
         "take half the time, the tissue gets more mass than it has; the table has the factor for "
         "each whole material. Forces at rest are exact either way, but added mass makes fast "
         "motion sluggish. With more substeps less of it is needed.</p>";
}

std::string provenance(const Json& organ) {
  std::string text = fmt::format(
      "<h2>Origin</h2><p class='small'>Organ hash {}. {}: {}</p>", organ["hash"].get<std::string>(),
      escaped(organ["provenance"]["tool_version"]), escaped(organ["provenance"]["options"]));
  for (const Json& s : organ["provenance"]["sources"]) {
    text += fmt::format("<p class='small'>{}: SHA-256 {}</p>", escaped(s["path"]),
                        s["sha256"].get<std::string>());
  }
  return text;
}

// ---- pictures -----------------------------------------------------------------------------------

constexpr const char* kSections[] = {"sagittal, across x", "coronal, across y", "axial, across z"};
constexpr const char* kScroll =
    "<script>for(const r of document.querySelectorAll('figure.cut input')){const f=r.parentNode,"
    "s=f.querySelectorAll('svg'),t=f.querySelector('b');r.oninput=()=>s.forEach((e,i)=>{"
    "e.classList.toggle('on',i==r.value);if(i==r.value)t.textContent=r.dataset.at.split(' ')[i]})}"
    "</script>";

// The layers to scroll through: evenly spread, including the best one.
std::vector<std::uint32_t> layers_of(const Organ& organ, const Section& best) {
  constexpr std::uint32_t kMostLayers = 32;
  const std::array<std::uint32_t, 3> count = size_in_space(organ);
  const std::uint32_t step = (count[best.axis] + kMostLayers - 1) / kMostLayers;
  std::vector<std::uint32_t> layers;
  for (std::uint32_t layer = best.layer % step; layer < count[best.axis]; layer += step) {
    layers.push_back(layer);
  }
  return layers;
}

std::string scrolled_sections(const Shown& shown, std::size_t axis) {
  const Section best = best_section(shown.organ, shown.cells, axis);
  const std::vector<std::uint32_t> layers = layers_of(shown.organ, best);
  std::string pictures, places;
  std::size_t first = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const Section section = {axis, layers[i]};
    std::string svg = section_svg(shown, section);
    if (layers[i] == best.layer) {
      first = i;
      svg.insert(svg.find(' '), " class='on'");
    }
    pictures += svg;
    places += fmt::format("{}{:.1f}", i == 0 ? "" : " ", section_at_m(shown.organ, section) * 1e3);
  }
  return fmt::format(
      "<figure class='cut'>{}<input type='range' min='0' max='{}' value='{}' aria-label='{}' "
      "data-at='{}'><figcaption>{} at <b>{:.1f}</b> mm</figcaption></figure>",
      pictures, layers.size() - 1, first, kSections[axis], places, kSections[axis],
      section_at_m(shown.organ, best) * 1e3);
}

// Whether the frame is the patient's: for label maps, except Inrimage, which has no sides.
bool is_of_patient(const Json& facts) {
  if (facts["labels"].empty()) return false;
  const std::string path = facts["organ"]["provenance"]["sources"][0]["path"];
  return path.find(".inr") == std::string::npos;
}

Shown shown_of(const Json& facts, const Organ& organ, const Built& built, const Mesh& surface_m) {
  Shown shown = {organ, cells_of(organ),     {}, built.input_m, surface_m, {},
                 {},    is_of_patient(facts)};
  for (std::uint32_t i = 0; i < organ.material_count; ++i) {
    shown.colours.push_back(material_colour(i));
  }
  for (const NamedHull& each : built.obstacles) {
    shown.obstacles.push_back({escaped(each.name), hull_mesh(each.hull)});
  }
  for (const Target& each : built.targets) {
    shown.aims.push_back({escaped(each.name), each.middle_m, each.radius_m});
  }
  return shown;
}

std::string key_of(const Shown& shown) {
  std::string key = "<p class='key'>";
  for (std::uint32_t i = 0; i < shown.organ.material_count; ++i) {
    key += fmt::format("<i style='background:{}'></i>{}", css(shown.colours[i]),
                       escaped(organ_material(shown.organ, i).name));
  }
  if (!shown.obstacles.empty())
    key += "<i style='background:#777;border-style:dashed'></i>obstacle";
  if (!shown.aims.empty()) key += "<i style='border-radius:50%'></i>target";
  return key + "</p>";
}

std::string pictures(const Json& facts, const Organ& organ, const Built& built) {
  const VoxelMesh surface = surface_mesh(organ, cells_of(organ));
  const Shown shown = shown_of(facts, organ, built, surface.mesh);
  const VoxelGrid grid = voxel_grid(shown.cells);
  std::string html = "<h2>Sections</h2>" + key_of(shown);
  for (const std::size_t axis : {std::size_t{2}, std::size_t{1}, std::size_t{0}}) {
    html += scrolled_sections(shown, axis);
  }
  html +=
      "<p class='small'>Squares are voxels, paler the emptier. Black: the surface of the input; "
      "white: that of the organ. ";
  html += shown.of_patient ? "R, L: the patient's right and left; A, P: front and back; S, I: head "
                             "and feet."
                           : "The letters are the axes of the input.";
  html += " The sliders go through the layers.</p><h2>Views</h2>";
  // No voxel of any level lies on both sides.
  const std::uint32_t layer = best_section(organ, shown.cells, 1).layer;
  const std::uint32_t front = layer - layer % (1U << (organ.levels - 1U));
  const VoxelMesh faces =
      voxel_faces(organ, shown.cells, grid, [front](const Cell& cell) { return cell[1] >= front; });
  const auto add_view = [&](const VoxelMesh& mesh, const char* caption) {
    if (mesh.mesh.triangles.empty()) return;
    html += fmt::format(
        "<figure class='view'><img alt='{}' src='data:image/png;base64,{}'><figcaption>{}"
        "</figcaption></figure>",
        caption, base64(view_png(shown, mesh)), caption);
  };
  add_view(surface, "surface, from low y (in a patient: the front)");
  add_view(faces, "voxels, cut open where the second section lies");
  return html + kScroll;
}

}  // namespace

void add_report(Outputs& outputs, const std::filesystem::path& folder,
                const nlohmann::ordered_json& facts, const Organ& organ, const Built& built) {
  const Json& quality = facts["quality"];
  const std::string html =
      "<!doctype html><html lang='en'><head><meta charset='utf-8'><meta name='viewport' "
      "content='width=device-width'><title>" +
      escaped(facts["organ"]["name"]) + "</title><style>" + kStyle + "</style></head><body>" +
      heading(facts) + findings(quality) + pictures(facts, organ, built) + tissues(quality) +
      distances(quality) + repairs(facts) + speed(facts) + provenance(facts["organ"]) +
      "</body></html>\n";
  outputs.add_folder(folder);
  outputs.add(folder / "report.json", facts.dump(2) + "\n");
  outputs.add(folder / "report.html", html);
}

}  // namespace stylet::offline
