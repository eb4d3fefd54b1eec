#include "report/failure.h"

#include <algorithm>
#include <cmath>

#include "planner/base/angle.h"
#include "planner/base/number.h"

namespace regrasp::report {

namespace {

using plan::Reason;
using sim::Cause;

/// Frictions that are asked for are rounded up to hundredths of a degree, and to thousandths.
constexpr double kDegreeSteps = 100;
constexpr double kMuSteps = 1000;

double RoundUp(double value, double steps) { return std::ceil(value * steps) / steps; }

std::string MendFriction(const ReportStep& step) {
  const std::string other =
      "plan for more to spare (plan --optimize margin, or plan at less "
      "friction than is checked)";
  if (!step.check.required) return "no friction is sure to be enough: other contacts, " + other;
  const double degrees = RoundUp(Degrees(step.check.required->upper), kDegreeSteps);
  const double mu = RoundUp(std::tan(Radians(degrees)), kMuSteps);
  return "fingertips with more friction (--friction-angle " + FormatShort(degrees) + " or --mu " +
         FormatShort(mu) + "; the shake may need a little more), or " + other;
}

/// By the likely cause of a replay that fails what the analysis passes.
std::string MendReplay(const ReportStep& step) {
  switch (step.disagreement ? step.disagreement->cause : Cause::kUnknown) {
    case Cause::kConcaveCorner:
    case Cause::kNoClearance:
      return "contacts farther from concave corners, or thinner fingers (--finger-radius)";
    case Cause::kWeight:
      return "a larger --squeeze, a lighter object (--mass, --density), or more friction";
    case Cause::kQuality:
      return "a plan of better grasps (plan --min-quality above the --shake), more friction, or a "
             "smaller --shake";
    case Cause::kEdge:
      return "contacts farther from the borders of their faces";
    case Cause::kConeReached:
      return "more friction, or a plan with more to spare (plan --optimize margin)";
    default:
      return "more friction or a smaller --shake; --stress shows in which direction the grasp is "
             "weak";
  }
}

std::string MendOf(const ReportStep& step) {
  switch (step.reason()) {
    case Reason::kOffSurface:
      return "a point on the surface; where many are off, this is not the object that the plan was "
             "made for, or not in its unit of length: plan again for this file";
    case Reason::kWrongNormal:
      return "the inward normal of the face there, of length 1";
    case Reason::kFingerNotFree:
      return "another finger, or a step before that releases this one";
    case Reason::kFingerNotHolding:
      return "releasing a finger that holds";
    case Reason::kTooManyFingers:
      return "fewer fingers at a time, or a hand of more (fingers in the plan)";
    case Reason::kCoincidentFingers:
      return "different points for the two fingers";
    case Reason::kDiscontinuous:
      return "a first waypoint that is the grasp before the step, and the same fingers in all";
    case Reason::kLeavesFace:
      return "a waypoint at each border that a finger crosses: between two waypoints it goes "
             "straight inside one face, or keeps its point and turns its normal";
    case Reason::kNotForceClosure:
      return MendFriction(step);
    case Reason::kNotProved:
      return "a little more friction, waypoints in between, or --allow-undecided where the pieces "
             "without a proof are few";
    case Reason::kUnreachable:
      return "thinner fingers (--finger-radius), or a plan for fingers of that radius (plan "
             "--finger-radius)";
    case Reason::kSimulationUnstable:
      return "another --squeeze or --mass: the replay says nothing of this plan";
    case Reason::kContactLost:
    case Reason::kSlipped:
    case Reason::kObjectMoved:
      return MendReplay(step);
    case Reason::kStartDiffers:
      return "planning from the grasp of --start, or leaving --start out";
    case Reason::kGoalNotReached:
      return "steps that end in the goal grasp, or another goal";
    case Reason::kNone:
      return "";
  }
  return "";
}

std::string WhyOf(const ReportStep& step) {
  const bool caused = step.disagreement && step.disagreement->between == sim::Between::kReplayFails;
  return step.detail() + (caused ? "; likely cause: " + step.disagreement->text : "");
}

}  // namespace

std::optional<Failure> DescribeFailure(const Report& report) {
  const auto failed = std::ranges::find(report.steps, Verdict::kFail, &ReportStep::verdict);
  if (failed == report.steps.end()) return std::nullopt;
  return Failure{failed->check.index,
                 "step " + std::to_string(failed->check.index) + " (" + failed->check.kind +
                     ") fails: " + std::string(plan::ReasonName(failed->reason())),
                 WhyOf(*failed), MendOf(*failed)};
}

std::string FormatFailure(const Report& report) {
  const auto failure = DescribeFailure(report);
  if (!failure) return "";
  return failure->what + "\n  why: " + failure->why + "\n  what would mend it: " + failure->mend +
         "\n";
}

}  // namespace regrasp::report
