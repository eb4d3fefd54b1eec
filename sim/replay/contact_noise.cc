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
  NoisyHand(const object::Object& object, const ContactNoise& noise, RandomStream& random)
      : object_(object), noise_(noise), random_(random) {}

  /// A free finger touches.
  void Place(plan::FingerContact& held) {
    const grasp::Contact actual = Draw(held.contact);
    held_[held.finger] = {held.contact, actual};
    held.contact = actual;
  }

  /// A finger that holds goes on, or stays, or turns.
  void Move(plan::FingerContact& held) {
    const auto at = held_.find(held.finger);
    const double same = object::kPointTolerance * object_.diameter();
    if (at == held_.end() || (at->second.meant.p - held.contact.p).norm() > same) {
      Place(held);
      return;
    }
    grasp::Contact actual = held.contact;
    actual.p = at->second.actual.p;
    at->second = {held.contact, actual};
    held.contact = actual;
  }

 private:
  struct Held {
    grasp::Contact meant;
    grasp::Contact actual;
  };

  /// Directions in which a contact can be off without leaving any face that it is on.
  [[nodiscard]] std::vector<Vector3d> Directions(const grasp::Contact& contact,
                                                 const std::vector<FaceIndex>& faces) const {
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

  [[nodiscard]] bool CanTouch(const grasp::Contact& from, const grasp::Contact& at,
                              const std::vector<FaceIndex>& faces) const {
    const double tolerance = object::kPointTolerance * object_.diameter();
    const bool inside = std::ranges::all_of(faces, [&](FaceIndex face) {
      return object_.ContainsSegment(face, from.p, at.p, tolerance);
    });
    return inside && criteria::ComputeClearance(object_, at, noise_.fingertip) >= noise_.fingertip;
  }

  [[nodiscard]] grasp::Contact Draw(const grasp::Contact& meant) {
    if (noise_.deviation == 0) return meant;
    const std::vector<FaceIndex> faces =
        object_.FacesNear(meant.p, object::kPointTolerance * object_.diameter());
    const std::vector<Vector3d> directions = Directions(meant, faces);
    if (directions.empty()) return meant;
    for (int i = 0; i < kMostNoiseDraws; ++i) {
      grasp::Contact drawn = meant;
      for (const Vector3d& along : directions) {
        drawn.p += noise_.deviation * random_.Normal() * along;
      }
      if (CanTouch(meant, drawn, faces)) return drawn;
    }
    return meant;
  }

  const object::Object& object_;
  ContactNoise noise_;
  RandomStream& random_;
  std::map<FingerIndex, Held> held_;
};

}  // namespace

plan::Plan AddContactNoise(const object::Object& object, const plan::Plan& plan,
                           const ContactNoise& noise, RandomStream& random) {
  plan::Plan noisy = plan;
  NoisyHand hand(object, noise, random);
  for (plan::FingerContact& held : noisy.initial) hand.Place(held);
  for (plan::Step& step : noisy.steps) {
    if (auto* change = std::get_if<plan::Switch>(&step)) {
      for (plan::FingerContact& held : change->place) hand.Place(held);
      continue;
    }
    auto* align = std::get_if<plan::Align>(&step);
    if (align == nullptr) continue;
    for (plan::FingerGrasp& waypoint : align->waypoints) {
      for (plan::FingerContact& held : waypoint) hand.Move(held);
    }
  }
  return noisy;
}

}  // namespace regrasp::sim
