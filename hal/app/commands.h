// SPDX-License-Identifier: Apache-2.0
// The program's subcommands: options in, exit code out. A user's mistake is an exception whose text
// is the one line that main prints.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stylet::app {

// Meaning of the program's exit code.
enum ExitCode : int {
  kExitOk = 0,
  kExitRefused = 1,    // scene, organ, recording or host file: not as it should be
  kExitUsage = 2,      // command line
  kExitTrouble = 3,    // run: a guard fault or lost records; replay: other bits; doctor: warnings
  kExitHostUnfit = 4,  // the machine does not grant what the real-time loop needs
};

// Where the console listens.
struct ServeOptions {
  bool on = false;
  std::uint16_t port = 0;  // 0: any free port
  std::string listen;      // empty: loopback, without a token
};

// Where OpenIGTLink clients can reach the run.
struct IgtlOptions {
  bool on = false;
  std::uint16_t port = 0;
  std::string listen = "127.0.0.1";
};

struct RunOptions {
  std::string scene;
  std::string organ;   // instead of the scene's
  std::string record;  // empty: no recording
  std::string flight = "stylet-fault.h5";
  std::string mode;                  // empty: the scene's
  double duration_s = 0;             // 0: as long as the hand's script
  std::vector<std::string> devices;  // instead of the scene's, in the order of the needles
  std::uint32_t threads = 0;         // 0: the scene's
  bool fast = false;
  bool json = false;
  bool allow_non_rt = false;
  bool force = false;  // overwrite an existing recording
  ServeOptions serve;  // the console, if `on`
  IgtlOptions igtl;
};
int run(const RunOptions& options);

// `run` with a console: one attempt after another, as the page asks.
int run_console(const RunOptions& options);

struct PlaybackOptions {
  std::string recording;
  std::string organ;  // instead of the recorded path
  ServeOptions serve;
};
// Shows a recording on the console's page.
int play_back(const PlaybackOptions& options);

struct ReplayOptions {
  std::string recording;
  std::string organ;
  bool json = false;
};
int replay_recording(const ReplayOptions& options);

struct PlotOptions {
  std::string recording;
  std::string output;             // .svg, .pdf or .png
  std::string style = "console";  // a name of plot_look.h
  std::uint32_t needle = 0;
};
int plot(const PlotOptions& options);

struct ScoreOptions {
  std::vector<std::string> recordings;
  std::string scene;  // its targets are used instead of the recorded ones
  std::string organ;  // instead of the recorded path, for the names of its layers
  bool json = false;
};
int score(const ScoreOptions& options);

struct DoctorOptions {
  std::string root = "/";  // or the root of a captured tree
  int cpu = -1;            // -1: as the loop would choose
  int priority = 80;
  double measure_s = 0;              // 0: only look, do not measure
  std::string recording;             // its ticks are the body that is measured
  std::string organ;                 // instead of the recording's
  std::vector<std::string> devices;  // URIs of devices to open and watch
  std::string scene;                 // its devices, too; empty: none
  bool json = false;
};
int doctor(const DoctorOptions& options);

// Prints the needles that a scene may name (hal/base/needles.h).
int list_needles(bool json);

struct DevicesOptions {
  std::string root = "/";  // or the root of a captured tree
  bool json = false;
};
int list_devices(const DevicesOptions& options);

struct ProbeOptions {
  std::string uri;
  std::string output;  // file for the record; empty: none
  double seconds = 5;
  bool push = false;
  bool json = false;
};
int probe(const ProbeOptions& options);

struct StationOptions {
  std::string uri;
  std::string to;      // ADDRESS:PORT
  double seconds = 0;  // 0: until Ctrl-C
  std::int32_t acknowledge_button = -1;
  std::int32_t dead_man_button = -1;
};
int station(const StationOptions& options);

// Runs beside another process of this program: not for users.
int beside(std::string_view role);

}  // namespace stylet::app
