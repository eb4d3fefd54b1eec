#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "sim/scene/engine_state.h"

namespace regrasp::sim {

/// The engine warned of the state of a simulation or refused to go on, or a state is not finite.
class UnstableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The version of MuJoCo that is linked, "2.2.2".
[[nodiscard]] std::string EngineVersion();

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

/// MuJoCo's model and data of one scene (sim/scene/scene.h): a body "object" whose centre of mass
/// is its origin, free or on the joints x, y and turn about z, and fingers "finger0" … on a slide
/// along each axis of space or of the plane.
///
/// Warnings and errors of the engine neither reach the terminal nor leave a log file: they become
/// exceptions. Lengths in metres, forces in newtons, seconds, all in the world frame of the scene,
/// whatever the units of the scene are.
class Engine {
 public:
  using State = EngineState;

  /// @param units  of the numbers in `mjcf`.
  /// @throws EnvironmentError  the engine does not take the scene.
  Engine(const std::string& mjcf, int fingers, const EngineUnits& units = {});
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  [[nodiscard]] double time() const;
  [[nodiscard]] Eigen::Isometry3d object_pose() const;
  [[nodiscard]] Eigen::Vector3d tip(FingerIndex finger) const;
  /// Force of a finger on the object in the last step; zero where they do not touch.
  [[nodiscard]] Eigen::Vector3d contact_force(FingerIndex finger) const;
  /// Its torque on the object about the normal; zero of hard points.
  [[nodiscard]] Eigen::Vector3d contact_torque(FingerIndex finger) const;

  /// Moves a finger there at once, at rest.
  void PlaceTip(FingerIndex finger, const Eigen::Vector3d& tip);
  /// Moves a finger by an offset at once; its velocity stays.
  void ShiftTip(FingerIndex finger, const Eigen::Vector3d& offset);
  /// What the finger's servo steers for: its tip position at rest under no force.
  void SetTarget(FingerIndex finger, const Eigen::Vector3d& target);
  /// The patches of this site, and no others, stop the finger; none where it is not valid.
  void SetSite(FingerIndex finger, SiteIndex site);
  void AddSite(FingerIndex finger, SiteIndex site);
  /// Acceleration along −z, m/s².
  void SetGravity(double gravity);
  /// Force and torque on the object about its centre of mass, besides gravity and fingers.
  void SetLoad(const Eigen::Vector3d& force, const Eigen::Vector3d& torque);

  /// One time step.
  /// @throws UnstableError
  void Step();

  [[nodiscard]] State Save() const;
  /// Also after UnstableError.
  void Restore(const State& state);

 private:
  struct Impl;
  /// Of all contacts of a finger three numbers of what the engine has in their frames, from `begin`
  /// on, in the world's axes, on the object.
  [[nodiscard]] Eigen::Vector3d SumOfContacts(FingerIndex finger, int begin) const;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::sim
