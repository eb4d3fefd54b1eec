#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Bounds on a quality; lower <= Q <= upper.
struct QualityBounds {
  double lower = 0;
  double upper = 0;
  /// Facets of all convex hulls that were computed: the work.
  std::int64_t facets = 0;
};

/// For people, to `digits` significant digits: the lower bound where both are within 2 % of each
/// other, otherwise "at least …, at most …".
[[nodiscard]] std::string QualityText(const QualityBounds& quality, int digits = 4);

/// Bounds no farther apart than this are not refined: a hundredth of the smallest shake that anyone
/// asks a grasp to resist.
inline constexpr double kQualityGap = 1e-6;

/// A hull is the last one where this many facets were computed, some seconds of work. Counted, not
/// timed, so that the same grasp has the same bounds on every machine.
inline constexpr std::int64_t kMostQualityFacets = 300'000;

/// The quality ε of Ferrari and Canny 1992 (the L1 metric): the radius of the largest ball about
/// the origin inside the wrenches that contact forces with Σ n_i·f_i ≤ 1 can apply, torques over
/// R. 0 where the grasp is not force closure.
///
/// Laws: independent of order, rigid motion and unit of length; monotone in half_angle and in the
/// set of contacts.
/// @param relative_gap  the bounds are refined until upper − lower ≤ relative_gap · upper, or
///                      kQualityGap. They are farther apart where more than kMostQualityFacets
///                      would be needed, or where rounding keeps them apart.
[[nodiscard]] QualityBounds ComputeQuality(std::span<const Contact> contacts,
                                           const object::WrenchFrame& frame, double half_angle,
                                           double relative_gap = 0.01);

/// True iff ε ≥ threshold is certain after at most kMostQualityFacets; stops as soon as it is
/// decided, so it is far cheaper than ComputeQuality for grasps that are clearly better or worse.
[[nodiscard]] bool QualityAtLeast(std::span<const Contact> contacts,
                                  const object::WrenchFrame& frame, double half_angle,
                                  double threshold);

}  // namespace regrasp::grasp
