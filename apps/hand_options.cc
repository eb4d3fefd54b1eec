#include "apps/hand_options.h"

#include <array>
#include <cmath>
#include <sstream>
#include <tuple>

#include "apps/help.h"
#include "apps/options.h"
#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::apps {
namespace {

constexpr double kMostTurns = 10;
constexpr double kLargestClearance_m = 0.05;
/// Of a quaternion's length: it may have been written with a few digits.
constexpr double kLargestNormError = 1e-3;
constexpr double kFarthest_m = 10;

/// "z 90" as a turn.
planning::Turn ParseTurn(const std::string& turn) {
  std::istringstream words(turn);
  std::string axis;
  std::string rest;
  double degrees = 0;
  const auto fail = [&]() -> planning::Turn {
    throw InputError("--turn: expected an axis and degrees, as in \"z 90\", found \"" + turn +
                     "\"");
  };
  if (!(words >> axis >> degrees) || words >> rest || axis.size() != 1) return fail();
  const std::size_t which = std::string("xyz").find(axis);
  if (which == std::string::npos) return fail();
  if (!std::isfinite(degrees) || degrees == 0 || std::abs(degrees) > kMostTurns * 360) {
    throw InputError("--turn: degrees must be other than 0 and at most 3600, found \"" + turn +
                     "\"");
  }
  return {Eigen::Vector3d::Unit(static_cast<Eigen::Index>(which)), Radians(degrees)};
}

Eigen::Isometry3d ParsePose(const std::string& option, const std::string& text) {
  std::istringstream words(text);
  std::array<double, 7> v = {};
  for (double& number : v) {
    if (words >> number && std::isfinite(number)) continue;
    throw InputError(option +
                     ": expected a position and a quaternion, 7 numbers as in \"0 0 0.12 "
                     "1 0 0 0\", found \"" +
                     text + "\"");
  }
  if (std::string rest; words >> rest) {
    throw InputError(option + ": expected 7 numbers, found more: \"" + rest + "\"");
  }
  const Eigen::Quaterniond turn(v[3], v[4], v[5], v[6]);
  if (std::abs(turn.norm() - 1) > kLargestNormError) {
    throw InputError(option + ": the quaternion's length must be 1, found " +
                     FormatShort(turn.norm(), 4));
  }
  const Eigen::Vector3d position(v[0], v[1], v[2]);
  if (position.norm() > kFarthest_m) {
    throw InputError(option + ": positions are in metres from the palm, found " +
                     FormatShort(position.norm(), 4) + " m");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn.normalized().toRotationMatrix();
  pose.translation() = position;
  return pose;
}

}  // namespace

void HandOptions::AddTo(CLI::App& app) {
  BeginGroup(app, "A hand");
  app.add_option("--hand", hand,
                 "The hand that moves the object; a file of the format regrasp-hand. The plan then "
                 "has the joints of every finger and the object's pose in the palm all along")
      ->type_name("FILE");
  app.add_option(
         "--turn", turn,
         "Turn the object in the hand; about an axis of its own by so many degrees, as in "
         "\"z 90\". The hand begins where the object's z axis is upright and its fingers "
         "reach most, unless --start or --start-pose say otherwise; the object's middle may "
         "end some millimetres away")
      ->type_name("\"AXIS DEGREES\"");
  for (const auto& [option, value, what] :
       {std::tuple("--start-pose", &start_pose,
                   "Where the object is in the hand at first; position of its origin in the "
                   "palm's frame, metres, and quaternion, as in \"0 0 0.12 1 0 0 0\""),
        {"--goal-pose", &goal_pose, "Where it is to be in the end; written likewise"}}) {
    app.add_option(option, *value, what)->type_name("\"X Y Z QW QX QY QZ\"");
  }
  AddNumber(app, "--clearance", clearance_m, {0, kLargestClearance_m, true, true},
            "What links keep from each other, from the palm and from the object; in metres "
            "(default 0.001)",
            "M");
  AddChoice<planning::RobustnessLevel>(
      app, "--reserve", robustness,
      {{"preferred", planning::RobustnessLevel::kPreferred},
       {"required", planning::RobustnessLevel::kRequired},
       {"none", planning::RobustnessLevel::kNone}},
      "Something to spare, for the hand's own motors: forces well inside their cones, better "
      "grasps that also hold where contacts roll to, more clearance, no slides. Plans are tried on "
      "the hand's model, and one is taken that its motors carry out. required, or there is no "
      "plan, and it is said what fails; preferred, otherwise one is written that they do not carry "
      "out, with a warning; none, nothing is tried (default required)");
}

void HandOptions::Check(const std::string& start, const std::string& goal) const {
  for (const auto& [option, value] :
       {std::pair("--turn", turn), {"--start-pose", start_pose}, {"--goal-pose", goal_pose}}) {
    if (given() || value.empty()) continue;
    throw InputError(std::string(option) + " requires --hand");
  }
  if (!given()) return;
  const bool moves = !turn.empty() || !goal_pose.empty();
  if (!moves && goal.empty()) {
    throw InputError(
        "--hand: --turn, --goal-pose or --goal says what the hand is to do, as in --turn \"z 90\"");
  }
  if (!moves && start.empty() && start_pose.empty()) {
    throw InputError("--goal: --start or --start-pose says what is before it");
  }
  if (!turn.empty() && !goal_pose.empty()) {
    throw InputError("--turn: --goal-pose says already how the object is to be in the end");
  }
}

void HandOptions::AskFor(planning::InHandTask& task) const {
  task.robustness = robustness;
  task.margin = clearance_m;
  if (!turn.empty()) task.turn = ParseTurn(turn);
  if (!start_pose.empty()) task.start_pose = ParsePose("--start-pose", start_pose);
  if (!goal_pose.empty()) task.goal_pose = ParsePose("--goal-pose", goal_pose);
}

}  // namespace regrasp::apps
