#include "planner/plan/check_step.h"

#include <algorithm>
#include <numbers>
#include <set>

#include "planner/base/number.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/motion/path_force_closure.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check_closure.h"
#include "planner/plan/plan.h"
#include "planner/plan/plan_reach.h"
#include "planner/plan/projection.h"

namespace regrasp::plan {

namespace {

/// Return whether a contact can change from one face to another at a common point.
/// It reaches and leaves that point without leaving the faces.
bool TurnsAtCommonPoint(const object::Object& object, const grasp::Contact& from,
                        const grasp::Contact& to, double tolerance) {
  // Each of the two points may be off by the tolerance.
  const auto common = object.CommonPoints(from.face, to.face, from.p, 2 * tolerance);
  return std::ranges::any_of(common, [&](const Eigen::Vector3d& p) {
    return object.ContainsSegment(from.face, from.p, p, tolerance) &&
           object.ContainsSegment(to.face, p, to.p, tolerance);
  });
}

}  // namespace

std::optional<std::string> FindMotionFault(const object::Object& object, const grasp::Contact& from,
                                           const grasp::Contact& to) {
  const double tolerance = object::kPointTolerance * object.diameter();
  if (from.face == to.face) {
    if (object.ContainsSegment(from.face, from.p, to.p, tolerance)) return std::nullopt;
    return "leaves face " + std::to_string(from.face);
  }
  const std::string faces =
      "from face " + std::to_string(from.face) + " to face " + std::to_string(to.face);
  if (!((from.p - to.p).norm() <= tolerance)) {
    return "moves " + faces + " without rotating at a common point";
  }
  if (!TurnsAtCommonPoint(object, from, to, tolerance)) {
    return "rotates " + faces + ", which have no common point there";
  }
  if (grasp::AngleBetween(from.n, to.n) > std::numbers::pi - kNormalTolerance) {
    return "rotates " + faces + ", whose normals are opposite";
  }
  return std::nullopt;
}

namespace {

std::string FingerName(FingerIndex finger) { return "finger " + std::to_string(finger); }

std::string WaypointName(std::size_t waypoint) { return "waypoint " + std::to_string(waypoint); }

std::string StateName(std::size_t state) { return "state " + std::to_string(state); }

/// Waypoint number of a grasp that is not a waypoint of a sliding step.
constexpr int kNoWaypoint = -1;

/// Return "waypoint 2: finger 1", or "finger 1" without a waypoint.
std::string At(int waypoint, FingerIndex finger) {
  return waypoint < 0 ? FingerName(finger) : WaypointName(waypoint) + ": " + FingerName(finger);
}

Fault FaultOf(FingerIndex finger, int waypoint = kNoWaypoint) {
  return {.fingers = {finger}, .waypoint = waypoint};
}

/// Return the fault of a contact that is not at its expected place.
Fault Misplaced(FingerIndex finger, int waypoint, const grasp::Contact& found,
                const grasp::Contact& expected) {
  return {.fingers = {finger}, .found = found, .expected = {expected}, .waypoint = waypoint};
}

/// Format the distance between two points of the object.
std::string LengthText(const CheckContext& context, const Eigen::Vector3d& a,
                       const Eigen::Vector3d& b) {
  return FormatLength((a - b).stableNorm() * context.plan.scale);
}

void CheckSurface(const CheckContext& context, const FingerGrasp& grasp, int waypoint,
                  StepFault& fault) {
  for (const FingerContact& held : grasp) {
    if (held.contact.face.valid()) continue;
    // Located contacts without a face are as given; locating them again finds the reason.
    const ProjectedContact projected = ProjectContact(context.object, held.contact);
    // The details of a fault require a search of the surface.
    if (!fault.Wants(projected.reason)) continue;
    const grasp::Contact nearest = NearestContact(context.object, held.contact);
    const std::string detail =
        projected.reason == Reason::kOffSurface
            ? " is " + LengthText(context, held.contact.p, nearest.p) + " off the surface"
            : ": " + projected.detail;
    fault.Add(projected.reason, At(waypoint, held.finger) + detail,
              Misplaced(held.finger, waypoint, held.contact, nearest));
  }
}

/// Check a finger's number.
/// If more fingers are in contact than the hand has, one of them is named twice or is outside the
/// hand.
void CheckFingerNumber(const CheckContext& context, FingerIndex finger, int waypoint,
                       StepFault& fault) {
  if (finger >= 0 && finger < context.plan.fingers) return;
  fault.Add(Reason::kTooManyFingers,
            At(waypoint, finger) + " not found: the hand has " +
                std::to_string(context.plan.fingers) + " fingers, numbered from 0",
            FaultOf(finger, waypoint));
}

/// Check a static grasp for fingers at the same point.
void CheckCoincidence(const CheckContext& context, const FingerGrasp& grasp, StepFault& fault) {
  // Too many fingers are a separate fault, and may be too many to compare.
  if (grasp.size() > static_cast<std::size_t>(context.plan.fingers)) return;
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    for (std::size_t j = i + 1; j < grasp.size(); ++j) {
      const double distance = (grasp[i].contact.p - grasp[j].contact.p).norm();
      if (distance <= context.tolerance()) {
        fault.Add(Reason::kCoincidentFingers,
                  FingerName(grasp[i].finger) + " and " + FingerName(grasp[j].finger) +
                      " are in contact at the same point",
                  {.fingers = {grasp[i].finger, grasp[j].finger}});
      }
    }
  }
}

/// Check that each finger has one contact.
void CheckNamedOnce(const FingerGrasp& grasp, int waypoint, StepFault& fault) {
  std::set<FingerIndex> seen;
  for (const FingerContact& held : grasp) {
    if (!seen.insert(held.finger).second) {
      fault.Add(Reason::kFingerNotFree, At(waypoint, held.finger) + " is named twice",
                FaultOf(held.finger, waypoint));
    }
  }
}

/// Return the states of a path after a state.
HandPath PathFrom(const HandState* state, const HandPath& path) {
  HandPath all;
  if (state != nullptr) all.push_back(*state);
  all.insert(all.end(), path.begin(), path.end());
  return all;
}

void AddObstacle(const std::optional<Obstacle>& obstacle, StepFault& fault) {
  if (obstacle) fault.Add(Reason::kUnreachable, obstacle->detail, obstacle->fault);
}

/// Initialize the result before force closure is decided.
void BeginForceClosure(const CheckContext& context, StepCheck& check) {
  if (!context.judge_force_closure) return;
  check.force_closure = true;
  check.required = grasp::RequiredFrictionAngle{0, 0};
}

StepCheck Finish(StepCheck check, const StepFault& fault) {
  check.reason = fault.reason();
  check.detail = fault.detail();
  check.fault = fault.fault();
  return check;
}

void CheckContinuity(const CheckContext& context, const FingerGrasp& before,
                     const FingerGrasp& first, StepFault& fault) {
  for (const FingerContact& held : before) {
    const FingerContact* moved = FindFinger(first, held.finger);
    if (moved == nullptr) continue;
    if (!AreSameContact(held.contact, moved->contact, context.tolerance())) {
      const double angle = grasp::AngleBetween(held.contact.n, moved->contact.n);
      fault.Add(
          Reason::kDiscontinuous,
          At(0, held.finger) + " is " + LengthText(context, held.contact.p, moved->contact.p) +
              " from its contact before the step" +
              (angle > kNormalTolerance ? ", its normal rotated by " + FormatDegrees(Degrees(angle))
                                        : ""),
          Misplaced(held.finger, 0, moved->contact, held.contact));
    } else if (held.contact.face.valid() && moved->contact.face.valid() &&
               FindMotionFault(context.object, held.contact, moved->contact)) {
      fault.Add(
          Reason::kDiscontinuous,
          At(0, held.finger) +
              " is not at its contact before the step: a gap in the surface, or a wall, thinner "
              "than the point tolerance separates them",
          Misplaced(held.finger, 0, moved->contact, held.contact));
    }
  }
}

/// Check that the fingers of a waypoint are those in contact before the step.
void CheckSameFingers(const FingerGrasp& before, const FingerGrasp& waypoint, int index,
                      StepFault& fault) {
  for (const FingerContact& held : before) {
    if (FindFinger(waypoint, held.finger) == nullptr) {
      Fault missing = FaultOf(held.finger, index);
      missing.expected = {held.contact};
      fault.Add(Reason::kDiscontinuous, At(index, held.finger) + " not found", missing);
    }
  }
  for (const FingerContact& held : waypoint) {
    if (FindFinger(before, held.finger) == nullptr) {
      fault.Add(Reason::kDiscontinuous, At(index, held.finger) + " was not in contact before",
                FaultOf(held.finger, index));
    }
  }
}

void CheckWaypoint(const CheckContext& context, const FingerGrasp& before,
                   const FingerGrasp& waypoint, int index, StepFault& fault) {
  CheckSurface(context, waypoint, index, fault);
  CheckNamedOnce(waypoint, index, fault);
  for (const FingerContact& held : waypoint) CheckFingerNumber(context, held.finger, index, fault);
  CheckSameFingers(before, waypoint, index, fault);
}

/// Return whether a normal is between those of the faces at a point: equal to the normal of a face
/// or, on edges and corners, no farther from any of them than they are from each other.
bool IsBetweenFaces(const object::Object& object, const std::vector<FaceIndex>& faces,
                    const Eigen::Vector3d& normal) {
  double farthest = 0;
  double spread = 0;
  double nearest = std::numbers::pi;
  for (const FaceIndex face : faces) {
    const Eigen::Vector3d& inward = object.inward_normal(face);
    const double angle = grasp::AngleBetween(normal, inward);
    farthest = std::max(farthest, angle);
    nearest = std::min(nearest, angle);
    for (const FaceIndex other : faces) {
      spread = std::max(spread, grasp::AngleBetween(inward, object.inward_normal(other)));
    }
  }
  return nearest <= kNormalTolerance || farthest <= spread + kNormalTolerance;
}

/// Check the contacts at a state of an in-hand motion with rolling.
/// They are on the surface, and their normals are those of the surface there.
void CheckRolled(const CheckContext& context, const FingerGrasp& before, const FingerGrasp& rolled,
                 int state, StepFault& fault) {
  CheckNamedOnce(rolled, kNoWaypoint, fault);
  CheckSameFingers(before, rolled, kNoWaypoint, fault);
  for (const FingerContact& held : rolled) {
    const auto add = [&](Reason reason, const std::string& what) {
      const grasp::Contact nearest = NearestContact(context.object, held.contact);
      fault.Add(reason, FingerName(held.finger) + what + " in " + StateName(state),
                Misplaced(held.finger, kNoWaypoint, held.contact, nearest));
    };
    const std::vector<FaceIndex> faces =
        context.object.FacesNear(held.contact.p, SurfaceTolerance(context.object));
    if (faces.empty()) {
      add(Reason::kOffSurface, " is off the surface");
    } else if (std::abs(held.contact.n.norm() - 1) > kNormalLengthTolerance ||
               !IsBetweenFaces(context.object, faces, held.contact.n)) {
      add(Reason::kWrongNormal, " has a normal that is not between those of its faces");
    }
  }
}

/// Check the motions between waypoints that have no other faults.
void CheckMotions(const CheckContext& context, const Align& step, StepFault& fault) {
  for (std::size_t w = 0; w + 1 < step.waypoints.size(); ++w) {
    for (const FingerContact& from : step.waypoints[w]) {
      const FingerContact* to = FindFinger(step.waypoints[w + 1], from.finger);
      if (const auto wrong = FindMotionFault(context.object, from.contact, to->contact)) {
        const auto index = static_cast<int>(w);
        fault.Add(Reason::kLeavesFace,
                  "on the path to " + At(index + 1, from.finger) + " " + *wrong,
                  Misplaced(from.finger, index + 1, to->contact, from.contact));
      }
    }
  }
}

/// Return the fingers of a motion's start at their contacts at an instant of it.
FingerGrasp FingersAt(const FingerGrasp& from, const motion::GraspMotion& motion, double t) {
  FingerGrasp there = from;
  for (std::size_t i = 0; i < there.size(); ++i) there[i].contact = motion[i].At(t);
  return there;
}

motion::GraspMotion MotionBetween(const FingerGrasp& from, const FingerGrasp& to) {
  motion::GraspMotion motion;
  for (const FingerContact& held : from) {
    motion.emplace_back(held.contact, FindFinger(to, held.finger)->contact);
  }
  return motion;
}

/// Return a note on why a proof may be missing for a motion that is force closure at every instant.
std::string SoftNote(const CheckContext& context) {
  if (context.plan.torsion == 0) return "";
  return "; a soft finger counts as a hard point while its normal rotates";
}

std::string UnprovedText(const motion::PathForceClosure& path, const std::string& way,
                         const std::optional<grasp::RequiredFrictionAngle>& required) {
  const std::string at = FormatShort(path.at) + " of the path " + way;
  if (path.ended_early) {
    return "force closure is not proved: the search for proofs ended at " + at +
           ", at the limit of pieces";
  }
  return "force closure is not proved near " + at + ": " + std::to_string(path.undecided) +
         " pieces, each a millionth of the path, are neither proved nor refuted" +
         (required ? "; the whole path is certainly force closure only from " +
                         FormatRequiredDegrees(Degrees(required->upper)) + "°"
                   : "");
}

/// Include the motion of the contacts from one grasp to the next in a step's force closure.
/// @param grasps  grasps of the same fingers: the waypoints of a sliding step, or those at the
///     states of an in-hand motion with rolling.
/// @param name  name of a grasp in messages.
void IncludeMotion(const CheckContext& context, const std::vector<FingerGrasp>& grasps,
                   int waypoint, std::string (*name)(std::size_t), StepCheck& check,
                   StepFault& fault) {
  if (!context.judge_force_closure) return;
  const FingerGrasp& from = grasps[waypoint];
  const motion::GraspMotion motion = MotionBetween(from, grasps[waypoint + 1]);
  const object::WrenchFrame frame = context.object.wrench_frame();
  const motion::PathForceClosure path =
      motion::DecidePathForceClosure(motion, frame, context.friction_angle, context.decisions);
  std::optional<double> proven;
  if (path.holds()) proven = context.friction_angle;
  const auto required =
      motion::ComputePathRequiredFrictionAngle(motion, frame, proven, context.bounds);
  check.required = Larger(check.required, required);
  check.undecided += path.undecided;
  const std::string way = "from " + name(waypoint) + " to " + name(waypoint + 1);
  const bool allowed = context.allow_undecided && !path.ended_early;
  const auto lost_at = [&](const std::optional<grasp::RequiredFrictionAngle>& needed) {
    Fault loss = LossOfClosure(context, FingersAt(from, motion, path.at), needed);
    loss.waypoint = waypoint;
    return loss;
  };
  if (path.decision == grasp::Decision::kNo) {
    const auto there = grasp::ComputeRequiredFrictionAngle(motion::GraspAt(motion, path.at), frame);
    check.force_closure = false;
    const Fault loss = lost_at(there);
    fault.Add(Reason::kNotForceClosure,
              "at " + FormatShort(path.at) + " of the path " + way + " the grasp " +
                  AngleNeeded(context, there),
              loss);
  } else if (path.decision == grasp::Decision::kTooClose && !allowed) {
    LeaveUnproved(UnprovedText(path, way, required) + SoftNote(context), lost_at(required), check,
                  fault);
  } else if (!required && !allowed) {
    LeaveUnproved("on the path " + way + " no bound on the required friction angle is proved" +
                      SoftNote(context),
                  lost_at(required), check, fault);
  }
}

}  // namespace

void StepFault::Add(Reason reason, const std::string& detail, const Fault& fault) {
  if (!Wants(reason)) return;
  reason_ = reason;
  detail_ = detail;
  fault_ = fault;
}

StepCheck CheckHold(const CheckContext& context) {
  const FingerGrasp& initial = context.plan.initial;
  StepCheck check;
  check.kind = "hold";
  StepFault fault;
  CheckSurface(context, initial, kNoWaypoint, fault);
  CheckNamedOnce(initial, kNoWaypoint, fault);
  for (const FingerContact& held : initial) {
    CheckFingerNumber(context, held.finger, kNoWaypoint, fault);
  }
  CheckCoincidence(context, initial, fault);
  if (fault.none()) {
    BeginForceClosure(context, check);
    const HandPath path = PathFrom(context.state, {});
    check.ends_supported = IncludeRest(context, initial, "the initial grasp", path, check, fault);
    AddObstacle(FindRestObstacle(context.object, initial, context.least_radius()), fault);
  }
  return Finish(check, fault);
}

StepCheck CheckSwitch(const CheckContext& context, const FingerGrasp& before, const Switch& step) {
  StepCheck check;
  check.kind = StepKind(step);
  StepFault fault;
  CheckSurface(context, step.place, kNoWaypoint, fault);
  CheckNamedOnce(step.place, kNoWaypoint, fault);
  for (const FingerContact& placed : step.place) {
    CheckFingerNumber(context, placed.finger, kNoWaypoint, fault);
    if (const FingerContact* holds = FindFinger(before, placed.finger)) {
      fault.Add(Reason::kFingerNotFree,
                FingerName(placed.finger) + " is placed, but is already in contact",
                Misplaced(placed.finger, kNoWaypoint, placed.contact, holds->contact));
    }
  }
  std::set<FingerIndex> released;
  for (const FingerIndex finger : step.release) {
    CheckFingerNumber(context, finger, kNoWaypoint, fault);
    const bool again = !released.insert(finger).second;
    if (!again && FindFinger(before, finger) != nullptr) continue;
    fault.Add(Reason::kFingerNotHolding,
              FingerName(finger) + " is released" + (again ? " twice" : ", but is not in contact"),
              FaultOf(finger));
  }
  const FingerGrasp after = GraspAfter(before, step);
  CheckCoincidence(context, after, fault);
  if (fault.none()) {
    BeginForceClosure(context, check);
    const SwitchMotion motion = step.motion.value_or(SwitchMotion());
    const HandPath place = PathFrom(context.state, motion.place);
    const HandPath release = PathFrom(place.empty() ? nullptr : &place.back(), motion.release);
    (void)IncludeRest(context, before, "the grasp before the step", place, check, fault);
    check.ends_supported =
        IncludeRest(context, after, "the grasp after the step", release, check, fault);
    AddObstacle(FindStepObstacle(context.object, before, step, context.least_radius()), fault);
  }
  return Finish(check, fault);
}

StepCheck CheckMove(const CheckContext& context, const FingerGrasp& before, const Move& step) {
  StepCheck check;
  check.kind = StepKind(Move{});
  StepFault fault;
  const HandPath path = PathFrom(context.state, step.path);
  if (step.contacts.empty()) {
    BeginForceClosure(context, check);
    check.ends_supported =
        IncludeRest(context, before, "the grasp of the in-hand motion", path, check, fault);
    return Finish(check, fault);
  }
  for (std::size_t i = 0; i < step.contacts.size(); ++i) {
    CheckRolled(context, before, step.contacts[i], static_cast<int>(i), fault);
  }
  CheckCoincidence(context, step.contacts.back(), fault);
  CheckContinuity(context, before, step.contacts.front(), fault);
  if (fault.none()) {
    BeginForceClosure(context, check);
    (void)IncludeRest(context, before, "the grasp before the step", {}, check, fault);
    (void)IncludeRest(context, step.contacts.back(), "the grasp after the step", {}, check, fault);
    for (std::size_t i = 0; i + 1 < step.contacts.size(); ++i) {
      IncludeMotion(context, step.contacts, static_cast<int>(i), StateName, check, fault);
    }
  }
  return Finish(check, fault);
}

StepCheck CheckAlign(const CheckContext& context, const FingerGrasp& before, const Align& step) {
  StepCheck check;
  check.kind = StepKind(step);
  StepFault fault;
  if (step.waypoints.empty()) {
    fault.Add(Reason::kDiscontinuous, "waypoints not found");
    return Finish(check, fault);
  }
  for (std::size_t w = 0; w < step.waypoints.size(); ++w) {
    CheckWaypoint(context, before, step.waypoints[w], static_cast<int>(w), fault);
  }
  CheckCoincidence(context, step.waypoints.back(), fault);
  CheckContinuity(context, before, step.waypoints.front(), fault);
  // All other faults precede leaves-face; faulty waypoints may be too large to pair.
  if (fault.none()) CheckMotions(context, step, fault);
  if (fault.none()) {
    BeginForceClosure(context, check);
    (void)IncludeRest(context, step.waypoints.front(), "the grasp before the step", {}, check,
                      fault);
    (void)IncludeRest(context, step.waypoints.back(), "the grasp after the step", {}, check, fault);
    for (std::size_t w = 0; w + 1 < step.waypoints.size(); ++w) {
      IncludeMotion(context, step.waypoints, static_cast<int>(w), WaypointName, check, fault);
    }
    AddObstacle(FindStepObstacle(context.object, before, step, context.least_radius()), fault);
  }
  return Finish(check, fault);
}

}  // namespace regrasp::plan
