#include "report/page/report_page.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "planner/base/number.h"
#include "render/picture/caption.h"
#include "render/viewer/viewer_scripts.h"
#include "report/failure.h"
#include "report/page/facts.h"
#include "report/page/html_page.h"
#include "report/page/step_plot.h"
#include "report/page/step_table.h"
#include "report/report_table.h"

namespace regrasp::report {

namespace {

using Parts = std::vector<Element>;

/// Style of a page with only a replay: its controls are visible without scrolling, also in the
/// frame of a notebook.
constexpr char kViewerPage[] =
    "main { padding-top: 1rem; } .verdict { margin-bottom: 1rem; }\n"
    ".viewer .stage { height: max(18rem, calc(100vh - 24rem)); }\n";

/// Legend of the images. In print it is next to the first image.
constexpr char kLegend[] =
    "Each picture shows the state after its step. A finger keeps its name or number and its "
    "colour. Cone: friction cone. Arrow: contact force. Ring: a finger that was placed. Pale "
    "finger "
    "with an arrow: a finger that was lifted. Dashed line: path of a finger that slid.";

/// The replay is hidden until its script runs. The data are not a script that could run.
Parts ViewerParts(std::string_view viewer) {
  if (viewer.empty()) return {};
  Element data("script", {{"type", "application/json"}, {"id", "viewer-data"}});
  data.AddVerbatim(viewer);
  return {Element("div", {{"id", "viewer"}, {"class", "viewer"}, {"tabindex", "0"}}),
          Element("p", {{"class", "note no-viewer"}},
                  "The interactive 3-D replay requires JavaScript and WebGL."),
          data};
}

class Page {
 public:
  Page(const Report& report, const plan::Plan& plan, const std::vector<PagePicture>& pictures,
       const PagePicture& moving, std::string_view viewer,
       std::span<const std::string> finger_names, const IndexRow& index)
      : report_(report),
        plan_(plan),
        pictures_(pictures),
        moving_(moving),
        viewer_(viewer),
        finger_names_(finger_names),
        index_(index),
        measures_(MeasureSteps(report)) {
    for (const ReportStep& step : report.steps) {
      if (step.verdict() == Verdict::kFail) failed_ = step.check.index;
    }
    // Without a failure the first image replaces the viewer.
    const plan::EntryIndex first{0};
    if (failed_ && HasPicture(*failed_)) still_ = failed_;
    if (!failed_ && !viewer.empty() && HasPicture(first)) still_ = first;
  }

  [[nodiscard]] std::string Format() const {
    Parts all;
    for (const Parts& parts :
         {Links(), Parts{Header()}, ViewerParts(viewer_), StillFrame(),
          MakeStepTable(report_, plan_, measures_, Anchors(), finger_names_), Plots(),
          Parts{MakeFacts(report_, measures_)}, MakeFingerTable(report_), MakeGoalSection(report_),
          MakeDisagreements(report_), MakeEngineSection(report_), MakeConditionSection(report_),
          Replay(), Frames(), MakeFindings(report_, finger_names_), Parts{MakeSettings(report_)}}) {
      all.insert(all.end(), parts.begin(), parts.end());
    }
    return FormatPage(all);
  }

  [[nodiscard]] std::string FormatViewer() const {
    Parts all = ViewerParts(viewer_);
    all.insert(all.begin(), Header());
    return FormatPage(all, kViewerPage);
  }

 private:
  [[nodiscard]] std::string FormatPage(const Parts& parts, std::string_view style = {}) const {
    const std::string extent = Extent();
    const std::string title = (report_.passed() ? "Pass" : "Fail") +
                              (extent.empty() ? "" : " " + extent) + ": " + report_.plan_file;
    if (viewer_.empty()) return FormatHtmlPage(title, parts);
    return FormatHtmlPage(title, parts, PictureSource::kInPage, render::ViewerScripts(), style);
  }

  /// The index page finds the previous and the next plan, so that results of other plans do not
  /// change this page.
  [[nodiscard]] Parts Links() const {
    if (index_.page.empty()) return {};
    const auto link = [this](const char* fragment, const char* text) {
      return Element("a", {{"href", index_.page + "#" + fragment + "=" + index_.key}}, text);
    };
    return {Element(
        "nav", {{"class", "links"}},
        Parts{link("plan", "All plans"), link("before", "Previous"), link("after", "Next")})};
  }

  [[nodiscard]] Element Header() const {
    return PageHeader(report_.grasp ? "Validation of a grasp" : "Validation of a regrasp plan",
                      report_.plan_file, report_.passed(), Statement(), Extent());
  }

  /// Return the number of trials for the verdict; empty without trials.
  [[nodiscard]] std::string Extent() const {
    if (report_.passed() && report_.conditions) {
      return (report_.trials ? TrialsPassText(*report_.trials) + ", " : "") +
             ConditionsPassText(*report_.conditions);
    }
    if (!report_.trials || (report_.conditions && report_.trials->enough())) return "";
    const sim::TrialSummary& trials = *report_.trials;
    const int failed = trials.options.count - trials.passed;
    return report_.passed() ? TrialsPassText(trials)
                            : "in " + std::to_string(failed) + " of " +
                                  std::to_string(trials.options.count) + " trials";
  }

  /// Return the verdict in words, with a line for each of fault, cause and remedy.
  [[nodiscard]] std::string Statement() const {
    if (failed_) return FailureStatement();
    const auto failure = DescribeFailure(report_);
    if (!failure) return Capitalized(StepsStatement());
    return Capitalized(failure->what) + "." + CauseAndFix(failure->why, failure->suggested_fix) +
           "\nIn the nominal replay, " + StepsStatement();
  }

  [[nodiscard]] std::string StepsStatement() const {
    const sim::ReplaySettings& settings = *report_.settings;
    const std::string what =
        " with " + FormatDegrees(Degrees(report_.friction_angle)) +
        " of friction, and in the replay the object resisted a force and a torque of " +
        NumberText(100 * settings.disturbance_ratio) +
        " % of the grasp force along every axis, in both directions";
    if (report_.grasp) return "the grasp is force closure" + what + ".";
    const std::string steps = std::to_string(plan_.steps.size());
    return "the hold and " +
           (plan_.steps.size() == 1 ? "the one step" : "all " + steps + " steps") +
           " pass: every grasp along them is " + StabilityText(report_) + what +
           ", in every static grasp.";
  }

  [[nodiscard]] std::string FailureStatement() const {
    const Failure failure = *DescribeFailure(report_);
    std::string text;
    if (!report_.grasp) {
      text = "at " + StepName(*failed_);
      if (*failed_ > 0) text += " (" + render::EntryTitle(plan_, *failed_, finger_names_) + ")";
      text += ": ";
    }
    text = Capitalized(text + failure.reason + ".");
    if (!failure.what.empty()) text += " " + Capitalized(failure.what) + ".";
    const bool replayed = report_.steps[*failed_].replay.has_value();
    text +=
        replayed ? " The replay found it." : " The analytic check found it; it was not replayed.";
    if (*failed_ + 1 < static_cast<int>(report_.steps.size())) text += " Later steps were skipped.";
    return text + CauseAndFix(failure.why, failure.suggested_fix) +
           "\nFor all causes and remedies, run regrasp validate --explain " + failure.reason + ".";
  }

  [[nodiscard]] double Tolerance() const {
    return report_.settings->tolerance * report_.settings->diameter_m;
  }

  [[nodiscard]] std::vector<std::optional<double>> Values(
      std::optional<double> StepMeasures::*member) const {
    std::vector<std::optional<double>> values;
    for (const StepMeasures& measures : measures_) values.push_back(measures.*member);
    return values;
  }

  [[nodiscard]] bool HasAny(std::optional<double> StepMeasures::*member) const {
    return std::ranges::any_of(measures_,
                               [member](const StepMeasures& m) { return (m.*member).has_value(); });
  }

  [[nodiscard]] Parts Plots() const {
    if (report_.grasp) return {};  // one entry makes no plot
    Parts figures;
    if (HasAny(&StepMeasures::deviation_percent)) {
      figures.push_back(DeviationFigure());
    } else if (HasAny(&StepMeasures::moved_m)) {
      figures.push_back(MotionFigure());
    }
    if (HasAny(&StepMeasures::margin_deg)) figures.push_back(MarginFigure());
    if (figures.empty()) return {};
    return {Element("div", {{"class", "plots"}}, figures)};
  }

  [[nodiscard]] Element MotionFigure() const {
    StepPlot plot;
    plot.title = "Motion of the object and slip of the fingers, over the steps";
    plot.y_axis = "length";
    plot.logarithmic = true;
    plot.series = {{"object moved", Values(&StepMeasures::moved_m), PlotMark::kDisc},
                   {"finger slipped", Values(&StepMeasures::slip_m), PlotMark::kRing}};
    plot.limit = PlotLimit{Tolerance(), "tolerance " + LengthText(Tolerance()), true};
    plot.failed = failed_;
    return Figure({}, DrawStepPlot(plot), "Motion of the object.",
                  "Largest motion of the object in each step, |Δx| + R|Δφ| with R half the "
                  "diameter, and largest slip of a holding fingertip. Logarithmic.");
  }

  /// Return the plot of a replay by a hand, which has several limits.
  [[nodiscard]] Element DeviationFigure() const {
    const sim::HandTolerance& tolerance = report_.settings->hand->tolerance;
    StepPlot plot;
    plot.title = "Deviation of the object and slip of the fingers, over the steps";
    plot.y_axis = "% of the limit";
    plot.series = {{"object", Values(&StepMeasures::deviation_percent), PlotMark::kDisc},
                   {"finger slipped", Values(&StepMeasures::slip_percent), PlotMark::kRing}};
    plot.limit = PlotLimit{100, "limit", true};
    plot.failed = failed_;
    return Figure({}, DrawStepPlot(plot), "Deviation of the object.",
                  "Discs: deviation of the object from the plan in each step, limits " +
                      LengthText(tolerance.length_m) + " and " +
                      render::AngleText(tolerance.angle_rad) +
                      ", half of that in a static grasp. Rings: slip of a holding fingertip, "
                      "limit " +
                      LengthText(tolerance.slip_m) + ".");
  }

  [[nodiscard]] Element MarginFigure() const {
    StepPlot plot;
    plot.title = "Margin to the friction cone, over the steps";
    plot.y_axis = "degrees";
    plot.series = {{"all grasps of the step", Values(&StepMeasures::margin_deg), PlotMark::kDisc}};
    if (HasAny(&StepMeasures::static_margin_deg)) {
      plot.series.push_back(
          {"forces in static grasp", Values(&StepMeasures::static_margin_deg), PlotMark::kRing});
    }
    plot.limit = PlotLimit{0, "", false};
    plot.failed = failed_;
    const std::string rings =
        " Rings: the friction angle minus the largest angle between a finger's force and its "
        "normal, in the static grasp after the step in the replay.";
    return Figure({}, DrawStepPlot(plot), "Friction margin.",
                  "Discs: the friction angle minus the smallest one at which every grasp of the "
                  "step is " +
                      StabilityText(report_) + "." + (plot.series.size() > 1 ? rings : ""));
  }

  [[nodiscard]] bool HasPicture(plan::EntryIndex index) const {
    return !pictures_.empty() && !pictures_[index].bytes.empty();
  }
  [[nodiscard]] static std::string Anchor(plan::EntryIndex index) {
    return "frame" + std::to_string(index);
  }
  [[nodiscard]] std::vector<std::string> Anchors() const {
    std::vector<std::string> anchors;
    for (const ReportStep& step : report_.steps) {
      anchors.push_back(HasPicture(step.check.index) ? Anchor(step.check.index) : "");
    }
    return anchors;
  }

  /// The image of the failure comes first, and large. Without a failure an image comes first only
  /// in place of the replay.
  [[nodiscard]] Parts StillFrame() const {
    if (!still_) return {};
    Element legend("p", {{"class", "note legend"}}, kLegend);
    return {Element("div", {{"class", failed_ ? "failure" : "still"}},
                    Parts{Frame(report_.steps[*still_]), legend})};
  }

  [[nodiscard]] Parts Frames() const {
    Parts frames;
    for (const ReportStep& step : report_.steps) {
      if (HasPicture(step.check.index) && step.check.index != still_) {
        frames.push_back(Frame(step));
      }
    }
    if (frames.empty()) return {};
    return {Element("h2", {}, "Frames"),
            Element("p", {{"class", still_ ? "note screen" : "note"}}, kLegend),
            Element("div", {{"class", "frames"}}, frames)};
  }

  [[nodiscard]] Parts Replay() const {
    if (moving_.bytes.empty()) return {};
    const std::string text =
        "The motion between the static grasps, with a short pause after each step.";
    const std::string name = "The replay as a moving picture";
    if (!moving_.file.empty()) return {LinkedReplay(text)};
    const bool video = moving_.media_type.starts_with("video/");
    // An image has no controls: it plays while the element is open.
    const Element image = Element("details", {}, Element("summary", {}, "Play the animation"),
                                  MakeImage(moving_, name));
    return {Element(
        "div", {{"class", "replay"}},
        Parts{Element("h2", {}, "Replay"), Note(text), video ? MakeVideo(moving_, name) : image})};
  }

  [[nodiscard]] Element LinkedReplay(const std::string& text) const {
    constexpr double kBytesPerMegabyte = 1e6;
    const auto megabytes = static_cast<double>(moving_.bytes.size()) / kBytesPerMegabyte;
    return Element(
        "div", {{"class", "replay"}},
        Parts{Element("h2", {}, "Replay"), Note(text),
              Element("p", {}, Element("a", {{"href", PathUri(moving_.file)}}, moving_.file),
                      " (" + NumberText(megabytes) + " MB, not part of this page)")});
  }

  [[nodiscard]] static Element MakeImage(const PagePicture& picture, const std::string& name) {
    return Element("img", {{"alt", name},
                           {"width", std::to_string(picture.width)},
                           {"height", std::to_string(picture.height)},
                           {"src", DataUri(picture.media_type, picture.bytes)}});
  }

  /// The animation starts by itself, silently, and repeats.
  [[nodiscard]] static Element MakeVideo(const PagePicture& picture, const std::string& name) {
    return Element("video",
                   {{"aria-label", name},
                    {"width", std::to_string(picture.width)},
                    {"height", std::to_string(picture.height)},
                    {"controls", ""},
                    {"autoplay", ""},
                    {"loop", ""},
                    {"muted", ""},
                    {"playsinline", ""},
                    {"src", DataUri(picture.media_type, picture.bytes)}},
                   "This browser plays no " + std::string(picture.media_type) + ".");
  }

  [[nodiscard]] Element Frame(const ReportStep& step) const {
    const plan::EntryIndex index = step.check.index;
    const PagePicture& picture = pictures_[index];
    const std::string name = index == 0 ? StepTitle(plan_, index, finger_names_)
                                        : "Step " + std::to_string(index) + ", " +
                                              render::EntryTitle(plan_, index, finger_names_);
    const bool failed = step.verdict() == Verdict::kFail;
    std::string text = failed ? std::string(plan::ReasonName(step.reason())) + ": " + step.detail()
                              : VerdictText(step);
    if (!failed && measures_[index].margin_deg) {
      text += ", friction margin " + FormatDegrees(*measures_[index].margin_deg);
    }
    if (picture.own_view) text += "; seen from another side, as one view hides a finger";
    return Figure({{"id", Anchor(index)}, {"class", std::string(VerdictName(step.verdict()))}},
                  MakeImage(picture, name), name + ".", Capitalized(text) + ".");
  }

  const Report& report_;
  const plan::Plan& plan_;
  const std::vector<PagePicture>& pictures_;
  const PagePicture& moving_;
  std::string_view viewer_;
  std::span<const std::string> finger_names_;
  const IndexRow& index_;
  std::vector<StepMeasures> measures_;
  std::optional<plan::EntryIndex> failed_;
  std::optional<plan::EntryIndex> still_;  ///< entry of the image below the verdict
};

}  // namespace

std::string FormatReportHtml(const Report& report, const plan::Plan& plan,
                             const std::vector<PagePicture>& pictures, const PagePicture& moving,
                             std::string_view viewer, std::span<const std::string> finger_names,
                             const IndexRow& index) {
  assert(pictures.empty() || pictures.size() == report.steps.size());
  return Page(report, plan, pictures, moving, viewer, finger_names, index).Format();
}

std::string FormatViewerHtml(const Report& report, const plan::Plan& plan,
                             std::string_view viewer) {
  const std::vector<PagePicture> pictures;
  const PagePicture moving;
  const IndexRow index;
  return Page(report, plan, pictures, moving, viewer, {}, index).FormatViewer();
}

std::string FormatPlanHtml(const Report& report, std::string_view viewer) {
  const auto steps = static_cast<int>(report.steps.size()) - 1;
  const std::string planner = report.planner.empty() ? "" : ", planner " + report.planner;
  Parts parts = {Element("p", {{"class", "kicker"}}, "Regrasp plan"),
                 Element("h1", {}, report.plan_file),
                 Note(report.object_file + planner + ", " + std::to_string(steps) +
                      (steps == 1 ? " step" : " steps") + ", friction angle " +
                      FormatDegrees(Degrees(report.friction_angle)) +
                      ". The planned motion, not simulated: regrasp validate replays the plan and "
                      "decides whether it passes.")};
  for (const Element& part : ViewerParts(viewer)) parts.push_back(part);
  return FormatHtmlPage("Plan: " + report.plan_file, parts, PictureSource::kInPage,
                        render::ViewerScripts(), kViewerPage);
}

int PagePictureWidth(int count) {
  // An image of width w takes about 0.07 w² bytes: 2 MB, 2 MB, and 10 kB for each.
  constexpr int kLarge = 800, kMedium = 560, kSmall = 320;
  constexpr int kManyLarge = 24, kManyMedium = 60;
  if (count <= kManyLarge) return kLarge;
  return count <= kManyMedium ? kMedium : kSmall;
}

}  // namespace regrasp::report
