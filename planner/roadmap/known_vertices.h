#pragma once

#include <deque>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"

namespace regrasp::roadmap {

/// What is known of the vertices of a roadmap, of which there are millions and few are asked for: a
/// number for each vertex, a KnownGrasp for those asked for.
class KnownVertices {
 public:
  /// @param initial  what is known of every vertex before it is asked for.
  KnownVertices(int vertex_count, const criteria::KnownGrasp& initial)
      : initial_(initial), place_(vertex_count, -1) {}

  criteria::KnownGrasp& operator[](int vertex) {
    int& place = place_[vertex];
    if (place < 0) {
      place = static_cast<int>(known_.size());
      known_.push_back(initial_);
    }
    return known_[place];
  }

 private:
  criteria::KnownGrasp initial_;
  std::vector<int> place_;  ///< in `known_`; −1 where not asked for
  std::deque<criteria::KnownGrasp> known_;
};

}  // namespace regrasp::roadmap
