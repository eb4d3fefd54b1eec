#include "report/page/data_table.h"

#include <algorithm>
#include <span>

#include "data_table_files.h"

namespace regrasp::report {

namespace {

/// Return a table that scrolls by itself, with its rows in bodies of at most kFirstRows.
/// The script takes one body at a time from an element noscript.
Element RowsTable(Attributes attributes, const Element& head, std::span<const Element> rows) {
  attributes.emplace_back("class", "data");
  Element table("table", attributes, Element("thead", {}, head));
  do {
    const std::span<const Element> part = rows.first(std::min(kFirstRows, rows.size()));
    table.Add(Element("tbody", {}, std::vector<Element>(part.begin(), part.end())));
    rows = rows.subspan(part.size());
  } while (!rows.empty());
  return Element("div", {{"class", "scroll"}}, table);
}

}  // namespace

std::vector<Element> MakeDataTable(const DataTable& table) {
  const std::span<const Element> rows(table.rows);
  const std::size_t first = std::min(kFirstRows, rows.size());
  std::vector<Element> parts = {RowsTable(
      {{"id", table.id}, {"data-noun", table.noun}, {"data-count", std::to_string(rows.size())}},
      table.head, rows.first(first))};
  if (first < rows.size()) {
    parts.emplace_back("noscript", Attributes{{"id", table.id + "-rest"}},
                       RowsTable({}, table.head, rows.subspan(first)));
  }
  return parts;
}

std::string_view DataTableScript() { return kDataTableScript; }

std::string_view DataTableStyle() { return kDataTableStyle; }

Element FilterHeadCell(std::string_view name, std::string_view filter) {
  return Element("th", {{"scope", "col"}, {"data-filter", std::string(filter)}}, name);
}

Element ValueCell(std::string_view value, std::string_view text, std::string_view style) {
  Attributes attributes;
  if (!style.empty()) attributes.emplace_back("class", style);
  attributes.emplace_back("data-value", value);
  return Element("td", attributes, text);
}

}  // namespace regrasp::report
