#include "planner/plan/goal_set_io.h"

#include <cmath>
#include <limits>
#include <set>

#include "planner/base/file.h"
#include "planner/base/number.h"

namespace regrasp::plan {

namespace {

/// Smallest length of a vector that has a direction.
constexpr double kShortestDirection = 1e-9;

/// Return degrees without the rounding of the conversion: 30 instead of 30.000000000000004.
double RoundedDegrees(double radians) {
  constexpr double kRounding = 1e9;
  return std::round(Degrees(radians) * kRounding) / kRounding;
}

double ReadTolerance(const JsonReader& json, double lower, double upper) {
  const double tolerance = json.Number();
  if (tolerance >= lower && tolerance <= upper) return tolerance;
  json.Fail("must be between " + FormatShort(lower) + " and " + FormatShort(upper) + ", found " +
            json.Quoted());
}

double ReadToleranceAngle(const JsonReader& json) {
  return Radians(ReadTolerance(json, kSmallestGoalAngle_deg, kLargestGoalAngle_deg));
}

/// Read a name or a vector of any length except 0.
Eigen::Vector3d ReadDirection(const JsonReader& json, const std::optional<Eigen::Vector3d>& up) {
  if (json.IsString()) {
    if (const auto direction = DirectionOfName(json.String(), up)) return *direction;
  }
  if (!json.IsArray()) {
    json.Fail(std::string("expected 3 numbers, or x, y or z with an optional sign") +
              (up ? ", up or down" : "") + ", found " + json.Quoted());
  }
  const Eigen::Vector3d vector = json.Vector(3);
  if (!(vector.norm() >= kShortestDirection)) json.Fail("must not be a zero vector");
  return vector.normalized();
}

FacingGoal ReadFacing(const JsonReader& json, const std::optional<Eigen::Vector3d>& up) {
  json.ExpectOnly({"axis", "direction", "tolerance_deg"});
  const JsonReader& direction = json.Member("direction");
  return {ReadDirection(json.Member("axis"), std::nullopt), ReadDirection(direction, up),
          ReadToleranceAngle(json.Member("tolerance_deg")),
          direction.IsString() ? AlongUp(direction.String()) : 0};
}

PoseGoal ReadPoseGoal(const JsonReader& json) {
  PoseGoal goal{ReadPose(json.Member("pose"))};
  if (json.Has("tolerance_m")) {
    goal.tolerance.length =
        ReadTolerance(json.Member("tolerance_m"), kSmallestGoalLength_m, kLargestGoalLength_m);
  }
  if (json.Has("tolerance_deg")) {
    goal.tolerance.angle = ReadToleranceAngle(json.Member("tolerance_deg"));
  }
  if (json.Has("point")) goal.point = json.Member("point").Vector(3);
  return goal;
}

}  // namespace

int AlongUp(const std::string& name) {
  if (name == "up") return 1;
  return name == "down" ? -1 : 0;
}

std::optional<Eigen::Vector3d> DirectionOfName(const std::string& name,
                                               const std::optional<Eigen::Vector3d>& up) {
  if (up && AlongUp(name) != 0) return AlongUp(name) * up->normalized();
  const bool has_sign = !name.empty() && (name[0] == '+' || name[0] == '-');
  const std::string axis = name.substr(has_sign ? 1 : 0);
  const std::size_t which = axis.size() == 1 ? std::string("xyz").find(axis) : std::string::npos;
  if (which == std::string::npos) return std::nullopt;
  const Eigen::Vector3d unit = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(which));
  return name[0] == '-' ? Eigen::Vector3d(-unit) : unit;
}

GoalSet ReadGoalSet(const JsonReader& json, const std::optional<Eigen::Vector3d>& up) {
  if (json.Has("facing") == json.Has("pose")) json.Fail("expected either \"facing\" or \"pose\"");
  if (json.Has("pose")) return GoalSet(ReadPoseGoal(json));
  for (const char* name : {"tolerance_m", "tolerance_deg", "point"}) {
    if (json.Has(name)) json.Member(name).Fail("cannot be used with \"facing\"");
  }
  return GoalSet(ReadFacing(json.Member("facing"), up));
}

Json GoalSetJson(const GoalSet& set) {
  if (const FacingGoal* goal = set.facing()) {
    return {{"facing",
             {{"axis", VectorJson(goal->axis, 3)},
              {"direction", VectorJson(goal->direction, 3)},
              {"tolerance_deg", RoundedDegrees(goal->tolerance)}}}};
  }
  const PoseGoal& goal = *set.pose();
  Json json = {{"pose", PoseJson(goal.pose)},
               {"tolerance_m", goal.tolerance.length},
               {"tolerance_deg", RoundedDegrees(goal.tolerance.angle)}};
  if (!goal.point.isZero(0)) json["point"] = VectorJson(goal.point, 3);
  return json;
}

std::vector<NamedGoal> ParseGoalList(std::string_view text, const std::string& name,
                                     const Eigen::Vector3d& up) {
  const Json json = ParseJson(text, name);
  const JsonReader root(json, name);
  root.ExpectOnly({"format", "version", "goals"});
  root.ExpectFormat("regrasp-goals");
  const JsonReader list = root.Member("goals");
  const std::vector<JsonReader> elements = list.Elements();
  if (elements.empty()) list.Fail("must not be empty");
  if (elements.size() > kMostGoals) {
    list.Fail("expected at most " + std::to_string(kMostGoals) + " goals, found " +
              std::to_string(elements.size()));
  }
  std::vector<NamedGoal> goals;
  std::set<std::string> names;
  for (const JsonReader& element : elements) {
    element.ExpectOnly({"name", "facing", "pose", "tolerance_m", "tolerance_deg", "point"});
    const JsonReader goal_name = element.Member("name");
    goals.push_back({goal_name.Name(), ReadGoalSet(element, up)});
    if (goals.back().name.empty()) goal_name.Fail("must not be empty");
    if (!names.insert(goals.back().name).second) {
      goal_name.Fail("must be unique, found " + goal_name.Quoted() + " again");
    }
  }
  return goals;
}

std::vector<NamedGoal> ReadGoalList(const std::filesystem::path& path, const Eigen::Vector3d& up) {
  return ParseGoalList(ReadFile(path), path.string(), up);
}

namespace {

/// Require vectors in a facing goal. Only a file of goals may have names of directions.
void ExpectVectors(const JsonReader& facing) {
  for (const char* key : {"axis", "direction"}) {
    const JsonReader vector = facing.Member(key);
    if (!vector.IsArray()) vector.Fail("expected 3 numbers, found " + vector.Quoted());
  }
}

}  // namespace

std::vector<GoalMark> ReadGoalMarks(const JsonReader& json) {
  const std::vector<JsonReader> elements = json.Elements();
  if (elements.empty()) json.Fail("must not be empty");
  std::vector<GoalMark> marks;
  std::set<std::string> names;
  for (const JsonReader& element : elements) {
    if (element.Has("facing")) ExpectVectors(element.Member("facing"));
    GoalMark mark{element.Has("name") ? element.Member("name").Name() : "",
                  element.Member("step").Integer(0, std::numeric_limits<int>::max()),
                  ReadGoalSet(element, std::nullopt)};
    if (!marks.empty() && mark.step < marks.back().step) {
      element.Member("step").Fail("must not be less than the step of the previous goal, " +
                                  std::to_string(marks.back().step));
    }
    if (!mark.name.empty() && !names.insert(mark.name).second) {
      const JsonReader name = element.Member("name");
      name.Fail("must be unique, found " + name.Quoted() + " again");
    }
    marks.push_back(std::move(mark));
  }
  return marks;
}

Json GoalMarksJson(const std::vector<GoalMark>& marks) {
  Json json = Json::array();
  for (const GoalMark& mark : marks) {
    Json& element = json.emplace_back(Json::object());
    if (!mark.name.empty()) element["name"] = mark.name;
    element["step"] = mark.step;
    element.update(GoalSetJson(mark.set));
  }
  return json;
}

}  // namespace regrasp::plan
