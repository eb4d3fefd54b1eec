#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/object.h"
#include "render/frames/facet_mesh.h"
#include "render/frames/ray_tree.h"

namespace regrasp::render {

/// Which edges of an object's facets are drawn.
enum class EdgeStyle {
  kCrease,  ///< those where the surface turns by more than the crease angle, but for short ends
  kAll,     ///< all between facets that are not coplanar
  kNone,
};

/// Where a surface turns by less than this, radians, it is drawn as one smooth surface.
inline constexpr double kUsualCreaseAngle = Radians(40);

/// Where two facets meet: part of the outline where one of them faces the eye and the other does
/// not.
struct Fold {
  std::array<Eigen::Vector3d, 2> edge;
  std::array<Eigen::Vector3d, 2> normals;  ///< unit, of the two facets, outward
};

/// What is drawn of an object: its true surface, shaded smoothly but across creases, its edges, and
/// the folds that may be its outline.
struct BodyShape {
  FacetMesh surface;
  RayTree rays;  ///< that meet the surface
  std::vector<std::array<Eigen::Vector3d, 2>> edges;
  std::vector<Fold> folds;
};

/// Thickness of the prism that stands for a polygon where none is given, in diameters.
inline constexpr double kUsualThickness = 0.25;

struct BodyOptions {
  double thickness = kUsualThickness;  ///< of the prism of a planar object, in diameters
  EdgeStyle edges = EdgeStyle::kCrease;
  double crease_angle = kUsualCreaseAngle;  ///< radians
};

/// The shape of an object about its centroid in units of its diameter. A polygon becomes a prism
/// whose top lies in the plane z = 0, a hair above it: contacts, fingers and cones, which are drawn
/// at z = 0, are then seen on its outline and before it.
[[nodiscard]] BodyShape MakeBodyShape(const object::Object& object,
                                      const BodyOptions& options = {});

/// The folds of a body that an eye sees as its outline, or as the outline of a part of it.
/// @param to_eye  from a point of the body towards the eye, in the body's frame; any length.
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
