#include "planner/gait/hand_scene.h"

#include <algorithm>
#include <set>
#include <utility>

#include "planner/object/rotation.h"

namespace regrasp::gait {

using collision::AreApart;
using collision::BoundingSphere;
using collision::ConvexShape;
using collision::PosedShape;
using Eigen::Isometry3d;
using kinematics::Finger;
using kinematics::LinkShape;

namespace {

/// Fraction of a joint range at each end that sampled configurations avoid.
constexpr double kLimitClearance = 0.02;

/// Maximum change of a joint angle between adjacent grid nodes while a finger keeps its contact,
/// radians. A larger change indicates another branch of the inverse kinematics.
constexpr double kMaxJump = 0.35;
/// First stride of the search for the end of a run, steps; a power of two.
constexpr int kRunStride = 4;

/// Distance by which a shape may reach out of another one that contains it, metres: rounding.
constexpr double kContained = 1e-9;

/// Return whether a shape is inside another one.
bool IsInside(const ConvexShape& inner, const ConvexShape& outer) {
  const ConvexShape core{outer.points, 0};
  const double left = outer.radius - inner.radius;
  return left >= 0 && std::ranges::none_of(inner.points, [&](const Eigen::Vector3d& point) {
           return AreApart({{point}, 0}, core, left + kContained);
         });
}

/// Return whether the fingertip shape of a finger contains a covered shape, which then adds
/// nothing.
bool IsRedundant(const LinkShape& link, const std::vector<LinkShape>& shapes) {
  return link.role == LinkShape::Role::kCovered &&
         std::ranges::any_of(shapes, [&](const LinkShape& other) {
           return other.role == LinkShape::Role::kTip && IsInside(link.shape, other.shape);
         });
}

bool IsContinuous(const JointConfiguration& from, const JointConfiguration& to, int steps) {
  return (to - from).cwiseAbs().maxCoeff() <= steps * kMaxJump;
}

}  // namespace

HandScene::HandScene(const kinematics::HandModel& hand, const collision::SurfaceTree& surface,
                     double margin)
    : hand_(hand),
      surface_(surface),
      margin_(margin),
      object_reach_(surface.ReachFrom(Eigen::Vector3d::Zero())) {
  for (const Finger& finger : hand.fingers) {
    redundant_.emplace_back();
    for (const LinkShape& link : finger.shapes) {
      redundant_.back().push_back(IsRedundant(link, finger.shapes));
    }
  }
  for (const LinkShape& link : hand.palm) {
    palm_.push_back({&link.enclosing, Isometry3d::Identity(), BoundingSphereOf(link.enclosing)});
  }
  for (FingerIndex a{0}; a < std::ssize(hand.fingers); ++a) {
    with_palm_.push_back(CheckedPairs(a, {}));
    with_fingers_.emplace_back();
    for (FingerIndex b{0}; b < std::ssize(hand.fingers); ++b) {
      with_fingers_.back().push_back(CheckedPairs(a, b));
    }
  }
  for (const Finger& finger : hand.fingers) {
    balls_.emplace_back();
    reach_.emplace_back();
    for (const LinkShape& link : finger.shapes) {
      balls_.back().push_back(BoundingSphereOf(link.enclosing));
      reach_.back().push_back(kinematics::LinkReach(finger, link));
    }
  }
}

std::vector<HandScene::ShapePair> HandScene::CheckedPairs(FingerIndex a, FingerIndex b) const {
  const auto count = [&](FingerIndex finger) {
    return static_cast<int>((finger.valid() ? hand_.fingers[finger].shapes : hand_.palm).size());
  };
  const auto adds_nothing = [&](FingerIndex finger, int shape) {
    return finger.valid() && redundant_[finger][shape];
  };
  const std::set ignored(hand_.ignored.begin(), hand_.ignored.end());
  std::vector<ShapePair> pairs;
  for (int i = 0; i < count(a); ++i) {
    for (int j = a == b ? i + 1 : 0; j < count(b); ++j) {
      if (adds_nothing(a, i) || adds_nothing(b, j)) continue;
      if (!ignored.contains(std::minmax(Part{a, i}, Part{b, j}))) pairs.push_back({i, j});
    }
  }
  return pairs;
}

JointConfiguration HandScene::DrawConfiguration(FingerIndex finger, RandomStream& random) const {
  const Finger& chain = hand_.fingers[finger];
  JointConfiguration configuration(chain.drives);
  for (int i = 0; i < chain.drives; ++i) {
    configuration[i] =
        chain.lower[i] + (kLimitClearance + (1 - 2 * kLimitClearance) * random.Uniform()) *
                             (chain.upper[i] - chain.lower[i]);
  }
  return configuration;
}

PlacedFinger HandScene::Place(FingerIndex finger, const JointConfiguration& configuration) const {
  const Finger& chain = hand_.fingers[finger];
  const kinematics::JointFrames frames = kinematics::FramesOf(chain, configuration);
  PlacedFinger placed;
  placed.finger = finger;
  placed.shapes.reserve(chain.shapes.size());
  for (const LinkShape& link : chain.shapes) {
    const Isometry3d& frame = frames[link.after - 1];
    const BoundingSphere& ball = balls_[finger][placed.shapes.size()];
    placed.shapes.push_back({&link.enclosing, frame, {frame * ball.centre, ball.radius}});
  }
  return placed;
}

bool HandScene::KeepsOffHand(const PlacedFinger& placed, Motion motion) const {
  const double needed = Needed(motion);
  return std::ranges::all_of(with_palm_[placed.finger],
                             [&](const ShapePair& pair) {
                               return AreApart(placed.shapes[pair.a], palm_[pair.b], needed);
                             }) &&
         KeepApart(placed, placed, motion);
}

bool HandScene::KeepsOffObject(const PlacedFinger& placed, const Isometry3d& pose, TipContact tip,
                               Motion motion, Links links) const {
  const Isometry3d to_object = pose.inverse();
  const std::vector<LinkShape>& shapes = hand_.fingers[placed.finger].shapes;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    // The fingertip sphere is fitted into this geometry, which is therefore inside the object at a
    // contact.
    if (shapes[i].role == LinkShape::Role::kCovered) continue;
    const bool is_tip = shapes[i].role == LinkShape::Role::kTip;
    if (links != Links::kAll && is_tip != (links == Links::kTip)) continue;
    const PosedShape posed = Moved(to_object, placed.shapes[i]);
    if (!is_tip || tip == TipContact::kFree) {
      if (!surface_.IsApart(posed, Needed(motion))) return false;
      continue;
    }
    ConvexShape shape = ShapeOf(posed);
    shape.radius = std::max(0.0, shape.radius - kTipDepth);
    if (!surface_.IsApart(shape, motion.value_or(0))) return false;
  }
  return true;
}

bool HandScene::IsShallow(const PlacedFinger& placed, const Isometry3d& pose,
                          const Eigen::Vector3d& inward) const {
  const Finger& finger = hand_.fingers[placed.finger];
  // The depth along the normal is the shortest translation that moves a shape out.
  const Isometry3d out =
      pose.inverse() * Eigen::Translation3d(-kCoveredDepth * finger.tip.radius * inward);
  for (std::size_t i = 0; i < placed.shapes.size(); ++i) {
    if (finger.shapes[i].role != LinkShape::Role::kCovered || redundant_[placed.finger][i]) {
      continue;
    }
    if (!surface_.IsApart(Moved(out, placed.shapes[i]), 0)) return false;
  }
  return true;
}

double HandScene::DistanceFromObject(const PlacedFinger& placed, const Isometry3d& pose,
                                     double limit) const {
  const Isometry3d to_object = pose.inverse();
  for (std::size_t i = 0; i < placed.shapes.size(); ++i) {
    if (redundant_[placed.finger][i]) continue;
    const ConvexShape shape = ShapeOf(Moved(to_object, placed.shapes[i]));
    limit = std::min(limit, surface_.DistanceFrom(shape, limit));
  }
  return limit;
}

bool HandScene::KeepApart(const PlacedFinger& a, const PlacedFinger& b, Motion motion) const {
  const double needed = Needed(motion);
  return std::ranges::all_of(with_fingers_[a.finger][b.finger], [&](const ShapePair& pair) {
    return AreApart(a.shapes[pair.a], b.shapes[pair.b], needed);
  });
}

bool HandScene::KeepsOffPalm(const Isometry3d& pose, Motion motion) const {
  const Isometry3d to_object = pose.inverse();
  return std::ranges::all_of(palm_, [&](const PosedShape& link) {
    return surface_.IsApart(Moved(to_object, link), Needed(motion));
  });
}

double HandScene::MotionBound(FingerIndex finger, const JointConfiguration& from,
                              const JointConfiguration& to) const {
  const Finger& chain = hand_.fingers[finger];
  double bound = 0;
  for (std::size_t i = 0; i < chain.shapes.size(); ++i) {
    bound = std::max(
        bound, kinematics::MotionBound(chain, from, to, chain.shapes[i].after, reach_[finger][i]));
  }
  return bound;
}

double HandScene::MotionBound(const Isometry3d& from, const Isometry3d& to) const {
  const double turn = object::RotationInBody(from.linear(), to.linear()).angle();
  return (to.translation() - from.translation()).norm() + turn * object_reach_;
}

kinematics::TipTarget TargetAt(const kinematics::Finger& finger, const SurfacePoint& contact,
                               const Eigen::Isometry3d& pose) {
  return {pose * (contact.p - finger.tip.radius * contact.n), pose.linear() * contact.n};
}

std::optional<JointConfiguration> ReachMap::Compute(FingerIndex finger, int point, int node) const {
  const Eigen::Isometry3d pose = grid_.PoseAt(node);
  const kinematics::TipTarget target = TargetAt(scene_.finger(finger), points_[point], pose);
  std::optional<JointConfiguration> configuration = inverse_[finger].Solve(target);
  if (!configuration) return std::nullopt;
  const PlacedFinger placed = scene_.Place(finger, *configuration);
  if (!scene_.KeepsOffHand(placed)) return std::nullopt;
  if (!scene_.KeepsOffObject(placed, pose, TipContact::kTouching)) return std::nullopt;
  if (!scene_.IsShallow(placed, pose, target.towards)) return std::nullopt;
  return configuration;
}

ReachMap::Cached& ReachMap::CachedAt(FingerIndex finger, int point, int node) {
  const std::size_t finger_point = static_cast<std::size_t>(finger) * points_.size() + point;
  const auto [found, is_new] = cache_.try_emplace(finger_point * grid_.size() + node);
  if (is_new) found->second.configuration = Compute(finger, point, node);
  return found->second;
}

const JointConfiguration* ReachMap::Find(FingerIndex finger, int point, int node) {
  const Cached& cached = CachedAt(finger, point, node);
  return cached.configuration ? &*cached.configuration : nullptr;
}

void ReachMap::Set(FingerIndex finger, int point, int node,
                   const JointConfiguration& configuration) {
  CachedAt(finger, point, node) = {configuration, -1};
}

bool ReachMap::CanFollow(FingerIndex finger, int point, int node, int neighbour) {
  const JointConfiguration* from = Find(finger, point, node);
  const JointConfiguration* to = Find(finger, point, neighbour);
  return from != nullptr && to != nullptr && IsContinuous(*from, *to, 1);
}

int ReachMap::ComputeRunEnd(FingerIndex finger, int point, int node) {
  const JointConfiguration* at = Find(finger, point, node);
  for (int stride = kRunStride; stride > 0; stride /= 2) {
    while (true) {
      const int next = grid_.Onward(node, stride);
      const JointConfiguration* then =
          next == PoseGrid::kNoNode ? nullptr : Find(finger, point, next);
      if (then == nullptr || !IsContinuous(*at, *then, stride)) break;
      node = next;
      at = then;
    }
  }
  return grid_.StepOf(node);
}

int ReachMap::RunEnd(FingerIndex finger, int point, int node) {
  Cached& cached = CachedAt(finger, point, node);
  if (cached.run_end < 0) cached.run_end = ComputeRunEnd(finger, point, node);
  return cached.run_end;
}

}  // namespace regrasp::gait
