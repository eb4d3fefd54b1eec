#include "planner/gait/plan_of_gait.h"

#include <algorithm>
#include <utility>

#include "planner/gait/object_motion.h"
#include "planner/kinematics/finger_kinematics.h"

namespace regrasp::gait {

namespace {

bool IsSameKeyframe(const Keyframe& a, const Keyframe& b) {
  return a.pose.matrix() == b.pose.matrix() && a.postures == b.postures;
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
      if (straight) move.path = *std::move(straight);
    }
    fewer.segments.push_back(std::move(move));
  }
  return fewer;
}

namespace {

plan::HandState StateOf(const Keyframe& frame, const kinematics::HandModel& hand) {
  plan::HandState state{frame.pose, {}};
  for (std::size_t i = 0; i < hand.fingers.size(); ++i) {
    state.joints.push_back(kinematics::JointAngles(hand.fingers[i], frame.postures[i]));
  }
  return state;
}

/// The states of some keyframes of a stretch.
plan::HandPath PathOf(const PlanSegment& stretch, int first, int last,
                      const kinematics::HandModel& hand) {
  plan::HandPath path;
  for (int i = first; i <= last; ++i) path.push_back(StateOf(stretch.path[i], hand));
  return path;
}

plan::HandPath PathOf(const PlanSegment& stretch, const kinematics::HandModel& hand) {
  return PathOf(stretch, 0, static_cast<int>(stretch.path.size()) - 1, hand);
}

plan::FingerGrasp GraspAtEnd(const plan::Plan& plan) {
  plan::FingerGrasp holding = plan.initial;
  for (const plan::Step& step : plan.steps) holding = plan::GraspAfter(holding, step);
  return holding;
}

/// Some fingers slide, the others stay where they are.
plan::Align SlideOf(const PlanSegment& stretch, const plan::FingerGrasp& holding,
                    const kinematics::HandModel& hand) {
  plan::Align align;
  align.motion.emplace();
  for (std::size_t i = 0; i < stretch.along.size(); ++i) {
    align.waypoints.push_back(holding);
    for (plan::FingerContact& held : align.waypoints.back()) {
      const auto slid = std::ranges::find(stretch.slid, held.finger, &PlanSegment::Slid::finger);
      if (slid != stretch.slid.end()) {
        held.contact = stretch.along[i][slid - stretch.slid.begin()];
      }
    }
    if (i == 0) continue;
    align.motion->push_back(PathOf(stretch, stretch.along_at[i - 1], stretch.along_at[i], hand));
  }
  return align;
}

/// Whether a stretch is one step with the one before: a placed finger, and then another released.
bool BelongTogether(const std::vector<PlanSegment>& segments, std::size_t i) {
  using enum PlanSegment::Kind;
  return i > 0 && segments[i].kind == kRelease && segments[i - 1].kind == kPlace &&
         segments[i].finger != segments[i - 1].finger;
}

}  // namespace

plan::Plan PlanOf(const Gait& gait, const GaitRequest& request,
                  const std::vector<grasp::Contact>& contacts) {
  const kinematics::HandModel& hand = *request.hand;
  plan::Plan plan;
  plan.scale = request.scale;
  plan.dimension = 3;
  plan.half_angle = request.criteria.half_angle;
  plan.fingers = static_cast<int>(hand.fingers.size());
  plan.planner = "gait";
  plan.hand =
      plan::HandUse{hand.name, hand.file, hand.sha256, StateOf(gait.start, hand),
                    (gait.segments.empty() ? gait.start : gait.segments.back().path.back()).pose};
  for (FingerIndex finger{0}; finger < plan.fingers; ++finger) {
    if (gait.initial[finger] == kNone) continue;
    plan.initial.push_back({finger, contacts[gait.initial[finger]]});
  }
  for (std::size_t i = 0; i < gait.segments.size(); ++i) {
    const PlanSegment& stretch = gait.segments[i];
    switch (stretch.kind) {
      case PlanSegment::Kind::kMove:
        plan.steps.emplace_back(plan::Move{PathOf(stretch, hand)});
        break;
      case PlanSegment::Kind::kPlace: {
        const plan::FingerContact placed{stretch.finger, contacts[stretch.contact]};
        plan.steps.emplace_back(
            plan::Switch{{placed}, {}, plan::SwitchMotion{PathOf(stretch, hand), {}}});
        break;
      }
      case PlanSegment::Kind::kSlide:
        plan.steps.emplace_back(SlideOf(stretch, GraspAtEnd(plan), hand));
        break;
      case PlanSegment::Kind::kRelease: {
        if (!BelongTogether(gait.segments, i)) {
          plan.steps.emplace_back(plan::Switch{{}, {}, plan::SwitchMotion{{}, {}}});
        }
        auto& last = std::get<plan::Switch>(plan.steps.back());
        last.release.push_back(stretch.finger);
        last.motion->release = PathOf(stretch, hand);
        break;
      }
    }
  }
  plan.goal = plan::ContactsOf(GraspAtEnd(plan));
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
