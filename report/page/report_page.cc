#include "report/page/report_page.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "page_style.h"
#include "planner/base/angle.h"
#include "planner/base/markup.h"
#include "render/picture/caption.h"
#include "report/page/data_uri.h"
#include "report/page/findings.h"
#include "report/page/quantity.h"
#include "report/page/step_measures.h"
#include "report/page/step_plot.h"
#include "report/trials_report.h"

namespace regrasp {

namespace {

constexpr char kNothing[] = "–";
/// Significant, as NumberText has.
constexpr int kQualityDigits = 3;

/// The page may load nothing and run nothing, whatever stands in it.
constexpr char kPolicy[] = "default-src 'none'; style-src 'unsafe-inline'; img-src data:";

template <typename Format>
std::string TextOr(const std::optional<double>& value, Format format) {
  return value ? format(*value) : std::string(kNothing);
}

/// An upper-case first letter; titles of steps are ASCII.
std::string Capitalized(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] += 'A' - 'a';
  return text;
}

std::string StepName(int index) {
  return index == 0 ? "the hold" : "step " + std::to_string(index);
}

class Page {
 public:
  Page(const Report& report, const Plan& plan, const std::vector<PagePicture>& pictures)
      : report_(report), plan_(plan), pictures_(pictures), measures_(MeasureSteps(report)) {
    for (const ReportStep& step : report.steps) {
      if (step.verdict() == Verdict::kFail) failed_ = step.check.index;
    }
  }

  [[nodiscard]] std::string Format() const {
    const std::string body =
        Element("main", "",
                Header() + Facts() + Plots() + Table() + (report_.grasp ? Fingers() : "") +
                    FormatFindings(report_) + Frames());
    return "<!DOCTYPE html>\n" +
           Element("html", "lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\"",
                   Head() + "\n" + Element("body", "", "\n" + body + "\n") + "\n") +
           "\n";
  }

 private:
  [[nodiscard]] std::string Head() const {
    const std::string meta =
        "<meta charset=\"utf-8\" />\n<meta http-equiv=\"Content-Security-Policy\" " +
        Attribute("content", kPolicy) +
        " />\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\" />\n";
    return Element("head", "",
                   "\n" + meta + Element("title", "", EscapeMarkup(Verdict() + ": " + Subject())) +
                       "\n" + Element("style", "", kPageStyle) + "\n");
  }

  [[nodiscard]] std::string Subject() const { return report_.plan_file; }
  [[nodiscard]] std::string Verdict() const { return report_.passed() ? "Pass" : "Fail"; }

  [[nodiscard]] std::string Header() const {
    const std::string style = report_.passed() ? "verdict pass" : "verdict fail";
    return Element(
               "header", "",
               Element("p", "class=\"kicker\"",
                       report_.grasp ? "Validation of a grasp" : "Validation of a regrasp plan") +
                   "\n" + Element("h1", "", EscapeMarkup(Subject())) + "\n" +
                   Element("p", Attribute("class", style),
                           Element("strong", "", Verdict()) + " " + EscapeMarkup(Statement()))) +
           "\n";
  }

  /// What the verdict says, in words.
  [[nodiscard]] std::string Statement() const {
    if (failed_) return FailureStatement();
    const ReplaySettings& settings = *report_.settings;
    const std::string what =
        " with " + DegreesText(Degrees(report_.half_angle)) +
        " of friction, and in the replay the object resisted a push and a twist of " +
        NumberText(100 * settings.shake) + " % of the squeeze along every axis, both ways";
    if (report_.grasp) return "The grasp is force closure" + what + ".";
    const std::string steps = std::to_string(plan_.steps.size());
    return "The hold and " +
           (plan_.steps.size() == 1 ? "the one step" : "all " + steps + " steps") +
           " stand: every grasp on the way is force closure" + what + ", at every rest.";
  }

  [[nodiscard]] std::string FailureStatement() const {
    const ReportStep& step = report_.steps[*failed_];
    std::string text;
    if (!report_.grasp) {
      text = "at " + StepName(*failed_);
      if (*failed_ > 0) text += " (" + EntryTitle(plan_, *failed_) + ")";
      text += ": ";
    }
    text += std::string(ReasonName(step.reason())) + ".";
    text = Capitalized(text);
    if (!step.detail().empty()) text += " " + Capitalized(step.detail()) + ".";
    const bool replayed = step.replay.has_value();
    text +=
        replayed ? " The replay found it." : " The analytic check found it; it was not replayed.";
    if (*failed_ + 1 < static_cast<int>(report_.steps.size())) text += " Later steps were skipped.";
    return text;
  }

  /// Names and values, beside each other.
  [[nodiscard]] std::string Facts() const {
    std::string list;
    const auto add = [&](std::string_view name, const std::string& value) {
      list +=
          Element("div", "",
                  Element("dt", "", EscapeMarkup(name)) + Element("dd", "", EscapeMarkup(value))) +
          "\n";
    };
    add("Object", report_.object_file + (report_.dimension == 2 ? ", planar" : ", a solid"));
    if (!report_.planner.empty()) add("Planner", report_.planner);
    add("Friction", DegreesText(Degrees(report_.half_angle)) +
                        " (μ = " + NumberText(std::tan(report_.half_angle)) + ")");
    if (report_.grasp) AddGrasp(add);
    const int weakest = report_.weakest_step();
    if (weakest >= 0 && !report_.grasp) {
      add("Weakest", StepName(weakest) + ", " +
                         DegreesText(measures_[weakest].margin_deg.value_or(0)) + " to spare");
    }
    if (report_.trials) AddTrials(add);
    if (report_.settings) AddSettings(add);
    list += Digest("Object, SHA-256", report_.object_sha256) +
            Digest(report_.grasp ? "Grasp, SHA-256" : "Plan, SHA-256", report_.plan_sha256);
    return Element("dl", "class=\"facts\"", "\n" + list) + "\n";
  }

  template <typename Add>
  void AddGrasp(const Add& add) const {
    const GraspReport& grasp = *report_.grasp;
    const std::optional<RequiredHalfAngle>& required = report_.steps.front().check.required;
    add("Needs", required ? DegreesText(Degrees(required->upper)) : std::string("none serves"));
    if (grasp.fingers.empty()) return;
    add("Quality ε", QualityText(grasp.quality, kQualityDigits));
    add("Weakest", "finger " + std::to_string(WeakestFinger(grasp.fingers)));
  }

  template <typename Add>
  void AddTrials(const Add& add) const {
    add("Trials", TrialsShareText(*report_.trials));
    const std::string failures = TrialsFailureText(*report_.trials);
    if (!failures.empty()) add("Trials that fail", failures);
    add("Noise", TrialsNoiseText(*report_.trials));
  }

  template <typename Add>
  void AddSettings(const Add& add) const {
    const ReplaySettings& settings = *report_.settings;
    add("Diameter", LengthText(settings.diameter_m));
    add("Mass", NumberText(settings.mass_kg) + " kg");
    add("Squeeze", NumberText(settings.squeeze_N) + " N");
    add("Shake", NumberText(100 * settings.shake) + " % of the squeeze");
    if (settings.protocol == Protocol::kFixed) add("Protocol", "fixed squeeze");
    add("Tolerance", LengthText(Tolerance()));
  }

  static std::string Digest(std::string_view name, const std::string& digest) {
    return Element(
               "div", "class=\"digest\"",
               Element("dt", "", EscapeMarkup(name)) + Element("dd", "", EscapeMarkup(digest))) +
           "\n";
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

  /// Of a single grasp: what each finger needs.
  [[nodiscard]] std::string Fingers() const {
    const std::vector<FingerFriction>& fingers = report_.grasp->fingers;
    if (fingers.empty()) return "";
    std::string rows;
    for (std::size_t i = 0; i < fingers.size(); ++i) {
      const std::optional<double>& without = fingers[i].without;
      const auto cell = [](const std::string& text) {
        return Element("td", "class=\"number\"", EscapeMarkup(text));
      };
      rows += Element("tr", "",
                      cell(std::to_string(i)) + cell(DegreesText(Degrees(fingers[i].required))) +
                          cell(DegreesText(Degrees(report_.half_angle - fingers[i].required))) +
                          cell(without ? DegreesText(Degrees(*without)) : "none")) +
              "\n";
    }
    std::string head;
    for (const char* name : {"Finger", "Needs alone", "Margin", "Others need without it"}) {
      head += Element("th", "scope=\"col\" class=\"number\"", name);
    }
    return Element("h2", "", "Fingers") + "\n" +
           Element("div", "class=\"scroll\"",
                   Element("table", "",
                           Element("thead", "", Element("tr", "", head)) +
                               Element("tbody", "", "\n" + rows))) +
           "\n" +
           Element("p", "class=\"note\"",
                   "Needs alone: how far the friction half-angle of this finger may fall while all "
                   "others keep theirs; 0 where it is not needed. Others need without it: the "
                   "friction half-angle at which the grasp is force closure without this finger.") +
           "\n";
  }

  [[nodiscard]] std::string Plots() const {
    if (report_.grasp) return "";  // one entry is no plot
    std::string figures;
    if (HasAny(&StepMeasures::margin_deg)) figures = MarginFigure();
    if (HasAny(&StepMeasures::moved_m)) figures = MotionFigure() + figures;
    if (figures.empty()) return "";
    return Element("div", "class=\"plots\"", "\n" + figures) + "\n";
  }

  static std::string Figure(const std::string& picture, std::string_view name,
                            std::string_view text) {
    return Element(
               "figure", "",
               picture + Element("figcaption", "",
                                 Element("b", "", EscapeMarkup(name)) + " " + EscapeMarkup(text))) +
           "\n";
  }

  [[nodiscard]] std::string MotionFigure() const {
    StepPlot plot;
    plot.title = "Motion of the object and slip of the fingers, over the steps";
    plot.y_axis = "metres";
    plot.logarithmic = true;
    plot.series = {{"object moved", Values(&StepMeasures::moved_m), PlotMark::kDisc},
                   {"finger slipped", Values(&StepMeasures::slip_m), PlotMark::kRing}};
    plot.limit = PlotLimit{Tolerance(), "tolerance " + LengthText(Tolerance()), true};
    plot.failed = failed_;
    return Figure(FormatStepPlot(plot), "How far things moved.",
                  "Largest motion of the object in each step, |Δx| + R|Δφ| with R half the "
                  "diameter, and largest slip of a holding fingertip. Logarithmic.");
  }

  [[nodiscard]] std::string MarginFigure() const {
    StepPlot plot;
    plot.title = "Margin to the friction cone, over the steps";
    plot.y_axis = "degrees";
    plot.series = {{"all grasps of the step", Values(&StepMeasures::margin_deg), PlotMark::kDisc}};
    if (HasAny(&StepMeasures::rest_margin_deg)) {
      plot.series.push_back(
          {"forces at rest", Values(&StepMeasures::rest_margin_deg), PlotMark::kRing});
    }
    plot.limit = PlotLimit{0, "", false};
    plot.failed = failed_;
    return Figure(
        FormatStepPlot(plot), "What friction is left.",
        "Discs: the friction half-angle less the smallest one at which every grasp of the "
        "step is force closure. Rings: the friction half-angle less the largest angle "
        "between a finger's force and its normal, at rest after the step in the replay.");
  }

  [[nodiscard]] std::string Table() const {
    std::string head;
    for (const auto& [style, name] :
         std::initializer_list<std::pair<const char*, const char*>>{{"number", "Step"},
                                                                    {"", "What happens"},
                                                                    {"number minor", "Needs"},
                                                                    {"number", "Margin"},
                                                                    {"number", "Displacement"},
                                                                    {"number minor", "Rotation"},
                                                                    {"number", "Slip"},
                                                                    {"", "Verdict"}}) {
      head += Element("th", "scope=\"col\" " + Attribute("class", style), name);
    }
    std::string rows;
    for (const ReportStep& step : report_.steps) rows += Row(step) + "\n";
    return Element("div", "class=\"scroll\"",
                   Element("table", "",
                           Element("thead", "", Element("tr", "", head)) + "\n" +
                               Element("tbody", "", "\n" + rows))) +
           "\n" +
           Element("p", "class=\"note\"",
                   "Needs: the smallest friction half-angle at which every grasp of the step is "
                   "force closure. Margin: what is left of the plan’s friction. Displacement, "
                   "rotation and slip: the largest in the replay of the step and the shakes after "
                   "it.") +
           "\n";
  }

  [[nodiscard]] std::string Row(const ReportStep& step) const {
    const int index = step.check.index;
    const StepMeasures& measures = measures_[index];
    std::string cells;
    const auto number = [&](const std::string& text, std::string_view style = "number") {
      cells += Element("td", Attribute("class", style), EscapeMarkup(text));
    };
    number(std::to_string(index));
    const std::string title = EscapeMarkup(Capitalized(EntryTitle(plan_, index)));
    cells += Element(
        "td", "",
        HasPicture(index) ? Element("a", Attribute("href", "#" + Anchor(index)), title) : title);
    number(Required(step), "number minor");
    number(TextOr(measures.margin_deg, DegreesText));
    const StepReplay* replay = step.replay && !step.skipped ? &*step.replay : nullptr;
    number(replay ? LengthText(replay->displacement_m) : kNothing);
    number(replay ? NumberText(replay->rotation_deg) + "°" : kNothing, "number minor");
    number(replay ? LengthText(replay->slip_m) : kNothing);
    cells += Element("td", "", EscapeMarkup(VerdictText(step)));
    return Element("tr", Attribute("class", VerdictName(step.verdict())), cells);
  }

  [[nodiscard]] static std::string Required(const ReportStep& step) {
    if (step.check.skipped) return kNothing;
    if (!step.check.required) {
      const bool judged =
          step.check.reason == Reason::kNotForceClosure || step.check.reason == Reason::kNotProved;
      return judged ? "none" : kNothing;
    }
    return DegreesText(Degrees(step.check.required->upper));
  }

  [[nodiscard]] static std::string VerdictText(const ReportStep& step) {
    const std::string verdict(VerdictName(step.verdict()));
    if (step.verdict() != regrasp::Verdict::kFail) return verdict;
    return verdict + ": " + std::string(ReasonName(step.reason()));
  }

  [[nodiscard]] bool HasPicture(int index) const {
    return !pictures_.empty() && !pictures_[index].webp.empty();
  }
  [[nodiscard]] static std::string Anchor(int index) { return "frame" + std::to_string(index); }

  [[nodiscard]] std::string Frames() const {
    std::string frames;
    for (const ReportStep& step : report_.steps) {
      if (HasPicture(step.check.index)) frames += Frame(step);
    }
    if (frames.empty()) return "";
    return Element("h2", "", "Frames") + "\n" +
           Element("p", "class=\"note\"",
                   "Each picture shows the state after its step. A finger keeps its number and "
                   "colour; a cone is what friction allows, an arrow the force. A ring marks a "
                   "finger just placed, a pale finger with an arrow one that leaves, a dashed line "
                   "the way of one that moved.") +
           "\n" + Element("div", "class=\"frames\"", "\n" + frames) + "\n";
  }

  [[nodiscard]] std::string Frame(const ReportStep& step) const {
    const int index = step.check.index;
    const PagePicture& picture = pictures_[index];
    const std::string title = EntryTitle(plan_, index);
    const std::string name =
        index == 0 ? Capitalized(title) : "Step " + std::to_string(index) + ", " + title;
    std::string text = VerdictText(step);
    if (measures_[index].margin_deg) {
      text += ", " + DegreesText(*measures_[index].margin_deg) + " of friction left";
    }
    const std::string image = "<img " + Attribute("alt", name) + " " +
                              Attribute("width", std::to_string(picture.width)) + " " +
                              Attribute("height", std::to_string(picture.height)) + " " +
                              Attribute("src", DataUri("image/webp", picture.webp)) + " />";
    return Element("figure",
                   Attribute("id", Anchor(index)) + " " +
                       Attribute("class", VerdictName(step.verdict())),
                   image + Element("figcaption", "",
                                   Element("b", "", EscapeMarkup(name + ".")) + " " +
                                       EscapeMarkup(Capitalized(text) + "."))) +
           "\n";
  }

  const Report& report_;
  const Plan& plan_;
  const std::vector<PagePicture>& pictures_;
  std::vector<StepMeasures> measures_;
  std::optional<int> failed_;
};

}  // namespace

std::string FormatReportHtml(const Report& report, const Plan& plan,
                             const std::vector<PagePicture>& pictures) {
  assert(pictures.empty() || pictures.size() == report.steps.size());
  return Page(report, plan, pictures).Format();
}

int PagePictureWidth(int count) {
  // A picture of w pixels takes about 0.07 w² bytes: 2 MB, 2 MB, and 10 kB for each.
  constexpr int kLarge = 800, kMedium = 560, kSmall = 320;
  constexpr int kManyLarge = 24, kManyMedium = 60;
  if (count <= kManyLarge) return kLarge;
  return count <= kManyMedium ? kMedium : kSmall;
}

}  // namespace regrasp
