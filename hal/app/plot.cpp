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
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hal/app/commands.h"
#include "hal/base/output_file.h"
#include "hal/base/vector.h"
#include "hal/record/recording.h"
#include "hal/score/phases.h"

extern char** environ;

namespace stylet::app {
namespace {

constexpr std::size_t kMaxPoints = 3000;  // more than a printed page can show

// The colours are those of hal/palette.csv.
struct Cause {
  const char* name;
  const char* colour;
  Vec3 ForceByCause::*force;
};
constexpr std::array kCauses = {Cause{"stiffness", "#0072b2", &ForceByCause::stiffness_n},
                                Cause{"cutting", "#c24e00", &ForceByCause::cutting_n},
                                Cause{"friction", "#009e73", &ForceByCause::friction_n},
                                Cause{"clamping", "#a8478a", &ForceByCause::clamping_n},
                                Cause{"obstacle", "#5c3d00", &ForceByCause::obstacle_n}};

struct Curve {
  std::vector<hal::TrackPoint> track;
  std::vector<std::array<float, kCauses.size()>> causes;  // axial, same sign as the track
  std::vector<hal::PhaseRow> phases;
  double period_s = 1e-3;
};

Curve read_curve(const hal::RecordingReader& recording, std::uint32_t needle) {
  const hal::RecordingInfo& info = recording.info();
  const hal::Course& course = info.course[needle];
  const Vec3 d = course.direction;
  Curve curve;
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
  curve.phases = hal::find_phases(curve.track, curve.period_s, info.config.needle[needle].unit_m);
  return curve;
}

// Every n-th tick, and the ticks around each change of stage, where curves have corners.
std::vector<std::size_t> shown_points(const Curve& curve) {
  std::vector<std::size_t> shown;
  const std::size_t stride = curve.track.size() / kMaxPoints + 1;
  for (std::size_t i = 0; i < curve.track.size(); i += stride) shown.push_back(i);
  std::size_t start = 0;
  for (const hal::PhaseRow& row : curve.phases) {
    if (start > 0) shown.push_back(start - 1);
    shown.push_back(start);
    start += row.end_tick - row.start_tick;
  }
  shown.push_back(curve.track.size() - 1);
  std::sort(shown.begin(), shown.end());
  shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
  return shown;
}

bool felt(const Curve& curve, std::size_t cause) {
  return std::any_of(curve.causes.begin(), curve.causes.end(),
                     [cause](const auto& f) { return std::fabs(f[cause]) > 1e-3F; });
}

const hal::PhaseRow& phase_of(const Curve& curve, std::uint64_t tick) {
  for (const hal::PhaseRow& row : curve.phases) {
    if (tick < row.end_tick) return row;
  }
  return curve.phases.back();
}

// Data blocks: "time force" of the total and of the causes, "travel force" by stage.
std::string data_blocks(const Curve& curve) {
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
    const hal::Stage stage = phase_of(curve, p.tick).stage;
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

// Shades the stages and names each in the margin above, slanted. The name of a stage too short for
// it is moved on.
std::string phase_shades(const Curve& curve, int font_size) {
  constexpr double kLabelGap = 0.035;  // of the width: needed by a slanted line of text
  const double gap_s = kLabelGap * static_cast<double>(curve.track.back().tick) * curve.period_s;
  double label_s = -gap_s;
  constexpr std::array kTints = {"#F2F2F2", "#E4EDF6", "#FBE3D6", "#EAF3E6",
                                 "#FFF6D6", "#F3E6F1", "#F2F2F2"};
  std::string script;
  int object = 1;
  for (const hal::PhaseRow& row : curve.phases) {
    const double from = static_cast<double>(row.start_tick) * curve.period_s;
    const double to = static_cast<double>(row.end_tick) * curve.period_s;
    script += fmt::format(
        "set object {} rectangle from first {:.6g}, graph 0 to first {:.6g}, graph 1 behind "
        "fillcolor rgb '{}' fillstyle solid 1 noborder\n",
        object, from, to, kTints[static_cast<std::size_t>(row.stage)]);
    label_s = std::max(label_s + gap_s, 0.5 * (from + to));
    script += fmt::format(
        "set label {} '{}' at first {:.6g}, graph 1.02 left rotate by 35 "
        "font ',{}' textcolor rgb '#333333'\n",
        object, hal::stage_name(row.stage), label_s, font_size);
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

std::string script_of(const Curve& curve, const hal::RecordingInfo& info, std::uint32_t needle,
                      bool svg) {
  std::string script =
      svg ? "set terminal svg size 900,820 font 'DejaVu Sans,13' background rgb 'white'\n"
          : "set terminal pngcairo size 1800,1640 fontscale 1 font 'DejaVu Sans,26' linewidth 2\n";
  script += data_blocks(curve);
  script +=
      "set encoding utf8\nset multiplot\nset border 3 linewidth 1\nset tics nomirror out\n"
      "set grid ytics linewidth 0.5 linecolor rgb '#CCCCCC'\nset lmargin screen 0.10\n"
      "set rmargin screen 0.97\nset xzeroaxis linewidth 0.8 linecolor rgb '#777777'\n"
      "set ylabel 'Axial force on the needle / N' offset 0.5\n";
  script +=
      "set tmargin screen 0.90\nset bmargin screen 0.56\nset xlabel 'Time / s'\n"
      "set key inside top right opaque box linewidth 0.5 spacing 1.1 Left reverse\n"
      "set offsets graph 0, graph 0, graph 0.06, graph 0.04\n";
  script += phase_shades(curve, svg ? 11 : 22);
  script += fmt::format("set xrange [0:{:.6g}]\n",
                        static_cast<double>(curve.track.back().tick) * curve.period_s);
  std::string plot =
      "plot $total using 1:2 with lines linewidth 2.4 linecolor rgb '#1d2733' "
      "title 'total'";
  for (std::size_t c = 0; c < kCauses.size(); ++c) {
    if (!felt(curve, c)) continue;
    plot += fmt::format(
        ", $causes using 1:{} with lines linewidth 1.6 linecolor rgb '{}' "
        "title '{}'",
        c + 2, kCauses[c].colour, kCauses[c].name);
  }
  script += plot + "\n";
  for (std::size_t i = 1; i <= curve.phases.size(); ++i) {
    script += fmt::format("unset object {0}\nunset label {0}\n", i);
  }
  script += fmt::format(
      "set label 99 '{}, {} mode, {:.2f} mm needle' at screen 0.97, screen 0.015 right font ',{}' "
      "noenhanced textcolor rgb '#555555'\n",
      legend_text(info.organ_name), info.config.mode == Mode::kPaper ? "paper" : "physical",
      2e3 * static_cast<double>(info.config.needle[needle].outer_radius_m), svg ? 10 : 20);
  script +=
      "set tmargin screen 0.47\nset bmargin screen 0.125\nset autoscale x\n"
      "set xlabel 'Tip travel beyond the first contact / mm'\nset key top left\n"
      "plot $in using 1:2 with lines linewidth 2.2 linecolor rgb '#332288' title 'way in', "
      "$hold using 1:2 with lines linewidth 2.2 linecolor rgb '#8f8f2b' title 'hold', "
      "$out using 1:2 with lines linewidth 2.2 linecolor rgb '#cc6677' title 'way out'\n";
  return script;
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
std::string gnuplot_picture(const std::string& script, bool svg) {
  const int file = memfd_create("picture", MFD_CLOEXEC);
  if (file < 0) throw std::runtime_error("gnuplot: no memory for its picture");
  std::string picture;
  try {
    run_gnuplot(script, file);
    picture.resize(static_cast<std::size_t>(lseek(file, 0, SEEK_END)));
    const ssize_t size = pread(file, picture.data(), picture.size(), 0);
    const std::string_view end = svg ? "</svg>" : "IEND";
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

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

int plot(const PlotOptions& options) {
  const bool svg = ends_with(options.output, ".svg");
  if (!svg && !ends_with(options.output, ".png")) {
    throw std::runtime_error(
        fmt::format("{}: expected a name that ends in .svg or .png", options.output));
  }
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
  const std::string script =
      script_of(read_curve(recording, options.needle), recording.info(), options.needle, svg);
  hal::write_output(output, gnuplot_picture(script, svg));
  fmt::print("{}\n", options.output);
  return kExitOk;
}

}  // namespace stylet::app
