#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/collision/ball_contact.h"
#include "planner/collision/convex_shape.h"
#include "planner/collision/shape_contact.h"
#include "planner/kinematics/hand_file.h"
#include "sim/scene/settings.h"

struct mjModel_;

namespace regrasp::sim {

// How hard tips and object touch in MuJoCo, in the replay by a hand and in its exported scene.

/// In which a contact comes back, seconds (solref): five steps of the replay; damped critically.
inline constexpr double kTipContactTime = 5e-3;
/// Impedances, the depth over which the one becomes the other, metres, and the shape (solimp).
inline constexpr std::array<double, 5> kTipImpedance = {0.95, 0.99, 0.0001, 0.5, 2};

/// Return the engine's contact of a tip and the object, without geoms.
/// @param touching  In the object's frame. @param pose  Of the object in the engine's world.
[[nodiscard]] mjContact MakeTipContact(const collision::SurfaceContact& touching,
                                       const Eigen::Isometry3d& pose, double mu);

/// The contacts of a tip as one, in the engine's world.
struct ContactSum {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< on the object
  double pressing = 0;                               ///< sum of the normal forces
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< of the surface, times `pressing`
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outward, times `pressing`
};
[[nodiscard]] ContactSum SumTipContacts(const mjModel& model, const mjData& data, int object_geom,
                                        int tip_geom);

/// What of a fingertip touches the object, in the frame of the tip's link, metres.
using TipShapes = std::vector<collision::ConvexShape>;

/// By finger: the ball of the hand's file; or with TipShape::kGeometry each geom of the tip's link
/// that collides, as links have them elsewhere (kinematics::ReadHandFile). A shape without a radius
/// gets one of kTipSkin, in which its contacts are found.
/// @throws InputError  a tip's link has no such geom: names the model's file, the link and finger.
[[nodiscard]] std::vector<TipShapes> TipShapesOf(const kinematics::HandFile& file, TipShape tip);

/// Return the collision geometry of a body as convex shapes in the body's frame, metres: the shapes
/// of its geoms (kinematics::ShapeOfGeom), of meshes a hull of at most 500 points.
[[nodiscard]] std::vector<collision::ConvexShape> CollisionShapesOf(const mjModel_& model,
                                                                    const std::string& body);

inline constexpr double kTipSkin = 2e-4;  ///< metres: thrice as deep as tips press at rest

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
