#pragma once

#include <optional>
#include <vector>

#include "planner/collision/surface_tree.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/holding.h"
#include "planner/gait/reach_map.h"
#include "planner/kinematics/inverse_kinematics.h"

namespace regrasp::bench {

/// Rests of three fingers at one pose of the object in the hand, each contact drawn among all that
/// its finger reaches there: no search has a say in which. The pose is the one where the hand's
/// reach is best.
class RandomRests {
 public:
  /// @param request  of the hand and the object; outlives this object.
  /// @throws std::runtime_error  the object is nowhere within reach of the fingers.
  explicit RandomRests(const gait::GaitRequest& request);
  RandomRests(const RandomRests&) = delete;  // its parts refer to each other
  RandomRests& operator=(const RandomRests&) = delete;

  [[nodiscard]] const Eigen::Isometry3d& pose() const { return homes_.front(); }
  /// Places where the hand's reach is good, the best first.
  [[nodiscard]] const std::vector<Eigen::Isometry3d>& homes() const { return homes_; }

  /// The contacts of three fingers drawn, whatever they are worth. @returns nullopt where a finger
  /// or the object is in something's way.
  [[nodiscard]] std::optional<gait::Holding> TryDraw(RandomStream& random) const;

  /// The grasp of one that holds, and beside which the other fingers have room somewhere.
  /// @returns nullopt where none is found in `tries`.
  [[nodiscard]] std::optional<grasp::Grasp> Draw(RandomStream& random, int tries);

 private:
  [[nodiscard]] std::optional<gait::PlacedFinger> PlaceAt(FingerIndex finger, int contact) const;
  [[nodiscard]] bool IsClear(const gait::PlacedFinger& placed,
                             const std::vector<gait::PlacedFinger>& others,
                             gait::TipContact tip) const;
  [[nodiscard]] bool HaveRoom(const gait::Holding& holding, RandomStream& random) const;

  const gait::GaitRequest& request_;
  std::vector<grasp::Contact> contacts_;
  collision::SurfaceTree surface_;
  gait::HandScene scene_;
  std::vector<kinematics::InverseKinematics> inverse_;  ///< by finger
  std::vector<std::vector<int>> within_reach_;          ///< contacts by finger
  criteria::GraspMemory memory_;
  std::vector<Eigen::Isometry3d> homes_;
};

}  // namespace regrasp::bench
