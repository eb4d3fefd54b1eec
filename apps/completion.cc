// Shell completions of a program's command line, from the same data as its --help.

#include <algorithm>

#include "apps/help.h"

namespace regrasp::apps {

namespace {

std::vector<OptionHelp> AllOptions(const CLI::App& app) {
  std::vector<OptionHelp> all;
  for (HelpGroup& group : HelpGroups(app))
    std::ranges::move(group.options, std::back_inserter(all));
  return all;
}

std::string Join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

bool TakesFile(const OptionHelp& option) { return option.type.starts_with("FILE"); }
bool TakesFolder(const OptionHelp& option) { return option.type == "DIR"; }

std::string Replaced(const std::string& text, char what, const std::string& by) {
  std::string out;
  for (const char c : text) out += c == what ? by : std::string(1, c);
  return out;
}

std::string SubcommandNames(const CLI::App& app, const std::string& separator) {
  std::string text;
  for (const CLI::App* command : Subcommands(app)) {
    text += (text.empty() ? "" : separator) + command->get_name();
  }
  return text;
}

/// Escape a text for single quotes of zsh, and for brackets in them.
std::string ZshQuoted(std::string text) {
  for (const char c : {'\\', '[', ']'}) text = Replaced(text, c, std::string("\\") + c);
  return Replaced(text, '\'', "'\\''");
}

/// Escape a text for single quotes of fish.
std::string FishQuoted(const std::string& text) {
  return Replaced(Replaced(text, '\\', "\\\\"), '\'', "\\'");
}

/// Return the completion of a program with subcommands.
/// The first word is completed with the subcommands and options of the program. Further words are
/// completed by the subcommand's program, whose completion is in a file of the same folder.
std::string BashDispatch(const CLI::App& app) {
  const std::string& name = app.get_name();
  return "_regrasp_" + name +
         "() {\n  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]}\n"
         "  if [ \"$COMP_CWORD\" -le 1 ]; then\n    mapfile -t COMPREPLY < <(compgen -W '" +
         SubcommandNames(app, " ") +
         " --help --version' -- \"$word\")\n    return\n  fi\n  case $command in\n    " +
         SubcommandNames(app, "|") +
         ") ;;\n    *) return ;;\n  esac\n"
         "  declare -F \"_regrasp_$command\" >/dev/null || . \"${BASH_SOURCE[0]%/*}/$command\"\n"
         "  \"_regrasp_$command\"\n}\n";
}

std::string ZshDispatch(const CLI::App& app) {
  std::string text = "if (( CURRENT == 2 )); then\n  local -a commands=(\n";
  for (const CLI::App* command : Subcommands(app)) {
    text += "    '" + command->get_name() + ":" + ZshQuoted(command->get_description()) + "'\n";
  }
  return text +
         "  )\n  _describe command commands\nelse\n  shift words\n  (( CURRENT-- ))\n"
         "  _normal\nfi\n";
}

std::string FishDispatch(const CLI::App& app) {
  const std::string begin = "complete -c " + app.get_name() + " -f -n ";
  std::string text;
  for (const CLI::App* command : Subcommands(app)) {
    text += begin + "__fish_use_subcommand -a " + command->get_name() + " -d '" +
            FishQuoted(command->get_description()) + "'\n";
  }
  return text + begin +
         "'not __fish_use_subcommand' -a '(set -l words (commandline -opc) (commandline -ct); "
         "complete -C \"$words[2..-1]\")'\n";
}

}  // namespace

std::string BashCompletion(const CLI::App& app) {
  const std::string& name = app.get_name();
  std::vector<std::string> names;
  std::string values;
  for (const OptionHelp& option : AllOptions(app)) {
    names.push_back(option.name);
    if (option.type.empty()) continue;
    std::string from;
    if (TakesFile(option)) from += " -f";
    if (TakesFolder(option)) from += " -d";
    if (!option.choices.empty()) from += " -W '" + Join(option.choices) + "'";
    values += "    " + option.name + ")" +
              (from.empty() ? "" : " mapfile -t COMPREPLY < <(compgen" + from + " -- \"$word\");") +
              " return ;;\n";
  }
  const std::string head = "# bash completion of " + name + "\n";
  const std::string end = "complete -o filenames -F _regrasp_" + name + " " + name + "\n";
  if (!Subcommands(app).empty()) return head + BashDispatch(app) + end;
  return head + "_regrasp_" + name +
         "() {\n  local word=${COMP_WORDS[COMP_CWORD]}\n  case ${COMP_WORDS[COMP_CWORD-1]} in\n" +
         values + "  esac\n  mapfile -t COMPREPLY < <(compgen -W '" + Join(names) +
         "' -- \"$word\")\n}\n" + end;
}

std::string ZshCompletion(const CLI::App& app) {
  const std::string head = "#compdef " + app.get_name() + "\n";
  if (!Subcommands(app).empty()) return head + ZshDispatch(app);
  std::string text = head + "_arguments";
  for (const OptionHelp& option : AllOptions(app)) {
    text += " \\\n  '" + option.name + "[" + ZshQuoted(option.summary) + "]";
    if (!option.type.empty()) {
      text += ":" + option.name.substr(2) + ":";
      if (TakesFile(option)) {
        text += "_files";
      } else if (TakesFolder(option)) {
        text += "_files -/";
      } else if (!option.choices.empty()) {
        text += "(" + Join(option.choices) + ")";
      }
    }
    text += "'";
  }
  return text + "\n";
}

std::string FishCompletion(const CLI::App& app) {
  std::string text = Subcommands(app).empty() ? "" : FishDispatch(app);
  for (const OptionHelp& option : AllOptions(app)) {
    // fish accepts only one of the two flags: with files or without.
    const bool files = TakesFile(option) || TakesFolder(option);
    text +=
        "complete -c " + app.get_name() + (files ? " -F -l " : " -f -l ") + option.name.substr(2);
    if (!option.type.empty()) text += " -r";
    if (!option.choices.empty()) text += " -a '" + Join(option.choices) + "'";
    text += " -d '" + FishQuoted(option.summary) + "'\n";
  }
  return text;
}

}  // namespace regrasp::apps
