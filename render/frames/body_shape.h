#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/object.h"
#include "render/frames/shaded_mesh.h"

namespace regrasp::render {

/// Selection of the edges of an object's triangles that are drawn.
enum class EdgeStyle {
  kCrease,  ///< edges at which the surface bends by more than the crease angle, except isolated
            ///< short ones; none of a scan, which bends at nearly every edge and rarely sharply
  kAll,     ///< all edges between triangles that are not coplanar
  kNone,
};

/// Crease angle of the default options, radians. Smaller bends are shaded smoothly.
inline constexpr double kDefaultCreaseAngle = Radians(40);

/// A convex edge between two triangles. It is part of the outline if exactly one of them faces the
/// eye. The solid hides a concave edge from all directions in which this holds.
struct Fold {
  std::array<Eigen::Vector3d, 2> edge;
  std::array<Eigen::Vector3d, 2> normals;  ///< outward unit normals of the two triangles
};

/// Width of edges and outlines, in diameters.
inline constexpr double kEdgeWidth = 0.0052;

/// Drawable parts of an object: its exact surface with smooth shading up to creases, its edges, and
/// the folds that can be part of its outline. A surface that is curved nearly everywhere, like a
/// scan, has smooth shading throughout.
struct BodyShape {
  ShadedMesh surface;
  RayTree rays;  ///< ray queries of the surface
  std::vector<std::array<Eigen::Vector3d, 2>> edges;
  std::vector<Fold> folds;
  /// Shell of a surface that is curved nearly everywhere; empty for other surfaces. Its rim is a
  /// smooth outline. The folds of such a surface would be a zigzag with loose ends.
  ShadedMesh shell = {};
};

/// Default thickness of the prism that represents a polygon, in object diameters.
inline constexpr double kDefaultThickness = 0.25;

struct BodyOptions {
  /// Thickness of the prism of a planar object, in object diameters.
  double thickness = kDefaultThickness;
  EdgeStyle edges = EdgeStyle::kCrease;
  double crease_angle = kDefaultCreaseAngle;  ///< crease angle, radians
};

/// Compute the shape of an object relative to its centroid, in units of its diameter.
///
/// A polygon becomes a prism whose top is slightly above the plane z = 0. Contacts, fingers and
/// cones are drawn at z = 0, so they appear on its outline and in front of it.
[[nodiscard]] BodyShape MakeBodyShape(const object::Object& object,
                                      const BodyOptions& options = {});

/// Return the folds that appear as outline of the object or of a part of it.
/// @param to_eye  function from a point of the object to a vector towards the eye, in the object
///                frame, of any length.
template <class ToEye>
[[nodiscard]] std::vector<std::array<Eigen::Vector3d, 2>> FindOutline(const BodyShape& body,
                                                                      const ToEye& to_eye) {
  std::vector<std::array<Eigen::Vector3d, 2>> outline;
  for (const auto& [edge, normals] : body.folds) {
    const Eigen::Vector3d back = to_eye(edge[0]);
    if ((normals[0].dot(back) > 0) != (normals[1].dot(back) > 0)) outline.push_back(edge);
  }
  return outline;
}

}  // namespace regrasp::render
