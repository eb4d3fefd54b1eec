#include "planner/base/text_table.h"

#include <algorithm>

namespace regrasp {

namespace {

/// Bytes of UTF-8 that begin a character.
std::size_t CountCharacters(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string OneLine(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    line += control ? ' ' : c;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::string FormatRows(const std::vector<TextRow>& rows) {
  if (rows.empty()) return "";
  std::vector<TextRow> cells = rows;
  std::vector<std::size_t> width(rows.front().size());
  for (TextRow& row : cells) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = OneLine(row[i]);
      width[i] = std::max(width[i], CountCharacters(row[i]));
    }
  }
  std::string text;
  for (const TextRow& row : cells) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      text += row[i] + std::string(width[i] - CountCharacters(row[i]) + 2, ' ');
    }
    text += row.back() + "\n";
  }
  return text;
}

}  // namespace regrasp
