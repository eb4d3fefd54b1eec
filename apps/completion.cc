// What shells complete a program's command line with, from what its --help says.

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

/// Within single quotes of zsh, and within brackets there.
std::string ZshQuoted(std::string text) {
  for (const char c : {'\\', '[', ']'}) text = Replaced(text, c, std::string("\\") + c);
  return Replaced(text, '\'', "'\\''");
}

/// Within single quotes of fish.
std::string FishQuoted(const std::string& text) {
  return Replaced(Replaced(text, '\\', "\\\\"), '\'', "\\'");
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
  return "# bash completion of " + name + "\n_regrasp_" + name +
         "() {\n  local word=${COMP_WORDS[COMP_CWORD]}\n  case ${COMP_WORDS[COMP_CWORD-1]} in\n" +
         values + "  esac\n  mapfile -t COMPREPLY < <(compgen -W '" + Join(names) +
         "' -- \"$word\")\n}\ncomplete -o filenames -F _regrasp_" + name + " " + name + "\n";
}

std::string ZshCompletion(const CLI::App& app) {
  std::string text = "#compdef " + app.get_name() + "\n_arguments";
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
  std::string text;
  for (const OptionHelp& option : AllOptions(app)) {
    // Without files or with them: fish refuses both at once.
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
