#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/gait/gait.h"
#include "planner/gait/hand_setup.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/reach_map.h"

namespace regrasp::gait {

/// How a hand holds an object.
struct Hold {
  Holding holding;
  std::vector<Posture> waiting = {};  ///< by finger, of those that hold nothing; empty: not yet
};

/// The nodes of a grid to which an object is carried by one hold.
struct Carried {
  std::map<int, int> from;  ///< of each node the one before; of the first itself
  int end = 0;              ///< the farthest of them

  /// From the first node. @param node  one of them.
  [[nodiscard]] std::vector<int> PathTo(int node) const;
};

/// Ways from a node of a grid to a neighbour, and back.
using Legs = std::set<std::pair<int, int>>;

/// Finds where holds can be carried on a grid of poses: fingers that hold follow, none runs into
/// anything, checked at the nodes.
class Carrier {
 public:
  /// @param parking  where free fingers may wait. All outlive this object.
  Carrier(const HandSetup& setup, const PoseGrid& grid, const Parking& parking)
      : setup_(setup),
        grid_(grid),
        parking_(parking),
        reach_(setup.scene, setup.inverse, setup.points, grid) {}

  [[nodiscard]] ReachMap& reach() { return reach_; }

  /// @param node  where all fingers that hold reach their contacts.
  [[nodiscard]] Keyframe FrameAt(const Hold& hold, int node);
  /// Whether the fingers may stand as they do at a node, those left out that have no posture.
  /// @param node  as in FrameAt.
  [[nodiscard]] bool IsPassable(const Hold& hold, int node);
  /// Finds postures for fingers that hold nothing and have none.
  /// @param random  draws others where a finger can't wait in any place of `parking`; null: none.
  /// @param before  fingers that held something in it may wait above that.
  /// @returns whether the hold can be at the node.
  [[nodiscard]] bool LetFreeFingersWait(Hold& hold, int node, RandomStream* random = nullptr,
                                        const Hold* before = nullptr);

  /// Along the track, with the node's offset.
  [[nodiscard]] Carried StraightOn(const Hold& hold, int node);
  /// Also beside the track; best first by steps, near the track before far from it.
  /// @param patience   nodes that are tried in vain, each a few microseconds to milliseconds.
  /// @param is_enough  of the farthest node: no more is looked for.
  /// @param barred     that are not gone.
  [[nodiscard]] Carried Around(const Hold& hold, int node, int patience,
                               const std::function<bool(int)>& is_enough, const Legs& barred);

 private:
  /// Of a finger off a contact that it reaches at the node; nullopt where it does not come there.
  /// @param height  metres.
  [[nodiscard]] std::optional<Posture> PostureAbove(FingerIndex finger, int point, int node,
                                                    double height);
  [[nodiscard]] bool CanFollow(const Hold& hold, int node, int neighbour);

  const HandSetup& setup_;
  const PoseGrid& grid_;
  const Parking& parking_;
  ReachMap reach_;
};

}  // namespace regrasp::gait
