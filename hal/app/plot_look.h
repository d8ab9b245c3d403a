// SPDX-License-Identifier: Apache-2.0
// How a force curve looks where it is to be shown: on a screen beside the console, in a column of a
// paper, or on a slide. Colours are the same in all of them (hal/palette.csv).
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <string_view>

namespace stylet::app {

enum class PictureFormat { kSvg, kPng, kPdf };

// Edges of a panel, as parts of the picture's width and height; and how high the names of its lines
// stand. 0: in the panel, where there is room.
struct Panel {
  double left, right, top, bottom, key = 0;
};

struct Look {
  std::string_view name;
  int width_px, height_px;  // 96 px are an inch
  int font_px, label_px, note_px;
  double total_width, cause_width, depth_width, axis_width;  // of lines, px
  bool shades;  // of the stages; else a line where one begins, which prints better
  Panel time, depth;
};

constexpr Look kOnScreen = {.name = "console",
                            .width_px = 900,
                            .height_px = 820,
                            .font_px = 13,
                            .label_px = 11,
                            .note_px = 10,
                            .total_width = 2.4,
                            .cause_width = 1.6,
                            .depth_width = 2.2,
                            .axis_width = 1,
                            .shades = true,
                            .time = {0.10, 0.97, 0.90, 0.56},
                            .depth = {0.10, 0.97, 0.47, 0.125}};
// A column of 85 mm; text of 7 points.
constexpr Look kOnPaper = {.name = "paper",
                           .width_px = 321,
                           .height_px = 420,
                           .font_px = 9,
                           .label_px = 8,
                           .note_px = 7,
                           .total_width = 1.2,
                           .cause_width = 0.9,
                           .depth_width = 1.1,
                           .axis_width = 0.5,
                           .shades = false,
                           .time = {0.19, 0.97, 0.88, 0.63, 0.485},
                           .depth = {0.19, 0.97, 0.44, 0.20, 0.075}};
// 16 : 9, to be read from the last row.
constexpr Look kOnSlide = {.name = "slide",
                           .width_px = 1280,
                           .height_px = 720,
                           .font_px = 20,
                           .label_px = 17,
                           .note_px = 14,
                           .total_width = 4,
                           .cause_width = 3,
                           .depth_width = 4,
                           .axis_width = 1.5,
                           .shades = true,
                           .time = {0.105, 0.49, 0.83, 0.25, 0.068},
                           .depth = {0.62, 0.98, 0.83, 0.25, 0.068}};
constexpr std::array kLooks = {kOnScreen, kOnPaper, kOnSlide};

// Of a stage's name, turned by kSlantDeg, to the next: 1.43 lines of text, in parts of the panel.
constexpr double kSlantDeg = 35;
inline double label_gap(const Look& look) {
  constexpr double kLines = 1.43, kPi = 3.14159265358979;
  const double panel_px = (look.time.right - look.time.left) * look.width_px;
  return kLines * look.label_px / std::sin(kSlantDeg * kPi / 180) / panel_px;
}

// gnuplot's command for the size, the fonts and the format. A PNG has twice the pixels.
std::string terminal_of(const Look& look, PictureFormat format);

}  // namespace stylet::app
