#include "planner/grasp/pair_line.h"

#include <cmath>

namespace regrasp::grasp {
namespace {

/// Torque that may be rounding, for lengths and forces of the order of 1. A hundred times the
/// rounding of the cross product, the dot products and the coordinates.
constexpr double kTorqueRounding = 1e-13;

}  // namespace

Turn TurnAboutLine(const UnitContact& a, const UnitContact& b, const UnitContact& c) {
  const Eigen::Vector3d line = b.q - a.q;
  const double length_squared = line.squaredNorm();
  if (length_squared <= kOnLine * kOnLine) return Turn::kUnclear;  // coincident: no line
  const Eigen::Vector3d u = line.cross(c.q - a.q);
  if (u.squaredNorm() <= kOnLine * kOnLine * length_squared) return Turn::kNone;
  const double along = c.n.dot(u);
  const double normal = std::abs(c.axial * along);
  const double sliding_squared = c.tangential * c.tangential * (u - along * c.n).squaredNorm();
  // |normal − sliding| > rounding without a square root: x² − y² = (x − y)(x + y).
  const double difference = normal * normal - sliding_squared;
  if (difference > 2 * kTorqueRounding * normal) {
    return along > 0 ? Turn::kPositive : Turn::kNegative;
  }
  const double sliding = std::sqrt(sliding_squared);
  return sliding - normal > kTorqueRounding ? Turn::kBoth : Turn::kUnclear;
}

bool IsAntipodal(const UnitContact& a, const UnitContact& b) {
  const Eigen::Vector3d d = b.q - a.q;
  const double along_a = a.n.dot(d);
  const double along_b = -b.n.dot(d);
  if (!(along_a * along_b > 0)) return false;
  const double sliding_a = (d - along_a * a.n).norm();
  const double sliding_b = (d + along_b * b.n).norm();
  return a.tangential * std::abs(along_a) - a.axial * sliding_a > kTorqueRounding &&
         b.tangential * std::abs(along_b) - b.axial * sliding_b > kTorqueRounding;
}

PairLineVerdict TestPairLines(std::span<const UnitContact> contacts) {
  bool accepted = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      bool positive = false;
      bool negative = false;
      bool unclear = false;
      for (std::size_t m = 0; m < contacts.size(); ++m) {
        if (m == i || m == j) continue;
        switch (TurnAboutLine(contacts[i], contacts[j], contacts[m])) {
          case Turn::kPositive:
            positive = true;
            break;
          case Turn::kNegative:
            negative = true;
            break;
          case Turn::kBoth:
            positive = negative = true;
            break;
          case Turn::kNone:
            break;
          case Turn::kUnclear:
            unclear = true;
            break;
        }
        if (positive && negative) break;
      }
      if (positive && negative) {
        accepted = accepted || IsAntipodal(contacts[i], contacts[j]);
      } else if (!unclear) {
        return PairLineVerdict::kNo;
      }
    }
  }
  return accepted ? PairLineVerdict::kYes : PairLineVerdict::kOpen;
}

}  // namespace regrasp::grasp
