// SPDX-License-Identifier: GPL-3.0-or-later
// stylet-organ check: checks whether an organ file is undamaged.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "base/file.h"
#include "base/outputs.h"
#include "base/refusal.h"
#include "commands.h"
#include "report/info.h"
#include "stylet/kernel.h"

namespace stylet::offline {
namespace {

using Json = nlohmann::ordered_json;

void run_check(const FileArguments& a) {
  const std::string bytes = read_file(a.file);
  const SumCheck sum = check_sum(a.file, bytes);
  const Organ organ = open_organ(a.file, std::as_bytes(std::span(bytes)));
  if (sum == SumCheck::kDiffers) {
    refuse(
        "{}: the file is undamaged, but not the one that {}{} was written for: expected that one",
        a.file, a.file, kSumEnding);
  }
  Sizes need{};
  if (const Status status = sizes(organ, Config{}, need); status != Status::kOk) {
    refuse("{}: {} voxels: {}", a.file, organ.voxel_count, status_name(status));
  }
  if (a.json) {
    const Json facts = {{"file", a.file},
                        {"ok", true},
                        {"voxels", organ.voxel_count},
                        {"hash", fmt::format("{:016x}", organ.hash)},
                        {"bytes_are_those_built", !organ.content_sha256.empty()},
                        {"sum_beside_it_agrees", sum == SumCheck::kSame}};
    fmt::print("{}\n", facts.dump(2));
    return;
  }
  fmt::print("{}: ok: {} voxels, hash {:016x}, {}{}\n", a.file, organ.voxel_count, organ.hash,
             organ.content_sha256.empty() ? "holds no SHA-256 of its bytes"
                                          : "its bytes are those that were built",
             sum == SumCheck::kSame ? " and those of the .sha256 file beside it" : "");
}

}  // namespace

void add_check(CLI::App& app) {
  const auto arguments = std::make_shared<FileArguments>();
  FileArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("check", "Check every value and byte of an organ file");
  command->add_option("file", a.file, "Organ file")->type_name("FILE")->required();
  command->add_flag("--json", a.json, "Print one JSON object");
  command->footer(
      "Example:\n  stylet-organ check liver.organ\nChecks every value as the kernel does, then "
      "every byte against the SHA-256 in the file. If FILE.sha256\n(of build --sum) lies beside "
      "the file, also checks that this is the file it was written for.");
  command->callback([arguments] { run_check(*arguments); });
}

}  // namespace stylet::offline
