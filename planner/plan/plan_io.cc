#include "planner/plan/plan_io.h"

#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/plan/json_reader.h"
#include "planner/plan/tolerance.h"

namespace regrasp {

namespace {

/// More fingers than any hand has; a file that claims more is not a plan.
constexpr int kMostFingers = 64;
/// Contacts and steps are small numbers; finger numbers outside the hand are left to the checker.
constexpr int kLargestFingerNumber = 1'000'000;

Contact ReadContact(const JsonReader& json, int dimension) {
  return {json.Member("point").Vector(dimension), json.Member("normal").Vector(dimension)};
}

FingerGrasp ReadFingerGrasp(const JsonReader& json, int dimension) {
  FingerGrasp grasp;
  for (const JsonReader& element : json.Elements()) {
    grasp.push_back({element.Member("finger").Integer(0, kLargestFingerNumber),
                     ReadContact(element, dimension)});
  }
  return grasp;
}

Switch ReadSwitch(const JsonReader& json, int dimension) {
  Switch step;
  step.place = ReadFingerGrasp(json.Member("place"), dimension);
  for (const JsonReader& finger : json.Member("release").Elements()) {
    step.release.push_back(finger.Integer(0, kLargestFingerNumber));
  }
  if (step.place.empty() && step.release.empty()) json.Fail("a switch that does nothing");
  return step;
}

Align ReadAlign(const JsonReader& json, int dimension) {
  Align step;
  for (const JsonReader& waypoint : json.Member("waypoints").Elements()) {
    step.waypoints.push_back(ReadFingerGrasp(waypoint.Member("contacts"), dimension));
  }
  if (step.waypoints.empty()) json.Member("waypoints").Fail("an align needs a waypoint");
  return step;
}

Step ReadStep(const JsonReader& json, int dimension) {
  const std::string kind = json.Member("kind").String();
  if (kind == "switch") return ReadSwitch(json, dimension);
  if (kind == "align") return ReadAlign(json, dimension);
  json.Member("kind").Fail("expected \"switch\" or \"align\", found \"" + kind + "\"");
}

Json ContactJson(const Contact& contact, int dimension) {
  Json json = Json::object();
  json["point"] = VectorJson(contact.p, dimension);
  json["normal"] = VectorJson(contact.n, dimension);
  return json;
}

Json FingerGraspJson(const FingerGrasp& grasp, int dimension) {
  Json json = Json::array();
  for (const FingerContact& held : grasp) {
    Json contact = Json::object();
    contact["finger"] = held.finger;
    contact.update(ContactJson(held.contact, dimension));
    json.push_back(contact);
  }
  return json;
}

Json GraspJson(const Grasp& grasp, int dimension) {
  Json json = Json::array();
  for (const Contact& contact : grasp) json.push_back(ContactJson(contact, dimension));
  return json;
}

Json StepJson(const Step& step, int dimension) {
  Json json = Json::object();
  json["kind"] = StepKind(step);
  if (const auto* finger_switch = std::get_if<Switch>(&step)) {
    json["place"] = FingerGraspJson(finger_switch->place, dimension);
    json["release"] = finger_switch->release;
    return json;
  }
  Json waypoints = Json::array();
  for (const FingerGrasp& waypoint : std::get<Align>(step).waypoints) {
    waypoints.push_back({{"contacts", FingerGraspJson(waypoint, dimension)}});
  }
  json["waypoints"] = waypoints;
  return json;
}

/// The face that a contact of a grasp file lies on. Tolerances are those of docs/formats.md.
int FaceOf(const JsonReader& json, const Object& object, const Eigen::Vector3d& point,
           const Eigen::Vector3d* normal) {
  const double tolerance = kPointTolerance * object.diameter();
  const std::vector<int> faces = object.FacesNear(point, tolerance);
  if (faces.empty()) {
    json.Member("point").Fail("farther than " + FormatShort(tolerance) +
                              " from the surface of the object");
  }
  if (normal == nullptr) {
    if (faces.size() > 1) json.Fail("on a border of faces the normal cannot be left out");
    return faces.front();
  }
  if (std::abs(normal->norm() - 1) > kNormalLengthTolerance) {
    json.Member("normal").Fail("not of unit length, but " + FormatShort(normal->norm()));
  }
  for (const int face : faces) {
    if (AngleBetween(*normal, object.inward_normal(face)) <= kNormalTolerance) return face;
  }
  json.Member("normal").Fail(
      "differs by " +
      FormatShort(Degrees(AngleBetween(*normal, object.inward_normal(faces.front())))) +
      " degrees from the inward normal of the surface there");
}

}  // namespace

Plan ParsePlan(std::string_view text, const std::string& name) {
  const Json json = ParseJson(text, name);
  const JsonReader root(json, name);
  root.ExpectFormat("regrasp-plan");
  Plan plan;
  const JsonReader object = root.Member("object");
  plan.object_file = object.Member("file").String();
  plan.object_sha256 = object.Member("sha256").String();
  plan.scale = object.Member("scale").Number();
  if (!(plan.scale > 0)) object.Member("scale").Fail("must be positive");
  plan.dimension = object.Member("dimension").Integer(2, 3);
  const JsonReader angle = root.Member("friction").Member("half_angle_deg");
  plan.half_angle = Radians(angle.Number());
  if (!(angle.Number() > 0 && angle.Number() < 90)) angle.Fail("must lie between 0 and 90");
  plan.fingers = root.Member("fingers").Integer(1, kMostFingers);
  plan.planner = root.Member("planner").String();
  plan.initial = ReadFingerGrasp(root.Member("initial").Member("contacts"), plan.dimension);
  for (const JsonReader& step : root.Member("steps").Elements()) {
    plan.steps.push_back(ReadStep(step, plan.dimension));
  }
  for (const JsonReader& contact : root.Member("goal").Member("contacts").Elements()) {
    plan.goal.push_back(ReadContact(contact, plan.dimension));
  }
  return plan;
}

Plan ReadPlan(const std::filesystem::path& path) {
  return ParsePlan(ReadFile(path), path.string());
}

std::string FormatPlan(const Plan& plan) {
  Json steps = Json::array();
  for (const Step& step : plan.steps) steps.push_back(StepJson(step, plan.dimension));
  Json json = Json::object();
  json["format"] = "regrasp-plan";
  json["version"] = 1;
  json["object"] = {{"file", plan.object_file},
                    {"sha256", plan.object_sha256},
                    {"scale", plan.scale},
                    {"dimension", plan.dimension}};
  json["friction"] = {{"half_angle_deg", Degrees(plan.half_angle)}};
  json["fingers"] = plan.fingers;
  json["planner"] = plan.planner;
  json["initial"] = {{"contacts", FingerGraspJson(plan.initial, plan.dimension)}};
  json["steps"] = steps;
  json["goal"] = {{"contacts", GraspJson(plan.goal, plan.dimension)}};
  return FormatJson(json);
}

Grasp ParseGrasp(std::string_view text, const std::string& name, const Object& object) {
  const Json json = ParseJson(text, name);
  const JsonReader root(json, name);
  root.ExpectFormat("regrasp-grasp");
  Grasp grasp;
  for (const JsonReader& element : root.Member("contacts").Elements()) {
    const Eigen::Vector3d point = element.Member("point").Vector(object.dimension());
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const bool has_normal = element.Has("normal");
    if (has_normal) normal = element.Member("normal").Vector(object.dimension());
    const int face = FaceOf(element, object, point, has_normal ? &normal : nullptr);
    grasp.push_back({object.ClosestPoint(face, point), object.inward_normal(face), face});
  }
  if (grasp.empty()) root.Member("contacts").Fail("a grasp needs a contact");
  return grasp;
}

Grasp ReadGrasp(const std::filesystem::path& path, const Object& object) {
  return ParseGrasp(ReadFile(path), path.string(), object);
}

std::string FormatGrasp(const Grasp& grasp, int dimension) {
  Json json = Json::object();
  json["format"] = "regrasp-grasp";
  json["version"] = 1;
  json["contacts"] = GraspJson(grasp, dimension);
  return FormatJson(json);
}

}  // namespace regrasp
