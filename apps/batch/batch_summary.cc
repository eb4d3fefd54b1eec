#include "apps/batch/batch_summary.h"

#include <algorithm>

#include "planner/base/number.h"
#include "planner/base/text_table.h"
#include "report/markup.h"
#include "report/report_json.h"

namespace regrasp::apps {

namespace {

constexpr char kNothing[] = "-";

long Count(const BatchSummary& summary, PlanVerdict verdict) {
  return std::ranges::count(summary.plans, verdict, &PlanOutcome::verdict);
}

/// Return the reason of a plan that does not pass, in one word.
std::string ReasonOf(const PlanOutcome& plan) {
  const auto failure = plan.report ? plan.report->failure() : std::nullopt;
  return failure ? failure->reason : "";
}

/// Return the reason of a failure, or the number of passed trials.
std::string ReasonCell(const ReportSummary& report) {
  const auto failure = report.failure();
  const std::string trials = report.extent();
  if (!failure) return trials.empty() ? "" : "passes " + trials;
  if (failure->entry.valid()) {
    return failure->reason + " in step " + std::to_string(failure->entry);
  }
  return failure->reason + ": passes " + trials;
}

Json TrialsJson(const ReportSummary::Trials& trials) {
  return {{"count", trials.count}, {"passed", trials.passed}};
}

Json PlanJson(const PlanOutcome& plan) {
  Json json = {{"name", plan.name},
               {"file", plan.file},
               {"verdict", std::string(PlanVerdictName(plan.verdict))},
               {"steps", nullptr},
               {"weakest_step", nullptr},
               {"required_half_angle_deg", nullptr},
               {"failed_step", nullptr},
               {"reason", report::TextOrNull(ReasonOf(plan))},
               {"message", report::TextOrNull(plan.message)},
               {"report", nullptr}};
  if (!plan.report) return json;
  json["steps"] = plan.report->entries.size() - 1;
  json["weakest_step"] = report::OrNull(plan.report->weakest_step);
  json["required_half_angle_deg"] = report::OrNull(plan.report->required_friction_angle_deg);
  json["failed_step"] = report::OrNull(plan.report->failed_step());
  json["report"] = plan.name + "/report.json";
  if (plan.report->trials) json["trials"] = TrialsJson(*plan.report->trials);
  if (plan.report->conditions) json["conditions"] = TrialsJson(*plan.report->conditions);
  return json;
}

TextRow MakeRow(const PlanOutcome& plan) {
  TextRow row = {plan.name, std::string(PlanVerdictName(plan.verdict)),
                 kNothing,  kNothing,
                 kNothing,  plan.message};
  if (plan.report) {
    const ReportSummary& report = *plan.report;
    row[2] = std::to_string(report.entries.size() - 1);
    if (report.weakest_step) row[3] = std::to_string(*report.weakest_step);
    if (report.required_friction_angle_deg) {
      row[4] = FormatRequiredDegrees(*report.required_friction_angle_deg);
    }
    row[5] = ReasonCell(report);
  }
  if (row.back().empty()) row.back() = kNothing;
  return row;
}

/// Return true if a plan passes although some of its trials fail.
bool PassesInPart(const PlanOutcome& plan) {
  return plan.verdict == PlanVerdict::kPass && plan.report && plan.report->trials &&
         plan.report->trials->passed < plan.report->trials->count;
}

std::string FormatCounts(const BatchSummary& summary) {
  std::string text = std::to_string(summary.plans.size()) +
                     (summary.plans.size() == 1 ? " plan: " : " plans: ") + CountsText(summary);
  const long kept = std::ranges::count(summary.plans, true, &PlanOutcome::kept);
  if (kept > 0) text += "; " + std::to_string(kept) + " kept from an earlier run";
  return text + "\n";
}

report::JunitSuite MakeSuite(const PlanOutcome& plan, const std::filesystem::path& folder) {
  report::JunitSuite suite{plan.file, {}, plan.seconds};
  if (!plan.report) {
    suite.cases.push_back({"plan", report::JunitOutcome::kError,
                           std::string(PlanVerdictName(plan.verdict)), plan.message});
    return suite;
  }
  for (std::size_t i = 0; i < plan.report->entries.size(); ++i) {
    const ReportSummary::Entry& entry = plan.report->entries[i];
    suite.cases.push_back(
        {.name = "step " + std::to_string(i) + " " + entry.kind,
         .outcome = report::OutcomeOf(entry.verdict),
         .message = entry.reason,
         .text = report::JunitText(entry.detail, entry.why, entry.suggested_fix),
         .picture = entry.frame.empty() ? "" : (folder / plan.name / entry.frame).string()});
  }
  if (plan.report->trials) {
    const auto failure = plan.report->failure();
    const bool enough = !failure || failure->entry.valid() || plan.report->trials->enough;
    suite.cases.push_back(
        {.name = "trials",
         .outcome = enough ? report::JunitOutcome::kPassed : report::JunitOutcome::kFailed,
         .message = enough ? "" : failure->reason,
         .text =
             enough ? "" : report::JunitText(failure->what, failure->why, failure->suggested_fix)});
  }
  if (plan.report->conditions) {
    const ReportSummary::Trials& conditions = *plan.report->conditions;
    const bool informs = !conditions.decides && conditions.passed < conditions.count;
    report::JunitCase& result = suite.cases.emplace_back();
    result.name = "conditions";
    if (informs) {
      result.outcome = report::JunitOutcome::kSkipped;
      result.message = std::to_string(conditions.passed) + " of " +
                       std::to_string(conditions.count) + " conditions pass, none is required";
    } else if (!conditions.enough) {
      result.outcome = report::JunitOutcome::kFailed;
      result.message = report::kConditionsFailed;
      result.text = report::JunitText(conditions.detail, conditions.why, conditions.suggested_fix);
    }
  }
  report::SetCaseTimes(plan.entry_seconds, suite);
  return suite;
}

}  // namespace

std::string_view PlanVerdictName(PlanVerdict verdict) {
  switch (verdict) {
    case PlanVerdict::kPass:
      return "pass";
    case PlanVerdict::kFail:
      return "fail";
    case PlanVerdict::kBadInput:
      return "bad-input";
    case PlanVerdict::kError:
      return "error";
  }
  return "";
}

std::string CountsText(const BatchSummary& summary) {
  std::string text;
  for (const PlanVerdict verdict :
       {PlanVerdict::kPass, PlanVerdict::kFail, PlanVerdict::kBadInput, PlanVerdict::kError}) {
    text += (text.empty() ? "" : ", ") + std::to_string(Count(summary, verdict)) + " " +
            std::string(PlanVerdictName(verdict));
  }
  // Plans with failed trials are counted separately, so that the number of passes does not hide
  // them.
  const long partly = std::ranges::count_if(summary.plans, PassesInPart);
  if (partly > 0) text += "; " + std::to_string(partly) + " pass in only a part of their trials";
  return text;
}

PlanVerdict BatchSummary::verdict() const {
  PlanVerdict worst = PlanVerdict::kPass;
  for (const PlanOutcome& plan : plans) worst = std::max(worst, plan.verdict);
  return worst;
}

std::string FormatSummaryJson(const BatchSummary& summary) {
  Json json = {{"format", "regrasp-summary"},
               {"version", 1},
               {"verdict", std::string(PlanVerdictName(summary.verdict()))},
               {"counts",
                {{"plans", summary.plans.size()},
                 {"pass", Count(summary, PlanVerdict::kPass)},
                 {"fail", Count(summary, PlanVerdict::kFail)},
                 {"bad-input", Count(summary, PlanVerdict::kBadInput)},
                 {"error", Count(summary, PlanVerdict::kError)}}},
               {"page", kIndexName},
               {"plans", Json::array()},
               {"skipped", Json::array()}};
  for (const PlanOutcome& plan : summary.plans) json["plans"].push_back(PlanJson(plan));
  for (const SkippedFile& file : summary.skipped) {
    json["skipped"].push_back({{"file", file.file}, {"why", file.why}});
  }
  return FormatJson(json);
}

std::string FormatSummaryTable(const BatchSummary& summary) {
  std::vector<TextRow> rows = {{"plan", "verdict", "steps", "weakest", "required_deg", "reason"}};
  for (const PlanOutcome& plan : summary.plans) rows.push_back(MakeRow(plan));
  std::string text = FormatRows(rows);
  for (const SkippedFile& file : summary.skipped) {
    text += OneLine("skipped: " + file.file + " " + file.why) + "\n";
  }
  return text + FormatCounts(summary);
}

std::string FormatSummaryJunit(const BatchSummary& summary, const std::filesystem::path& folder) {
  std::vector<report::JunitSuite> suites;
  for (const PlanOutcome& plan : summary.plans) suites.push_back(MakeSuite(plan, folder));
  return report::FormatJunit(suites);
}

}  // namespace regrasp::apps
