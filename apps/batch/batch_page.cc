#include "apps/batch/batch_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "batch_page_style.h"
#include "planner/base/number.h"
#include "report/markup.h"
#include "report/page/data_table.h"
#include "report/page/html_page.h"
#include "report/page/step_table.h"

namespace regrasp::apps {

namespace {

using report::Element;
using Parts = std::vector<Element>;

constexpr char kPage[] = "report.html";
constexpr char kMissing[] = "–";

bool Passed(const PlanOutcome& plan) { return plan.verdict == PlanVerdict::kPass; }

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

/// A failure, and its cause and remedy; empty if the plan passes.
struct FailureText {
  std::string what, why;
};

std::string OnOneLine(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

FailureText FailureOf(const PlanOutcome& plan) {
  if (!plan.report) return {OnOneLine(plan.message), ""};
  const auto failure = plan.report->failure();
  if (!failure) return {};
  const std::string where =
      !failure->entry.valid() ? "Trials"
      : failure->entry == 0   ? "The hold"
                            : "Step " + std::to_string(failure->entry) + " (" + failure->kind + ")";
  std::string why = report::CauseAndFix(failure->why, failure->suggested_fix);
  if (!why.empty()) why.erase(0, 1);  // the line feed before it
  return {OnOneLine(where + ": " + (failure->what.empty() ? failure->reason : failure->what) + "."),
          OnOneLine(why)};
}

/// Return a cell with a failure. Cause and remedy are folded, because they would make a row as high
/// as several others.
Element FailureCell(const FailureText& failure) {
  Element cell = report::WithOptions(Element("td"), failure.what);
  if (failure.why.empty()) return cell;
  Element why = report::WithOptions(Element("p"), failure.why);
  cell.Add(Element("details", {}, Element("summary", {}, "Cause and remedy"), why));
  return cell;
}

/// Return the friction margin of the weakest step, degrees. A failed plan has only a missing
/// margin, because a margin elsewhere does not help.
std::optional<double> MarginOf(const PlanOutcome& plan) {
  if (!plan.report) return std::nullopt;
  const ReportSummary& report = *plan.report;
  if (!report.weakest_step || !report.required_friction_angle_deg || !report.friction_angle_deg) {
    return std::nullopt;
  }
  const double margin = *report.friction_angle_deg - *report.required_friction_angle_deg;
  if (!Passed(plan) && margin >= 0) return std::nullopt;
  return margin;
}

/// Return the name of the image in the plan's folder; empty if there is none.
std::string PictureOf(const ReportSummary& report) {
  const auto frame_of = [&](std::optional<int> step) {
    return step ? report.entries[*step].frame : "";
  };
  if (report.failed_step()) return frame_of(report.failed_step());
  const std::string weakest = frame_of(report.weakest_step);
  return weakest.empty() ? frame_of(0) : weakest;
}

/// Return a cell of text, or of a dash, which cards omit.
Element TextCell(const std::string& text) {
  if (text.empty()) return Element("td", {{"class", "none"}}, kMissing);
  return Element("td", {}, text);
}

/// @param more  text below the number; may be empty.
Element NumberOrDash(const std::optional<double>& value, const std::string& text,
                     const std::string& more = "") {
  if (!value) return Element("td", {{"class", "number none"}}, kMissing);
  Element cell = report::ValueCell(FormatShort(*value), text);
  if (!more.empty()) cell.Add(Element("small", {}, " " + more));
  return cell;
}

/// Return an angle with a minus sign instead of a hyphen.
std::string AngleText(double degrees) {
  return (degrees < 0 ? "\u2212" : "") + FormatDegrees(std::abs(degrees));
}

/// Images are loaded lazily, because there may be thousands.
Element PictureCell(const PlanOutcome& plan) {
  const std::string picture = plan.report ? PictureOf(*plan.report) : "";
  if (picture.empty()) return Element("td", {{"class", "none"}});
  const auto link = [&](const std::string& file) { return PlanKey(plan.name) + "/" + file; };
  const std::string what = Passed(plan) ? "Frame of " : "Failure of ";
  return Element("td", {},
                 Element("a", {{"href", link(kPage)}, {"tabindex", "-1"}},
                         Element("img", {{"alt", what + plan.name},
                                         {"loading", "lazy"},
                                         {"src", link(report::PathUri(picture))}})));
}

Element ObjectCell(const ReportSummary& report) {
  if (report.object.empty()) return TextCell("");
  Element cell("td", {{"data-value", report.object}}, report.object, " ");
  if (!report.size.empty()) cell.Add(Element("small", {}, report.size));
  return cell;
}

Element Row(const PlanOutcome& plan) {
  const ReportSummary& report = plan.report ? *plan.report : ReportSummary();
  const auto failure = report.failure();
  const std::optional<double> margin = MarginOf(plan);
  const std::string weakest =
      margin ? report::StepName(plan::EntryIndex(*report.weakest_step)) : "";
  std::optional<double> steps;
  if (plan.report) steps = static_cast<double>(report.entries.size()) - 1;
  Element row("tr",
              {{"class", Passed(plan) ? "pass" : "fail"}, {"id", "plan=" + PlanKey(plan.name)}});
  row.Add(PictureCell(plan));
  row.Add(
      plan.report
          ? Element("td", {}, Element("a", {{"href", PlanKey(plan.name) + "/" + kPage}}, plan.name))
          : Element("td", {}, plan.name));
  row.Add(Element("td", {{"class", "outcome"}}, VerdictWord(plan)));
  row.Add(TextCell(failure ? failure->reason : ""));
  const FailureText failed = FailureOf(plan);
  row.Add(failed.what.empty() ? TextCell("") : FailureCell(failed));
  row.Add(NumberOrDash(margin, margin ? AngleText(*margin) : "", "in " + weakest));
  row.Add(NumberOrDash(steps, steps ? FormatShort(*steps) : ""));
  row.Add(NumberOrDash(report.friction_angle_deg,
                       report.friction_angle_deg ? FormatDegrees(*report.friction_angle_deg) : ""));
  row.Add(ObjectCell(report));
  row.Add(TextCell(report.planner));
  return row;
}

Element Head() {
  const Parts cells = {report::HeadCell("", ""),
                       report::HeadCell("Plan", ""),
                       report::FilterHeadCell("Verdict", "verdict"),
                       report::FilterHeadCell("Reason", "reason"),
                       report::HeadCell("Failure", ""),
                       report::HeadCell("Friction margin"),
                       report::HeadCell("Steps"),
                       report::HeadCell("Friction"),
                       report::FilterHeadCell("Object", "object"),
                       report::FilterHeadCell("Planner", "planner")};
  return Element("tr", {}, cells);
}

Parts Skipped(const std::vector<SkippedFile>& skipped) {
  if (skipped.empty()) return {};
  Parts items;
  for (const SkippedFile& file : skipped)
    items.emplace_back("li", report::Attributes(), file.file + " " + file.why);
  return {Element("h2", {}, "Skipped"), Element("ul", {}, items)};
}

}  // namespace

std::string PlanKey(const std::string& name) { return report::PathUri(name); }

std::string FormatBatchPage(const BatchSummary& summary) {
  std::vector<const PlanOutcome*> plans;
  for (const PlanOutcome& plan : summary.plans) plans.push_back(&plan);
  // Worst first.
  std::ranges::stable_sort(plans, std::ranges::greater(), &PlanOutcome::verdict);
  report::DataTable table{"plans", "plans", Head(), {}};
  for (const PlanOutcome* plan : plans) table.rows.push_back(Row(*plan));
  const bool pass = summary.verdict() == PlanVerdict::kPass;
  const std::string subject =
      std::to_string(plans.size()) + (plans.size() == 1 ? " plan" : " plans");
  Parts all = {report::PageHeader("Validation of a library of plans", subject, pass,
                                  CountsText(summary) + ".")};
  for (const Parts& parts : {report::MakeDataTable(table), Skipped(summary.skipped)}) {
    all.insert(all.end(), parts.begin(), parts.end());
  }
  const std::array scripts = {report::DataTableScript()};
  return report::FormatHtmlPage((pass ? "Pass: " : "Fail: ") + subject, all,
                                report::PictureSource::kOwnSite, scripts,
                                std::string(report::DataTableStyle()) + kBatchPageStyle);
}

}  // namespace regrasp::apps
