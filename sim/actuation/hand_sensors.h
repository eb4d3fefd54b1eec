#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <deque>
#include <optional>

#include "planner/base/random.h"
#include "sim/actuation/hand_engine.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

/// Draw a vector whose coordinates are normally distributed.
/// @param deviation  standard deviation of each coordinate.
[[nodiscard]] Eigen::Vector3d DrawNormalVector(double deviation, RandomStream& random);

/// Deviation of a measured object pose from the planned pose at the time of the measurement.
struct PoseDeviation {
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();   ///< planned minus measured centroid
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();  ///< rotation from the measured orientation
};

/// Everything that the controller of a hand measures, with the errors of HandSensing.
///
/// A camera measures the object pose at a fixed rate. Each measurement arrives after a delay, with
/// normal noise and a constant bias. Errors depend on the seed and on the number of the measurement
/// alone, so that a copy continues identically.
class HandSensors {
 public:
  /// @param world  world of hand and object; must outlive this object.
  HandSensors(const HandEngine& world, const HandSensing& sensing);

  /// Return the joint configuration that the joint sensors measure.
  [[nodiscard]] kinematics::JointConfiguration configuration(FingerIndex finger) const {
    return world_.measured_configuration(finger);
  }
  /// Return whether the touch sensor of a fingertip detects a contact.
  [[nodiscard]] bool Touches(FingerIndex finger) const;
  /// Return the time between two measured poses, seconds.
  [[nodiscard]] double pose_period() const { return 1 / sensing_.pose_rate_Hz; }

  /// Measure the object pose if a measurement is due.
  /// @param planned  planned pose of the object at this time.
  void Update(const Eigen::Isometry3d& planned);
  /// Return the oldest measurement that has arrived and was not returned yet.
  [[nodiscard]] std::optional<PoseDeviation> TakeDeviation();

  /// Take the state of other sensors of the same world.
  void CopyState(const HandSensors& other);

 private:
  struct Arrival {
    double time = 0;
    PoseDeviation deviation;
  };
  const HandEngine& world_;
  HandSensing sensing_;
  PoseDeviation bias_;
  std::int64_t taken_ = 0;  ///< number of measurements
  std::deque<Arrival> pending_;
};

}  // namespace regrasp::sim
