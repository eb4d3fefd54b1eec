#include "apps/evaluate_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/line_records.h"
#include "planner/base/json.h"
#include "planner/base/text_table.h"
#include "planner/plan/json_reader.h"

namespace regrasp::apps {

namespace {

/// Return the index of a claim in Confusion.
std::size_t ClaimOf(const Json& json) {
  const auto claimed = json.find("claimed");
  if (claimed == json.end() || !claimed->is_boolean()) return 2;
  return claimed->get<bool>() ? 0 : 1;
}

void CountReport(const Line& line, EvaluateCounts& counts) {
  const Json json = ParseJson(line.text, line.name);
  const plan::JsonReader reader(json, line.name);
  const std::size_t claim = ClaimOf(json);
  const auto measured = [](const plan::JsonReader& verdict) -> std::size_t {
    return verdict.Member("verdict").String() == "pass" ? 0 : 1;
  };
  ++counts.by_object[reader.Member("object").Member("file").String()]
        .counts[claim][measured(reader)];
  for (const plan::JsonReader& result : reader.Member("protocols").Elements()) {
    ++counts.by_protocol[result.Member("protocol").String()].counts[claim][measured(result)];
  }
  if (reader.Has("reason")) ++counts.by_reason[reader.Member("reason").String()];
}

/// Names of the claims, in the order of Confusion.
constexpr std::array kClaims = {"claimed success", "claimed failure", "no claim"};

/// Format a confusion table: a row per name, and two columns per claim that a grasp makes.
/// @returns an empty text if there are no rows.
std::string ConfusionTable(const std::string& title,
                           const std::map<std::string, EvaluateCounts::Confusion>& by) {
  if (by.empty()) return "";
  std::vector<TextRow> rows = {{title}};
  for (const auto& [name, confusion] : by) rows.push_back({name});
  for (std::size_t claim = 0; claim < kClaims.size(); ++claim) {
    const auto has_claim = [&](const auto& row) {
      const auto& counts = row.second.counts[claim];
      return counts[0] > 0 || counts[1] > 0;
    };
    if (std::ranges::none_of(by, has_claim)) continue;
    rows[0].push_back(std::string(kClaims[claim]) + ": pass");
    rows[0].push_back("fail");
    std::size_t row = 1;
    for (const auto& [name, confusion] : by) {
      for (const std::int64_t count : confusion.counts[claim]) {
        rows[row].push_back(std::to_string(count));
      }
      ++row;
    }
  }
  return FormatRows(rows);
}

}  // namespace

EvaluateCounts ReadEvaluateCounts(const std::filesystem::path& path) {
  EvaluateCounts counts;
  LinesInput input(path);
  while (const std::optional<Line> line = input.Next()) {
    const std::optional<Outcome> outcome = OutcomeOf(line->text, line->entry);
    if (outcome == Outcome::kPass || outcome == Outcome::kFail) CountReport(*line, counts);
  }
  return counts;
}

std::string FormatEvaluateTable(const EvaluateCounts& counts) {
  std::vector<TextRow> reasons = {{"reason", "grasps"}};
  for (const auto& [reason, count] : counts.by_reason) {
    reasons.push_back({reason, std::to_string(count)});
  }
  return (reasons.size() > 1 ? FormatRows(reasons) : "") +
         ConfusionTable("protocol", counts.by_protocol) +
         ConfusionTable("object", counts.by_object);
}

}  // namespace regrasp::apps
