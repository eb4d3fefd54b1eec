#include "planner/graph/standing_room.h"

#include <algorithm>

namespace regrasp {

namespace {

/// Faces farther from the ball's centre than this share of its radius don't meet it: the contact's
/// own is at the radius.
constexpr double kInside = 1 - 1e-6;

}  // namespace

bool HasStandingRoom(const Object& object, const Contact& contact) {
  const double radius = kStandingRoom * object.diameter();
  const auto near = object.FacesNear(contact.p - radius * contact.n, kInside * radius);
  return std::all_of(near.begin(), near.end(), [&](int face) { return face == contact.face; });
}

}  // namespace regrasp
