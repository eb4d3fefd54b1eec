#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "planner/base/index.h"
#include "planner/collision/ball_contact.h"
#include "planner/collision/shape_contact.h"
#include "planner/kinematics/hand_file.h"
#include "sim/actuation/tip_geometry.h"

namespace regrasp::sim {

/// Where the fingertips of a hand touch an object's surface. All in the object's frame, metres.
class TipSurface {
 public:
  /// @throws InputError  as TipShapesOf.
  TipSurface(const kinematics::HandFile& file, TipShape tip, const object::Polyhedron& solid,
             double scale);

  /// As many contacts as all tips may be expected to have at a time.
  [[nodiscard]] int most_contacts() const;

  /// What comes does not depend on what was, to the last bit.
  void Forget();

  /// Where the tip touches now, shape by shape. The surface is looked for up to kNear from the tip.
  /// @param link       of the tip, in the world. @param to_object  from the world.
  std::vector<collision::SurfaceContact> FindContacts(FingerIndex finger,
                                                      const Eigen::Isometry3d& link,
                                                      const Eigen::Isometry3d& to_object);
  /// The deepest of them; without one where the tip was nearest, or at least its ball; nullopt
  /// farther than kNear.
  [[nodiscard]] const std::optional<collision::SurfaceContact>& nearest(FingerIndex finger) const {
    return tips_[finger].nearest;
  }

  /// The centre of the tip's ball, in the frame of its link.
  [[nodiscard]] const Eigen::Vector3d& ball(FingerIndex finger) const {
    return tips_[finger].centre;
  }
  /// Where the ball is near the surface, whatever touches; nullopt farther than kNear.
  [[nodiscard]] std::optional<collision::NearPoint> NearBall(FingerIndex finger,
                                                             const Eigen::Vector3d& centre) const;

  inline static constexpr double kNear = 5e-3;

 private:
  struct Tip {
    TipShapes shapes;
    Eigen::Vector3d centre;  ///< of the ball
    double radius;
    double reach = 0;  ///< of the shapes, from the ball's centre
    std::optional<collision::SurfaceContact> nearest = std::nullopt;
    /// The triangles that it may touch before the ball has gone kNeighbourhood from here.
    Eigen::Vector3d around = Eigen::Vector3d::Zero();
    std::optional<std::vector<int>> triangles = std::nullopt;
  };
  [[nodiscard]] std::optional<collision::SurfaceContact> NearestTo(const TipShapes& placed,
                                                                   const Tip& tip) const;

  collision::BallContact surface_;
  Eigen::Vector3d centroid_;
  double object_reach_ = 0;  ///< from the centroid
  std::vector<Tip> tips_;
};

}  // namespace regrasp::sim
