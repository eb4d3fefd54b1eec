#pragma once

#include <Eigen/Geometry>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/plan/reason.h"
#include "sim/actuation/hand_engine.h"
#include "sim/actuation/penetration.h"
#include "sim/scene/measured.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

/// Measures a replay by a hand while it runs, and finds the first violated limit of each step.
class ExecutionMonitor {
 public:
  ExecutionMonitor(const HandEngine& world, const object::Polyhedron& solid, double scale,
                   const HandTolerance& tolerance);

  /// Take the measurements of another monitor of the same world.
  void CopyState(const ExecutionMonitor& other);
  /// Begin a step: forget its measurements and violation.
  void Start();
  /// Set the phase of the step that violations name: "during the move".
  void SetPhase(std::string phase) { phase_ = std::move(phase); }
  /// Set the disturbance that violations name from now on.
  void SetDisturbance(plan::FaultDisturbance disturbance) { disturbance_ = std::move(disturbance); }
  /// Check that fingers are at these contacts.
  /// @param known_off  additional allowed distance, metres.
  void WatchContacts(const plan::FingerGrasp& grasp, double scale, double known_off = 0);
  /// Set whether a finger holds from now on; its slip is measured from here.
  void SetHolding(FingerIndex finger, bool holds);
  /// Set the target of a sliding finger. Its distance from the surface does not count.
  /// @param centre_O  centre of the fingertip sphere, in the object's frame.
  void SetSliding(FingerIndex finger, const Eigen::Vector3d& centre_O);
  /// Measure after a time step of the world. @param planned  pose of the object.
  void Watch(const Eigen::Isometry3d& planned);
  /// Measure a static grasp. @param planned  pose of the object.
  void WatchRest(const Eigen::Isometry3d& planned);
  /// Note that the step has reached its static grasp.
  void SetComplete() { measures_.is_complete = true; }
  /// Measure the motion of the object under constant controls.
  /// @param start  its pose in the static grasp.
  void WatchFrozen(const Eigen::Isometry3d& start);
  /// Check that motion after the last time step.
  void CheckFrozen(const Eigen::Isometry3d& start);
  /// Check that a finger that was placed is near the object.
  void WatchPlaced(FingerIndex finger);
  /// Set whether fingertips of the model may be in the object.
  /// They may from the start to the first static grasp, while contact forces press them out of it.
  void SetSettling(bool on) { settling_ = on; }
  /// Check the depth of fingertips in a static grasp.
  /// It also measures the depth of the collision geometry that fingertip spheres replace.
  void WatchTipsAtRest();

  [[nodiscard]] const std::optional<Violation>& violation() const { return violation_; }
  [[nodiscard]] const HandMeasures& measures() const { return measures_; }

 private:
  struct Finger {
    bool holds = false;
    std::optional<Eigen::Vector3d> slides_to_O = std::nullopt;  ///< target of SetSliding
    double without_force = 0;
    Eigen::Vector3d slip = Eigen::Vector3d::Zero();
    Eigen::Vector3d first_O = Eigen::Vector3d::Zero();
    /// uninterrupted seconds at the force limit, by independent joint
    std::vector<double> at_limit;
    /// seconds at the control limit in this step, by independent joint
    std::vector<double> control_limit;
  };
  void WatchObject(const Eigen::Isometry3d& planned, double share, double& off_m, double& off_rad);
  void WatchFinger(FingerIndex finger);
  void WatchContact(FingerIndex finger);
  void WatchActuators(FingerIndex finger);
  void WatchLinks();
  void WatchJoints(FingerIndex finger);
  void WatchCouplings();
  void WatchTips(const std::vector<HandLinks::Placed>& placed);
  /// Check that a shape of a finger is not deeper in the object than `allowed`.
  /// @param shape  shape in the palm's frame.
  void WatchDepth(FingerIndex finger, const collision::ConvexShape& shape, double allowed,
                  const std::string& what);
  /// Marks of a violation in an image.
  struct Marks {
    std::string number;
    std::vector<FingerIndex> fingers = {};
    std::vector<plan::HandLink> links = {};
    std::optional<Eigen::Vector3d> at = std::nullopt;
    std::optional<Eigen::Isometry3d> pose = std::nullopt;  ///< planned pose of the object
  };
  void Fail(plan::Reason reason, const std::string& what, Marks marks);
  [[nodiscard]] std::vector<HandLinks::Placed> PlaceLinks() const;
  [[nodiscard]] std::string LinkText(const HandLinks::Placed& placed) const;
  [[nodiscard]] static Marks MarksOf(std::initializer_list<const HandLinks::Placed*> links);
  [[nodiscard]] Marks MarksOfJoint(FingerIndex finger, int joint, std::string number) const;

  const HandEngine& world_;
  std::shared_ptr<const Penetration> object_;  ///< copies share it
  HandTolerance tolerance_;
  std::string phase_;
  std::optional<plan::FaultDisturbance> disturbance_;
  std::vector<Finger> fingers_;
  HandMeasures measures_;
  std::optional<Violation> violation_;
  int steps_ = 0;
  bool settling_ = false;
};

}  // namespace regrasp::sim
