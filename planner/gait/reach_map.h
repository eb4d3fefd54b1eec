#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "planner/gait/hand_scene.h"
#include "planner/gait/pose_grid.h"
#include "planner/grasp/contact.h"
#include "planner/kinematics/inverse_kinematics.h"

namespace regrasp::gait {

/// A contact of the object in its own frame, metres.
struct SurfacePoint {
  Eigen::Vector3d p;
  Eigen::Vector3d n;  ///< inward, of length 1
};

/// What a finger is asked for at a contact: the centre of its ball is one radius outside.
/// @param pose  of the object in the palm's frame.
[[nodiscard]] kinematics::TipTarget TargetAt(const kinematics::Finger& finger,
                                             const SurfacePoint& contact,
                                             const Eigen::Isometry3d& pose);

/// Which fingers can be at which contacts, and how they stand there, for the poses of a grid: the
/// finger alone, whatever the others do. Worked out when first asked for.
class ReachMap {
 public:
  /// @param scene, inverse, points, grid  outlive this object; `inverse` has one for each finger.
  ReachMap(const HandScene& scene, const std::vector<kinematics::InverseKinematics>& inverse,
           const std::vector<SurfacePoint>& points, const PoseGrid& grid)
      : scene_(scene), inverse_(inverse), points_(points), grid_(grid) {}

  /// How the finger stands at a contact at a node of the grid, keeping off the palm, itself and
  /// the object; null where it does not reach it. Stays where it is.
  [[nodiscard]] const Posture* Find(FingerIndex finger, int point, int node);

  /// Whether the finger can keep the contact from a node to a neighbour, without a jump in its
  /// posture. @param node  where it reaches the contact.
  [[nodiscard]] bool CanFollow(FingerIndex finger, int point, int node, int neighbour);

  /// The last step to which the finger can keep the contact from a node on, with the node's offset:
  /// an estimate, as not every pose on the way is looked at.
  /// @param node  where it reaches the contact.
  [[nodiscard]] int RunEnd(FingerIndex finger, int point, int node);

 private:
  struct Known {
    std::optional<Posture> posture;
    int run_end = -1;  ///< a step; -1: not asked for yet
  };
  [[nodiscard]] Known& KnownAt(FingerIndex finger, int point, int node);
  [[nodiscard]] std::optional<Posture> WorkOut(FingerIndex finger, int point, int node) const;
  [[nodiscard]] int WorkOutRunEnd(FingerIndex finger, int point, int node);

  const HandScene& scene_;
  const std::vector<kinematics::InverseKinematics>& inverse_;
  const std::vector<SurfacePoint>& points_;
  const PoseGrid& grid_;
  std::unordered_map<std::size_t, Known> known_;
};

}  // namespace regrasp::gait
