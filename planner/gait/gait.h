#pragma once

#include <vector>

#include "planner/gait/holding.h"
#include "planner/gait/keyframe.h"
#include "planner/grasp/contact.h"

namespace regrasp::gait {

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
                             const std::vector<int>& contacts, const Holding& holding);

/// A stretch of a gait: keyframes, the first of which is the last one of the stretch before.
struct Stretch {
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
  Holding initial;
  Keyframe start;
  std::vector<Stretch> stretches;
};

/// A stretch the other way round.
[[nodiscard]] Stretch Reversed(Stretch stretch);

[[nodiscard]] const Keyframe& EndOf(const Gait& gait);
[[nodiscard]] Holding HoldingAtEnd(const Gait& gait);

/// Appends stretches the other way round, the last one first.
void AppendReversed(const std::vector<Stretch>& stretches, Gait& gait);

}  // namespace regrasp::gait
