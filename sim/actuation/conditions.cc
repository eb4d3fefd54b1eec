#include "sim/actuation/conditions.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>

#include "planner/base/number.h"
#include "planner/plan/json_reader.h"

namespace regrasp::sim {
namespace {

using plan::JsonReader;

constexpr double kMillimetre = 1e-3;
/// Largest error of a length, millimetres, and of an angle, degrees.
constexpr double kMostError_mm = 1000;
constexpr double kMostError_deg = 180;
constexpr double kMostFactor = 100;
constexpr double kMostDelay_s = 10;

/// Largest number of conditions of a file: each one is a replay of the whole plan and a row of the
/// report.
constexpr std::size_t kMostConditions = 1000;

/// Return a number in [lower, upper].
double Bounded(const JsonReader& json, double lower, double upper) {
  const double number = json.Number();
  if (!(number >= lower && number <= upper)) {
    json.Fail("expected a number from " + FormatShort(lower) + " to " + FormatShort(upper) +
              ", found " + json.Quoted());
  }
  return number;
}

double Factor(const JsonReader& json) { return Bounded(json, 1 / kMostFactor, kMostFactor); }
double Metres(const JsonReader& json) { return kMillimetre * Bounded(json, 0, kMostError_mm); }
double Angle(const JsonReader& json) { return Radians(Bounded(json, 0, kMostError_deg)); }

Eigen::Vector3d BoundedVector(const JsonReader& json, double most) {
  for (const JsonReader& element : json.Elements()) {
    static_cast<void>(Bounded(element, -most, most));
  }
  return json.Vector(3);
}

/// A member of a condition.
struct ConditionField {
  const char* key;
  /// Set the option. @throws InputError  if the value is invalid.
  void (*set)(const JsonReader& json, HandReplayOptions& options);
};

constexpr std::array kConditionFields = std::to_array<ConditionField>({
    {"friction_factor", [](const JsonReader& j, auto& o) { o.friction_factor *= Factor(j); }},
    {"mass_factor", [](const JsonReader& j, auto& o) { o.mass_factor *= Factor(j); }},
    {"feedback",
     [](const JsonReader& j, auto& o) {
       o.sensing.feedback =
           j.OneOf({"pose", "none"}) == "pose" ? PoseFeedback::kPose : PoseFeedback::kNone;
     }},
    {"pose_delay_s",
     [](const JsonReader& j, auto& o) { o.sensing.pose_delay_s = Bounded(j, 0, kMostDelay_s); }},
    {"pose_rate_Hz",
     [](const JsonReader& j, auto& o) { o.sensing.pose_rate_Hz = Bounded(j, 0.1, 1e4); }},
    {"pose_noise_mm", [](const JsonReader& j, auto& o) { o.sensing.pose_noise_m = Metres(j); }},
    {"pose_noise_deg", [](const JsonReader& j, auto& o) { o.sensing.pose_noise_rad = Angle(j); }},
    {"pose_bias_mm", [](const JsonReader& j, auto& o) { o.sensing.pose_bias_m = Metres(j); }},
    {"pose_bias_deg", [](const JsonReader& j, auto& o) { o.sensing.pose_bias_rad = Angle(j); }},
    {"joint_bias_deg", [](const JsonReader& j, auto& o) { o.sensing.joint_bias_rad = Angle(j); }},
    {"touch_N", [](const JsonReader& j, auto& o) { o.sensing.touch_N = Bounded(j, 0, 1e3); }},
    {"command_delay_s",
     [](const JsonReader& j, auto& o) { o.sensing.command_delay_s = Bounded(j, 0, kMostDelay_s); }},
    {"seed", [](const JsonReader& j, auto& o) { o.sensing.seed = j.Unsigned(); }},
    {"timestep_s",
     [](const JsonReader& j, auto& o) { o.physics.timestep_s = Bounded(j, 5e-5, 2e-2); }},
    {"cones",
     [](const JsonReader& j, auto& o) {
       o.physics.pyramidal_cones = j.OneOf({"elliptic", "pyramidal"}) == "pyramidal";
     }},
    {"contacts",
     [](const JsonReader& j, auto& o) {
       o.physics.contacts = j.OneOf({"stiff", "default"}) == "stiff" ? TipContactModel::kStiff
                                                                     : TipContactModel::kDefault;
     }},
    {"torsion_mm", [](const JsonReader& j, auto& o) { o.physics.torsion_m = Metres(j); }},
    {"gain_factor", [](const JsonReader& j, auto& o) { o.physics.gain_factor = Factor(j); }},
    {"joint_friction_Nm",
     [](const JsonReader& j, auto& o) { o.physics.joint_friction_Nm = Bounded(j, 0, 1e3); }},
    {"start_shift_mm",
     [](const JsonReader& j, auto& o) {
       o.start_shift_m = kMillimetre * BoundedVector(j, kMostError_mm);
     }},
    {"start_turn_deg",
     [](const JsonReader& j, auto& o) {
       o.start_turn_rad = Radians(1) * BoundedVector(j, kMostError_deg);
     }},
    {"fingertip",
     [](const JsonReader& j, auto& o) {
       o.tip = j.OneOf({"sphere", "geometry"}) == "sphere" ? TipShape::kBall : TipShape::kGeometry;
     }},
});

constexpr char kNameKey[] = "name";

void Apply(const JsonReader& json, const Json& changes, HandReplayOptions& options) {
  for (const ConditionField& field : kConditionFields) {
    if (changes.contains(field.key)) field.set(json.Member(field.key), options);
  }
}

void CheckMembers(const JsonReader& json, const Json& condition) {
  for (const auto& [key, value] : condition.items()) {
    const bool known =
        key == kNameKey || std::ranges::any_of(kConditionFields, [&](const ConditionField& field) {
          return key == field.key;
        });
    if (!known) json.Fail("member \"" + key + "\" not supported");
  }
}

std::string ReadConditionName(const JsonReader& json, std::set<std::string>& names) {
  const JsonReader name = json.Member(kNameKey);
  const std::string text = name.Name();
  if (text.empty()) name.Fail("expected a name, found an empty one");
  if (!names.insert(text).second) name.Fail("must be unique, found twice: " + name.Quoted());
  return text;
}

/// The standard conditions. Sizes and their sources are in docs/conditions.md.
constexpr char kStandardText[] = R"([
  {"name": "friction-minus-10", "friction_factor": 0.9},
  {"name": "friction-minus-20", "friction_factor": 0.8},
  {"name": "friction-plus-10", "friction_factor": 1.1},
  {"name": "mass-minus-10", "mass_factor": 0.9},
  {"name": "mass-plus-10", "mass_factor": 1.1},
  {"name": "mass-plus-25", "mass_factor": 1.25},
  {"name": "gain-minus-20", "gain_factor": 0.8},
  {"name": "gain-plus-20", "gain_factor": 1.2},
  {"name": "latency-10ms", "command_delay_s": 0.01},
  {"name": "latency-20ms", "command_delay_s": 0.02},
  {"name": "pose-exact", "feedback": "pose", "pose_delay_s": 0, "pose_rate_Hz": 100,
   "pose_noise_mm": 0, "pose_noise_deg": 0, "pose_bias_mm": 0, "pose_bias_deg": 0},
  {"name": "pose-30ms", "feedback": "pose", "pose_delay_s": 0.03, "pose_rate_Hz": 100,
   "pose_noise_mm": 0, "pose_noise_deg": 0, "pose_bias_mm": 0, "pose_bias_deg": 0},
  {"name": "camera", "feedback": "pose", "pose_delay_s": 0.05, "pose_rate_Hz": 30,
   "pose_noise_mm": 0.3, "pose_noise_deg": 0.3, "pose_bias_mm": 0, "pose_bias_deg": 0},
  {"name": "blind", "feedback": "none"},
  {"name": "realistic", "feedback": "pose", "pose_delay_s": 0.05, "pose_rate_Hz": 30,
   "pose_noise_mm": 0.3, "pose_noise_deg": 0.3, "pose_bias_mm": 0.6, "pose_bias_deg": 0.6,
   "joint_bias_deg": 0.5, "command_delay_s": 0.01, "friction_factor": 0.9, "mass_factor": 1.1,
   "touch_N": 0.3, "joint_friction_Nm": 0.01, "gain_factor": 0.9},
  {"name": "timestep-0.5ms", "timestep_s": 0.0005},
  {"name": "timestep-2ms", "timestep_s": 0.002},
  {"name": "pyramidal-cones", "cones": "pyramidal"},
  {"name": "default-contacts", "contacts": "default"},
  {"name": "torsion-5mm", "torsion_mm": 5},
  {"name": "start-off", "start_shift_mm": [0.577, 0.577, 0.577],
   "start_turn_deg": [1.155, -1.155, 1.155]},
  {"name": "joints-0.5deg", "joint_bias_deg": 0.5},
  {"name": "joints-1deg", "joint_bias_deg": 1},
  {"name": "joint-friction", "joint_friction_Nm": 0.03},
  {"name": "touch-0.3N", "touch_N": 0.3},
  {"name": "fingertip-geometry", "fingertip": "geometry"}
])";

}  // namespace

std::vector<HandCondition> ReadConditions(std::string_view text, const std::string& file) {
  const Json list = ParseJson(text, file);
  const JsonReader reader(list, file);
  std::vector<HandCondition> conditions;
  std::set<std::string> names;
  const std::vector<JsonReader> elements = reader.Elements();
  if (elements.empty()) reader.Fail("expected at least one condition, found an empty array");
  if (elements.size() > kMostConditions) {
    reader.Fail("expected at most " + std::to_string(kMostConditions) + " conditions, found " +
                std::to_string(elements.size()));
  }
  for (std::size_t i = 0; i < elements.size(); ++i) {
    HandCondition& condition = conditions.emplace_back();
    condition.name = ReadConditionName(elements[i], names);
    CheckMembers(elements[i], list[i]);
    HandReplayOptions checked;
    Apply(elements[i], list[i], checked);
    Json changes = list[i];
    changes.erase(kNameKey);
    condition.changes = changes.dump();
  }
  return conditions;
}

const std::vector<HandCondition>& StandardConditions() {
  static const std::vector<HandCondition> conditions =
      ReadConditions(kStandardText, "standard conditions");
  return conditions;
}

HandReplayOptions OptionsUnder(const HandCondition& condition, const HandReplayOptions& nominal) {
  HandReplayOptions options = nominal;
  options.disturbance_ratio = 0;
  options.freeze_s = 0;
  options.to_end = true;
  // With two engines MuJoCo decides.
  if (nominal.engine == EngineChoice::kBoth) options.engine = EngineChoice::kMujoco;
  const Json changes = ParseJson(condition.changes, condition.name);
  Apply({changes, condition.name}, changes, options);
  return options;
}

}  // namespace regrasp::sim
