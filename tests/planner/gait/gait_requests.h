#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "planner/base/number.h"
#include "planner/gait/find_gait.h"
#include "planner/kinematics/hand_file.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::gait {

// Requests shared by the tests of gaits.

inline const object::Polyhedron& Model(const std::string& name) {
  static std::map<std::string, object::ObjectFile> files;
  auto& file = files[name];
  if (!file.object) {
    file = object::ReadObject(ProjectPath("models/" + name + ".obj"));
  }
  return dynamic_cast<const object::Polyhedron&>(*file.object);
}

/// A ring hand with four fingers.
inline const kinematics::HandModel& Ring() {
  static const kinematics::HandModel hand =
      kinematics::ReadHand(ProjectPath("models/hands/ring4.json"));
  return hand;
}

/// Return a request to rotate a model about z.
/// @param scale  metres per unit of the model's file.
inline GaitRequest RequestFor(const std::string& model, double scale, double degrees) {
  GaitRequest request;
  request.hand = &Ring();
  request.solid = &Model(model);
  request.scale = scale;
  request.criteria.friction_angle = std::atan(0.8);
  request.turn = {Eigen::Vector3d::UnitZ(), Radians(degrees)};
  request.seed = 2;
  return request;
}

/// Return whether the plan of a result executes. A missing simulation result fails the test.
inline bool ExecutesInSimulation(const GaitResult& result) {
  EXPECT_TRUE(result.execution) << result.message;
  return result.execution && result.execution->is_whole;
}

}  // namespace regrasp::gait
