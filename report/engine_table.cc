#include "report/engine_table.h"

#include "planner/base/number.h"
#include "planner/base/text_table.h"
#include "report/report_json.h"

namespace regrasp::report {
namespace {

constexpr int kEngineDigits = 2;
constexpr double kEngineMillimetres = 1e3;

}  // namespace

std::string FormatEngineTable(const validation::Report& report) {
  const std::vector<validation::EngineResult> results = validation::EngineResultsOf(report);
  if (results.empty()) return "";
  std::vector<TextRow> rows = {
      {"engine", "step", "displacement_mm", "rotation_deg", "margin", "verdict"}};
  for (const validation::EngineResult& result : results) {
    rows.push_back({result.engine, result.passed ? "-" : std::to_string(result.failed),
                    FormatShort(kEngineMillimetres * result.off_m, kEngineDigits),
                    FormatShort(Degrees(result.off_rad), kEngineDigits),
                    FormatShort(result.margin, kEngineDigits), result.passed ? "pass" : "fail"});
  }
  return FormatRows(rows);
}

Json EngineResultsJson(const std::vector<validation::EngineResult>& results) {
  Json json = Json::array();
  for (const validation::EngineResult& result : results) {
    json.push_back({{"engine", result.engine},
                    {"verdict", result.passed ? "pass" : "fail"},
                    {"step", IndexOrNull(result.failed)},
                    {"detail", TextOrNull(result.detail)},
                    {"displacement_m", result.off_m},
                    {"rotation_deg", Degrees(result.off_rad)},
                    {"margin", result.margin}});
  }
  return json;
}

}  // namespace regrasp::report
