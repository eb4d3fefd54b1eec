#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_evaluator.h"

namespace regrasp::tree {

/// Limits at which a search stops.
struct SearchLimits {
  std::int64_t most_tests = std::numeric_limits<std::int64_t>::max();
  Deadline deadline = {};
  /// Callback with the number of tests, called whenever the clock is read.
  std::function<void(std::int64_t tests)> on_check = [](std::int64_t) {};
};

/// Contacts and grasps of a search.
/// Contacts are numbered as they occur. A set of contacts is admitted if it is a grasp that a
/// sequence may contain, by the quick test of quality. Counts the tests, which are the search
/// budget.
class SearchSpace : public criteria::GraspMemory {
 public:
  /// @param object  object that outlives this space.
  SearchSpace(const object::Object& object, const criteria::GraspCriteria& criteria,
              const hand::Hand& hand = {});

  /// Number of usable fingers of the hand, at most the number that can hold at once.
  [[nodiscard]] int fingers() const { return fingers_; }

  /// Number of force-closure tests, including those of certificates and the cost of qualities.
  [[nodiscard]] std::int64_t tests() const;
  void CountTests(std::int64_t tests) { more_tests_ += tests; }
  void SetLimits(const SearchLimits& limits) { limits_ = limits; }
  /// Return whether the search must stop; reads the clock only occasionally.
  [[nodiscard]] bool IsSpent();
  [[nodiscard]] bool out_of_time() const { return out_of_time_; }

 private:
  int fingers_;
  std::int64_t more_tests_ = 0;  ///< tests that the memory does not count
  SearchLimits limits_;
  std::int64_t next_check_ = 0;  ///< number of tests at which the clock is read next
  bool out_of_time_ = false;
};

}  // namespace regrasp::tree
