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
};

/// A stretch of a gait: keyframes, the first of which is the last one of the stretch before.
struct Stretch {
  enum class Kind {
    kMove,     ///< the object moves, held by all fingers that hold
    kPlace,    ///< a free finger comes to its contact
    kRelease,  ///< a finger leaves its contact
    kSlide,    ///< a finger that holds slides to another contact
  };
  Kind kind = Kind::kMove;
  FingerIndex finger;   ///< that is placed, released or slides
  int contact = kNone;  ///< that it comes to or leaves
  std::vector<Keyframe> path;
  // Of kSlide:
  int from = kNone;                        ///< the contact that it leaves
  std::vector<grasp::Contact> along = {};  ///< those that it passes, and the two, in a file's units
  std::vector<int> along_at = {};          ///< of each the number of its keyframe
};

/// A way of fingers and object from a rest to another one.
struct Gait {
  Holding initial;
  Keyframe start;
  std::vector<Stretch> stretches;
};

}  // namespace regrasp::gait
