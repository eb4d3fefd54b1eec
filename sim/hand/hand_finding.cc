#include "sim/hand/hand_finding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/base/number.h"
#include "planner/object/rotation.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::HandState;
using plan::Reason;

/// Number of directions for moving a part out of another part. For the object the normals of its
/// triangles are used instead.
constexpr int kDirections = 60;
constexpr std::size_t kMostFaces = 24;

/// Tolerances of a goal.
constexpr double kGoalLength = 1e-6;  // metres
constexpr double kGoalAngle = 1e-6;   // radians

std::string DegreesText(double radians) { return FormatDegrees(Degrees(radians)); }

std::string After(const std::string& when) { return when.empty() ? "" : ", " + when; }

/// Return "100 µm and 0.20°", without zero parts.
std::string MotionText(const Isometry3d& a, const Isometry3d& b) {
  constexpr double kNothing = 1e-12;
  const double length = (a.translation() - b.translation()).norm();
  const double turn = object::RotationInBody(a.linear(), b.linear()).angle();
  if (turn <= kNothing) return FormatLength(length);
  if (length <= kNothing) return DegreesText(turn);
  return FormatLength(length) + " and " + DegreesText(turn);
}

std::string PartText(const HandBody& body, int index) {
  const HandPart& part = body.parts()[index];
  return part.body + " of " +
         (part.finger.valid() ? FingerText(body.hand(), part.finger) : "the palm");
}

HandFinding AtJoint(Reason reason, HandBody& body, const HandState& state, FingerIndex finger,
                    int joint, const std::string& number) {
  body.SetJoints(state.joints);
  HandFinding finding{reason, "", {.fingers = {finger}}};
  plan::HandFaultPlace& place = finding.fault.hand.emplace();
  place.state = state;
  // All links that the joint moves, because not every joint has a visible link.
  const int last = static_cast<int>(state.joints[finger].size());
  for (int moved = joint + 1; moved <= last; ++moved) place.links.push_back({finger, moved});
  place.at = body.JointAnchor(finger, joint);
  place.number = number;
  return finding;
}

/// Describe the parts at fault, with their gap.
HandFinding Collision(const HandBody& body, const HandState& state, const std::vector<int>& parts,
                      const Nearness& nearness) {
  HandFinding finding{Reason::kHandCollides, "", {}};
  plan::HandFaultPlace& place = finding.fault.hand.emplace();
  for (const int index : parts) {
    const HandPart& part = body.parts()[index];
    place.links.push_back({part.finger, part.joints});
    const auto& fingers = finding.fault.fingers;
    if (part.finger.valid() && std::ranges::find(fingers, part.finger) == fingers.end()) {
      finding.fault.fingers.push_back(part.finger);
    }
  }
  place.state = state;
  place.at = nearness.at;
  place.gap_m = nearness.gap;
  place.number = nearness.gap < 0 ? FormatLength(-nearness.gap, 2) + " inside"
                                  : FormatLength(nearness.gap, 2) + " apart";
  return finding;
}

/// Return "a is 0.3 mm from b" or "a is 3.2 mm inside b".
std::string NearText(const std::string& a, const std::string& b, double gap,
                     const LimitText& text) {
  if (gap < 0) return a + " is " + text.value + " inside " + b;
  return a + " is " + text.value + " from " + b;
}

/// Return the texts of a gap and of the required gap, metres; negative values are depths.
LimitText GapText(double gap, double needed) {
  if ((gap < 0) == (needed < 0)) return FormatLengthWithLimit(std::abs(gap), std::abs(needed));
  return {FormatLength(std::abs(gap)), FormatLength(std::abs(needed))};
}

/// Return directions evenly distributed over the sphere (a spiral by the golden angle).
std::vector<Vector3d> AllDirections() {
  std::vector<Vector3d> directions;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2.0 * i + 1) / kDirections;
    const double turn = std::numbers::pi * (3 - std::sqrt(5)) * i;
    const double r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return directions;
}

/// Return directions out of the surface that a solid penetrates: the normals of its triangles.
std::vector<Vector3d> WaysOut(const ConvexBody& solid, std::span<const ConvexBody> surface) {
  std::vector<Vector3d> ways;
  for (const ConvexBody& triangle : surface) {
    if (ways.size() == kMostFaces) break;
    if (HaveGap(solid, triangle, 0)) continue;
    const auto& p = triangle.points;
    const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]).stableNormalized();
    const bool known =
        std::ranges::any_of(ways, [&](const Vector3d& way) { return way.dot(normal) > 0.999; });
    if (!known && normal.norm() > 0) ways.push_back(normal);
  }
  return ways;
}

/// Report a final object pose that differs from the goal.
HandFinding GoalMissed(const HandState& last, const Isometry3d& goal) {
  HandFinding finding{Reason::kGoalNotReached,
                      "the object ends " + MotionText(last.pose, goal) + " from its goal",
                      {}};
  plan::HandFaultPlace& place = finding.fault.hand.emplace();
  place.state = last;
  place.pose = goal;
  place.number = MotionText(last.pose, goal);
  return finding;
}

/// Report an object pose outside a goal set.
HandFinding GoalSetMissed(const HandState& now, const plan::GoalMark& goal) {
  const plan::GoalDistance off = goal.set.Distance(now.pose);
  std::string far = off.length > 0 ? FormatLength(off.length) : "";
  if (off.angle > 0) far += (far.empty() ? "" : " and ") + DegreesText(off.angle);
  HandFinding finding{
      Reason::kGoalNotReached,
      "the object is " + far + " outside " +
          (goal.name.empty() ? "its goal set" : "the set of goal \"" + goal.name + "\""),
      {}};
  plan::HandFaultPlace& place = finding.fault.hand.emplace();
  place.state = now;
  place.pose = goal.set.Nearest(now.pose);
  place.number = far;
  return finding;
}

}  // namespace

std::string FingerText(const kinematics::HandModel& hand, FingerIndex finger) {
  return "finger " + std::to_string(finger) + " (" + hand.fingers[finger].name + ")";
}

std::string OtherHandText(const kinematics::HandModel& found, const plan::HandUse& expected) {
  constexpr std::size_t kShown = 12;
  const auto describe = [](const std::string& name, const std::string& file) {
    return file + " (hand " + name + ")";
  };
  if (found.name != expected.name || found.file != expected.file) {
    return "the plan is for another hand, expected " + describe(expected.name, expected.file) +
           ", found " + describe(found.name, found.file);
  }
  return "the plan is for another version of " + describe(found.name, found.file) +
         ": the hand file, its model or a mesh differs, expected SHA-256 " +
         expected.sha256.substr(0, kShown) + "…, found " + found.sha256.substr(0, kShown) + "…";
}

HandFinding NoSuchPath(const std::string& what, const HandState& state) {
  HandFinding finding{Reason::kHandJumps, what, {}};
  finding.fault.hand.emplace().state = state;
  return finding;
}

HandFinding NoSuchFinger(FingerIndex finger, const HandState& state) {
  HandFinding finding =
      NoSuchPath("finger " + std::to_string(finger) + " not found in the hand", state);
  finding.reason = Reason::kTipOffContact;
  finding.fault.fingers = {finger};
  return finding;
}

HandFinding ObjectJumps(const HandState& now, const Isometry3d& before, const std::string& when) {
  HandFinding finding{
      Reason::kHandJumps,
      "the object " + when + " " + MotionText(now.pose, before) + " from its previous pose",
      {}};
  plan::HandFaultPlace& place = finding.fault.hand.emplace();
  place.state = now;
  place.pose = before;
  place.number = MotionText(now.pose, before);
  return finding;
}

std::optional<HandFinding> FindMissedGoal(const plan::Plan& plan, int entry,
                                          const HandState& state) {
  for (const plan::GoalMark& mark : plan.hand->goals) {
    if (mark.step != entry) continue;
    const plan::GoalDistance off = mark.set.Distance(state.pose);
    if (off.length > kGoalLength || off.angle > kGoalAngle) return GoalSetMissed(state, mark);
  }
  if (entry != std::ssize(plan.steps)) return std::nullopt;
  const Isometry3d& goal = plan.hand->goal;
  const double length = (goal.translation() - state.pose.translation()).norm();
  const double turn = object::RotationInBody(goal.linear(), state.pose.linear()).angle();
  if (length <= kGoalLength && turn <= kGoalAngle) return std::nullopt;
  return GoalMissed(state, goal);
}

HandFinding JointJumps(HandBody& body, const HandState& now, FingerIndex finger, int joint,
                       double before) {
  const double angle = now.joints[finger][joint];
  const std::string jump = FormatDegreesWithLimit(Degrees(std::abs(angle - before)), 0).value;
  const LimitText text = FormatDegreesWithLimit(Degrees(angle), Degrees(before));
  HandFinding finding = AtJoint(Reason::kHandJumps, body, now, finger, joint, jump + " off");
  finding.detail = "joint " + body.hand().fingers[finger].joints[joint].name + " of " +
                   FingerText(body.hand(), finger) + " begins the step at " + text.value + ", " +
                   jump + " from its previous angle (" + text.limit + ")";
  return finding;
}

HandFinding JointOutside(HandBody& body, const HandState& state, FingerIndex finger, int joint,
                         const std::string& when) {
  const kinematics::Joint& limits = body.hand().fingers[finger].joints[joint];
  const double angle = state.joints[finger][joint];
  const bool below = angle < limits.lower;
  const double limit = below ? limits.lower : limits.upper;
  const LimitText text = FormatDegreesWithLimit(Degrees(angle), Degrees(limit));
  const LimitText off = FormatDegreesWithLimit(Degrees(std::abs(angle - limit)), 0);
  HandFinding finding = AtJoint(Reason::kJointLimit, body, state, finger, joint,
                                text.value + ", limit " + text.limit);
  finding.detail = "joint " + limits.name + " of " + FingerText(body.hand(), finger) + " is at " +
                   text.value + After(when) + ": " + off.value + (below ? " below" : " beyond") +
                   ", limits " + (below ? text.limit : DegreesText(limits.lower)) + " and " +
                   (below ? DegreesText(limits.upper) : text.limit);
  return finding;
}

HandFinding JointUncoupled(HandBody& body, const HandState& state,
                           const HandBody::Uncoupled& uncoupled, double most,
                           const std::string& when) {
  const kinematics::Joint& joint = body.hand().fingers[uncoupled.finger].joints[uncoupled.joint];
  const std::string off = FormatPlain(Degrees(uncoupled.radians), 3) + "°";
  HandFinding finding = AtJoint(Reason::kCouplingViolated, body, state, uncoupled.finger,
                                uncoupled.joint, off + " off its coupling");
  finding.detail = "joint " + joint.name + " of " + FingerText(body.hand(), uncoupled.finger) +
                   " is at " + DegreesText(state.joints[uncoupled.finger][uncoupled.joint]) +
                   After(when) + ": " + off + " from its coupling (" + uncoupled.source +
                   "), limit " + FormatPlain(Degrees(most), 3) + "°";
  return finding;
}

HandFinding TipOff(HandBody& body, const HandState& state, FingerIndex finger,
                   const Vector3d& expected, double tolerance, const std::string& when) {
  body.SetJoints(state.joints);
  const kinematics::Finger& of = body.hand().fingers[finger];
  const Vector3d found = body.TipCentre(finger);
  const double off = (found - expected).norm();
  const auto [value, limit] = FormatLengthWithLimit(off, tolerance);
  HandFinding finding{Reason::kTipOffContact, "", {.fingers = {finger}}};
  finding.detail = "the fingertip of " + FingerText(body.hand(), finger) + " is " + value +
                   " from its contact" + After(when) + ", limit " + limit;
  plan::HandFaultPlace& place = finding.fault.hand.emplace();
  place.state = state;
  place.links = {{finger, static_cast<int>(of.joints.size())}};
  place.at = found;
  place.number = FormatLength(off);
  place.tip = {found, expected, of.tip.radius};
  return finding;
}

double GapBetween(HandBody& body, const HandState& state, int a, int b) {
  body.SetJoints(state.joints);
  const ConvexBody other = body.Place(b);
  return NearestOf(body.Place(a), {&other, 1}).gap;
}

double GapToObject(HandBody& body, const HandState& state, int part,
                   std::span<const ConvexBody> surface) {
  body.SetJoints(state.joints);
  return NearestOf(Moved(state.pose.inverse(), body.Place(part)), surface).gap;
}

HandFinding PartsCollide(HandBody& body, const HandState& state, int a, int b, double clearance,
                         const std::string& when) {
  body.SetJoints(state.joints);
  const ConvexBody first = body.Place(a);
  const ConvexBody second = body.Place(b);
  Nearness nearness = NearestOf(first, {&second, 1});
  if (nearness.gap < 0) {
    nearness.gap = -FreeingDistance(first, {&second, 1}, AllDirections());
  }
  HandFinding finding = Collision(body, state, {a, b}, nearness);
  const LimitText text = GapText(nearness.gap, clearance);
  finding.detail = NearText(PartText(body, a), PartText(body, b), nearness.gap, text) +
                   After(when) + ", required clearance " + text.limit;
  return finding;
}

HandFinding PartMeetsObject(HandBody& body, const HandState& state, int part,
                            std::span<const ConvexBody> surface, double needed,
                            const std::string& when) {
  body.SetJoints(state.joints);
  const ConvexBody solid = Moved(state.pose.inverse(), body.Place(part));
  Nearness nearness = NearestOf(solid, surface);
  const std::vector<Vector3d> ways = WaysOut(solid, surface);
  if (nearness.gap < 0 && !ways.empty()) nearness.gap = -FreeingDistance(solid, surface, ways);
  nearness.at = state.pose * nearness.at;
  HandFinding finding = Collision(body, state, {part}, nearness);
  const LimitText text = GapText(nearness.gap, needed);
  finding.detail = NearText(PartText(body, part), "the object", nearness.gap, text) + After(when) +
                   (needed < 0 ? ", limit for a touching fingertip " : ", required clearance ") +
                   text.limit;
  return finding;
}

}  // namespace regrasp::sim
