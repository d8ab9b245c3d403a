// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "stylet/command_texts.h"

namespace stylet::cli {
namespace {

// What may follow an option or stand for a positional one.
enum class Values { kNone, kFiles, kFolders, kChoices, kOther };

Values values_of(const CLI::Option& option) {
  if (!takes_value(option)) return Values::kNone;
  if (!choices_of(option).empty()) return Values::kChoices;
  if (option.get_type_name().starts_with("FILE")) return Values::kFiles;
  if (option.get_type_name().starts_with("FOLDER")) return Values::kFolders;
  return Values::kOther;
}

// In single quotes of any of the shells; a colon and brackets are zsh's own signs.
std::string in_quotes(const std::string& text, const char* specials = "") {
  std::string safe = "'";
  for (const char c : text) {
    if (std::string_view(specials).find(c) != std::string_view::npos) safe += '\\';
    safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return safe + "'";
}

std::string function_name(const std::string& program) {
  std::string name = "_" + program;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}

std::string inner_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* inner : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(inner->get_name());
  }
  return CLI::detail::join(names, " ");
}

// ---- bash ---------------------------------------------------------------------------------------

std::string bash_values(const CLI::Option& option) {
  switch (values_of(option)) {
    case Values::kFiles:
      return "mapfile -t COMPREPLY < <(compgen -f -- \"$word\")";
    case Values::kFolders:
      return "mapfile -t COMPREPLY < <(compgen -d -- \"$word\")";
    case Values::kChoices:
      return fmt::format("COMPREPLY=($(compgen -W {} -- \"$word\"))",
                         in_quotes(CLI::detail::join(choices_of(option), " ")));
    default:
      return ":";
  }
}

std::string bash(const CLI::App& program) {
  std::string known, words, values, files;
  for (const Command& command : commands_of(program)) {
    std::string options;
    for (const CLI::Option* option : shown_options(*command.app, false)) {
      std::vector<std::string> patterns;
      for (const std::string& name : names_of(*option)) {
        options += name + " ";
        patterns.push_back(in_quotes(command.words + " " + name));
      }
      if (takes_value(*option)) {
        values += fmt::format("    {}) {}; return ;;\n", CLI::detail::join(patterns, " | "),
                              bash_values(*option));
      }
    }
    known += in_quotes(command.words) + " | ";
    words += fmt::format("    {}) options={}; commands={} ;;\n", in_quotes(command.words),
                         in_quotes(options), in_quotes(inner_names(*command.app)));
    for (const CLI::Option* option : shown_options(*command.app, true)) {
      files += fmt::format("    {}) {} ;;\n", in_quotes(command.words), bash_values(*option));
      break;
    }
  }
  known.resize(known.size() - 3);
  return fmt::format(R"(# Completion of {0} for bash; printed by {0} --completion bash.
{1}() {{
  local word=$2 before=$3 command= options= commands= i next
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    next=${{command:+$command }}${{COMP_WORDS[i]}}
    case "$next" in
      {2}) command=$next ;;
    esac
  done
  case "$command $before" in
{3}  esac
  case "$command" in
{4}  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")); return ;;
  esac
  case "$command" in
{5}  esac
  COMPREPLY+=($(compgen -W "$commands" -- "$word"))
}}
complete -o filenames -F {1} {0}
)",
                     program.get_name(), function_name(program.get_name()), known, values, words,
                     files);
}

// ---- zsh ----------------------------------------------------------------------------------------

std::string zsh_values(const CLI::Option& option) {
  switch (values_of(option)) {
    case Values::kFiles:
      return ":file:_files";
    case Values::kFolders:
      return ":folder:_files -/";
    case Values::kChoices:
      return fmt::format(":value:({})", CLI::detail::join(choices_of(option), " "));
    case Values::kOther:
      return ":value: ";
    default:
      return "";
  }
}

std::string zsh_arguments(const CLI::App& app) {
  constexpr const char* kSpecials = "[]:";
  std::string text = "_arguments";
  for (const CLI::Option* option : shown_options(app, false)) {
    for (const std::string& name : names_of(*option)) {
      text +=
          fmt::format(" \\\n        '{}'{}'{}'", name + "[",
                      in_quotes(option->get_description(), kSpecials), "]" + zsh_values(*option));
    }
  }
  for (const CLI::Option* option : shown_options(app, true)) {
    text += fmt::format(" \\\n        '*{}'", zsh_values(*option));
    break;
  }
  return text;
}

std::string zsh(const CLI::App& program) {
  std::string cases, list;
  for (const CLI::App* inner : program.get_subcommands([](const CLI::App*) { return true; })) {
    list += "    " + in_quotes(inner->get_name() + ":" + inner->get_description()) + "\n";
  }
  for (const Command& command : commands_of(program)) {
    if (command.words.empty()) continue;
    cases += fmt::format("      {})\n        {} ;;\n", in_quotes(command.words),
                         zsh_arguments(*command.app));
  }
  return fmt::format(R"(#compdef {0}
# Completion of {0} for zsh; printed by {0} --completion zsh.
{1}() {{
  local -a commands
  commands=(
{2}  )
  if (( CURRENT == 2 )); then
    if [[ ${{words[2]}} == -* ]]; then
      {3}
    else
      _describe command commands
    fi
    return
  fi
  local command=${{words[2]}}
  shift words
  (( CURRENT-- ))
  while (( CURRENT > 2 )); do
    case "$command ${{words[2]}}" in
      {4}) command="$command ${{words[2]}}"; shift words; (( CURRENT-- )) ;;
      *) break ;;
    esac
  done
  case "$command" in
{5}  esac
}}
{1} "$@"
)",
                     program.get_name(), function_name(program.get_name()), list,
                     zsh_arguments(program),
                     [&] {
                       std::vector<std::string> nested = {"''"};
                       for (const Command& command : commands_of(program)) {
                         if (command.words.find(' ') != std::string::npos) {
                           nested.push_back(in_quotes(command.words));
                         }
                       }
                       return CLI::detail::join(nested, " | ");
                     }(),
                     cases);
}

// ---- fish ---------------------------------------------------------------------------------------

std::string fish_condition(const std::string& words) {
  if (words.empty()) return "__fish_use_subcommand";
  std::string condition;
  for (const std::string& word : CLI::detail::split(words, ' ')) {
    condition += (condition.empty() ? "" : "; and ") + ("__fish_seen_subcommand_from " + word);
  }
  return condition;
}

std::string fish_values(const CLI::Option& option) {
  switch (values_of(option)) {
    case Values::kFiles:
      return " -r -F";
    case Values::kFolders:
      return " -x -a '(__fish_complete_directories)'";
    case Values::kChoices:
      return fmt::format(" -x -a {}", in_quotes(CLI::detail::join(choices_of(option), " ")));
    case Values::kOther:
      return " -x";
    default:
      return "";
  }
}

std::string fish(const CLI::App& program) {
  const std::string name = program.get_name();
  std::string text = fmt::format(
      "# Completion of {0} for fish; printed by {0} --completion fish.\n"
      "complete -c {0} -n __fish_use_subcommand -f\n",
      name);
  for (const Command& command : commands_of(program)) {
    const std::string head =
        fmt::format("complete -c {} -n {}", name, in_quotes(fish_condition(command.words)));
    for (const CLI::App* inner :
         command.app->get_subcommands([](const CLI::App*) { return true; })) {
      text += fmt::format("{} -a {} -d {}\n", head, inner->get_name(),
                          in_quotes(inner->get_description()));
    }
    for (const CLI::Option* option : shown_options(*command.app, false)) {
      text += head;
      for (const std::string& each : option->get_snames()) text += " -s " + each;
      for (const std::string& each : option->get_lnames()) text += " -l " + each;
      text += fish_values(*option) + " -d " + in_quotes(option->get_description()) + "\n";
    }
    for (const CLI::Option* option : shown_options(*command.app, true)) {
      if (values_of(*option) == Values::kChoices) text += head + fish_values(*option) + "\n";
    }
  }
  return text;
}

}  // namespace

std::string completion(const CLI::App& program, const std::string& shell) {
  return shell == "bash" ? bash(program) : shell == "zsh" ? zsh(program) : fish(program);
}

}  // namespace stylet::cli
