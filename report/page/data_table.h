#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/markup.h"

namespace regrasp::report {

/// Number of rows that a page with scripts reads and shows first.
/// More rows open slowly in browsers.
inline constexpr std::size_t kFirstRows = 500;

/// A table of many rows, which a script sorts, searches and filters (data_table.js).
///
/// The script requires DataTableScript in the page. Without scripts, all rows are a plain table in
/// their given order. The script reads these attributes:
///
/// - head cell, class "number": sort the column as numbers; other columns are sorted as text.
/// - head cell, data-filter="NAME": select element with the values of the column, id filter-NAME.
/// - cell, data-value: value for sorting and filtering that replaces the text.
/// - row, data-also: further value by which the first filter finds the row.
/// - row, id="NAME=KEY": the link #NAME=KEY shows the row. The links #before=KEY and #after=KEY
///   open the page that the next row above or below links to.
struct DataTable {
  std::string id;             ///< id of the table
  std::string noun;           ///< plural noun of the rows: "plans"
  Element head;               ///< element tr with the head cells
  std::vector<Element> rows;  ///< elements tr
};

/// Return the elements of the table. Rows after the first kFirstRows are in an element noscript,
/// which the script reads in parts.
[[nodiscard]] std::vector<Element> MakeDataTable(const DataTable& table);

/// Return the script and the style sheet of the table, for FormatHtmlPage.
[[nodiscard]] std::string_view DataTableScript();
[[nodiscard]] std::string_view DataTableStyle();

/// Return the head of a column with a filter.
/// @param filter  name of the filter (DataTable).
[[nodiscard]] Element FilterHeadCell(std::string_view name, std::string_view filter);

/// Return a cell that is sorted by a value other than its text.
/// @param value  number or text, as in FormatShort.
[[nodiscard]] Element ValueCell(std::string_view value, std::string_view text,
                                std::string_view style = "number");

}  // namespace regrasp::report
