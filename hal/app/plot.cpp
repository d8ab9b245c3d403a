// SPDX-License-Identifier: Apache-2.0
// Force curves by gnuplot. It reads script and data from standard input and writes the picture to
// standard output: so there is no shell, and no file name that it must read.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hal/app/commands.h"
#include "hal/app/palette.h"
#include "hal/app/plot_look.h"
#include "hal/base/output_file.h"
#include "hal/base/vector.h"
#include "hal/record/recording.h"
#include "hal/score/stages.h"

extern char** environ;

namespace stylet::app {
namespace {

constexpr std::size_t kMaxPoints = 3000;  // more than a printed page can show
constexpr int kPngScale = 2;              // pixels of a PNG for each of the look's

struct Cause {
  const char* name;
  const char* colour;
  Vec3 ForceByCause::*force;
};
constexpr std::array kCauses = {Cause{"stiffness", palette::kStiffness, &ForceByCause::stiffness_n},
                                Cause{"cutting", palette::kCutting, &ForceByCause::cutting_n},
                                Cause{"friction", palette::kFriction, &ForceByCause::friction_n},
                                Cause{"clamping", palette::kClamping, &ForceByCause::clamping_n},
                                Cause{"obstacle", palette::kObstacle, &ForceByCause::obstacle_n}};

struct PlottedCurve {
  std::vector<hal::TrackPoint> track;
  std::vector<std::array<float, kCauses.size()>> causes;  // axial, same sign as the track
  std::vector<hal::StageRow> stages;
  double period_s = 1e-3;
};

PlottedCurve read_curve(const hal::RecordingReader& recording, std::uint32_t needle) {
  const hal::RecordingInfo& info = recording.info();
  const hal::Course& course = info.course[needle];
  const Vec3 d = course.direction;
  PlottedCurve curve;
  curve.period_s = static_cast<double>(info.config.period_s);
  std::vector<hal::TickRecord> block;
  for (std::uint64_t first = 0; first < recording.ticks(); first += block.size()) {
    block.resize(std::min<std::uint64_t>(4096, recording.ticks() - first));
    recording.read(first, block, needle);
    for (const hal::TickRecord& record : block) {
      curve.track.push_back(hal::track_point(record, course));
      auto& causes = curve.causes.emplace_back();
      for (std::size_t c = 0; c < kCauses.size(); ++c) {
        causes[c] = -hal::dot(record.output.cause.*kCauses[c].force, d);
      }
    }
  }
  curve.stages = hal::find_stages(curve.track, curve.period_s, info.config.needle[needle].unit_m);
  return curve;
}

// Every n-th tick, and the ticks around each change of stage, where curves have corners.
std::vector<std::size_t> shown_points(const PlottedCurve& curve) {
  std::vector<std::size_t> shown;
  const std::size_t stride = curve.track.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < curve.track.size(); i += stride) shown.push_back(i);
  std::size_t start = 0;
  for (const hal::StageRow& row : curve.stages) {
    if (start > 0) shown.push_back(start - 1);
    shown.push_back(start);
    start += row.end_tick - row.start_tick;
  }
  shown.push_back(curve.track.size() - 1);
  std::sort(shown.begin(), shown.end());
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  return shown;
}

bool felt(const PlottedCurve& curve, std::size_t cause) {
  return std::any_of(curve.causes.begin(), curve.causes.end(),
                     [cause](const auto& f) { return std::fabs(f[cause]) > 1e-3F; });
}

const hal::StageRow& stage_row_of(const PlottedCurve& curve, std::uint64_t tick) {
  for (const hal::StageRow& row : curve.stages) {
    if (tick < row.end_tick) return row;
  }
  return curve.stages.back();
}

// Data blocks: "time force" of the total and of the causes, "travel force" by stage.
std::string data_blocks(const PlottedCurve& curve) {
  std::string total = "$total << EOD\n", causes = "$causes << EOD\n";
  std::string in = "$in << EOD\n", hold = "$hold << EOD\n", out = "$out << EOD\n";
  std::string* last_block = &in;
  std::string last_row;
  for (const std::size_t i : shown_points(curve)) {
    const hal::TrackPoint& p = curve.track[i];
    const double time_s = static_cast<double>(p.tick) * curve.period_s;
    const double travel_mm = static_cast<double>(p.travel_m) * 1e3;
    const double force_n = static_cast<double>(p.axial_n);
    total += fmt::format("{:.6g} {:.6g}\n", time_s, force_n);
    causes += fmt::format("{:.6g}", time_s);
    for (const float f : curve.causes[i]) causes += fmt::format(" {:.6g}", static_cast<double>(f));
    causes += '\n';
    const hal::Stage stage = stage_row_of(curve, p.tick).stage;
    const bool back = stage == hal::Stage::kRetraction || stage == hal::Stage::kExit;
    std::string& by_depth = stage == hal::Stage::kHold ? hold : back ? out : in;
    if (&by_depth != last_block) by_depth += last_row;  // no gap where the colour changes
    last_block = &by_depth;
    last_row = fmt::format("{:.6g} {:.6g}\n", travel_mm, force_n);
    by_depth += last_row;
  }
  const std::string end = "EOD\n";
  const auto some = [&end](const std::string& block) {
    return block +
           (block.back() == '\n' && block.find('\n') + 1 == block.size() ? "NaN NaN\n" : "") + end;
  };
  return some(total) + some(causes) + some(in) + some(hold) + some(out);
}

// Shows the stages and names each in the margin above, slanted. The name of a stage too short for
// it is moved on.
std::string stage_shades(const PlottedCurve& curve, const Look& look, int scale) {
  const double gap_s =
      label_gap(look) * static_cast<double>(curve.track.back().tick) * curve.period_s;
  double label_s = -gap_s;
  constexpr std::array kTints = {"#F2F2F2", "#E4EDF6", "#FBE3D6", "#EAF3E6",
                                 "#FFF6D6", "#F3E6F1", "#F2F2F2"};
  std::string script;
  int object = 1;
  for (const hal::StageRow& row : curve.stages) {
    const double from = static_cast<double>(row.start_tick) * curve.period_s;
    const double to = static_cast<double>(row.end_tick) * curve.period_s;
    if (look.shades) {
      script += fmt::format(
          "set object {} rectangle from first {:.6g}, graph 0 to first {:.6g}, graph 1 behind "
          "fillcolor rgb '{}' fillstyle solid 1 noborder\n",
          object, from, to, kTints[static_cast<std::size_t>(row.stage)]);
    } else {
      script += fmt::format(
          "set arrow {} from first {:.6g}, graph 0 to first {:.6g}, graph 1 nohead back "
          "linewidth {} linecolor rgb '#BBBBBB'\n",
          object, from, from, look.axis_width);
    }
    label_s = std::max(label_s + gap_s, 0.5 * (from + to));
    script += fmt::format(
        "set label {} '{}' at first {:.6g}, graph 1.02 left rotate by {} "
        "font ',{}' textcolor rgb '#333333'\n",
        object, hal::stage_name(row.stage), label_s, kSlantDeg, scale * look.label_px);
    ++object;
  }
  return script;
}

std::string legend_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    safe += (c >= ' ' && c <= '~' && c != '\'' && c != '\\' && c != '"') ? c : '_';
  }
  return safe;
}

std::string margins(const Panel& panel) {
  return fmt::format(
      "set lmargin screen {}\nset rmargin screen {}\nset tmargin screen {}\nset bmargin screen "
      "{}\n",
      panel.left, panel.right, panel.top, panel.bottom);
}

// Where the names of a panel's lines stand; `inside`: where in it, if they do.
std::string key_of(const Look& look, const Panel& panel, const char* inside) {
  if (panel.key > 0) {
    return fmt::format(
        "set key at screen {}, screen {} center center horizontal maxrows 2 nobox samplen 1.5\n",
        0.5 * (panel.left + panel.right), panel.key);
  }
  return fmt::format("set key inside {} opaque box linewidth {} spacing 1.1 Left reverse\n", inside,
                     0.5 * look.axis_width);
}

std::string causes_over_time(const PlottedCurve& curve, const Look& look) {
  std::string plot =
      fmt::format("plot $total using 1:2 with lines linewidth {} linecolor rgb '{}' title 'total'",
                  look.total_width, palette::kTotal);
  for (std::size_t c = 0; c < kCauses.size(); ++c) {
    if (!felt(curve, c)) continue;
    plot +=
        fmt::format(", $causes using 1:{} with lines linewidth {} linecolor rgb '{}' title '{}'",
                    c + 2, look.cause_width, kCauses[c].colour, kCauses[c].name);
  }
  return plot + "\n";
}

std::string force_over_depth(const Look& look) {
  return fmt::format(
      "set autoscale x\nset xlabel 'Tip travel beyond the first contact / mm'\n"
      "plot $in using 1:2 with lines linewidth {0} linecolor rgb '{1}' title 'way in', "
      "$hold using 1:2 with lines linewidth {0} linecolor rgb '{2}' title 'hold', "
      "$out using 1:2 with lines linewidth {0} linecolor rgb '{3}' title 'way out'\n",
      look.depth_width, palette::kWayIn, palette::kHold, palette::kWayOut);
}

std::string script_of(const PlottedCurve& curve, const hal::RecordingInfo& info,
                      std::uint32_t needle, const Look& look, PictureFormat format) {
  const int scale = format == PictureFormat::kPng ? kPngScale : 1;
  std::string script = terminal_of(look, format) + data_blocks(curve);
  script += fmt::format(
      "set encoding utf8\nset multiplot\nset border 3 linewidth {0}\nset tics nomirror out\n"
      "set grid ytics linewidth {1} linecolor rgb '#CCCCCC'\n"
      "set xzeroaxis linewidth {2} linecolor rgb '#777777'\n"
      "set ylabel 'Axial force on the needle / N' offset 0.5\nset xlabel 'Time / s'\n"
      "set offsets graph 0, graph 0, graph 0.06, graph 0.04\n",
      look.axis_width, 0.5 * look.axis_width, 0.8 * look.axis_width);
  script +=
      key_of(look, look.time, "top right") + margins(look.time) + stage_shades(curve, look, scale);
  script += fmt::format("set xrange [0:{:.6g}]\n",
                        static_cast<double>(curve.track.back().tick) * curve.period_s);
  script += causes_over_time(curve, look);
  for (std::size_t i = 1; i <= curve.stages.size(); ++i) {
    script += fmt::format("unset {0} {1}\nunset label {1}\n", look.shades ? "object" : "arrow", i);
  }
  script += fmt::format(
      "set label 99 '{}, {} mode, {:.2f} mm needle' at screen {}, screen 0.015 right font ',{}' "
      "noenhanced textcolor rgb '#555555'\n",
      legend_text(info.organ_name), info.config.mode == Mode::kPaper ? "paper" : "physical",
      2e3 * static_cast<double>(info.config.needle[needle].outer_radius_m), look.depth.right,
      scale * look.note_px);
  return script + key_of(look, look.depth, "top left") + margins(look.depth) +
         force_over_depth(look);
}

// Runs gnuplot with `script` as its input and `output_fd` as its output.
void run_gnuplot(const std::string& script, int output_fd) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("gnuplot: no pipe to it");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output_fd, STDOUT_FILENO);
  std::string name = "gnuplot", plain = "--default-settings";  // ignores the user's own settings
  char* arguments[] = {name.data(), plain.data(), nullptr};
  setenv("LC_ALL", "C.UTF-8", 1);  // else it complains about characters that it never draws
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  if (error != 0) {
    close(ends[1]);
    throw std::runtime_error(
        fmt::format("gnuplot: {}: expected the program of the package "
                    "gnuplot-nox",
                    std::strerror(error)));
  }
  signal(SIGPIPE, SIG_IGN);  // if gnuplot dies, its exit status tells
  for (std::size_t done = 0; done < script.size();) {
    const ssize_t part = write(ends[1], script.data() + done, script.size() - done);
    if (part < 0 && errno != EINTR) break;
    if (part > 0) done += static_cast<std::size_t>(part);
  }
  close(ends[1]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw std::runtime_error("gnuplot: failed; its own message is above");
  }
}

// Through memory: gnuplot does not report what it could not write.
std::string gnuplot_picture(const std::string& script, PictureFormat format) {
  const int file = memfd_create("picture", MFD_CLOEXEC);
  if (file < 0) throw std::runtime_error("gnuplot: no memory for its picture");
  std::string picture;
  try {
    run_gnuplot(script, file);
    picture.resize(static_cast<std::size_t>(lseek(file, 0, SEEK_END)));
    const ssize_t size = pread(file, picture.data(), picture.size(), 0);
    const std::string_view end = format == PictureFormat::kSvg   ? "</svg>"
                                 : format == PictureFormat::kPng ? "IEND"
                                                                 : "%%EOF";
    if (size < 0 || picture.find(end, picture.size() - std::min<std::size_t>(20, picture.size())) ==
                        std::string::npos) {
      throw std::runtime_error("gnuplot: its picture is incomplete: is memory full?");
    }
  } catch (...) {
    close(file);
    throw;
  }
  close(file);
  return picture;
}

PictureFormat format_of(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension();
  if (ending == ".svg") return PictureFormat::kSvg;
  if (ending == ".png") return PictureFormat::kPng;
  if (ending == ".pdf") return PictureFormat::kPdf;
  throw std::runtime_error(
      fmt::format("{}: expected a name that ends in .svg, .pdf or .png", name));
}

}  // namespace

std::string terminal_of(const Look& look, PictureFormat format) {
  constexpr double kPxPerInch = 96, kPointsPerInch = 72;
  switch (format) {
    case PictureFormat::kSvg:
      return fmt::format(
          "set terminal svg size {},{} font 'DejaVu Sans,{}' background rgb 'white'\n",
          look.width_px, look.height_px, look.font_px);
    case PictureFormat::kPng:
      return fmt::format(
          "set terminal pngcairo size {},{} fontscale 1 font 'DejaVu Sans,{}' linewidth {}\n",
          kPngScale * look.width_px, kPngScale * look.height_px, kPngScale * look.font_px,
          kPngScale);
    case PictureFormat::kPdf:
      break;
  }
  return fmt::format(
      "set terminal pdfcairo size {:.4f}in,{:.4f}in fontscale {:.4f} font 'DejaVu Sans,{}' "
      "linewidth 1 background rgb 'white'\n",
      look.width_px / kPxPerInch, look.height_px / kPxPerInch, kPointsPerInch / kPxPerInch,
      look.font_px);
}

int plot(const PlotOptions& options) {
  const PictureFormat format = format_of(options.output);
  const auto look = std::ranges::find(kLooks, options.style, &Look::name);
  const std::string output = hal::checked_output(options.output, std::array{options.recording});
  const hal::RecordingReader recording(options.recording);
  if (recording.ticks() == 0) {
    throw hal::RecordingError(fmt::format("{}: ticks: 0: nothing to draw", options.recording));
  }
  if (const std::uint32_t needles = recording.info().config.needle_count;
      options.needle >= needles) {
    throw hal::RecordingError(fmt::format("{}: needle {}: expected 0 to {}", options.recording,
                                          options.needle, needles - 1));
  }
  const std::string script = script_of(read_curve(recording, options.needle), recording.info(),
                                       options.needle, *look, format);
  hal::write_output(output, gnuplot_picture(script, format));
  fmt::print("{}\n", options.output);
  return kExitOk;
}

}  // namespace stylet::app
