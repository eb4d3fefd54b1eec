#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"
#include "planner/gait/rolling.h"
#include "planner/tree/surface_route.h"

namespace regrasp::gait {

/// Cache of the shortest surface routes between contacts, computed on demand.
class SlideRoutes {
 public:
  /// @param memory  contacts by number; outlives this object.
  explicit SlideRoutes(const criteria::GraspMemory& memory) : memory_(memory) {}

  /// Return the route from one contact to another.
  /// @param from, to  contact numbers.
  /// @returns pointer to the cached route, valid for the lifetime of this object; null if
  ///     tree::FindSurfaceRoute finds none.
  [[nodiscard]] const tree::SurfaceRoute* Between(int from, int to);

 private:
  const criteria::GraspMemory& memory_;
  std::map<std::pair<int, int>, std::optional<tree::SurfaceRoute>> cache_;
};

/// One finger of a sliding step: the route of its contact and its joint configuration at the end.
struct Sliding {
  FingerIndex finger;
  const tree::SurfaceRoute* route = nullptr;
  const JointConfiguration* end = nullptr;
};

/// Sliding step: holding fingers slide along the surface simultaneously.
/// Between two waypoints each contact moves straight on a planar face, rotates about an edge from
/// one face to the next, or stays.
struct Slide {
  /// Contacts [waypoint][sliding finger], in object units.
  std::vector<std::vector<grasp::Contact>> waypoints;
  /// Keyframes [interval between waypoints], equally spaced along the interval.
  std::vector<std::vector<Keyframe>> paths;
};

/// Compute the common waypoints of contacts that move along routes simultaneously.
/// Each contact moves at its own constant speed and all arrive at the same time. A waypoint is
/// inserted when a contact reaches another face, and one more for each rotation about an edge,
/// during which the other contacts stay.
/// Law: the first and the last waypoint equal the ends of the routes bit for bit.
[[nodiscard]] std::vector<std::vector<grasp::Contact>> SynchronizeRoutes(
    const std::vector<const tree::SurfaceRoute*>& routes);

/// Plan a certified sliding step along given surface routes (tree/surface_route.h).
/// The fingertips follow their routes within kTipOff. The path is collision-free, and the grasp is
/// force closure throughout.
/// @param fingers  sliding fingers with their routes.
/// @param assignment  contacts before the step.
/// @param from  keyframe before the step.
/// @returns the step; nullopt if none is found.
[[nodiscard]] std::optional<Slide> FindSlide(const HandSetup& setup,
                                             const criteria::GraspMemory& memory,
                                             const std::vector<Sliding>& fingers,
                                             const ContactAssignment& assignment,
                                             const Keyframe& from);

/// Difference between two consecutive contact assignments.
/// Either holding fingers slide simultaneously, or one finger is placed, one is released, or both.
struct Change {
  FingerIndex placed = {};    ///< finger that is placed; invalid if none
  FingerIndex released = {};  ///< finger that is released; invalid if none
  std::vector<FingerIndex> slid = {};
};
[[nodiscard]] Change ChangeBetween(const ContactAssignment& from, const ContactAssignment& to);

/// Planner of finger paths between two stances while the object does not move.
class ChangePaths {
 public:
  /// Fingertips after rolling, before and after the change; empty if rolling is not modelled.
  struct Rolled {
    const RolledTips& before;
    const RolledTips& after;
  };

  /// All arguments outlive this object.
  ChangePaths(const HandSetup& setup, criteria::GraspMemory& memory, ObjectMotionChecker& checker,
              SlideRoutes& routes, RandomStream& random)
      : setup_(setup), memory_(memory), checker_(checker), routes_(routes), random_(random) {}

  /// Plan the paths of all fingers that change.
  /// @param from  stance before the change.
  /// @param to  stance after the change. If the released finger finds no path to its idle
  ///     configuration, its idle configuration becomes the one above its contact.
  /// @param node  grid node that both stances can reach.
  /// @param rolled  fingertips before and after the change.
  /// @returns the certified segments; nullopt if a finger finds no path.
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
