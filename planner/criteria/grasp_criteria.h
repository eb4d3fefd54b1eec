#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp::grasp {
class QualityFilter;
}

namespace regrasp::criteria {

/// Criteria of a static grasp, in addition to the requirements of the hand (reach.h, CanMeet).
///
/// All planners evaluate grasps with GraspEvaluator, which calls the functions below.
/// A new criterion, such as a limit of the largest contact force, is a field here and a row of the
/// table in grasp_criteria.cc. All planners then apply it, relax it if they find no sequence, and
/// warn of grasps that do not meet it.
struct GraspCriteria {
  double friction_angle = 0;  ///< friction angle, radians in (0, π/2)
  /// Smallest grasp quality (grasp/quality.h) of random grasps. Sequences use such grasps if
  /// possible.
  double min_quality = 0.01;

  /// Return whether more than force closure is required.
  [[nodiscard]] bool AsksMore() const;
  /// Return relaxed criteria, with a share of the requirements beyond force closure.
  /// A share of 1 keeps all of them, 0 drops them.
  [[nodiscard]] GraspCriteria Relaxed(double share) const;
};

/// Return whether a force-closure grasp meets the criteria beyond force closure.
/// @param filter  fast test of the quality at the filter's friction angle, which also rejects a few
///     grasps just above the threshold; null: exact test.
[[nodiscard]] bool MeetsCriteria(std::span<const grasp::Contact> grasp,
                                 const object::WrenchFrame& frame, const GraspCriteria& criteria,
                                 grasp::QualityFilter* filter = nullptr);

/// Return how far a force-closure grasp is from criteria that it does not meet.
/// @returns value in [−1, 0); lower is worse.
[[nodiscard]] double Shortfall(std::span<const grasp::Contact> grasp,
                               const object::WrenchFrame& frame, const GraspCriteria& criteria);

/// Criterion that a grasp does not meet.
struct UnmetCriterion {
  std::string_view name;  ///< "quality"
  double asked = 0;       ///< required minimum
  double reached = 0;     ///< reached value
};
/// Return the criteria that a grasp does not meet, in table order.
[[nodiscard]] std::vector<UnmetCriterion> FindUnmet(std::span<const grasp::Contact> grasp,
                                                    const object::WrenchFrame& frame,
                                                    const GraspCriteria& criteria);

/// Format criteria for messages: " with a quality of at least 0.01".
/// The text is empty if only force closure is required.
[[nodiscard]] std::string WithWhatIsAsked(const GraspCriteria& criteria);

/// Distance over the diameter within which contacts coincide. It is twice the tolerance for
/// reading, so that no checker considers other contacts coincident after rounding.
inline constexpr double kSamePoint = 2 * object::kPointTolerance;

/// Return whether two fingers can be at two contacts at the same time.
/// The contacts must be farther apart than `same_point`, and the fingertips must not overlap
/// (KeepApart).
[[nodiscard]] bool CanMeet(const grasp::Contact& a, const grasp::Contact& b, double same_point,
                           double fingertip_radius);
/// Return whether fingers can be at all contacts of a grasp at the same time.
[[nodiscard]] bool CanAllMeet(std::span<const grasp::Contact> grasp, double same_point,
                              double fingertip_radius);

}  // namespace regrasp::criteria
