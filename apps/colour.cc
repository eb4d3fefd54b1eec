#include "apps/colour.h"

#include <unistd.h>

#include <cstdlib>
#include <regex>
#include <sstream>
#include <string_view>

namespace regrasp::apps {

namespace {

Ink InkOf(std::string_view verdict) {
  if (verdict.starts_with("pass")) return Ink::kGreen;
  return verdict == "skipped" ? Ink::kFaint : Ink::kRed;
}

std::string PaintLine(const std::string& line) {
  // "verdict: fail, …", and the first line of a failed plan.
  static const std::regex kWhole("(verdict: )(.*)|()(step \\d+ \\(\\w+\\) fails: .*)");
  // A cell of a table.
  static const std::regex kCell("(.*?  )(pass|fail(: \\S+)?|skipped|bad-input|error)((  .*)?)");
  std::smatch found;
  if (std::regex_match(line, found, kWhole)) {
    const std::string said = found[2].matched ? found[2].str() : found[4].str();
    return found[1].str() + Paint(said, InkOf(said));
  }
  if (std::regex_match(line, found, kCell)) {
    return found[1].str() + Paint(found[2].str(), InkOf(found[2].str())) + found[4].str();
  }
  return line;
}

}  // namespace

bool TakesColour(int stream) {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  return variable("NO_COLOR").empty() && variable("TERM") != "dumb" && isatty(stream) == 1;
}

std::string Paint(const std::string& text, Ink ink) {
  return "\x1b[" + std::to_string(static_cast<int>(ink)) + "m" + text + "\x1b[0m";
}

std::string PaintVerdicts(const std::string& table) {
  std::string painted;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) painted += PaintLine(line) + "\n";
  return painted;
}

}  // namespace regrasp::apps
