#include "report/condition_table.h"

#include <vector>

#include "planner/base/number.h"
#include "planner/base/text_table.h"
#include "report/report_json.h"

namespace regrasp::report {
namespace {

constexpr int kShareDigits = 3;
constexpr int kEndDigits = 2;
constexpr double kMillimetres = 1e3;

std::string PercentText(double share) { return FormatShort(100 * share, kShareDigits) + " %"; }

std::string OfAllText(int count, const sim::ConditionSummary& summary) {
  return std::to_string(count) + " of " + std::to_string(summary.applicable());
}

const char* VerdictOf(const sim::ConditionResult& result) {
  if (!result.applies) return "skipped";
  return result.passed() ? "pass" : "fail";
}

Json ResultJson(const sim::ConditionResult& result) {
  Json json = {{"name", result.condition.name},
               {"changes", ParseJson(result.condition.changes, result.condition.name)},
               {"verdict", VerdictOf(result)},
               {"step", IndexOrNull(result.failed)},
               {"reason", TextOrNull(plan::ReasonName(result.reason))},
               {"detail", TextOrNull(result.detail)}};
  if (!result.applies) return json;
  json["reaches_end"] = result.reaches_end;
  json["ends_within"] = result.ends_within;
  json["displacement_m"] = result.end_m;
  json["rotation_deg"] = Degrees(result.end_rad);
  json["margin"] = result.margin;
  return json;
}

TextRow MakeConditionRow(const sim::ConditionResult& result) {
  constexpr char kNone[] = "-";
  if (!result.applies) {
    return {result.condition.name, kNone, kNone, kNone, kNone, kNone, "not applicable"};
  }
  return {result.condition.name,
          result.failed.valid() ? std::to_string(result.failed) : kNone,
          FormatShort(kMillimetres * result.end_m, kEndDigits),
          FormatShort(Degrees(result.end_rad), kEndDigits),
          result.ends_within ? "yes" : "no",
          FormatShort(result.margin, kEndDigits),
          ConditionVerdictText(result)};
}

}  // namespace

Json ConditionsJson(const sim::ConditionSummary& summary) {
  Json results = Json::array();
  for (const sim::ConditionResult& result : summary.results) results.push_back(ResultJson(result));
  return {{"verdict", summary.enough() ? "pass" : "fail"},
          {"required", OrNull(summary.required)},
          {"applicable", summary.applicable()},
          {"passed", summary.passed()},
          {"ended_within", summary.ended_within()},
          {"share", summary.share()},
          {"results", results}};
}

std::string ConditionVerdictText(const sim::ConditionResult& result) {
  return result.applies ? ReasonText(result.reason) : "not applicable";
}

std::string ConditionsPassText(const sim::ConditionSummary& summary) {
  return "under " + OfAllText(summary.passed(), summary) + " conditions";
}

std::string ConditionsShareText(const sim::ConditionSummary& summary) {
  return OfAllText(summary.passed(), summary) + " pass, " +
         OfAllText(summary.ended_within(), summary) + " end within the tolerance" +
         (summary.required ? "; required " + PercentText(*summary.required) : "");
}

std::string ConditionsFailureText(const sim::ConditionSummary& summary) {
  const int failed = summary.applicable() - summary.passed();
  if (failed == 0) return "";
  std::string text = OfAllText(failed, summary) + " conditions fail";
  const char* between = ": ";
  for (const sim::ConditionResult& result : summary.results) {
    if (!result.applies || result.passed()) continue;
    text +=
        between + result.condition.name + " (" + std::string(plan::ReasonName(result.reason)) + ")";
    between = ", ";
  }
  return text;
}

std::string ConditionsRequiredText(const sim::ConditionSummary& summary) {
  const auto [share, required] =
      FormatWithLimit(100 * summary.share(), 100 * summary.required.value_or(0), kShareDigits);
  return OfAllText(summary.passed(), summary) + " conditions pass (" + share +
         " %), --require requires " + required + " %";
}

std::string FormatConditionTable(const Report& report) {
  if (!report.conditions) return "";
  std::vector<TextRow> rows = {
      {"condition", "step", "end_mm", "end_deg", "ends_within", "margin", "verdict"}};
  for (const sim::ConditionResult& result : report.conditions->results) {
    rows.push_back(MakeConditionRow(result));
  }
  return FormatRows(rows) + "conditions: " + ConditionsShareText(*report.conditions) + "\n";
}

}  // namespace regrasp::report
