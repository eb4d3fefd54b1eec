#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/mujoco_model.h"
#include "planner/object/polyhedron.h"
#include "sim/actuation/hand_world.h"

namespace regrasp::sim {

/// Name of the object's body and of its geom, which has no contacts by default.
inline constexpr const char* kHandSceneObject = "regrasp_object";

/// Return the model of a hand with the object in it.
/// The object is a free body with its mass and inertia, its origin at its centroid and the axes of
/// its file. Couplings of the hand's file become constraints. A URDF has no actuators. It gets an
/// actuator for each independent joint of a finger, with the force limit of the joint.
/// @param scale  metres per unit of the object's file. @param mass  mass of the object, kg.
[[nodiscard]] kinematics::ModelText HandSceneText(const kinematics::HandFile& file,
                                                  const object::Polyhedron& solid, double scale,
                                                  double mass);

/// Write the compiled inertia of every body, and remove compiler settings that derive or scale
/// masses. They would change an object that is added to the model.
/// @param model  model of the text, with its bodies in the same order.
void FixMasses(const mjModel_& model, kinematics::XmlElement& root);

/// A static grasp of a replay as a keyframe of a scene.
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
/// Name of the site at the origin of the object's file, in the object's body.
inline constexpr const char* kSceneOrigin = "regrasp_object_origin";

/// Return whether a scene may have a file of this name.
[[nodiscard]] bool IsSceneFile(const std::string& name);

/// Export the world of a hand as a folder that stock MuJoCo loads, from version 2.2.2 on.
/// The folder has copies of the meshes of the hand, and scene.xml as the last file. The scene has:
///
/// - the hand's servos and their limits
/// - the object as a mesh
/// - spheres at the fingertips, or the model's geometry
/// - friction and gravity
/// - a keyframe for each static grasp
///
/// It differs from HandWorld in one point: MuJoCo collides the convex hull of the mesh. Textures
/// from files are omitted.
/// @param keys  keyframes from a HandWorld of the same hand and object.
/// @throws InputError  as HandWorld.
[[nodiscard]] std::vector<SceneFile> ExportHandScene(const kinematics::HandFile& file,
                                                     const object::Polyhedron& solid, double scale,
                                                     const HandWorldOptions& options,
                                                     const std::vector<SceneKey>& keys);

}  // namespace regrasp::sim
