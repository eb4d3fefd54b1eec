#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp::sim {

/// The true surface of the body that is simulated, for the eye.
struct VisibleSurface {
  std::vector<Eigen::Vector3d> vertices;      ///< the object's own frame and units
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
};

/// A solid's own surface; a polygon's prism of the height `thickness` about the plane z = 0.
[[nodiscard]] VisibleSurface MakeVisibleSurface(const object::Object& object, double thickness);

/// Where a finger touches: a face (an edge, in the plane), and the straight path of the contact on
/// it (a point where `from` is `to`). Lengths are the object's own units.
struct ContactSite {
  FaceIndex face = {};
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};

/// A convex piece of the true surface near a site; its prism is what a finger collides with.
struct ContactPatch {
  std::vector<Eigen::Vector3d> outline;  ///< counter-clockwise from outside
  bool rectangle = false;                ///< of four right angles: a box will do, found exactly
};

/// The surface of the site's face within `size` of its path, as few convex pieces.
///
/// A rectangle where one fits between the borders, cut short towards them and as small as size / 64
/// in sharp corners of the face (size / 256 for a point), since the engine finds contacts with
/// boxes exactly and misses some of those with other shapes, or finds them in the wrong place where
/// they are small; otherwise the part of the face inside the square of half-side `size` about the
/// path, in one piece where that is convex, else one per triangle. On a face that is narrower than
/// 1e-3 D, far smaller than a fingertip, the largest rectangle that fits, however small; 2e-6 D
/// wide where none does, across the face's border. Never none. A finger that leaves its patch has
/// left the face or slipped that far. MuJoCo collides convex shapes only, so a body that is not
/// convex is touched through these and never through its hull.
[[nodiscard]] std::vector<ContactPatch> MakeContactPatches(const object::Polyhedron& body,
                                                           const ContactSite& site, double size);

/// The piece of a polygon's edge within `size` of the site's path, cut at the edge's ends: a
/// rectangle of the height `thickness` about the plane z = 0.
[[nodiscard]] ContactPatch MakeEdgePatch(const object::Polygon& polygon, const ContactSite& site,
                                         double size, double thickness);

}  // namespace regrasp::sim
