#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp {

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
