#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"

namespace regrasp::polyhedron {

/// Index of a FacePart in FaceParts::parts.
using PartIndex = Index<struct PartTag>;

/// Convex part of a face, in coordinates of the face's plane: x = origin + y_0 u + y_1 v.
struct FacePart {
  struct Side {
    Eigen::Vector2d from;
    Eigen::Vector2d along;    ///< unit vector along the side
    Eigen::Vector2d outward;  ///< unit vector out of the part
    double length;
  };

  FaceIndex face;
  Eigen::Vector3d origin;
  Eigen::Vector3d normal;  ///< unit normal into the object
  Eigen::Vector3d u;       ///< unit vector; u, v and −normal are a right-handed frame
  Eigen::Vector3d v;
  /// Counter-clockwise; two for a segment, none for a point at the origin.
  std::vector<Side> sides;
  std::vector<int> corners;  ///< vertices of the solid on the outline

  /// Add the sides of an outline to a part without sides.
  void SetOutline(const std::vector<Eigen::Vector2d>& outline);
  [[nodiscard]] std::vector<Eigen::Vector2d> outline() const;

  /// Projection of x onto the plane, in the plane's coordinates, and the inverse mapping to space.
  [[nodiscard]] Eigen::Vector2d FootOf(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d from_origin = x - origin;
    return {u.dot(from_origin), v.dot(from_origin)};
  }
  [[nodiscard]] Eigen::Vector3d PointAt(const Eigen::Vector2d& y) const {
    return origin + y.x() * u + y.y() * v;
  }
  [[nodiscard]] double HeightOf(const Eigen::Vector3d& x) const { return normal.dot(x - origin); }
};

/// Make a part of a single contact on a part's plane.
[[nodiscard]] FacePart PointPart(const FacePart& part, const Eigen::Vector3d& contact);

/// Common border of two parts of one face: a segment.
struct PartJoint {
  std::array<PartIndex, 2> parts;
  FacePart segment;  ///< part with two corners
};

/// Faces of a solid, divided into convex parts.
struct FaceParts {
  std::vector<FacePart> parts;    ///< parts, sorted by face
  std::vector<PartIndex> first;   ///< parts of face f are first[f] to first[f + 1] − 1
  std::vector<PartJoint> joints;  ///< joints, sorted by face
  /// Convex hull of each face. Its corners are all corners of the face's parts.
  std::vector<FacePart> hulls;
};

/// Divide faces that are not convex, or have holes, into convex parts.
///
/// The method joins the face's triangles across their sides while the union stays convex (Hertel
/// and Mehlhorn 1983). The number of parts is at most four times the minimum, and 1 for a convex
/// face.
[[nodiscard]] FaceParts SplitFaces(const object::Polyhedron& solid);

/// Return the depth of a point of the plane inside a part; negative outside.
[[nodiscard]] double DepthIn(const FacePart& part, const Eigen::Vector2d& y);

/// Find a contact on a part that a focus point sees, well inside both its cone and the part.
///
/// It maximizes the smaller of the distances from both borders.
/// @param tangent  tangent of the angle of the cone about the contact's normal.
[[nodiscard]] Eigen::Vector3d ContactFor(const FacePart& part, double tangent,
                                         const Eigen::Vector3d& focus);

/// Draw a random contact that the focus point sees; if no draw is on the part, return ContactFor.
[[nodiscard]] Eigen::Vector3d DrawContact(const FacePart& part, double tangent,
                                          const Eigen::Vector3d& focus, RandomStream& random);

/// Focus point of a concurrent grasp with its contact regions, for images.
struct FocusView {
  /// Focus point deepest inside the contacts' cones.
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();
  /// Regions in which contacts can move independently on their faces while the focus point sees
  /// them (Phoka 2010, section 5.3.1). There is one closed outline per convex part of a face.
  std::vector<std::vector<Eigen::Vector3d>> regions;
};

/// Find the focus point of four contacts whose faces are set, with cones of angle φ = min(θ, φ*).
/// @param friction_angle  friction angle θ, rad.
/// @returns nullopt if the grasp is not concurrent or does not have four contacts.
[[nodiscard]] std::optional<FocusView> DescribeFocus(const object::Polyhedron& solid,
                                                     const grasp::Grasp& grasp,
                                                     double friction_angle);

}  // namespace regrasp::polyhedron
