#include "planner/gait/hand_scene.h"

#include <algorithm>
#include <utility>

namespace regrasp::gait {

using collision::AreApart;
using collision::Ball;
using collision::ConvexShape;
using Eigen::Isometry3d;
using kinematics::Finger;
using kinematics::LinkShape;

namespace {

bool AreApart(const ConvexShape& a, const Ball& ball_a, const ConvexShape& b, const Ball& ball_b,
              double distance) {
  const double apart = ball_a.radius + ball_b.radius + distance;
  if ((ball_a.centre - ball_b.centre).squaredNorm() > apart * apart) return true;
  return collision::AreApart(a, b, distance);
}

}  // namespace

HandScene::HandScene(const kinematics::HandModel& hand, const collision::SurfaceTree& surface,
                     double margin)
    : hand_(hand),
      surface_(surface),
      margin_(margin),
      object_reach_(surface.ReachFrom(Eigen::Vector3d::Zero())) {
  for (const LinkShape& link : hand.palm) palm_balls_.push_back(BallAround(link.shape));
  for (const Finger& finger : hand.fingers) {
    reach_.emplace_back();
    for (const LinkShape& link : finger.shapes) {
      reach_.back().push_back(kinematics::LinkReach(finger, link));
    }
  }
}

bool HandScene::IsIgnored(const Part& a, const Part& b) const {
  return std::ranges::binary_search(
      hand_.ignored, std::minmax(a, b), [](const auto& x, const auto& y) {
        return std::pair(x.first, x.second) < std::pair(y.first, y.second);
      });
}

PlacedFinger HandScene::Place(FingerIndex finger, const Posture& posture) const {
  const Finger& chain = hand_.fingers[finger];
  const kinematics::JointFrames frames = kinematics::FramesOf(chain, posture);
  PlacedFinger placed;
  placed.finger = finger;
  for (const LinkShape& link : chain.shapes) {
    placed.shapes.push_back(collision::Moved(frames[link.after - 1], link.shape));
    placed.balls.push_back(BallAround(placed.shapes.back()));
  }
  return placed;
}

bool HandScene::KeepsOffHand(const PlacedFinger& placed, Motion motion) const {
  const int count = static_cast<int>(placed.shapes.size());
  for (int i = 0; i < count; ++i) {
    const Part part{placed.finger, i};
    for (int j = 0; j < static_cast<int>(hand_.palm.size()); ++j) {
      if (AreApart(placed.shapes[i], placed.balls[i], hand_.palm[j].shape, palm_balls_[j],
                   Needed(motion))) {
        continue;
      }
      if (!IsIgnored(part, {FingerIndex{}, j})) return false;
    }
    for (int j = i + 1; j < count; ++j) {
      if (AreApart(placed.shapes[i], placed.balls[i], placed.shapes[j], placed.balls[j],
                   Needed(motion))) {
        continue;
      }
      if (!IsIgnored(part, {placed.finger, j})) return false;
    }
  }
  return true;
}

bool HandScene::KeepsOffObject(const PlacedFinger& placed, const Isometry3d& pose, TipContact tip,
                               Motion motion) const {
  const Isometry3d to_object = pose.inverse();
  const std::vector<LinkShape>& links = hand_.fingers[placed.finger].shapes;
  for (std::size_t i = 0; i < links.size(); ++i) {
    ConvexShape shape = collision::Moved(to_object, placed.shapes[i]);
    double distance = Needed(motion);
    if (links[i].is_tip && tip == TipContact::kTouching) {
      shape.radius = std::max(0.0, shape.radius - kTipDepth);
      distance = motion.value_or(0);
    }
    if (!surface_.IsApart(shape, distance)) return false;
  }
  return true;
}

double HandScene::DistanceFromObject(const PlacedFinger& placed, const Isometry3d& pose,
                                     double limit) const {
  const Isometry3d to_object = pose.inverse();
  for (const ConvexShape& shape : placed.shapes) {
    limit = std::min(limit, surface_.DistanceFrom(collision::Moved(to_object, shape), limit));
  }
  return limit;
}

bool HandScene::KeepApart(const PlacedFinger& a, const PlacedFinger& b, Motion motion) const {
  for (std::size_t i = 0; i < a.shapes.size(); ++i) {
    for (std::size_t j = 0; j < b.shapes.size(); ++j) {
      if (AreApart(a.shapes[i], a.balls[i], b.shapes[j], b.balls[j], Needed(motion))) continue;
      if (!IsIgnored({a.finger, static_cast<int>(i)}, {b.finger, static_cast<int>(j)})) {
        return false;
      }
    }
  }
  return true;
}

bool HandScene::KeepsOffPalm(const Isometry3d& pose, Motion motion) const {
  const Isometry3d to_object = pose.inverse();
  return std::ranges::all_of(hand_.palm, [&](const LinkShape& link) {
    return surface_.IsApart(collision::Moved(to_object, link.shape), Needed(motion));
  });
}

double HandScene::MotionBound(FingerIndex finger, const Posture& from, const Posture& to) const {
  const Finger& chain = hand_.fingers[finger];
  double bound = 0;
  for (std::size_t i = 0; i < chain.shapes.size(); ++i) {
    bound = std::max(
        bound, kinematics::MotionBound(chain, from, to, chain.shapes[i].after, reach_[finger][i]));
  }
  return bound;
}

double HandScene::MotionBound(const Isometry3d& from, const Isometry3d& to) const {
  const Eigen::AngleAxisd turn(from.linear().transpose() * to.linear());
  return (to.translation() - from.translation()).norm() + std::abs(turn.angle()) * object_reach_;
}

}  // namespace regrasp::gait
