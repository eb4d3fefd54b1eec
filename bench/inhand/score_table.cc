#include "bench/inhand/score_table.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "bench/spread.h"
#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::bench {
namespace {

constexpr std::string_view kBegin = "<!-- scoreboard: begin -->\n";
constexpr std::string_view kEnd = "<!-- scoreboard: end -->\n";

using Rows = std::vector<Row>;

/// Return the distinct values of rows, in the order of their first occurrence.
std::vector<std::string> Different(const Rows& rows,
                                   const std::function<std::string(const Row&)>& of) {
  std::vector<std::string> values;
  for (const Row& row : rows) {
    if (std::ranges::find(values, of(row)) == values.end()) values.push_back(of(row));
  }
  return values;
}

Rows Those(const Rows& rows, const std::function<bool(const Row&)>& in) {
  Rows those;
  std::ranges::copy_if(rows, std::back_inserter(those), in);
  return those;
}

std::string ContenderOf(const Row& row) {
  return row.planner == Row().planner ? row.hand : row.hand + ", " + row.planner;
}

/// Return the median and the maximum over the rows that have the number.
std::string MedianOf(const Rows& rows,
                     const std::function<std::optional<double>(const Row&)>& number, int digits,
                     bool with_worst) {
  std::vector<double> values;
  for (const Row& row : rows) {
    if (const auto value = number(row)) values.push_back(*value);
  }
  if (values.empty()) return "–";
  const std::string median = FormatFixed(Median(values), digits);
  return with_worst ? median + ", " + FormatFixed(Largest(values), digits) : median;
}

std::string FailuresOf(const Rows& rows) {
  std::map<std::string, int> reasons;
  for (const Row& row : rows) {
    if (!row.passed) ++reasons[row.reason];
  }
  std::string text;
  for (const auto& [reason, count] : reasons) {
    text += (text.empty() ? "" : ", ") + reason + " " + std::to_string(count);
  }
  return text.empty() ? "–" : text;
}

std::string LineOf(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) line += " " + cell + " |";
  return line + "\n";
}

std::string HeadOf(const std::vector<std::string>& cells) {
  return LineOf(cells) + LineOf(std::vector<std::string>(cells.size(), "---"));
}

std::string SummaryLine(const std::string& contender, const Rows& rows) {
  const Rows found = Those(rows, [](const Row& row) { return row.found; });
  const Rows passed = Those(rows, [](const Row& row) { return row.passed; });
  const auto median = [&](auto number, int digits) {
    return MedianOf(found, number, digits, false);
  };
  const auto error_mm = [](const Row& row) -> std::optional<double> {
    return row.error ? std::optional(1e3 * row.error->metres) : std::nullopt;
  };
  const auto error_deg = [](const Row& row) -> std::optional<double> {
    return row.error ? std::optional(Degrees(row.error->radians)) : std::nullopt;
  };
  const std::string of_all = " of " + std::to_string(rows.size());
  return LineOf({contender, std::to_string(found.size()) + of_all,
                 std::to_string(passed.size()) + of_all,
                 median([](const Row& row) { return row.seconds; }, 1),
                 median([](const Row& row) { return std::optional<double>(row.switches); }, 1),
                 median([](const Row& row) { return std::optional<double>(row.moves); }, 1),
                 MedianOf(passed, error_mm, 3, true), MedianOf(passed, error_deg, 3, true),
                 FailuresOf(rows)});
}

std::string SummaryTable(const Rows& rows, const std::vector<std::string>& contenders) {
  std::string text = HeadOf({"hand", "found", "pass", "time, s", "switches", "moves",
                             "error, mm: median, worst", "error, degrees", "failures"});
  for (const std::string& contender : contenders) {
    text += SummaryLine(contender,
                        Those(rows, [&](const Row& row) { return ContenderOf(row) == contender; }));
  }
  return text;
}

/// Return the time limit as text: "At most 8 s to plan a task."
std::string LimitsText(const Rows& rows) {
  std::string text;
  for (const std::string& limit : Different(rows, [](const Row& row) {
         return row.limit_s ? FormatShort(*row.limit_s) + " s" : "";
       })) {
    if (!limit.empty()) text += (text.empty() ? "At most " : " or ") + limit;
  }
  return text.empty() ? "" : text + " of processor time to plan a task.\n\n";
}

std::string TaskTable(const Rows& rows, const std::vector<std::string>& contenders) {
  std::vector<std::string> columns = {"task"};
  columns.insert(columns.end(), contenders.begin(), contenders.end());
  std::string text = HeadOf(columns);
  for (const std::string& task : Different(rows, [](const Row& row) { return row.task; })) {
    std::vector<std::string> cells = {task};
    for (const std::string& contender : contenders) {
      const auto found = std::ranges::find_if(
          rows, [&](const Row& row) { return row.task == task && ContenderOf(row) == contender; });
      const bool is_there = found != rows.end();
      cells.push_back(!is_there ? "" : found->passed ? "pass" : found->reason);
    }
    text += LineOf(cells);
  }
  return text;
}

}  // namespace

std::string ScoreTables(const std::vector<Row>& rows, const std::vector<Task>& tasks) {
  Rows sorted = rows;
  const auto place = [&](const Row& row) {
    return std::ranges::find(tasks, row.task, &Task::name) - tasks.begin();
  };
  std::ranges::stable_sort(sorted, {}, place);
  // Order of the hands in the run, regardless of which task ended first.
  const std::vector<std::string> all = Different(rows, ContenderOf);
  std::string text;
  for (const std::string& group : Different(sorted, [](const Row& row) { return row.group; })) {
    const Rows of_group = Those(sorted, [&](const Row& row) { return row.group == group; });
    const std::vector<std::string> there = Different(of_group, ContenderOf);
    std::vector<std::string> contenders;
    std::ranges::copy_if(all, std::back_inserter(contenders), [&](const std::string& name) {
      return std::ranges::find(there, name) != there.end();
    });
    text += "### " + group + "\n\n" + LimitsText(of_group) + SummaryTable(of_group, contenders) +
            "\n<details><summary>Every task</summary>\n\n" + TaskTable(of_group, contenders) +
            "\n</details>\n\n";
  }
  return text;
}

std::string ReplaceBetweenMarkers(std::string_view text, std::string_view between,
                                  const std::string& name) {
  const std::size_t begin = text.find(kBegin);
  const std::size_t end = text.find(kEnd, begin == std::string_view::npos ? 0 : begin);
  if (begin == std::string_view::npos || end == std::string_view::npos) {
    throw InputError(name + ": has no lines \"" + std::string(kBegin.substr(0, kBegin.size() - 1)) +
                     "\" and \"" + std::string(kEnd.substr(0, kEnd.size() - 1)) + "\"");
  }
  return std::string(text.substr(0, begin + kBegin.size())) + "\n" + std::string(between) +
         std::string(text.substr(end));
}

}  // namespace regrasp::bench
