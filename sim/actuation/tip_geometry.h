#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/collision/convex_shape.h"
#include "planner/collision/shape_contact.h"
#include "planner/kinematics/hand_file.h"
#include "sim/scene/settings.h"

struct mjModel_;

namespace regrasp::sim {

// Stiffness of contacts between fingertips and object in MuJoCo, in the replay by a hand and in its
// exported scene.

/// Time constant of a contact, seconds (solref): five steps of the replay, with critical damping.
inline constexpr double kTipContactTime = 5e-3;
/// Impedances, width of the transition between them in metres, and its shape (solimp).
inline constexpr std::array<double, 5> kTipImpedance = {0.95, 0.99, 0.0001, 0.5, 2};
/// Contact parameters of TipContactModel::kDefault: the defaults of MuJoCo.
inline constexpr double kDefaultTipContactTime = 2e-2;
inline constexpr std::array<double, 5> kDefaultTipImpedance = {0.9, 0.95, 0.001, 0.5, 2};

/// Return the engine's contact of a fingertip and the object, without geoms.
/// With torsional friction the contact resists a torque about its normal of at most
/// μ · torsion_m · normal force, together with tangential forces (grasp::Contact::torsion).
/// @param touching  contact in the object's frame.
/// @param pose      pose of the object in the engine's world.
[[nodiscard]] mjContact MakeTipContact(const collision::SurfaceContact& touching,
                                       const Eigen::Isometry3d& pose, double mu,
                                       const HandPhysics& physics = {});

/// The combined contacts of a fingertip, in the engine's world.
struct ContactSum {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< force on the object
  double pressing = 0;                               ///< sum of the normal forces
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< point of the surface, times `pressing`
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< outward normal, times `pressing`
};
[[nodiscard]] ContactSum SumTipContacts(const mjModel& model, const mjData& data, int object_geom,
                                        int tip_geom);

/// Shapes of a fingertip that touch the object, in the frame of the fingertip's link, metres.
using TipShapes = std::vector<collision::ConvexShape>;

/// Return the shapes of each fingertip: the sphere of the hand's file, or the colliding geoms.
/// With TipShape::kGeometry they are the colliding geoms of the fingertip's link, as for other
/// links (kinematics::ReadHandFile). A shape without a radius gets the radius kTipSkin, within
/// which its contacts are found.
/// @throws InputError  if a fingertip's link has no colliding geom; the message names the model's
///     file, the link and the finger.
[[nodiscard]] std::vector<TipShapes> TipShapesOf(const kinematics::HandFile& file, TipShape tip);

/// Return the collision geometry of a body as convex shapes in the body's frame, metres.
/// They are the shapes of its geoms (kinematics::ShapeOfGeom). A mesh becomes a hull of at most 500
/// points.
[[nodiscard]] std::vector<collision::ConvexShape> CollisionShapesOf(const mjModel_& model,
                                                                    const std::string& body);

/// Radius of shapes without one, metres: three times the depth of fingertips in a static grasp.
inline constexpr double kTipSkin = 2e-4;

/// Contacts of a hand's fingertips with an object's surface, in the object's frame, metres.
class TipSurface {
 public:
  /// @throws InputError  as TipShapesOf.
  TipSurface(const kinematics::HandFile& file, TipShape tip, const object::Polyhedron& solid,
             double scale);

  /// Return the expected maximum number of simultaneous contacts of all fingertips.
  [[nodiscard]] int most_contacts() const;

  /// Clear the cached triangles. Later results then do not depend on earlier ones, to the bit.
  void Forget();

  /// Return the present contacts of a fingertip, shape by shape. The search extends to kNear.
  /// @param link       pose of the fingertip's link in the world.
  /// @param to_object  transform from the world to the object's frame.
  std::vector<collision::SurfaceContact> FindContacts(FingerIndex finger,
                                                      const Eigen::Isometry3d& link,
                                                      const Eigen::Isometry3d& to_object);
  /// Return the deepest contact of the last search, or the nearest surface point without contact.
  /// That point belongs to the fingertip, or at least to its sphere. The result is nullopt beyond
  /// kNear.
  [[nodiscard]] const std::optional<collision::SurfaceContact>& nearest(FingerIndex finger) const {
    return tips_[finger].nearest;
  }

  /// Return the centre of the fingertip sphere, in the frame of its link.
  [[nodiscard]] const Eigen::Vector3d& ball(FingerIndex finger) const {
    return tips_[finger].centre;
  }
  /// Return the surface point near the fingertip sphere; nullopt beyond kNear.
  /// The sphere counts even if other geometry makes contact.
  [[nodiscard]] std::optional<collision::NearPoint> NearBall(FingerIndex finger,
                                                             const Eigen::Vector3d& centre) const;

  inline static constexpr double kNear = 5e-3;

 private:
  using Shapes = std::vector<collision::TreeShape>;
  struct Tip {
    Shapes shapes;
    Eigen::Vector3d centre;  ///< centre of the sphere
    double radius;
    double reach = 0;  ///< largest distance of the shapes from the sphere's centre
    std::optional<collision::SurfaceContact> nearest = std::nullopt;
    /// Triangles that it may touch until the sphere is kNeighbourhood from `around`.
    Eigen::Vector3d around = Eigen::Vector3d::Zero();
    std::optional<std::vector<int>> triangles = std::nullopt;
  };
  [[nodiscard]] std::optional<collision::SurfaceContact> NearestTo(const Shapes& placed,
                                                                   const Tip& tip) const;

  collision::BallContact surface_;
  Eigen::Vector3d centroid_;
  double object_reach_ = 0;  ///< largest distance of the object's points from its centroid
  std::vector<Tip> tips_;
};

}  // namespace regrasp::sim
