#include "planner/criteria/clearance.h"

#include <algorithm>
#include <vector>

namespace regrasp::criteria {
namespace {

/// A surface point counts as inside the ball only this much nearer than its radius: the contact
/// itself is at the radius up to rounding.
constexpr double kInside = 1 - 1e-9;

/// The radius falls by at least the relative kInside in each round and in practice halves; the
/// bound only guards against rounding that never settles.
constexpr int kMostRounds = 100;

/// Faces farther from the centre of a ball than this share of its radius don't meet it: those that
/// the contact lies on are at the radius.
constexpr double kTouches = 1 - 1e-6;

}  // namespace

double ComputeClearance(const object::Object& object, const grasp::Contact& contact, double limit) {
  double radius = limit;
  for (int round = 0; round < kMostRounds; ++round) {
    const Eigen::Vector3d centre = contact.p - radius * contact.n;
    double shrunk = radius;
    for (const FaceIndex face : object.FacesNear(centre, radius * kInside)) {
      if (face == contact.face) continue;
      const Eigen::Vector3d to_point = object.ClosestPoint(face, centre) - contact.p;
      const double depth = -contact.n.dot(to_point);
      if (depth <= 0) continue;
      shrunk = std::min(shrunk, to_point.squaredNorm() / (2 * depth));
    }
    if (shrunk == radius) break;
    radius = shrunk;
  }
  return radius;
}

bool HasClearance(const object::Object& object, const grasp::Contact& contact) {
  const double radius = kFingertipClearance * object.diameter();
  const auto near = object.FacesNear(contact.p - radius * contact.n, kTouches * radius);
  return std::ranges::all_of(near, [&](FaceIndex face) { return face == contact.face; });
}

bool CanRest(const object::Object& object, const grasp::Contact& contact) {
  return HasClearance(object, contact) && !object.IsRough(contact.face, contact.p);
}

}  // namespace regrasp::criteria
