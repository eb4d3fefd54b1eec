#include "report/failure.h"

#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/object/object.h"
#include "planner/object/read_object.h"
#include "planner/plan/projection.h"
#include "report/report_table.h"

namespace regrasp::report {

namespace {

using plan::Reason;
using sim::Cause;

/// Steps per unit to which required coefficients of friction are rounded up.
constexpr double kMuSteps = 1000;

/// Return whether a step passes the analytic check and fails in the replay.
bool FailsInReplay(const ReportStep& step) { return step.check.reason == Reason::kNone; }

/// Return the required friction angle, degrees, as in the detail of the failure.
std::string RequiredText(const ReportStep& step, const Report& report) {
  return FormatRequiredDegrees(Degrees(step.check.required->upper), Degrees(report.friction_angle))
      .value;
}

/// Return " 7.34" if the required friction angle is known.
std::string DegreesAsked(const ReportStep& step, const Report& report) {
  return step.check.required ? " " + RequiredText(step, report) : "";
}

std::string FixOfFriction(const ReportStep& step, const Report& report) {
  const std::string other =
      "plan with more friction margin (plan --optimize margin, or plan at less "
      "friction than you check)";
  if (!step.check.required)
    return "use other contacts, because no friction is certainly sufficient: " + other;
  const std::string degrees = RequiredText(step, report);
  const double mu = std::ceil(std::tan(Radians(*ParseDouble(degrees))) * kMuSteps) / kMuSteps;
  return "use fingertips with more friction (--friction-angle " + degrees + " or --mu " +
         FormatShort(mu) + "; the disturbance test can require slightly more), or " + other;
}

/// Return a fix for the likely cause of a failed replay of a step that passes the analysis.
std::string FixOfReplay(const ReportStep& step, const Report& report) {
  if (report.settings && report.settings->hand) {
    return "plan with more margin (plan at less friction than you check, --min-quality 0.05 or "
           "more), "
           "or with smaller in-hand motions, in which fingertips roll less";
  }
  switch (step.disagreement ? step.disagreement->cause : Cause::kUnknown) {
    case Cause::kConcaveCorner:
    case Cause::kNoClearance:
      return "use contacts farther from concave corners, or thinner fingers (--finger-radius)";
    case Cause::kWeight:
      return "use a larger --grasp-force, a lighter object (--mass, --density), or more friction "
             "(--friction-angle)";
    case Cause::kQuality:
      return "plan better grasps (plan --min-quality above the --disturbance), or use more "
             "friction "
             "(--friction-angle)";
    case Cause::kEdge:
      return "use contacts farther from the borders of their faces";
    case Cause::kConeReached:
      return "use more friction (--friction-angle), or plan with more friction margin (plan "
             "--optimize margin)";
    default:
      return "use more friction (--friction-angle), or plan with more friction margin (plan "
             "--optimize margin); note: --disturbance limits reports in which direction the grasp "
             "is weak";
  }
}

std::string FixOfCollision(const ReportStep& step) {
  if (FailsInReplay(step)) {
    return "plan with a larger --clearance, or with motions in which fingertips roll less";
  }
  const plan::Fault& fault = step.fault();
  const bool apart = fault.hand && fault.hand->gap_m && *fault.hand->gap_m > 0;
  if (!apart) return "use another path or other contacts, because links penetrate each other";
  return "use another path or other contacts; note: the check passes with a --clearance below " +
         FormatLength(*fault.hand->gap_m);
}

std::string FixOfReach(const plan::Fault& fault) {
  if (fault.finger_radius > 0) {
    return "use thinner fingers (--finger-radius), or plan for fingers of that radius (plan "
           "--finger-radius)";
  }
  return "use contacts that a finger reaches from outside, farther from concave corners";
}

/// Return ": (0, 0.6, -0.8)".
std::string NormalText(const ReportStep& step, const Report& report) {
  const grasp::Grasp& expected = step.fault().expected;
  return expected.empty() ? "" : ": " + plan::VectorText(expected.front().n, report.dimension);
}

std::string SuggestedFixOf(const ReportStep& step, const Report& report) {
  switch (step.reason()) {
    case Reason::kOffSurface:
      return "use a point on the surface; if many are off, the plan was made for another object or "
             "unit of length: plan again for this file";
    case Reason::kWrongNormal:
      return "use the inward unit normal of the face there" + NormalText(step, report);
    case Reason::kFingerNotFree:
      return "use another finger, or release this one in an earlier step";
    case Reason::kFingerNotHolding:
      return "release a finger that is in contact, once";
    case Reason::kTooManyFingers:
      return "use a finger of the hand, or a hand with more fingers (fingers in the plan)";
    case Reason::kCoincidentFingers:
      return "use different points for the two fingers";
    case Reason::kDiscontinuous:
      return "begin with the grasp before the step, and use the same fingers in all waypoints";
    case Reason::kLeavesFace:
      return "add a waypoint at each border that a finger crosses";
    case Reason::kNotForceClosure:
      return FixOfFriction(step, report);
    case Reason::kNotProved:
      return "use slightly more friction (--friction-angle" + DegreesAsked(step, report) +
             "), add waypoints, or pass --allow undecided if few pieces have no proof";
    case Reason::kUnreachable:
      return FixOfReach(step.fault());
    case Reason::kOffPoint:
      return "use contacts at points of the object's file, connected by switches (plan --planner "
             "points=given)";
    case Reason::kHandJumps:
      return "begin the path of every step with the last state before it, with all joints of the "
             "hand";
    case Reason::kTipOffContact:
      return "use joint angles that place the fingertips at their contacts, and more states on the "
             "path";
    case Reason::kJointLimit:
      return "use a joint configuration within the limits, or a contact that it reaches";
    case Reason::kHandCollides:
      return FixOfCollision(step);
    case Reason::kTorqueLimit:
      return "use a smaller --grasp-force, a lighter object (--mass), or joint configurations in "
             "which "
             "the finger is stronger";
    case Reason::kCouplingViolated:
      return FailsInReplay(step)
                 ? "use a model whose coupling is as hard as that of the real hand (solref and "
                   "solimp of its equality), or a smaller --grasp-force"
                 : "plan again with a hand file that hand --model writes, whose couplings the "
                   "joint angles keep";
    case Reason::kTipPenetrates:
      return "use a fingertip sphere inside the model's geometry (hand --model fits one), or plan "
             "with a larger margin";
    case Reason::kSimulationUnstable:
      return "check --grasp-force, --mass and --scale";
    case Reason::kContactLost:
    case Reason::kSlipped:
    case Reason::kObjectMoved:
      return FixOfReplay(step, report);
    case Reason::kNotStatic:
      return "use a smaller --grasp-force or stiffer servos, or plan with more friction margin "
             "(plan at less friction than you check)";
    case Reason::kStartDiffers:
      return "plan from the grasp of --start, or omit --start";
    case Reason::kGoalNotReached:
      if (step.fault().hand) return "plan again, so that the object reaches its goal";
      return "add steps that end in the goal grasp, or use another goal";
    case Reason::kNone:
      return "";
  }
  return "";
}

/// Return the tolerances of a replay by a hand.
std::string HandToleranceText(const sim::HandTolerance& tolerance) {
  return "limit: the object is " + FormatLength(tolerance.length_m) + " and " +
         FormatDegrees(Degrees(tolerance.angle_rad)) +
         " from its planned pose (--tolerance in mm and deg), in a static grasp half of "
         "that; a "
         "finger in contact slips " +
         FormatLength(tolerance.slip_m);
}

constexpr double kMilliseconds = 1e3;  ///< per second

/// Significant digits of a limit that is printed next to a value that exceeds it.
constexpr int kLimitDigits = 6;

/// Return the limits of displacement and slip.
std::string ToleranceText(const Report& report) {
  if (report.settings && report.settings->hand) {
    return HandToleranceText(report.settings->hand->tolerance);
  }
  if (!report.settings) return "limit: --tolerance times the object's diameter";
  return "limit: " +
         FormatLength(report.settings->tolerance * report.settings->diameter_m, kLimitDigits) +
         ", --tolerance " + FormatShort(report.settings->tolerance) + " of the object's diameter";
}

sim::HandTolerance HandToleranceOf(const Report& report) {
  return report.settings && report.settings->hand ? report.settings->hand->tolerance
                                                  : sim::HandTolerance();
}

std::string JointToleranceText(const Report& report) {
  return FormatDegrees(Degrees(HandToleranceOf(report).joint_rad));
}

std::string DepthToleranceText(const Report& report) {
  return FormatLength(HandToleranceOf(report).depth_m);
}

/// Return the rule that a step violates.
std::string RuleOf(const ReportStep& step, const Report& report) {
  const bool is_of_replay = FailsInReplay(step);
  switch (step.reason()) {
    case Reason::kOffSurface:
      return "a contact must be on the surface to within " +
             FormatPlain(100 * object::kPointTolerance, 2) +
             " % of the object's diameter, or the precision of float32 coordinates if that is "
             "coarser";
    case Reason::kWrongNormal:
      return "the normal of a contact must be the inward normal of its face";
    case Reason::kFingerNotFree:
      return "a finger has at most one contact";
    case Reason::kFingerNotHolding:
      return "only a finger in contact can be released, and only once";
    case Reason::kTooManyFingers:
      return "at most the fingers of the hand can be in contact";
    case Reason::kCoincidentFingers:
      return "in a static grasp no two fingers can be at one point";
    case Reason::kDiscontinuous:
      return "a sliding step must begin with the grasp before it and keep its fingers";
    case Reason::kLeavesFace:
      return "between two waypoints a finger must move straight inside one face, or keep its point "
             "and rotate from one face to the next";
    case Reason::kNotForceClosure:
      return "with this friction the contact forces cannot resist every wrench";
    case Reason::kNotProved:
      return "force closure must be proved at every instant";
    case Reason::kUnreachable:
      return "a finger approaches along the normal, and must not overlap the object or another "
             "finger";
    case Reason::kOffPoint:
      return "in a plan with given contacts, each contact must be at a point of the object's file: "
             "at most " +
             FormatPlain(100 * object::kAtGivenPoint, 2) +
             " % of the object's diameter from it, and without moving along the surface";
    case Reason::kHandJumps:
      return "a step must begin with the last state of hand and object: to 1 nm and 10 nrad for "
             "the object, to 1 nrad for a joint";
    case Reason::kTipOffContact:
      return "the fingertip sphere of a finger in contact must be at its contact, to 1 µm in a "
             "static grasp and to 100 µm along a motion";
    case Reason::kJointLimit:
      return "joints must stay within the limits of the hand's model" +
             (is_of_replay ? ", to " + JointToleranceText(report) : "");
    case Reason::kHandCollides:
      if (is_of_replay) {
        return "links of the hand must not touch each other, the palm or the object; only "
               "fingertips may touch the object";
      }
      return "the links of the hand must keep the clearance from each other, the palm and the "
             "object on the whole path; a fingertip in contact may penetrate by 0.3 mm";
    case Reason::kTorqueLimit:
      return "no actuator of the hand may be at its force limit for longer than " +
             FormatShort(kMilliseconds * HandToleranceOf(report).limit_s) + " ms";
    case Reason::kCouplingViolated:
      return is_of_replay ? "coupled joints must stay within " + JointToleranceText(report) +
                                " of their coupling"
                          : "coupled joints must keep the relation of the hand's model in every "
                            "state of the plan, to 1 µrad";
    case Reason::kTipPenetrates:
      return "a fingertip may penetrate the object by at most " + DepthToleranceText(report) +
             ", and its collision geometry, if a sphere represents it, by at most half the "
             "sphere's radius";
    case Reason::kSimulationUnstable:
      return "the simulation must not diverge; this step is not evaluated";
    case Reason::kContactLost:
      return "a finger in contact must stay on the surface";
    case Reason::kSlipped:
    case Reason::kObjectMoved:
      return ToleranceText(report);
    case Reason::kNotStatic:
      return "with constant controls the object must stay within " +
             FormatLength(HandToleranceOf(report).frozen_m) + " and " +
             FormatDegrees(Degrees(HandToleranceOf(report).frozen_rad)) +
             " of its pose in the static grasp for one second";
    case Reason::kStartDiffers:
      return "the plan must begin with the grasp of --start";
    case Reason::kGoalNotReached:
      if (step.fault().hand) {
        return "the object must end at the goal of the plan's hand and be in each goal set of the "
               "plan, to 1 µm and 1 µrad";
      }
      return "the contacts after the last step must be those of the goal";
    case Reason::kNone:
      return "";
  }
  return "";
}

std::string WhyOf(const ReportStep& step, const Report& report) {
  const bool caused = step.disagreement && step.disagreement->between == sim::Between::kReplayFails;
  return RuleOf(step, report) + (caused ? "; " + sim::LikelyCauseText(*step.disagreement) : "");
}

}  // namespace

std::string Failure::headline() const {
  if (!entry.valid()) return reason + (what.empty() ? "" : ": " + what);
  return "step " + std::to_string(entry) + " (" + kind + ") fails: " + reason +
         (what.empty() ? "" : ": " + what);
}

std::string Failure::line() const {
  return headline() + "; why: " + why + "; help: " + suggested_fix;
}

std::optional<Failure> DescribeFailure(const Report& report) {
  const auto failed = std::ranges::find(report.steps, Verdict::kFail, &ReportStep::verdict);
  if (failed == report.steps.end()) {
    if (report.passed()) return std::nullopt;
    if (!report.trials || report.trials->enough()) {
      return Failure{plan::EntryIndex(),
                     "conditions",
                     kConditionsFailed,
                     ConditionsFailureText(*report.conditions),
                     ConditionsRequiredText(*report.conditions),
                     "plan with larger friction margins (plan --optimize margin, or plan at less "
                     "friction than you check), or with smaller in-hand motions"};
    }
    return Failure{
        plan::EntryIndex(),
        "trials",
        kTrialsFailed,
        TrialsFailureText(*report.trials),
        TrialsRequiredText(*report.trials),
        "plan with larger friction margins (plan --optimize margin, or plan at less friction "
        "than you check), or reduce the errors of the real hand and object"};
  }
  return Failure{
      failed->check.index, failed->check.kind,     std::string(plan::ReasonName(failed->reason())),
      failed->detail(),    WhyOf(*failed, report), SuggestedFixOf(*failed, report)};
}

std::string VerdictHeadline(const Report& report) {
  if (const auto failure = DescribeFailure(report)) return failure->headline();
  const bool some = report.trials && report.trials->passed < report.trials->options.count;
  std::string text = some ? "pass " + TrialsPassText(*report.trials) : "";
  if (report.conditions && report.conditions->passed() < report.conditions->applicable()) {
    text += (text.empty() ? "pass " : ", ") + ConditionsPassText(*report.conditions);
  }
  return text;
}

std::string HeadingText(const Report& report) {
  if (const auto failure = DescribeFailure(report)) {
    const std::string where = !failure->entry.valid() ? "FAIL"
                              : failure->entry == 0
                                  ? "FAIL at the hold"
                                  : "FAIL at step " + std::to_string(failure->entry);
    return where + ": " + failure->what;
  }
  const std::size_t steps = report.steps.size() - 1;
  const std::string pass = report.trials ? "PASS " + TrialsPassText(*report.trials) : "PASS";
  if (steps == 0) return pass + ": the hold passes";
  return pass + ": the hold and " +
         (steps == 1 ? "the step" : "all " + std::to_string(steps) + " steps") + " pass";
}

std::string FormatFailure(const Report& report) {
  const auto failure = DescribeFailure(report);
  if (!failure) return "";
  return failure->headline() + "\n  why: " + failure->why + "\n  help: " + failure->suggested_fix +
         "\n  more: regrasp validate --explain " + failure->reason + "\n";
}

}  // namespace regrasp::report
