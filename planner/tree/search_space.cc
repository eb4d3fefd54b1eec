#include "planner/tree/search_space.h"

#include <algorithm>

namespace regrasp::tree {

namespace {

/// Number of tests between two readings of the clock, about a millisecond.
constexpr std::int64_t kTestsBetweenChecks = 500;

/// Cost of ray shooting for a quality, in force-closure tests.
constexpr std::int64_t kShotCost = 40;

}  // namespace

SearchSpace::SearchSpace(const object::Object& object, const criteria::GraspCriteria& criteria,
                         const hand::Hand& hand)
    : criteria::GraspMemory(object, criteria, hand, criteria::QualityTest::kQuick),
      fingers_(std::min(hand.FingersIn(object.dimension()), criteria::ContactSet::kMostHeld)) {}

std::int64_t SearchSpace::tests() const {
  return counts().force_closure + kShotCost * shot_count() + more_tests_;
}

bool SearchSpace::IsSpent() {
  if (tests() >= next_check_) {
    next_check_ = tests() + kTestsBetweenChecks;
    out_of_time_ = limits_.deadline.IsOver();
    limits_.on_check(tests());
  }
  return out_of_time_ || tests() >= limits_.most_tests;
}

}  // namespace regrasp::tree
