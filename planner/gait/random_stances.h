#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/collision/surface_tree.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/request.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/plan/plan.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::gait {

/// A hand that holds an object.
struct RandomStance {
  plan::HandState
      state;  ///< object pose and joint configurations of all fingers, idle ones included
  plan::FingerGrasp grasp;  ///< contacts by finger, in object units
};

struct RandomStanceOptions {
  /// Range of the number of holding fingers.
  /// The number is drawn uniformly; draws with many fingers succeed less often.
  int fewest = 3;
  int most = 3;
  /// Candidate contacts. Empty: any point of the surface.
  std::vector<grasp::Contact> among = {};
};

/// Sampler of random stances, independent of any search.
/// Draws the object pose, a contact of each finger among those that it reaches, and the
/// configurations of idle fingers. Not thread-safe.
class RandomStances {
 public:
  /// @param request  hand, object and criteria of the grasps. A start pose in it fixes the object
  ///     pose. Outlives this object.
  /// @throws std::invalid_argument  if not 3 ≤ fewest ≤ most ≤ number of fingers.
  RandomStances(const GaitRequest& request, RandomStanceOptions options);
  RandomStances(const RandomStances&) = delete;  // members refer to each other
  RandomStances& operator=(const RandomStances&) = delete;

  /// Draw fingers at contacts without checking the grasp; idle fingers have no configuration.
  /// @returns the stance; nullopt if too few fingers reach the object or a collision occurs.
  [[nodiscard]] std::optional<RandomStance> TryDraw(RandomStream& random) const;

  /// Draw a stance that meets the criteria, with collision-free idle fingers.
  /// @returns the stance; nullopt if none is found in `tries` draws.
  [[nodiscard]] std::optional<RandomStance> Draw(RandomStream& random, int tries) const;

 private:
  struct Holding {
    RandomStance stance;
    std::vector<PlacedFinger> placed;  ///< fingers with a configuration
  };
  [[nodiscard]] std::optional<Holding> DrawHolding(RandomStream& random) const;
  [[nodiscard]] Eigen::Isometry3d DrawPose(RandomStream& random) const;
  /// Draw candidate contacts for all fingers.
  [[nodiscard]] std::vector<grasp::Contact> DrawContacts(RandomStream& random) const;
  /// Place a finger at a contact.
  /// @returns false if the finger does not reach it or collides there.
  [[nodiscard]] bool PlaceAt(FingerIndex finger, const grasp::Contact& contact,
                             Holding& holding) const;
  [[nodiscard]] bool IsClear(const PlacedFinger& placed, const Holding& holding,
                             TipContact tip) const;
  [[nodiscard]] bool PlaceIdleFingers(Holding& holding, RandomStream& random) const;

  const GaitRequest& request_;
  RandomStanceOptions options_;
  sampling::SurfaceSampler sampler_;
  collision::SurfaceTree surface_;
  HandScene scene_;
  std::vector<kinematics::InverseKinematics> inverse_;  ///< [finger]
  criteria::GraspEvaluator evaluator_;
  Eigen::Vector3d centre_;        ///< centroid in the object's frame, metres
  Eigen::AlignedBox3d tips_box_;  ///< bounding box of all sampled fingertip positions, metres
};

}  // namespace regrasp::gait
