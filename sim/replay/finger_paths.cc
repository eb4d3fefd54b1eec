#include "sim/replay/finger_paths.h"

#include <algorithm>

namespace regrasp::sim {

using Eigen::Vector3d;
using object::SurfaceLeg;

namespace {

bool AreSame(const plan::FingerGrasp& a, const plan::FingerGrasp& b) {
  return std::ranges::equal(a, b, [](const auto& one, const auto& other) {
    return one.contact.p == other.contact.p && one.contact.face == other.contact.face;
  });
}

}  // namespace

void FingerPaths::Add(const plan::FingerContact& held, const std::vector<SurfaceLeg>& legs) {
  Way way{held, legs, {}};
  double length = 0;
  for (const SurfaceLeg& leg : legs) way.ends.push_back(length += (leg.to - leg.from).norm());
  for (double& end : way.ends) end = length > 0 ? end / length : 1;
  way.ends.back() = 1;
  paths_.push_back(std::move(way));
}

void FingerPaths::AppendTo(const object::Object& object,
                           std::vector<plan::FingerGrasp>& waypoints) const {
  std::vector<std::size_t> leg_of(paths_.size(), 0);
  const auto add_at = [&](double time) {
    plan::FingerGrasp grasp;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      const std::size_t k = leg_of[i];
      const SurfaceLeg& leg = paths_[i].legs[k];
      const double begin = k == 0 ? 0 : paths_[i].ends[k - 1], end = paths_[i].ends[k];
      const double share = end > begin ? (time - begin) / (end - begin) : 1;
      grasp.push_back(paths_[i].held);
      grasp.back().contact = {
          share >= 1 ? leg.to : Vector3d(leg.from + share * (leg.to - leg.from)),
          object.inward_normal(leg.face), leg.face, paths_[i].held.contact.torsion};
    }
    if (waypoints.empty() || !AreSame(waypoints.back(), grasp)) waypoints.push_back(grasp);
  };
  while (true) {
    // Finger that reaches a border next.
    std::size_t next = paths_.size();
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      if (leg_of[i] + 1 == paths_[i].legs.size()) continue;
      if (next < paths_.size() && paths_[i].ends[leg_of[i]] >= paths_[next].ends[leg_of[next]])
        continue;
      next = i;
    }
    if (next == paths_.size()) break;
    const double time = paths_[next].ends[leg_of[next]];
    add_at(time);
    ++leg_of[next];
    add_at(time);
  }
  add_at(1);
}

}  // namespace regrasp::sim
