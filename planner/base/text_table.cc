#include "planner/base/text_table.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace regrasp {

namespace {

struct Range {
  char32_t first, last;
};

constexpr auto kInvisible = std::to_array<Range>({{0x0000, 0x001F},
                                                  {0x007F, 0x009F},
                                                  {0x00AD, 0x00AD},
                                                  {0x061C, 0x061C},
                                                  {0x180E, 0x180E},
                                                  {0x200B, 0x200F},
                                                  {0x2028, 0x202E},
                                                  {0x2060, 0x206F},
                                                  {0xFDD0, 0xFDEF},
                                                  {0xFEFF, 0xFEFF},
                                                  {0xFFF9, 0xFFFB},
                                                  {0xE0000, 0xE007F}});

/// Number of bytes after a leading byte, and the range of the first of them.
/// The ranges exclude overlong encodings, surrogates and characters beyond U+10FFFF.
struct Lead {
  std::size_t following = 0;
  unsigned char least = 0x80, most = 0xBF;
};

Lead LeadOf(unsigned char byte) {
  if (byte >= 0xC2 && byte <= 0xDF) return {1};
  if (byte == 0xE0) return {2, 0xA0, 0xBF};
  if (byte == 0xED) return {2, 0x80, 0x9F};
  if (byte >= 0xE1 && byte <= 0xEF) return {2};
  if (byte == 0xF0) return {3, 0x90, 0xBF};
  if (byte == 0xF4) return {3, 0x80, 0x8F};
  if (byte >= 0xF1 && byte <= 0xF3) return {3};
  return {};
}

}  // namespace

Utf8Character TakeCharacter(std::string_view& text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const Lead lead = LeadOf(byte(0));
  std::size_t size = 1;
  char32_t code = lead.following == 0 ? byte(0) : byte(0) & (0x3F >> lead.following);
  for (; size <= lead.following && size < text.size(); ++size) {
    const unsigned char least = size == 1 ? lead.least : 0x80, most = size == 1 ? lead.most : 0xBF;
    if (byte(size) < least || byte(size) > most) break;
    code = code << 6 | (byte(size) & 0x3F);
  }
  const bool is_valid = size == lead.following + 1 && (size > 1 || code < 0x80);
  const Utf8Character character{is_valid ? code : 0, text.substr(0, size), is_valid};
  text.remove_prefix(size);
  return character;
}

bool IsInvisible(char32_t code) {
  if ((code & 0xFFFE) == 0xFFFE) return true;  // two noncharacters per plane
  return std::ranges::any_of(
      kInvisible, [&](const Range& range) { return code >= range.first && code <= range.last; });
}

namespace {

unsigned char AsByte(char c) { return static_cast<unsigned char>(c); }

/// Return whether a byte of UTF-8 begins a character.
bool IsFirst(char c) { return (AsByte(c) & 0xC0) != 0x80; }

std::size_t CountCharacters(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, IsFirst));
}

/// Format a number with at least `digits` lower-case hexadecimal digits.
std::string HexDigits(char32_t value, int digits) {
  std::string text;
  for (; value > 0 || digits > 0; value >>= 4, --digits) {
    text.insert(text.begin(), "0123456789abcdef"[value & 0xF]);
  }
  return text;
}

/// Return the position at which the character with an index begins.
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
