#include "report/simulation_json.h"

#include <cmath>
#include <set>
#include <vector>

#include "planner/base/angle.h"
#include "report/json_values.h"
#include "sim/measure/push.h"
#include "sim/world/cone_margin.h"

namespace regrasp::report {
namespace {

Json MarginOf(const sim::FingerMargins& margins, FingerIndex finger) {
  const auto found = margins.find(finger);
  return found == margins.end() ? Json(nullptr) : Json(Degrees(found->second));
}

Json FingersJson(const sim::StepReplay& replay) {
  std::set<FingerIndex> fingers;
  for (const sim::FingerMargins* margins : {&replay.rest_margins, &replay.shake_margins}) {
    for (const auto& [finger, margin] : *margins) fingers.insert(finger);
  }
  Json json = Json::array();
  for (const FingerIndex finger : fingers) {
    json.push_back({{"finger", finger},
                    {"rest_margin_deg", MarginOf(replay.rest_margins, finger)},
                    {"shake_margin_deg", MarginOf(replay.shake_margins, finger)}});
  }
  return json;
}

Json MotionJson(const sim::StepMotion& motion) {
  const bool passes = motion.reason == plan::Reason::kNone;
  return {{"verdict", passes ? "pass" : "fail"},
          {"reason", TextOrNull(plan::ReasonName(motion.reason))},
          {"detail", TextOrNull(motion.detail)},
          {"displacement_m", motion.displacement_m},
          {"rotation_deg", motion.rotation_deg},
          {"motion_m", motion.moved_m},
          {"give_m", motion.give_m},
          {"slip_m", motion.slip_m},
          {"contact_lost", motion.contact_lost},
          {"shake_margin_deg", DegreesOrNull(sim::SmallestMargin(motion.shake_margins))}};
}

Json HandJson(const sim::HandMeasures& measures) {
  return {{"rest_displacement_m", measures.rest_off_m},
          {"rest_rotation_deg", Degrees(measures.rest_off_rad)},
          {"roll_m", measures.roll_m},
          {"torque_share", measures.torque_share},
          {"torque_Nm", measures.torque_Nm},
          {"control_limit_s", measures.control_limit_s},
          {"coupling_deg", Degrees(measures.coupling_rad)},
          {"tip_depth_m", measures.tip_depth_m},
          {"covered_depth_m", measures.covered_depth_m},
          {"simulated_s", measures.simulated_s}};
}

Json LimitsJson(const std::vector<sim::DriveLimits>& limits) {
  Json json = Json::array();
  for (const sim::DriveLimits& limit : limits) {
    json.push_back(
        {{"finger", int{limit.finger}},
         {"joint", limit.joint},
         {"actuator", limit.actuator},
         {"torque_Nm", std::isfinite(limit.torque_Nm) ? Json(limit.torque_Nm) : Json(nullptr)},
         {"control", OrNull(limit.control)},
         {"range_deg", {Degrees(limit.lower_rad), Degrees(limit.upper_rad)}}});
  }
  return json;
}

}  // namespace

const char* ProtocolName(sim::Protocol protocol) {
  switch (protocol) {
    case sim::Protocol::kAdapted:
      return "adapted";
    case sim::Protocol::kFixed:
      return "fixed";
    case sim::Protocol::kBoth:
      return "both";
  }
  return "";
}

const char* EngineName(sim::EngineChoice engine) {
  switch (engine) {
    case sim::EngineChoice::kMujoco:
      return "mujoco";
    case sim::EngineChoice::kOde:
      return "ode";
    case sim::EngineChoice::kBoth:
      return "both";
  }
  return "";
}

const char* SqueezeSourceName(sim::SqueezeSource source) {
  switch (source) {
    case sim::SqueezeSource::kShake:
      return "shake";
    case sim::SqueezeSource::kHand:
      return "hand";
    case sim::SqueezeSource::kTorques:
      return "torques";
    case sim::SqueezeSource::kGiven:
      return "option";
  }
  return "";
}

Json HandSettingsJson(const sim::HandReplaySettings& settings) {
  return {{"tolerance_m", settings.tolerance.length_m},
          {"tolerance_deg", Degrees(settings.tolerance.angle_rad)},
          {"tolerance_at_rest", settings.tolerance.at_rest},
          {"slip_m", settings.tolerance.slip_m},
          {"lost_s", settings.tolerance.lost_s},
          {"limit_s", settings.tolerance.limit_s},
          {"joint_deg", Degrees(settings.tolerance.joint_rad)},
          {"depth_m", settings.tolerance.depth_m},
          {"feedback", settings.feedback ? "pose" : "none"},
          {"tip", settings.tip == sim::TipShape::kBall ? "ball" : "geometry"},
          {"servo_stiffness_Nm_rad", {settings.least_stiffness, settings.largest_stiffness}},
          {"derived_servos", settings.derived_servos},
          {"limits", LimitsJson(settings.limits)}};
}

Json SimulationJson(const sim::StepReplay& replay) {
  Json json = {{"displacement_m", replay.displacement_m},
               {"rotation_deg", replay.rotation_deg},
               {"motion_m", replay.moved_m},
               {"slip_m", replay.slip_m},
               {"contact_lost", replay.contact_lost},
               {"cone_margin_deg",
                {{"motion", DegreesOrNull(sim::SmallestMargin(replay.motion_margins))},
                 {"rest", DegreesOrNull(sim::SmallestMargin(replay.rest_margins))},
                 {"shakes", DegreesOrNull(sim::SmallestMargin(replay.shake_margins))}}},
               {"fingers", FingersJson(replay)}};
  if (replay.hand) json["hand"] = HandJson(*replay.hand);
  return json;
}

Json ProtocolsJson(const sim::StepReplay& replay) {
  Json json = Json::object();
  if (replay.adapted) json["adapted"] = MotionJson(*replay.adapted);
  if (replay.fixed) json["fixed"] = MotionJson(*replay.fixed);
  return json;
}

Json StressJson(const std::vector<sim::DirectionStress>& stress) {
  Json json = Json::array();
  for (const sim::DirectionStress& direction : stress) {
    json.push_back({{"direction", sim::PushName(direction.push)},
                    {"replay", direction.replay},
                    {"analysis", direction.analysis}});
  }
  return json;
}

Json CauseJson(const std::optional<sim::Disagreement>& disagreement) {
  if (!disagreement) return nullptr;
  Json values = Json::object();
  for (const auto& [name, value] : disagreement->values) values[name] = value;
  return {{"between", std::string(sim::BetweenName(disagreement->between))},
          {"cause", std::string(sim::CauseName(disagreement->cause))},
          {"text", disagreement->text},
          {"values", values}};
}

Json EnginesJson(const sim::StepReplay& replay, const std::optional<sim::Disagreement>& between) {
  return {{"mujoco", MotionJson(replay)},
          {"ode", MotionJson(*replay.ode)},
          {"cause", CauseJson(between)}};
}

Json FingerNeedJson(FingerIndex finger, const grasp::FingerFriction& friction, double half_angle) {
  return {{"finger", finger},
          {"needed", friction.needed},
          {"required_half_angle_deg", Degrees(friction.required)},
          {"margin_deg", Degrees(half_angle - friction.required)},
          {"without_half_angle_deg", DegreesOrNull(friction.without)}};
}

}  // namespace regrasp::report
