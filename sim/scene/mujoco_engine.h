#pragma once

#include <memory>
#include <string>

#include "sim/scene/engine.h"

namespace regrasp::sim {

/// Return the version of the linked MuJoCo, such as "2.2.2".
[[nodiscard]] std::string EngineVersion();

/// MuJoCo model and data of one scene.
/// The body "object" has its centre of mass as origin. It is free, or has the joints x, y and a
/// rotation about z. The fingers "finger0" … have a slide joint along each axis of space or of the
/// plane.
///
/// Warnings and errors of MuJoCo become exceptions; they neither reach the terminal nor leave a log
/// file.
class MujocoEngine final : public Engine {
 public:
  /// @param mjcf   scene from FormatScene (sim/scene/scene.h).
  /// @param units  units of the numbers in `mjcf`.
  /// @throws EnvironmentError  if MuJoCo rejects the scene.
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
