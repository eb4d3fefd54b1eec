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
#include "planner/gait/supported_grasps.h"

namespace regrasp::gait {

/// Plan a certified short in-hand motion between two keyframes.
/// Holding fingers keep their contacts, with the centre of the fingertip sphere one radius above
/// each; idle fingers are stationary. Joints move linearly between keyframes, which are dense
/// enough that no fingertip leaves its contact by more than kTipOff halfway.
/// @param from, to  keyframes with the fingertips at their contacts.
/// @returns keyframes including both ends; nullopt if a finger cannot follow or a collision occurs.
[[nodiscard]] std::optional<std::vector<Keyframe>> FindMove(const HandSetup& setup,
                                                            const ContactAssignment& assignment,
                                                            const Keyframe& from,
                                                            const Keyframe& to);

/// Permitted deviation of a fingertip from its contact between keyframes, metres.
inline constexpr double kTipOff = 2e-5;

/// Stance: the contacts of the holding fingers and the joint configurations of the idle fingers.
struct Stance {
  ContactAssignment assignment;
  std::vector<JointConfiguration> idle =
      {};  ///< joint configuration [finger] of idle fingers; empty until chosen
};

/// Grid nodes that the object reaches with one stance.
struct ReachablePoses {
  std::map<int, int> predecessor;  ///< previous node of each node; the first node maps to itself
  int end = 0;                     ///< the farthest node

  /// Return the nodes from the first one to `node`.
  /// @param node  one of the reachable nodes.
  [[nodiscard]] std::vector<int> PathTo(int node) const;
};

/// Undirected edges between adjacent grid nodes.
using GridEdges = std::set<std::pair<int, int>>;

/// Motion checker of stances on a pose grid.
/// Checks at the grid nodes that holding fingers follow the object and that nothing collides.
class ObjectMotionChecker {
 public:
  /// @param idle_configurations  candidate configurations of idle fingers. All arguments outlive
  /// this
  ///     object.
  ObjectMotionChecker(const HandSetup& setup, const PoseGrid& grid,
                      const IdleConfigurations& idle_configurations)
      : setup_(setup),
        grid_(grid),
        idle_configurations_(idle_configurations),
        reach_(setup.scene, setup.inverse, setup.points, grid) {}

  [[nodiscard]] ReachMap& reach() { return reach_; }

  /// Let a finger touch a contact at a grid node with a given configuration instead of the one of
  /// its inverse kinematics.
  void SetConfiguration(FingerIndex finger, int point, int node,
                        const JointConfiguration& configuration) {
    reach_.Set(finger, point, node, configuration);
    apart_.clear();
  }

  /// Let stances pass only at grid nodes at which they hold the object. Without it, the caller
  /// tests force closure of stances, because it does not depend on the pose.
  /// @param grasps  outlives this object.
  void RequireSupport(SupportedGrasps& grasps) { supported_ = &grasps; }

  /// Return the keyframe of a stance at a grid node.
  /// @param node  grid node at which all holding fingers reach their contacts.
  [[nodiscard]] Keyframe FrameAt(const Stance& stance, int node);
  /// Return whether one holding finger is clear of the other holding fingers.
  /// @param node  grid node at which all of them reach their contacts.
  [[nodiscard]] bool KeepsApart(const Stance& stance, FingerIndex finger, int node);
  /// Return whether a stance is collision-free at a grid node.
  /// Idle fingers without a configuration are ignored.
  /// @param node  grid node at which all holding fingers reach their contacts.
  [[nodiscard]] bool IsPassable(const Stance& stance, int node);
  /// Choose configurations for idle fingers that have none.
  /// @param random  random stream for further candidates if `idle_configurations` does not suffice;
  /// null:
  ///     no further candidates.
  /// @param before  previous stance; a finger that it releases may idle above its former contact.
  ///     Null: none.
  /// @returns whether the stance is collision-free at the grid node.
  [[nodiscard]] bool PlaceIdleFingers(Stance& stance, int node, RandomStream* random = nullptr,
                                      const Stance* before = nullptr);
  /// Let an idle finger wait above a contact that it reaches at the grid node.
  /// @returns whether such a configuration is collision-free.
  [[nodiscard]] bool IdleAbove(Stance& stance, FingerIndex finger, int point, int node);

  /// Extend a stance along the track at the offset of the grid node.
  [[nodiscard]] ReachablePoses ExtendAlongTrack(const Stance& stance, int node);
  /// Extend a stance over the whole grid, best first.
  /// Order: larger steps, then smaller offsets from the track.
  /// @param patience  maximum number of expanded nodes without progress; each takes microseconds to
  ///     milliseconds.
  /// @param is_enough  predicate of the farthest node that ends the search.
  /// @param blocked  edges that must not be used.
  [[nodiscard]] ReachablePoses ExtendAround(const Stance& stance, int node, int patience,
                                            const std::function<bool(int)>& is_enough,
                                            const GridEdges& blocked);

 private:
  /// Choose the first collision-free candidate of each idle finger.
  /// The last candidate is above the finger's contact in `before`.
  [[nodiscard]] bool UseIdleConfigurations(Stance& stance, int node, const Stance* before);
  /// Draw configurations finger by finger in random order.
  [[nodiscard]] bool DrawIdleConfigurations(Stance& stance, int node, RandomStream& random);
  /// Return a configuration above a contact; nullopt if the finger does not reach it.
  /// @param height  height above the contact, metres.
  [[nodiscard]] std::optional<JointConfiguration> ConfigurationAbove(FingerIndex finger, int point,
                                                                     int node, double height);
  [[nodiscard]] bool CanFollow(const Stance& stance, int node, int neighbour);
  [[nodiscard]] bool KeepsOffPalm(int node);
  /// Return whether two holding fingers are clear of each other.
  [[nodiscard]] bool KeepApart(const Stance& stance, FingerIndex a, FingerIndex b, int node);

  const HandSetup& setup_;
  const PoseGrid& grid_;
  const IdleConfigurations& idle_configurations_;
  ReachMap reach_;
  SupportedGrasps* supported_ = nullptr;  ///< null: not tested
  // Caches, filled on demand: there are many grasps, but they consist of few contacts.
  std::unordered_map<int, bool> off_palm_;  ///< cached clearance of the palm, by grid node
  std::unordered_map<std::size_t, bool>
      apart_;  ///< cached clearance, by grid node and two (finger, contact) pairs
};

}  // namespace regrasp::gait
