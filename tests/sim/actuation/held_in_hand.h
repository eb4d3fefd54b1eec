#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/projection.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::sim {

/// Fixture of a hand that holds a cube of 5 cm in the initial grasp of a plan.
class HeldInHand : public testing::Test {
 protected:
  HeldInHand() {
    gait::GaitRequest request;
    request.hand = &hand_.hand;
    request.solid = &solid();
    request.scale = kScale;
    request.criteria.friction_angle = std::atan(0.5);
    request.criteria.min_quality = 0.06;
    request.turn = {Eigen::Vector3d::UnitZ(), 0.3};
    const gait::GaitResult found = gait::FindGait(request);
    if (!found.gait) throw std::runtime_error(found.message);
    plan_ = plan::ProjectPlan(solid(), gait::PlanOf(*found.gait, request, found.contacts));
    plan_.friction_angle = std::atan(kMu);
  }
  [[nodiscard]] const object::Polyhedron& solid() const {
    return dynamic_cast<const object::Polyhedron&>(*cube_.object);
  }

  static constexpr double kScale = 0.8333;
  static constexpr double kMu = 0.8;
  static constexpr double kMass = 0.125;
  kinematics::HandFile hand_ = kinematics::ReadHandFile(ProjectPath("models/hands/ring5.json"));
  object::ObjectFile cube_ = object::ReadObject(ProjectPath("models/cube.obj"));
  plan::Plan plan_;
};

}  // namespace regrasp::sim
