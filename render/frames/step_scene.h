#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/facet_mesh.h"
#include "render/frames/gltf.h"
#include "render/picture/label_layout.h"

namespace regrasp::render {

/// What is drawn of where an object was before it moved.
inline constexpr Color kBefore = {112, 120, 138};

/// How an object turned, as an arrow about the axis of its turn, over the end of the object that is
/// turned to the eye: as long as the turn, in the picture's unit of length.
///
/// @param surface        of the object, in its frame.
/// @param before, after  its pose.
/// @param to_eye         unit.
/// @returns points of the arrow, the last one its tip; none of a turn that is too small to be seen.
[[nodiscard]] std::vector<Eigen::Vector3d> TurnArrow(const FacetMesh& surface,
                                                     const Eigen::Isometry3d& before,
                                                     const Eigen::Isometry3d& after,
                                                     const Eigen::Vector3d& to_eye);

/// Draws it. @param arrow_head  among the canvas's meshes.
void AddTurnArrow(const std::vector<Eigen::Vector3d>& arrow, int arrow_head, Color color,
                  std::vector<Shape>& shapes);

/// What labels should not cover of it.
[[nodiscard]] std::vector<Obstacle> ObstaclesOf(const Camera& camera,
                                                const std::vector<Eigen::Vector3d>& arrow);

/// An entry of a plan as a scene in space, metres, in the object's frame: the object as glass, and
/// for each finger its ball, stem and friction cone, its arrow or its track, as frames draw them,
/// without forces. Names are "object", "finger 0", "finger 0 cone" ...
/// @param located  the plan on this object (LocatePlan).
/// @param entry    0 the hold, k the k-th step.
[[nodiscard]] std::vector<ScenePart> MakeStepScene(const object::Object& object,
                                                   const plan::Plan& located,
                                                   plan::EntryIndex entry,
                                                   const BodyOptions& options = {});

}  // namespace regrasp::render
