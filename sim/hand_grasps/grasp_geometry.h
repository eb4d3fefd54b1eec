#pragma once

#include <string>
#include <vector>

#include "planner/collision/shape_contact.h"
#include "planner/object/polyhedron.h"
#include "sim/actuation/penetration.h"
#include "sim/hand_grasps/grasp_world.h"

namespace regrasp::sim {

/// Distance of a link from the object, and its contacts within kContactDistance.
struct LinkTouch {
  int link = 0;      ///< body of the hand's model
  std::string name;  ///< name of the body
  /// Signed distance from the surface, metres; negative: depth. At most kFarthest.
  double distance = 0;
  std::vector<collision::SurfaceContact> contacts;  ///< in the object's frame, metres
};

/// Distances and contacts between the collision geometry of a hand and an object's exact surface.
class GraspGeometry {
 public:
  inline static constexpr double kContactDistance = 1e-3;  ///< metres
  inline static constexpr double kFarthest = 1.0;          ///< largest measured distance, metres
  inline static constexpr double kDeepest = 0.05;          ///< largest measured depth, metres

  /// @param world  world of the hand.
  /// @param scale  metres per unit of the object's file.
  GraspGeometry(const GraspWorld& world, const object::Polyhedron& solid, double scale);

  /// Measure all links with collision geometry.
  /// @param world  world of the constructor, with the hand placed.
  [[nodiscard]] std::vector<LinkTouch> Measure(const GraspWorld& world) const;

 private:
  struct Link {
    int body;
    std::vector<collision::ConvexShape> shapes;  ///< in the frame of the body
  };
  void MeasureShape(const collision::ConvexShape& shape, LinkTouch& touch) const;

  std::vector<Link> links_;
  Penetration penetration_;
  collision::BallContact surface_;
};

/// Return the smallest signed distance of all links, metres.
[[nodiscard]] double SmallestDistance(const std::vector<LinkTouch>& touches);

}  // namespace regrasp::sim
