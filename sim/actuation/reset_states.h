#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/base/random.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/plan.h"
#include "sim/actuation/execution_monitor.h"
#include "sim/actuation/hand_control.h"
#include "sim/actuation/hand_world.h"
#include "sim/scene/settings.h"

namespace regrasp {
struct ShareInterval;  // planner/base/random.h
}

namespace regrasp::sim {

/// A static grasp of an object by a hand, to initialize a simulation with zero velocities.
struct ResetState {
  struct Tip {
    bool holds = false;
    Eigen::Vector3d contact_O = Eigen::Vector3d::Zero();  ///< contact in the object's frame, metres
    /// force on the object, in its frame, newtons
    Eigen::Vector3d force_O = Eigen::Vector3d::Zero();
  };

  std::vector<double> joints;    ///< joint angles, as in HandWorld::joint_angles
  std::vector<double> controls;  ///< controls, as in HandWorld::controls
  /// Pose of the object's frame in the palm's frame, metres and w, x, y, z.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector4d quaternion = Eigen::Vector4d::UnitX();
  std::vector<double> qpos;  ///< complete position vector of the engine (HandWorld::Save)
  std::vector<Tip> tips;     ///< fingertips by finger
  double grasp_force_N = 0;  ///< grasp force with which the state was made
  /// Largest deviation of the object from this state while it was held.
  double off_m = 0;
  double off_rad = 0;
};

struct ResetStateOptions {
  double friction_angle = 0;  ///< friction angle, radians
  double mass_kg = 0;
  std::optional<double> grasp_force_N;  ///< grasp force; none: the largest that the torques allow
  HandTolerance tolerance;     ///< limits while the state is held, throughout as in a static grasp
  double friction_factor = 1;  ///< friction of the world over the assumed friction
};

/// Makes reset states from static grasps in the world of a hand, and validates them.
///
/// To validate a state, the world is set to it with zero velocities, and all controls stay constant
/// for kHeld seconds. No holding finger may lose its contact or slip (HandTolerance). No link may
/// touch anything, no actuator may reach its limit, and the object must stay within the tolerance.
///
/// Laws: the result for a grasp depends on it alone, not on earlier grasps.
class ResetStates {
 public:
  /// @throws InputError  as HandWorld.
  ResetStates(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
              const ResetStateOptions& options);

  /// Return the grasp force of a static grasp, newtons: that of the options, or as
  /// StaticGraspForce.
  /// @param grasp  contacts of the grasp, in the object's units.
  /// @returns the grasp force; nullopt if no forces with that sum balance the object's weight.
  [[nodiscard]] std::optional<double> GraspForceOf(const plan::HandState& rest,
                                                   const plan::FingerGrasp& grasp);

  /// Grasp the object in a given state, wait until it is static, and validate it.
  /// @returns the state, or the reason why it is not held.
  [[nodiscard]] std::variant<ResetState, plan::Reason> Make(const plan::HandState& rest,
                                                            const plan::FingerGrasp& grasp,
                                                            double grasp_force_N);

  /// Hold a state, and measure the deviation of the object.
  /// @returns the reason why it is not held; nullopt if it is held.
  [[nodiscard]] std::optional<plan::Reason> Validate(ResetState& state);

  [[nodiscard]] const HandWorld& world() const { return world_; }

  inline static constexpr double kTakeHold = 0.15;  ///< seconds with the object pinned
  /// subsequent seconds with the object free, under control
  inline static constexpr double kSettle = 0.15;
  inline static constexpr double kHeld = 1;  ///< seconds with constant controls

 private:
  void TakeHold(const plan::HandState& rest, const plan::FingerGrasp& grasp, double grasp_force_N);
  [[nodiscard]] ResetState Store(const plan::FingerGrasp& grasp, double grasp_force_N) const;
  [[nodiscard]] plan::HandState StateOf(const ResetState& state) const;
  /// Return the violation that the monitor found, if any.
  [[nodiscard]] std::optional<plan::Reason> Failure() const;

  const object::Polyhedron& solid_;
  double scale_;
  ResetStateOptions options_;
  double weight_N_;  ///< weight of the object
  HandWorld world_;
  ExecutionMonitor fresh_;  ///< monitor without measurements
  ExecutionMonitor monitor_;
  std::vector<std::vector<int>> joints_;  ///< indices among all joints of the model, by finger
};

/// A static grasp to be held by the hand.
struct RestToHold {
  plan::HandState state;
  plan::FingerGrasp grasp;  ///< contacts in the object's units
};

/// Function that draws a static grasp.
/// It returns nullopt if a bounded number of attempts finds none.
using DrawRest = std::function<std::optional<RestToHold>(RandomStream&)>;

struct DrawnStatesOptions {
  int count = 0;
  std::uint64_t seed = 0;
  /// Largest number of grasps simulated per state. If one of fifty is held, the probability that
  /// none of 1000 is held is below 1e-8.
  int most_simulated = 1000;
  int jobs = 1;  ///< number of threads
  std::function<void(int done)> told =
      {};  ///< callback after every state, from one thread at a time; may be empty
};

/// Reset states, and the results of all grasps that were drawn for them.
struct DrawnStates {
  std::vector<ResetState> states;               ///< drawn states; empty if `message` is not
  std::map<plan::Reason, std::int64_t> fallen;  ///< number of grasps that were not held, by reason
  /// Number of grasps without balancing forces (GraspForceOf), not simulated
  std::int64_t unbalanced = 0;
  std::string message;  ///< reason why drawing stopped; empty if it completed
  // Properties of the simulated world.
  std::vector<std::string> joint_names;
  std::vector<std::string> control_names;
  double timestep_s = 0;

  [[nodiscard]] std::int64_t fallen_count() const;
  /// Return the share of simulated grasps that were not held.
  [[nodiscard]] double fallen_share() const;
  /// Return the interval of that share at kTrialConfidence, as for a fixed number of grasps.
  [[nodiscard]] ShareInterval interval() const;
};

/// Draw static grasps until a given number of reset states is found.
/// For each state, grasps are drawn until one is held. If none of `most_simulated` is held, the
/// function stops.
///
/// Laws: state k depends on the seed and k alone, for any number of threads. The first M of N
/// states are the states of a run with M.
/// @param make_draw  factory, called once per thread; only that thread uses the result.
/// @throws InputError  as ResetStates.
[[nodiscard]] DrawnStates DrawResetStates(const kinematics::HandFile& file,
                                          const object::Polyhedron& solid, double scale,
                                          const ResetStateOptions& states,
                                          const DrawnStatesOptions& options,
                                          const std::function<DrawRest()>& make_draw);

/// Origin of reset states.
struct ResetStatesOrigin {
  std::string object;         ///< name of the object's file
  std::string object_sha256;  ///< SHA-256 of the file's bytes
  double scale = 1;           ///< metres per unit of the file
  std::uint64_t seed = 0;
};

/// Format reset states as the bytes of an NPZ file; docs/formats.md defines its arrays.
[[nodiscard]] std::string FormatResetStates(const DrawnStates& drawn,
                                            const kinematics::HandModel& hand,
                                            const ResetStateOptions& options,
                                            const ResetStatesOrigin& origin);

}  // namespace regrasp::sim
