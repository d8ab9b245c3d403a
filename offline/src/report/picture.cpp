// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/picture.h"

#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <stdexcept>

namespace stylet::offline {
namespace {

struct Place {  // a place in a picture
  double u = 0, v = 0;
};

// ---- sections -----------------------------------------------------------------------------------

// Axes of a section, to the right and downward; z points up, so its sign is changed.
struct Sheet {
  std::size_t across, u, v;
  double v_sign;
};

Sheet sheet_of(std::size_t axis) {
  if (axis == 2) return {2, 0, 1, 1};
  return {axis, axis == 0 ? 1U : 0U, 2, -1};
}

Place place_mm(const Sheet& sheet, Vec p_m) {
  return {p_m[sheet.u] * 1e3, p_m[sheet.v] * 1e3 * sheet.v_sign};
}

// The lines where the plane cuts the triangles, as a path of single strokes.
std::string outline(const Sheet& sheet, const Mesh& mesh, double at_m) {
  std::string path;
  for (const Triangle& t : mesh.triangles) {
    Place ends[3];
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec a = mesh.points[t[i]], b = mesh.points[t[(i + 1) % 3]];
      const double from = a[sheet.across] - at_m, to = b[sheet.across] - at_m;
      if ((from < 0) != (to < 0)) {
        ends[count++] = place_mm(sheet, a + (b - a) * (from / (from - to)));
      }
    }
    if (count == 2) {
      path +=
          fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", ends[0].u, ends[0].v, ends[1].u, ends[1].v);
    }
  }
  return path;
}

// Neighbours in a row with the same colour and fill become one rectangle.
std::string rectangles(const Organ& organ, const std::vector<Cell>& cells,
                       const std::vector<Colour>& colours, const Section& section,
                       const Sheet& sheet) {
  struct Run {
    Cell cell{};
    std::uint32_t count = 0;
    std::string fill;
  };
  std::string text;
  Run run;
  const double cell_mm = cell_edge_m(organ) * 1e3;
  const auto end_run = [&] {
    if (run.count == 0) return;
    const Place low = place_mm(sheet, low_corner_m(organ, run.cell));
    const double edge_mm = cell_mm * run.cell.size;
    text += fmt::format("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' {}/>", low.u,
                        sheet.v_sign > 0 ? low.v : low.v - edge_mm, edge_mm * run.count, edge_mm,
                        run.fill);
  };
  std::vector<std::uint32_t> shown;
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t low = cells[i][section.axis];
    if (low <= section.layer && section.layer < low + cells[i].size) shown.push_back(i);
  }
  std::sort(shown.begin(), shown.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(cells[a][sheet.v], cells[a][sheet.u]) <
           std::pair(cells[b][sheet.v], cells[b][sheet.u]);
  });
  for (const std::uint32_t voxel : shown) {
    const int tenths = (organ.voxel_fill[voxel] + 24) / 25;
    const std::string fill =
        fmt::format("fill='{}' fill-opacity='{:.2f}'", css(colours[organ.voxel_material[voxel]]),
                    std::clamp(tenths / 10.0, 0.15, 1.0));
    Cell next = run.cell;
    next[sheet.u] += run.count * run.cell.size;
    next[section.axis] = cells[voxel][section.axis];
    if (run.count == 0 || next != cells[voxel] || fill != run.fill) {
      end_run();
      run = {cells[voxel], 0, fill};
    }
    ++run.count;
  }
  end_run();
  return text;
}

// The filled section of a convex body: the points where the plane cuts it, sorted by angle.
std::string convex_cut(const Sheet& sheet, const Mesh& mesh, double at_m) {
  std::vector<Place> points;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec a = mesh.points[t[i]], b = mesh.points[t[(i + 1) % 3]];
      const double from = a[sheet.across] - at_m, to = b[sheet.across] - at_m;
      if ((from < 0) != (to < 0)) {
        points.push_back(place_mm(sheet, a + (b - a) * (from / (from - to))));
      }
    }
  }
  Place middle;
  for (const Place& p : points) {
    middle.u += p.u / static_cast<double>(points.size());
    middle.v += p.v / static_cast<double>(points.size());
  }
  std::sort(points.begin(), points.end(), [&](const Place& a, const Place& b) {
    return std::atan2(a.v - middle.v, a.u - middle.u) < std::atan2(b.v - middle.v, b.u - middle.u);
  });
  std::string path;
  for (const Place& p : points) path += fmt::format("{:.1f},{:.1f} ", p.u, p.v);
  return path;
}

std::string beside(const Shown& shown, const Sheet& sheet, double at_m, double stroke) {
  std::string text;
  for (const Obstacle& body : shown.obstacles) {
    const std::string points = convex_cut(sheet, body.mesh_m, at_m);
    if (points.empty()) continue;
    text += fmt::format(
        "<polygon points='{}' fill='#000' fill-opacity='.35' stroke='#000' stroke-width='{:.3f}' "
        "stroke-dasharray='{:.2f}'><title>obstacle {}</title></polygon>",
        points, stroke, 2 * stroke, body.name);
  }
  for (const Aim& aim : shown.aims) {
    const double away = aim.middle_m[sheet.across] - at_m;
    if (std::fabs(away) >= aim.radius_m) continue;
    const Place middle = place_mm(sheet, aim.middle_m);
    const double radius_mm = 1e3 * std::sqrt(aim.radius_m * aim.radius_m - away * away);
    for (const auto& [colour, width] : {std::pair("#fff", 1.6), std::pair("#000", 0.6)}) {
      text += fmt::format(
          "<circle cx='{:.2f}' cy='{:.2f}' r='{:.2f}' fill='none' stroke='{}' "
          "stroke-width='{:.3f}'><title>target {}</title></circle>",
          middle.u, middle.v, radius_mm, colour, width * stroke, aim.name);
    }
  }
  return text;
}

// Names of a picture's sides: left, right, top, bottom.
std::array<const char*, 4> sides_of(const Sheet& sheet, bool of_patient) {
  if (of_patient) {
    return {sheet.u == 0 ? "R" : "A", sheet.u == 0 ? "L" : "P", sheet.v == 1 ? "A" : "S",
            sheet.v == 1 ? "P" : "I"};
  }
  return {sheet.u == 0 ? "-x" : "-y", sheet.u == 0 ? "+x" : "+y", sheet.v == 1 ? "-y" : "+z",
          sheet.v == 1 ? "+y" : "-z"};
}

struct Frame {
  double u, v, width, height;
};

// The longest of 1, 2, 5, 10, ... mm that is not longer than `most_mm`.
double scale_mm(double most_mm) {
  const double tens = std::pow(10, std::floor(std::log10(most_mm)));
  return (5 * tens <= most_mm ? 5 : 2 * tens <= most_mm ? 2 : 1) * tens;
}

std::string marks(const Sheet& sheet, bool of_patient, const Frame& frame) {
  const double size = std::max(frame.width, frame.height) / 22;
  const double middle_u = frame.u + frame.width / 2, middle_v = frame.v + frame.height / 2;
  const std::array<const char*, 4> sides = sides_of(sheet, of_patient);
  const Place places[] = {{frame.u + 0.8 * size, middle_v},
                          {frame.u + frame.width - 0.8 * size, middle_v},
                          {middle_u, frame.v + 1.1 * size},
                          {middle_u, frame.v + frame.height - 0.4 * size}};
  std::string text = fmt::format(
      "<g font-family='sans-serif' font-size='{:.2f}' text-anchor='middle' fill='#222' "
      "stroke='#fff' stroke-width='{:.2f}' paint-order='stroke'>",
      size, size / 6);
  for (std::size_t i = 0; i < 4; ++i) {
    text +=
        fmt::format("<text x='{:.2f}' y='{:.2f}'>{}</text>", places[i].u, places[i].v, sides[i]);
  }
  const double bar_mm = scale_mm(frame.width / 3);
  const double bar_v = frame.v + frame.height - 0.7 * size, bar_u = frame.u + 0.5 * size;
  return text + fmt::format(
                    "<text x='{:.2f}' y='{:.2f}' font-size='{:.2f}'>{:g} mm</text></g>"
                    "<path d='M{:.2f} {:.2f}h{:.3f}' stroke='#222' stroke-width='{:.2f}'/>",
                    bar_u + bar_mm / 2, bar_v - 0.3 * size, 0.75 * size, bar_mm, bar_u, bar_v,
                    bar_mm, size / 5);
}

// ---- views --------------------------------------------------------------------------------------

constexpr int kWidth = 960, kHeight = 720;

// A camera that looks from the front, a little from the body's left and from above.
struct Camera {
  Vec right{0.8660254037844386, 0.5, 0};
  Vec down{0.1710100716628344, -0.2961981327260238, -0.9396926207859084};
  Vec away{-0.4698463103929543, 0.8137976813493737, -0.3420201433256687};
  Vec middle_m;
  double pixels_per_m = 1;
};

Camera camera_for(const Mesh& mesh) {
  constexpr double kMargin = 0.96;
  Camera camera;
  Box box;  // in the camera's axes
  for (const Vec& p : mesh.points) {
    grow(box, {dot(p, camera.right), dot(p, camera.down), dot(p, camera.away)});
  }
  const Vec middle = (box.low + box.high) * 0.5, size = box.high - box.low;
  camera.middle_m = camera.right * middle.x + camera.down * middle.y + camera.away * middle.z;
  camera.pixels_per_m =
      kMargin * std::min(kWidth / std::max(size.x, 1e-9), kHeight / std::max(size.y, 1e-9));
  return camera;
}

struct Canvas {
  std::vector<std::uint8_t> rgb = std::vector<std::uint8_t>(3 * kWidth * kHeight, 255);
  std::vector<float> depth =
      std::vector<float>(kWidth * kHeight, std::numeric_limits<float>::infinity());
};

Vec on_canvas(const Camera& camera, Vec p_m) {
  const Vec from = (p_m - camera.middle_m) * camera.pixels_per_m;
  return {dot(from, camera.right) + kWidth / 2.0, dot(from, camera.down) + kHeight / 2.0,
          dot(from, camera.away)};
}

// Draws the part of the triangle that is nearer than what is already drawn.
void draw(const std::array<Vec, 3>& c, Colour colour, Canvas& canvas) {
  const double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
  if (area == 0) return;
  const auto pixel = [](double at, int most) { return std::clamp(static_cast<int>(at), 0, most); };
  const auto [low_x, high_x] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [low_y, high_y] = std::minmax({c[0].y, c[1].y, c[2].y});
  for (int y = pixel(low_y, kHeight - 1); y <= pixel(high_y, kHeight - 1); ++y) {
    for (int x = pixel(low_x, kWidth - 1); x <= pixel(high_x, kWidth - 1); ++x) {
      const double px = x + 0.5, py = y + 0.5;
      const double b =
          ((px - c[0].x) * (c[2].y - c[0].y) - (py - c[0].y) * (c[2].x - c[0].x)) / area;
      const double d =
          ((c[1].x - c[0].x) * (py - c[0].y) - (c[1].y - c[0].y) * (px - c[0].x)) / area;
      if (b < 0 || d < 0 || b + d > 1) continue;
      const auto depth = static_cast<float>(c[0].z + b * (c[1].z - c[0].z) + d * (c[2].z - c[0].z));
      const auto at = static_cast<std::size_t>(y * kWidth + x);
      if (depth >= canvas.depth[at]) continue;
      canvas.depth[at] = depth;
      canvas.rgb[3 * at] = colour.red;
      canvas.rgb[3 * at + 1] = colour.green;
      canvas.rgb[3 * at + 2] = colour.blue;
    }
  }
}

// Brighter where the surface faces the upper left of the viewer.
Colour lit(Colour colour, Vec normal) {
  const Camera camera;
  const Vec light = camera.right * -0.4 + camera.down * -0.5 + camera.away * -0.77;
  const double size = length(normal);
  const double share = size > 0 ? std::fabs(dot(normal, light)) / size : 0;
  const auto shade = [&](std::uint8_t c) {
    return static_cast<std::uint8_t>(c * std::min(1.0, 0.35 + 0.65 * share));
  };
  return {shade(colour.red), shade(colour.green), shade(colour.blue)};
}

std::string png_bytes(const Canvas& canvas) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = kWidth;
  image.height = kHeight;
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string text(bytes, '\0');
  const int made =
      png_image_write_to_memory(&image, text.data(), &bytes, 0, canvas.rgb.data(), 0, nullptr);
  if (made == 0) throw std::runtime_error(fmt::format("no picture is written: {}", image.message));
  text.resize(bytes);
  return text;
}

}  // namespace

std::string css(Colour c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

Colour material_colour(std::size_t index) {
  static constexpr Colour kColours[] = {{0xE6, 0x9F, 0x00}, {0x56, 0xB4, 0xE9}, {0x00, 0x9E, 0x73},
                                        {0xF0, 0xE4, 0x42}, {0x00, 0x72, 0xB2}, {0xD5, 0x5E, 0x00},
                                        {0xCC, 0x79, 0xA7}, {0x33, 0x22, 0x88}, {0x11, 0x77, 0x33},
                                        {0x88, 0x22, 0x55}, {0x44, 0xAA, 0x99}, {0xDD, 0xCC, 0x77},
                                        {0xAA, 0x44, 0x99}};
  return kColours[index % std::size(kColours)];
}

Section best_section(const Organ& organ, const std::vector<Cell>& cells, std::size_t axis) {
  const std::array<std::uint32_t, 3> layers = size_in_space(organ);
  std::vector<std::uint64_t> tissues(layers[axis], 0);
  std::vector<std::size_t> voxels(layers[axis], 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::uint32_t n = 0; n < cells[i].size; ++n) {
      tissues[cells[i][axis] + n] |= std::uint64_t{1} << organ.voxel_material[i];
      ++voxels[cells[i][axis] + n];
    }
  }
  Section best{axis, 0};
  for (std::uint32_t layer = 0; layer < layers[axis]; ++layer) {
    const auto rank = [&](std::uint32_t i) {
      return std::pair(std::popcount(tissues[i]), voxels[i]);
    };
    if (rank(layer) > rank(best.layer)) best.layer = layer;
  }
  return best;
}

double section_at_m(const Organ& organ, const Section& section) {
  Cell middle{};
  middle[section.axis] = section.layer;
  return low_corner_m(organ, middle)[section.axis] + cell_edge_m(organ) / 2;
}

std::string section_svg(const Shown& shown, const Section& section) {
  const Organ& organ = shown.organ;
  const Sheet sheet = sheet_of(section.axis);
  const double at_m = section_at_m(organ, section);
  const Place a = place_mm(sheet, low_corner_m(organ, {}));
  const Place b = place_mm(sheet, low_corner_m(organ, {size_in_space(organ)}));
  const double width = b.u - a.u, height = std::fabs(b.v - a.v);
  const double margin = std::max(width, height) / 12;
  const Frame frame = {a.u - margin, std::min(a.v, b.v) - margin, width + 2 * margin,
                       height + 2 * margin};
  const double stroke = std::max(width, height) / 130;
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='{:.2f} {:.2f} {:.2f} {:.2f}'>"
      "<g shape-rendering='crispEdges'>{}</g><path d='{}' stroke='#fff' stroke-width='{:.3f}'/>"
      "<path d='{}' stroke='#000' stroke-width='{:.3f}'/>{}{}</svg>",
      frame.u, frame.v, frame.width, frame.height,
      rectangles(organ, shown.cells, shown.colours, section, sheet),
      outline(sheet, shown.surface_m, at_m), stroke, outline(sheet, shown.input_m, at_m),
      stroke / 3, beside(shown, sheet, at_m, stroke / 2), marks(sheet, shown.of_patient, frame));
}

std::string view_png(const Shown& shown, const VoxelMesh& mesh) {
  const Camera camera = camera_for(mesh.mesh);
  Canvas canvas;
  const auto draw_all = [&](const Mesh& of, auto colour_of) {
    for (std::size_t i = 0; i < of.triangles.size(); ++i) {
      std::array<Vec, 3> corners;
      for (std::size_t c = 0; c < 3; ++c) corners[c] = of.points[of.triangles[i][c]];
      const Vec normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
      for (Vec& corner : corners) corner = on_canvas(camera, corner);
      draw(corners, lit(colour_of(i), normal), canvas);
    }
  };
  draw_all(mesh.mesh,
           [&](std::size_t i) { return shown.colours[shown.organ.voxel_material[mesh.voxel[i]]]; });
  constexpr Colour kObstacle = {70, 70, 70};
  for (const Obstacle& body : shown.obstacles) {
    draw_all(body.mesh_m, [&](std::size_t) { return kObstacle; });
  }
  return png_bytes(canvas);
}

}  // namespace stylet::offline
