#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/kinematics/hand_model.h"

namespace regrasp::gait {

/// By finger: the contact that it holds, by number; kNone where it is free.
using ContactAssignment = std::vector<int>;
inline constexpr int kNone = -1;

/// How many fingers hold.
[[nodiscard]] inline int CountHoldingFingers(const ContactAssignment& holding) {
  return static_cast<int>(std::ranges::count_if(holding, [](int point) { return point != kNone; }));
}

[[nodiscard]] inline bool Holds(const ContactAssignment& holding, int point) {
  return std::ranges::find(holding, point) != holding.end();
}

/// Calls `take` with each way to have fingers hold the points, one finger each.
/// @pre no more points than fingers.
template <class Take>
void ForEachAssignment(const std::vector<int>& points, int fingers, const Take& take) {
  std::vector<int> order(fingers, kNone);
  std::ranges::copy(points, order.begin());
  std::ranges::sort(order);
  do {
    take(ContactAssignment(order));
  } while (std::ranges::next_permutation(order).found);
}

/// How object and hand stand at an instant. Between two that follow each other the drives go
/// straight, the object's origin goes straight and its orientation turns about one axis.
struct Keyframe {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of the object in the palm's frame
  std::vector<kinematics::Posture> postures;               ///< of all fingers
};

[[nodiscard]] Eigen::Isometry3d Between(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                                        double share);
[[nodiscard]] Keyframe Between(const Keyframe& from, const Keyframe& to, double share);

/// The grasps that a gait begins and ends with, as numbers of contacts; none: any grasp.
struct GaitEnds {
  std::vector<int> start;
  std::vector<int> goal;
  /// That hold the contacts of the start, and of the goal, in their order; none: whichever can.
  std::vector<FingerIndex> start_fingers = {};
  std::vector<FingerIndex> goal_fingers = {};
};

/// Whether contacts are held by the fingers that are asked for; true where none are.
[[nodiscard]] bool AreHeldBy(const std::vector<FingerIndex>& fingers,
                             const std::vector<int>& contacts, const ContactAssignment& holding);

/// A stretch of a gait: keyframes, the first of which is the last one of the stretch before.
struct PlanSegment {
  enum class Kind {
    kMove,     ///< the object moves, held by all fingers that hold
    kPlace,    ///< a free finger comes to its contact
    kRelease,  ///< a finger leaves its contact
    kSlide,    ///< fingers that hold slide to other contacts, all at once
  };
  Kind kind = Kind::kMove;
  FingerIndex finger;   ///< that is placed or released
  int contact = kNone;  ///< that it comes to or leaves
  std::vector<Keyframe> path;
  // Of kSlide:
  /// A finger that slides, and between which contacts.
  struct Slid {
    FingerIndex finger;
    int from = kNone;
    int to = kNone;
  };
  std::vector<Slid> slid = {};
  /// Waypoints, the first and the last one too: where each of them is, in a file's units.
  std::vector<std::vector<grasp::Contact>> along = {};
  std::vector<int> along_at = {};  ///< of each the number of its keyframe
};

/// A way of fingers and object from a rest to another one.
struct Gait {
  ContactAssignment initial;
  Keyframe start;
  std::vector<PlanSegment> segments;
};

/// A stretch the other way round.
[[nodiscard]] PlanSegment Reversed(PlanSegment stretch);

[[nodiscard]] const Keyframe& EndOf(const Gait& gait);
[[nodiscard]] ContactAssignment AssignmentAtEnd(const Gait& gait);

/// Appends stretches the other way round, the last one first.
void AppendReversed(const std::vector<PlanSegment>& segments, Gait& gait);

}  // namespace regrasp::gait
