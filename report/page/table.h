#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/markup.h"

namespace regrasp::report {

/// A column's head; numbers stand to the right.
/// @param style  classes, "number" or "number minor"; may be empty.
[[nodiscard]] Element HeadCell(std::string_view name, std::string_view style = "number");

/// Heads of columns of numbers.
[[nodiscard]] std::vector<Element> HeadCells(const std::vector<std::string_view>& names);

[[nodiscard]] Element NumberCell(std::string_view text);

/// A table that is scrolled by itself where it is wider than the page.
/// @param head  cells of the first row.
/// @param rows  elements tr.
[[nodiscard]] Element ScrolledTable(const std::vector<Element>& head,
                                    const std::vector<Element>& rows);

/// A picture with its caption, which begins with a name in bold.
[[nodiscard]] Element Figure(const Attributes& attributes, const Element& picture,
                             std::string_view name, const std::string& text);

/// What a reader of a table or of pictures has to know.
[[nodiscard]] Element Note(std::string_view text);

}  // namespace regrasp::report
