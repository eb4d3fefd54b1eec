#pragma once

#include <memory>
#include <string>

#include "planner/object/object.h"
#include "sim/scene/engine.h"
#include "sim/scene/scene.h"

namespace regrasp::sim {

/// The version of ODE that the project is built for, "0.16.2".
[[nodiscard]] std::string OdeVersion();

/// The same scene in the Open Dynamics Engine, a second opinion beside MuJoCo: hard contacts, found
/// exactly from the patches (patch_touch.h), and Coulomb's circular cones, held by solving each
/// step again until every box of friction lies in its cone and gives nothing away (friction_box.h).
///
/// What both share is the scene: bodies, masses, patches, time step, and the law of the servos.
/// Fingertips are balls that do not turn. In the plane everything stays in it.
///
/// Messages and errors of ODE do not reach the terminal: they become UnstableError.
class OdeEngine final : public Engine {
 public:
  /// @param scene  in metres.
  OdeEngine(const Scene& scene, const object::Object& body);
  ~OdeEngine() override;

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
