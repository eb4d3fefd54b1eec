#include "planner/kinematics/hand_description.h"

#include <cmath>

#include "planner/base/json.h"
#include "planner/plan/json_reader.h"

namespace regrasp::kinematics {
namespace {

using plan::JsonReader;

constexpr char kFormat[] = "regrasp-hand";
/// Smallest number of fingers, because a grasp requires three contacts.
constexpr std::size_t kFewestFingers = 3;
constexpr double kLargestRadius = 0.1;

std::string NonEmpty(const JsonReader& json) {
  std::string text = json.String();
  if (text.empty()) json.Fail("expected a name, found an empty one");
  return text;
}

Eigen::Vector3d Direction(const JsonReader& json) {
  const Eigen::Vector3d vector = json.Vector(3);
  if (!(vector.norm() > 1e-6)) json.Fail("expected a direction, found " + json.Quoted());
  return vector.normalized();
}

HandDescription::Tip ParseTip(const JsonReader& json) {
  const JsonReader tip = json.Member("tip");
  HandDescription::Tip parsed{NonEmpty(json.Member("name")), NonEmpty(tip.Member("body")),
                              tip.Member("centre").Vector(3), tip.Member("radius").Number()};
  if (!(parsed.radius > 0) || parsed.radius > kLargestRadius) {
    tip.Member("radius").Fail("expected metres in (0, 0.1], found " +
                              tip.Member("radius").Quoted());
  }
  return parsed;
}

HandDescription::Coupling ParseCoupling(const JsonReader& json) {
  HandDescription::Coupling parsed{NonEmpty(json.Member("joint")), NonEmpty(json.Member("follows")),
                                   json.Member("ratio").Number()};
  if (json.Has("offset")) parsed.offset = json.Member("offset").Number();
  if (parsed.ratio == 0) json.Member("ratio").Fail("expected a number other than 0");
  return parsed;
}

void ExpectDifferent(const std::vector<HandDescription::Tip>& tips, const JsonReader& json) {
  for (std::size_t i = 0; i < tips.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (tips[i].name == tips[j].name) json.Fail("two fingers have the name " + tips[i].name);
      if (tips[i].body == tips[j].body) {
        json.Fail("fingers " + tips[j].name + " and " + tips[i].name + " have the same tip, " +
                  tips[i].body);
      }
    }
  }
}

}  // namespace

HandDescription ParseHandDescription(std::string_view text, const std::string& name) {
  const Json value = ParseJson(text, name);
  const JsonReader json(value, name);
  json.ExpectFormat(kFormat);
  HandDescription description;
  description.name = NonEmpty(json.Member("name"));
  description.model = NonEmpty(json.Member("model"));
  description.palm = NonEmpty(json.Member("palm"));
  description.up = Direction(json.Member("up"));
  const JsonReader fingers = json.Member("fingers");
  for (const JsonReader& finger : fingers.Elements()) description.tips.push_back(ParseTip(finger));
  if (description.tips.size() < kFewestFingers) {
    fingers.Fail("expected at least 3 fingers, found " + std::to_string(description.tips.size()));
  }
  ExpectDifferent(description.tips, fingers);
  if (json.Has("couplings")) {
    for (const JsonReader& coupling : json.Member("couplings").Elements()) {
      description.couplings.push_back(ParseCoupling(coupling));
    }
  }
  return description;
}

std::string FormatHandDescription(const HandDescription& description) {
  Json json = {{"format", kFormat},        {"version", 1},
               {"name", description.name}, {"model", description.model},
               {"palm", description.palm}, {"up", plan::VectorJson(description.up, 3)},
               {"fingers", Json::array()}};
  for (const HandDescription::Tip& tip : description.tips) {
    json["fingers"].push_back({{"name", tip.name},
                               {"tip",
                                {{"body", tip.body},
                                 {"centre", plan::VectorJson(tip.centre, 3)},
                                 {"radius", tip.radius}}}});
  }
  if (!description.couplings.empty()) {
    json["couplings"] = Json::array();
    for (const HandDescription::Coupling& coupling : description.couplings) {
      Json written = {
          {"joint", coupling.joint}, {"follows", coupling.follows}, {"ratio", coupling.ratio}};
      if (coupling.offset != 0) written["offset"] = coupling.offset;
      json["couplings"].push_back(std::move(written));
    }
  }
  return FormatJson(json);
}

}  // namespace regrasp::kinematics
