#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/carrier.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_setup.h"
#include "planner/gait/rolling.h"
#include "planner/gait/slide_path.h"

namespace regrasp::gait {

/// What fingers do between two rests: either some that hold slide, all at once, or one is placed,
/// one released, or both.
struct Change {
  FingerIndex placed = {};    ///< not valid: none
  FingerIndex released = {};  ///< not valid: none
  std::vector<FingerIndex> slid = {};
};
[[nodiscard]] Change ChangeBetween(const Holding& from, const Holding& to);

/// Finds how fingers go from one hold to the next while the object stands still.
class ChangePaths {
 public:
  /// Where tips have rolled to before and after a change; empty without reserve.
  struct Rolled {
    const RolledTips& before;
    const RolledTips& after;
  };

  /// All outlive this object.
  ChangePaths(const HandSetup& setup, criteria::GraspMemory& memory, Carrier& carrier,
              SlideRoutes& routes, RandomStream& random)
      : setup_(setup), memory_(memory), carrier_(carrier), routes_(routes), random_(random) {}

  /// @param to  after the change; where a finger that is released can't go to where it is to wait,
  ///            it waits above its contact from now on.
  /// @param node  of the grid, where both holds can be.
  /// @returns the stretches, certified; nullopt where a finger finds no way.
  [[nodiscard]] std::optional<std::vector<Stretch>> Find(const Hold& from, Hold& to, int node,
                                                         const Rolled& rolled);

 private:
  [[nodiscard]] std::optional<Stretch> Slide(const std::vector<FingerIndex>& slid,
                                             const Holding& from, const Holding& to, int node,
                                             const Keyframe& before);
  [[nodiscard]] std::optional<Stretch> Place(FingerIndex finger, int point, int node,
                                             const Keyframe& before, const RolledTips& rolled);
  [[nodiscard]] std::optional<Stretch> Release(FingerIndex finger, int point, Hold& to, int node,
                                               const Keyframe& before, const RolledTips& rolled);

  const HandSetup& setup_;
  criteria::GraspMemory& memory_;
  Carrier& carrier_;
  SlideRoutes& routes_;
  RandomStream& random_;
};

}  // namespace regrasp::gait
