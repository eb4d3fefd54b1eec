#include "sim/actuation/hand_sensors.h"

#include <cstdint>

#include "planner/base/random.h"
#include "planner/object/rotation.h"

namespace regrasp::sim {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Time, as a share of a period, by which a measurement may come early. It absorbs rounding of the
/// simulation's time.
constexpr double kEarly = 1e-6;

PoseDeviation DrawDeviation(double length, double angle, std::uint64_t seed, std::uint64_t index) {
  RandomStream random(seed, RandomUse::kPoseErrors, index);
  const Vector3d shift = DrawNormalVector(length, random);
  return {shift, DrawNormalVector(angle, random)};
}

}  // namespace

Vector3d DrawNormalVector(double deviation, RandomStream& random) {
  Vector3d drawn;
  for (double& x : drawn) x = deviation * random.Normal();
  return drawn;
}

HandSensors::HandSensors(const HandEngine& world, const HandSensing& sensing)
    : world_(world),
      sensing_(sensing),
      bias_(DrawDeviation(sensing.pose_bias_m, sensing.pose_bias_rad, sensing.seed, 0)) {}

bool HandSensors::Touches(FingerIndex finger) const {
  const double force_N = world_.touch(finger).force.norm();
  return force_N > 0 && force_N >= sensing_.touch_N;
}

void HandSensors::Update(const Isometry3d& planned) {
  if (sensing_.feedback == PoseFeedback::kNone) return;
  const double due = static_cast<double>(taken_) * pose_period();
  if (world_.time() < due - kEarly * pose_period()) return;
  ++taken_;
  const Isometry3d pose = world_.object_pose();
  const PoseDeviation noise = DrawDeviation(sensing_.pose_noise_m, sensing_.pose_noise_rad,
                                            sensing_.seed, static_cast<std::uint64_t>(taken_));
  const Vector3d& centre_O = world_.centroid_O();
  const Eigen::AngleAxisd turn = object::RotationInWorld(pose.linear(), planned.linear());
  Arrival arrival;
  arrival.time = world_.time() + sensing_.pose_delay_s;
  arrival.deviation.shift_m = planned * centre_O - pose * centre_O + bias_.shift_m + noise.shift_m;
  // Errors and deviations are small angles, so rotation vectors add.
  arrival.deviation.turn_rad = turn.angle() * turn.axis() + bias_.turn_rad + noise.turn_rad;
  pending_.push_back(arrival);
}

std::optional<PoseDeviation> HandSensors::TakeDeviation() {
  if (pending_.empty() || pending_.front().time > world_.time() + kEarly * pose_period()) {
    return std::nullopt;
  }
  const PoseDeviation deviation = pending_.front().deviation;
  pending_.pop_front();
  return deviation;
}

void HandSensors::CopyState(const HandSensors& other) {
  taken_ = other.taken_;
  pending_ = other.pending_;
}

}  // namespace regrasp::sim
