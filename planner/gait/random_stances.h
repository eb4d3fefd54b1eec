#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/collision/surface_tree.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/request.h"
#include "planner/kinematics/inverse_kinematics.h"
#include "planner/plan/plan.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::gait {

/// A hand that holds an object.
struct RandomStance {
  plan::HandState state;    ///< with a posture for each finger, those too that hold nothing
  plan::FingerGrasp grasp;  ///< by finger, in the object's units
};

struct RandomStanceOptions {
  /// Fingers that hold: their number is drawn evenly, and rests of many are found less often.
  int fewest = 3;
  int most = 3;
  /// Contacts are drawn among these; none: anywhere on the surface.
  std::vector<grasp::Contact> among = {};
};

/// Random rests of a hand: no search has a say in them. Where the object is in the hand is drawn,
/// each finger's contact among those that it reaches there, and how fingers wait that hold nothing.
/// Not for several threads.
class RandomStances {
 public:
  /// @param request  of the hand and the object; its criteria are what grasps meet, and where it
  ///                 has a start pose the object is nowhere else. Outlives this object.
  RandomStances(const GaitRequest& request, RandomStanceOptions options);
  RandomStances(const RandomStances&) = delete;  // its parts refer to each other
  RandomStances& operator=(const RandomStances&) = delete;

  /// Fingers at contacts, whatever those are worth as a grasp; those that do not hold have no
  /// posture. @returns nullopt where fewer fingers reach the object, or something is in the way.
  [[nodiscard]] std::optional<RandomStance> TryDraw(RandomStream& random) const;

  /// One that meets the criteria, and beside which the other fingers have room.
  /// @returns nullopt where none is found in `tries`.
  [[nodiscard]] std::optional<RandomStance> Draw(RandomStream& random, int tries) const;

 private:
  struct Held {
    RandomStance rest;
    std::vector<PlacedFinger> placed;  ///< those that have a posture
  };
  [[nodiscard]] std::optional<Held> DrawHeld(RandomStream& random) const;
  [[nodiscard]] Eigen::Isometry3d DrawPose(RandomStream& random) const;
  /// For all fingers together.
  [[nodiscard]] std::vector<grasp::Contact> DrawContacts(RandomStream& random) const;
  /// @returns false where the finger does not reach the contact, or is in something's way there.
  [[nodiscard]] bool PlaceAt(FingerIndex finger, const grasp::Contact& contact, Held& held) const;
  [[nodiscard]] bool IsClear(const PlacedFinger& placed, const Held& held, TipContact tip) const;
  [[nodiscard]] bool PlaceIdleFingers(Held& held, RandomStream& random) const;

  const GaitRequest& request_;
  RandomStanceOptions options_;
  sampling::SurfaceSampler sampler_;
  collision::SurfaceTree surface_;
  HandScene scene_;
  std::vector<kinematics::InverseKinematics> inverse_;  ///< by finger
  criteria::GraspEvaluator evaluator_;
  Eigen::Vector3d centre_;        ///< of the object, in its frame, metres
  Eigen::AlignedBox3d tips_box_;  ///< around all places of tips
};

}  // namespace regrasp::gait
