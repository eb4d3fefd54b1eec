#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/kinematics/hand_model.h"
#include "planner/plan/plan.h"

namespace regrasp::gait {

/// Contact assignment: the contact number of each finger, kNone for an idle finger.
using ContactAssignment = std::vector<int>;
inline constexpr int kNone = -1;

/// Return the number of fingers in contact.
[[nodiscard]] inline int CountHoldingFingers(const ContactAssignment& assignment) {
  return static_cast<int>(
      std::ranges::count_if(assignment, [](int point) { return point != kNone; }));
}

[[nodiscard]] inline bool IsAssigned(const ContactAssignment& assignment, int point) {
  return std::ranges::find(assignment, point) != assignment.end();
}

/// Call `take` with every assignment of the contacts to distinct fingers.
/// @pre `points` has at most `fingers` elements.
template <class Take>
void ForEachAssignment(const std::vector<int>& points, int fingers, const Take& take) {
  std::vector<int> order(fingers, kNone);
  std::ranges::copy(points, order.begin());
  std::ranges::sort(order);
  do {
    take(ContactAssignment(order));
  } while (std::ranges::next_permutation(order).found);
}

/// State of object and hand at an instant.
/// Between consecutive keyframes the joints and the object's origin move linearly, and the object
/// rotates about one fixed axis.
struct Keyframe {
  Eigen::Isometry3d pose =
      Eigen::Isometry3d::Identity();  ///< object pose in the palm's frame, metres
  std::vector<kinematics::JointConfiguration> configurations;  ///< joint configuration [finger]
};

[[nodiscard]] Keyframe Between(const Keyframe& from, const Keyframe& to, double fraction);

/// Grasps at both ends of a gait, as contact numbers; an empty grasp means any grasp.
struct GaitEnds {
  std::vector<int> start;
  std::vector<int> goal;
  /// Fingers of the start and goal contacts, in contact order. Empty: any finger.
  std::vector<FingerIndex> start_fingers = {};
  std::vector<FingerIndex> goal_fingers = {};
  /// Joint configuration [finger] at the start, with given start fingers. Empty: any.
  std::vector<kinematics::JointConfiguration> start_configurations = {};
};

/// Return whether each contact is assigned to the required finger; true if none is required.
[[nodiscard]] bool AreHeldBy(const std::vector<FingerIndex>& fingers,
                             const std::vector<int>& contacts, const ContactAssignment& assignment);

/// Segment of a gait: keyframes that begin with the last keyframe of the previous segment.
struct PlanSegment {
  enum class Kind {
    kMove,     ///< in-hand motion: the object moves with all holding fingers
    kPlace,    ///< an idle finger reaches its contact
    kRelease,  ///< a finger leaves its contact
    kSlide,    ///< holding fingers slide to other contacts simultaneously
  };
  Kind kind = Kind::kMove;
  FingerIndex finger;   ///< finger that is placed or released
  int contact = kNone;  ///< contact that is reached or left
  std::vector<Keyframe> path;
  // Members of sliding steps (kSlide):
  /// A sliding finger with the contact numbers of both ends.
  struct Slid {
    FingerIndex finger;
    int from = kNone;
    int to = kNone;
  };
  std::vector<Slid> slid = {};
  /// Contacts [waypoint][sliding finger] including both ends, in object units.
  std::vector<std::vector<grasp::Contact>> waypoints = {};
  std::vector<int> waypoint_frames = {};  ///< keyframe number [waypoint]
  /// Contacts [keyframe] of an in-hand motion in which fingertips roll (rolled_gait.h), in object
  /// units. Empty: contacts are fixed.
  std::vector<plan::FingerGrasp> rolled = {};
};

/// Gait: an alternating sequence of in-hand motions and contact changes between two stances.
struct Gait {
  ContactAssignment initial;
  Keyframe start;
  std::vector<PlanSegment> segments;
};

/// Return the time-reversed segment.
[[nodiscard]] PlanSegment Reversed(PlanSegment segment);

[[nodiscard]] const Keyframe& EndOf(const Gait& gait);
[[nodiscard]] ContactAssignment AssignmentAtEnd(const Gait& gait);

/// Append the time-reversed segments, the last one first.
void AppendReversed(const std::vector<PlanSegment>& segments, Gait& gait);

}  // namespace regrasp::gait
