#pragma once

#include <memory>
#include <string>

#include "planner/object/object.h"
#include "sim/scene/engine.h"
#include "sim/scene/scene.h"

namespace regrasp::sim {

/// Return the version of ODE for which the project is built, "0.16.2".
[[nodiscard]] std::string OdeVersion();

/// Simulation of the same scene in the Open Dynamics Engine, independent of MuJoCo.
/// Contacts are hard and computed exactly from the patches (ode_world.h). Friction cones are
/// circular: each step is solved again until the friction of every contact is inside its cone and,
/// if its box limits it, on the cone (KeepsCone).
///
/// Both engines share the scene: bodies, masses, patches, time step, and the control law of the
/// servos. Fingertips are spheres that do not rotate. In the plane all motion stays in the plane.
///
/// Messages and errors of ODE become UnstableError; they do not reach the terminal.
class OdeEngine final : public Engine {
 public:
  /// @param scene  scene in metres.
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
