#include "planner/roadmap/sample_elimination.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regrasp {

namespace {

// The parameters that the paper recommends.
constexpr int kAlpha = 8;
constexpr double kBeta = 0.65;
constexpr double kGamma = 1.5;

/// How strongly two contacts crowd each other, as a function of their distance.
class Crowding {
 public:
  Crowding(std::size_t from, int to, double area)
      : reach_(2 * LargestRadius(to, area)),
        floor_(reach_ * (1 - std::pow(double(to) / double(from), kGamma)) * kBeta) {}

  [[nodiscard]] double operator()(const Contact& a, const Contact& b) const {
    const double distance = (a.p - b.p).norm();
    if (distance >= reach_ || a.n.dot(b.n) < std::cos(kOppositeAngle)) return 0;
    return std::pow(1 - std::max(distance, floor_) / reach_, kAlpha);
  }

 private:
  /// Of `count` equal discs in the densest packing on the area.
  static double LargestRadius(int count, double area) {
    return std::sqrt(area / (2 * std::numbers::sqrt3 * count));
  }

  double reach_;
  double floor_;
};

}  // namespace

std::vector<Contact> EliminateSamples(const std::vector<Contact>& contacts, int count,
                                      double area) {
  if (contacts.size() <= static_cast<std::size_t>(count)) return contacts;
  const Crowding crowding(contacts.size(), count, area);
  std::vector<std::size_t> kept;
  std::vector<double> weight(contacts.size(), 0);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    kept.push_back(i);
    for (std::size_t j = 0; j < i; ++j) {
      const double w = crowding(contacts[i], contacts[j]);
      weight[i] += w;
      weight[j] += w;
    }
  }
  while (kept.size() > static_cast<std::size_t>(count)) {
    const auto heaviest = std::max_element(kept.begin(), kept.end(),
                                           [&](auto a, auto b) { return weight[a] < weight[b]; });
    const std::size_t gone = *heaviest;
    kept.erase(heaviest);
    for (const std::size_t i : kept) weight[i] -= crowding(contacts[i], contacts[gone]);
  }
  std::vector<Contact> result;
  for (const std::size_t i : kept) result.push_back(contacts[i]);
  return result;
}

}  // namespace regrasp
