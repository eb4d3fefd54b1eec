#pragma once

#include <map>
#include <vector>

#include "planner/gait/contact_kinds.h"
#include "planner/gait/holding.h"

namespace regrasp::gait {

/// How much a search has looked at of what is like a rest, and how far that puts it back: so that
/// a dead end does not hold the search up.
class Crowding {
 public:
  /// @param kinds  outlives this object. @param steps  that the object's track has.
  Crowding(const ContactKinds& kinds, int steps) : kinds_(kinds), at_(steps + 1, 0) {}

  /// A rest was looked at. @param step  of the track, where it ends; in [0, steps].
  void Count(const Holding& holding, int step);
  /// A rest's score less what it is put back, in steps: for each one that ends where it ends, that
  /// is of its kind, and that the same fingers hold.
  [[nodiscard]] double PutBack(double score, const Holding& holding, int step) const;

 private:
  const ContactKinds& kinds_;
  std::vector<int> at_;                    ///< rests, by the step that they end at
  std::map<Holding, int> like_;            ///< by the kind of their grasp
  std::map<std::vector<bool>, int> with_;  ///< by which fingers hold
};

}  // namespace regrasp::gait
