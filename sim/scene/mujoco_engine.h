#pragma once

#include <memory>
#include <string>

#include "sim/scene/engine.h"

namespace regrasp::sim {

/// The version of MuJoCo that is linked, "2.2.2".
[[nodiscard]] std::string EngineVersion();

/// MuJoCo's model and data of one scene: a body "object" whose centre of mass is its origin, free
/// or on the joints x, y and turn about z, and fingers "finger0" … on a slide along each axis of
/// space or of the plane.
///
/// Warnings and errors of MuJoCo neither reach the terminal nor leave a log file: they become
/// exceptions.
class MujocoEngine final : public Engine {
 public:
  /// @param mjcf   FormatScene (sim/scene/scene.h).
  /// @param units  of the numbers in `mjcf`.
  /// @throws EnvironmentError  MuJoCo does not take the scene.
  MujocoEngine(const std::string& mjcf, int fingers, const EngineUnits& units = {});
  ~MujocoEngine() override;

  [[nodiscard]] double time() const override;
  [[nodiscard]] Eigen::Isometry3d object_pose() const override;
  [[nodiscard]] Eigen::Vector3d tip(FingerIndex finger) const override;
  [[nodiscard]] const TipForce& tip_force(FingerIndex finger) const override;
  void PlaceTip(FingerIndex finger, const Eigen::Vector3d& tip) override;
  void ShiftTip(FingerIndex finger, const Eigen::Vector3d& offset) override;
  void SetTarget(FingerIndex finger, const Eigen::Vector3d& target) override;
  void SetSite(FingerIndex finger, SiteIndex site) override;
  void AddSite(FingerIndex finger, SiteIndex site) override;
  void SetGravity(double gravity) override;
  void SetLoad(const Eigen::Vector3d& force, const Eigen::Vector3d& torque) override;
  void Step() override;
  [[nodiscard]] State Save() const override;
  void Restore(const State& state) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::sim
