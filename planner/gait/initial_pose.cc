#include "planner/gait/initial_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace regrasp::gait {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kPlaces = 300;        // drawn, with a yaw each
constexpr int kMostDrawn = 60'000;  // where a grasp is given that most poses don't suit
constexpr int kPoints = 40;         // of the surface that are looked at
constexpr int kPosesOfTurn = 4;     // at which it is looked at them
constexpr int kHomes = 24;
constexpr int kHomeGrasps = 150;  // at each pose
/// So many of the best by what tips may reach are looked at more closely.
constexpr int kCloser = 36;
/// Contacts within reach of a finger are worth their logarithm, so that all fingers count.
constexpr double kNoContact = 0.3;

constexpr int kParkingDraws = 160;
constexpr int kMostParkingDraws = 5000;  // where a finger has hardly any place
constexpr int kParkingPlaces = 16;
constexpr double kOtherPlace = 0.5;  // radians over all drives
constexpr int kTrackSamples = 5;
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

/// A contact that a finger reaches, and the finger there.
struct Reached {
  int point;
  PlacedFinger placed;
};

/// Whether these three fingers, each at a contact of its own drawn for it, hold the object and keep
/// off each other.
bool DrawGrasp(const HandSetup& setup, const std::vector<std::vector<Reached>>& reached,
               const std::vector<int>& fingers, criteria::GraspMemory& memory,
               RandomStream& random) {
  std::vector<const Reached*> drawn;
  criteria::ContactSet set;
  for (const int finger : fingers) {
    if (reached[finger].empty()) return false;
    drawn.push_back(&reached[finger][random.Index(reached[finger].size())]);
    if (!set.Has(drawn.back()->point)) set.Insert(drawn.back()->point);
  }
  if (set.size() < 3 || !memory.Admits(set)) return false;
  return setup.scene.KeepApart(drawn[0]->placed, drawn[1]->placed) &&
         setup.scene.KeepApart(drawn[0]->placed, drawn[2]->placed) &&
         setup.scene.KeepApart(drawn[1]->placed, drawn[2]->placed);
}

/// By grasps: of three contacts that three fingers reach without running into anything, drawn at
/// some poses of the turn, how many hold the object, and how many without a finger, so that it is
/// free to go on, for each of them.
double CloserScoreOf(const HandSetup& setup, const PoseTrack& track, criteria::GraspMemory& memory,
                     RandomStream& random) {
  const PoseGrid grid(track, setup.scene.hand().up, PoseGrid::End::kPose);
  ReachMap reach(setup.scene, setup.inverse, setup.points, grid);
  const int every = std::max<int>(1, static_cast<int>(setup.points.size()) / kPoints);
  double score = 0;
  for (int node = grid.start(); node != PoseGrid::kNoNode; node = grid.Onward(node)) {
    std::vector<std::vector<Reached>> reached;
    for (FingerIndex finger{0}; finger < setup.scene.finger_count(); ++finger) {
      std::vector<Reached> contacts;
      for (int point = 0; point < static_cast<int>(setup.points.size()); point += every) {
        const Posture* posture = reach.Find(finger, point, node);
        if (posture != nullptr) contacts.push_back({point, setup.scene.Place(finger, *posture)});
      }
      reached.push_back(std::move(contacts));
    }
    int grasps = 0;
    std::vector<int> grasps_without(reached.size(), 0);
    for (int i = 0; reached.size() >= 3 && i < kHomeGrasps; ++i) {
      const std::vector<int> fingers = random.Choose(static_cast<int>(reached.size()), 3);
      if (!DrawGrasp(setup, reached, fingers, memory, random)) continue;
      ++grasps;
      for (int& count : grasps_without) ++count;
      for (const int finger : fingers) --grasps_without[finger];
    }
    score += std::log(kNoContact + grasps);
    for (const int count : grasps_without) score += std::log(kNoContact + count);
  }
  return score;
}

/// Whether tips may be at all contacts of a grasp, each at one: by the tables of reach alone.
bool MayHold(const HandSetup& setup, const std::vector<int>& grasp, const Isometry3d& pose) {
  std::vector<std::vector<int>> fingers_of;  // by contact
  for (const int point : grasp) {
    fingers_of.emplace_back();
    for (FingerIndex finger{0}; finger < setup.scene.finger_count(); ++finger) {
      const auto target = TargetAt(setup.scene.finger(finger), setup.points[point], pose);
      if (setup.inverse[finger].MayReach(target)) fingers_of.back().push_back(finger);
    }
    if (fingers_of.back().empty()) return false;
  }
  std::vector<bool> taken(setup.scene.finger_count(), false);
  const auto match = [&](const auto& self, std::size_t contact) -> bool {
    if (contact == fingers_of.size()) return true;
    return std::ranges::any_of(fingers_of[contact], [&](int finger) {
      if (taken[finger]) return false;
      taken[finger] = true;
      const bool matched = self(self, contact + 1);
      taken[finger] = false;
      return matched;
    });
  };
  return match(match, 0);
}

/// Draws poses for an object to begin in.
class PoseDraw {
 public:
  PoseDraw(const HandSetup& setup, const ObjectTask& task, const GaitEnds& ends,
           RandomStream& random)
      : setup_(setup),
        task_(task),
        grasp_(ends.start.empty() ? ends.goal : ends.start),
        upright_(Upright(setup.scene.hand().up)),
        random_(random) {
    for (const kinematics::InverseKinematics& inverse : setup.inverse) {
      for (const Vector3d& tip : inverse.sampled_tips()) box_.extend(tip);
    }
  }

  Isometry3d Next() { return grasp_.empty() ? Anywhere() : WithAContactAtATip(); }

 private:
  Isometry3d Anywhere() {
    Isometry3d pose = Isometry3d::Identity();
    const double yaw = 2 * std::numbers::pi * random_.Uniform();
    pose.linear() = upright_ * Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
    Vector3d place;
    for (int k = 0; k < 3; ++k) place[k] = box_.min()[k] + random_.Uniform() * box_.sizes()[k];
    pose.translation() = place - pose.linear() * task_.centre();
    return pose;
  }
  /// With any orientation.
  Isometry3d WithAContactAtATip() {
    const FingerIndex finger{static_cast<int>(random_.Index(setup_.inverse.size()))};
    const std::vector<Vector3d>& tips = setup_.inverse[finger].sampled_tips();
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() = DrawTurn(random_);
    const Vector3d centre = TargetAt(setup_.scene.finger(finger),
                                     setup_.points[grasp_[random_.Index(grasp_.size())]], pose)
                                .centre;
    pose.translation() = tips[random_.Index(tips.size())] - centre;
    return pose;
  }

  const HandSetup& setup_;
  const ObjectTask& task_;
  const std::vector<int>& grasp_;
  Eigen::AlignedBox3d box_;
  Eigen::Matrix3d upright_;
  RandomStream& random_;
};

}  // namespace

std::vector<Isometry3d> FindInitialPoses(const HandSetup& setup, const ObjectTask& task,
                                         const GaitEnds& ends, criteria::GraspMemory& memory,
                                         RandomStream& random) {
  PoseDraw draw(setup, task, ends, random);
  struct Home {
    double score;
    Isometry3d pose;
  };
  std::vector<Home> homes;
  for (int i = 0; i < kMostDrawn && static_cast<int>(homes.size()) < kPlaces; ++i) {
    const Isometry3d pose = draw.Next();
    const PoseTrack track = task.From(pose, kPosesOfTurn);
    if (!MayHold(setup, ends.start, pose)) continue;
    if (!MayHold(setup, ends.goal, track.PoseAt(track.steps()))) continue;
    homes.push_back({ScoreOf(setup, track), pose});
  }
  std::ranges::stable_sort(homes, std::greater<>(), &Home::score);
  homes.resize(std::min<std::size_t>(homes.size(), kCloser));
  for (Home& home : homes) {
    if (!std::isfinite(home.score)) continue;
    home.score = CloserScoreOf(setup, task.From(home.pose, kPosesOfTurn / 2), memory, random);
  }
  std::ranges::stable_sort(homes, std::greater<>(), &Home::score);
  std::vector<Isometry3d> poses;
  for (const Home& home : homes) {
    if (static_cast<int>(poses.size()) == kHomes || !std::isfinite(home.score)) break;
    poses.push_back(home.pose);
  }
  return poses;
}

std::optional<IdlePostures> FindIdlePostures(const HandSetup& setup, const PoseTrack& track,
                                             RandomStream& random) {
  struct Place {
    double score;
    Posture posture;
  };
  const HandScene& scene = setup.scene;
  const int samples = track.steps() == 0 ? 1 : kTrackSamples;
  IdlePostures idle_postures(scene.finger_count());
  for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
    std::vector<Place> places;
    for (int i = 0; i < kParkingDraws || (i < kMostParkingDraws && places.empty()); ++i) {
      const Posture& middle = setup.inverse[finger].middle();
      Posture posture = i == 0 ? middle : scene.DrawPosture(finger, random);
      const PlacedFinger placed = scene.Place(finger, posture);
      if (!scene.KeepsOffHand(placed)) continue;
      double clearance = kParkingClearance;
      for (int k = 0; k < samples && clearance > scene.margin() + kPostureMargin; ++k) {
        const Isometry3d pose = track.PoseAt(track.steps() * k / (kTrackSamples - 1.0));
        clearance = std::min(clearance, scene.DistanceFromObject(placed, pose, clearance));
      }
      if (clearance <= scene.margin() + kPostureMargin) continue;
      // Far enough off, it had better stay where it is soon back.
      const double bent = (posture - middle).norm();
      places.push_back({clearance - kBendPenalty * bent, std::move(posture)});
    }
    std::ranges::stable_sort(places, std::greater<>(), &Place::score);
    for (Place& place : places) {
      std::vector<Posture>& chosen = idle_postures[finger];
      if (static_cast<int>(chosen.size()) == kParkingPlaces) break;
      const bool is_other = std::ranges::all_of(chosen, [&](const Posture& posture) {
        return (posture - place.posture).norm() > kOtherPlace;
      });
      if (is_other) chosen.push_back(std::move(place.posture));
    }
    if (idle_postures[finger].empty()) return std::nullopt;
  }
  return idle_postures;
}

}  // namespace regrasp::gait
