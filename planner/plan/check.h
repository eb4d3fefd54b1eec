#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/grasp/required_friction_angle.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/projection.h"  // IWYU pragma: export
#include "planner/plan/reason.h"

namespace regrasp::plan {

/// Result of the analytic check of one entry of the report: the initial grasp or a step.
struct StepCheck {
  EntryIndex index{0};
  std::string kind;  ///< "hold", or as StepKind
  Reason reason = Reason::kNone;
  std::string detail;    ///< details for messages: finger, waypoint, deviation
  Fault fault;           ///< details of the failure for an image
  bool skipped = false;  ///< whether an earlier step failed
  /// Whether every grasp of the step, anywhere on the path, is proved to be force closure at the
  /// friction angle; with CheckOptions::allow_undecided, except for `undecided` intervals. If the
  /// step is skipped, or has a fault that precedes force closure, there is no sequence of grasps to
  /// evaluate: then this is false and `required` is nullopt.
  bool force_closure = false;
  /// Smallest friction angle at which every grasp of the step is force closure; nullopt if there is
  /// none. If proofs alone make `force_closure` true, `upper` is at most the friction angle of the
  /// plan.
  std::optional<grasp::RequiredFrictionAngle> required;
  /// Whether a grasp of the step that is not force closure is gravity-supported (WeightCarrier).
  /// `force_closure` is then false, and `required` includes the friction angle at which it is
  /// supported.
  bool is_supported = false;
  /// Whether this applies to the static grasp after the step.
  bool ends_supported = false;
  /// Size of the disturbances that the gravity-supported grasps of the step resist at the
  /// states of the hand, a lower bound in weights of the object; nullopt if there are none.
  std::optional<double> resistance;
  /// Number of intervals of a sliding step's path with undecided force closure, each at most 1e-6
  /// of the path between two waypoints. They have no proof, and no instant that is not force
  /// closure. They fail the step (kNotProved) unless CheckOptions::allow_undecided is set.
  int undecided = 0;
};

/// First fault of an entry that the check of a plan's hand found.
struct HandFault {
  EntryIndex entry{0};
  Reason reason = Reason::kNone;
  std::string detail;  ///< description, as in StepCheck
  Fault fault = {};
};

struct CheckOptions {
  /// Friction angle instead of the plan's, radians.
  std::optional<double> friction_angle = std::nullopt;
  /// Torsional friction length of all contacts instead of the plan's, in the object's unit of
  /// length; 0: hard-finger contacts.
  std::optional<double> torsion = std::nullopt;
  /// Radius of the fingers (reach.h) instead of the plan's, in the object's unit of length. Fingers
  /// are points if neither is given.
  std::optional<double> finger_radius = std::nullopt;
  /// Whether to check force closure. If false, the other checks remain, and all entries have
  /// `force_closure` false and `required` nullopt.
  bool judge_force_closure = true;
  const grasp::Grasp* start = nullptr;  ///< required initial grasp of the plan; null: any
  const grasp::Grasp* goal = nullptr;   ///< required goal of the plan; null: any
  /// Faults that the caller's check of the plan's hand found (sim/hand/check_hand.h). Each fails
  /// its entry if that has no other fault.
  std::vector<HandFault> hand_faults = {};
  /// Points of the object's file, for plans with `at_given_points`; null: do not check that
  /// contacts are at these points.
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
  /// Whether sliding steps pass with up to kMostUndecided undecided intervals in each motion
  /// between waypoints.
  bool allow_undecided = false;
};

/// Return the step with the largest required friction angle, the first of equal ones.
/// Not valid if no step that is not skipped has a required friction angle.
[[nodiscard]] EntryIndex WeakestStep(const std::vector<StepCheck>& steps);

/// Describe WeakestStep, with its required friction angle, for messages of all programs.
/// Empty if there is none.
/// @param friction_angle  friction angle of the check, radians.
[[nodiscard]] std::string WeakestStepText(const std::vector<StepCheck>& steps,
                                          double friction_angle);

struct PlanCheck {
  std::vector<StepCheck> steps;  ///< entry 0: the initial grasp; then one entry per step
  /// Plan on the surface, for the replay: every point is projected, every normal is that of its
  /// face, and faces are set. Contacts off the surface are unchanged and have face −1.
  Plan projected;
  [[nodiscard]] bool passed() const;
};

/// Check every rule of docs/formats.md for a plan, from the plan and the object alone.
///
/// The first failing step ends the check; later steps are `skipped`. Force closure along a sliding
/// step is decided over the whole path by proofs of its pieces, which are checked exactly
/// (path_force_closure.h). An instant that is too close to call is not force closure; an unproved
/// interval does not pass. The work on proofs is limited for the plan as a whole, by its size. If
/// the limit is reached, sliding steps fail as kNotProved.
///
/// Laws: independent of the fingers' numbering, of the order of contacts, of rigid motion and of
/// the unit of length. A larger friction angle never turns a pass into a fail. In proofs of a
/// motion on which the normal of a soft finger (Plan::torsion) turns, that finger counts as a
/// hard-finger contact. A sliding step that requires its torque there fails as kNotProved.
/// @throws InputError             if the plan's dimension differs from the object's, or a planar
///     plan has torsion.
/// @throws std::invalid_argument  if the friction angle is not in (0, π/2).
[[nodiscard]] PlanCheck CheckPlan(const object::Object& object, const Plan& plan,
                                  const CheckOptions& options = {});

/// Return the largest distance of a plan's contacts to the nearest of the given points.
/// @pre there is at least one point.
/// @returns a length in the object's unit.
[[nodiscard]] double FarthestFromPoints(const Plan& plan,
                                        const std::vector<Eigen::Vector3d>& points);

}  // namespace regrasp::plan
