#include "sim/actuation/hand_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/kinematics/derive_couplings.h"
#include "sim/actuation/hand_scene.h"

namespace regrasp::sim {

using Eigen::Vector3d;

HandEngine::HandEngine(std::unique_ptr<HandScene> scene) : scene_(std::move(scene)) {}
HandEngine::~HandEngine() = default;

const kinematics::HandModel& HandEngine::hand() const { return scene_->hand; }
double HandEngine::timestep() const { return scene_->model->opt.timestep; }
const Vector3d& HandEngine::centroid_O() const { return scene_->centroid; }
const HandLinks& HandEngine::links() const { return scene_->links; }
TipShape HandEngine::tip_shape() const { return scene_->options.tip; }

kinematics::JointConfiguration HandEngine::measured_configuration(FingerIndex finger) const {
  const std::vector<kinematics::JointConfiguration>& offsets = scene_->options.joint_offsets;
  if (offsets.empty()) return configuration(finger);
  return configuration(finger) + offsets[finger];
}

std::optional<collision::NearPoint> HandEngine::NearSphere(FingerIndex finger,
                                                           const Vector3d& centre_O) const {
  return scene_->surface.NearBall(finger, centre_O);
}

const DriveServo& HandEngine::servo(FingerIndex finger, int drive) const {
  return scene_->fingers[finger].drives[drive].servo;
}

double HandEngine::load_share(FingerIndex finger, int drive) const {
  const DriveActuator& found = scene_->fingers[finger].drives[drive];
  if (!std::isfinite(found.servo.limit)) return 0;
  return std::abs(torque(finger, drive)) / found.servo.limit;
}

std::vector<DriveLimits> HandEngine::limits() const {
  std::vector<DriveLimits> limits;
  for (FingerIndex f{0}; f < std::ssize(scene_->fingers); ++f) {
    const kinematics::Finger& chain = scene_->hand.fingers[f];
    for (int drive = 0; drive < chain.drives; ++drive) {
      const DriveActuator& found = scene_->fingers[f].drives[drive];
      const auto joint = std::ranges::find(chain.joints, drive, &kinematics::Joint::drive);
      limits.push_back({f, joint->name, kinematics::ActuatorName(*scene_->model, found.actuator),
                        found.servo.limit, found.servo.control_range, joint->lower, joint->upper});
    }
  }
  return limits;
}

std::string HandEngine::CouplingText(int equality) const {
  return scene_->couplings->TextOf(*scene_->model, equality);
}

std::pair<FingerIndex, int> HandEngine::JointOfCoupling(int equality) const {
  const int joint = scene_->couplings->JointOf(*scene_->model, equality);
  for (FingerIndex f{0}; f < std::ssize(scene_->fingers); ++f) {
    const std::vector<int>& joints = scene_->fingers[f].joints;
    const auto at = std::ranges::find(joints, joint);
    if (at != joints.end()) return {f, static_cast<int>(at - joints.begin())};
  }
  return {FingerIndex(), -1};
}

}  // namespace regrasp::sim
