#include "report/failure.h"

#include <algorithm>
#include <cmath>

#include "planner/base/limit_text.h"
#include "planner/base/number.h"
#include "planner/object/given_points.h"
#include "planner/object/object.h"
#include "planner/plan/locate.h"
#include "report/report_table.h"

namespace regrasp::report {

namespace {

using plan::Reason;
using sim::Cause;

/// Coefficients of friction that are required are rounded up to thousandths.
constexpr double kMuSteps = 1000;

/// The friction angle that is enough, degrees, as the detail of the failure has it.
std::string RequiredText(const ReportStep& step, const Report& report) {
  return FormatRequiredDegrees(Degrees(step.check.required->upper), Degrees(report.half_angle))
      .value;
}

/// " 7.34" if an angle is known that is enough.
std::string DegreesAsked(const ReportStep& step, const Report& report) {
  return step.check.required ? " " + RequiredText(step, report) : "";
}

std::string MendFriction(const ReportStep& step, const Report& report) {
  const std::string other =
      "plan for more to spare (plan --optimize margin, or plan at less "
      "friction than is checked)";
  if (!step.check.required) return "other contacts, as no friction is sure to be enough: " + other;
  const std::string degrees = RequiredText(step, report);
  const double mu = std::ceil(std::tan(Radians(*ParseDouble(degrees))) * kMuSteps) / kMuSteps;
  return "fingertips with more friction (--friction-angle " + degrees + " or --mu " +
         FormatShort(mu) + "; to stand the shake may take a little more), or " + other;
}

/// By the likely cause of a replay that fails what the analysis passes.
std::string MendReplay(const ReportStep& step, const Report& report) {
  if (report.settings && report.settings->hand) {
    return "a plan with more to spare (plan at less friction than is checked, --min-quality 0.05 "
           "or more), moves in which tips roll less, or a larger --tolerance in mm, deg";
  }
  const bool shaken = report.settings && report.settings->shake > 0;
  switch (step.disagreement ? step.disagreement->cause : Cause::kUnknown) {
    case Cause::kConcaveCorner:
    case Cause::kNoClearance:
      return "contacts farther from concave corners, or thinner fingers (--finger-radius)";
    case Cause::kWeight:
      return "a larger --grasp-force, a lighter object (--mass, --density), or more friction "
             "(--friction-angle)";
    case Cause::kQuality:
      return "a plan of better grasps (plan --min-quality above the --disturbance), more friction "
             "(--friction-angle), or a smaller --disturbance";
    case Cause::kEdge:
      return "contacts farther from the borders of their faces";
    case Cause::kConeReached:
      return "more friction (--friction-angle), or a plan with more to spare (plan --optimize "
             "margin)";
    default:
      return std::string("more friction (--friction-angle)") +
             (shaken ? ", a smaller --disturbance" : "") +
             " or a larger --tolerance; --disturbance limits shows in which direction the grasp is "
             "weak";
  }
}

/// A clearance helps only where there is one.
std::string MendCollision(const plan::Fault& fault) {
  if (fault.hand && !fault.hand->gap_m) {
    return "a plan whose links keep a larger --clearance, or in which tips roll less";
  }
  const bool apart = fault.hand && fault.hand->gap_m && *fault.hand->gap_m > 0;
  if (!apart) return "a way around, or other contacts: no --clearance allows links in each other";
  return "a way around, other contacts, or a --clearance below the " +
         FormatLength(*fault.hand->gap_m) + " that there are";
}

std::string MendReach(const plan::Fault& fault) {
  if (fault.finger_radius > 0) {
    return "thinner fingers (--finger-radius), or a plan for fingers of that radius (plan "
           "--finger-radius)";
  }
  return "contacts that a finger reaches from outside, farther from concave corners";
}

/// ": (0, 0.6, -0.8)"
std::string NormalText(const ReportStep& step, const Report& report) {
  const grasp::Grasp& expected = step.fault().expected;
  return expected.empty() ? "" : ": " + plan::VectorText(expected.front().n, report.dimension);
}

std::string MendOf(const ReportStep& step, const Report& report) {
  switch (step.reason()) {
    case Reason::kOffSurface:
      return "a point on the surface; where many are off, this is not the object that the plan was "
             "made for, or not in its unit of length: plan again for this file";
    case Reason::kWrongNormal:
      return "the inward normal of the face there, of length 1" + NormalText(step, report);
    case Reason::kFingerNotFree:
      return "another finger, or a step before that releases this one";
    case Reason::kFingerNotHolding:
      return "releasing a finger that holds, once";
    case Reason::kTooManyFingers:
      return "a finger that the hand has, or a hand of more (fingers in the plan)";
    case Reason::kCoincidentFingers:
      return "different points for the two fingers";
    case Reason::kDiscontinuous:
      return "a first waypoint that is the grasp before the step, and the same fingers in all";
    case Reason::kLeavesFace:
      return "a waypoint at each border that a finger crosses";
    case Reason::kNotForceClosure:
      return MendFriction(step, report);
    case Reason::kNotProved:
      return "a little more friction (--friction-angle" + DegreesAsked(step, report) +
             "), waypoints in between, or --allow undecided where the pieces without a proof are "
             "few";
    case Reason::kUnreachable:
      return MendReach(step.fault());
    case Reason::kOffPoint:
      return "contacts at points that the object's file gives, joined by switches (plan --planner "
             "points=given)";
    case Reason::kHandJumps:
      return "a path in every step whose first state is the last one before it, with all joints of "
             "the hand";
    case Reason::kTipOffContact:
      return "joints that put the tips where the contacts are, and more states on the path where "
             "they leave them between two";
    case Reason::kJointLimit:
      return "a posture within the limits, or a contact that the finger reaches within them";
    case Reason::kHandCollides:
      return MendCollision(step.fault());
    case Reason::kTorqueLimit:
      return "a smaller --grasp-force, a lighter object (--mass), or postures in which the finger "
             "has "
             "more strength";
    case Reason::kCouplingViolated:
      return step.fault().hand
                 ? "joint angles that keep the couplings of the hand's model; plan again with a "
                   "hand file that hand --model writes"
                 : "a model whose coupling is as hard as that of the real hand (solref and solimp "
                   "of its equality), a smaller --grasp-force, or a plan whose states keep the "
                   "coupling";
    case Reason::kTipPenetrates:
      return "a fingertip sphere that the model's geometry is inside (hand --model fits one), or a "
             "plan with a larger margin";
    case Reason::kSimulationUnstable:
      return "another --grasp-force or --mass, a smaller --disturbance, or the right --scale where "
             "the "
             "object is of no usual size";
    case Reason::kContactLost:
    case Reason::kSlipped:
    case Reason::kObjectMoved:
      return MendReplay(step, report);
    case Reason::kStartDiffers:
      return "planning from the grasp of --start, or leaving --start out";
    case Reason::kGoalNotReached:
      if (step.fault().hand) return "a last move that ends in the hand's goal, or another goal";
      return "steps that end in the goal grasp, or another goal";
    case Reason::kNone:
      return "";
  }
  return "";
}

/// Of a replay by a hand.
std::string HandToleranceText(const sim::HandTolerance& tolerance) {
  return "the object may be " + FormatLength(tolerance.length_m) + " and " +
         FormatDegrees(Degrees(tolerance.angle_rad)) +
         " from where the plan has it (--tolerance in mm, deg), at rest half of that; a "
         "tip that holds may slip by " +
         FormatLength(tolerance.slip_m);
}

/// Significant digits of a limit that stands beside a value that exceeds it.
constexpr int kLimitDigits = 6;

/// How much may move or slip.
std::string ToleranceText(const Report& report) {
  if (report.settings && report.settings->hand) {
    return HandToleranceText(report.settings->hand->tolerance);
  }
  if (!report.settings) return "more than the --tolerance of the object's diameter";
  return "up to " +
         FormatLength(report.settings->tolerance * report.settings->diameter_m, kLimitDigits) +
         ", --tolerance " + FormatShort(report.settings->tolerance) +
         " of the object's diameter, counts as standing still";
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

/// What a step breaks. @param hand  the fault is of the plan's hand.
std::string RuleOf(Reason reason, bool hand, const Report& report) {
  switch (reason) {
    case Reason::kOffSurface:
      return "a contact lies on the surface to within " + FormatShort(object::kPointTolerance) +
             " of the object's diameter, or the precision of float32 coordinates if that is "
             "coarser";
    case Reason::kWrongNormal:
      return "the normal of a contact is the inward one of its face, which the replay pushes along";
    case Reason::kFingerNotFree:
      return "a finger makes one contact at a time";
    case Reason::kFingerNotHolding:
      return "only a finger that holds before the step can be released, and only once";
    case Reason::kTooManyFingers:
      return "no more fingers touch the object than the hand has";
    case Reason::kCoincidentFingers:
      return "at rest no two fingers stand at one point";
    case Reason::kDiscontinuous:
      return "an align begins with the grasp before it, and its fingers stay the same";
    case Reason::kLeavesFace:
      return "between two waypoints a finger moves straight inside one face, or keeps its point "
             "and turns from one face to the next";
    case Reason::kNotForceClosure:
      return "with this friction forces of the fingers cannot resist every push and twist";
    case Reason::kNotProved:
      return "what is neither proved nor refuted does not pass";
    case Reason::kUnreachable:
      return "a finger comes straight along the normal, and keeps clear of the object and the "
             "others";
    case Reason::kOffPoint:
      return "the plan says that its contacts are at points that the object's file gives: no "
             "farther than " +
             FormatShort(object::kAtGivenPoint) +
             " of the object's diameter from one, and none moves along the surface";
    case Reason::kHandJumps:
      return "hand and object go on from where they are, to 1e-9 m and, of the object, 1e-8 rad, "
             "of "
             "a joint, 1e-9 rad";
    case Reason::kTipOffContact:
      return "the ball of a finger that holds touches its contact, to 1 µm at rest and to 100 µm "
             "all "
             "along a move";
    case Reason::kJointLimit:
      return "joints stay within the limits of the hand's model";
    case Reason::kHandCollides:
      return "the links of the hand keep the clearance from each other, the palm and the object, "
             "on all of the path; a tip that touches may be 0.3 mm in the surface";
    case Reason::kTorqueLimit:
      return "no actuator of the hand stands at the limit of its force for longer than 50 ms";
    case Reason::kCouplingViolated:
      return hand ? "coupled joints keep the relation that the hand's model gives them, in every "
                    "state of the plan to 1e-6 rad"
                  : "joints that the hand couples stay within " + JointToleranceText(report) +
                        " of their coupling";
    case Reason::kTipPenetrates:
      return "a fingertip is no deeper in the object than " + DepthToleranceText(report) +
             ", and its collision geometry, if its sphere stands for it, no deeper than half the "
             "sphere's radius";
    case Reason::kSimulationUnstable:
      return "the simulation came to no end, so nothing is known of the step";
    case Reason::kContactLost:
      return "a finger that holds stays on the surface";
    case Reason::kSlipped:
    case Reason::kObjectMoved:
      return ToleranceText(report);
    case Reason::kStartDiffers:
      return "the plan is to begin with the grasp of --start";
    case Reason::kGoalNotReached:
      if (hand)
        return "the object is to end where the plan's hand has its goal, to 1 µm and 1e-6 rad";
      return "the contacts after the last step are to be those of the goal";
    case Reason::kNone:
      return "";
  }
  return "";
}

std::string WhyOf(const ReportStep& step, const Report& report) {
  const bool caused = step.disagreement && step.disagreement->between == sim::Between::kReplayFails;
  return RuleOf(step.reason(), step.fault().hand.has_value(), report) +
         (caused ? "; " + sim::LikelyCauseText(*step.disagreement) : "");
}

}  // namespace

std::string Failure::headline() const {
  if (!entry.valid()) return reason + (what.empty() ? "" : ": " + what);
  return "step " + std::to_string(entry) + " (" + kind + ") fails: " + reason +
         (what.empty() ? "" : ": " + what);
}

std::string Failure::line() const {
  return headline() + "; why: " + why + "; what would mend it: " + mend;
}

std::optional<Failure> DescribeFailure(const Report& report) {
  const auto failed = std::ranges::find(report.steps, Verdict::kFail, &ReportStep::verdict);
  if (failed == report.steps.end()) {
    if (report.passed()) return std::nullopt;
    return Failure{plan::EntryIndex(),
                   "trials",
                   kTrialsFailed,
                   TrialsFailureText(*report.trials),
                   TrialsRequiredText(*report.trials),
                   "a plan with larger friction margins (plan --optimize margin, or plan at less "
                   "friction than is checked), or smaller errors of the real hand and object"};
  }
  return Failure{
      failed->check.index, failed->check.kind,     std::string(plan::ReasonName(failed->reason())),
      failed->detail(),    WhyOf(*failed, report), MendOf(*failed, report)};
}

std::string VerdictHeadline(const Report& report) {
  if (const auto failure = DescribeFailure(report)) return failure->headline();
  const bool some = report.trials && report.trials->passed < report.trials->options.count;
  return some ? "pass " + TrialsPassText(*report.trials) : "";
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
  if (steps == 0) return pass + ": the hold stands";
  return pass + ": the hold and " +
         (steps == 1 ? "the step" : "all " + std::to_string(steps) + " steps") + " stand";
}

std::string FormatFailure(const Report& report) {
  const auto failure = DescribeFailure(report);
  if (!failure) return "";
  return failure->headline() + "\n  why: " + failure->why +
         "\n  what would mend it: " + failure->mend + "\n";
}

}  // namespace regrasp::report
