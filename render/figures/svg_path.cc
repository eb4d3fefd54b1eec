#include "render/figures/svg_path.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>

namespace regrasp::render {

namespace {

constexpr double kUnits = 100;  ///< integers per unit
constexpr std::string_view kSpace = " \t\n";

/// Reads commands and numbers.
class PathReader {
 public:
  explicit PathReader(std::string_view data) : left_(data) {}

  /// Return the next command letter, or nothing if a number or the end follows.
  std::optional<char> Command() {
    SkipSpace();
    if (left_.empty() || kCommands.find(left_.front()) == std::string_view::npos) return {};
    const char command = left_.front();
    left_.remove_prefix(1);
    return command;
  }

  /// Return the next number in hundredths, or nothing if none follows.
  std::optional<long> Number() {
    SkipSpace();
    double value = 0;
    const auto [end, error] = std::from_chars(left_.data(), left_.data() + left_.size(), value);
    constexpr double kLargest = 1e9;
    if (error != std::errc() || !(std::abs(value) < kLargest)) return {};
    left_.remove_prefix(end - left_.data());
    return std::lround(kUnits * value);
  }

  bool AtEnd() {
    SkipSpace();
    return left_.empty();
  }

 private:
  static constexpr std::string_view kCommands = "MLCZ";

  void SkipSpace() {
    const std::size_t first = left_.find_first_not_of(kSpace);
    left_.remove_prefix(first == std::string_view::npos ? left_.size() : first);
  }

  std::string_view left_;
};

/// Write hundredths without needless zeros: "-.5", "12.25".
std::string HundredthsText(long hundredths) {
  const long size = std::labs(hundredths);
  const long whole = size / 100, part = size % 100;
  std::string text = hundredths < 0 ? "-" : "";
  if (whole > 0 || part == 0) text += std::to_string(whole);
  if (part == 0) return text;
  text += part < 10 ? ".0" : ".";
  return text + std::to_string(part % 10 == 0 ? part / 10 : part);
}

/// Writes commands with relative coordinates.
class PathWriter {
 public:
  /// Begin a command, unless it continues the previous one.
  void Begin(char command) {
    // Points after those of "m" are those of lines.
    if (command == last_ || (command == 'l' && last_ == 'm')) return;
    text_ += command;
    last_ = command;
  }
  void Add(long value) {
    const std::string number = HundredthsText(value);
    const char before = text_.back();
    const bool after_number = before == '.' || (before >= '0' && before <= '9');
    if (after_number && number.front() != '-') text_ += ' ';
    text_ += number;
  }
  /// A new subpath needs its own command.
  void Separate() { last_ = '\0'; }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  char last_ = '\0';
};

/// Number of points of a command.
std::size_t PointsOf(char command) { return command == 'C' ? 3 : 1; }

}  // namespace

std::string ShortPathData(std::string_view data) {
  PathReader reader(data);
  PathWriter writer;
  std::array<long, 2> now = {0, 0}, start = {0, 0};
  bool first = true;
  char command = '\0';
  while (!reader.AtEnd()) {
    if (const auto next = reader.Command()) {
      command = *next;
    } else if (command == 'M') {
      command = 'L';
    } else if (command == '\0' || command == 'Z') {
      return std::string(data);
    }
    if (command == 'Z') {
      writer.Begin('z');
      writer.Separate();
      now = start;
      continue;
    }
    if (first && command != 'M') return std::string(data);
    if (command == 'M') writer.Separate();
    writer.Begin(command == 'M' ? 'm' : command == 'L' ? 'l' : 'c');
    std::array<long, 2> end = now;
    for (std::size_t i = 0; i < PointsOf(command); ++i) {
      for (int axis = 0; axis < 2; ++axis) {
        const auto value = reader.Number();
        if (!value) return std::string(data);
        writer.Add(*value - now[axis]);
        end[axis] = *value;
      }
    }
    now = end;
    if (command == 'M') start = end;
    first = false;
  }
  return writer.text();
}

std::string ShortenPaths(std::string_view svg) {
  static constexpr std::string_view kPath = "<path";
  static constexpr std::string_view kData = " d=\"";
  std::string text;
  while (true) {
    const std::size_t path = svg.find(kPath);
    const std::size_t close = path == std::string_view::npos ? path : svg.find('>', path);
    if (close == std::string_view::npos) break;
    const std::size_t data = svg.substr(0, close).find(kData, path);
    if (data == std::string_view::npos) {
      text += svg.substr(0, close);
      svg.remove_prefix(close);
      continue;
    }
    const std::size_t first = data + kData.size();
    const std::size_t last = svg.find('"', first);
    text += svg.substr(0, first);
    text += ShortPathData(svg.substr(first, last - first));
    svg.remove_prefix(last);
  }
  return text += svg;
}

}  // namespace regrasp::render
