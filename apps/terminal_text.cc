#include "apps/terminal_text.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "apps/help.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

/// Limits of the width of a text, and its default.
/// Narrower lines break words, and wider ones are hard to read.
constexpr int kNarrowest = 40, kWidest = 120, kUsualWidth = 80;

constexpr int kHangingIndent = 2;
constexpr std::string_view kFail = "verdict: fail";

std::size_t IndentOf(const std::string& line) {
  return std::min(line.find_first_not_of(' '), line.size());
}

bool IsTableRow(const std::string& line) {
  return line.find("  ", IndentOf(line)) != std::string::npos;
}

}  // namespace

int TextWidth(int stream) {
  const char* columns = std::getenv("COLUMNS");
  const std::optional<double> asked = columns == nullptr ? std::nullopt : ParseDouble(columns);
  winsize terminal{};
  int width = kUsualWidth;
  if (asked && *asked >= 1) {
    width = static_cast<int>(std::min<double>(*asked, kWidest));
  } else if (isatty(stream) == 1 && ioctl(stream, TIOCGWINSZ, &terminal) == 0 &&
             terminal.ws_col > 0) {
    width = terminal.ws_col;
  }
  return std::clamp(width, kNarrowest, kWidest);
}

std::string WrapForTerminal(const std::string& line, int width) {
  const std::size_t indent = IndentOf(line);
  if (IsTableRow(line) || indent == line.size()) return line + "\n";
  return WrapText(line, static_cast<int>(indent) + kHangingIndent, width).substr(kHangingIndent);
}

std::string ArrangeForTerminal(const std::string& text, int width) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  if (lines.empty()) return "";
  std::string verdict = lines.back();
  lines.pop_back();
  // The first reason repeats the text after "verdict: fail, ".
  if (!lines.empty() && verdict == std::string(kFail) + ", " + lines.front()) verdict = kFail;
  const auto table = std::ranges::find_if(lines, IsTableRow);
  std::string arranged = WrapForTerminal(verdict, width);
  for (auto line = lines.begin(); line != lines.end(); ++line) {
    if (line == table) arranged += "\n";
    arranged += WrapForTerminal(*line, width);
  }
  return arranged;
}

}  // namespace regrasp::apps
