#include "report/page/table.h"

namespace regrasp::report {

Element HeadCell(std::string_view name, std::string_view style) {
  return Element("th", {{"scope", "col"}, {"class", std::string(style)}}, name);
}

std::vector<Element> HeadCells(const std::vector<std::string_view>& names) {
  std::vector<Element> cells;
  for (const std::string_view name : names) cells.push_back(HeadCell(name));
  return cells;
}

Element NumberCell(std::string_view text) { return Element("td", {{"class", "number"}}, text); }

Element ScrolledTable(const std::vector<Element>& head, const std::vector<Element>& rows) {
  const Element table("table", {}, Element("thead", {}, Element("tr", {}, head)),
                      Element("tbody", {}, rows));
  return Element("div", {{"class", "scroll"}}, table);
}

Element Figure(const Attributes& attributes, const Element& picture, std::string_view name,
               const std::string& text) {
  return Element("figure", attributes, picture,
                 Element("figcaption", {}, Element("b", {}, name), " " + text));
}

Element Note(std::string_view text) { return Element("p", {{"class", "note"}}, text); }

}  // namespace regrasp::report
