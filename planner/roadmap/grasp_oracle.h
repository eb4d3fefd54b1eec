#pragma once

#include <cstdint>
#include <span>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/grasp/contact.h"
#include "planner/object/wrench_frame.h"
#include "planner/roadmap/roadmap.h"

namespace regrasp::roadmap {

/// One number for a grasp of four contact points, smaller than 2¹⁶ each.
[[nodiscard]] constexpr std::uint64_t GraspKey(const Quadruple& ascending) {
  std::uint64_t key = 0;
  for (const int contact : ascending) key = key << 16 | static_cast<std::uint64_t>(contact);
  return key;
}

/// Says whether a sequence may pass a grasp of four contact points: a GraspMemory that is asked by
/// quadruples, and that makes an end in time.
class GraspOracle {
 public:
  /// @param contacts    at most ContactSet::kMostNumbers.
  /// @param same_point  contacts no farther apart than this are at one point.
  /// @throws std::invalid_argument  there are more contacts.
  GraspOracle(std::span<const grasp::Contact> contacts, const object::WrenchFrame& frame,
              double same_point, const criteria::GraspCriteria& criteria,
              const hand::Hand& hand = {}, Deadline deadline = {});

  /// @throws TimeUp  the deadline came.
  [[nodiscard]] bool Admits(const Quadruple& ascending);
  /// Whether two contacts are at one point, or too close for two fingers: then a finger can't take
  /// the one before another leaves the other.
  [[nodiscard]] bool ExcludeEachOther(int a, int b) const { return !memory_.CanMeet(a, b); }

  [[nodiscard]] grasp::Grasp GraspOf(const Quadruple& contacts) const;

  /// From now on grasps are asked to be of this quality; what is known of them stays known.
  void SetMinQuality(double min_quality) { memory_.SetMinQuality(min_quality); }
  [[nodiscard]] const criteria::GraspMemory::Counts& counts() const { return memory_.counts(); }

 private:
  criteria::GraspMemory memory_;
  Deadline deadline_;
};

}  // namespace regrasp::roadmap
