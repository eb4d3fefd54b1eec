#include "planner/plan/hand_motion_json.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace regrasp::plan {
namespace {

constexpr std::size_t kSha256Digits = 64;
/// Of quaternions in files; they are then made unit ones.
constexpr double kUnitTolerance = 1e-6;

std::vector<double> ReadNumbers(const JsonReader& json) {
  std::vector<double> numbers;
  for (const JsonReader& number : json.Elements()) numbers.push_back(number.Number());
  return numbers;
}

Eigen::Isometry3d ReadPose(const JsonReader& json) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = json.Member("position").Vector(3);
  const JsonReader turn = json.Member("quaternion");
  const std::vector<double> wxyz = ReadNumbers(turn);
  if (wxyz.size() != 4) {
    turn.Fail("expected w, x, y and z, found " + std::to_string(wxyz.size()) + " numbers");
  }
  const Eigen::Quaterniond quaternion(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (!(std::abs(quaternion.norm() - 1) <= kUnitTolerance)) {
    turn.Fail("expected a quaternion of length 1, found " + turn.Quoted());
  }
  pose.linear() = quaternion.normalized().toRotationMatrix();
  return pose;
}

Json PoseJson(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond turn(pose.linear());
  return {{"position", VectorJson(pose.translation(), 3)},
          {"quaternion", {turn.w(), turn.x(), turn.y(), turn.z()}}};
}

HandState ReadState(const JsonReader& json) {
  HandState state{ReadPose(json.Member("pose")), {}};
  for (const JsonReader& finger : json.Member("joints").Elements()) {
    state.joints.push_back(ReadNumbers(finger));
  }
  return state;
}

Json StateJson(const HandState& state) {
  return {{"pose", PoseJson(state.pose)}, {"joints", state.joints}};
}

}  // namespace

std::string ReadSha256(const JsonReader& json) {
  std::string digits = json.String();
  const auto is_digit = [](unsigned char c) { return std::isxdigit(c) && !std::isupper(c); };
  if (digits.size() != kSha256Digits || !std::ranges::all_of(digits, is_digit)) {
    json.Fail("expected 64 lower-case hexadecimal digits, found " + json.Quoted());
  }
  return digits;
}

HandUse ReadHandUse(const JsonReader& json) {
  return {json.Member("name").String(), json.Member("file").String(),
          ReadSha256(json.Member("sha256")), ReadState(json.Member("initial")),
          ReadPose(json.Member("goal"))};
}

HandPath ReadHandPath(const JsonReader& json) {
  HandPath path;
  for (const JsonReader& state : json.Elements()) path.push_back(ReadState(state));
  if (path.empty()) json.Fail("expected at least one state of the hand");
  return path;
}

SwitchMotion ReadSwitchMotion(const JsonReader& json) {
  return {ReadHandPath(json.Member("place")), ReadHandPath(json.Member("release"))};
}

Json HandUseJson(const HandUse& hand) {
  return {{"name", hand.name},
          {"file", hand.file},
          {"sha256", hand.sha256},
          {"initial", StateJson(hand.initial)},
          {"goal", PoseJson(hand.goal)}};
}

Json HandPathJson(const HandPath& path) {
  Json json = Json::array();
  for (const HandState& state : path) json.push_back(StateJson(state));
  return json;
}

Json SwitchMotionJson(const SwitchMotion& motion) {
  return {{"place", HandPathJson(motion.place)}, {"release", HandPathJson(motion.release)}};
}

}  // namespace regrasp::plan
