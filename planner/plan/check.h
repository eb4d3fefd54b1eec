#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/grasp/required_half_angle.h"
#include "planner/object/object.h"
#include "planner/plan/locate.h"  // IWYU pragma: export
#include "planner/plan/plan.h"
#include "planner/plan/reason.h"

namespace regrasp::plan {

/// What the analytic check says of one entry of the report: the initial hold or a step.
struct StepCheck {
  EntryIndex index{0};
  std::string kind;  ///< "hold", or as StepKind
  Reason reason = Reason::kNone;
  std::string detail;    ///< for people: which finger, which waypoint, how far off
  Fault fault;           ///< the same for a picture
  bool skipped = false;  ///< a step before it failed
  /// Every grasp of the step, everywhere on the path, is proved to be force closure at the friction
  /// (with CheckOptions::allow_undecided: but for `undecided` intervals). False, and `required`
  /// nullopt, also where the step is skipped or has a fault that comes before force closure: then
  /// there is no sequence of grasps to evaluate.
  bool force_closure = false;
  /// The smallest half-angle at which every grasp of the step is force closure; nullopt where none.
  /// Where `force_closure` is true by proofs alone, `upper` is no larger than the friction's.
  std::optional<grasp::RequiredHalfAngle> required;
  /// Intervals of an align's path, each no longer than 1e-6 of the path between two waypoints, on
  /// which force closure stayed undecided: no proof was found, and no instant that is not force
  /// closure. They fail the step (kNotProved) unless CheckOptions::allow_undecided is set.
  int undecided = 0;
};

/// What a check of a plan's hand found: the first fault of an entry.
struct HandFault {
  EntryIndex entry{0};
  Reason reason = Reason::kNone;
  std::string detail;  ///< as in StepCheck
  Fault fault = {};
};

struct CheckOptions {
  std::optional<double> half_angle = std::nullopt;  ///< instead of the plan's friction, radians
  /// Of the contacts, the object's unit of length, instead of the plan's; 0: hard points.
  std::optional<double> torsion = std::nullopt;
  /// Fingers have this radius (reach.h), the object's unit of length, instead of the plan's; points
  /// where neither says.
  std::optional<double> finger_radius = std::nullopt;
  /// False: everything but force closure, which is then false and `required` nullopt everywhere.
  bool judge_force_closure = true;
  const grasp::Grasp* start = nullptr;  ///< the plan's initial grasp must be this one
  const grasp::Grasp* goal = nullptr;   ///< and its goal this one
  /// Found by whoever checks the hand that the plan is for (sim/hand/check_hand.h); each fails its
  /// entry, where that has no other fault.
  std::vector<HandFault> hand_faults = {};
  /// The points that the object's file gives, for plans that are `at_given_points`; null: whether
  /// contacts are there is not asked.
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
  /// Aligns pass with up to kMostUndecided undecided intervals in each motion between waypoints.
  bool allow_undecided = false;
};

/// The step that needs the largest half-angle, the first of equal ones; not valid where no step
/// that is not skipped needs one.
[[nodiscard]] EntryIndex WeakestStep(const std::vector<StepCheck>& steps);

/// "step 1 (align), which needs a friction half-angle of 7.34 of 20.00 degrees", of WeakestStep;
/// empty where there is none. All programs say it so.
/// @param half_angle  that was checked against, radians.
[[nodiscard]] std::string WeakestStepText(const std::vector<StepCheck>& steps, double half_angle);

struct PlanCheck {
  std::vector<StepCheck> steps;  ///< entry 0 the hold, then one per step
  /// The plan on the surface: every point projected, every normal its face's own, faces filled in
  /// (−1 and unchanged where a contact is off the surface). What the replay uses.
  Plan located;
  [[nodiscard]] bool passed() const;
};

/// Checks everything that docs/formats.md says of a plan, from the plan and the object alone.
///
/// The first failing step ends the check; later ones are `skipped`. Force closure along an align is
/// decided over the whole path by proofs of its pieces, checked exactly (path_force_closure.h).
/// What is too close to call at an instant is not force closure; what is not proved does not pass.
/// The work on proofs is limited for the plan as a whole, by its size; where the limit is reached
/// aligns fail as kNotProved.
///
/// Laws: independent of the fingers' numbering and of the order of contacts, of rigid motion and of
/// the unit of length; enlarging the friction never turns pass into fail.
/// A soft finger (Plan::torsion) counts as a hard point in the proofs of a motion on which its
/// normal turns: an align that needs its torque there fails as kNotProved.
/// @throws InputError             the plan's dimension is not the object's, or it is planar and has
///                                torsion.
/// @throws std::invalid_argument  the friction half-angle is not in (0, π/2).
[[nodiscard]] PlanCheck CheckPlan(const object::Object& object, const Plan& plan,
                                  const CheckOptions& options = {});

/// The largest distance of a plan's contacts to the nearest of the given points, the object's unit
/// of length. @pre there is a point.
[[nodiscard]] double FarthestFromPoints(const Plan& plan,
                                        const std::vector<Eigen::Vector3d>& points);

}  // namespace regrasp::plan
