// SPDX-License-Identifier: GPL-3.0-or-later
// The program stylet-organ: build, phantom, hull, labels, info, check. Exit codes: 0 done, 1 input
// refused or file damaged, 2 wrong command line.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "base/refusal.h"
#include "commands.h"
#include "organ_command.h"
#include "stylet/command_texts.h"

namespace stylet::offline {

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    fmt::print(stderr, "stylet-organ: warning: {}\n", warning);
  }
}

void tell_of_leftovers(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    fmt::print(stderr, "stylet-organ: removed {}, which a command that was killed had left\n",
               name);
  }
}

namespace {

constexpr int kExitRefused = 1;
constexpr int kExitUsage = 2;

int run(int argc, char** argv) {
  CLI::App app{"Makes and checks organ files: the anatomy that stylet simulates", "stylet-organ"};
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", tool_version());
  cli::add_text_options(app, tool_version());
  app.footer(
      "Examples:\n"
      "  stylet-organ build Liver.stl --units mm --voxel-mm 5 -o liver.organ\n"
      "  stylet-organ phantom liver --voxel-mm 5 -o liver-phantom.organ\n"
      "  stylet-organ info liver.organ\n"
      "Exit codes: 0 done, 1 input refused or file damaged, 2 wrong usage.");
  add_build(app);
  add_phantom(app);
  add_hull(app);
  add_labels(app);
  add_info(app);
  add_check(app);
  try {
    cli::refuse_empty_values(app, argc, argv);
    cli::refuse_separate_values(app, argc, argv);
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) {
      throw CLI::RequiredError("A command (build, phantom, hull, labels, info or check)");
    }
    if (std::fflush(stdout) != 0) refuse("standard output: {}", std::strerror(errno));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr,
               "stylet-organ: out of memory: expected a larger voxel edge, a smaller input or a "
               "larger --memory-limit\n");
    return kExitRefused;
  } catch (const std::exception& error) {
    fmt::print(stderr, "stylet-organ: {}\n", error.what());
    return kExitRefused;
  }
  return 0;
}

}  // namespace
}  // namespace stylet::offline

int main(int argc, char** argv) {
  // A file size limit then acts like a full disk: the write fails, and no partial file is left.
  (void)std::signal(SIGXFSZ, SIG_IGN);
  return stylet::offline::run(argc, argv);
}
