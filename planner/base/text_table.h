#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp {

/// One character at the front of a text, or the bytes there that are none.
struct Utf8Character {
  char32_t code = 0;       ///< 0 also where the bytes are no character
  std::string_view bytes;  ///< not empty
  bool is_valid = false;   ///< whether the bytes are a character of UTF-8 (Unicode 15, table 3-7)
};

/// Takes the first character off a text; where the bytes are no UTF-8, as many as begin a character
/// and at least one. What is taken in turn makes up the whole text.
/// @param text  not empty; becomes the rest.
[[nodiscard]] Utf8Character TakeCharacter(std::string_view& text);

/// Whether a character cannot be seen or changes how others are shown: control characters, marks of
/// direction, joiners, spaces of no width, separators of lines and paragraphs, tags,
/// noncharacters. A name with such characters looks like another, or acts on a terminal.
[[nodiscard]] bool IsInvisible(char32_t code);

/// Characters of the longest line that OneLine returns: some twenty lines of a terminal.
inline constexpr std::size_t kLongestLine = 2000;

/// Text as one line that shows all that is in it: ASCII's control characters become spaces, and
/// those at the end go; other invisible characters (IsInvisible) and bytes that are not UTF-8 are
/// written as \u202e and \xff. More than `kLongestLine` characters lose those in the middle to "…".
/// File names may hold any bytes, terminals act on some of them, and scripts count on lines.
[[nodiscard]] std::string OneLine(std::string_view text);

using TextRow = std::vector<std::string>;

/// Rows as lines of columns with two spaces between them. All columns but the last are filled up to
/// their widest entry, counted in characters. Cells are made one line.
/// @param rows  UTF-8, all of the same size.
[[nodiscard]] std::string FormatRows(const std::vector<TextRow>& rows);

}  // namespace regrasp
