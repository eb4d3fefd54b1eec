#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <stdexcept>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::sim {

/// Complete state of a simulation, in the engine's units. A replay from a saved state is
/// bit-identical.
struct EngineState {
  double time = 0;
  std::vector<double> qpos, qvel, act, qacc_warmstart;
};

/// Error of an unstable simulation: the engine warned or stopped, or a state is not finite.
class UnstableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Units of the engine. They make all objects look alike to its absolute limits and tolerances.
struct EngineUnits {
  double length_m = 1;
  double mass_kg = 1;
  double time_s = 1;

  [[nodiscard]] double force_N() const { return mass_kg * length_m / (time_s * time_s); }
};

/// Index of a place at which fingers make contact, Scene::sites (sim/scene/scene.h).
using SiteIndex = Index<struct SiteTag>;

/// Load of a finger on the object, in the frame of the scene; zero without contact.
struct TipForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< N
  /// N m, about the normal; 0 for hard-finger contacts.
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
};

/// Physics of one scene (sim/scene/scene.h): an object, free or in the plane, and servo fingers.
/// The patches of sites stop the fingers. The engine is independent of plans and verdicts. Inputs
/// are targets of the servos and loads; outputs are poses, fingertips and contact forces.
///
/// Lengths are in metres, forces in newtons, times in seconds, all in the world frame of the scene,
/// whatever the internal units of the engine.
class Engine {
 public:
  using State = EngineState;

  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  [[nodiscard]] virtual double time() const = 0;
  [[nodiscard]] virtual Eigen::Isometry3d object_pose() const = 0;
  [[nodiscard]] virtual Eigen::Vector3d tip(FingerIndex finger) const = 0;
  /// Load of a finger on the object in the last step.
  [[nodiscard]] virtual const TipForce& tip_force(FingerIndex finger) const = 0;

  /// Place a fingertip immediately, with zero velocity.
  virtual void PlaceTip(FingerIndex finger, const Eigen::Vector3d& tip) = 0;
  /// Shift a fingertip immediately; its velocity does not change.
  virtual void ShiftTip(FingerIndex finger, const Eigen::Vector3d& offset) = 0;
  /// Set the target of a finger's servo: its fingertip position in equilibrium without force.
  virtual void SetTarget(FingerIndex finger, const Eigen::Vector3d& target) = 0;
  /// Let the patches of this site, and no others, stop the finger; none if it is not valid.
  virtual void SetSite(FingerIndex finger, SiteIndex site) = 0;
  virtual void AddSite(FingerIndex finger, SiteIndex site) = 0;
  /// Set the acceleration along −z, m/s².
  virtual void SetGravity(double gravity) = 0;
  /// Set the load on the object about its centre of mass.
  /// It acts in addition to gravity and fingers.
  virtual void SetLoad(const Eigen::Vector3d& force, const Eigen::Vector3d& torque) = 0;

  /// Simulate one time step.
  /// @throws UnstableError  if the simulation becomes unstable.
  virtual void Step() = 0;

  [[nodiscard]] virtual State Save() const = 0;
  /// Restore a state, also after UnstableError.
  virtual void Restore(const State& state) = 0;
};

/// Handlers of MuJoCo's errors and warnings while any simulation lives, in any thread.
/// They replace its two global hooks: errors become UnstableError, and warnings neither reach the
/// terminal nor leave a log file.
class EngineHooks {
 public:
  EngineHooks();
  ~EngineHooks();
  EngineHooks(const EngineHooks&) = delete;
  EngineHooks& operator=(const EngineHooks&) = delete;
};

/// Check the state after a step.
/// @throws UnstableError  if a warning makes the last step unreliable, or the state is not finite.
void CheckState(const mjModel& model, const mjData& data);

[[nodiscard]] EngineState SaveState(const mjModel& model, const mjData& data);
/// Restore a state of the same model, and clear later warnings.
void RestoreState(const EngineState& state, mjData& data);

}  // namespace regrasp::sim
