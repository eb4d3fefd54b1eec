#include "sim/replay/contact_noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <vector>

#include "planner/criteria/clearance.h"

namespace regrasp::sim {

namespace {

using Eigen::Vector3d;

/// The fingers as they are meant to be and as they are.
class NoisyHand {
 public:
  NoisyHand(const Object& object, const ContactNoise& noise, RandomStream& random)
      : object_(object), noise_(noise), random_(random) {}

  /// A free finger touches.
  void Place(FingerContact& held) {
    const Contact actual = Draw(held.contact);
    held_[held.finger] = {held.contact, actual};
    held.contact = actual;
  }

  /// A finger that holds goes on, or stays, or turns.
  void Move(FingerContact& held) {
    const auto at = held_.find(held.finger);
    const double same = kPointTolerance * object_.diameter();
    if (at == held_.end() || (at->second.meant.p - held.contact.p).norm() > same) {
      Place(held);
      return;
    }
    Contact actual = held.contact;
    actual.p = at->second.actual.p;
    at->second = {held.contact, actual};
    held.contact = actual;
  }

 private:
  struct Held {
    Contact meant;
    Contact actual;
  };

  /// Directions in which a contact can be off without leaving any face that it is on.
  [[nodiscard]] std::vector<Vector3d> Directions(const Contact& contact,
                                                 const std::vector<int>& faces) const {
    const Vector3d n = contact.n;
    if (object_.dimension() == 2) {
      if (faces.size() > 1) return {};
      return {Vector3d(-n.y(), n.x(), 0)};
    }
    if (faces.size() > 2) return {};
    if (faces.size() == 2) {
      const Vector3d border =
          object_.inward_normal(faces[0]).cross(object_.inward_normal(faces[1]));
      return {border.normalized()};
    }
    const Vector3d across = n.unitOrthogonal();
    return {across, n.cross(across)};
  }

  [[nodiscard]] bool CanTouch(const Contact& from, const Contact& at,
                              const std::vector<int>& faces) const {
    const double tolerance = kPointTolerance * object_.diameter();
    const bool inside = std::ranges::all_of(
        faces, [&](int face) { return object_.ContainsSegment(face, from.p, at.p, tolerance); });
    return inside && ComputeClearance(object_, at, noise_.fingertip) >= noise_.fingertip;
  }

  [[nodiscard]] Contact Draw(const Contact& meant) {
    if (noise_.deviation == 0) return meant;
    const std::vector<int> faces = object_.FacesNear(meant.p, kPointTolerance * object_.diameter());
    const std::vector<Vector3d> directions = Directions(meant, faces);
    if (directions.empty()) return meant;
    for (int i = 0; i < kMostNoiseDraws; ++i) {
      Contact drawn = meant;
      for (const Vector3d& along : directions) {
        drawn.p += noise_.deviation * random_.Normal() * along;
      }
      if (CanTouch(meant, drawn, faces)) return drawn;
    }
    return meant;
  }

  const Object& object_;
  ContactNoise noise_;
  RandomStream& random_;
  std::map<int, Held> held_;
};

}  // namespace

Plan AddContactNoise(const Object& object, const Plan& plan, const ContactNoise& noise,
                     RandomStream& random) {
  Plan noisy = plan;
  NoisyHand hand(object, noise, random);
  for (FingerContact& held : noisy.initial) hand.Place(held);
  for (Step& step : noisy.steps) {
    if (auto* change = std::get_if<Switch>(&step)) {
      for (FingerContact& held : change->place) hand.Place(held);
      continue;
    }
    for (FingerGrasp& waypoint : std::get<Align>(step).waypoints) {
      for (FingerContact& held : waypoint) hand.Move(held);
    }
  }
  return noisy;
}

}  // namespace regrasp::sim
