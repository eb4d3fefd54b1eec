#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp {

/// First character of a text, or its first invalid bytes.
struct Utf8Character {
  char32_t code = 0;       ///< code point; 0 if the bytes are invalid
  std::string_view bytes;  ///< bytes of the character, at least one
  bool is_valid = false;   ///< whether the bytes are a UTF-8 character (Unicode 15, table 3-7)
};

/// Remove the first character from a text.
/// If the text does not start with valid UTF-8, removes the bytes that could begin a character, at
/// least one. The removed bytes of successive calls are the whole text.
/// @param text  not empty; becomes the remaining text.
[[nodiscard]] Utf8Character TakeCharacter(std::string_view& text);

/// Return whether a character is invisible or changes the display of other characters.
/// These are control characters, direction marks, joiners, zero-width spaces, line and paragraph
/// separators, tags and noncharacters. Names with them can imitate other names or control a
/// terminal.
[[nodiscard]] bool IsInvisible(char32_t code);

/// Largest number of characters of a line of OneLine, about twenty lines of a terminal.
inline constexpr std::size_t kLongestLine = 2000;

/// Format text as one line that shows all its characters.
/// ASCII control characters become spaces, without trailing ones. Other invisible characters
/// (IsInvisible) and invalid bytes are written as `\u202e` and `\xff`. Beyond `kLongestLine`
/// characters the middle is replaced by "…". This is required because file names can contain any
/// bytes, terminals act on some of them, and scripts count lines.
[[nodiscard]] std::string OneLine(std::string_view text);

using TextRow = std::vector<std::string>;

/// Format rows as lines of columns, separated by two spaces.
/// All columns but the last are padded to their widest entry, counted in characters. Cells are
/// formatted by OneLine.
/// @param rows  UTF-8, all of the same size.
[[nodiscard]] std::string FormatRows(const std::vector<TextRow>& rows);

}  // namespace regrasp
