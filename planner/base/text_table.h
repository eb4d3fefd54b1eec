#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace regrasp {

/// Text without control characters: they become spaces, and those at the end go. File names may
/// hold line breaks, and scripts count on lines.
[[nodiscard]] std::string OneLine(std::string_view text);

using TextRow = std::vector<std::string>;

/// Rows as lines of columns with two spaces between them. All columns but the last are filled up to
/// their widest entry, counted in characters. Cells are made one line.
/// @param rows  UTF-8, all of the same size.
[[nodiscard]] std::string FormatRows(const std::vector<TextRow>& rows);

}  // namespace regrasp
