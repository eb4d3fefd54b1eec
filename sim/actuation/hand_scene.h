#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/mujoco_model.h"
#include "planner/object/polyhedron.h"
#include "sim/actuation/drive_servo.h"
#include "sim/actuation/hand_engine.h"
#include "sim/actuation/hand_links.h"
#include "sim/actuation/joint_couplings.h"
#include "sim/actuation/tip_geometry.h"
#include "sim/scene/engine.h"

namespace regrasp::sim {

/// The hand and the object that every engine of a hand replay simulates: the hand's model with its
/// servos and the object in it, and the object's surface. It has masses, inertias, axes, gains and
/// limits; each engine has its own dynamics and contacts. The engine's world is the model's.
struct HandScene {
  struct Finger {
    std::vector<int> joints;  ///< joints of the model
    int tip_body = 0;
    int tip_geom = 0;  ///< geom that represents all touching shapes
    std::vector<DriveActuator> drives;
  };

  /// @throws InputError  if the hand's model cannot be simulated; as TipShapesOf.
  HandScene(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
            const HandWorldOptions& given);

  [[nodiscard]] int Id(int kind, const std::string& name) const;
  /// Return whether a joint is revolute or prismatic.
  [[nodiscard]] bool IsScalar(int joint) const;

  EngineHooks hooks;
  kinematics::HandModel hand;
  HandLinks links;
  TipSurface surface;
  HandWorldOptions options;
  kinematics::ModelPtr model;
  kinematics::DataPtr data;  ///< data of the model, in its reference configuration
  Eigen::Isometry3d palm = Eigen::Isometry3d::Identity();  ///< pose in the engine's world
  Eigen::Vector3d centroid;                                ///< centroid of the object, in its frame
  int object_body = 0, object_geom = 0, object_qpos = 0;
  std::vector<Finger> fingers;
  std::vector<int> frozen;  ///< frozen joints
  std::optional<JointCouplings> couplings;

 private:
  void FindParts(const kinematics::HandFile& file);
  void CheckObjectMass(const kinematics::HandFile& file) const;
  void FindFrozen();
  void FindServos();
  void SetTruePhysics();
};

}  // namespace regrasp::sim
