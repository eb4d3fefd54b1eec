#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/pose_grid.h"

namespace regrasp::gait {

/// Certified keyframes of a short move, both ends among them: all holding fingers keep their
/// contacts, the ball's centre one radius above each, the others stay where they are.
///
/// Between keyframes drives go straight; there are so many of them that no tip is off its contact
/// by more than kTipOff half-way.
/// @param from, to  with tips at their contacts.
/// @returns nullopt where a finger can't follow, or something comes too near something.
[[nodiscard]] std::optional<std::vector<Keyframe>> FindMove(const HandSetup& setup,
                                                            const ContactAssignment& holding,
                                                            const Keyframe& from,
                                                            const Keyframe& to);

/// Metres.
inline constexpr double kTipOff = 2e-5;

/// How a hand holds an object.
struct Stance {
  ContactAssignment holding;
  std::vector<Posture> waiting = {};  ///< by finger, of those that hold nothing; empty: not yet
};

/// The nodes of a grid to which an object is carried by one hold.
struct ReachablePoses {
  std::map<int, int> from;  ///< of each node the one before; of the first itself
  int end = 0;              ///< the farthest of them

  /// From the first node. @param node  one of them.
  [[nodiscard]] std::vector<int> PathTo(int node) const;
};

/// Ways from a node of a grid to a neighbour, and back.
using GridEdges = std::set<std::pair<int, int>>;

/// Finds where holds can be carried on a grid of poses: fingers that hold follow, none runs into
/// anything, checked at the nodes.
class ObjectMotionChecker {
 public:
  /// @param parking  where free fingers may wait. All outlive this object.
  ObjectMotionChecker(const HandSetup& setup, const PoseGrid& grid,
                      const IdlePostures& idle_postures)
      : setup_(setup),
        grid_(grid),
        idle_postures_(idle_postures),
        reach_(setup.scene, setup.inverse, setup.points, grid) {}

  [[nodiscard]] ReachMap& reach() { return reach_; }

  /// @param node  where all fingers that hold reach their contacts.
  [[nodiscard]] Keyframe FrameAt(const Stance& hold, int node);
  /// Whether a finger that holds keeps off all others that hold at a node, where all reach theirs.
  [[nodiscard]] bool KeepsApart(const Stance& hold, FingerIndex finger, int node);
  /// Whether the fingers may stand as they do at a node, those left out that have no posture.
  /// @param node  as in FrameAt.
  [[nodiscard]] bool IsPassable(const Stance& hold, int node);
  /// Finds postures for fingers that hold nothing and have none.
  /// @param random  draws others where fingers can't all wait in places of `parking`; null: none.
  /// @param before  fingers that held something in it may wait above that.
  /// @returns whether the hold can be at the node.
  [[nodiscard]] bool PlaceIdleFingers(Stance& hold, int node, RandomStream* random = nullptr,
                                      const Stance* before = nullptr);
  /// Has a finger that holds nothing wait above a contact that it reaches at the node.
  /// @returns whether it can.
  [[nodiscard]] bool IdleAbove(Stance& hold, FingerIndex finger, int point, int node);

  /// Along the track, with the node's offset.
  [[nodiscard]] ReachablePoses ExtendAlongTrack(const Stance& hold, int node);
  /// Also beside the track; best first by steps, near the track before far from it.
  /// @param patience   nodes that are tried in vain, each a few microseconds to milliseconds.
  /// @param is_enough  of the farthest node: no more is looked for.
  /// @param barred     that are not gone.
  [[nodiscard]] ReachablePoses ExtendAround(const Stance& hold, int node, int patience,
                                            const std::function<bool(int)>& is_enough,
                                            const GridEdges& blocked);

 private:
  /// The first that suits of its parking and above where it was before, finger by finger.
  [[nodiscard]] bool UseIdlePostures(Stance& hold, int node, const Stance* before);
  /// In postures that are drawn, finger by finger in an order that is drawn.
  [[nodiscard]] bool DrawIdlePostures(Stance& hold, int node, RandomStream& random);
  /// Of a finger off a contact that it reaches at the node; nullopt where it does not come there.
  /// @param height  metres.
  [[nodiscard]] std::optional<Posture> PostureAbove(FingerIndex finger, int point, int node,
                                                    double height);
  [[nodiscard]] bool CanFollow(const Stance& hold, int node, int neighbour);
  [[nodiscard]] bool KeepsOffPalm(int node);
  /// Of two fingers that hold.
  [[nodiscard]] bool KeepApart(const Stance& hold, FingerIndex a, FingerIndex b, int node);

  const HandSetup& setup_;
  const PoseGrid& grid_;
  const IdlePostures& idle_postures_;
  ReachMap reach_;
  // Worked out when first asked for: grasps are many, and made of few contacts.
  std::unordered_map<int, bool> off_palm_;       ///< by node
  std::unordered_map<std::size_t, bool> apart_;  ///< by node, and two fingers with their contacts
};

}  // namespace regrasp::gait
