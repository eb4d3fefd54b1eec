#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "planner/base/deadline.h"
#include "planner/base/random.h"
#include "planner/object/object.h"
#include "planner/planning/grasp_choice.h"
#include "planner/planning/plan_result.h"

namespace regrasp {

/// What a sequence is made best in, once one is found.
enum class Objective {
  kSteps,   ///< the fewest steps found, then the largest margin of the weakest grasp
  kMargin,  ///< the largest margin, with a few steps more where they help
  kTravel,  ///< the fewest steps found, then the least way of all fingers together (TravelOf)
};

struct GeneralPlanOptions {
  double half_angle = 0;  ///< friction, radians
  std::uint64_t seed = 0;
  /// Quality that random grasps have at least, and the sequence's grasps where there is a way.
  double min_quality = 0.01;
  double finger_radius = 0;  ///< of fingers that are not points (reach.h), the object's unit
  Objective aim = Objective::kSteps;
  /// Force-closure tests after which a search gives up; about two microseconds each.
  std::int64_t effort = kDefaultEffort;
  /// When drawing and searching make an end; the plan then depends on the machine.
  Deadline deadline = {};
  /// Where there is no sequence: looks for the smallest friction at which one is found.
  bool explain = false;
  /// Told what is being done.
  std::function<void(std::string_view)> progress = [](std::string_view) {};

  static constexpr std::int64_t kDefaultEffort = 1'000'000;
};

/// Plans between any two force-closure grasps that the hand can hold, on any body, in space (three
/// to five contacts, a hand of five fingers) and in the plane (two to four contacts, four fingers),
/// with switches and aligns.
///
/// First the grasps of the two grasps' own contacts; then a tree from each, grown by switches with
/// contacts of the whole surface and by aligns, until they meet (BidirectionalTree). The sequence
/// is then shortened and widened. Every align on the way is proved to keep force closure.
///
/// No sequence found is no proof that there is none: the message says what was reached.
///
/// Laws: without a time limit the same arguments give the same plan, bit for bit; a goal equal to
/// the start as a set gives no steps.
/// @throws InputError             a given grasp does not serve (CheckGivenGrasp).
/// @throws std::invalid_argument  an option is out of its range.
[[nodiscard]] PlanResult PlanGeneral(const Object& object, const GraspChoice& start,
                                     const GraspChoice& goal, const GeneralPlanOptions& options);

/// A start or goal as PlanGeneral takes it: a given one checked, a random one drawn evenly over the
/// surface, of four contacts in space, in the plane of two or three by the seed.
/// @throws InputError  it does not serve. @throws NoGrasp  none was drawn.
[[nodiscard]] GraspChoice ResolveGrasp(const Object& object, const GraspChoice& choice,
                                       RandomUse use, const GeneralPlanOptions& options);

}  // namespace regrasp
