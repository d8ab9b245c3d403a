// SPDX-License-Identifier: Apache-2.0
// The program stylet: command line in, one line of error or a report out.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "hal/app/commands.h"
#include "hal/app/own_program.h"
#include "hal/app/plot_look.h"
#include "hal/app/scene_name.h"
#include "hal/base/side_process.h"
#include "hal/console/limits.h"
#include "hal/device/devices.h"
#include "hal/device/driver_call.h"
#include "hal/device/drivers/haply.h"
#include "hal/publish/igtl.h"
#include "stylet/command_texts.h"
#include "stylet/limits.h"

namespace stylet::app {
namespace {

CLI::Option* add_json(CLI::App& command, bool& json, const char* what) {
  return command.add_flag("--json", json,
                          fmt::format("Print {} on standard output, and nothing else there", what));
}

CLI::Option* add_organ(CLI::App& command, std::string& organ, const char* instead_of) {
  return command.add_option("--organ", organ, fmt::format("Organ file, instead of {}", instead_of))
      ->type_name("FILE");
}

CLI::Option* add_recording(CLI::App& command, std::string& recording) {
  return command.add_option("recording", recording, "Recording that stylet run --record wrote")
      ->type_name("FILE")
      ->required();
}

CLI::Option* add_serving(CLI::App& command, ServeOptions& options) {
  return command
      .add_option("--listen", options.listen,
                  "Address of this machine at which other machines can open the page, with a token "
                  "that is printed (default: only this machine can)")
      ->type_name("ADDRESS")
      ->check(CLI::ValidIPV4);
}

void add_igtl(CLI::App& run, IgtlOptions& options) {
  options.port = hal::kIgtlPort;
  CLI::Option* igtl =
      run.add_flag(fmt::format("--igtl{{{}}}", hal::kIgtlPort), options.port,
                   fmt::format("Let OpenIGTLink clients such as 3D Slicer follow the run, on port "
                               "{} of this machine; --igtl=PORT takes another, 0 any that is free",
                               hal::kIgtlPort))
          ->type_name("PORT")
          ->check(cli::between(0, 65535));
  run.add_option("--igtl-listen", options.listen,
                 "Address of this machine at which clients on other machines can connect (default: "
                 "only clients on this machine can)")
      ->type_name("ADDRESS")
      ->check(CLI::ValidIPV4)
      ->needs(igtl);
}

void add_run(CLI::App& program, RunOptions& options) {
  CLI::App& run = *program.add_subcommand("run", "Run a scene on the real-time loop");
  run.footer(
      "Examples:\n"
      "  stylet run lumbar-puncture\n"
      "  stylet run fig09-force-curve.toml --organ liver.organ --record out.h5\n"
      "  stylet run fig09-force-curve.toml --organ liver.organ --console\n"
      "With --console the page starts each attempt, also of other scenes in the same folder;\n"
      "--record out.h5 writes them to out-1.h5, out-2.h5 ...");
  run.add_option("scene", options.scene, "Scene file (TOML), or a name that stylet scenes lists")
      ->type_name("FILE")
      ->required();
  add_organ(run, options.organ, "the scene's");
  run.add_option("--record", options.record,
                 "Recording to write (HDF5); if the file exists, NAME-2.h5 and so on")
      ->type_name("FILE");
  run.add_flag("--force", options.force, "Let --record overwrite a file that exists");
  run.add_option("--flight", options.flight,
                 "Recording of the second before a fault: NAME-1.h5 for the first fault, NAME-2.h5 "
                 "for the next, and so on")
      ->type_name("FILE")
      ->capture_default_str();
  run.add_option("--mode", options.mode,
                 "Rules of the simulation, instead of the scene's: measured laws, or the paper's")
      ->type_name("MODE")
      ->check(CLI::IsMember({"physical", "paper"}));
  run.add_option("--duration-s", options.duration_s,
                 "Simulated time (default: until the hand's script ends)")
      ->type_name("SECONDS")
      ->check(cli::between(1e-3, 86400.0));
  run.add_option("--device", options.devices,
                 "Device instead of the scene's, such as hd: (stylet devices lists them); "
                 "once for each needle")
      ->type_name("URI")
      ->allow_extra_args(false);
  run.add_option("--threads", options.threads,
                 "Threads of the tissue step, instead of the scene's; results are the same, bit "
                 "for bit, with any number")
      ->type_name("NUMBER")
      ->check(cli::between(1U, kMaxHelpers + 1));
  run.add_flag(
      "--fast", options.fast,
      "Do not wait for the clock: the same results, bit for bit, as fast as the machine can");
  add_json(run, options.json, "one JSON object");
  run.add_flag("--allow-non-rt", options.allow_non_rt,
               "Run, with a warning, even if the machine refuses real-time rights");
  options.serve.port = console::kDefaultPort;
  CLI::Option* console =
      run.add_flag(fmt::format("--console{{{}}}", console::kDefaultPort), options.serve.port,
                   fmt::format("Serve a page that shows and controls the run, on port {} of this "
                               "machine; --console=PORT takes another, 0 any that is free",
                               console::kDefaultPort))
          ->type_name("PORT")
          ->check(cli::between(0, 65535))
          ->excludes("--json");
  add_serving(run, options.serve)->needs(console);
  add_igtl(run, options.igtl);
}

void add_playback(CLI::App& program, PlaybackOptions& options) {
  CLI::App& play =
      *program.add_subcommand("console", "Play back a recording on a page in a browser");
  play.footer("Example: stylet console out.h5");
  add_recording(play, options.recording);
  add_organ(play, options.organ, "the one that the recording names");
  options.serve.port = console::kDefaultPort;
  play.add_option("--port", options.serve.port, "Port of the page; 0: any that is free")
      ->type_name("PORT")
      ->capture_default_str();
  add_serving(play, options.serve);
}

void add_replay(CLI::App& program, ReplayOptions& options) {
  CLI::App& replay = *program.add_subcommand(
      "replay", "Repeat a recording from its inputs, and compare the results bit for bit");
  replay.footer(
      "Example: stylet replay out.h5\nExit codes: 0 the same results, bit for bit; 3 other "
      "results");
  add_recording(replay, options.recording);
  add_organ(replay, options.organ, "the one that the recording names");
  add_json(replay, options.json, "one JSON object");
}

void add_plot(CLI::App& program, PlotOptions& options) {
  CLI::App& plot = *program.add_subcommand("plot", "Draw the force curves of a recording");
  plot.footer(
      "Examples:\n  stylet plot out.h5 -o force.svg\n"
      "  stylet plot out.h5 --style paper -o force.pdf");
  add_recording(plot, options.recording);
  plot.add_option("-o,--output", options.output, "Picture to write (.svg, .pdf or .png)")
      ->type_name("FILE")
      ->required();
  std::vector<std::string> styles;
  for (const Look& look : kLooks) styles.emplace_back(look.name);
  plot.add_option("--style", options.style,
                  "For the screen, a column of a paper (85 mm), or a slide (16:9)")
      ->type_name("STYLE")
      ->check(CLI::IsMember(styles))
      ->capture_default_str();
  plot.add_option("--needle", options.needle, "Which of several needles, counted from 0")
      ->type_name("NUMBER")
      ->capture_default_str();
}

void add_score(CLI::App& program, ScoreOptions& options) {
  CLI::App& score =
      *program.add_subcommand("score", "Score recorded attempts, and compare them side by side");
  score.footer(
      "Examples:\n"
      "  stylet score out.h5\n"
      "  stylet score monday.h5 tuesday.h5 --scene liver-biopsy.toml");
  score.add_option("recordings", options.recordings, "Recordings that stylet run --record wrote")
      ->type_name("FILE")
      ->required();
  score
      .add_option("--scene", options.scene, "Scene whose targets count, instead of the recording's")
      ->type_name("FILE");
  add_organ(score, options.organ, "the one that the recording names");
  add_json(score, options.json, "one JSON array");
}

void add_doctor(CLI::App& program, DoctorOptions& options) {
  CLI::App& doctor =
      *program.add_subcommand("doctor", "Check whether this machine is fit for the loop");
  doctor.footer(
      "Examples:\n  stylet doctor\n  stylet doctor --device udp:7755\n"
      "  stylet doctor --measure 60 --replay out.h5\nExit codes: 0 "
      "ready, 3 degraded (warnings, or something could not be read), 4 not suitable");
  auto* device = doctor
                     .add_option("--device", options.devices,
                                 "Device to open and to watch for a second, without force: does it "
                                 "send, how often, how late, what is lost; may be given several "
                                 "times")
                     ->type_name("URI")
                     ->allow_extra_args(false);
  auto* scene =
      doctor.add_option("--scene", options.scene, "Scene whose devices are watched in this way")
          ->type_name("SCENE");
  auto* measure = doctor
                      .add_option("--measure", options.measure_s,
                                  "Measure for this time how late a thread wakes up")
                      ->type_name("SECONDS")
                      ->check(cli::between(0.1, 86400.0));
  auto* replay =
      doctor
          .add_option("--replay", options.recording,
                      "Recording whose ticks run meanwhile, to measure how long they take")
          ->type_name("FILE")
          ->needs(measure);
  add_organ(doctor, options.organ, "the one that the recording names")->needs(replay);
  doctor
      .add_option("--cpu", options.cpu,
                  "Processor to look at, like loop.cpu of a scene (default: the one that the loop "
                  "would choose)")
      ->type_name("NUMBER")
      ->check(cli::between(0, 1023));
  doctor
      .add_option("--priority", options.priority,
                  "Priority to test, like loop.rt_priority of a scene")
      ->type_name("NUMBER")
      ->check(cli::between(1, 99))
      ->capture_default_str();
  doctor
      .add_option("--root", options.root,
                  "Folder with a copy of another machine's /proc and /sys, to look at instead")
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory)
      ->excludes(measure)
      ->excludes(device)
      ->excludes(scene);
  add_json(doctor, options.json, "one JSON object");
}

// Returns the subcommand that opens a device.
CLI::App& add_devices(CLI::App& program, DevicesOptions& options, ProbeOptions& probed) {
  CLI::App& devices = *program.add_subcommand(
      "devices", "List which devices are ready here, and what is missing for the others");
  devices.footer(
      "Examples:\n  stylet devices\n  stylet devices probe hd: --push -o touch.json\n"
      "A device is \"unknown\" (with --json: ready is null) if it shows itself only when it is\n"
      "opened, as a program in a network does: stylet devices probe URI waits up to 10 s for it.");
  add_json(devices, options.json, "one JSON array");
  devices
      .add_option(
          "--root", options.root,
          "Folder with a copy of another machine's /proc, /sys and /dev, to look at instead")
      ->type_name("FOLDER")
      ->check(CLI::ExistingDirectory);
  CLI::App& probe =
      *devices.add_subcommand("probe", "Open a device and measure what it really does");
  probe.footer("Example: stylet devices probe hd: --push -o touch.json");
  probe.add_option("uri", probed.uri, "Device as in a scene: hd:, dhd:0, udp:7755 ...")
      ->type_name("URI")
      ->required();
  probe.add_option("-o,--output", probed.output, "File to write what was measured to (JSON)")
      ->type_name("FILE");
  probe.add_option("--seconds", probed.seconds, "Time to watch the device without force")
      ->type_name("SECONDS")
      ->check(cli::between(0.1, 3600.0))
      ->capture_default_str();
  probe.add_flag("--push", probed.push, "After that, push along its axes, with at most 1 N");
  add_json(probe, probed.json, "what was measured as one JSON object");
  return probe;
}

void add_station(CLI::App& program, StationOptions& options) {
  CLI::App& station = *program.add_subcommand(
      "station", "Let a device of this machine hold a needle that another machine simulates");
  station.footer(
      "Example: stylet station hd: 192.168.0.5:7755\nThe other machine, here 192.168.0.5, runs: "
      "stylet run SCENE --device udp:0.0.0.0:7755");
  station.add_option("uri", options.uri, "Device of this machine: hd:, dhd:0 ...")
      ->type_name("URI")
      ->required();
  station.add_option("to", options.to, "The machine that simulates the tissue")
      ->type_name("ADDRESS:PORT")
      ->required();
  station
      .add_option("--duration-s", options.seconds,
                  "Time after which to end (default: when Ctrl-C is pressed)")
      ->type_name("SECONDS")
      ->check(cli::between(1e-3, 86400.0));
  station
      .add_option("--acknowledge-button", options.acknowledge_button,
                  "Button, counted from 0, that acknowledges a latched fault, as Enter on this "
                  "keyboard does")
      ->type_name("NUMBER")
      ->check(cli::between(0, 31));
  station
      .add_option("--dead-man-button", options.dead_man_button,
                  "Button, counted from 0, that must be held down for any force")
      ->type_name("NUMBER")
      ->check(cli::between(0, 31));
}

// The benchmarks are a program of their own, in the same folder as this one.
[[noreturn]] void bench(char** arguments) {
  const auto program = own_program().replace_filename("stylet-bench");
  execv(program.c_str(), arguments);
  throw std::runtime_error(
      fmt::format("{}: {}: expected the benchmarks, which are built with the "
                  "tests",
                  program.string(), std::strerror(errno)));
}

// Only for the help; main starts the benchmarks before options are read here.
void add_bench(CLI::App& program) {
  program.add_subcommand(
      "bench", "Measure how long a tick takes on this machine (options: stylet bench --help)");
}

constexpr const char* kFooter =
    "Examples:\n"
    "  stylet scenes\n"
    "  stylet run lumbar-puncture\n"
    "  stylet run fig09-force-curve.toml --organ liver.organ --record out.h5\n"
    "  stylet plot out.h5 -o force.svg\n"
    "  stylet run fig09-force-curve.toml --organ liver.organ --console\n"
    "  stylet console out.h5\n"
    "  stylet replay out.h5\n"
    "  stylet score out.h5\n"
    "  stylet bench liver.organ\n"
    "  stylet doctor --measure 60\n"
    "  stylet devices\n"
    "  stylet station hd: 192.168.0.5:7755\n"
    "Exit codes: 0 done, 1 a file or device was refused, 2 wrong usage, 3 a run that ended with a\n"
    "fault or lost a process, a replay with other results, or a machine with warnings,\n"
    "4 a machine that is not fit for real time";

struct ListOptions {
  bool json = false;
  std::string organ_of;  // empty: all are listed
};

int answer(const ListOptions& asked) {
  return asked.organ_of.empty() ? list_scenes(asked.json) : tell_organ(asked.organ_of);
}

void add_lists(CLI::App& program, ListOptions& scene_list, bool& needles_json) {
  CLI::App& scenes = *program.add_subcommand(
      "scenes", "List the scenes that come with Stylet, to run by their name");
  CLI::Option* const json = add_json(scenes, scene_list.json, "one JSON array");
  scenes
      .add_option("--organ", scene_list.organ_of,
                  "Print the file of this scene's organ, and make it if it is not there yet")
      ->excludes(json);
  CLI::App& needles = *program.add_subcommand(
      "needles", "List the needles that a scene may name: diameters, material, stiffness and tip");
  add_json(needles, needles_json, "one JSON array");
}

int dispatch(int argc, char** argv) {
  CLI::App program("Haptic needle insertion: runs scenes, repeats and draws their recordings",
                   "stylet");
  program.set_version_flag("--version", STYLET_VERSION);
  cli::add_text_options(program, "stylet " STYLET_VERSION);
  program.require_subcommand(0, 1);
  program.footer(kFooter);
  RunOptions run_options;
  ReplayOptions replay_options;
  PlaybackOptions playback_options;
  PlotOptions plot_options;
  DoctorOptions doctor_options;
  add_run(program, run_options);
  ListOptions scene_list;
  bool needles_json = false;
  add_lists(program, scene_list, needles_json);
  add_playback(program, playback_options);
  add_replay(program, replay_options);
  add_plot(program, plot_options);
  ScoreOptions score_options;
  add_score(program, score_options);
  add_doctor(program, doctor_options);
  DevicesOptions devices_options;
  ProbeOptions probe_options;
  StationOptions station_options;
  const CLI::App& probing = add_devices(program, devices_options, probe_options);
  add_station(program, station_options);
  add_bench(program);
  try {
    cli::refuse_empty_values(program, argc, argv);
    cli::refuse_separate_values(program, argc, argv);
    program.parse(argc, argv);
    if (program.get_subcommands().empty()) {
      throw CLI::RequiredError(
          "A command (run, scenes, needles, console, replay, plot, score, devices, station, "
          "doctor or bench)");
    }
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kExitOk : kExitUsage;
  }
  if (program.got_subcommand("scenes")) return answer(scene_list);
  if (program.got_subcommand("needles")) return list_needles(needles_json);
  if (program.got_subcommand("run")) {
    run_options.scene = scene_file(run_options.scene);
    run_options.igtl.on = program.get_subcommand("run")->count("--igtl") > 0;
    run_options.serve.on = program.get_subcommand("run")->count("--console") > 0;
    return run_options.serve.on ? run_console(run_options) : run(run_options);
  }
  if (program.got_subcommand("console")) return play_back(playback_options);
  if (program.got_subcommand("replay")) return replay_recording(replay_options);
  if (program.got_subcommand("score")) {
    if (!score_options.scene.empty()) score_options.scene = scene_file(score_options.scene);
    return score(score_options);
  }
  if (probing.parsed()) return probe(probe_options);
  if (program.got_subcommand("devices")) return list_devices(devices_options);
  if (program.got_subcommand("station")) return station(station_options);
  if (program.got_subcommand("doctor")) return doctor(doctor_options);
  return plot(plot_options);
}

// Threads that hang in a driver still run: nothing they use may be destroyed.
int leave(int code) {
  if (hal::driver_calls_given_up() == 0) return code;
  std::fflush(nullptr);
  _exit(code == kExitOk ? kExitTrouble : code);
}

}  // namespace
}  // namespace stylet::app

int main(int argc, char** argv) {
  try {
    if (argc > 1 && std::string_view(argv[1]) == "bench") stylet::app::bench(argv + 1);
    if (argc == 3 && std::string_view(argv[1]) == stylet::hal::kBesideCommand) {
      return stylet::app::beside(argv[2]);
    }
    stylet::hal::use_drivers(stylet::hal::drivers_with_haply());
    const int code = stylet::app::dispatch(argc, argv);
    if (std::fflush(stdout) != 0) {
      throw std::runtime_error(fmt::format("standard output: {}", std::strerror(errno)));
    }
    return stylet::app::leave(code);
  } catch (const std::bad_alloc&) {
    (void)std::fputs(
        "stylet: not enough memory: expected a smaller organ or a shorter recording, or a higher "
        "limit (ulimit -v)\n",
        stderr);
  } catch (const std::system_error& error) {
    const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
    (void)std::fprintf(
        stderr, "stylet: %s%s\n", error.what(),
        no_thread ? ": expected memory for one more thread (ulimit -v, ulimit -u)" : "");
  } catch (const std::exception& error) {
    (void)std::fprintf(stderr, "stylet: %s\n", error.what());
  } catch (...) {
    (void)std::fputs("stylet: an exception of unknown type was thrown\n", stderr);
  }
  return stylet::app::leave(stylet::app::kExitRefused);
}
