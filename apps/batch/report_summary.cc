#include "apps/batch/report_summary.h"

#include <algorithm>

#include "planner/base/file.h"
#include "planner/plan/json_reader.h"

namespace regrasp::apps {

namespace {

std::string TextOrNothing(const plan::JsonReader& parent, const char* key) {
  if (!parent.Has(key)) return "";
  const plan::JsonReader member = parent.Member(key);
  return member.IsNull() ? "" : member.String();
}

ReportSummary::Entry ReadEntry(const plan::JsonReader& step) {
  return {step.Member("kind").OneOf({"hold", "switch", "align", "move"}),
          step.Member("verdict").OneOf({"pass", "fail", "skipped"}),
          TextOrNothing(step, "reason"),
          TextOrNothing(step, "detail"),
          TextOrNothing(step, "frame"),
          TextOrNothing(step, "why"),
          TextOrNothing(step, "mend")};
}

void ReadSubject(const plan::JsonReader& root, ReportSummary& summary) {
  if (root.Has("object")) {
    summary.object = TextOrNothing(root.Member("object"), "file");
    summary.size = TextOrNothing(root.Member("object"), "measures");
  }
  if (root.Has("plan") && !root.Member("plan").IsNull()) {
    summary.planner = TextOrNothing(root.Member("plan"), "planner");
  }
  if (root.Has("settings")) {
    summary.friction_angle_deg = root.Member("settings").Member("friction_half_angle_deg").Number();
  }
}

/// Read how many of several replays pass.
/// @param count  name of the member with their number.
ReportSummary::Trials ReadCounts(const plan::JsonReader& json, const char* count, int least) {
  constexpr int kMost = 1'000'000'000;
  ReportSummary::Trials read;
  read.count = json.Member(count).Integer(least, kMost);
  read.passed = json.Member("passed").Integer(0, read.count);
  read.detail = TextOrNothing(json, "detail");
  read.why = TextOrNothing(json, "why");
  read.suggested_fix = TextOrNothing(json, "mend");
  read.enough = json.Member("verdict").OneOf({"pass", "fail"}) == "pass";
  return read;
}

void ReadRun(const plan::JsonReader& run, ReportSummary& summary) {
  summary.run = run.Member("sha256").String();
  if (!run.Has("files")) return;
  for (const plan::JsonReader& file : run.Member("files").Elements()) {
    summary.files.push_back({file.Member("file").String(), file.Member("sha256").String()});
  }
}

}  // namespace

std::optional<int> ReportSummary::failed_step() const {
  const auto failed = std::ranges::find(entries, "fail", &Entry::verdict);
  if (failed == entries.end()) return std::nullopt;
  return static_cast<int>(failed - entries.begin());
}

std::optional<report::Failure> ReportSummary::failure() const {
  if (const std::optional<int> step = failed_step()) {
    const Entry& entry = entries[*step];
    return report::Failure{
        plan::EntryIndex(*step), entry.kind, entry.reason, entry.detail, entry.why,
        entry.suggested_fix};
  }
  if (!passed && conditions && !conditions->enough && (!trials || trials->enough)) {
    return report::Failure{plan::EntryIndex(), "conditions",    report::kConditionsFailed,
                           conditions->detail, conditions->why, conditions->suggested_fix};
  }
  if (passed || !trials) return std::nullopt;
  return report::Failure{plan::EntryIndex(), "trials",    report::kTrialsFailed,
                         trials->detail,     trials->why, trials->suggested_fix};
}

std::string ReportSummary::extent() const {
  std::string text;
  if (trials) {
    text =
        "in " + std::to_string(trials->passed) + " of " + std::to_string(trials->count) + " trials";
  }
  if (conditions) {
    text += (text.empty() ? "under " : ", under ") + std::to_string(conditions->passed) + " of " +
            std::to_string(conditions->count) + " conditions";
  }
  return text;
}

std::string ReportSummary::headline() const {
  if (const auto failed = failure()) return failed->headline();
  const auto some = [](const std::optional<Trials>& of) { return of && of->passed < of->count; };
  return some(trials) || some(conditions) ? "pass " + extent() : "";
}

ReportSummary SummarizeReport(const Json& json, const std::string& name) {
  const plan::JsonReader root(json, name);
  root.ExpectFormat("regrasp-report");
  ReportSummary summary;
  summary.passed = root.Member("verdict").OneOf({"pass", "fail"}) == "pass";
  ReadSubject(root, summary);
  if (root.Has("run")) ReadRun(root.Member("run"), summary);
  if (root.Has("trials")) summary.trials = ReadCounts(root.Member("trials"), "count", 1);
  if (root.Has("conditions")) {
    const plan::JsonReader conditions = root.Member("conditions");
    summary.conditions = ReadCounts(conditions, "applicable", 0);
    summary.conditions->decides = !conditions.Member("required").IsNull();
  }
  const plan::JsonReader list = root.Member("steps");
  const std::vector<plan::JsonReader> steps = list.Elements();
  if (steps.empty()) list.Fail("expected at least one step, found none");
  for (const plan::JsonReader& step : steps) summary.entries.push_back(ReadEntry(step));
  const plan::JsonReader weakest = root.Member("weakest_step");
  if (weakest.IsNull()) return summary;
  summary.weakest_step = weakest.Integer(0, static_cast<int>(steps.size()) - 1);
  const plan::JsonReader closure = steps[*summary.weakest_step].Member("force_closure");
  if (closure.IsNull()) return summary;
  const plan::JsonReader required = closure.Member("required_half_angle_deg");
  if (!required.IsNull()) summary.required_friction_angle_deg = required.Number();
  return summary;
}

ReportSummary ReadReportSummary(const std::filesystem::path& path) {
  return SummarizeReport(ParseJson(ReadFile(path), path.string()), path.string());
}

}  // namespace regrasp::apps
