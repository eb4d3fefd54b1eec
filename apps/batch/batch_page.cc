#include "apps/batch/batch_page.h"

#include <algorithm>

#include "planner/base/number.h"
#include "report/markup.h"
#include "report/page/facts.h"
#include "report/page/html_page.h"
#include "report/page/step_table.h"

namespace regrasp::apps {

namespace {

using report::Element;
using Parts = std::vector<Element>;

constexpr char kPage[] = "report.html";
constexpr char kSheet[] = "overview.png";

bool Passed(const PlanOutcome& plan) { return plan.verdict == PlanVerdict::kPass; }

/// Return a count with its noun: "1 plan", "3 plans".
std::string Count(long count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string StepCount(const ReportSummary& report) {
  return Count(static_cast<long>(report.entries.size()) - 1, "step");
}

/// Return the outcome of the plan in words.
std::string Statement(const PlanOutcome& plan) {
  if (!plan.report) return plan.message;
  const auto failure = plan.report->failure();
  if (!failure) {
    const std::size_t steps = plan.report->entries.size() - 1;
    return steps == 0 ? "The hold passes." : "The hold and " + StepCount(*plan.report) + " pass.";
  }
  const std::string where =
      !failure->entry.valid() ? "Trials"
      : failure->entry == 0   ? "The hold"
                            : "Step " + std::to_string(failure->entry) + " (" + failure->kind + ")";
  return where + ": " + failure->reason + "." +
         (failure->what.empty() ? "" : " " + report::Capitalized(failure->what) + ".") +
         report::CauseAndFix(failure->why, failure->suggested_fix);
}

std::string VerdictWord(const PlanOutcome& plan) {
  switch (plan.verdict) {
    case PlanVerdict::kPass: {
      const std::string trials = plan.report ? plan.report->extent() : "";
      return trials.empty() ? "Pass" : "Pass " + trials;
    }
    case PlanVerdict::kFail:
      return "Fail";
    case PlanVerdict::kBadInput:
      return "Bad input";
    case PlanVerdict::kError:
      return "Not validated";
  }
  return "";
}

/// Return the friction margin with its step. For a failed plan, return only a missing margin,
/// because a margin elsewhere does not help.
std::string MarginText(const PlanOutcome& plan) {
  const ReportSummary& report = *plan.report;
  if (!report.weakest_step || !report.required_friction_angle_deg || !report.friction_angle_deg)
    return "";
  const double margin = *report.friction_angle_deg - *report.required_friction_angle_deg;
  if (!Passed(plan) && margin >= 0) return "";
  return FormatDegrees(std::abs(margin)) + (margin < 0 ? " missing in " : " margin in ") +
         report::StepName(plan::EntryIndex(*report.weakest_step));
}

Element Facts(const PlanOutcome& plan) {
  const ReportSummary& report = *plan.report;
  report::FactList facts;
  const auto add = [&facts](const char* name, const std::string& value) {
    if (!value.empty()) facts.Add(name, value);
  };
  add("Object", report.object);
  add("Size", report.size);
  add("Friction", report.friction_angle_deg ? FormatDegrees(*report.friction_angle_deg) : "");
  add("Weakest", MarginText(plan));
  add("Sequence", StepCount(report));
  add("Planner", report.planner);
  return facts.Make();
}

/// Return the name of the most informative image in the plan's folder; empty if there is none.
std::string PictureOf(const ReportSummary& report) {
  const auto failed = report.failed_step();
  if (failed && !report.entries[*failed].frame.empty()) return report.entries[*failed].frame;
  const bool has_sheet =
      std::ranges::find(report.files, kSheet, &report::FileDigest::name) != report.files.end();
  return has_sheet ? kSheet : "";
}

std::string Link(const PlanOutcome& plan, const std::string& file) {
  return report::PathUri(plan.name + "/" + file);
}

/// Images are loaded lazily, because there may be a thousand.
Parts Picture(const PlanOutcome& plan) {
  const std::string picture = plan.report ? PictureOf(*plan.report) : "";
  if (picture.empty()) return {};
  const std::string what = picture == kSheet ? "All frames of " : "What fails in ";
  return {Element(
      "a", {{"href", Link(plan, kPage)}},
      Element("img",
              {{"alt", what + plan.name}, {"loading", "lazy"}, {"src", Link(plan, picture)}}))};
}

Element Card(const PlanOutcome& plan) {
  Parts words = {plan.report
                     ? Element("h3", {}, Element("a", {{"href", Link(plan, kPage)}}, plan.name))
                     : Element("h3", {}, plan.name),
                 Element("p", {}, Element("strong", {}, VerdictWord(plan)), " ", Statement(plan))};
  if (plan.report) words.push_back(Facts(plan));
  Parts parts = Picture(plan);
  parts.push_back(Element("div", {}, words));
  return Element("article", {{"class", Passed(plan) ? "plan pass" : "plan fail"}}, parts);
}

/// Return a heading and a card for each plan; nothing if there are no plans.
Parts Section(const std::string& name, const std::vector<const PlanOutcome*>& plans) {
  if (plans.empty()) return {};
  Parts cards;
  for (const PlanOutcome* plan : plans) cards.push_back(Card(*plan));
  return {Element("h2", {}, name), Element("div", {{"class", "plans"}}, cards)};
}

Parts Skipped(const std::vector<SkippedFile>& skipped) {
  if (skipped.empty()) return {};
  Parts items;
  for (const SkippedFile& file : skipped)
    items.emplace_back("li", report::Attributes(), file.file + " " + file.why);
  return {Element("h2", {}, "Skipped"), Element("ul", {}, items)};
}

}  // namespace

std::string FormatBatchPage(const BatchSummary& summary) {
  std::vector<const PlanOutcome*> passed, others;
  for (const PlanOutcome& plan : summary.plans) (Passed(plan) ? passed : others).push_back(&plan);
  // Worst first.
  std::ranges::stable_sort(others, std::ranges::greater(), &PlanOutcome::verdict);
  const bool pass = others.empty();
  const std::string subject = Count(std::ssize(summary.plans), "plan");
  Parts all = {report::PageHeader("Validation of a library of plans", subject, pass,
                                  CountsText(summary) + ".")};
  for (const Parts& parts :
       {Section("Not passed", others), Section("Passed", passed), Skipped(summary.skipped)}) {
    all.insert(all.end(), parts.begin(), parts.end());
  }
  return report::FormatHtmlPage((pass ? "Pass: " : "Fail: ") + subject, all,
                                report::PictureSource::kOwnSite);
}

}  // namespace regrasp::apps
