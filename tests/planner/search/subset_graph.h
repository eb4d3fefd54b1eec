#pragma once

#include <algorithm>
#include <bit>
#include <random>
#include <vector>

#include "planner/search/switching_graph.h"

namespace regrasp::search {

/// Small graph whose vertices are 4-subsets of a set, given as bits. Subsets that share three
/// elements are connected, as in a roadmap.
class SubsetGraph final : public SwitchingGraph {
 public:
  explicit SubsetGraph(std::vector<unsigned> sets) : sets_(std::move(sets)) {}

  /// Keep each 4-subset of `things` with probability `density`.
  static SubsetGraph Random(int things, double density, std::mt19937& random) {
    std::vector<unsigned> sets;
    std::bernoulli_distribution keep(density);
    for (unsigned set = 0; set < (1u << things); ++set) {
      if (std::popcount(set) == 4 && keep(random)) sets.push_back(set);
    }
    return SubsetGraph(std::move(sets));
  }

  [[nodiscard]] int vertex_count() const override { return static_cast<int>(sets_.size()); }

  void GetNeighbours(int vertex, std::vector<int>& neighbours) const override {
    neighbours.clear();
    for (int other = 0; other < vertex_count(); ++other) {
      if (MinSwitches(vertex, other) == 1) neighbours.push_back(other);
    }
  }

  [[nodiscard]] int MinSwitches(int from, int to) const override {
    return std::popcount(sets_[from] & ~sets_[to]);
  }

 private:
  std::vector<unsigned> sets_;
};

}  // namespace regrasp::search
