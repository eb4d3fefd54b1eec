#include "planner/gait/change_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/gait/finger_path.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"
#include "planner/motion/find_motion_proof.h"

namespace regrasp::gait {

namespace {

using grasp::Contact;
using Contacts = std::vector<Contact>;

/// Subdivision of the path between two waypoints: length of a piece, metres, and maximum number of
/// pieces.
constexpr double kSlideStep = 0.004;
constexpr int kMaxPieces = 64;
/// Shortest permitted piece of a proof of force closure.
/// Motions that require shorter pieces are too close to the friction limit.
constexpr double kShortestPiece = 1.0 / 64;
/// Maximum change of a joint angle when a path is bent to its required end configuration, radians.
constexpr double kMaxBend = 0.5;
/// Limits of a surface route: maximum number of crossed triangles of a fine mesh, and maximum
/// rotation of the normal at concave edges, radians. There a fingertip of radius 10 mm penetrates
/// by kTipDepth; smaller ones are checked during the slide.
constexpr int kMaxCrossings = 6;
constexpr double kMaxConcaveTurn = 0.2;

bool IsSame(const Contact& a, const Contact& b) { return a.p == b.p && a.face == b.face; }

/// Contact of a route with the normalized arc length there.
/// Two knots with equal arc length are a rotation about an edge.
struct Knot {
  double fraction;
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
  for (Knot& knot : knots) knot.fraction = length > 0 ? knot.fraction / length : 0;
  return knots;
}

/// Position of a contact on a route.
class RouteCursor {
 public:
  explicit RouteCursor(const tree::SurfaceRoute& route) : knots_(KnotsOf(route)) {}

  [[nodiscard]] const Contact& at() const { return at_; }
  /// Arc length of the next knot; infinite at the last one.
  [[nodiscard]] double next() const {
    return last_ + 1 < knots_.size() ? knots_[last_ + 1].fraction
                                     : std::numeric_limits<double>::infinity();
  }
  /// @param fraction  normalized arc length, at most next().
  void AdvanceTo(double fraction) {
    if (next() == fraction) {
      at_ = knots_[++last_].contact;
    } else if (last_ + 1 < knots_.size()) {
      const Knot& from = knots_[last_];
      const Knot& to = knots_[last_ + 1];
      at_ = from.contact;
      at_.p += (fraction - from.fraction) / (to.fraction - from.fraction) *
               (to.contact.p - from.contact.p);
    }
  }

 private:
  std::vector<Knot> knots_;
  std::size_t last_ = 0;
  Contact at_ = knots_.front().contact;
};

/// Inverse kinematics of sliding fingers along contact motions.
class SlideFollower {
 public:
  SlideFollower(const HandSetup& setup, const std::vector<Sliding>& fingers,
                const ContactAssignment& assignment)
      : setup_(setup), fingers_(fingers) {
    for (const int point : assignment) {
      touching_.push_back(point == kNone ? TipContact::kFree : TipContact::kTouching);
    }
  }

  /// Follow a contact motion from the keyframe at its first contacts.
  /// @param is_last  whether the motion ends the sliding step.
  /// @returns the certified keyframes; nullopt if a finger cannot follow.
  [[nodiscard]] std::optional<std::vector<Keyframe>> Follow(const motion::GraspMotion& motion,
                                                            const Keyframe& from,
                                                            bool is_last) const {
    for (int pieces = std::max(1, static_cast<int>(std::ceil(LengthOf(motion) / kSlideStep)));
         pieces <= kMaxPieces; pieces *= 2) {
      auto path = Subdivide(motion, from, pieces);
      if (!path || (is_last && !BendToEnd(motion, *path))) return std::nullopt;
      if (KeepsContact(motion, *path)) return IsFree(*path) ? path : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  /// Return the longest distance that a fingertip moves, metres.
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
  [[nodiscard]] std::optional<std::vector<Keyframe>> Subdivide(const motion::GraspMotion& motion,
                                                               const Keyframe& from,
                                                               int pieces) const {
    std::vector<Keyframe> path = {from};
    for (int k = 1; k <= pieces; ++k) {
      path.push_back(path.back());
      for (std::size_t i = 0; i < fingers_.size(); ++i) {
        const Contact contact = k == pieces ? motion[i].to() : motion[i].At(double(k) / pieces);
        JointConfiguration& configuration = path.back().configurations[fingers_[i].finger];
        const auto next = setup_.inverse[fingers_[i].finger].SolveFrom(
            TargetOf(fingers_[i].finger, contact, from.pose), configuration);
        if (!next) return std::nullopt;
        configuration = *next;
      }
    }
    return path;
  }
  /// Bend a path gradually to the required end configurations; fingertips stay on their contacts.
  /// @returns whether the required bend is small enough.
  [[nodiscard]] bool BendToEnd(const motion::GraspMotion& motion,
                               std::vector<Keyframe>& path) const {
    const std::size_t pieces = path.size() - 1;
    for (std::size_t i = 0; i < fingers_.size(); ++i) {
      const FingerIndex finger = fingers_[i].finger;
      const JointConfiguration bend = *fingers_[i].end - path.back().configurations[finger];
      if (bend.cwiseAbs().maxCoeff() > kMaxBend) return false;
      for (std::size_t k = 1; k < pieces; ++k) {
        const double fraction = static_cast<double>(k) / static_cast<double>(pieces);
        JointConfiguration& configuration = path[k].configurations[finger];
        const auto bent =
            setup_.inverse[finger].SolveNear(TargetOf(finger, motion[i].At(fraction), path[k].pose),
                                             configuration + fraction * bend);
        if (!bent) return false;
        configuration = *bent;
      }
      path.back().configurations[finger] = *fingers_[i].end;
    }
    return true;
  }
  /// Check contacts halfway between keyframes, too.
  [[nodiscard]] bool KeepsContact(const motion::GraspMotion& motion,
                                  const std::vector<Keyframe>& path) const {
    const auto pieces = static_cast<double>(path.size() - 1);
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const Keyframe middle = Between(path[k], path[k + 1], 0.5);
      for (std::size_t i = 0; i < fingers_.size(); ++i) {
        const FingerIndex finger = fingers_[i].finger;
        const Contact contact = motion[i].At((static_cast<double>(k) + 0.5) / pieces);
        const auto tip =
            kinematics::TipAt(setup_.scene.finger(finger), middle.configurations[finger]);
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

/// Append a keyframe in which only one finger has moved.
void Append(const Keyframe& before, FingerIndex finger, const JointConfiguration& configuration,
            PlanSegment& segment) {
  segment.path.push_back(before);
  segment.path.back().configurations[finger] = configuration;
}

}  // namespace

const tree::SurfaceRoute* SlideRoutes::Between(int from, int to) {
  // A given contact that has rolled onto an edge has no face, and no route begins there.
  if (!memory_.contact(from).face.valid() || !memory_.contact(to).face.valid()) return nullptr;
  const auto [found, is_new] = cache_.try_emplace({from, to});
  if (is_new) {
    found->second = tree::FindSurfaceRoute(memory_.object(), memory_.contact(from),
                                           memory_.contact(to), {kMaxCrossings, kMaxConcaveTurn});
  }
  return found->second ? &*found->second : nullptr;
}

std::vector<Contacts> SynchronizeRoutes(const std::vector<const tree::SurfaceRoute*>& routes) {
  std::vector<RouteCursor> cursors;
  for (const tree::SurfaceRoute* route : routes) cursors.emplace_back(*route);
  std::vector<Contacts> waypoints;
  const auto append = [&] {
    waypoints.emplace_back();
    for (const RouteCursor& cursor : cursors) waypoints.back().push_back(cursor.at());
  };
  append();
  double fraction = 0;
  while (true) {
    for (RouteCursor& cursor : cursors) {
      while (cursor.next() == fraction) {
        cursor.AdvanceTo(fraction);
        append();
      }
    }
    double next = std::numeric_limits<double>::infinity();
    for (const RouteCursor& cursor : cursors) next = std::min(next, cursor.next());
    if (!std::isfinite(next)) return waypoints;
    fraction = next;
    for (RouteCursor& cursor : cursors) cursor.AdvanceTo(fraction);
    append();
  }
}

std::optional<Slide> FindSlide(const HandSetup& setup, const criteria::GraspMemory& memory,
                               const std::vector<Sliding>& fingers,
                               const ContactAssignment& assignment, const Keyframe& from) {
  std::vector<const tree::SurfaceRoute*> routes;
  for (const Sliding& sliding : fingers) routes.push_back(sliding.route);
  Contacts stationary;
  for (FingerIndex finger{0}; finger < std::ssize(assignment); ++finger) {
    const bool slides = std::ranges::find(fingers, finger, &Sliding::finger) != fingers.end();
    if (!slides && assignment[finger] != kNone)
      stationary.push_back(memory.contact(assignment[finger]));
  }
  Slide slide{SynchronizeRoutes(routes), {}};
  std::vector<motion::GraspMotion> motions;
  for (std::size_t i = 0; i + 1 < slide.waypoints.size(); ++i) {
    motion::GraspMotion& motion = motions.emplace_back();
    for (std::size_t k = 0; k < fingers.size(); ++k) {
      motion.emplace_back(slide.waypoints[i][k], slide.waypoints[i + 1][k]);
    }
    for (const Contact& contact : stationary) motion.emplace_back(contact, contact);
    if (!motion::FindMotionProof(motion, memory.dimension(), memory.friction_angle(),
                                 kShortestPiece)) {
      return std::nullopt;
    }
  }
  const SlideFollower follower(setup, fingers, assignment);
  for (const motion::GraspMotion& motion : motions) {
    const Keyframe& at = slide.paths.empty() ? from : slide.paths.back().back();
    auto path = follower.Follow(motion, at, &motion == &motions.back());
    if (!path) return std::nullopt;
    slide.paths.push_back(*std::move(path));
  }
  return slide;
}

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
  const Change change = ChangeBetween(from.assignment, to.assignment);
  Keyframe frame = checker_.FrameAt(from, node);
  std::vector<PlanSegment> segments;
  const auto take = [&](std::optional<PlanSegment> segment) {
    if (!segment) return false;
    frame = segment->path.back();
    segments.push_back(*std::move(segment));
    return true;
  };
  const auto& [placed, released, slid] = change;
  if (!slid.empty() && !take(Slide(slid, from.assignment, to.assignment, node, frame))) {
    return std::nullopt;
  }
  if (placed.valid() && !take(Place(placed, to.assignment[placed], node, frame, rolled.before))) {
    return std::nullopt;
  }
  if (released.valid() &&
      !take(Release(released, from.assignment[released], to, node, frame, rolled.after))) {
    return std::nullopt;
  }
  return segments;
}

std::optional<PlanSegment> ChangePaths::Place(FingerIndex finger, int point, int node,
                                              const Keyframe& before, const RolledTips& rolled) {
  const JointConfiguration touching = *checker_.reach().Find(finger, point, node);
  Surroundings around = AllExcept(setup_.scene, finger, before);
  AddRolled(setup_.scene, rolled, around);
  const auto path =
      FindPathToContact(setup_.scene, setup_.inverse[finger], finger, before.configurations[finger],
                        TargetAt(setup_.scene.finger(finger), setup_.points[point], before.pose),
                        touching, around, random_);
  if (!path) return std::nullopt;
  PlanSegment segment{PlanSegment::Kind::kPlace, finger, point, {}};
  for (const JointConfiguration& configuration : *path)
    Append(before, finger, configuration, segment);
  return segment;
}

/// The finger moves to its idle configuration or, if there is no path, stops above its contact.
std::optional<PlanSegment> ChangePaths::Release(FingerIndex finger, int point, Stance& to, int node,
                                                const Keyframe& before, const RolledTips& rolled) {
  Surroundings around = AllExcept(setup_.scene, finger, before);
  AddRolled(setup_.scene, rolled, around);
  const auto lift_path =
      FindLiftPath(setup_.scene, setup_.inverse[finger], finger,
                   TargetAt(setup_.scene.finger(finger), setup_.points[point], before.pose),
                   before.configurations[finger], around);
  if (!lift_path) return std::nullopt;
  const auto free_path =
      FindFreePath(setup_.scene, finger, lift_path->back(), to.idle[finger], around, random_);
  FingerPath path = *lift_path;
  if (free_path) {
    path.insert(path.end(), free_path->begin() + 1, free_path->end());
  } else {
    to.idle[finger] = lift_path->back();
    if (!checker_.IsPassable(to, node)) return std::nullopt;
  }
  PlanSegment segment{PlanSegment::Kind::kRelease, finger, point, {}};
  for (const JointConfiguration& configuration : path)
    Append(before, finger, configuration, segment);
  return segment;
}

std::optional<PlanSegment> ChangePaths::Slide(const std::vector<FingerIndex>& slid,
                                              const ContactAssignment& from,
                                              const ContactAssignment& to, int node,
                                              const Keyframe& before) {
  PlanSegment segment{PlanSegment::Kind::kSlide, {}, kNone, {before}};
  std::vector<Sliding> fingers;
  for (const FingerIndex finger : slid) {
    segment.slid.push_back({finger, from[finger], to[finger]});
    fingers.push_back({finger, routes_.Between(from[finger], to[finger]),
                       checker_.reach().Find(finger, to[finger], node)});
  }
  auto slide = FindSlide(setup_, memory_, fingers, from, before);
  if (!slide) return std::nullopt;
  segment.waypoints = std::move(slide->waypoints);
  segment.waypoint_frames = {0};
  for (const std::vector<Keyframe>& path : slide->paths) {
    segment.path.insert(segment.path.end(), path.begin() + 1, path.end());
    segment.waypoint_frames.push_back(static_cast<int>(segment.path.size()) - 1);
  }
  return segment;
}

}  // namespace regrasp::gait
