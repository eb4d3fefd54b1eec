#include "sim/hand_grasps/hand_grasp.h"

#include <cmath>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/plan/json_reader.h"

namespace regrasp::sim {
namespace {

using plan::JsonReader;

constexpr char kGraspFormat[] = "regrasp-hand-grasp";
/// Largest difference of a quaternion's length from 1. Data sets store float32.
constexpr double kUnitTolerance = 1e-3;
constexpr std::size_t kMostNameBytes = 1000;

std::string Name(const JsonReader& json) {
  std::string text = json.String();
  if (text.empty()) json.Fail("must not be empty");
  if (text.size() > kMostNameBytes) {
    json.Fail("too long, expected at most " + std::to_string(kMostNameBytes) + " bytes, found " +
              std::to_string(text.size()));
  }
  return text;
}

Eigen::Quaterniond ReadQuaternion(const JsonReader& json) {
  std::vector<double> values;
  for (const JsonReader& element : json.Elements()) values.push_back(element.Number());
  if (values.size() != 4) {
    json.Fail("expected 4 numbers w, x, y, z, found " + std::to_string(values.size()));
  }
  const Eigen::Quaterniond quaternion(values[0], values[1], values[2], values[3]);
  const double length = quaternion.norm();
  if (!(std::abs(length - 1) <= kUnitTolerance)) {
    json.Fail("must be a unit quaternion w, x, y, z, found length " + FormatShort(length));
  }
  return quaternion.normalized();
}

Eigen::Isometry3d ReadPalm(const JsonReader& json) {
  json.ExpectOnly({"position", "quaternion"});
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = json.Member("position").Vector(3);
  pose.linear() = ReadQuaternion(json.Member("quaternion")).toRotationMatrix();
  return pose;
}

/// Read joints into a map that may have values.
void ReadJoints(const Json& value, const JsonReader& json, std::map<std::string, double>& joints) {
  if (!value.is_object()) json.Fail("expected an object with a number by joint name");
  for (const auto& [joint, unused] : value.items()) {
    joints[joint] = json.Member(joint.c_str()).Number();
  }
}

std::optional<HandConfiguration> ReadConfiguration(const Json& value, const JsonReader& line,
                                                   const char* key,
                                                   const HandConfiguration& grasp) {
  if (!line.Has(key)) return std::nullopt;
  const JsonReader json = line.Member(key);
  if (!value[key].is_object()) json.Fail("expected an object with palm, joints or both");
  json.ExpectOnly({"palm", "joints"});
  HandConfiguration configuration = grasp;
  if (json.Has("palm")) configuration.palm = ReadPalm(json.Member("palm"));
  if (json.Has("joints")) {
    ReadJoints(value[key]["joints"], json.Member("joints"), configuration.joints);
  }
  return configuration;
}

}  // namespace

HandGrasp ParseHandGrasp(std::string_view text, const std::string& name) {
  const Json value = ParseJson(text, name);
  const JsonReader json(value, name);
  json.ExpectFormat(kGraspFormat);
  json.ExpectOnly({"format", "version", "id", "set", "object", "palm", "joints", "pregrasp",
                   "target", "closing", "claimed", "score"});
  HandGrasp grasp;
  grasp.id = Name(json.Member("id"));
  if (json.Has("set")) grasp.set = Name(json.Member("set"));
  const JsonReader object = json.Member("object");
  object.ExpectOnly({"file", "scale"});
  grasp.object_file = Name(object.Member("file"));
  if (object.Has("scale")) grasp.scale = object.Member("scale").Number();
  if (!(grasp.scale > 0)) {
    object.Member("scale").Fail("must be above 0, found " + FormatShort(grasp.scale));
  }
  grasp.grasp.palm = ReadPalm(json.Member("palm"));
  const JsonReader joints = json.Member("joints");
  ReadJoints(value["joints"], joints, grasp.grasp.joints);
  grasp.pregrasp = ReadConfiguration(value, json, "pregrasp", grasp.grasp);
  grasp.target = ReadConfiguration(value, json, "target", grasp.grasp);
  if (json.Has("closing")) {
    if (grasp.target) json.Member("closing").Fail("cannot be used with target");
    ReadJoints(value["closing"], json.Member("closing"), grasp.closing);
  }
  if (json.Has("claimed")) {
    if (!value["claimed"].is_boolean()) json.Member("claimed").Fail("expected true or false");
    grasp.claimed = value["claimed"].get<bool>();
  }
  if (json.Has("score")) grasp.score = json.Member("score").Number();
  return grasp;
}

}  // namespace regrasp::sim
