#include "report/page/facts.h"

#include <cmath>
#include <string>

#include "planner/base/number.h"
#include "report/page/step_table.h"
#include "report/report_table.h"

namespace regrasp::report {

namespace {

/// Number of significant digits, as in NumberText.
constexpr int kQualityDigits = 3;

/// Class of values that need a line of their own.
constexpr char kLong[] = "digest";

void AddGrasp(const Report& report, FactList& facts) {
  const GraspReport& grasp = *report.grasp;
  const std::optional<grasp::RequiredFrictionAngle>& required = report.steps.front().check.required;
  facts.Add("Needs",
            required ? FormatRequiredDegrees(Degrees(required->upper)) + "°" : "none is enough");
  if (grasp.fingers.empty()) return;
  facts.Add("Quality ε", grasp::QualityText(grasp.quality, kQualityDigits));
  facts.Add("Weakest", "finger " + std::to_string(grasp::WeakestFinger(grasp.fingers)));
}

void AddTrials(const sim::TrialSummary& trials, FactList& facts) {
  facts.Add("Trials", TrialsShareText(trials));
  const std::string failures = TrialsFailureText(trials);
  if (!failures.empty()) facts.Add("Trials that fail", failures);
  facts.Add("Noise", TrialsNoiseText(trials));
}

void AddSettings(const sim::ReplaySettings& settings, FactList& facts) {
  facts.Add("Diameter", LengthText(settings.diameter_m));
  facts.Add("Mass", NumberText(settings.mass_kg) + " kg");
  facts.Add("Grasp force", GraspForceText(settings));
  facts.Add("Disturbance", NumberText(100 * settings.disturbance_ratio) + " % of the grasp force");
  if (settings.protocol == sim::Protocol::kFixed) facts.Add("Protocol", "fixed grasp force");
  if (settings.hand) {
    const sim::HandTolerance& tolerance = settings.hand->tolerance;
    facts.Add("Replay", "by the hand's own actuators");
    facts.Add("Feedback", FeedbackText(settings.hand->sensing));
    facts.Add("Fingertips", settings.hand->tip == sim::TipShape::kBall
                                ? "balls"
                                : "the model's own collision geometry");
    facts.Add("Tolerance", LengthText(tolerance.length_m) + ", " +
                               FormatDegrees(Degrees(tolerance.angle_rad)) + " off the plan");
    facts.Add("Limits", LimitsText(settings.hand->limits));
    return;
  }
  facts.Add("Tolerance", LengthText(settings.tolerance * settings.diameter_m));
}

}  // namespace

Element MakeFacts(const Report& report, const std::vector<StepMeasures>& measures) {
  FactList facts;
  facts.Add("Object", report.object_file + (report.dimension == 2 ? ", planar" : ", a solid"));
  if (!report.planner.empty()) facts.Add("Planner", report.planner);
  if (report.farthest_from_points) {
    facts.Add("Contacts", "at given points, at most " +
                              LengthText(*report.farthest_from_points * report.scale) + " off");
  }
  facts.Add("Friction", FormatDegrees(Degrees(report.friction_angle)) +
                            " (μ = " + NumberText(std::tan(report.friction_angle)) + ")");
  if (report.torsion > 0) {
    facts.Add("Soft fingers", "torsion " + LengthText(report.torsion * report.scale));
  }
  if (report.grasp) AddGrasp(report, facts);
  const plan::EntryIndex weakest = report.weakest_step();
  if (weakest.valid() && !report.grasp && report.steps_passed()) {
    facts.Add("Weakest", StepName(weakest) + ", " +
                             FormatDegrees(measures[weakest].margin_deg.value_or(0)) + " margin");
  }
  if (report.trials) AddTrials(*report.trials, facts);
  if (report.settings) AddSettings(*report.settings, facts);
  if (report.run && !report.run->program.empty()) {
    facts.Add("Program", report.run->program);
    if (!report.run->date.empty()) facts.Add("Validated on", report.run->date + " (UTC)");
    facts.Add("Command, but for where results go", report.run->command, kLong);
  }
  facts.Add("Object, SHA-256", report.object_sha256, kLong);
  facts.Add(report.grasp ? "Grasp, SHA-256" : "Plan, SHA-256", report.plan_sha256, kLong);
  return facts.Make();
}

}  // namespace regrasp::report
