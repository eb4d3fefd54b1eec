#include "planner/gait/home.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace regrasp::gait {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kPlaces = 300;     // drawn, with a yaw each
constexpr int kPoints = 40;      // of the surface that are looked at
constexpr int kPosesOfTurn = 4;  // at which it is looked at them
constexpr int kHomes = 12;
constexpr int kDrawnGrasps = 150;  // at each pose
/// So many of the best by what tips may reach are looked at more closely.
constexpr int kCloser = 36;
/// Contacts within reach of a finger are worth their logarithm, so that all fingers count.
constexpr double kNoContact = 0.3;

constexpr int kParkingDraws = 120;
constexpr int kTrackSamples = 9;
constexpr double kParkingClearance = 0.02;  // metres: more counts for nothing
constexpr double kBendPenalty = 0.002;      // metres per radian

/// Turns z to `up`.
Eigen::Matrix3d Upright(const Vector3d& up) {
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up).toRotationMatrix();
}

double ScoreOf(const HandSetup& setup, const PoseTrack& track) {
  const int every = std::max<int>(1, static_cast<int>(setup.points.size()) / kPoints);
  double score = 0;
  for (int step = 0; step <= track.steps(); ++step) {
    const Isometry3d pose = track.PoseAt(step);
    if (!setup.scene.KeepsOffPalm(pose)) return -std::numeric_limits<double>::infinity();
    for (FingerIndex finger{0}; finger < setup.scene.finger_count(); ++finger) {
      const kinematics::Finger& chain = setup.scene.finger(finger);
      int reached = 0;
      for (std::size_t i = 0; i < setup.points.size(); i += every) {
        const kinematics::TipTarget target = TargetAt(chain, setup.points[i], pose);
        reached += static_cast<int>(setup.inverse[finger].MayReach(target));
      }
      score += std::log(kNoContact + reached);
    }
  }
  return score;
}

/// By grasps: of three contacts that three fingers reach without running into anything, drawn at
/// some poses of the turn, how many are force closure.
double CloserScoreOf(const HandSetup& setup, const PoseTrack& track, criteria::GraspMemory& memory,
                     RandomStream& random) {
  ReachMap reach(setup.scene, setup.inverse, setup.points, track);
  const int every = std::max<int>(1, static_cast<int>(setup.points.size()) / kPoints);
  double score = 0;
  for (int step = 0; step <= track.steps(); step += 2) {
    std::vector<std::vector<int>> reached;
    for (FingerIndex finger{0}; finger < setup.scene.finger_count(); ++finger) {
      std::vector<int> points;
      for (int point = 0; point < static_cast<int>(setup.points.size()); point += every) {
        if (reach.Find(finger, point, step) != nullptr) points.push_back(point);
      }
      if (!points.empty()) reached.push_back(std::move(points));
    }
    int grasps = 0;
    for (int i = 0; reached.size() >= 3 && i < kDrawnGrasps; ++i) {
      criteria::ContactSet set;
      for (const int finger : random.Choose(static_cast<int>(reached.size()), 3)) {
        const int point = reached[finger][random.Index(reached[finger].size())];
        if (!set.Has(point)) set.Insert(point);
      }
      grasps += static_cast<int>(set.size() == 3 && memory.Admits(set));
    }
    score += std::log(kNoContact + grasps);
  }
  return score;
}

}  // namespace

std::vector<Isometry3d> FindHomes(const HandSetup& setup, const Vector3d& centre, const Turn& turn,
                                  criteria::GraspMemory& memory, RandomStream& random) {
  Eigen::AlignedBox3d box;
  for (const kinematics::InverseKinematics& inverse : setup.inverse) {
    for (const Vector3d& tip : inverse.sampled_tips()) box.extend(tip);
  }
  const Eigen::Matrix3d upright = Upright(setup.scene.hand().up);
  struct Home {
    double score;
    Isometry3d pose;
  };
  std::vector<Home> homes;
  for (int i = 0; i < kPlaces; ++i) {
    Isometry3d pose = Isometry3d::Identity();
    const double yaw = 2 * std::numbers::pi * random.Uniform();
    pose.linear() = upright * Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
    Vector3d place;
    for (int k = 0; k < 3; ++k) place[k] = box.min()[k] + random.Uniform() * box.sizes()[k];
    pose.translation() = place - pose.linear() * centre;
    const PoseTrack track(pose, centre, turn.axis, turn.angle, kPosesOfTurn);
    homes.push_back({ScoreOf(setup, track), pose});
  }
  std::ranges::stable_sort(homes, std::greater<>(), &Home::score);
  homes.resize(std::min<std::size_t>(homes.size(), kCloser));
  for (Home& home : homes) {
    if (!std::isfinite(home.score)) continue;
    home.score = CloserScoreOf(
        setup, PoseTrack(home.pose, centre, turn.axis, turn.angle, kPosesOfTurn), memory, random);
  }
  std::ranges::stable_sort(homes, std::greater<>(), &Home::score);
  std::vector<Isometry3d> poses;
  for (const Home& home : homes) {
    if (static_cast<int>(poses.size()) == kHomes || !std::isfinite(home.score)) break;
    poses.push_back(home.pose);
  }
  return poses;
}

std::optional<Parking> FindParking(const HandSetup& setup, const PoseTrack& track,
                                   RandomStream& random) {
  const HandScene& scene = setup.scene;
  Parking parking;
  std::vector<PlacedFinger> parked;
  for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
    const kinematics::Finger& chain = scene.finger(finger);
    std::optional<Posture> best;
    double best_score = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < kParkingDraws; ++i) {
      Posture posture = setup.inverse[finger].middle();
      for (int k = 0; i > 0 && k < chain.drives; ++k) {
        posture[k] =
            chain.lower[k] + (0.02 + 0.96 * random.Uniform()) * (chain.upper[k] - chain.lower[k]);
      }
      const PlacedFinger placed = scene.Place(finger, posture);
      if (!scene.KeepsOffHand(placed)) continue;
      if (!std::ranges::all_of(
              parked, [&](const PlacedFinger& other) { return scene.KeepApart(placed, other); })) {
        continue;
      }
      double clearance = kParkingClearance;
      for (int k = 0; k < kTrackSamples && clearance > 0; ++k) {
        const Isometry3d pose = track.PoseAt(track.steps() * k / (kTrackSamples - 1.0));
        clearance = std::min(clearance, scene.DistanceFromObject(placed, pose, clearance));
      }
      if (clearance <= scene.margin() + kSpare) continue;
      // Far enough off, it had better stay where it is soon back.
      const double bent = (posture - setup.inverse[finger].middle()).norm();
      const double score = clearance - kBendPenalty * bent;
      if (score <= best_score) continue;
      best_score = score;
      best = posture;
    }
    if (!best) return std::nullopt;
    parking.push_back(*best);
    parked.push_back(scene.Place(finger, *best));
  }
  return parking;
}

}  // namespace regrasp::gait
