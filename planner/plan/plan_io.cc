#include "planner/plan/plan_io.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/plan/json_reader.h"

namespace regrasp::plan {

namespace {

Switch ReadSwitch(const JsonReader& json, int dimension) {
  Switch step;
  step.place = ReadFingerGrasp(json.Member("place"), dimension);
  for (const JsonReader& finger : json.Member("release").Elements()) {
    step.release.push_back(ReadFinger(finger));
  }
  if (step.place.empty() && step.release.empty()) {
    json.Fail("a switch must place or release a finger");
  }
  if (json.Has("motion")) step.motion = ReadSwitchMotion(json.Member("motion"));
  return step;
}

/// Require one element per finger.
/// @param what  name in messages: "forces", "torques".
void ExpectOneAFinger(const JsonReader& json, const char* what, std::size_t found,
                      std::size_t fingers) {
  if (found == fingers) return;
  json.Fail("expected " + std::to_string(fingers) + " " + what + ", one per finger, found " +
            std::to_string(found));
}

/// Read the hand of a plan. The check of the hand rejects later states with other fingers.
HandUse ReadHand(const JsonReader& json, int fingers) {
  HandUse hand = ReadHandUse(json);
  ExpectOneAFinger(json.Member("initial").Member("joints"), "lists of joint angles",
                   hand.initial.joints.size(), static_cast<std::size_t>(fingers));
  return hand;
}

/// Require a torque per finger if a piece has any torques.
void ExpectTorques(const JsonReader& piece, const motion::MotionSegment& read,
                   std::size_t fingers) {
  if (read.start_torques.empty() && read.end_torques.empty()) return;
  ExpectOneAFinger(piece.Member("start_torques"), "torques", read.start_torques.size(), fingers);
  ExpectOneAFinger(piece.Member("end_torques"), "torques", read.end_torques.size(), fingers);
}

/// Return the elements of a list with one for each waypoint of a sliding step except the last.
/// @param what  name of the elements in messages.
std::vector<JsonReader> ElementsByWay(const JsonReader& json, const Align& step,
                                      const std::string& what) {
  std::vector<JsonReader> ways = json.Elements();
  if (ways.size() + 1 != step.waypoints.size()) {
    json.Fail("expected " + std::to_string(step.waypoints.size() - 1) + " lists of " + what +
              ", one for each waypoint except the last, found " + std::to_string(ways.size()));
  }
  return ways;
}

AlignCertificate ReadCertificate(const JsonReader& json, const Align& step, int dimension) {
  const std::vector<JsonReader> motions = ElementsByWay(json, step, "pieces");
  AlignCertificate certificate;
  for (std::size_t w = 0; w < motions.size(); ++w) {
    certificate.push_back(ReadMotionSegments(motions[w], dimension));
    const std::vector<JsonReader> pieces = motions[w].Elements();
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const motion::MotionSegment& piece = certificate.back()[k];
      const std::size_t fingers = step.waypoints[w].size();
      ExpectOneAFinger(pieces[k].Member("start"), "forces", piece.start.size(), fingers);
      ExpectOneAFinger(pieces[k].Member("end"), "forces", piece.end.size(), fingers);
      ExpectTorques(pieces[k], piece, fingers);
    }
  }
  return certificate;
}

Align ReadAlign(const JsonReader& json, int dimension) {
  Align step;
  for (const JsonReader& waypoint : json.Member("waypoints").Elements()) {
    step.waypoints.push_back(ReadFingerGrasp(waypoint.Member("contacts"), dimension));
  }
  if (step.waypoints.size() < 2) {
    json.Member("waypoints")
        .Fail("expected at least 2 waypoints, found " + std::to_string(step.waypoints.size()));
  }
  if (json.Has("certificate")) {
    step.certificate = ReadCertificate(json.Member("certificate"), step, dimension);
  }
  if (json.Has("motion")) {
    step.motion.emplace();
    for (const JsonReader& way : ElementsByWay(json.Member("motion"), step, "states")) {
      step.motion->push_back(ReadHandPath(way));
    }
  }
  return step;
}

Move ReadMove(const JsonReader& json, int dimension) {
  Move step{ReadHandPath(json.Member("path"))};
  if (!json.Has("contacts")) return step;
  for (const JsonReader& grasp : json.Member("contacts").Elements()) {
    step.contacts.push_back(ReadFingerGrasp(grasp, dimension));
  }
  if (step.contacts.size() != step.path.size()) {
    json.Member("contacts")
        .Fail("expected one grasp for each of the " + std::to_string(step.path.size()) +
              " states of the path, found " + std::to_string(step.contacts.size()));
  }
  return step;
}

Json MoveJson(const Move& step, int dimension) {
  Json json = {{"kind", "move"}, {"path", HandPathJson(step.path)}};
  if (step.contacts.empty()) return json;
  json["contacts"] = Json::array();
  for (const FingerGrasp& grasp : step.contacts) {
    json["contacts"].push_back(FingerGraspJson(grasp, dimension));
  }
  return json;
}

Step ReadStep(const JsonReader& json, int dimension) {
  const std::string kind = json.Member("kind").OneOf({"switch", "align", "move"});
  if (kind == "switch") return ReadSwitch(json, dimension);
  if (kind == "move") return ReadMove(json, dimension);
  return ReadAlign(json, dimension);
}

object::RepairRecord ReadRepair(const JsonReader& json) {
  object::RepairRecord repair;
  repair.sha256 = ReadSha256(json.Member("sha256"));
  repair.options.max_deviation = json.Member("max_deviation").Number();
  if (json.Has("facets")) {
    repair.options.facets = json.Member("facets").Integer(1, std::numeric_limits<int>::max());
  }
  if (json.Has("part")) {
    repair.options.part = json.Member("part").Integer(1, std::numeric_limits<int>::max());
  }
  if (json.Has("thickness")) repair.options.thickness = json.Member("thickness").Number();
  return repair;
}

Json RepairJson(const object::RepairRecord& repair) {
  Json json = {{"sha256", repair.sha256}, {"max_deviation", repair.options.max_deviation}};
  if (repair.options.facets) json["facets"] = *repair.options.facets;
  if (repair.options.part) json["part"] = *repair.options.part;
  if (repair.options.thickness) json["thickness"] = *repair.options.thickness;
  return json;
}

constexpr char kUnion[] = "union";
constexpr char kLargest[] = "largest";

object::Shells ReadShells(const JsonReader& json) {
  return json.OneOf({kUnion, kLargest}) == kUnion ? object::Shells::kUnion
                                                  : object::Shells::kLargest;
}

void ReadObjectPart(const JsonReader& json, Plan& plan) {
  plan.object_file = json.Member("file").String();
  if (plan.object_file.find('\0') != std::string::npos) {
    // Programs would read the name beyond the NUL character, the operating system would not.
    json.Member("file").Fail("must not contain a NUL character");
  }
  plan.object_sha256 = ReadSha256(json.Member("sha256"));
  plan.scale = json.Member("scale").Number();
  if (!(plan.scale > 0)) json.Member("scale").Fail("must be positive");
  plan.dimension = json.Member("dimension").Integer(2, 3);
  if (json.Has("repair")) plan.repair = ReadRepair(json.Member("repair"));
  if (json.Has("shells")) plan.shells = ReadShells(json.Member("shells"));
}

double ReadFrictionAngle(const JsonReader& json) {
  const double degrees = json.Number();
  if (!(degrees > 0 && degrees < 90)) {
    json.Fail("must be between 0 and 90, found " + json.Quoted());
  }
  const double angle = Radians(degrees);
  // A number near an end of the interval may round onto it, in radians or when written again.
  if (!(angle > 0 && angle < std::numbers::pi / 2 && Degrees(angle) < 90)) {
    json.Fail("too close to an end of (0, 90), found " + json.Quoted());
  }
  return angle;
}

/// Return degrees that read back as the same radians, if there are such.
/// They are round if possible: 20 instead of 19.999999999999996.
double WrittenDegrees(double radians) {
  constexpr double kRounding = 1e9;
  const double degrees = Degrees(radians);
  for (const double candidate : {std::round(degrees * kRounding) / kRounding, degrees,
                                 std::nextafter(degrees, 0.0), std::nextafter(degrees, 90.0)}) {
    if (Radians(candidate) == radians) return candidate;
  }
  return degrees;
}

double ReadRadius(const JsonReader& json) {
  const double radius = json.Number();
  if (!(radius > 0)) json.Fail("must be positive, found " + json.Quoted());
  return radius;
}

double ReadPatchRadius(const JsonReader& json, const Plan& plan) {
  if (plan.dimension == 2) json.Fail("cannot be used with a planar object");
  return ReadRadius(json);
}

double ReadTorsion(const JsonReader& json, const Plan& plan) {
  if (plan.dimension == 2) json.Fail("cannot be used with a planar object");
  return ReadRadius(json);
}

bool ReadContactPlaces(const JsonReader& json, const Plan& plan) {
  if (plan.dimension == 2) json.Fail("cannot be used with a planar object");
  return json.OneOf({"given"}) == "given";
}

RoadmapNote ReadRoadmapNote(const JsonReader& json) {
  RoadmapNote note;
  note.contacts = json.Member("contacts").Integer(1, std::numeric_limits<int>::max());
  note.clusters = json.Member("clusters").Integer(1, std::numeric_limits<int>::max());
  note.seed = json.Member("seed").Unsigned();
  note.start = json.Member("start").String();
  note.goal = json.Member("goal").String();
  if (json.Has("roughness_deg")) note.roughness = ReadFrictionAngle(json.Member("roughness_deg"));
  if (json.Has("invented")) {
    note.allow_filled = json.Member("invented").OneOf({"allowed"}) == "allowed";
  }
  return note;
}

Json RoadmapNoteJson(const RoadmapNote& note) {
  Json json = {{"contacts", note.contacts},
               {"clusters", note.clusters},
               {"seed", note.seed},
               {"start", note.start},
               {"goal", note.goal}};
  if (note.roughness) json["roughness_deg"] = WrittenDegrees(*note.roughness);
  if (note.allow_filled) json["invented"] = "allowed";
  return json;
}

Json SwitchJson(const Switch& step, int dimension) {
  Json json = Json::object();
  json["kind"] = "switch";
  json["place"] = FingerGraspJson(step.place, dimension);
  json["release"] = step.release;
  if (step.motion) json["motion"] = SwitchMotionJson(*step.motion);
  return json;
}

Json AlignJson(const Align& step, int dimension) {
  Json waypoints = Json::array();
  for (const FingerGrasp& waypoint : step.waypoints) {
    Json contacts = Json::object();
    contacts["contacts"] = FingerGraspJson(waypoint, dimension);
    waypoints.push_back(std::move(contacts));
  }
  Json json = Json::object();
  json["kind"] = "align";
  json["waypoints"] = std::move(waypoints);
  if (step.certificate) {
    json["certificate"] = Json::array();
    for (const motion::MotionSegments& pieces : *step.certificate) {
      json["certificate"].push_back(MotionSegmentsJson(pieces, dimension));
    }
  }
  if (step.motion) {
    json["motion"] = Json::array();
    for (const HandPath& path : *step.motion) json["motion"].push_back(HandPathJson(path));
  }
  return json;
}

Json StepJson(const Step& step, int dimension) {
  if (const auto* finger_switch = std::get_if<Switch>(&step)) {
    return SwitchJson(*finger_switch, dimension);
  }
  if (const auto* move = std::get_if<Move>(&step)) {
    return MoveJson(*move, dimension);
  }
  return AlignJson(std::get<Align>(step), dimension);
}

}  // namespace

Plan ParsePlan(std::string_view text, const std::string& name) {
  const Json json = ParseJson(text, name);
  const JsonReader root(json, name);
  root.ExpectFormat("regrasp-plan");
  Plan plan;
  ReadObjectPart(root.Member("object"), plan);
  plan.friction_angle = ReadFrictionAngle(root.Member("friction").Member("half_angle_deg"));
  plan.fingers = root.Member("fingers").Integer(1, kMostFingers);
  plan.planner = root.Member("planner").String();
  if (root.Has("finger_radius")) plan.finger_radius = ReadRadius(root.Member("finger_radius"));
  if (root.Has("torsion")) plan.torsion = ReadTorsion(root.Member("torsion"), plan);
  if (root.Has("patch_radius"))
    plan.patch_radius = ReadPatchRadius(root.Member("patch_radius"), plan);
  if (root.Has("contacts")) plan.at_given_points = ReadContactPlaces(root.Member("contacts"), plan);
  if (root.Has("roadmap")) plan.roadmap = ReadRoadmapNote(root.Member("roadmap"));
  if (root.Has("hand")) plan.hand = ReadHand(root.Member("hand"), plan.fingers);
  plan.initial = ReadFingerGrasp(root.Member("initial").Member("contacts"), plan.dimension);
  for (const JsonReader& step : root.Member("steps").Elements()) {
    plan.steps.push_back(ReadStep(step, plan.dimension));
  }
  if (!plan.hand && HasRolling(plan)) {
    root.Member("steps").Fail("contacts of an in-hand motion require the member hand of the plan");
  }
  if (plan.hand && !plan.hand->goals.empty() &&
      plan.hand->goals.back().step > std::ssize(plan.steps)) {
    root.Member("hand").Member("goals").Fail("a goal is marked after step " +
                                             std::to_string(plan.hand->goals.back().step) +
                                             ", the plan has " + std::to_string(plan.steps.size()));
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
  Json json = Json::object();
  json["format"] = "regrasp-plan";
  json["version"] = 1;
  json["object"] = {{"file", plan.object_file},
                    {"sha256", plan.object_sha256},
                    {"scale", plan.scale},
                    {"dimension", plan.dimension}};
  if (plan.repair) json["object"]["repair"] = RepairJson(*plan.repair);
  if (plan.shells) {
    json["object"]["shells"] = *plan.shells == object::Shells::kUnion ? kUnion : kLargest;
  }
  json["friction"]["half_angle_deg"] = WrittenDegrees(plan.friction_angle);
  json["fingers"] = plan.fingers;
  json["planner"] = plan.planner;
  if (plan.finger_radius) json["finger_radius"] = *plan.finger_radius;
  if (plan.torsion > 0) json["torsion"] = plan.torsion;
  if (plan.patch_radius) json["patch_radius"] = *plan.patch_radius;
  if (plan.at_given_points) json["contacts"] = "given";
  if (plan.roadmap) json["roadmap"] = RoadmapNoteJson(*plan.roadmap);
  if (plan.hand) json["hand"] = HandUseJson(*plan.hand);
  json["initial"]["contacts"] = FingerGraspJson(plan.initial, plan.dimension);
  json["steps"] = Json::array();
  for (const Step& step : plan.steps) json["steps"].push_back(StepJson(step, plan.dimension));
  json["goal"]["contacts"] = GraspJson(plan.goal, plan.dimension);
  return FormatJson(json);
}

}  // namespace regrasp::plan
