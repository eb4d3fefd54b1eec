#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/mujoco_model.h"
#include "planner/object/polyhedron.h"
#include "sim/actuation/hand_world.h"

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

/// A rest of a replay, as a scene has it.
struct SceneKey {
  std::string name;
  double time_s = 0;
  std::vector<double> qpos;
  std::vector<double> controls;
};

/// A file of a scene.
struct SceneFile {
  std::string name;
  std::string bytes;
};

inline constexpr const char* kSceneName = "scene.xml";
/// The site of the object's body that is the origin of the object's file.
inline constexpr const char* kSceneOrigin = "regrasp_object_origin";

/// Whether a scene may have a file of this name.
[[nodiscard]] bool IsSceneFile(const std::string& name);

/// The world of a hand as a folder that stock MuJoCo loads, from 2.2.2 on: scene.xml, last, and
/// before it copies of the meshes of the hand. It has the hand's servos and their limits, the
/// object as a mesh, balls at the tips or the model's own, friction, gravity, and a keyframe for
/// each rest.
///
/// What differs from HandWorld: MuJoCo collides the mesh as its convex hull. Pictures on surfaces
/// (textures from files) are left out.
/// @param keys  of a HandWorld of the same hand and object.
/// @throws InputError  as HandWorld.
[[nodiscard]] std::vector<SceneFile> ExportHandScene(const kinematics::HandFile& file,
                                                     const object::Polyhedron& solid, double scale,
                                                     const HandWorldOptions& options,
                                                     const std::vector<SceneKey>& keys);

}  // namespace regrasp::sim
