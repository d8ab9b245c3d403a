// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture.h"

#include <fmt/format.h>
#include <png.h>

#include <map>
#include <stdexcept>

namespace stylet::bake {
namespace {

struct Place {  // in a picture
  double u = 0, v = 0;
};

// ---- sections -----------------------------------------------------------------------------------

// Axes of a section, to the right and downward; z is upward, so it is turned over.
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

// Where the plane cuts the triangles, as a path of single strokes.
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
          fmt::format("M{:.2f} {:.2f}L{:.2f} {:.2f}", ends[0].u, ends[0].v, ends[1].u, ends[1].v);
    }
  }
  return path;
}

// Neighbours of one colour and filling along a row are one rectangle.
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
  const double edge_mm = static_cast<double>(organ.voxel_edge_m) * 1e3;
  const auto end_run = [&] {
    if (run.count == 0) return;
    const Place low = place_mm(sheet, low_corner_m(organ, run.cell));
    text += fmt::format("<rect x='{:.2f}' y='{:.2f}' width='{:.2f}' height='{:.2f}' {}/>", low.u,
                        sheet.v_sign > 0 ? low.v : low.v - edge_mm, edge_mm * run.count, edge_mm,
                        run.fill);
  };
  std::vector<std::uint32_t> shown;
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    if (cells[i][section.axis] == section.layer) shown.push_back(i);
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
    next[sheet.u] += run.count;
    if (run.count == 0 || next != cells[voxel] || fill != run.fill) {
      end_run();
      run = {cells[voxel], 0, fill};
    }
    ++run.count;
  }
  end_run();
  return text;
}

// ---- views --------------------------------------------------------------------------------------

constexpr int kWidth = 960, kHeight = 720;

// Looks at the body from the front, a little from its left and from above.
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
  Box box;  // in the picture
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

// Fills what of the triangle is nearer than what is drawn already.
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

// Bright where it faces the eye's left and above.
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
  if (png_image_write_to_memory(&image, text.data(), &bytes, 0, canvas.rgb.data(), 0, nullptr) ==
      0) {
    throw std::runtime_error(fmt::format("a picture cannot be written: {}", image.message));
  }
  text.resize(bytes);
  return text;
}

}  // namespace

std::string css(Colour c) {
  return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
}

Colour colour_of(const std::string& tissue, std::size_t index) {
  static const std::map<std::string, Colour> kUsual = {{"liver", {166, 82, 66}},
                                                       {"liver_capsule", {205, 133, 114}},
                                                       {"kidney", {190, 104, 120}},
                                                       {"vessel", {196, 30, 42}},
                                                       {"bone", {226, 214, 178}},
                                                       {"muscle", {204, 112, 92}},
                                                       {"fat", {240, 214, 110}},
                                                       {"epidural_fat", {246, 226, 140}},
                                                       {"skin", {236, 188, 160}},
                                                       {"tumour", {104, 140, 60}},
                                                       {"prostate", {180, 120, 160}},
                                                       {"prostate_capsule", {206, 160, 190}},
                                                       {"fascia", {214, 200, 196}},
                                                       {"ligament", {198, 190, 164}},
                                                       {"ligamentum_flavum", {214, 190, 90}},
                                                       {"gel", {120, 170, 196}}};
  static const Colour kOthers[] = {{120, 94, 168}, {72, 148, 140}, {208, 130, 52},
                                   {84, 118, 178}, {150, 150, 70}, {176, 88, 140}};
  const auto usual = kUsual.find(tissue);
  return usual != kUsual.end() ? usual->second : kOthers[index % std::size(kOthers)];
}

Section best_section(const Organ& organ, const std::vector<Cell>& cells, std::size_t axis) {
  const std::uint32_t layers[3] = {organ.size_x, organ.sheet_rows, organ.size_z};
  std::vector<std::uint64_t> tissues(layers[axis], 0);
  std::vector<std::size_t> voxels(layers[axis], 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    tissues[cells[i][axis]] |= std::uint64_t{1} << organ.voxel_material[i];
    ++voxels[cells[i][axis]];
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

std::string section_svg(const Organ& organ, const std::vector<Cell>& cells,
                        const std::vector<Colour>& colours, const Section& section,
                        const Mesh& input_m, const Mesh& surface_m) {
  const Sheet sheet = sheet_of(section.axis);
  Cell middle{};
  middle[section.axis] = section.layer;
  const double edge_m = static_cast<double>(organ.voxel_edge_m);
  const double at_m = low_corner_m(organ, middle)[section.axis] + edge_m / 2;
  const Place a = place_mm(sheet, low_corner_m(organ, {0, 0, 0}));
  const Place b =
      place_mm(sheet, low_corner_m(organ, {organ.size_x, organ.sheet_rows, organ.size_z}));
  const double margin = edge_m * 1e3, width = b.u - a.u, height = std::fabs(b.v - a.v);
  const double stroke = std::max(width, height) / 130;
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='{:.2f} {:.2f} {:.2f} {:.2f}'>"
      "<g shape-rendering='crispEdges'>{}</g><path d='{}' stroke='#fff' stroke-width='{:.3f}'/>"
      "<path d='{}' stroke='#000' stroke-width='{:.3f}'/></svg>",
      a.u - margin, std::min(a.v, b.v) - margin, width + 2 * margin, height + 2 * margin,
      rectangles(organ, cells, colours, section, sheet), outline(sheet, surface_m, at_m), stroke,
      outline(sheet, input_m, at_m), stroke / 3);
}

std::string view_png(const Organ& organ, const VoxelMesh& shown,
                     const std::vector<Colour>& colours) {
  const Camera camera = camera_for(shown.mesh);
  Canvas canvas;
  for (std::size_t i = 0; i < shown.mesh.triangles.size(); ++i) {
    std::array<Vec, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = shown.mesh.points[shown.mesh.triangles[i][c]];
    const Vec normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    for (Vec& corner : corners) corner = on_canvas(camera, corner);
    draw(corners, lit(colours[organ.voxel_material[shown.voxel[i]]], normal), canvas);
  }
  return png_bytes(canvas);
}

}  // namespace stylet::bake
