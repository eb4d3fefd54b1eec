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

/// What is asked of a grasp that a hand is to rest in, beside what the hand itself asks
/// (clearance.h, reach.h, CanMeet).
///
/// Every planner decides through GraspEvaluator whether a grasp is good enough, and that by the
/// functions below. A new criterion (a limit of the largest contact force, say) is a field here and
/// a row of the table in grasp_criteria.cc: all planners then obey it, ask for less of it where
/// they find no sequence otherwise, and warn of grasps that do not meet it.
struct GraspCriteria {
  double half_angle = 0;  ///< of the friction cones, radians in (0, π/2)
  /// Quality (grasp/quality.h) that random grasps have at least. A sequence keeps to such grasps
  /// where it can.
  double min_quality = 0.01;

  /// Whether more is asked for than force closure.
  [[nodiscard]] bool AsksMore() const;
  /// The same with a share of what is asked for beyond force closure: of 1 all of it, of 0 nothing.
  [[nodiscard]] GraspCriteria Relaxed(double share) const;
};

/// Whether a force-closure grasp meets what is asked for beyond force closure.
/// @param filter  decides the quality quickly, at its own half-angle, and refuses a few grasps just
///                above the threshold too; null: exactly.
[[nodiscard]] bool MeetsCriteria(std::span<const grasp::Contact> grasp,
                                 const object::WrenchFrame& frame, const GraspCriteria& criteria,
                                 grasp::QualityFilter* filter = nullptr);

/// How far a force-closure grasp that does not meet the criteria is from them: in [−1, 0), the
/// worse the lower.
[[nodiscard]] double Shortfall(std::span<const grasp::Contact> grasp,
                               const object::WrenchFrame& frame, const GraspCriteria& criteria);

/// A criterion that a grasp does not meet.
struct UnmetCriterion {
  std::string_view name;  ///< "quality"
  double asked = 0;       ///< at least so much
  double reached = 0;     ///< less than that
};
/// Those that a grasp does not meet, in the order of the table.
[[nodiscard]] std::vector<UnmetCriterion> FindUnmet(std::span<const grasp::Contact> grasp,
                                                    const object::WrenchFrame& frame,
                                                    const GraspCriteria& criteria);

/// For messages: " with a quality of at least 0.01"; empty where nothing is asked for beyond force
/// closure.
[[nodiscard]] std::string WithWhatIsAsked(const GraspCriteria& criteria);

/// Contacts this close, relative to the diameter, are at the same point: twice the tolerance for
/// reading, so that no checker takes them for coincident after rounding.
inline constexpr double kSamePoint = 2 * object::kPointTolerance;

/// Whether two fingers can be at two contacts at once: they are farther apart than `same_point`,
/// and the fingertips do not overlap (KeepApart).
[[nodiscard]] bool CanMeet(const grasp::Contact& a, const grasp::Contact& b, double same_point,
                           double fingertip_radius);
/// Whether fingers can be at all contacts of a grasp at once.
[[nodiscard]] bool CanAllMeet(std::span<const grasp::Contact> grasp, double same_point,
                              double fingertip_radius);

}  // namespace regrasp::criteria
