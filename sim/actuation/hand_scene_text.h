#pragma once

#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/mujoco_model.h"
#include "planner/object/polyhedron.h"

namespace regrasp::sim {

/// The body of the object, and its geom, which touches nothing by itself.
inline constexpr const char* kHandSceneObject = "regrasp_object";

/// The model of a hand with the object in it: a free body with its mass and inertia, the origin at
/// its centroid, the axes of its file. Couplings of the hand's file become constraints; a URDF,
/// which has no actuators, gets a motor for each drive of a finger, as strong as the joint may be.
/// @param scale  metres per unit of the object's file. @param mass  kg.
[[nodiscard]] kinematics::ModelText HandSceneText(const kinematics::HandFile& file,
                                                  const object::Polyhedron& solid, double scale,
                                                  double mass);

}  // namespace regrasp::sim
