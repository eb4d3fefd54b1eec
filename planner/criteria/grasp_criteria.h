#pragma once

#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {
class QualityFilter;
}

namespace regrasp::criteria {

/// What is asked of a grasp that a hand is to rest in, beside what the hand itself asks
/// (clearance.h, reach.h, CanMeet).
///
/// Every planner decides by the functions below whether a grasp is good enough: the sets of grasps
/// and the drawing through GraspEvaluator, the searches over numbered contacts through GraspMemory.
/// A new criterion (a limit of the largest contact force, say) is a field here and a line in
/// AsksMore, MeetsCriteria and Shortfall, and all planners obey it.
struct GraspCriteria {
  double half_angle = 0;  ///< of the friction cones, radians in (0, π/2)
  /// Quality (grasp/quality.h) that random grasps have at least. A sequence keeps to such grasps
  /// where it can.
  double min_quality = 0.01;

  /// Whether more is asked for than force closure.
  [[nodiscard]] bool AsksMore() const { return min_quality > 0; }
};

/// Whether a force-closure grasp meets what is asked for beyond force closure.
/// @param filter  decides the quality quickly, at its own half-angle, and refuses a few grasps just
///                above the threshold too; null: exactly.
[[nodiscard]] bool MeetsCriteria(const grasp::Grasp& grasp, const object::WrenchFrame& frame,
                                 const GraspCriteria& criteria,
                                 grasp::QualityFilter* filter = nullptr);

/// How far a force-closure grasp that does not meet the criteria is from them: in [−1, 0), the
/// worse the lower.
[[nodiscard]] double Shortfall(const grasp::Grasp& grasp, const object::WrenchFrame& frame,
                               const GraspCriteria& criteria);

/// Contacts this close, relative to the diameter, are at the same point: twice the tolerance for
/// reading, so that no checker takes them for coincident after rounding.
inline constexpr double kSamePoint = 2 * object::kPointTolerance;

/// Whether two fingers can be at two contacts at once: they are farther apart than `same_point`,
/// and the fingertips do not overlap (KeepApart).
[[nodiscard]] bool CanMeet(const grasp::Contact& a, const grasp::Contact& b, double same_point,
                           double fingertip_radius);
/// Whether fingers can be at all contacts of a grasp at once.
[[nodiscard]] bool CanAllMeet(const grasp::Grasp& grasp, double same_point,
                              double fingertip_radius);

}  // namespace regrasp::criteria
