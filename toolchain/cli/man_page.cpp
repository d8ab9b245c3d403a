// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "stylet/command_texts.h"

namespace stylet::cli {
namespace {

// A line of text: no sign is a request of groff's.
std::string plain(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\') {
      safe += "\\e";
    } else if (c == '-') {
      safe += "\\-";
    } else if (c == '\'') {
      safe += "\\(aq";
    } else {
      safe += c;
    }
  }
  return safe.empty() || safe[0] != '.' ? safe : "\\&" + safe;
}

std::string name_list(const std::set<CLI::Option*>& options) {
  std::set<std::string> names;  // the set's own order is that of addresses
  for (const CLI::Option* option : options) names.insert(option->get_name());
  return plain(CLI::detail::join(names, ", "));
}

std::string value_text(const CLI::Option& option) {
  std::string text;
  if (takes_value(option)) {
    text = option.get_positional() ? option.get_name(true) : option.get_type_name();
    if (option.get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
  } else if (!option.get_fnames().empty()) {
    text = "[=NUMBER]";
  }
  return text;
}

std::string option_text(const CLI::Option& option) {
  std::string head;
  for (const std::string& name : names_of(option)) {
    head += fmt::format("{}\\fB{}\\fR", head.empty() ? "" : ", ", plain(name));
  }
  const std::string value = value_text(option);
  if (!value.empty()) {
    head += fmt::format("{}\\fI{}\\fR", head.empty() || value[0] == '[' ? "" : " ", plain(value));
  }
  std::string text = fmt::format(".TP\n{}\n{}", head, plain(option.get_description()));
  if (option.get_positional() && !option.get_type_name().empty()) {
    text += fmt::format(" ({})", plain(option.get_type_name()));
  }
  text += ".\n";
  if (!option.get_default_str().empty()) {
    text += fmt::format("Without it: {}.\n", plain(option.get_default_str()));
  }
  if (option.get_required()) text += "Required.\n";
  if (!option.get_needs().empty())
    text += fmt::format("Only with {}.\n", name_list(option.get_needs()));
  if (!option.get_excludes().empty()) {
    text += fmt::format("Not with {}.\n", name_list(option.get_excludes()));
  }
  return text;
}

std::string option_texts(const CLI::App& app) {
  std::string text;
  for (const bool positional : {true, false}) {
    for (const CLI::Option* option : shown_options(app, positional)) text += option_text(*option);
  }
  return text;
}

std::string synopsis(const CLI::App& app) {
  std::string text = "[\\fIOPTIONS\\fR]";
  for (const CLI::Option* option : shown_options(app, true)) {
    const bool many = option->get_expected_max() == CLI::detail::expected_max_vector_size;
    text += fmt::format(" \\fI{}\\fR{}", plain(option->get_name(true)), many ? " ..." : "");
  }
  return text;
}

// Examples and exit codes, line by line as --help has them.
std::string footer(const CLI::App& app) {
  const std::string text = app.get_footer();
  if (text.empty()) return "";
  std::string lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines += plain(text.substr(begin, end - begin)) + "\n";
    begin = end + 1;
  }
  return ".PP\n.nf\n" + lines + ".fi\n";
}

}  // namespace

std::string man_page(const CLI::App& program, const std::string& version) {
  const std::string name = program.get_name();
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string page = fmt::format(
      ".TH \"{}\" 1 \"\" \"{}\" \"Stylet\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n\\fB{}\\fR "
      "[\\fIOPTIONS\\fR] \\fICOMMAND\\fR ...\n.SH OPTIONS\n{}",
      plain(upper), plain(version), plain(name), plain(program.get_description()), plain(name),
      option_texts(program));
  page += ".SH COMMANDS\n";
  for (const Command& command : commands_of(program)) {
    if (command.words.empty()) continue;
    page += fmt::format(".SS {} {}\n\\fB{} {}\\fR {}\n.PP\n{}.\n{}{}", plain(name),
                        plain(command.words), plain(name), plain(command.words),
                        synopsis(*command.app), plain(command.app->get_description()),
                        option_texts(*command.app), footer(*command.app));
  }
  return page + ".SH EXAMPLES\n" + footer(program);
}

std::vector<Command> commands_of(const CLI::App& program) {
  std::vector<Command> all = {{"", &program}};
  for (std::size_t i = 0; i < all.size(); ++i) {  // grows
    const Command outer = all[i];
    std::vector<Command> inner;
    for (const CLI::App* app : outer.app->get_subcommands([](const CLI::App*) { return true; })) {
      inner.push_back({(outer.words.empty() ? "" : outer.words + " ") + app->get_name(), app});
    }
    all.insert(all.end(), inner.begin(), inner.end());
  }
  return all;
}

std::vector<const CLI::Option*> shown_options(const CLI::App& app, bool positional) {
  std::vector<const CLI::Option*> shown;
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty() && option->get_positional() == positional) {
      shown.push_back(option);
    }
  }
  return shown;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
}

bool takes_value(const CLI::Option& option) {
  return option.get_expected_min() > 0 && option.get_items_expected_max() > 0;
}

void add_text_options(CLI::App& program, const std::string& version) {
  const auto print = [](const std::string& text) {
    std::fputs(text.c_str(), stdout);
    throw CLI::Success();
  };
  program
      .add_flag_callback("--man", [&program, version, print] { print(man_page(program, version)); })
      ->group("");
  program
      .add_option_function<std::string>(
          "--completion",
          [&program, print](const std::string& shell) { print(completion(program, shell)); })
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->group("");
}

}  // namespace stylet::cli
