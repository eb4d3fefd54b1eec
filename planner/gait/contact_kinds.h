#pragma once

#include <vector>

#include "planner/gait/gait.h"
#include "planner/gait/reach_map.h"

namespace regrasp::gait {

/// Groups of contacts near each other, so that grasps can be told from those much like them.
class ContactKinds {
 public:
  explicit ContactKinds(const std::vector<SurfacePoint>& points);

  /// By finger: the group of its contact, kNone where it is free.
  [[nodiscard]] Holding KindOf(Holding holding) const;

 private:
  std::vector<int> groups_;  ///< by contact
};

}  // namespace regrasp::gait
