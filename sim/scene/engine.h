#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <stdexcept>
#include <vector>

#include "planner/base/index.h"

namespace regrasp::sim {

/// Everything that the next steps of a simulation depend on, in the engine's units: replaying from
/// a saved state gives the same bits.
struct EngineState {
  double time = 0;
  std::vector<double> qpos, qvel, act, qacc_warmstart;
};

/// The engine warned of the state of a simulation or refused to go on, or a state is not finite.
class UnstableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the engine's units are. It has absolute limits and tolerances, so that every body should
/// look alike to it.
struct EngineUnits {
  double length_m = 1;
  double mass_kg = 1;
  double time_s = 1;

  [[nodiscard]] double force_N() const { return mass_kg * length_m / (time_s * time_s); }
};

/// One of the places where fingers touch, Scene::sites (sim/scene/scene.h).
using SiteIndex = Index<struct SiteTag>;

/// What a finger does to the object, in the frame of the scene; zero where they do not touch.
struct TipForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m, about the normal; 0 of hard points
};

/// The physics of one scene (sim/scene/scene.h): an object, free or in the plane, and fingers on
/// servos that stop at the patches of sites. It knows no plan and judges nothing: targets of the
/// servos and loads go in; poses, tips and forces of contacts come out.
///
/// Lengths in metres, forces in newtons, seconds, all in the world frame of the scene, whatever the
/// units of the engine are.
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
  /// What a finger did to the object in the last step.
  [[nodiscard]] virtual const TipForce& tip_force(FingerIndex finger) const = 0;

  /// Moves a finger there at once, at rest.
  virtual void PlaceTip(FingerIndex finger, const Eigen::Vector3d& tip) = 0;
  /// Moves a finger by an offset at once; its velocity stays.
  virtual void ShiftTip(FingerIndex finger, const Eigen::Vector3d& offset) = 0;
  /// What the finger's servo steers for: its tip position at rest under no force.
  virtual void SetTarget(FingerIndex finger, const Eigen::Vector3d& target) = 0;
  /// The patches of this site, and no others, stop the finger; none where it is not valid.
  virtual void SetSite(FingerIndex finger, SiteIndex site) = 0;
  virtual void AddSite(FingerIndex finger, SiteIndex site) = 0;
  /// Acceleration along −z, m/s².
  virtual void SetGravity(double gravity) = 0;
  /// Force and torque on the object about its centre of mass, besides gravity and fingers.
  virtual void SetLoad(const Eigen::Vector3d& force, const Eigen::Vector3d& torque) = 0;

  /// One time step.
  /// @throws UnstableError
  virtual void Step() = 0;

  [[nodiscard]] virtual State Save() const = 0;
  /// Also after UnstableError.
  virtual void Restore(const State& state) = 0;
};

/// Takes MuJoCo's two global hooks while any simulation lives, in whatever thread: its errors
/// become UnstableError, its warnings neither reach the terminal nor leave a log file.
class EngineHooks {
 public:
  EngineHooks();
  ~EngineHooks();
  EngineHooks(const EngineHooks&) = delete;
  EngineHooks& operator=(const EngineHooks&) = delete;
};

/// @throws UnstableError  a warning says that the last step is not to be trusted, or the state is
///                        not finite.
void CheckState(const mjModel& model, const mjData& data);

[[nodiscard]] EngineState SaveState(const mjModel& model, const mjData& data);
/// Of the same model. Warnings of what happened since are forgotten.
void RestoreState(const EngineState& state, mjData& data);

}  // namespace regrasp::sim
