#pragma once

#include <string_view>

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

}  // namespace regrasp
