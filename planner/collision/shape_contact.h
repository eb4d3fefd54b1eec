#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "planner/collision/convex_shape.h"
#include "planner/object/polyhedron.h"

namespace regrasp::collision {

/// Point of a surface near a sphere.
struct NearPoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d outward =
      Eigen::Vector3d::UnitZ();  ///< unit vector from `point` to the sphere's centre
  double distance = 0;           ///< distance to the sphere's centre
};

/// Contacts of spheres with the exact surface of a solid, which can be non-convex.
/// MuJoCo is not used for this because it collides convex shapes only, and finds mesh contacts to a
/// tolerance.
class BallContact {
 public:
  /// @param solid  solid in object units.
  /// @param scale  metres per object unit.
  BallContact(const object::Polyhedron& solid, double scale);

  /// Return the points nearest to a sphere's centre, nearest first.
  /// At these points the distance from `centre` is a local minimum over the surface and at most
  /// `reach`.
  /// There is one such point over a face or an edge, and two in a groove. Triangles that face away
  /// are ignored: the centre must be outside, or inside by less than the sphere's radius.
  /// @param centre  centre in the solid's frame, metres.
  [[nodiscard]] std::vector<NearPoint> Find(const Eigen::Vector3d& centre, double reach) const;
  /// Return the same points from candidate triangles (result of Around). The candidates can be
  /// reused while a sphere moves little.
  [[nodiscard]] std::vector<NearPoint> Find(const Eigen::Vector3d& centre, double reach,
                                            const std::vector<int>& among) const;
  /// Return the triangles that can be within `reach` of `centre`, in ascending order.
  [[nodiscard]] std::vector<int> Around(const Eigen::Vector3d& centre, double reach) const;

  /// Return the corners of a triangle, counter-clockwise from outside, metres.
  [[nodiscard]] const std::array<Eigen::Vector3d, 3>& corners(int triangle) const {
    return triangles_[triangle].corners;
  }
  /// Return the outward unit normal of a triangle.
  [[nodiscard]] const Eigen::Vector3d& normal(int triangle) const {
    return triangles_[triangle].normal;
  }
  /// Return the point of a triangle nearest to a point.
  [[nodiscard]] Eigen::Vector3d ClosestOn(int triangle, const Eigen::Vector3d& point) const;

 private:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::Vector3d normal;
    Eigen::Vector3d middle;
    double radius;  ///< radius of a bounding sphere about the centroid
  };
  std::vector<Triangle> triangles_;
};

/// Contact of a shape with a surface, or their nearest point.
struct SurfaceContact {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< point on the surface
  Eigen::Vector3d outward = Eigen::Vector3d::UnitZ();
  double gap = 0;  ///< signed distance, metres; negative if the shape penetrates the surface
};

/// Convex shape with its points in a tree, for shapes of many points.
struct TreeShape {
  explicit TreeShape(const ConvexShape& shape) : points(shape.points), radius(shape.radius) {}

  PointTree points;
  double radius;
};

/// Find the contacts of a convex shape with the exact surface of a solid.
///
/// Each point of the shape is a sphere of the shape's radius and has the contacts of that sphere
/// (BallContact). If other points are nearest, there is one more contact: an edge of the shape at
/// an edge of the solid, or a side of the shape at a corner of the solid. A point inside the solid
/// has a contact at most kMostInside deep; this occurs if shapes overlap before they are separated.
/// If the hull intersects the surface without such a point, the contact is along the line to the
/// centre of the shape. Contacts within kApart of a deeper one are redundant and omitted. At most
/// the kMostContacts deepest contacts are returned.
///
/// Laws: a single point has the contacts of BallContact::Find. Rigid motion moves the contacts.
/// @param shape  shape with positive radius in the solid's frame, metres. Contacts of edges inside
///     the solid are found up to the depth of the radius.
/// @param among  result of BallContact::Around: triangles within kMostInside and the radius of the
///     shape.
/// @returns contacts, the deepest first.
[[nodiscard]] std::vector<SurfaceContact> FindContacts(const BallContact& surface,
                                                       const TreeShape& shape,
                                                       const std::vector<int>& among);

/// Find the nearest point of the surface to a shape.
/// If the hull of the shape's points intersects the surface, the gap is at most minus the radius,
/// and is only an estimate.
/// @returns nullopt if the hull is farther from the surface than `reach`.
[[nodiscard]] std::optional<SurfaceContact> FindNearest(const BallContact& surface,
                                                        const TreeShape& shape, double reach,
                                                        const std::vector<int>& among);

inline constexpr double kMostInside = 5e-3;  ///< metres
inline constexpr double kApart = 1e-3;       ///< metres
inline constexpr int kMostContacts = 8;

}  // namespace regrasp::collision
