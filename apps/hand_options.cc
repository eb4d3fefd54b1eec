#include "apps/hand_options.h"

#include <algorithm>
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
/// Tolerance of a quaternion's length, for text with few digits.
constexpr double kLargestNormError = 1e-3;
constexpr double kFarthest_m = 10;

/// Replace commas by spaces; lists are accepted with both.
std::string SpacesForCommas(std::string text) {
  std::ranges::replace(text, ',', ' ');
  return text;
}

/// Parse "z,90".
planning::Turn ParseTurn(const std::string& turn) {
  std::istringstream words(SpacesForCommas(turn));
  std::string axis;
  std::string rest;
  double degrees = 0;
  const auto fail = [&]() -> planning::Turn {
    throw InputError("--turn: expected an axis and degrees, as in z,90, found \"" + turn + "\"");
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
  std::istringstream words(SpacesForCommas(text));
  std::array<double, 7> v = {};
  for (double& number : v) {
    if (words >> number && std::isfinite(number)) continue;
    throw InputError(option +
                     ": expected a position and a quaternion, 7 numbers as in "
                     "0,0,0.12,1,0,0,0, found \"" +
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
  BeginGroup(app, "Hand");
  app.add_option("--hand", hand,
                 "Hand file. The plan then contains joint trajectories and the object's pose in "
                 "the palm frame")
      ->type_name("FILE");
  app.add_option("--turn", turn,
                 "Rotate the object about one of its axes, as in z,90. The program chooses the "
                 "initial pose unless --start or --start-pose states it; the object's centre can "
                 "end some millimetres off")
      ->type_name("AXIS,DEGREES");
  for (const auto& [option, value, what] :
       {std::tuple("--start-pose", &start_pose,
                   "Initial pose of the object in the palm frame. Position in metres and unit "
                   "quaternion, as in 0,0,0.12,1,0,0,0"),
        {"--goal-pose", &goal_pose,
         "Goal pose of the object in the palm frame. As --start-pose"}}) {
    app.add_option(option, *value, what)->type_name("X,Y,Z,QW,QX,QY,QZ");
  }
  AddNumber(app, "--clearance", clearance_m, {0, kLargestClearance_m, true, true},
            "Minimum distance of links from each other, palm and object, metres "
            "[default: 0.001]",
            "M");
  using Level = planning::RobustnessLevel;
  AddChoice<Robustness>(
      app, "--robustness", robustness,
      {{"preferred", {Level::kPreferred}},
       {"required", {Level::kRequired}},
       {"nominal", {Level::kRequired}},
       {"standard", {Level::kRequired, sim::PlanningRobustness::kStandard}},
       {"none", {Level::kNone}}},
      "Required robustness of a hand plan [default: required]\n"
      "required, nominal: return only plans that execute in simulation on the hand's actuators\n"
      "standard: return only plans that also execute with realistic sensors, joint errors of 0.5° "
      "and 20 % less friction\n"
      "preferred: otherwise write the best plan with a warning\n"
      "none: no simulation, no extra margins");
  MarkRare(app, {"--clearance"});
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
    throw InputError("--hand: requires a task, --turn, --goal-pose or --goal; help: --turn z,90");
  }
  if (!moves && start.empty() && start_pose.empty()) {
    throw InputError("--goal: with --hand requires --start or --start-pose");
  }
  if (!turn.empty() && !goal_pose.empty()) {
    throw InputError("--turn: cannot be used with --goal-pose");
  }
}

void HandOptions::AskFor(planning::InHandTask& task) const {
  task.robustness = robustness.level;
  task.margin = clearance_m;
  if (!turn.empty()) task.turn = ParseTurn(turn);
  if (!start_pose.empty()) task.start_pose = ParsePose("--start-pose", start_pose);
  if (!goal_pose.empty()) task.goal_pose = ParsePose("--goal-pose", goal_pose);
}

}  // namespace regrasp::apps
