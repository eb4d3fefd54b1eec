#include "report/stress_table.h"

#include "planner/base/number.h"
#include "planner/base/text_table.h"
#include "sim/measure/push.h"

namespace regrasp::report {
namespace {

std::string Percent(double share) { return FormatShort(100 * share, 2); }

/// "+x" of a force, "t+x" of a torque.
std::string ShortName(const sim::Push& push) {
  return std::string(push.turn ? "t" : "") + (push.sign > 0 ? "+" : "-") + "xyz"[push.axis];
}

}  // namespace

std::optional<WeakestPush> FindWeakestPush(const Report& report) {
  std::optional<WeakestPush> weakest;
  for (const ReportStep& step : report.steps) {
    if (!step.replay || step.skipped) continue;
    for (const sim::DirectionStress& stress : step.replay->stress) {
      if (weakest && stress.replay >= weakest->stress.replay) continue;
      weakest = WeakestPush{step.check.index, stress};
    }
  }
  return weakest;
}

std::string FormatStressTable(const Report& report) {
  const auto weakest = FindWeakestPush(report);
  if (!weakest) return "";
  std::vector<TextRow> rows = {{"step"}};
  for (const sim::Push& push : sim::PushDirections(report.dimension)) {
    rows.front().push_back(ShortName(push));
  }
  for (const ReportStep& step : report.steps) {
    if (!step.replay || step.skipped || step.replay->stress.empty()) continue;
    TextRow row = {std::to_string(step.check.index)};
    for (const sim::DirectionStress& stress : step.replay->stress)
      row.push_back(Percent(stress.replay));
    rows.push_back(row);
  }
  return "largest push (t: turn) in percent of the squeeze:\n" + FormatRows(rows) + "least: step " +
         std::to_string(weakest->step) + ", " + sim::PushName(weakest->stress.push) + ", " +
         Percent(weakest->stress.replay) + " % in the replay, " +
         Percent(weakest->stress.analysis) + " % by analysis\n";
}

}  // namespace regrasp::report
