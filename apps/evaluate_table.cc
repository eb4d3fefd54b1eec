#include "apps/evaluate_table.h"

#include <cstddef>
#include <optional>
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

/// Append the rows of a confusion table.
void AddConfusion(const std::string& title,
                  const std::map<std::string, EvaluateCounts::Confusion>& by,
                  std::vector<TextRow>& rows) {
  rows.push_back({title, "pass, claimed", "fail, claimed", "pass, not claimed", "fail, not claimed",
                  "pass, no claim", "fail, no claim"});
  for (const auto& [name, confusion] : by) {
    TextRow row = {name};
    for (const auto& claim : confusion.counts) {
      for (const std::int64_t count : claim) row.push_back(std::to_string(count));
    }
    rows.push_back(row);
  }
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
  std::vector<TextRow> protocols;
  AddConfusion("protocol", counts.by_protocol, protocols);
  std::vector<TextRow> objects;
  AddConfusion("object", counts.by_object, objects);
  return (reasons.size() > 1 ? FormatRows(reasons) : "") + FormatRows(protocols) +
         FormatRows(objects);
}

}  // namespace regrasp::apps
