// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "stylet/command_texts.h"

namespace stylet::cli {
namespace {

bool is_number(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

const CLI::App* inner_command(const CLI::App& app, const std::string& name) {
  const auto found =
      app.get_subcommands([&](const CLI::App* inner) { return inner->get_name() == name; });
  return found.empty() ? &app : found.front();
}

bool has_optional_value(const CLI::App& app, const std::string& word) {
  const CLI::Option* option = app.get_option_no_throw(word);
  return option != nullptr && !takes_value(*option) && !option->get_fnames().empty();
}

// What an option or, after a command, its next positional value is.
std::string kind_of(const CLI::Option* option) {
  return option == nullptr || option->get_type_name().empty() ? "a value" : option->get_type_name();
}

}  // namespace

void refuse_empty_values(const CLI::App& program, int argc, const char* const* argv) {
  const CLI::App* command = &program;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::string last = i > 1 ? argv[i - 1] : "";
    if (word.empty()) {
      const CLI::Option* option =
          last.starts_with("-") ? command->get_option_no_throw(last) : nullptr;
      throw CLI::ArgumentMismatch(fmt::format("{}: an empty text follows: expected {}",
                                              last.empty() ? program.get_name() : last,
                                              kind_of(option)));
    }
    const std::string name = word.substr(0, word.size() - 1);
    if (word.starts_with("-") && word.ends_with("=") &&
        command->get_option_no_throw(name) != nullptr) {
      throw CLI::ArgumentMismatch(fmt::format("{} is followed by nothing: expected {}", word,
                                              kind_of(command->get_option_no_throw(name))));
    }
    command = inner_command(*command, word);
  }
}

void refuse_separate_values(const CLI::App& program, int argc, const char* const* argv) {
  const CLI::App* command = &program;
  for (int i = 1; i + 1 < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") return;
    if (!word.starts_with("-")) {
      command = inner_command(*command, word);
    } else if (is_number(argv[i + 1]) && has_optional_value(*command, word)) {
      throw CLI::ArgumentMismatch(
          fmt::format("{0} {1}: expected {0}={1}: a value that may be missing comes after '='",
                      word, argv[i + 1]));
    }
  }
}

}  // namespace stylet::cli
