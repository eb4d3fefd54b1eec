#include "sim/actuation/format_reset_states.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "planner/base/npz.h"
#include "planner/plan/reason.h"
#include "sim/scene/scaling.h"

namespace regrasp::sim {
namespace {

using Values = std::vector<double>;

void AppendVector(const Eigen::VectorXd& vector, Values& values) {
  values.insert(values.end(), vector.begin(), vector.end());
}

/// An array with a row for each state.
/// @param shape   of a row.
/// @param append  a state's row to values.
template <typename AppendRow>
NpzArray RowsOf(const DrawnStates& drawn, const std::string& name, std::vector<std::size_t> shape,
                const AppendRow& append) {
  shape.insert(shape.begin(), drawn.states.size());
  NpzArray array{name, std::move(shape)};
  for (const ResetState& state : drawn.states) append(state, array.values);
  return array;
}

/// The same, with a row in it for each finger.
template <typename AppendTip>
NpzArray TipsOf(const DrawnStates& drawn, const std::string& name, std::vector<std::size_t> shape,
                const AppendTip& append) {
  return RowsOf(drawn, name, std::move(shape), [&](const ResetState& state, Values& values) {
    for (const ResetState::Tip& tip : state.tips) append(tip, values);
  });
}

/// Of fingers that hold; the others have none.
NpzArray VectorsOf(const DrawnStates& drawn, const std::string& name, std::size_t fingers,
                   Eigen::Vector3d ResetState::Tip::*vector) {
  const Eigen::Vector3d none = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return TipsOf(drawn, name, {fingers, 3}, [&](const ResetState::Tip& tip, Values& values) {
    AppendVector(tip.holds ? tip.*vector : none, values);
  });
}

NpzArray ListsOf(const DrawnStates& drawn, const std::string& name,
                 std::vector<double> ResetState::*list) {
  const std::size_t length = drawn.states.empty() ? 0 : (drawn.states.front().*list).size();
  return RowsOf(drawn, name, {length}, [list](const ResetState& state, Values& values) {
    values.insert(values.end(), (state.*list).begin(), (state.*list).end());
  });
}

NpzArray ResetNumbersOf(const DrawnStates& drawn, const std::string& name,
                        double ResetState::*number) {
  return RowsOf(drawn, name, {}, [number](const ResetState& state, Values& values) {
    values.push_back(state.*number);
  });
}

NpzArray Names(const std::string& name, const std::vector<std::string>& texts) {
  return {name, {texts.size()}, {}, texts};
}
NpzArray Number(const std::string& name, double value) { return {name, {}, {value}}; }
NpzArray Text(const std::string& name, const std::string& text) { return {name, {}, {}, {text}}; }

void AddStates(const DrawnStates& drawn, std::size_t fingers, std::vector<NpzArray>& arrays) {
  arrays.push_back(ListsOf(drawn, "joints", &ResetState::joints));
  arrays.push_back(ListsOf(drawn, "controls", &ResetState::controls));
  arrays.push_back(ListsOf(drawn, "qpos", &ResetState::qpos));
  arrays.push_back(RowsOf(
      drawn, "object_position", {3},
      [](const ResetState& state, Values& values) { AppendVector(state.position, values); }));
  arrays.push_back(RowsOf(
      drawn, "object_quaternion", {4},
      [](const ResetState& state, Values& values) { AppendVector(state.quaternion, values); }));
  arrays.push_back(
      TipsOf(drawn, "holds", {fingers},
             [](const ResetState::Tip& tip, Values& values) { values.push_back(tip.holds); }));
  arrays.back().is_truth = true;
  arrays.push_back(VectorsOf(drawn, "contact_points", fingers, &ResetState::Tip::contact_O));
  arrays.push_back(VectorsOf(drawn, "contact_forces", fingers, &ResetState::Tip::force_O));
  arrays.push_back(ResetNumbersOf(drawn, "squeeze_N", &ResetState::squeeze_N));
  arrays.push_back(ResetNumbersOf(drawn, "off_m", &ResetState::off_m));
  arrays.push_back(ResetNumbersOf(drawn, "off_rad", &ResetState::off_rad));
}

void AddSettings(const kinematics::HandModel& hand, const ResetStateOptions& options,
                 const ResetStatesOrigin& origin, std::vector<NpzArray>& arrays) {
  NpzArray gravity{"gravity", {3}};
  AppendVector(-kGravity * hand.up, gravity.values);
  arrays.push_back(std::move(gravity));
  arrays.push_back(Number("mu", std::tan(options.half_angle)));
  arrays.push_back(Number("mass_kg", options.mass_kg));
  arrays.push_back(Number("scale", origin.scale));
  arrays.push_back(Number("held_s", ResetStates::kHeld));
  const HandTolerance& tolerance = options.tolerance;
  arrays.push_back(Number("tolerance_m", tolerance.at_rest * tolerance.length_m));
  arrays.push_back(Number("tolerance_rad", tolerance.at_rest * tolerance.angle_rad));
  arrays.push_back(Text("seed", std::to_string(origin.seed)));  // of 64 bits
  arrays.push_back(Text("object", origin.object));
  arrays.push_back(Text("object_sha256", origin.object_sha256));
  arrays.push_back(Text("hand", hand.file));
  arrays.push_back(Text("hand_sha256", hand.sha256));
}

void AddFallen(const DrawnStates& drawn, std::vector<NpzArray>& arrays) {
  std::vector<std::string> reasons;
  Values fallen;
  for (const plan::Reason reason :
       {plan::Reason::kContactLost, plan::Reason::kSlipped, plan::Reason::kObjectMoved,
        plan::Reason::kHandCollides, plan::Reason::kTorqueLimit, plan::Reason::kSimulationUnstable,
        plan::Reason::kJointLimit, plan::Reason::kCouplingViolated, plan::Reason::kTipPenetrates}) {
    const auto found = drawn.fallen.find(reason);
    reasons.emplace_back(plan::ReasonName(reason));
    fallen.push_back(found == drawn.fallen.end() ? 0 : static_cast<double>(found->second));
  }
  arrays.push_back(Names("fallen_reasons", reasons));
  arrays.push_back({"fallen", {fallen.size()}, fallen});
  arrays.push_back(Number("unbalanced", static_cast<double>(drawn.unbalanced)));
}

}  // namespace

std::string FormatResetStates(const DrawnStates& drawn, const kinematics::HandModel& hand,
                              const ResetStateOptions& options, const ResetStatesOrigin& origin) {
  std::vector<std::string> fingers;
  for (const kinematics::Finger& finger : hand.fingers) fingers.push_back(finger.name);
  std::vector<NpzArray> arrays;
  AddStates(drawn, fingers.size(), arrays);
  arrays.push_back(Names("joint_names", drawn.joint_names));
  arrays.push_back(Names("control_names", drawn.control_names));
  arrays.push_back(Names("finger_names", fingers));
  arrays.push_back(Number("timestep_s", drawn.timestep_s));
  AddSettings(hand, options, origin, arrays);
  AddFallen(drawn, arrays);
  return FormatNpz(arrays);
}

}  // namespace regrasp::sim
