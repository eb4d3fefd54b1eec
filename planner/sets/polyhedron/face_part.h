#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/object/polyhedron.h"

namespace regrasp::polyhedron {

/// A convex part of a face, in coordinates of the face's plane: x = origin + y_0 u + y_1 v.
struct FacePart {
  int face = 0;
  Eigen::Vector3d origin;
  Eigen::Vector3d normal;  ///< unit, into the object
  Eigen::Vector3d u;       ///< unit, with v and −normal a right-handed frame
  Eigen::Vector3d v;
  std::vector<Eigen::Vector2d> outline;  ///< counter-clockwise; two points for a segment
  std::vector<int> corners;              ///< the solid's vertices of the outline
};

/// Where two parts of one face meet: a segment that borders both.
struct PartJoint {
  std::array<int, 2> parts;
  FacePart segment;  ///< of two points
};

/// The faces of a solid as convex parts.
struct FaceParts {
  std::vector<FacePart> parts;    ///< by faces
  std::vector<int> first;         ///< parts of face f: first[f] to first[f + 1] − 1
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
