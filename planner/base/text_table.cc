#include "planner/base/text_table.h"

#include <algorithm>

#include "planner/base/utf8.h"

namespace regrasp {

namespace {

unsigned char AsByte(char c) { return static_cast<unsigned char>(c); }

/// Whether a byte of UTF-8 begins a character.
bool IsFirst(char c) { return (AsByte(c) & 0xC0) != 0x80; }

std::size_t CountCharacters(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, IsFirst));
}

/// Lower-case digits, at least so many.
std::string HexDigits(char32_t value, int digits) {
  std::string text;
  for (; value > 0 || digits > 0; value >>= 4, --digits) {
    text.insert(text.begin(), "0123456789abcdef"[value & 0xF]);
  }
  return text;
}

/// Where the character with this index begins.
std::size_t PlaceOf(std::size_t index, const std::string& text) {
  std::size_t place = 0;
  for (; place < text.size(); ++place) {
    if (IsFirst(text[place]) && index-- == 0) break;
  }
  return place;
}

std::string WithoutMiddle(const std::string& line) {
  const std::size_t count = CountCharacters(line);
  if (count <= kLongestLine) return line;
  constexpr std::size_t kHead = kLongestLine / 2, kTail = kLongestLine - kHead - 1;
  return line.substr(0, PlaceOf(kHead, line)) + "…" + line.substr(PlaceOf(count - kTail, line));
}

}  // namespace

std::string OneLine(std::string_view text) {
  std::string line;
  while (!text.empty()) {
    const Utf8Character character = TakeCharacter(text);
    if (!character.is_valid) {
      for (const char byte : character.bytes) line += "\\x" + HexDigits(AsByte(byte), 2);
    } else if (character.code < 0x20 || character.code == 0x7F) {
      line += ' ';
    } else if (IsInvisible(character.code)) {
      line += "\\u" + HexDigits(character.code, 4);
    } else {
      line += character.bytes;
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return WithoutMiddle(line);
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
