#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_memory.h"

namespace regrasp::tree {

/// When a search gives up.
struct SearchLimits {
  std::int64_t most_tests = std::numeric_limits<std::int64_t>::max();
  Deadline deadline = {};
  /// Told how many tests were done, at every look at the clock.
  std::function<void(std::int64_t tests)> on_look = [](std::int64_t) {};
};

/// What a search may look at: contacts as they come up, numbered, and which sets of them are grasps
/// that a sequence may pass, by the quick test of quality. Counts what it tests,
/// which is what searches spend.
class SearchSpace : public criteria::GraspMemory {
 public:
  /// @param object  outlives this object.
  SearchSpace(const object::Object& object, const criteria::GraspCriteria& criteria,
              const hand::Hand& hand = {});

  /// Fingers of the hand that may be used: all of it, but no more than hold at once.
  [[nodiscard]] int fingers() const { return fingers_; }

  /// Tests of force closure so far, those of certificates included, and what qualities cost.
  [[nodiscard]] std::int64_t tests() const;
  void CountTests(std::int64_t tests) { more_tests_ += tests; }
  void SetLimits(const SearchLimits& limits) { limits_ = limits; }
  /// Whether the search has to give up. Looks at the clock now and then only.
  [[nodiscard]] bool IsSpent();
  [[nodiscard]] bool out_of_time() const { return out_of_time_; }

 private:
  int fingers_;
  std::int64_t more_tests_ = 0;  ///< that the memory does not count
  SearchLimits limits_;
  std::int64_t next_look_ = 0;  ///< at the clock, by tests
  bool out_of_time_ = false;
};

}  // namespace regrasp::tree
