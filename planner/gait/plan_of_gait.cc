#include "planner/gait/plan_of_gait.h"

#include <algorithm>
#include <utility>

#include "planner/gait/object_motion.h"
#include "planner/kinematics/finger_kinematics.h"

namespace regrasp::gait {

namespace {

bool IsSameKeyframe(const Keyframe& a, const Keyframe& b) {
  return a.pose.matrix() == b.pose.matrix() && a.configurations == b.configurations;
}

plan::HandState StateOf(const Keyframe& frame, const kinematics::HandModel& hand) {
  plan::HandState state{frame.pose, {}};
  for (std::size_t i = 0; i < hand.fingers.size(); ++i) {
    state.joints.push_back(kinematics::JointAngles(hand.fingers[i], frame.configurations[i]));
  }
  return state;
}

/// Return the hand states of the keyframes first to last of a segment.
plan::HandPath PathOf(const PlanSegment& segment, int first, int last,
                      const kinematics::HandModel& hand) {
  plan::HandPath path;
  for (int i = first; i <= last; ++i) path.push_back(StateOf(segment.path[i], hand));
  return path;
}

plan::HandPath PathOf(const PlanSegment& segment, const kinematics::HandModel& hand) {
  return PathOf(segment, 0, static_cast<int>(segment.path.size()) - 1, hand);
}

plan::FingerGrasp GraspAtEnd(const plan::Plan& plan) {
  plan::FingerGrasp grasp = plan.initial;
  for (const plan::Step& step : plan.steps) grasp = plan::GraspAfter(grasp, step);
  return grasp;
}

/// Return the sliding step: some fingers slide, the others stay.
plan::Align SlideOf(const PlanSegment& segment, const plan::FingerGrasp& grasp,
                    const kinematics::HandModel& hand) {
  plan::Align align;
  align.motion.emplace();
  for (std::size_t i = 0; i < segment.waypoints.size(); ++i) {
    align.waypoints.push_back(grasp);
    for (plan::FingerContact& held : align.waypoints.back()) {
      const auto slid = std::ranges::find(segment.slid, held.finger, &PlanSegment::Slid::finger);
      if (slid != segment.slid.end()) {
        held.contact = segment.waypoints[i][slid - segment.slid.begin()];
      }
    }
    if (i == 0) continue;
    align.motion->push_back(
        PathOf(segment, segment.waypoint_frames[i - 1], segment.waypoint_frames[i], hand));
  }
  return align;
}

/// Return the in-hand motion, with its contacts if they roll.
/// @param grasp  grasp before the step, which gives the order of the fingers.
plan::Move MoveOf(const PlanSegment& segment, const plan::FingerGrasp& grasp,
                  const kinematics::HandModel& hand) {
  plan::Move move{PathOf(segment, hand)};
  for (const plan::FingerGrasp& rolled : segment.rolled) {
    move.contacts.push_back(grasp);
    for (plan::FingerContact& held : move.contacts.back()) {
      held.contact = plan::FindFinger(rolled, held.finger)->contact;
    }
  }
  return move;
}

/// Mark the goal of the request in a plan, unless it is the final pose with the default tolerance.
void MarkGoal(const Gait& gait, const GaitRequest& request, plan::Plan& plan) {
  const ObjectTask task(request.scale * request.solid->mass_properties().centroid, request.turn,
                        request.goal, request.turn_tolerance);
  const auto goal = task.GoalFrom(gait.start.pose);
  if (!goal || goal->HasDefaultTolerance()) return;
  plan.hand->goals.push_back({"", static_cast<int>(plan.steps.size()), *goal});
}

/// Return whether a grasp that gravity supports at the start of a path is supported at all its
/// poses. Other grasps are force closure.
bool KeepsSupport(const HandSetup& setup, const ContactAssignment& assignment,
                  const std::vector<Keyframe>& path) {
  if (setup.carrier == nullptr) return true;
  grasp::Grasp contacts;
  for (const int point : assignment) {
    if (point == kNone) continue;
    contacts.push_back({setup.points[point].p / setup.scale, setup.points[point].n, {}});
  }
  std::vector<Eigen::Isometry3d> poses;
  for (const Keyframe& frame : path) poses.push_back(frame.pose);
  return !setup.carrier->HoldsAt(contacts, poses.front()) ||
         setup.carrier->HoldsAlong(contacts, poses);
}

/// Return whether a segment belongs to the same plan step as the previous one.
/// True if a finger is placed and then another one is released.
bool BelongTogether(const std::vector<PlanSegment>& segments, std::size_t i) {
  using enum PlanSegment::Kind;
  return i > 0 && segments[i].kind == kRelease && segments[i - 1].kind == kPlace &&
         segments[i].finger != segments[i - 1].finger;
}

}  // namespace

Gait MergeMoves(const HandSetup& setup, const Gait& gait) {
  using enum PlanSegment::Kind;
  Gait fewer{gait.initial, gait.start, {}};
  for (std::size_t i = 0; i < gait.segments.size(); ++i) {
    if (gait.segments[i].kind != kMove) {
      fewer.segments.push_back(gait.segments[i]);
      continue;
    }
    PlanSegment move = gait.segments[i];
    for (; i + 1 < gait.segments.size() && gait.segments[i + 1].kind == kMove; ++i) {
      const std::vector<Keyframe>& more = gait.segments[i + 1].path;
      move.path.insert(move.path.end(), more.begin() + 1, more.end());
    }
    if (setup.rolled_on == nullptr) {
      if (IsSameKeyframe(move.path.front(), move.path.back())) continue;
      auto straight = FindMove(setup, AssignmentAtEnd(fewer), move.path.front(), move.path.back());
      if (straight && KeepsSupport(setup, AssignmentAtEnd(fewer), *straight)) {
        move.path = *std::move(straight);
      }
    }
    fewer.segments.push_back(std::move(move));
  }
  return fewer;
}

plan::Plan PlanOf(const Gait& gait, const GaitRequest& request,
                  const std::vector<grasp::Contact>& contacts) {
  const kinematics::HandModel& hand = *request.hand;
  plan::Plan plan;
  plan.scale = request.scale;
  plan.dimension = 3;
  plan.friction_angle = request.criteria.friction_angle;
  plan.fingers = static_cast<int>(hand.fingers.size());
  plan.planner = "gait";
  plan.hand =
      plan::HandUse{hand.name, hand.file, hand.sha256, StateOf(gait.start, hand),
                    (gait.segments.empty() ? gait.start : gait.segments.back().path.back()).pose};
  if (!hand.has_own_up || request.gravity_support) plan.hand->up = hand.up;
  plan.hand->gravity_support = request.gravity_support;
  plan.hand->mass_kg = request.mass_kg;
  for (FingerIndex finger{0}; finger < plan.fingers; ++finger) {
    if (gait.initial[finger] == kNone) continue;
    plan.initial.push_back({finger, contacts[gait.initial[finger]]});
  }
  for (std::size_t i = 0; i < gait.segments.size(); ++i) {
    const PlanSegment& segment = gait.segments[i];
    switch (segment.kind) {
      case PlanSegment::Kind::kMove:
        plan.steps.emplace_back(MoveOf(segment, GraspAtEnd(plan), hand));
        break;
      case PlanSegment::Kind::kPlace: {
        const plan::FingerContact placed{segment.finger, contacts[segment.contact]};
        const plan::HandPath path = PathOf(segment, hand);
        plan.steps.emplace_back(
            plan::Switch{{placed}, {}, plan::SwitchMotion{path, {path.back()}}});
        break;
      }
      case PlanSegment::Kind::kSlide:
        plan.steps.emplace_back(SlideOf(segment, GraspAtEnd(plan), hand));
        break;
      case PlanSegment::Kind::kRelease: {
        plan::HandPath path = PathOf(segment, hand);
        if (!BelongTogether(gait.segments, i)) {
          plan.steps.emplace_back(plan::Switch{{}, {}, plan::SwitchMotion{{path.front()}, {}}});
        }
        auto& last = std::get<plan::Switch>(plan.steps.back());
        last.release.push_back(segment.finger);
        last.motion->release = std::move(path);
        break;
      }
    }
  }
  plan.goal = plan::ContactsOf(GraspAtEnd(plan));
  MarkGoal(gait, request, plan);
  return plan;
}

int CountChanges(const Gait& gait, int steps) {
  int changes = 0;
  int count = 0;
  for (std::size_t i = 0; i < gait.segments.size(); ++i) {
    if (!BelongTogether(gait.segments, i)) ++count;
    if (count > steps) break;
    if (gait.segments[i].kind != PlanSegment::Kind::kMove) ++changes;
  }
  return changes;
}

}  // namespace regrasp::gait
