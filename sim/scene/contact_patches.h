#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp::sim {

/// Surface of the simulated object for rendering.
struct VisibleSurface {
  std::vector<Eigen::Vector3d> vertices;      ///< vertices in the object's frame and unit
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
};

/// Return the surface of a solid, or of the prism of a polygon about the plane z = 0.
/// @param thickness  height of the prism.
[[nodiscard]] VisibleSurface MakeVisibleSurface(const object::Object& object, double thickness);

/// Place at which a finger makes contact: a face (in the plane: an edge), and the straight path of
/// the contact on it, a point if `from` equals `to`. Lengths are in the object's unit.
struct ContactSite {
  FaceIndex face = {};
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

/// Convex piece of the object's surface near a site. A finger collides with its prism.
struct ContactPatch {
  std::vector<Eigen::Vector3d> outline;  ///< counter-clockwise from outside
  /// Whether all angles are right angles, so that a box represents it exactly.
  bool rectangle = false;
};

/// Return the surface of the site's face within `size` of its path, as few convex pieces.
///
/// A rectangle is preferred, because the engine finds contacts with boxes exactly. With other
/// shapes it misses some contacts, or misplaces them if the shapes are small. The rectangle is
/// shortened towards the borders of the face, down to size / 64 in sharp corners (size / 256 for a
/// point). If no rectangle fits, the result is the part of the face inside the square of half-side
/// `size` about the path: one piece if that is convex, otherwise one per triangle.
///
/// On a face that is narrower than 1e-3 D, much smaller than a fingertip, the result is the largest
/// rectangle that fits, however small. If none fits, it is 2e-6 D wide and extends across the
/// face's border. There is always at least one piece. A finger that leaves its patch has left the
/// face, or has slipped that far. MuJoCo collides convex shapes only, so fingers touch a nonconvex
/// object through these pieces and never through its hull.
[[nodiscard]] std::vector<ContactPatch> MakeContactPatches(const object::Polyhedron& body,
                                                           const ContactSite& site, double size);

/// Return the piece of a polygon's edge within `size` of the site's path, up to the edge's ends.
/// It is a rectangle of height `thickness` about the plane z = 0.
[[nodiscard]] ContactPatch MakeEdgePatch(const object::Polygon& polygon, const ContactSite& site,
                                         double size, double thickness);

}  // namespace regrasp::sim
