// SPDX-License-Identifier: GPL-3.0-or-later
// stylet-organ info: shows what an organ file contains and needs.
#include "report/info.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "base/file.h"
#include "commands.h"

namespace stylet::offline {
namespace {

using Json = nlohmann::ordered_json;

void run_info(const FileArguments& a) {
  const std::string bytes = read_file(a.file);
  const auto view = std::as_bytes(std::span(bytes));
  const Json facts = organ_facts(open_organ(a.file, view), view);
  fmt::print("{}", a.json ? facts.dump(2) + "\n" : organ_text(facts));
}

}  // namespace

void add_info(CLI::App& app) {
  const auto arguments = std::make_shared<FileArguments>();
  FileArguments& a = *arguments;
  CLI::App* command =
      app.add_subcommand("info", "Show what an organ file holds, and the memory it needs");
  command->add_option("file", a.file, "Organ file")->type_name("FILE")->required();
  command->add_flag("--json", a.json, "Print one JSON object");
  command->footer("Example:\n  stylet-organ info liver.organ --json");
  command->callback([arguments] { run_info(*arguments); });
}

}  // namespace stylet::offline
