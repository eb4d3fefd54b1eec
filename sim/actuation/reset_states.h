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

/// A hand that holds an object, at rest: what a simulation is set to, with velocities of zero.
struct ResetState {
  struct Tip {
    bool holds = false;
    Eigen::Vector3d contact_O = Eigen::Vector3d::Zero();  ///< in the object's frame, metres
    Eigen::Vector3d force_O = Eigen::Vector3d::Zero();    ///< on the object, in its frame, newtons
  };

  std::vector<double> joints;    ///< as HandWorld::joint_angles
  std::vector<double> controls;  ///< as HandWorld::controls
  /// Of the object's frame in the palm's, metres and w, x, y, z.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector4d quaternion = Eigen::Vector4d::UnitX();
  std::vector<double> qpos;  ///< all of it as the engine has it (HandWorld::Save)
  std::vector<Tip> tips;     ///< by finger
  double squeeze_N = 0;      ///< sum of the normal forces that it was made with
  /// The farthest that the object came from here while it was held.
  double off_m = 0;
  double off_rad = 0;
};

struct ResetStateOptions {
  double half_angle = 0;  ///< friction, radians
  double mass_kg = 0;
  std::optional<double> squeeze_N;  ///< otherwise as much as the torques of each rest allow
  HandTolerance tolerance;          ///< while it is held all along as at rest
  double friction_factor = 1;       ///< the world's friction over the one that the hand believes
};

/// Makes reset states of rests in the world of a hand, and holds them.
///
/// What a state is held by: it is set as it is stored, velocities zero, and for kHeld seconds all
/// controls stay as they are stored. No finger that holds loses its contact or slips
/// (HandTolerance), no link touches anything, no actuator is at its limit, the object stays within
/// the tolerance.
///
/// Laws: what comes of a rest depends on it alone, not on those before it.
class ResetStates {
 public:
  /// @throws InputError  as HandWorld.
  ResetStates(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
              const ResetStateOptions& options);

  /// The sum of the normal forces that a rest is held with, newtons: that of the options, or as
  /// RestSqueeze. @returns nullopt where no forces with that sum balance the object's weight.
  /// @param grasp  of the rest, in the object's units.
  [[nodiscard]] std::optional<double> SqueezeOf(const plan::HandState& rest,
                                                const plan::FingerGrasp& grasp);

  /// The hand takes hold of the object in a rest, comes to rest, and is validated.
  /// @returns why it is not held, where it is not.
  [[nodiscard]] std::variant<ResetState, plan::Reason> Make(const plan::HandState& rest,
                                                            const plan::FingerGrasp& grasp,
                                                            double squeeze_N);

  /// Holds a state, and measures how far off the object comes.
  /// @returns why it is not held; nullopt where it is.
  [[nodiscard]] std::optional<plan::Reason> Validate(ResetState& state);

  [[nodiscard]] const HandWorld& world() const { return world_; }

  inline static constexpr double kTakeHold = 0.15;  ///< seconds, the object pinned
  inline static constexpr double kSettle = 0.15;    ///< and then free, under control
  inline static constexpr double kHeld = 1;         ///< seconds, with the controls as they are

 private:
  void TakeHold(const plan::HandState& rest, const plan::FingerGrasp& grasp, double squeeze_N);
  [[nodiscard]] ResetState Store(const plan::FingerGrasp& grasp, double squeeze_N) const;
  [[nodiscard]] plan::HandState StateOf(const ResetState& state) const;
  /// Whether the monitor has seen something fail.
  [[nodiscard]] std::optional<plan::Reason> Failure() const;

  const object::Polyhedron& solid_;
  double scale_;
  ResetStateOptions options_;
  double weight_N_;  ///< of the object
  HandWorld world_;
  ExecutionMonitor fresh_;  ///< that has seen nothing
  ExecutionMonitor monitor_;
  std::vector<std::vector<int>> joints_;  ///< by finger: places among all joints of the model
};

/// A rest that the hand is to hold.
struct RestToHold {
  plan::HandState state;
  plan::FingerGrasp grasp;  ///< in the object's units
};

/// Draws rests. @returns nullopt where none is found in a bounded number of tries.
using DrawRest = std::function<std::optional<RestToHold>(RandomStream&)>;

struct DrawnStatesOptions {
  int count = 0;
  std::uint64_t seed = 0;
  /// Rests that are tried for one state: where one of fifty is held, one of a billion has none.
  int most_tried = 1000;
  int jobs = 1;  ///< threads
  std::function<void(int done)> told =
      {};  ///< after every state, by one thread at a time; may be empty
};

/// Reset states, and what became of all rests that were drawn for them.
struct DrawnStates {
  std::vector<ResetState> states;               ///< none where `message` says why
  std::map<plan::Reason, std::int64_t> fallen;  ///< rests that were not held, by reason
  std::int64_t unbalanced = 0;  ///< rests that no forces hold (ResetStates::SqueezeOf), not tried
  std::string message;          ///< what stopped it; empty: nothing
  // Of the world that they are for.
  std::vector<std::string> joint_names;
  std::vector<std::string> control_names;
  double timestep_s = 0;

  [[nodiscard]] std::int64_t fallen_count() const;
  /// Of all rests that were tried, those that were not held.
  [[nodiscard]] double fallen_share() const;
  /// Of that share, as if their number had been given, at kTrialConfidence.
  [[nodiscard]] ShareInterval interval() const;
};

/// Draws rests until so many are reset states. For each state rests are drawn until one is held;
/// none of `most_tried` ends it all.
///
/// Laws: state k depends on the seed and k alone, whatever the number of threads; of N states the
/// first M are those that M alone are.
/// @param make_draw  called once for each thread: what it returns is used by that one.
/// @throws InputError  as ResetStates.
[[nodiscard]] DrawnStates DrawResetStates(const kinematics::HandFile& file,
                                          const object::Polyhedron& solid, double scale,
                                          const ResetStateOptions& states,
                                          const DrawnStatesOptions& options,
                                          const std::function<DrawRest()>& make_draw);

/// What reset states are of.
struct ResetStatesOrigin {
  std::string object;         ///< name of the file
  std::string object_sha256;  ///< of its bytes
  double scale = 1;           ///< metres per unit of it
  std::uint64_t seed = 0;
};

/// Reset states as the bytes of an NPZ file: docs/formats.md has its arrays.
[[nodiscard]] std::string FormatResetStates(const DrawnStates& drawn,
                                            const kinematics::HandModel& hand,
                                            const ResetStateOptions& options,
                                            const ResetStatesOrigin& origin);

}  // namespace regrasp::sim
