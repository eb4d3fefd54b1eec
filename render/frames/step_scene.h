#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/shaded_mesh.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// A named part of a 3D scene: copies of a mesh in one colour.
struct ScenePart {
  std::string name;
  ShadedMesh mesh;
  Color color;
  double opacity = 1;
  /// Transformations from the mesh to the scene, one per copy.
  std::vector<Eigen::Affine3d> poses = {Eigen::Affine3d::Identity()};
};

/// Encode a scene as a binary glTF 2.0 file (.glb), with a mesh per part and a node per copy.
/// A part with several copies has a node, which is the parent of its copies.
///
/// Lengths are in the unit of the parts, which glTF interprets as metres. The scene is rotated so
/// that z points up, where glTF has y. Deterministic: the same parts give the same bytes.
/// @param name  name of the root node, the parent of all others.
/// @throws EnvironmentError  if assimp cannot write the scene.
[[nodiscard]] std::string EncodeGlb(const std::string& name, const std::vector<ScenePart>& parts);

/// Colour of an object's former pose.
inline constexpr Color kBefore = {112, 120, 138};

/// Compute an arrow that shows a rotation of the object about its axis, above the end of the object
/// that faces the eye.
///
/// The arc has the angle of the rotation, and at least 30° to show its direction. Lengths are in
/// normalized units.
/// @param surface        surface of the object, in the object frame.
/// @param before, after  poses of the object.
/// @param to_eye         unit vector.
/// @returns points of the arrow up to its head; empty if the rotation is too small to see.
[[nodiscard]] std::vector<Eigen::Vector3d> RotationArrow(const ShadedMesh& surface,
                                                         const Eigen::Isometry3d& before,
                                                         const Eigen::Isometry3d& after,
                                                         const Eigen::Vector3d& to_eye);

/// Add the shapes of a rotation arrow.
/// @param arrow_head  index of the arrow head in the canvas meshes.
void AddRotationArrow(const std::vector<Eigen::Vector3d>& arrow, int arrow_head, Color color,
                      std::vector<Shape>& shapes);

/// Return the areas of a rotation arrow that labels should not cover.
[[nodiscard]] std::vector<Obstacle> ObstaclesOf(const Camera& camera,
                                                const std::vector<Eigen::Vector3d>& arrow);

/// Convert a plan entry to a 3D scene in metres, in the object frame.
///
/// The object is translucent. Each finger has its fingertip sphere, stem and friction cone, and its
/// arrow or track, as in frames but without forces. Names are "object", "finger 0 sphere", "finger
/// 0 cylinder", "finger 0 arrow head", "finger 0 cone" and so on; "ghost" is added to translucent
/// spheres, cylinders and arrow heads.
/// @param located  plan with faces of this object (ProjectPlan).
/// @param entry    index of the entry: 0 the initial grasp, k the k-th step.
[[nodiscard]] std::vector<ScenePart> MakeStepScene(const object::Object& object,
                                                   const plan::Plan& projected,
                                                   plan::EntryIndex entry,
                                                   const BodyOptions& options = {});

}  // namespace regrasp::render
