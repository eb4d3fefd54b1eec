#include "planner/gait/rolled_gait.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "planner/gait/finger_path.h"
#include "planner/gait/object_motion.h"
#include "planner/gait/rolling.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/object/rotation.h"

namespace regrasp::gait {

namespace {

using plan::Reason;

/// Largest step of the object in which a contact rolls: rotation, radians, and distance, metres.
constexpr double kRollTurn = 0.02;
constexpr double kRollShift = 1e-3;
/// Number of times that a step is halved if a fingertip leaves its contact within it.
constexpr int kMostHalvings = 3;
/// A rolled contact depends on the joints, and the joints on the contact. They are computed in turn
/// until the contact changes by less than this, metres.
constexpr double kSameContact = 1e-9;
constexpr int kMostTurns = 20;
/// Shortest permitted piece of a proof of force closure, of a step of length 1.
constexpr double kShortestRolledPiece = 1.0 / 16;

/// Repeats a gait with rolling contacts, segment by segment.
class ContactRoller {
 public:
  ContactRoller(const HandSetup& setup, const collision::BallContact& surface,
                double friction_angle, const Gait& gait, RandomStream& random)
      : setup_(setup),
        surface_(surface),
        friction_angle_(friction_angle),
        random_(random),
        frame_(gait.start),
        contacts_(gait.initial.size()),
        touching_(gait.initial.size(), TipContact::kFree) {
    for (FingerIndex finger{0}; finger < std::ssize(gait.initial); ++finger) {
      if (gait.initial[finger] != kNone) Hold(finger, setup.points[gait.initial[finger]]);
    }
  }

  /// Return the segment with rolled contacts; nullopt, with a reason, if there is none.
  [[nodiscard]] std::optional<PlanSegment> Repeat(const PlanSegment& segment) {
    switch (segment.kind) {
      case PlanSegment::Kind::kMove:
        return Move(segment);
      case PlanSegment::Kind::kPlace:
        return Place(segment);
      case PlanSegment::Kind::kRelease:
        return Release(segment);
      case PlanSegment::Kind::kSlide:
        return Slide(segment);
    }
    return std::nullopt;
  }

  [[nodiscard]] Reason reason() const { return reason_; }

 private:
  using Contacts = std::vector<std::optional<SurfacePoint>>;  ///< [finger]

  void Hold(FingerIndex finger, const SurfacePoint& contact) {
    contacts_[finger] = contact;
    touching_[finger] = TipContact::kTouching;
  }
  std::nullopt_t Fail(Reason reason) {
    reason_ = reason;
    return std::nullopt;
  }
  [[nodiscard]] plan::FingerGrasp GraspNow() const {
    plan::FingerGrasp grasp;
    for (FingerIndex finger{0}; finger < std::ssize(contacts_); ++finger) {
      const auto& contact = contacts_[finger];
      if (contact) grasp.push_back({finger, {contact->p / setup_.scale, contact->n, {}}});
    }
    return grasp;
  }

  [[nodiscard]] std::optional<PlanSegment> Move(const PlanSegment& segment) {
    PlanSegment rolled{PlanSegment::Kind::kMove, {}, kNone, {frame_}};
    rolled.rolled = {GraspNow()};
    for (std::size_t i = 1; i < segment.path.size(); ++i) {
      const Keyframe& from = segment.path[i - 1];
      const Keyframe& to = segment.path[i];
      const double turn = object::RotationInBody(from.pose.linear(), to.pose.linear()).angle();
      const double shift = (to.pose.translation() - from.pose.translation()).norm();
      const int pieces =
          std::max(1, static_cast<int>(std::ceil(std::max(turn / kRollTurn, shift / kRollShift))));
      for (int k = 1; k <= pieces; ++k) {
        const Keyframe before = Between(from, to, static_cast<double>(k - 1) / pieces);
        const Keyframe after =
            k == pieces ? to : Between(from, to, static_cast<double>(k) / pieces);
        if (!Advance(before, after, kMostHalvings, rolled)) return std::nullopt;
      }
    }
    return rolled;
  }

  /// Append a step in which the object moves as between two keyframes of the gait.
  /// @returns whether it is feasible.
  [[nodiscard]] bool Advance(const Keyframe& before, const Keyframe& after, int halvings,
                             PlanSegment& rolled) {
    Keyframe next{after.pose, frame_.configurations};
    Contacts contacts = contacts_;
    bool stays = true;
    for (FingerIndex finger{0}; stays && finger < std::ssize(contacts); ++finger) {
      if (!contacts[finger]) continue;
      const JointConfiguration change =
          after.configurations[finger] - before.configurations[finger];
      stays = Follow(finger, change, next, *contacts[finger]);
    }
    if (!stays || !StaysOnContacts(next, contacts)) {
      if (halvings == 0) {
        reason_ = Reason::kTipOffContact;
        return false;
      }
      const Keyframe middle = Between(before, after, 0.5);
      return Advance(before, middle, halvings - 1, rolled) &&
             Advance(middle, after, halvings - 1, rolled);
    }
    if (!IsClear(setup_.scene, frame_, next, touching_)) {
      reason_ = Reason::kHandCollides;
      return false;
    }
    const plan::FingerGrasp grasp_before = GraspNow();
    contacts_ = std::move(contacts);
    frame_ = std::move(next);
    const plan::FingerGrasp grasp = GraspNow();
    if (!IsForceClosure(grasp_before, grasp)) {
      reason_ = Reason::kNotForceClosure;
      return false;
    }
    rolled.path.push_back(frame_);
    rolled.rolled.push_back(grasp);
    return true;
  }

  /// Return whether force closure is proved between two grasps of the same fingers.
  [[nodiscard]] bool IsForceClosure(const plan::FingerGrasp& from,
                                    const plan::FingerGrasp& to) const {
    motion::GraspMotion motion;
    for (std::size_t i = 0; i < from.size(); ++i) {
      motion.emplace_back(from[i].contact, to[i].contact);
    }
    return motion::FindMotionProof(motion, 3, friction_angle_, kShortestRolledPiece).has_value();
  }

  /// Let a fingertip roll while the object moves to the pose of `next`.
  /// @param change  change of the joints in the gait.
  /// @param contact  contact before and after the step.
  /// @returns whether joints and contact were found.
  [[nodiscard]] bool Follow(FingerIndex finger, const JointConfiguration& change, Keyframe& next,
                            SurfacePoint& contact) const {
    const kinematics::Finger& chain = setup_.scene.finger(finger);
    const JointConfiguration& now = frame_.configurations[finger];
    const Eigen::Matrix3d turn_now = FingertipOrientation(chain, now, frame_.pose);
    SurfacePoint rolled = contact;
    for (int i = 0; i < kMostTurns; ++i) {
      const auto joints =
          setup_.inverse[finger].SolveNear(TargetAt(chain, rolled, next.pose), now + change);
      if (!joints) return false;
      next.configurations[finger] = *joints;
      const Eigen::Matrix3d turn =
          FingertipOrientation(chain, *joints, next.pose) * turn_now.transpose();
      const SurfacePoint again = Rolled(contact, turn, chain.tip.radius, surface_);
      const double off =
          (again.p - rolled.p).norm() + chain.tip.radius * (again.n - rolled.n).norm();
      if (off < kSameContact) {
        contact = rolled;
        return true;
      }
      rolled = again;
    }
    return false;
  }

  /// Return whether fingertips are at their contacts halfway to a keyframe.
  [[nodiscard]] bool StaysOnContacts(const Keyframe& next, const Contacts& contacts) const {
    const Keyframe middle = Between(frame_, next, 0.5);
    for (FingerIndex finger{0}; finger < std::ssize(contacts); ++finger) {
      if (!contacts[finger]) continue;
      const SurfacePoint& from = *contacts_[finger];
      const SurfacePoint& to = *contacts[finger];
      const grasp::Contact there =
          motion::ContactMotion({from.p, from.n, {}}, {to.p, to.n, {}}).At(0.5);
      const kinematics::Finger& chain = setup_.scene.finger(finger);
      const Eigen::Vector3d expected = TargetAt(chain, {there.p, there.n}, middle.pose).centre;
      const auto tip = kinematics::TipAt(chain, middle.configurations[finger]);
      if ((tip.centre - expected).norm() > kTipOff) return false;
    }
    return true;
  }

  /// Return a segment in which one finger moves along a path.
  [[nodiscard]] PlanSegment Along(const PlanSegment& segment, const FingerPath& path) {
    PlanSegment moved{segment.kind, segment.finger, segment.contact, {}};
    for (const JointConfiguration& configuration : path) {
      frame_.configurations[segment.finger] = configuration;
      moved.path.push_back(frame_);
    }
    return moved;
  }

  [[nodiscard]] std::optional<PlanSegment> Place(const PlanSegment& segment) {
    const FingerIndex finger = segment.finger;
    const SurfacePoint& contact = setup_.points[segment.contact];
    const auto path = FindPathToContact(setup_.scene, setup_.inverse[finger], finger,
                                        frame_.configurations[finger],
                                        TargetAt(setup_.scene.finger(finger), contact, frame_.pose),
                                        segment.path.back().configurations[finger],
                                        AllExcept(setup_.scene, finger, frame_), random_);
    if (!path) return Fail(Reason::kHandCollides);
    Hold(finger, contact);
    if (!IsForceClosure(GraspNow(), GraspNow())) return Fail(Reason::kNotForceClosure);
    return Along(segment, *path);
  }

  [[nodiscard]] std::optional<PlanSegment> Release(const PlanSegment& segment) {
    const FingerIndex finger = segment.finger;
    const Surroundings around = AllExcept(setup_.scene, finger, frame_);
    auto path = FindLiftPath(setup_.scene, setup_.inverse[finger], finger,
                             TargetAt(setup_.scene.finger(finger), *contacts_[finger], frame_.pose),
                             frame_.configurations[finger], around);
    if (!path) return Fail(Reason::kHandCollides);
    const auto back = FindFreePath(setup_.scene, finger, path->back(),
                                   segment.path.back().configurations[finger], around, random_);
    if (!back) return Fail(Reason::kHandCollides);
    path->insert(path->end(), back->begin() + 1, back->end());
    contacts_[finger].reset();
    touching_[finger] = TipContact::kFree;
    if (!IsForceClosure(GraspNow(), GraspNow())) return Fail(Reason::kNotForceClosure);
    return Along(segment, *path);
  }

  /// Repeat a sliding step that begins as in the gait.
  [[nodiscard]] std::optional<PlanSegment> Slide(const PlanSegment& segment) {
    const Keyframe& first = segment.path.front();
    if (first.pose.matrix() != frame_.pose.matrix() ||
        first.configurations != frame_.configurations) {
      return Fail(Reason::kDiscontinuous);
    }
    for (const PlanSegment::Slid& slid : segment.slid) Hold(slid.finger, setup_.points[slid.to]);
    frame_ = segment.path.back();
    return segment;
  }

  const HandSetup& setup_;
  const collision::BallContact& surface_;
  double friction_angle_;
  RandomStream& random_;
  Keyframe frame_;     ///< present state
  Contacts contacts_;  ///< present contacts, metres
  Touching touching_;
  Reason reason_ = Reason::kNone;
};

}  // namespace

RolledGait RollContacts(const HandSetup& setup, const collision::BallContact& surface,
                        double friction_angle, const Gait& gait, RandomStream random) {
  ContactRoller roller(setup, surface, friction_angle, gait, random);
  RolledGait rolled{Gait{gait.initial, gait.start, {}}};
  for (const PlanSegment& segment : gait.segments) {
    auto repeated = roller.Repeat(segment);
    if (!repeated) return {std::nullopt, rolled.segments, roller.reason()};
    rolled.gait->segments.push_back(*std::move(repeated));
    ++rolled.segments;
  }
  return rolled;
}

}  // namespace regrasp::gait
