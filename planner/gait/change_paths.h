#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"
#include "planner/gait/rolling.h"
#include "planner/tree/surface_route.h"

namespace regrasp::gait {

/// Ways that a contact can take along the surface to another one, worked out when first asked for.
class SlideRoutes {
 public:
  /// @param memory  knows the contacts by their numbers; outlives this object.
  explicit SlideRoutes(const criteria::GraspMemory& memory) : memory_(memory) {}

  /// Null where there is none (tree::FindSurfaceRoute). Stays where it is.
  [[nodiscard]] const tree::SurfaceRoute* Between(int from, int to);

 private:
  const criteria::GraspMemory& memory_;
  std::map<std::pair<int, int>, std::optional<tree::SurfaceRoute>> known_;
};

/// A finger that is to slide, the way that its contact takes, and its posture there in the end.
struct Sliding {
  FingerIndex finger;
  const tree::SurfaceRoute* route = nullptr;
  const Posture* end = nullptr;
};

/// How fingers that hold slide along the surface, all at once: between two waypoints each goes
/// straight on a face, or about one point from a face to the next, or stays.
struct Slide {
  /// By waypoint where each of the fingers is, the object's units.
  std::vector<std::vector<grasp::Contact>> along;
  /// Between two waypoints, at equal shares of the way.
  std::vector<std::vector<Keyframe>> paths;
};

/// Waypoints of contacts that go along routes at once, each at its own even speed, all for the same
/// time: where one of them reaches another face, and one more for each turn about an edge, for
/// which the others wait.
///
/// Law: begins and ends with the first and last contacts of the routes, bit for bit.
[[nodiscard]] std::vector<std::vector<grasp::Contact>> GoTogether(
    const std::vector<const tree::SurfaceRoute*>& routes);

/// A slide that tips follow within kTipOff, certified to be free and force closure all along, by
/// routes as aligns take them (tree/surface_route.h).
/// @param fingers  that slide.
/// @param holding  at first.
/// @param from     how all stands at first.
/// @returns nullopt where none was found.
[[nodiscard]] std::optional<Slide> FindSlide(const HandSetup& setup,
                                             const criteria::GraspMemory& memory,
                                             const std::vector<Sliding>& fingers,
                                             const ContactAssignment& holding,
                                             const Keyframe& from);

/// What fingers do between two rests: either some that hold slide, all at once, or one is placed,
/// one released, or both.
struct Change {
  FingerIndex placed = {};    ///< not valid: none
  FingerIndex released = {};  ///< not valid: none
  std::vector<FingerIndex> slid = {};
};
[[nodiscard]] Change ChangeBetween(const ContactAssignment& from, const ContactAssignment& to);

/// Finds how fingers go from one hold to the next while the object stands still.
class ChangePaths {
 public:
  /// Where tips have rolled to before and after a change; empty without reserve.
  struct Rolled {
    const RolledTips& before;
    const RolledTips& after;
  };

  /// All outlive this object.
  ChangePaths(const HandSetup& setup, criteria::GraspMemory& memory, ObjectMotionChecker& checker,
              SlideRoutes& routes, RandomStream& random)
      : setup_(setup), memory_(memory), checker_(checker), routes_(routes), random_(random) {}

  /// @param to  after the change; where a finger that is released can't go to where it is to wait,
  ///            it waits above its contact from now on.
  /// @param node  of the grid, where both holds can be.
  /// @returns the stretches, certified; nullopt where a finger finds no way.
  [[nodiscard]] std::optional<std::vector<PlanSegment>> Find(const Stance& from, Stance& to,
                                                             int node, const Rolled& rolled);

 private:
  [[nodiscard]] std::optional<PlanSegment> Slide(const std::vector<FingerIndex>& slid,
                                                 const ContactAssignment& from,
                                                 const ContactAssignment& to, int node,
                                                 const Keyframe& before);
  [[nodiscard]] std::optional<PlanSegment> Place(FingerIndex finger, int point, int node,
                                                 const Keyframe& before, const RolledTips& rolled);
  [[nodiscard]] std::optional<PlanSegment> Release(FingerIndex finger, int point, Stance& to,
                                                   int node, const Keyframe& before,
                                                   const RolledTips& rolled);

  const HandSetup& setup_;
  criteria::GraspMemory& memory_;
  ObjectMotionChecker& checker_;
  SlideRoutes& routes_;
  RandomStream& random_;
};

}  // namespace regrasp::gait
