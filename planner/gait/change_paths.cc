#include "planner/gait/change_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/gait/finger_path.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"
#include "planner/motion/contact_motion.h"
#include "planner/motion/find_motion_proof.h"

namespace regrasp::gait {

namespace {

using grasp::Contact;
using Contacts = std::vector<Contact>;

/// Shares that the way between two waypoints is cut into: the fewest, of how far a tip goes in one,
/// metres, and the most.
constexpr double kSlideStride = 0.004;
constexpr int kMostShares = 64;
/// A motion that needs shorter pieces of a proof keeps too close to the limit.
constexpr double kShortestPiece = 1.0 / 64;
/// How far a path is bent to another posture at one place, radians.
constexpr double kMostBend = 0.5;
/// Faces of a fine mesh that a slide goes over, and the turn of the normal, radians, at edges
/// between them that are concave: a tip of 10 mm is in the surface by kTipDepth there. Whether
/// this one is, by no more, is looked at where it slides.
constexpr int kMostCrossings = 6;
constexpr double kConcave = 0.2;

bool IsSame(const Contact& a, const Contact& b) { return a.p == b.p && a.face == b.face; }

/// A contact of a route, and the share of its length there. Two with one share: a turn about an
/// edge.
struct Knot {
  double share;
  Contact contact;
};

std::vector<Knot> KnotsOf(const tree::SurfaceRoute& route) {
  std::vector<Knot> knots = {{0, route.front()}};
  double length = 0;
  for (const Contact& contact : route) {
    if (IsSame(contact, knots.back().contact)) continue;
    length += (contact.p - knots.back().contact.p).norm();
    knots.push_back({length, contact});
  }
  for (Knot& knot : knots) knot.share = length > 0 ? knot.share / length : 0;
  return knots;
}

/// A contact on its way along a route.
class Traveller {
 public:
  explicit Traveller(const tree::SurfaceRoute& route) : knots_(KnotsOf(route)) {}

  [[nodiscard]] const Contact& at() const { return at_; }
  /// The share at which it comes to its next knot; infinite where it is at the last one.
  [[nodiscard]] double next() const {
    return last_ + 1 < knots_.size() ? knots_[last_ + 1].share
                                     : std::numeric_limits<double>::infinity();
  }
  /// @param share  no more than next().
  void GoTo(double share) {
    if (next() == share) {
      at_ = knots_[++last_].contact;
    } else if (last_ + 1 < knots_.size()) {
      const Knot& from = knots_[last_];
      const Knot& to = knots_[last_ + 1];
      at_ = from.contact;
      at_.p += (share - from.share) / (to.share - from.share) * (to.contact.p - from.contact.p);
    }
  }

 private:
  std::vector<Knot> knots_;
  std::size_t last_ = 0;
  Contact at_ = knots_.front().contact;
};

/// Fingers on their way.
class Slider {
 public:
  Slider(const HandSetup& setup, const std::vector<Sliding>& fingers,
         const ContactAssignment& holding)
      : setup_(setup), fingers_(fingers) {
    for (const int point : holding) {
      touching_.push_back(point == kNone ? TipContact::kFree : TipContact::kTouching);
    }
  }

  /// From where tips are at a motion's first contacts on. @param is_last  it ends in the end.
  [[nodiscard]] std::optional<std::vector<Keyframe>> Follow(const motion::GraspMotion& motion,
                                                            const Keyframe& from,
                                                            bool is_last) const {
    for (int shares = std::max(1, static_cast<int>(std::ceil(LengthOf(motion) / kSlideStride)));
         shares <= kMostShares; shares *= 2) {
      auto path = InShares(motion, from, shares);
      if (!path || (is_last && !LeadToTheEnd(motion, *path))) return std::nullopt;
      if (StaysOn(motion, *path)) return IsFree(*path) ? path : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  /// Of the longest way of a tip, metres.
  [[nodiscard]] double LengthOf(const motion::GraspMotion& motion) const {
    double length = 0;
    for (std::size_t i = 0; i < fingers_.size(); ++i) {
      const double radius = setup_.scene.finger(fingers_[i].finger).tip.radius;
      length =
          std::max(length, setup_.scale * motion[i].velocity().norm() + radius * motion[i].turn());
    }
    return length;
  }
  [[nodiscard]] kinematics::TipTarget TargetOf(FingerIndex finger, const Contact& contact,
                                               const Eigen::Isometry3d& pose) const {
    return TargetAt(setup_.scene.finger(finger), {setup_.scale * contact.p, contact.n}, pose);
  }
  [[nodiscard]] std::optional<std::vector<Keyframe>> InShares(const motion::GraspMotion& motion,
                                                              const Keyframe& from,
                                                              int shares) const {
    std::vector<Keyframe> path = {from};
    for (int k = 1; k <= shares; ++k) {
      path.push_back(path.back());
      for (std::size_t i = 0; i < fingers_.size(); ++i) {
        const Contact contact = k == shares ? motion[i].to() : motion[i].At(double(k) / shares);
        Posture& posture = path.back().postures[fingers_[i].finger];
        const auto next = setup_.inverse[fingers_[i].finger].SolveFrom(
            TargetOf(fingers_[i].finger, contact, from.pose), posture);
        if (!next) return std::nullopt;
        posture = *next;
      }
    }
    return path;
  }
  /// Bends a path to the postures that fingers are to have in the end, the more the nearer it is:
  /// tips stay where they are. @returns whether it can be bent so far.
  [[nodiscard]] bool LeadToTheEnd(const motion::GraspMotion& motion,
                                  std::vector<Keyframe>& path) const {
    const std::size_t shares = path.size() - 1;
    for (std::size_t i = 0; i < fingers_.size(); ++i) {
      const FingerIndex finger = fingers_[i].finger;
      const Posture bend = *fingers_[i].end - path.back().postures[finger];
      if (bend.cwiseAbs().maxCoeff() > kMostBend) return false;
      for (std::size_t k = 1; k < shares; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(shares);
        Posture& posture = path[k].postures[finger];
        const auto bent = setup_.inverse[finger].SolveNear(
            TargetOf(finger, motion[i].At(share), path[k].pose), posture + share * bend);
        if (!bent) return false;
        posture = *bent;
      }
      path.back().postures[finger] = *fingers_[i].end;
    }
    return true;
  }
  /// Half-way between postures too.
  [[nodiscard]] bool StaysOn(const motion::GraspMotion& motion,
                             const std::vector<Keyframe>& path) const {
    const auto shares = static_cast<double>(path.size() - 1);
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const Keyframe middle = Between(path[k], path[k + 1], 0.5);
      for (std::size_t i = 0; i < fingers_.size(); ++i) {
        const FingerIndex finger = fingers_[i].finger;
        const Contact contact = motion[i].At((static_cast<double>(k) + 0.5) / shares);
        const auto tip = kinematics::TipAt(setup_.scene.finger(finger), middle.postures[finger]);
        if ((tip.centre - TargetOf(finger, contact, middle.pose).centre).norm() > kTipOff) {
          return false;
        }
      }
    }
    return true;
  }
  [[nodiscard]] bool IsFree(const std::vector<Keyframe>& path) const {
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      if (!IsClear(setup_.scene, path[k], path[k + 1], touching_)) return false;
    }
    return true;
  }

  const HandSetup& setup_;
  const std::vector<Sliding>& fingers_;
  Touching touching_;
};

}  // namespace

const tree::SurfaceRoute* SlideRoutes::Between(int from, int to) {
  const auto [found, is_new] = known_.try_emplace({from, to});
  if (is_new) {
    found->second = tree::FindSurfaceRoute(memory_.object(), memory_.contact(from),
                                           memory_.contact(to), {kMostCrossings, kConcave});
  }
  return found->second ? &*found->second : nullptr;
}

std::vector<Contacts> GoTogether(const std::vector<const tree::SurfaceRoute*>& routes) {
  std::vector<Traveller> travellers;
  for (const tree::SurfaceRoute* route : routes) travellers.emplace_back(*route);
  std::vector<Contacts> along;
  const auto append = [&] {
    along.emplace_back();
    for (const Traveller& traveller : travellers) along.back().push_back(traveller.at());
  };
  append();
  double share = 0;
  while (true) {
    for (Traveller& traveller : travellers) {
      while (traveller.next() == share) {
        traveller.GoTo(share);
        append();
      }
    }
    double next = std::numeric_limits<double>::infinity();
    for (const Traveller& traveller : travellers) next = std::min(next, traveller.next());
    if (!std::isfinite(next)) return along;
    share = next;
    for (Traveller& traveller : travellers) traveller.GoTo(share);
    append();
  }
}

std::optional<Slide> FindSlide(const HandSetup& setup, const criteria::GraspMemory& memory,
                               const std::vector<Sliding>& fingers,
                               const ContactAssignment& holding, const Keyframe& from) {
  std::vector<const tree::SurfaceRoute*> routes;
  for (const Sliding& sliding : fingers) routes.push_back(sliding.route);
  Contacts still;
  for (FingerIndex finger{0}; finger < std::ssize(holding); ++finger) {
    const bool slides = std::ranges::find(fingers, finger, &Sliding::finger) != fingers.end();
    if (!slides && holding[finger] != kNone) still.push_back(memory.contact(holding[finger]));
  }
  Slide slide{GoTogether(routes), {}};
  std::vector<motion::GraspMotion> motions;
  for (std::size_t i = 0; i + 1 < slide.along.size(); ++i) {
    motion::GraspMotion& motion = motions.emplace_back();
    for (std::size_t k = 0; k < fingers.size(); ++k) {
      motion.emplace_back(slide.along[i][k], slide.along[i + 1][k]);
    }
    for (const Contact& contact : still) motion.emplace_back(contact, contact);
    if (!motion::FindMotionProof(motion, memory.dimension(), memory.half_angle(), kShortestPiece)) {
      return std::nullopt;
    }
  }
  const Slider slider(setup, fingers, holding);
  for (const motion::GraspMotion& motion : motions) {
    const Keyframe& at = slide.paths.empty() ? from : slide.paths.back().back();
    auto path = slider.Follow(motion, at, &motion == &motions.back());
    if (!path) return std::nullopt;
    slide.paths.push_back(*std::move(path));
  }
  return slide;
}

namespace {

/// One finger goes along a path, all else stays.
void Append(const Keyframe& before, FingerIndex finger, const Posture& posture,
            PlanSegment& stretch) {
  stretch.path.push_back(before);
  stretch.path.back().postures[finger] = posture;
}

}  // namespace

Change ChangeBetween(const ContactAssignment& from, const ContactAssignment& to) {
  Change change;
  for (FingerIndex finger{0}; finger < std::ssize(from); ++finger) {
    if (from[finger] == to[finger]) continue;
    if (from[finger] == kNone) {
      change.placed = finger;
    } else if (to[finger] == kNone) {
      change.released = finger;
    } else {
      change.slid.push_back(finger);
    }
  }
  return change;
}

std::optional<std::vector<PlanSegment>> ChangePaths::Find(const Stance& from, Stance& to, int node,
                                                          const Rolled& rolled) {
  const Change change = ChangeBetween(from.holding, to.holding);
  Keyframe frame = checker_.FrameAt(from, node);
  std::vector<PlanSegment> segments;
  const auto take = [&](std::optional<PlanSegment> stretch) {
    if (!stretch) return false;
    frame = stretch->path.back();
    segments.push_back(*std::move(stretch));
    return true;
  };
  const auto& [placed, released, slid] = change;
  if (!slid.empty() && !take(Slide(slid, from.holding, to.holding, node, frame))) {
    return std::nullopt;
  }
  if (placed.valid() && !take(Place(placed, to.holding[placed], node, frame, rolled.before))) {
    return std::nullopt;
  }
  if (released.valid() &&
      !take(Release(released, from.holding[released], to, node, frame, rolled.after))) {
    return std::nullopt;
  }
  return segments;
}

std::optional<PlanSegment> ChangePaths::Place(FingerIndex finger, int point, int node,
                                              const Keyframe& before, const RolledTips& rolled) {
  const Posture touching = *checker_.reach().Find(finger, point, node);
  Surroundings around = AllBut(setup_.scene, finger, before);
  AddRolled(setup_.scene, rolled, around);
  const auto path =
      FindPathToContact(setup_.scene, setup_.inverse[finger], finger, before.postures[finger],
                        TargetAt(setup_.scene.finger(finger), setup_.points[point], before.pose),
                        touching, around, random_);
  if (!path) return std::nullopt;
  PlanSegment stretch{PlanSegment::Kind::kPlace, finger, point, {}};
  for (const Posture& posture : *path) Append(before, finger, posture, stretch);
  return stretch;
}

/// To where the finger is to wait, or else no farther than above its contact.
std::optional<PlanSegment> ChangePaths::Release(FingerIndex finger, int point, Stance& to, int node,
                                                const Keyframe& before, const RolledTips& rolled) {
  Surroundings around = AllBut(setup_.scene, finger, before);
  AddRolled(setup_.scene, rolled, around);
  const auto up =
      FindLiftPath(setup_.scene, setup_.inverse[finger], finger,
                   TargetAt(setup_.scene.finger(finger), setup_.points[point], before.pose),
                   before.postures[finger], around);
  if (!up) return std::nullopt;
  const auto onward =
      FindFreePath(setup_.scene, finger, up->back(), to.waiting[finger], around, random_);
  FingerPath path = *up;
  if (onward) {
    path.insert(path.end(), onward->begin() + 1, onward->end());
  } else {
    to.waiting[finger] = up->back();
    if (!checker_.IsPassable(to, node)) return std::nullopt;
  }
  PlanSegment stretch{PlanSegment::Kind::kRelease, finger, point, {}};
  for (const Posture& posture : path) Append(before, finger, posture, stretch);
  return stretch;
}

std::optional<PlanSegment> ChangePaths::Slide(const std::vector<FingerIndex>& slid,
                                              const ContactAssignment& from,
                                              const ContactAssignment& to, int node,
                                              const Keyframe& before) {
  PlanSegment stretch{PlanSegment::Kind::kSlide, {}, kNone, {before}};
  std::vector<Sliding> fingers;
  for (const FingerIndex finger : slid) {
    stretch.slid.push_back({finger, from[finger], to[finger]});
    fingers.push_back({finger, routes_.Between(from[finger], to[finger]),
                       checker_.reach().Find(finger, to[finger], node)});
  }
  auto slide = FindSlide(setup_, memory_, fingers, from, before);
  if (!slide) return std::nullopt;
  stretch.along = std::move(slide->along);
  stretch.along_at = {0};
  for (const std::vector<Keyframe>& path : slide->paths) {
    stretch.path.insert(stretch.path.end(), path.begin() + 1, path.end());
    stretch.along_at.push_back(static_cast<int>(stretch.path.size()) - 1);
  }
  return stretch;
}

}  // namespace regrasp::gait
