#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::grasp {

/// Decide for many grasps of one object, cheaply, whether their quality reaches a threshold.
///
/// In the direction of a unit twist, a grasp's wrenches (quality.h) reach as far as those of the
/// contact that reaches farthest. If that is less than the threshold, so is the quality. The filter
/// stores twists that refuted a grasp. They refute most other insufficient grasps, a hundred times
/// faster than ray shooting.
class QualityFilter {
 public:
  /// @param friction_angle  friction angle in radians.
  QualityFilter(const object::WrenchFrame& frame, double friction_angle);

  /// Return true only if ε ≥ threshold is certain.
  /// False if ε is smaller, and also for some grasps just above the threshold. Takes at most 0.2
  /// ms.
  /// @param grasp  contacts that are force closure at the friction angle.
  /// @param threshold  threshold above 0.
  [[nodiscard]] bool IsClearlyAtLeast(std::span<const Contact> grasp, double threshold);

  /// Number of grasps that required ray shooting.
  [[nodiscard]] std::int64_t shot_count() const { return shot_count_; }

 private:
  /// Twist; planar twists use the first three numbers.
  using Twist = Eigen::Matrix<double, 6, 1>;

  template <int kDim>
  [[nodiscard]] bool Decide(const UnitContacts& contacts, double threshold);
  template <int kDim>
  [[nodiscard]] bool IsRefuted(const UnitContacts& contacts, double threshold);

  object::WrenchFrame frame_;
  double friction_angle_;
  /// Stored twists; those that refuted a grasp recently are nearer to the front.
  std::vector<Twist> twists_;
  std::int64_t shot_count_ = 0;
};

}  // namespace regrasp::grasp
