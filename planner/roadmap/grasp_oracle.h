#pragma once

#include <cstdint>
#include <span>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_memory.h"
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
class GraspOracle : public criteria::GraspMemory {
 public:
  /// @param object    outlives this object.
  /// @param contacts  at most ContactSet::kMostNumbers.
  /// @throws std::invalid_argument  there are more contacts.
  GraspOracle(const object::Object& object, std::span<const grasp::Contact> contacts,
              const criteria::GraspCriteria& criteria, const hand::Hand& hand = {},
              Deadline deadline = {});

  /// @throws TimeUp  the deadline came.
  [[nodiscard]] bool Admits(const Quadruple& ascending);

 private:
  Deadline deadline_;
};

}  // namespace regrasp::roadmap
