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

/// What fingers do between two rests; those that are not valid: none. Either one slides, or one is
/// placed, one released, or both.
struct Change {
  FingerIndex placed = {};
  FingerIndex slid = {};
  FingerIndex released = {};
  int point = kNone;  ///< that the finger comes to which is placed or slides
};

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
  [[nodiscard]] std::optional<std::vector<Stretch>> Find(const Change& change, const Hold& from,
                                                         Hold& to, int node, const Rolled& rolled);

 private:
  [[nodiscard]] std::optional<Stretch> Slide(const Change& change, const Holding& from, int node,
                                             const Keyframe& before);
  [[nodiscard]] std::optional<Stretch> Place(const Change& change, int node, const Keyframe& before,
                                             const RolledTips& rolled);
  [[nodiscard]] std::optional<Stretch> Release(const Change& change, int point, Hold& to, int node,
                                               const Keyframe& before, const RolledTips& rolled);

  const HandSetup& setup_;
  criteria::GraspMemory& memory_;
  Carrier& carrier_;
  SlideRoutes& routes_;
  RandomStream& random_;
};

}  // namespace regrasp::gait
