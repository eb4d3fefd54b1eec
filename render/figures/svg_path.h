#pragma once

#include <string>
#include <string_view>

namespace regrasp::render {

/// Rewrite path data of SVG in fewer characters: relative coordinates of two decimals, and no
/// command that repeats the previous one. Points move by at most 0.005 units, and rounding errors
/// do not add up. Data with commands other than M, L, C and Z are returned unchanged.
/// @param data  value of an attribute d with absolute coordinates, as Cairo writes it.
[[nodiscard]] std::string ShortPathData(std::string_view data);

/// Shorten the path data of all paths of a document (ShortPathData).
[[nodiscard]] std::string ShortenPaths(std::string_view svg);

}  // namespace regrasp::render
