#include "planner/criteria/reach.h"

#include <algorithm>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::criteria {

namespace {

/// Relative radius within which a surface point is inside the sphere. The contact itself is at the
/// radius up to rounding.
constexpr double kInside = 1 - 1e-9;

/// Largest number of rounds. The radius typically halves per round and falls at least by the
/// relative kInside; the limit only guards against rounding that never converges.
constexpr int kMostRounds = 100;

/// Relative radius within which other faces intersect the sphere. Faces through the contact are at
/// the radius.
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

using Eigen::Vector3d;

namespace {

/// Tolerances for faces and fingers that touch without overlap: relative for computed distances,
/// and in diameters for their coordinates.
constexpr double kTouchesInside = 1 - 1e-9;
constexpr double kRounding = 1e-12;

/// Accuracy of the free path length in messages, over the diameter.
constexpr double kDistanceAccuracy = 1e-4;
constexpr int kDistanceDigits = 3;

/// Unit of radii in messages.
constexpr char kUnits[] = " (units of the object file)";

/// Return true iff another face enters the capsule that a finger sweeps during the last `travel`
/// before contact.
bool IsBlocked(const object::Object& object, const grasp::Contact& contact, double radius,
               double travel) {
  const Vector3d rest = BallCentre(contact, radius);
  const double within = std::max(kTouchesInside * radius - kRounding * object.diameter(), 0.0);
  const auto near = object.FacesNearSegment(rest, rest - travel * contact.n, within);
  return std::ranges::any_of(near, [&](FaceIndex face) { return face != contact.face; });
}

/// Return whether a contact is in a sealed cavity.
bool IsShutIn(const object::Object& object, const grasp::Contact& contact) {
  return contact.face.valid() && object.IsEnclosed(contact.face);
}

}  // namespace

Vector3d BallCentre(const grasp::Contact& contact, double radius) {
  return contact.p - radius * contact.n;
}

bool CanReach(const object::Object& object, const grasp::Contact& contact, double radius) {
  if (IsShutIn(object, contact)) return false;
  return radius <= 0 || !IsBlocked(object, contact, radius, object.diameter());
}

bool KeepApart(std::span<const grasp::Contact> contacts, double radius) {
  if (radius <= 0) return true;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      const Vector3d between = BallCentre(contacts[i], radius) - BallCentre(contacts[j], radius);
      if (between.norm() < kTouchesInside * 2 * radius) return false;
    }
  }
  return true;
}

namespace {

void CheckLength(const object::Object& object, double length, const std::string& name) {
  if (length <= object.diameter()) return;
  throw InputError(name + ": must be at most the object's diameter of " +
                   FormatShort(object.diameter()) + kUnits + ", found " + FormatShort(length));
}

}  // namespace

void CheckFingerRadius(const object::Object& object, double radius, const std::string& name) {
  CheckLength(object, radius, name);
}

void CheckTorsion(const object::Object& object, double torsion, const std::string& name) {
  CheckLength(object, torsion, name);
}

std::optional<std::string> FindObstacle(const object::Object& object, const grasp::Contact& contact,
                                        double radius) {
  if (CanReach(object, contact, radius)) return std::nullopt;
  if (IsShutIn(object, contact)) {
    return "its contact is in a sealed cavity";
  }
  const double clearance = ComputeClearance(object, contact, radius);
  if (clearance < kTouchesInside * radius) {
    return "a sphere of radius " + FormatShort(radius) +
           " at its contact penetrates the object, limit " + FormatShort(clearance) + kUnits;
  }
  double free = 0;
  double blocked = object.diameter();
  while (blocked - free > kDistanceAccuracy * object.diameter()) {
    const double travel = (free + blocked) / 2;
    (IsBlocked(object, contact, radius, travel) ? blocked : free) = travel;
  }
  return "the object blocks its path to the contact along the normal: a finger of radius " +
         FormatShort(radius) + " has " + FormatShort(free, kDistanceDigits) +
         " of free path there" + kUnits;
}

}  // namespace regrasp::criteria
