#include "apps/hand_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>

#include "apps/help.h"
#include "apps/options.h"
#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/hand_model.h"
#include "planner/plan/goal_set_io.h"

namespace regrasp::apps {
namespace {

constexpr double kMostTurns = 10;
constexpr double kLargestClearance_m = 0.05;
/// Tolerance of a quaternion's length, for text with few digits.
constexpr double kLargestNormError = 1e-3;
constexpr double kFarthest_m = 10;
constexpr double kShortestDirection = 1e-9;
constexpr char kAnyGravity[] = "any";

/// Replace commas by spaces; lists are accepted with both.
std::string SpacesForCommas(std::string text) {
  std::ranges::replace(text, ',', ' ');
  return text;
}

/// Parse a finite number that fills the text.
std::optional<double> NumberIn(const std::string& text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [rest, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || rest != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

void CheckRange(const std::string& option, const std::string& what, double value, double lower,
                double upper) {
  if (value >= lower && value <= upper) return;
  throw InputError(option + ": " + what + " must be between " + FormatShort(lower) + " and " +
                   FormatShort(upper) + ", found " + FormatShort(value));
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

/// Read a direction from a list of words: a name, or three numbers.
/// @param up  upward direction of the palm; nullopt: up and down are not accepted.
/// @param along_up  if given, set to plan::FacingGoal::along_up.
std::optional<Eigen::Vector3d> NextDirection(std::istringstream& words,
                                             const std::optional<Eigen::Vector3d>& up,
                                             int* along_up = nullptr) {
  std::string word;
  if (!(words >> word)) return std::nullopt;
  if (along_up != nullptr) *along_up = plan::AlongUp(word);
  if (const auto direction = plan::DirectionOfName(word, up)) return direction;
  Eigen::Vector3d vector;
  for (int k = 0; k < 3; ++k) {
    if (k > 0 && !(words >> word)) return std::nullopt;
    const auto number = NumberIn(word);
    if (!number) return std::nullopt;
    vector[k] = *number;
  }
  return vector;
}

/// Parse the direction of --gravity. @returns the unit vector against it.
Eigen::Vector3d ParseGravity(const std::string& text) {
  std::istringstream words(SpacesForCommas(text));
  const auto down = NextDirection(words, std::nullopt);
  std::string rest;
  if (!down || words >> rest || down->norm() < kShortestDirection) {
    throw InputError(
        "--gravity: expected a direction in the palm frame or any, as in -z, +x or 0,1,-1, found "
        "\"" +
        text + "\"");
  }
  return -down->normalized();
}

/// Parse "+y,up,30".
plan::GoalSet ParseFacing(const std::string& text, const Eigen::Vector3d& up) {
  std::istringstream words(SpacesForCommas(text));
  const auto axis = NextDirection(words, std::nullopt);
  int along_up = 0;
  const auto direction = axis ? NextDirection(words, up, &along_up) : std::nullopt;
  std::string degrees;
  std::string rest;
  const bool is_list = direction && words >> degrees && !(words >> rest);
  const auto tolerance = is_list ? NumberIn(degrees) : std::nullopt;
  if (!tolerance) {
    throw InputError(
        "--goal-facing: expected an axis, a direction and degrees, as in +y,up,30 or "
        "0,1,0,0,0,1,30, found \"" +
        text + "\"");
  }
  for (const Eigen::Vector3d& vector : {*axis, *direction}) {
    if (vector.norm() >= kShortestDirection) continue;
    throw InputError("--goal-facing: must not have a zero vector, found \"" + text + "\"");
  }
  CheckRange("--goal-facing", "degrees", *tolerance, plan::kSmallestGoalAngle_deg,
             plan::kLargestGoalAngle_deg);
  return plan::GoalSet(
      plan::FacingGoal{axis->normalized(), direction->normalized(), Radians(*tolerance), along_up});
}

/// Parse "0.005,10".
plan::PoseTolerance ParseTolerance(const std::string& text) {
  std::istringstream words(SpacesForCommas(text));
  std::array<std::string, 2> parts;
  std::string rest;
  const bool is_list = words >> parts[0] >> parts[1] && !(words >> rest);
  const auto length = is_list ? NumberIn(parts[0]) : std::nullopt;
  const auto degrees = is_list ? NumberIn(parts[1]) : std::nullopt;
  if (!length || !degrees) {
    throw InputError("--goal-tolerance: expected metres and degrees, as in 0.005,10, found \"" +
                     text + "\"");
  }
  CheckRange("--goal-tolerance", "metres", *length, plan::kSmallestGoalLength_m,
             plan::kLargestGoalLength_m);
  CheckRange("--goal-tolerance", "degrees", *degrees, plan::kSmallestGoalAngle_deg,
             plan::kLargestGoalAngle_deg);
  return {*length, Radians(*degrees)};
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
  app.add_option("--goal-facing", goal_facing,
                 "Let an axis of the object point in a direction, as in +y,up,30. Axis: x, y or z "
                 "with an optional sign, or three numbers. Direction: the same in the palm frame, "
                 "up or down. Degrees: largest angle between both. Rotation about the axis and "
                 "position are free. A leading minus sign requires --goal-facing=-y,up,30")
      ->type_name("AXIS,DIRECTION,DEGREES");
  app.add_option(
         "--goal-tolerance", goal_tolerance,
         "Tolerance of --goal-pose, --turn or the pose of a hand grasp: position, angle, as in "
         "0.005,10. "
         "Position: that of the object's origin, with --turn that of its centre "
         "[default: 0.001,1; with --turn some millimetres, exact rotation]")
      ->type_name("METRES,DEGREES");
  app.add_option("--goals", goals,
                 "File of named goals in JSON. The plan reaches them one after the other and marks "
                 "the step of each; `validate` checks every marked goal")
      ->type_name("FILE");
  app.add_option("--gravity", gravity,
                 "Direction of gravity in the palm frame. An axis x, y or z with an optional sign, "
                 "or three numbers. any: the direction of the hand file, otherwise the first of "
                 "the six axes with a plan. The plan records the direction. A leading minus sign "
                 "requires --gravity=-z [default: opposite to `up` of the hand file]")
      ->type_name("DIRECTION|any");
  AddNumber(app, "--mass", mass_kg, NumberRange::Positive(),
            "Mass of the object in simulation, in kg. The plan records it, and `validate` uses it "
            "[default: that of the density of water]",
            "KG");
  AddChoice<bool>(app, "--closure", gravity_support, {{"force", false}, {"gravity", true}},
                  "How grasps hold the object [default: force]\n"
                  "force: every grasp is force closure\n"
                  "gravity: a grasp may also hold the object by its weight, with forces of up to 9 "
                  "weights, against disturbances of 0.1 weights");
  AddChoice<bool>(app, "--rolling", rolls, {{"on", true}, {"off", false}},
                  "Contacts of in-hand motions [default: off]\n"
                  "off: fixed on the object; real fingertips roll and deviate from them\n"
                  "on: fingertips roll without slipping. The plan has the rolled contacts, and all "
                  "its grasps are force closure");
  app.add_option("--continue", continue_plan,
                 "Plan to continue. Its last object pose, contacts and joint angles are the start. "
                 "Hand, object and --scale must be those of that plan")
      ->type_name("PLAN");
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

void HandOptions::Check(const Ends& ends) const {
  for (const auto& [option, value] : {std::pair("--turn", turn),
                                      {"--start-pose", start_pose},
                                      {"--goal-pose", goal_pose},
                                      {"--goal-facing", goal_facing},
                                      {"--goal-tolerance", goal_tolerance},
                                      {"--goals", goals},
                                      {"--gravity", gravity},
                                      {"--mass", mass_kg ? "given" : ""},
                                      {"--closure", gravity_support ? "gravity" : ""},
                                      {"--rolling", rolls ? "on" : ""},
                                      {"--continue", continue_plan}}) {
    if (given() || value.empty()) continue;
    throw InputError(std::string(option) + " requires --hand");
  }
  if (!given()) return;
  const bool moves = ends.ends_at_hand_grasp || !turn.empty() || !goal_pose.empty() ||
                     !goal_facing.empty() || !goals.empty();
  if (!moves && !ends.has_goal) {
    throw InputError(
        "--hand: requires a task, --turn, --goal-pose, --goal-facing, --goals or --goal; help: "
        "--turn z,90");
  }
  if (!moves && !ends.has_start && start_pose.empty() && continue_plan.empty()) {
    throw InputError("--goal: with --hand requires --start or --start-pose");
  }
  if (!turn.empty() && !goal_pose.empty()) {
    throw InputError("--turn: cannot be used with --goal-pose");
  }
  for (const auto& [option, value] : {std::pair("--turn", turn), {"--goal-pose", goal_pose}}) {
    if (goal_facing.empty() || value.empty()) continue;
    throw InputError(std::string("--goal-facing: cannot be used with ") + option);
  }
  for (const auto& [option, value] : {std::pair("--turn", turn),
                                      {"--goal-pose", goal_pose},
                                      {"--goal-facing", goal_facing},
                                      {"--goal", ends.has_goal ? "given" : ""}}) {
    if (goals.empty() || value.empty()) continue;
    throw InputError(std::string("--goals: cannot be used with ") + option);
  }
  for (const auto& [option, value] :
       {std::pair("--start", std::string(ends.has_start ? "given" : "")),
        {"--start-pose", start_pose},
        {"--gravity", gravity}}) {
    if (continue_plan.empty() || value.empty()) continue;
    throw InputError(std::string("--continue: cannot be used with ") + option);
  }
  if (rolls && (ends.has_goal || gravity_support)) {
    throw InputError(
        std::string("--rolling on: cannot be used with ") +
        (gravity_support ? "--closure gravity" : "--goal, because contacts roll away"));
  }
  if (!goal_tolerance.empty() && turn.empty() && goal_pose.empty() && !ends.ends_at_hand_grasp) {
    throw InputError("--goal-tolerance: requires --goal-pose or --turn");
  }
  if (ends.starts_at_hand_grasp && !start_pose.empty()) {
    throw InputError("--start: a hand grasp states the pose, cannot be used with --start-pose");
  }
  for (const auto& [option, value] :
       {std::pair("--turn", turn), {"--goal-pose", goal_pose}, {"--goal-facing", goal_facing}}) {
    if (!ends.ends_at_hand_grasp || value.empty()) continue;
    throw InputError(std::string("--goal: a hand grasp states the pose, cannot be used with ") +
                     option);
  }
}

plan::PoseTolerance HandOptions::GoalTolerance() const {
  return goal_tolerance.empty() ? plan::PoseTolerance() : ParseTolerance(goal_tolerance);
}

void HandOptions::AskFor(planning::InHandTask& task) const {
  task.robustness = robustness.level;
  task.margin = clearance_m;
  if (!turn.empty()) task.turn = ParseTurn(turn);
  if (!start_pose.empty()) task.start_pose = ParsePose("--start-pose", start_pose);
  std::optional<plan::PoseTolerance> tolerance;
  if (!goal_tolerance.empty()) tolerance = ParseTolerance(goal_tolerance);
  if (!turn.empty()) task.turn_tolerance = tolerance;
  if (!goal_pose.empty()) {
    task.goal = plan::GoalSet(plan::PoseGoal{ParsePose("--goal-pose", goal_pose),
                                             tolerance.value_or(plan::PoseTolerance())});
  }
  Eigen::Vector3d up = task.hand == nullptr ? Eigen::Vector3d::UnitZ() : task.hand->up;
  if (gravity == kAnyGravity) {
    if (task.hand != nullptr) task.ups = kinematics::UpDirections(*task.hand);
  } else if (!gravity.empty()) {
    up = ParseGravity(gravity);
    task.ups = {up};
  }
  if (gravity_support) task.gravity_support.emplace();
  task.rolls = rolls;
  if (!goal_facing.empty()) task.goal = ParseFacing(goal_facing, up);
  if (!goals.empty() && task.hand != nullptr) task.goals = plan::ReadGoalList(goals, up);
}

}  // namespace regrasp::apps
