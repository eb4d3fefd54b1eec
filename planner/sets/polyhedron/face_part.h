#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/object/polyhedron.h"

namespace regrasp::polyhedron {

/// A FacePart of a solid; its number in FaceParts::parts.
using PartIndex = Index<struct PartTag>;

/// A convex part of a face, in coordinates of the face's plane: x = origin + y_0 u + y_1 v.
struct FacePart {
  struct Side {
    Eigen::Vector2d from;
    Eigen::Vector2d along;    ///< unit
    Eigen::Vector2d outward;  ///< unit
    double length;
  };

  FaceIndex face;
  Eigen::Vector3d origin;
  Eigen::Vector3d normal;  ///< unit, into the object
  Eigen::Vector3d u;       ///< unit, with v and −normal a right-handed frame
  Eigen::Vector3d v;
  std::vector<Side> sides;   ///< counter-clockwise; two of a segment, none of a point at the origin
  std::vector<int> corners;  ///< the solid's vertices of the outline

  /// Of a part with no sides yet.
  void SetOutline(const std::vector<Eigen::Vector2d>& outline);
  [[nodiscard]] std::vector<Eigen::Vector2d> outline() const;

  /// Where x is seen from above the plane, in the plane's coordinates; and back into space.
  [[nodiscard]] Eigen::Vector2d FootOf(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d from_origin = x - origin;
    return {u.dot(from_origin), v.dot(from_origin)};
  }
  [[nodiscard]] Eigen::Vector3d PointAt(const Eigen::Vector2d& y) const {
    return origin + y.x() * u + y.y() * v;
  }
  [[nodiscard]] double HeightOf(const Eigen::Vector3d& x) const { return normal.dot(x - origin); }
};

/// A single contact on a part's plane as a part of its own.
[[nodiscard]] FacePart PointPart(const FacePart& part, const Eigen::Vector3d& contact);

/// Where two parts of one face meet: a segment that borders both.
struct PartJoint {
  std::array<PartIndex, 2> parts;
  FacePart segment;  ///< of two points
};

/// The faces of a solid as convex parts.
struct FaceParts {
  std::vector<FacePart> parts;    ///< by faces
  std::vector<PartIndex> first;   ///< parts of face f: first[f] to first[f + 1] − 1
  std::vector<PartJoint> joints;  ///< by faces
  /// Of each face the smallest convex part that contains all of its parts; its corners are all that
  /// they have.
  std::vector<FacePart> hulls;
};

/// Cuts faces that are not convex, or have holes, into convex parts: the face's triangles, joined
/// across their sides while the union stays convex (Hertel and Mehlhorn 1983): at most four times
/// as many as needed, one where the face is convex.
[[nodiscard]] FaceParts SplitFaces(const object::Polyhedron& solid);

}  // namespace regrasp::polyhedron
