#include "cli/completion_script.h"

#include <sstream>
#include <vector>

namespace heightlight {
namespace {

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// "-o", "--output"; none of what is given by its place.
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// What an option can be, where that is one of some words: CLI11 tells it as {a,b,c}.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.rfind('{');
  std::vector<std::string> choices;
  if (open == std::string::npos || !type.ends_with('}')) return choices;
  std::istringstream list(type.substr(open + 1, type.size() - open - 2));
  for (std::string choice; std::getline(list, choice, ',');) choices.push_back(choice);
  return choices;
}

std::string join(const std::vector<std::string>& words, const std::string& between) {
  return CLI::detail::join(words, between);
}

/// For a shell, in single quotes.
std::string quote(const std::string& text) {
  std::string quoted = "'";
  for (const char byte : text) quoted += byte == '\'' ? "'\\''" : std::string(1, byte);
  return quoted + '\'';
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Names of options of a command, and choices of what is given by its place.
struct CommandWords {
  std::vector<std::string> options;
  std::vector<std::string> places;
};

CommandWords words_of(const CLI::App& command) {
  CommandWords words;
  for (const CLI::Option* option : command.get_options()) {
    const std::vector<std::string> names = names_of(*option);
    words.options.insert(words.options.end(), names.begin(), names.end());
    if (!names.empty()) continue;
    const std::vector<std::string> choices = choices_of(*option);
    words.places.insert(words.places.end(), choices.begin(), choices.end());
  }
  return words;
}

/// What follows an option that takes a value: its choices, or else a file.
std::string bash_values(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : command.get_options()) {
    if (names_of(*option).empty() || !takes_value(*option)) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : names_of(*option))
      patterns.push_back(quote(command.get_name() + ' ' + name));
    text += "    " + join(patterns, "|") + ") words=" + quote(join(choices_of(*option), " ")) + " ;;\n";
  }
  return text;
}

/// Of zsh's _arguments: "--depth[what it is]:value:(8 16)".
std::string zsh_argument(const CLI::Option& option, const std::string& name) {
  std::string about;
  for (const char byte : first_line(option.get_description()))
    about += byte == '[' || byte == ']' || byte == ':' || byte == '\\' ? std::string("\\") + byte
                                                                       : std::string(1, byte);
  const std::vector<std::string> choices = choices_of(option);
  const std::string values = choices.empty() ? ":value:_files" : ":value:(" + join(choices, " ") + ')';
  if (name.empty()) return "'*" + values + '\'';
  return quote('*' + name + '[' + about + ']' + (takes_value(option) ? values : ""));
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> commands;
  std::string values;
  std::string words;
  for (const CLI::App* command : commands_of(app)) {
    commands.push_back(command->get_name());
    values += bash_values(*command);
    const CommandWords known = words_of(*command);
    words += "    " + command->get_name() + ") options=" + quote(join(known.options, " ")) +
             " words=" + quote(join(known.places, " ")) + " ;;\n";
  }
  return R"(# Completion of heightlight for bash, written by: heightlight completion bash
_heightlight() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
  local options= words=
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W )" +
         quote(join(commands, " ") + " --help --version") + R"( -- "$word"))
    return
  fi
  if [[ $before == '=' ]]; then before=${COMP_WORDS[COMP_CWORD - 2]}; fi
  if [[ $word == '=' ]]; then word=; fi
  case "$command $before" in
)" + values +
         R"(    *) case $command in
)" + words +
         R"(    esac
      if [[ $word == -* ]]; then words=$options; fi ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o default -F _heightlight heightlight
)";
}

std::string zsh_completion(const CLI::App& app) {
  std::string names;
  std::string cases;
  for (const CLI::App* command : commands_of(app)) {
    names += ' ' + quote(command->get_name() + ':' + first_line(command->get_description()));
    cases += "    " + command->get_name() + ") _arguments";
    for (const CLI::Option* option : command->get_options()) {
      const std::vector<std::string> options = names_of(*option);
      for (const std::string& name : options) cases += " \\\n      " + zsh_argument(*option, name);
      if (options.empty()) cases += " \\\n      " + zsh_argument(*option, "");
    }
    cases += " ;;\n";
  }
  return R"(#compdef heightlight
# Completion of heightlight for zsh, written by: heightlight completion zsh
_heightlight() {
  local -a commands=()" +
         names + R"()
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  shift words
  ((CURRENT--))
  case $words[1] in
)" + cases +
         R"(  esac
}
if [[ $funcstack[1] == _heightlight ]]; then _heightlight "$@"; else compdef _heightlight heightlight; fi
)";
}

}  // namespace heightlight
