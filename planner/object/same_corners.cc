#include "planner/object/same_corners.h"

#include <algorithm>
#include <compare>
#include <cstdint>

namespace regrasp::object {

namespace {

/// A cycle of corners from its lowest one towards the lower of the two beside it.
class Cycle {
 public:
  Cycle() = default;
  Cycle(const std::vector<int>& corners, int facet) : corners_(&corners), facet_(facet) {
    const std::size_t size = corners.size();
    start_ = static_cast<std::size_t>(std::ranges::min_element(corners) - corners.begin());
    forward_ = corners[(start_ + 1) % size] < corners[(start_ + size - 1) % size];
    for (std::size_t k = 0; k < size; ++k) hash_ = (hash_ ^ std::uint64_t(at(k))) * kPrime;
  }

  [[nodiscard]] int facet() const { return facet_; }
  [[nodiscard]] bool forward() const { return forward_; }

  /// Any order that puts equal ones beside each other.
  friend std::weak_ordering operator<=>(const Cycle& a, const Cycle& b) {
    const auto rough =
        std::pair(a.hash_, a.corners_->size()) <=> std::pair(b.hash_, b.corners_->size());
    if (rough != 0) return rough;
    for (std::size_t k = 0; k < a.corners_->size(); ++k) {
      if (a.at(k) != b.at(k)) return a.at(k) <=> b.at(k);
    }
    return std::weak_ordering::equivalent;
  }
  friend bool operator==(const Cycle& a, const Cycle& b) { return (a <=> b) == 0; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3;  // of FNV-1a

  [[nodiscard]] int at(std::size_t k) const {
    const std::size_t size = corners_->size();
    return (*corners_)[(forward_ ? start_ + k : start_ + size - k) % size];
  }

  const std::vector<int>* corners_ = nullptr;
  std::size_t start_ = 0;
  std::uint64_t hash_ = 0xcbf29ce484222325;
  int facet_ = 0;
  bool forward_ = true;
};

}  // namespace

std::vector<RepeatedFacet> FindRepeatedFacets(const std::vector<std::vector<int>>& facets) {
  std::vector<Cycle> cycles;
  for (int f = 0; f < std::ssize(facets); ++f) {
    if (!facets[f].empty()) cycles.emplace_back(facets[f], f);
  }
  std::ranges::stable_sort(cycles, [](const Cycle& a, const Cycle& b) { return a < b; });
  std::vector<RepeatedFacet> repeated;
  for (std::size_t first = 0, i = 1; i < cycles.size(); ++i) {
    if (cycles[i] == cycles[first]) {
      repeated.push_back({cycles[i].facet(), cycles[first].facet(),
                          cycles[i].forward() == cycles[first].forward()});
    } else {
      first = i;
    }
  }
  std::ranges::sort(repeated, {},
                    [](const RepeatedFacet& r) { return std::pair(r.first, r.facet); });
  return repeated;
}

}  // namespace regrasp::object
