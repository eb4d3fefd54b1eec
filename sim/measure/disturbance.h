#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/grasp/grasp_forces.h"
#include "planner/object/wrench_frame.h"
#include "planner/plan/plan.h"
#include "sim/scene/measured.h"
#include "sim/world/replay_world.h"

namespace regrasp::sim {

/// Return the directions of disturbances.
/// They are ± a force along every axis, then ± a torque about every axis. There are twelve in
/// space. In the plane there are six: forces along x and y, and torques about z.
[[nodiscard]] std::vector<Disturbance> DisturbanceDirections(int dimension);

/// Return "force +x" or "torque -z".
[[nodiscard]] std::string DisturbanceName(const Disturbance& disturbance);

/// Describe a disturbance for messages, with its size and direction.
/// @param size    force, or torque over `radius`, newtons.
/// @param radius  metres.
[[nodiscard]] std::string DisturbanceText(const Disturbance& disturbance, double size,
                                          double radius);

/// Return the wrench of a force of `size`, or of a torque of `size` times the frame's radius.
[[nodiscard]] grasp::Wrench DisturbanceWrench(const Disturbance& disturbance, double size);

/// Response of the fingers to a disturbance.
enum class DisturbanceResponse {
  kAdapted,  ///< forces planned for the disturbance
  /// Forces of the static grasp; only the servos' stiffness adds to them. The object moves by the
  /// compliance of the servos, and counts as moved if it does not return.
  kFixed,
};

/// Apply the disturbance test to a static grasp.
/// In every direction, one after the other, it applies a force of disturbance_ratio · grasp force,
/// then a torque of that over R, in addition to the weight. Each lasts until everything is still
/// (sim/world/replay_world.h). The world's monitor measures; the test stops at the first
/// disturbance that the grasp does not resist. Afterwards the world is restored, even after an
/// exception.
/// @param on_fault  callback before the world is restored after the failing disturbance.
/// @throws UnstableError  if the simulation becomes unstable.
void ApplyDisturbances(
    ReplayWorld& world, DisturbanceResponse response,
    const std::function<void(const plan::FaultDisturbance& disturbance)>& on_fault);

/// Apply one disturbance to a static grasp, and measure its contacts.
/// With adapted forces, these and the disturbance stay; with fixed forces the disturbance is
/// removed again.
/// @throws UnstableError  if the simulation becomes unstable.
void DisturbOnce(ReplayWorld& world, const grasp::Wrench& wrench_S, DisturbanceResponse response);

/// Guard of a static grasp: saves the state of the world, and restores it when destroyed.
class KeepRest {
 public:
  explicit KeepRest(ReplayWorld& world);
  ~KeepRest();
  KeepRest(const KeepRest&) = delete;
  KeepRest& operator=(const KeepRest&) = delete;
  /// Restore the saved state.
  void Restore();

 private:
  ReplayWorld& world_;
  Engine::State rest_;
  std::vector<Eigen::Vector3d> forces_;
};

/// Return the largest disturbance size that an unsupported object could appear to resist.
/// Under it, such an object moves by the tolerance (FreeMotion), or so little in kStillTime that it
/// appears still.
[[nodiscard]] double LeastDisturbance(double tolerance);

/// Check the disturbance size; 0 is allowed.
/// @throws InputError  if an unsupported object would pass the disturbance test.
void CheckDisturbance(const ReplaySettings& settings);

/// Characteristic times (ReplaySettings); a finger's servo settles in a tenth.
inline constexpr double kDisturbanceRamp = 0.6;

class ReplayWorld;

/// Measure the resisted wrench in every direction.
/// Each search starts from the world's current static grasp; afterwards everything except the
/// monitor is restored.
///
/// The criteria are those of a step: the object must not move, slip or lose a contact by more than
/// the tolerance. A grasp that resists two disturbances resists all in between, so bisection finds
/// the limit: to kResistedGap of it, or to kLeastResisted.
[[nodiscard]] std::vector<ResistedWrench> MeasureResistedWrenches(ReplayWorld& world);

inline constexpr double kResistedGap = 0.01;    ///< over the limit
inline constexpr double kLeastResisted = 1e-4;  ///< difference below which disturbances are equal

/// Weakest fingers of the static grasps of an entry: those with the smallest friction margin of
/// their own.
/// The grasps of an entry are the initial grasp, or those before and after a finger switch, or
/// those at the waypoints of a sliding step. The criterion is that of
/// planner/grasp/required_friction_angle.h; among equal fingers, the first.
class WeakestFingers {
 public:
  /// @param located  plan with contacts on the surface, in the unit of `frame`; must outlive this
  ///     object.
  WeakestFingers(const plan::Plan& projected, const object::WrenchFrame& frame,
                 double friction_angle)
      : projected_(projected), frame_(frame), friction_angle_(friction_angle) {}

  /// Return the weakest finger of an entry.
  /// @returns nullopt if the entry has no contacts, or none of its grasps is force closure.
  [[nodiscard]] std::optional<NeedOfFinger> OfEntry(plan::EntryIndex index);

 private:
  std::optional<NeedOfFinger> OfGrasp(const plan::FingerGrasp& grasp);

  const plan::Plan& projected_;
  object::WrenchFrame frame_;
  double friction_angle_;
  // Last grasp of the previous entry, which is the first of the next one.
  plan::FingerGrasp last_;
  std::optional<NeedOfFinger> last_weakest_;
};

/// Return the grasps of an entry in order of time (see WeakestFingers).
[[nodiscard]] std::vector<plan::FingerGrasp> GraspsOfEntry(const plan::Plan& projected,
                                                           plan::EntryIndex index);

}  // namespace regrasp::sim
