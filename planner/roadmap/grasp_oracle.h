#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp {

/// One number for a grasp of four contact points, smaller than 2¹⁶ each.
[[nodiscard]] constexpr std::uint64_t GraspKey(const Quadruple& ascending) {
  std::uint64_t key = 0;
  for (const int contact : ascending) key = key << 16 | static_cast<std::uint64_t>(contact);
  return key;
}
inline constexpr int kMostOracleContacts = 1 << 16;

/// Says whether a sequence may pass a grasp of four contact points: worked out when first asked,
/// then remembered.
class GraspOracle {
 public:
  /// @param contacts    outlive this object; at most kMostOracleContacts.
  /// @param half_angle  radians.
  /// @param same_point  contacts no farther apart than this stand in no grasp.
  /// @param is_good  asked of force-closure grasps; empty: all are.
  /// @param finger_radius  fingers of this radius that overlap at two contacts hold no grasp.
  GraspOracle(const std::vector<Contact>& contacts, const WrenchFrame& frame, double half_angle,
              double same_point, std::function<bool(const Grasp&)> is_good = {},
              double finger_radius = 0);

  [[nodiscard]] bool Admits(const Quadruple& ascending);
  /// Whether two contacts are at one point, or too close for two fingers: then a finger can't take
  /// the one before another leaves the other.
  [[nodiscard]] bool ExcludeEachOther(int a, int b) const;

  [[nodiscard]] Grasp GraspOf(const Quadruple& contacts) const;

  /// Grasps tested for force closure so far, and force-closure grasps asked whether they are good.
  [[nodiscard]] std::int64_t test_count() const { return test_count_; }
  [[nodiscard]] std::int64_t good_count() const { return good_count_; }

 private:
  [[nodiscard]] bool Test(const Quadruple& grasp);

  const std::vector<Contact>& contacts_;
  WrenchFrame frame_;
  double half_angle_;
  double same_point_;
  std::function<bool(const Grasp&)> is_good_;
  double finger_radius_;
  std::unordered_map<std::uint64_t, bool> known_;
  std::int64_t test_count_ = 0;
  std::int64_t good_count_ = 0;
};

}  // namespace regrasp
