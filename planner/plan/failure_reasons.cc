#include "planner/plan/failure_reasons.h"

#include <algorithm>
#include <array>

namespace regrasp::plan {

namespace {

using enum FailureCheck;

constexpr std::array kFailureReasons = std::to_array<FailureReason>({
    {.name = "off-surface",
     .check = kAnalytic,
     .meaning = "A contact is farther than 1e-6 of the object's diameter from the surface, or than "
                "the precision of float32 coordinates if that is larger.",
     .causes = "Many contacts: the plan was made for another object or another unit of length.\n"
               "One contact: its coordinates were rounded or edited.",
     .remedies = "Use a point on the surface.\nIf many contacts are off, plan again for this file.",
     .see = "formats.md#tolerances",
     .about = "tolerances"},
    {.name = "wrong-normal",
     .check = kAnalytic,
     .meaning = "The normal of a contact is not of unit length (to 1e-4), or no face at that point "
                "has it (to 0.1°).",
     .causes = "The normal points out of the object instead of into it.\n"
               "The normal was interpolated or smoothed.",
     .remedies = "Use the inward unit normal of the face at the contact.",
     .see = "formats.md#tolerances",
     .about = "tolerances"},
    {.name = "finger-not-free",
     .check = kAnalytic,
     .meaning = "A placed finger is already in contact, or a finger is named twice in the initial "
                "grasp, in `place` or in a waypoint.",
     .causes = "An earlier step does not release the finger.",
     .remedies = "Place another finger.\nRelease this finger in an earlier step."},
    {.name = "finger-not-holding",
     .check = kAnalytic,
     .meaning = "A released finger was not in contact before the step, or is named twice. A finger "
                "that the same step places was not in contact before it.",
     .causes = "An earlier step already releases the finger.",
     .remedies = "Release a holding finger, once."},
    {.name = "too-many-fingers",
     .check = kAnalytic,
     .meaning =
         "More fingers are in contact than the hand has, also between placing and releasing. "
         "Or a finger number is outside the hand.",
     .causes = "`fingers` in the plan is too small.\n"
               "Finger numbers in the file start at 1 instead of 0.",
     .remedies =
         "Use a finger of the hand.\nUse a hand with more fingers (`fingers` in the plan)."},
    {.name = "coincident-fingers",
     .check = kAnalytic,
     .meaning =
         "Two fingers are in contact at the same point in a static grasp: the initial grasp, "
         "or the grasp after a step. During a switch or a sliding step fingers may meet.",
     .causes = "The same contact is given for two fingers.",
     .remedies = "Use different points for the two fingers."},
    {.name = "discontinuous",
     .check = kAnalytic,
     .meaning = "A sliding step does not begin with the grasp before it, or its fingers change. A "
                "point beyond a slit or a thin wall is not that grasp either.",
     .causes = "The first waypoint was omitted, rounded or edited.",
     .remedies = "Let the first waypoint be the grasp before the step.\n"
                 "Use the same fingers in all waypoints."},
    {.name = "leaves-face",
     .check = kAnalytic,
     .meaning =
         "Between two waypoints a finger crosses a border, a notch, a hole, a slit or a wall, "
         "however narrow. Or it continues on another face without turning at a point that "
         "both faces share.",
     .causes = "A waypoint is missing at the border between two faces.\n"
               "The straight line between two waypoints crosses a hole or a notch.",
     .remedies = "Add a waypoint at each border that a finger crosses."},
    {.name = "not-force-closure",
     .check = kAnalytic,
     .meaning = "A grasp of the step is not force closure at this friction: before or after a "
                "switch, or anywhere along a sliding step. With a `patch_radius` this includes "
                "static grasps with the mean normals of their contact patches.",
     .causes = "The plan is checked at less friction than it was planned for.\n"
               "The grasp has no friction margin, and a contact moved slightly.\n"
               "All contacts are on one side of the object.",
     .remedies = "Plan with a larger friction margin (plan --optimize margin).\n"
                 "Plan at less friction than you check.\n"
                 "Use fingertips with at least the required friction angle, which the report "
                 "contains.",
     .see = "force_closure.md",
     .about = "force closure"},
    {.name = "not-proved",
     .check = kAnalytic,
     .meaning = "Force closure is neither proved nor refuted somewhere along a sliding step, or no "
                "required friction angle is found.",
     .causes = "The required friction angle is within rounding of the available one.\n"
               "Contacts are collinear or coincide for an instant.",
     .remedies = "Add waypoints.\nPlan with a slightly larger friction margin.\n"
                 "Pass --allow undecided if you accept few undecided pieces without a proof.",
     .see = "analytic_check.md#force-closure-along-a-sliding-step",
     .about = "how it is decided"},
    {.name = "unreachable",
     .check = kAnalytic,
     .meaning =
         "A finger cannot reach its contact, which is in a sealed cavity or, in the replay, "
         "in a concave corner. Or a finger of the given radius overlaps the object or another "
         "finger there.",
     .causes = "The plan was made for thinner fingers.\nThe contact is in a concave corner.\n"
               "The contact is on an inner shell of the object.",
     .remedies = "Use contacts that a finger reaches from outside, away from concave corners.\n"
                 "Plan with --finger-radius.",
     .see = "replay_variants.md#thick-fingers",
     .about = "thick fingers"},
    {.name = "off-point",
     .check = kAnalytic,
     .meaning =
         "In a plan with `\"contacts\": \"given\"`, a contact is farther than 1e-3 of the "
         "object's diameter from all points of the object's file. Or a finger moves along the "
         "surface.",
     .causes = "The object is a surface reconstructed from points, and the plan uses contacts "
               "between them.",
     .remedies = "Plan with --planner points=given."},
    {.name = "hand-jumps",
     .check = kHand,
     .meaning =
         "With `--hand`: a step does not begin with the last state of the previous step (object "
         "to 1 nm and 10 nrad, joint to 1 nrad). Or a step has no path of the hand, or a "
         "path has another number of fingers or joints than the hand.",
     .causes = "Steps were removed, reordered or joined from different plans.\n"
               "The plan was made for another hand file.",
     .remedies = "Begin the path of each step with the last state of the previous one, with all "
                 "joints of the hand.\nPlan again with this hand file."},
    {.name = "tip-off-contact",
     .check = kHand,
     .meaning =
         "With `--hand`: the fingertip sphere of a holding finger is not at its contact. The "
         "tolerance is 1 µm in a static grasp and 100 µm along a motion.",
     .causes = "Joint angles were rounded or come from another model of the hand.\n"
               "Two states of a motion are too far apart.",
     .remedies = "Correct the joint angles.\nAdd states to the path."},
    {.name = "joint-limit",
     .check = kHand,
     .meaning = "With `--hand`: a joint exceeds its limits. In the hand replay: by more than 1°.",
     .causes = "The plan was made for a model with wider limits.\n"
               "In the replay, contact forces rotate a joint beyond its limit.",
     .remedies = "Use a joint configuration within the limits.\nUse another contact."},
    {.name = "hand-collides",
     .check = kHand,
     .meaning =
         "With `--hand`: a link is nearer than the clearance to another link, to the palm or "
         "to the object. The reason also applies if the check cannot certify the clearance. "
         "In the hand replay: a link touches something.",
     .causes = "The plan was made with a smaller --clearance.\n"
               "In the replay, a finger deviates from its planned path.",
     .remedies = "Use another path.\nUse other contacts.\nPlan with a larger --clearance."},
    {.name = "torque-limit",
     .check = kReplay,
     .meaning = "With `--replay hand`: an actuator is at its force limit for longer than 50 ms.",
     .causes = "The grasp force is too large for the actuators.\n"
               "The object is too heavy.\n"
               "The finger is almost extended, so that a joint needs a large torque.",
     .remedies = "Use a smaller grasp force (--grasp-force).\nUse a lighter object.\n"
                 "Use joint configurations in which the finger is stronger."},
    {.name = "coupling-violated",
     .check = kHand,
     .meaning =
         "With `--hand`: a joint is more than 1 µrad from the angle that its coupling "
         "requires (an equality constraint, `<mimic>`, or `couplings` of the hand file). With "
         "`--replay hand`: it is more than 1° from that angle.",
     .causes = "The plan was made with a hand file without couplings.\n"
               "The model's coupling is softer than that of the real hand.",
     .remedies = "Plan again with a hand file that `hand --model` writes.\n"
                 "Use a model whose coupling is as hard as that of the real hand.",
     .see = "hand_model.md",
     .about = "models of a hand"},
    {.name = "tip-penetrates",
     .check = kReplay,
     .meaning = "With `--replay hand`: a fingertip is more than 1 mm inside the object, or its "
                "collision geometry, if a sphere represents it, by more than half the sphere's "
                "radius.",
     .causes = "The fingertip sphere is larger than the model's geometry or not inside it.\n"
               "The grasp force is large for the model's contact stiffness.",
     .remedies = "Use a sphere that lies inside the model's geometry.\nPlan with a larger margin.",
     .see = "fingertip_geometry.md",
     .about = "fingertip geometry"},
    {.name = "simulation-unstable",
     .check = kReplay,
     .meaning = "The engine warned, a state was not finite, or the solver did not converge, before "
                "any other fault. The step was not evaluated.",
     .causes = "The unit of length is wrong, so that the object is very large or very small.\n"
               "Grasp force and mass are out of proportion.",
     .remedies =
         "Check the grasp force (--grasp-force), the mass (--mass, --density) and --scale."},
    {.name = "contact-lost",
     .check = kReplay,
     .meaning = "A holding finger left the surface. In a hand replay: it had no force for 20 ms. "
                "Or, at the first hold or after a slide, its sphere is more than 1 mm from its "
                "contact.",
     .causes = "The likely cause in the report, for example [`edge`](likely_causes.md#edge) or "
               "[`cone-reached`](likely_causes.md#cone-reached).",
     .remedies = "Choose contacts farther from borders.\nPlan with a larger friction margin."},
    {.name = "slipped",
     .check = kReplay,
     .meaning = "A holding finger slid by more than --tolerance times the object's diameter. In a "
                "hand replay: by more than 1 mm along the surface without rolling, or a sliding "
                "finger is that far off its path.",
     .causes = "The likely cause in the report, for example [`weight`](likely_causes.md#weight) or "
               "[`cone-reached`](likely_causes.md#cone-reached).\n"
               "The grasp has no friction margin, and the fingertips roll.",
     .remedies = "Plan with a larger friction margin (plan --optimize margin, or plan at less "
                 "friction than you check).\nPlan with --min-quality above --disturbance."},
    {.name = "object-moved",
     .check = kReplay,
     .meaning = "The object moved by more than --tolerance, or still moved at the end of "
                "the step or under a disturbance. In a hand replay: it is farther from its planned "
                "pose than --tolerance allows in mm or deg.",
     .causes = "The likely cause in the report, for example "
               "[`quality-below-shake`](likely_causes.md#quality-below-shake) or "
               "[`weight`](likely_causes.md#weight).\n"
               "In a hand replay, the joints yield under the contact forces.",
     .remedies = "Plan grasps of higher quality (plan --min-quality above --disturbance).\n"
                 "Plan with a larger friction margin (plan --optimize margin)."},
    {.name = "not-static",
     .check = kReplay,
     .meaning = "In a hand replay: with the controls of all actuators kept constant for one second "
                "in a static grasp, the object moves by more than 1 mm or 2.5°. The grasp is held "
                "by the controller and not by the servos alone.",
     .causes = "The grasp force is large for the stiffness of the servos, so that opposed fingers "
               "buckle.\n"
               "The contact forces are close to the edges of their friction cones.",
     .remedies = "Use a smaller grasp force (--grasp-force).\nUse stiffer servos.\n"
                 "Plan with a larger friction margin (plan --optimize margin).",
     .see = "hand_replay.md#static-grasps",
     .about = "static grasps"},
    {.name = "trials-failed",
     .check = kTrials,
     .meaning = "The plan passes without noise, and fewer trials pass than --trials min-pass-rate "
                "requires.",
     .causes = "The plan has too little margin for the given errors of friction, pose or joints.",
     .remedies = "Plan with a larger friction margin (plan --optimize margin).\n"
                 "Reduce the errors of the real hand and object, and pass the smaller values.",
     .see = "robustness_trials.md",
     .about = "robustness trials"},
    {.name = "conditions-failed",
     .check = kTrials,
     .meaning = "The plan passes in the nominal replay, and a smaller share of --conditions passes "
                "than the required one (--conditions require=SHARE).",
     .causes = "The plan has too little margin for errors of sensors, friction or contacts.\n"
               "The controller depends on an accurate object pose.",
     .remedies = "Plan with a larger friction margin (plan --optimize margin).\n"
                 "Use smaller in-hand motions.",
     .see = "conditions.md",
     .about = "conditions"},
    {.name = "start-differs",
     .check = kAnalytic,
     .meaning = "Step 0: the plan's initial grasp is not the grasp of --start.",
     .causes = "The plan was made from another start grasp.",
     .remedies = "Plan from the grasp of --start.\nOmit --start."},
    {.name = "goal-not-reached",
     .check = kAnalytic,
     .meaning =
         "Last step: its contacts are not those of the plan's goal, or the goal is not the "
         "grasp of --goal. With `--hand` also: the object's last pose is not the hand's goal, or "
         "the object is outside a goal set after its step. The tolerance is 1 µm and 1 µrad.",
     .causes = "Steps are missing at the end of the plan.\nThe plan was made for another goal.",
     .remedies = "Add steps that end in the goal.\nPlan for this goal."},
    {.name = "concave-corner",
     .check = kCause,
     .meaning = "No fingertip fits at a contact.",
     .causes = "The contact is in a concave corner.",
     .remedies = "Choose contacts farther from concave corners."},
    {.name = "no-room",
     .check = kCause,
     .meaning = "The fingertip is thicker than the clearance of its contact.",
     .causes = "The contact is in a groove or a hole.",
     .remedies = "Choose another contact.\nUse thinner fingers (--finger-radius)."},
    {.name = "weight",
     .check = kCause,
     .meaning = "The grasp force does not support the weight, or not in addition to the "
                "disturbance.",
     .causes = "The grasp force is small for the object's mass.\n"
               "The grasp is weak in the direction of gravity.",
     .remedies = "Use a larger grasp force (--grasp-force).\n"
                 "Use a lighter object (--mass, --density).\nUse more friction."},
    {.name = "quality-below-shake",
     .check = kCause,
     .meaning = "The grasp quality ε (Ferrari-Canny) is below the size of the disturbance test.",
     .causes = "The grasp is force closure with a small margin.",
     .remedies = "Plan with --min-quality above --disturbance."},
    {.name = "edge",
     .check = kCause,
     .meaning = "A contact is nearer to the border of its face than a finger may slip.",
     .causes = "The planner chose a contact near an edge of the object.",
     .remedies = "Choose contacts farther from borders."},
    {.name = "cone-reached",
     .check = kCause,
     .meaning = "The force of a finger reaches its friction cone.",
     .causes = "The grasp has too little friction margin.",
     .remedies = "Plan with a larger friction margin (plan --optimize margin)."},
    {.name = "not-simulated",
     .check = kCause,
     .meaning = "The replay does not model the fault that the analytic check reports.",
     .causes = "For example a finger number outside the hand: the replay has no such limit.",
     .remedies = "Remove the fault that the analytic check reports."},
    {.name = "no-shake",
     .check = kCause,
     .meaning = "Without a disturbance the replay does not test the grasp.",
     .causes = "--disturbance 0 was passed.",
     .remedies = "Omit --disturbance 0."},
    {.name = "critical-friction",
     .check = kCause,
     .meaning = "The friction is less than 2 % below the required one. Between two engines: within "
                "2 % of it.",
     .causes = "The simulated friction is not exactly Coulomb friction.",
     .remedies = "Plan with a larger friction margin (plan --optimize margin)."},
    {.name = "unstable",
     .check = kCause,
     .meaning = "One of two engines did not converge.",
     .causes = "See [`simulation-unstable`](failure_reasons.md#simulation-unstable).",
     .remedies =
         "Check the grasp force (--grasp-force), the mass (--mass, --density) and --scale."},
    {.name = "unknown",
     .check = kCause,
     .meaning = "No other likely cause applies.",
     .causes = "The values that the report contains were examined.",
     .remedies = "Run `validate --disturbance limits`, which reports the direction in which the "
                 "grasp is weak."},
    {.name = "too-heavy",
     .check = kCause,
     .meaning = "`plan --hand`: in the failed step of the best candidate, the grasp requires a "
                "larger grasp force to support the weight than the actuators exert. The message "
                "states the required force, the weight and the available force.",
     .causes = "The object is heavy for the actuators of the hand.\nThe friction is low.",
     .remedies = "Use a smaller or lighter object (--scale, --mass).\nUse more friction (--mu)."},
    {.name = "too-thick",
     .check = kCause,
     .meaning =
         "`plan --hand`: no grasp is found, and the smallest width of the object exceeds the "
         "largest distance between two fingertips that face each other. The message states "
         "both.",
     .causes = "The unit of length is wrong.\nThe object is too large for the hand.",
     .remedies = "Check --scale.\nUse a smaller object or a larger hand."},
    {.name = "too-thin",
     .check = kCause,
     .meaning = "`plan --hand`: two fingertips come no closer than the diameter of the object. Or "
                "fingers collide in at least 9 of 10 grasps, and the object is thinner than a "
                "fingertip. The message states the lengths and the counts.",
     .causes = "The unit of length is wrong.\nThe fingertips are thick for the object.",
     .remedies = "Check --scale.\nUse a larger object or a hand with thinner fingertips."},
    {.name = "out-of-reach",
     .check = kCause,
     .meaning = "`plan --hand`: from each initial pose, fewer than three fingers reach the object "
                "somewhere on the path. The message states the place, the number of fingers and "
                "the distance of the next finger from its nearest contact.",
     .causes = "The start pose or the goal is too far from the fingers.\n"
               "Joint limits prevent the contact.",
     .remedies = "Choose a start pose and a goal nearer to the fingers (--start-pose).\n"
                 "Omit --start-pose."},
    {.name = "finger-always-required",
     .check = kCause,
     .meaning = "`plan --hand`: a finger takes part in every grasp that the search evaluated. It "
                "never changes its contact, which limits the rotation. The message states the "
                "fingers and the number of grasps.",
     .causes = "Only this finger, usually the thumb, opposes the others.",
     .remedies = "Rotate the object by a smaller angle.\n"
                 "Permit grasps that hold the object by its weight (--closure gravity).\n"
                 "Let gravity act in another direction (--gravity)."},
    {.name = "contacts-roll-off",
     .check = kCause,
     .meaning = "`plan --hand`: at least half of the grasps are lost when their fingertips roll. "
                "Or fingertips leave their contacts in at least half of the failed simulations. Or "
                "contacts of the gaits that were found cannot roll. The message states the counts.",
     .causes = "The faces of the object are small for the rolling fingertips.\n"
               "The object rotates far relative to the fingers.",
     .remedies = "Plan with rolling contacts (--rolling on).\nUse more friction (--mu)."},
    {.name = "time-limit",
     .check = kCause,
     .meaning = "`plan --hand`: the time limit passed before the search ended. The message states "
                "the number of expanded stances and the share of the path that was reached.",
     .causes = "The task requires many contact changes.\nThe machine is busy.",
     .remedies = "Use a longer --time-limit.\nUse more --jobs."},
    {.name = "search-budget",
     .check = kCause,
     .meaning = "`plan --hand`: the search ended without a plan, and no other cause applies. The "
                "message states the number of expanded stances and the share of the path that was "
                "reached.",
     .causes = "The hand cannot perform the task.\nThe search budget is too small.",
     .remedies = "Use another --seed.\nUse a larger budget (--planner gait,budget=N).\n"
                 "Run `plan --explain`, which searches for a change that helps."},
});

/// Return the items of a text with one per line as a Markdown list.
std::string MarkdownItems(std::string_view items) {
  std::string list = "- ";
  for (const char c : items) list += c == '\n' ? "\n- " : std::string(1, c);
  return list + "\n";
}

}  // namespace

std::span<const FailureReason> FailureReasons() { return kFailureReasons; }

const FailureReason* FindFailureReason(std::string_view name) {
  const auto* found = std::ranges::find(kFailureReasons, name, &FailureReason::name);
  return found == kFailureReasons.end() ? nullptr : found;
}

std::string_view FailureCheckName(FailureCheck check) {
  switch (check) {
    case kAnalytic:
      return "analytic check";
    case kHand:
      return "hand check";
    case kReplay:
      return "replay";
    case kTrials:
      return "trials";
    case kCause:
      return "likely cause";
  }
  return "";
}

std::string FailureReasonMarkdown(const FailureReason& reason) {
  std::string text = "### `" + std::string(reason.name) + "`\n\n" + std::string(reason.meaning) +
                     "\n\nUsual causes:\n\n" + MarkdownItems(reason.causes) + "\nRemedies:\n\n" +
                     MarkdownItems(reason.remedies);
  if (!reason.see.empty()) {
    text += "\nSee [" + std::string(reason.about) + "](" + std::string(reason.see) + ").\n";
  }
  return text;
}

}  // namespace regrasp::plan
