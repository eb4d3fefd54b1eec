#include "sim/scene/align_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace regrasp::sim {

namespace {

/// The fingers of `to` in the order of `from`.
plan::FingerGrasp InOrderOf(const plan::FingerGrasp& from, const plan::FingerGrasp& to) {
  plan::FingerGrasp ordered;
  for (const plan::FingerContact& held : from) {
    const plan::FingerContact* match = plan::FindFinger(to, held.finger);
    ordered.push_back(match == nullptr ? held : *match);
  }
  return ordered;
}

}  // namespace

plan::FingerGrasp Interpolate(const plan::FingerGrasp& from, const plan::FingerGrasp& to,
                              double share) {
  if (share >= 1) return to;
  plan::FingerGrasp between = to;
  for (std::size_t i = 0; i < to.size(); ++i) {
    const grasp::Contact& a = from[i].contact;
    grasp::Contact& c = between[i].contact;
    c.p = (1 - share) * a.p + share * c.p;
    if (a.face == c.face) continue;
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(a.n, c.n);
    c.n = (Eigen::Quaterniond::Identity().slerp(share, turn) * a.n).normalized();
    c.face = a.face;
  }
  return between;
}

AlignPath::AlignPath(const plan::Align& align) {
  assert(!align.waypoints.empty());
  for (const plan::FingerGrasp& waypoint : align.waypoints) {
    waypoints_.push_back(InOrderOf(align.waypoints.front(), waypoint));
  }
}

plan::FingerGrasp AlignPath::At(double t) const {
  const int from = std::clamp(static_cast<int>(std::floor(t)), 0, end());
  if (from == end()) return waypoints_.back();
  return Interpolate(waypoints_[from], waypoints_[from + 1], t - from);
}

double AlignPath::Travel(double from, double to) const {
  double travel = 0;
  while (from < to) {
    const double next = std::min(std::floor(from) + 1, to);
    const plan::FingerGrasp a = At(from), b = At(next);
    for (std::size_t k = 0; k < a.size(); ++k) {
      travel += (b[k].contact.p - a[k].contact.p).norm();
    }
    from = next;
  }
  return travel;
}

bool AlignPath::IsTurning(std::size_t k, double t) const {
  const int from = static_cast<int>(std::floor(t));
  if (from < 0 || from >= end() || t == from) return false;
  return waypoints_[from][k].contact.face != waypoints_[from + 1][k].contact.face;
}

}  // namespace regrasp::sim
