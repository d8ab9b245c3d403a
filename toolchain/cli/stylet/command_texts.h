// SPDX-License-Identifier: Apache-2.0
// What a program's table of options says besides --help: a manual page and completions for shells.
//
// Promises: each option, command and example of --help is in them, in the order of --help; the same
// bytes in every run. A value is a file where its type is FILE or FOLDER, and one of {a,b} where
// the table says so.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace stylet::cli {

// Page of section 1, in the man macros of groff and mandoc.
std::string man_page(const CLI::App& program, const std::string& version);

// For "bash", "zsh" or "fish".
std::string completion(const CLI::App& program, const std::string& shell);

// --man and --completion SHELL, which print these and end; --help does not name them.
void add_text_options(CLI::App& program, const std::string& version);

// An option that may be without a value takes one only after '=': in `--port 7899` the number would
// be taken for a file, and the error name another word. Throws a CLI::ParseError that says so.
void refuse_separate_values(const CLI::App& program, int argc, const char* const* argv);

// An empty text is never what a user means: it is a variable that a script has not set, and would
// pass for an option that was not given. Throws a CLI::ParseError that names the option.
void refuse_empty_values(const CLI::App& program, int argc, const char* const* argv);

// CLI::Range, which --help would tell as "UINT in [1 - 16]".
template <typename Number>
CLI::Range between(Number low, Number high) {
  return CLI::Range(low, high, CLI::detail::to_string(low) + " to " + CLI::detail::to_string(high));
}

// ---- parts of the above
// --------------------------------------------------------------------------

// `app` and all its commands, outer before inner; with the words that lead there, "devices probe".
struct Command {
  std::string words;  // empty: the program itself
  const CLI::App* app;
};
std::vector<Command> commands_of(const CLI::App& program);

// Those that --help shows, positional ones (or the others) only.
std::vector<const CLI::Option*> shown_options(const CLI::App& app, bool positional);

std::vector<std::string> names_of(const CLI::Option& option);    // --output, -o
std::vector<std::string> choices_of(const CLI::Option& option);  // empty: not from a list
bool takes_value(const CLI::Option& option);

}  // namespace stylet::cli
