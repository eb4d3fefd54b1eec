#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/mujoco_model.h"
#include "planner/object/object.h"
#include "planner/plan/projection.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::sim {

/// Replacement of a text in a file, at every occurrence.
struct Edit {
  std::string from;
  std::string to;
};

/// Fixture for hands whose model text differs from ring5, and for their plans for a cube of 5 cm.
class EditedHandTest : public FolderTest {
 protected:
  static constexpr double kScale = 0.8333;
  static constexpr double kMu = 0.8;
  static constexpr double kMass = 0.125;

  [[nodiscard]] static std::string Edited(std::string text, const std::vector<Edit>& edits) {
    for (const auto& [from, to] : edits) {
      std::size_t at = text.find(from);
      if (at == std::string::npos) throw std::runtime_error("the model has no " + from);
      for (; at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
      }
    }
    return text;
  }
  [[nodiscard]] static std::string RingText() {
    return ReadFile(ProjectPath("models/hands/ring5.xml"));
  }
  /// @param coupled  true: the last joint of each finger follows the joint before it.
  [[nodiscard]] kinematics::HandFile HandWith(const std::vector<Edit>& edits,
                                              bool coupled = false) const {
    Json json = ParseJson(ReadFile(ProjectPath("models/hands/ring5.json")), "ring5.json");
    if (coupled) {
      for (int f = 0; f < 5; ++f) {
        const std::string finger = "finger" + std::to_string(f);
        json["couplings"].push_back(
            {{"joint", finger + "_joint3"}, {"follows", finger + "_joint2"}, {"ratio", 1.0}});
      }
    }
    static_cast<void>(Write("ring5.xml", Edited(RingText(), edits)));
    return kinematics::ReadHandFile(Write("hand.json", json.dump()));
  }
  /// Return a hand without inertia behind its joints, without servos and with coupled joints.
  /// Most URDFs and MJCF models with torque actuators are like this.
  [[nodiscard]] kinematics::HandFile CoupledHand() const {
    std::vector<Edit> edits = {{" armature=\"0.001\"", ""},
                               {"<position kp=\"2.0\" forcerange=\"-1.0 1.0\"/>",
                                "<motor forcelimited=\"true\" forcerange=\"-1.0 1.0\"/>"},
                               {"<position name", "<motor name"}};
    std::string equalities = "<equality>";
    for (int f = 0; f < 5; ++f) {
      const std::string finger = "finger" + std::to_string(f);
      edits.push_back(
          {"<motor name=\"" + finger + "_motor3\" joint=\"" + finger + "_joint3\"/>", ""});
      equalities += "<joint joint1=\"" + finger + "_joint3\" joint2=\"" + finger +
                    "_joint2\" polycoef=\"0 1 0 0 0\"/>";
    }
    edits.push_back({"<actuator>", equalities + "</equality><actuator>"});
    return HandWith(edits, true);
  }
  /// Return ring5 on a wrist, which the replay keeps fixed.
  [[nodiscard]] kinematics::HandFile HandOnWrist() const {
    return HandWith(
        {{"<body name=\"palm\">",
          "<body name=\"palm\"><joint name=\"wrist\" axis=\"1 0 0\" range=\"-30 30\"/>"}});
  }
  /// Return a hand whose compiled model is not the one that its joints were read from. A model that
  /// the hand reader rejects must not affect a replay either.
  [[nodiscard]] kinematics::HandFile WithModel(kinematics::HandFile hand,
                                               const std::string& model) const {
    hand.compiled = std::make_shared<const kinematics::CompiledModel>(
        kinematics::CompileModel(Write("other.xml", model)));
    return hand;
  }
  /// Plan for a rotation of the cube about z, radians, with the friction of the world.
  [[nodiscard]] plan::Plan PlanFor(const kinematics::HandFile& hand, double turn = 0.3) const {
    gait::GaitRequest request;
    request.hand = &hand.hand;
    request.solid = &solid();
    request.scale = kScale;
    request.criteria.friction_angle = std::atan(0.5);
    request.criteria.min_quality = 0.06;
    request.turn = {Eigen::Vector3d::UnitZ(), turn};
    const gait::GaitResult found = gait::FindGait(request);
    if (!found.gait) throw std::runtime_error(found.message);
    plan::Plan plan =
        plan::ProjectPlan(solid(), gait::PlanOf(*found.gait, request, found.contacts));
    plan.friction_angle = std::atan(kMu);
    return plan;
  }
  [[nodiscard]] const object::Polyhedron& solid() const {
    return dynamic_cast<const object::Polyhedron&>(*cube_.object);
  }

  object::ObjectFile cube_ = object::ReadObject(ProjectPath("models/cube.obj"));
};

}  // namespace regrasp::sim
