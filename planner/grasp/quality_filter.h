#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Decides for many grasps of one object, cheaply, whether their quality at a half-angle reaches a
/// threshold.
///
/// In the direction of a unit twist a grasp's wrenches (quality.h) reach as far as those of the
/// contact that reaches farthest; where that is less than the threshold, so is the quality. Twists
/// that refuted a grasp are remembered and refute most others that are not good enough, a hundred
/// times faster than rays are shot.
class QualityFilter {
 public:
  /// @param half_angle  friction, radians.
  QualityFilter(const object::WrenchFrame& frame, double half_angle);

  /// True only if ε ≥ threshold is certain; false where it is not so, and for a few grasps just
  /// above the threshold too. Takes a fifth of a millisecond at most.
  /// @param grasp  force closure at the half-angle. @param threshold  above 0.
  [[nodiscard]] bool IsClearlyAtLeast(std::span<const Contact> grasp, double threshold);

  /// Grasps for which rays were shot.
  [[nodiscard]] std::int64_t shot_count() const { return shot_count_; }

 private:
  /// Of a plane's twists the first three numbers.
  using Twist = Eigen::Matrix<double, 6, 1>;

  template <int kDim>
  [[nodiscard]] bool Decide(const UnitContacts& contacts, double threshold);
  template <int kDim>
  [[nodiscard]] bool IsRefuted(const UnitContacts& contacts, double threshold);

  object::WrenchFrame frame_;
  double half_angle_;
  std::vector<Twist> twists_;  ///< those that refuted something lately nearer to the front
  std::int64_t shot_count_ = 0;
};

}  // namespace regrasp::grasp
