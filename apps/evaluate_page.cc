#include "apps/evaluate_page.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "apps/evaluate_reasons.h"
#include "apps/evaluate_rows.h"
#include "apps/evaluate_table.h"
#include "planner/base/number.h"
#include "report/page/data_table.h"
#include "report/page/html_page.h"
#include "report/page/step_table.h"

namespace regrasp::apps {

namespace {

using report::Element;

constexpr char kMissing[] = "–";

/// Return the place of a verdict on the page: grasps that fail are first.
int PlaceOf(const std::string& verdict) {
  if (verdict == "fail") return 0;
  return verdict == "pass" ? 2 : 1;
}

std::string TextOrDash(const std::string& text) { return text.empty() ? kMissing : text; }

std::string FixedOrDash(const std::optional<double>& value, int decimals) {
  return value ? FormatFixed(*value, decimals) : kMissing;
}

/// Return the result of a protocol with its measured values.
std::string ResultText(const ProtocolCell& cell) {
  if (cell.verdict.empty()) return kMissing;
  std::vector<std::string> values;
  if (!cell.reason.empty()) values.push_back(cell.reason);
  if (cell.quality) values.push_back("ε " + FormatShort(*cell.quality, 3));
  if (cell.moved_mm) values.push_back(FormatFixed(*cell.moved_mm, 1) + " mm");
  if (cell.rotated_deg) values.push_back(FormatFixed(*cell.rotated_deg, 1) + "°");
  if (cell.seconds) values.push_back(FormatFixed(*cell.seconds, 2) + " s");
  if (cell.resisted_N) values.push_back(FormatShort(*cell.resisted_N, 3) + " N");
  std::string text = cell.verdict;
  for (const std::string& value : values) text += (&value == values.data() ? ": " : ", ") + value;
  return text;
}

/// The columns of the table; only those that a row has a value for.
class GraspTableColumns {
 public:
  void Add(const GraspRow& row) {
    hand_ |= !row.hand.empty();
    set_ |= !row.set.empty();
    claimed_ |= row.claimed.has_value();
    score_ |= row.score.has_value();
    cause_ |= !row.likely_cause.empty();
    for (std::size_t i = 0; i < kProtocolNames.size(); ++i) {
      tested_[i] |= !row.results[i].verdict.empty();
    }
  }

  [[nodiscard]] Element Head() const {
    Element head("tr");
    ForEach({}, [&](std::string_view name, const std::string&, bool is_number) {
      const bool is_text = name == "reason" || name == "likely cause";
      head.Add(name == "verdict" ? report::FilterHeadCell(name, "verdict")
                                 : report::HeadCell(name, is_number ? "number"
                                                          : is_text ? "text"
                                                                    : ""));
    });
    return head;
  }

  /// Return the names of columns as a style sheet, for the cards of narrow screens.
  [[nodiscard]] std::string NamesOfCards() const {
    std::string style = "@media screen and (max-width: 40rem) {\n";
    int column = 0;
    ForEach({}, [&](std::string_view name, const std::string&, bool) {
      style += "#grasps td:nth-child(" + std::to_string(++column) + ")::before { content: \"" +
               std::string(name) + " \" }\n";
    });
    return style + "}\n";
  }

  [[nodiscard]] Element Row(const GraspRow& row, const std::string& images) const {
    report::Attributes attributes = {{"class", row.verdict == "pass" ? "pass" : "fail"}};
    if (row.differs_from_claim()) attributes.emplace_back("data-also", "claim differs");
    Element line("tr", attributes);
    ForEach(row, [&](std::string_view name, const std::string& text, bool is_number) {
      if (name == "grasp" && !images.empty() && row.distance_mm) {
        const std::string file = images + "/" + GraspImageName(row.index);
        line.Add(Element("td", {}, Element("a", {{"href", report::PathUri(file)}}, text)));
      } else if (is_number) {
        line.Add(report::NumberCell(text));
      } else if (name == "verdict") {
        line.Add(Element("td", {{"class", "outcome"}}, text));
      } else {
        line.Add(Element("td", {}, text));
      }
    });
    return line;
  }

 private:
  /// Call visit(name, text, is_number) for each column.
  template <class Visit>
  void ForEach(const GraspRow& row, const Visit& visit) const {
    visit("no.", std::to_string(row.index), true);
    visit("grasp", TextOrDash(row.id), false);
    if (set_) visit("data set", TextOrDash(row.set), false);
    visit("object", TextOrDash(row.object), false);
    visit("scale", row.scale ? FormatShort(*row.scale) : kMissing, true);
    if (hand_) visit("hand", TextOrDash(row.hand), false);
    visit("verdict", row.verdict, false);
    if (claimed_) {
      visit("claimed", row.claimed ? (*row.claimed ? "success" : "failure") : kMissing, false);
    }
    if (score_) visit("score", row.score ? FormatShort(*row.score) : kMissing, true);
    visit("reason", TextOrDash(row.reason), false);
    if (cause_) visit("likely cause", TextOrDash(row.likely_cause), false);
    visit("penetration, mm", FixedOrDash(row.depth_mm(), 2), true);
    visit("contacts per link", TextOrDash(row.contacts()), false);
    for (std::size_t i = 0; i < kProtocolNames.size(); ++i) {
      if (tested_[i]) visit(kProtocolNames[i], ResultText(row.results[i]), false);
    }
  }

  bool hand_ = false, set_ = false, claimed_ = false, score_ = false, cause_ = false;
  std::array<bool, kProtocolNames.size()> tested_ = {};
};

/// The rows that a page shows: those that fail first, in file order.
struct PageRows {
  std::vector<GraspRow> rows;
  std::map<std::string, std::int64_t> by_verdict;
  GraspTableColumns columns;
  std::int64_t count = 0;

  explicit PageRows(const std::filesystem::path& reports) {
    const auto is_before = [](const GraspRow& a, const GraspRow& b) {
      return std::tuple(PlaceOf(a.verdict), a.index) < std::tuple(PlaceOf(b.verdict), b.index);
    };
    ReadGraspRows(reports, [&](GraspRow row) {
      ++count;
      ++by_verdict[row.verdict];
      columns.Add(row);
      rows.push_back(std::move(row));
      if (rows.size() < 2 * kMostPageRows) return;
      std::ranges::sort(rows, is_before);
      rows.resize(kMostPageRows);
    });
    std::ranges::sort(rows, is_before);
    if (rows.size() > kMostPageRows) rows.resize(kMostPageRows);
  }
};

Element CountsTable(const std::vector<TextRow>& texts) {
  Element head("tr"), body("tbody");
  for (const std::string& name : texts.front()) {
    head.Add(report::HeadCell(name, &name == texts.front().data() ? "" : "number"));
  }
  for (std::size_t i = 1; i < texts.size(); ++i) {
    Element line("tr", {}, Element("td", {}, texts[i].front()));
    for (std::size_t k = 1; k < texts[i].size(); ++k) line.Add(report::NumberCell(texts[i][k]));
    body.Add(line);
  }
  return Element("div", {{"class", "scroll"}},
                 Element("table", {{"class", "counts"}}, Element("thead", {}, head), body));
}

/// Return text of the failure reasons without marks of code.
std::string PlainText(std::string_view text) {
  std::string plain(text);
  std::erase(plain, '`');
  return plain;
}

/// Return a list of the remedies, which are separated by line ends.
Element RemedyList(std::string_view remedies) {
  Element list("ul");
  while (!remedies.empty()) {
    const std::size_t end = std::min(remedies.find('\n'), remedies.size());
    list.Add(Element("li", {}, PlainText(remedies.substr(0, end))));
    remedies.remove_prefix(std::min(end + 1, remedies.size()));
  }
  return list;
}

/// Return the section on the grasps that fail: reasons with meaning and remedies, most grasps
/// first.
std::vector<Element> MakeReasonSection(const std::map<std::string, std::int64_t>& by_reason) {
  if (by_reason.empty()) return {};
  std::vector<std::pair<std::string, std::int64_t>> reasons(by_reason.begin(), by_reason.end());
  std::ranges::stable_sort(reasons, std::ranges::greater(),
                           &std::pair<std::string, std::int64_t>::second);
  const Element head("tr", {}, report::HeadCell("reason", ""), report::HeadCell("grasps"),
                     report::HeadCell("meaning", ""), report::HeadCell("remedies", ""));
  Element body("tbody");
  std::int64_t failed = 0;
  for (const auto& [name, count] : reasons) {
    failed += count;
    Element line("tr", {}, Element("td", {}, name), report::NumberCell(std::to_string(count)));
    const auto known = std::ranges::find(EvaluateReasons(), name, &plan::FailureReason::name);
    const bool is_known = known != EvaluateReasons().end();
    line.Add(Element("td", {}, is_known ? PlainText(known->meaning) : kMissing));
    line.Add(is_known ? Element("td", {}, RemedyList(known->remedies))
                      : Element("td", {}, kMissing));
    body.Add(line);
  }
  return {
      Element("h2", {}, "Reasons for failure"),
      report::Note("Discard the grasps that fail (" + std::to_string(failed) +
                   "), unless a remedy applies. If most grasps of an object or of a hand fail "
                   "for the same reason, first check its scale, frame and conventions."),
      Element("div", {{"class", "scroll"}},
              Element("table", {{"class", "counts reasons"}}, Element("thead", {}, head), body))};
}

std::string Summary(const PageRows& rows) {
  std::string text = std::to_string(rows.count) + " grasps";
  for (const auto& [verdict, count] : rows.by_verdict) {
    text += (verdict == rows.by_verdict.begin()->first ? ": " : ", ") + std::to_string(count) +
            " " + verdict;
  }
  return text + ".";
}

}  // namespace

std::string GraspImageName(std::int64_t index) {
  constexpr std::size_t kDigits = 6;
  std::string number = std::to_string(index);
  if (number.size() < kDigits) number.insert(0, kDigits - number.size(), '0');
  return number + ".png";
}

bool IsGraspImageName(const std::string& name) {
  constexpr std::string_view kEnding = ".png";
  if (!name.ends_with(kEnding)) return false;
  const std::string_view number = std::string_view(name).substr(0, name.size() - kEnding.size());
  return !number.empty() && number.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string FormatGraspPage(const std::filesystem::path& reports, const GraspPage& page) {
  const PageRows rows(reports);
  const auto passed = rows.by_verdict.find("pass");
  const bool all_pass = passed != rows.by_verdict.end() && passed->second == rows.count;
  std::vector<Element> parts = {
      report::PageHeader("Evaluation of hand grasps", page.grasps, all_pass, Summary(rows))};
  EvaluateCounts counts = ReadEvaluateCounts(reports);
  for (const Element& part : MakeReasonSection(counts.by_reason)) parts.push_back(part);
  counts.by_reason.clear();
  const std::vector<std::vector<TextRow>> tables = EvaluateTables(counts);
  if (!tables.empty()) parts.push_back(Element("h2", {}, "Pass and fail"));
  for (const std::vector<TextRow>& table : tables) parts.push_back(CountsTable(table));
  parts.push_back(Element("h2", {}, "Grasps"));
  if (rows.count > static_cast<std::int64_t>(rows.rows.size())) {
    parts.push_back(report::Note("The table has the first " + std::to_string(rows.rows.size()) +
                                 " grasps, those that fail first. The file of reports and the CSV "
                                 "file have all."));
  }
  report::DataTable table{"grasps", "grasps", rows.columns.Head(), {}};
  for (const GraspRow& row : rows.rows) table.rows.push_back(rows.columns.Row(row, page.images));
  for (const Element& part : report::MakeDataTable(table)) parts.push_back(part);
  const std::array scripts = {report::DataTableScript()};
  return report::FormatHtmlPage(
      "Evaluation of " + page.grasps, parts, report::PictureSource::kInPage, scripts,
      std::string(report::DataTableStyle()) + rows.columns.NamesOfCards());
}

}  // namespace regrasp::apps
