#include "report/simulation_json.h"

#include <set>

#include "planner/base/angle.h"

namespace regrasp {
namespace {

Json DegreesOrNull(const std::optional<double>& angle) {
  return angle ? Json(Degrees(*angle)) : Json(nullptr);
}

Json MarginOf(const FingerMargins& margins, int finger) {
  const auto found = margins.find(finger);
  return found == margins.end() ? Json(nullptr) : Json(Degrees(found->second));
}

/// An empty text is null.
Json TextOrNull(std::string_view text) {
  return text.empty() ? Json(nullptr) : Json(std::string(text));
}

Json FingersJson(const StepReplay& replay) {
  std::set<int> fingers;
  for (const FingerMargins* margins : {&replay.rest_margins, &replay.shake_margins}) {
    for (const auto& [finger, margin] : *margins) fingers.insert(finger);
  }
  Json json = Json::array();
  for (const int finger : fingers) {
    json.push_back({{"finger", finger},
                    {"rest_margin_deg", MarginOf(replay.rest_margins, finger)},
                    {"shake_margin_deg", MarginOf(replay.shake_margins, finger)}});
  }
  return json;
}

Json MotionJson(const StepMotion& motion) {
  const bool passes = motion.reason == Reason::kNone;
  return {{"verdict", passes ? "pass" : "fail"},
          {"reason", TextOrNull(ReasonName(motion.reason))},
          {"detail", TextOrNull(motion.detail)},
          {"displacement_m", motion.displacement_m},
          {"rotation_deg", motion.rotation_deg},
          {"motion_m", motion.moved_m},
          {"give_m", motion.give_m},
          {"slip_m", motion.slip_m},
          {"contact_lost", motion.contact_lost},
          {"shake_margin_deg", DegreesOrNull(SmallestMargin(motion.shake_margins))}};
}

}  // namespace

const char* ProtocolName(Protocol protocol) {
  switch (protocol) {
    case Protocol::kAdapted:
      return "adapted";
    case Protocol::kFixed:
      return "fixed";
    case Protocol::kBoth:
      return "both";
  }
  return "";
}

Json SimulationJson(const StepReplay& replay) {
  return {{"displacement_m", replay.displacement_m},
          {"rotation_deg", replay.rotation_deg},
          {"motion_m", replay.moved_m},
          {"slip_m", replay.slip_m},
          {"contact_lost", replay.contact_lost},
          {"cone_margin_deg",
           {{"motion", DegreesOrNull(SmallestMargin(replay.motion_margins))},
            {"rest", DegreesOrNull(SmallestMargin(replay.rest_margins))},
            {"shakes", DegreesOrNull(SmallestMargin(replay.shake_margins))}}},
          {"fingers", FingersJson(replay)}};
}

Json ProtocolsJson(const StepReplay& replay) {
  Json json = Json::object();
  if (replay.adapted) json["adapted"] = MotionJson(*replay.adapted);
  if (replay.fixed) json["fixed"] = MotionJson(*replay.fixed);
  return json;
}

Json StressJson(const std::vector<DirectionStress>& stress) {
  Json json = Json::array();
  for (const DirectionStress& direction : stress) {
    json.push_back({{"direction", PushName(direction.push)},
                    {"replay", direction.replay},
                    {"analysis", direction.analysis}});
  }
  return json;
}

Json CauseJson(const std::optional<Disagreement>& disagreement) {
  if (!disagreement) return nullptr;
  Json values = Json::object();
  for (const auto& [name, value] : disagreement->values) values[name] = value;
  return {{"between", std::string(BetweenName(disagreement->between))},
          {"cause", std::string(CauseName(disagreement->cause))},
          {"text", disagreement->text},
          {"values", values}};
}

Json FingerNeedJson(int finger, const FingerFriction& friction, double half_angle) {
  return {{"finger", finger},
          {"needed", friction.needed},
          {"required_half_angle_deg", Degrees(friction.required)},
          {"margin_deg", Degrees(half_angle - friction.required)},
          {"without_half_angle_deg", DegreesOrNull(friction.without)}};
}

}  // namespace regrasp
