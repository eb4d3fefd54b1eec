#include "planner/gait/initial_pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "planner/object/rotation.h"

namespace regrasp::gait {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Number of candidate poses, and of draws for them: few poses suit a given grasp.
constexpr int kPoseDraws = 300;
constexpr int kMaxPoseDraws = 60'000;
/// First score: number of contacts, and of steps of the task.
constexpr int kScoredContacts = 40;
constexpr int kTaskSteps = 4;
/// Number of candidates that receive the second score, and of grasps drawn for each.
constexpr int kMaxRefined = 36;
constexpr int kGraspDraws = 150;
constexpr int kMaxInitialPoses = 24;
/// Turn about a nearly vertical axis, in radians, above which the object may also begin on a side.
/// Its axis is then horizontal, so that more fingers can turn it.
constexpr double kLongTurn = std::numbers::pi;
/// Largest angle of that axis from the vertical, radians.
constexpr double kNearVertical = std::numbers::pi / 4;
/// Turn about any axis, in radians, above which a slender object may also begin on a side.
/// End over end, it then turns in a horizontal plane instead of through the palm.
constexpr double kLongSlenderTurn = 1.75;
constexpr int kSides = 4;  ///< sides on which an object can lie: ±x and ±y up
/// Offset in the logarithm of the number of reachable contacts.
/// The logarithm makes all fingers count.
constexpr double kNoContact = 0.3;

/// Number of sampled idle configurations; the maximum applies to a finger with little free space.
constexpr int kIdleSamples = 160;
constexpr int kMaxIdleSamples = 5000;
constexpr int kMaxIdleConfigurations = 16;
/// Minimum distance between two idle configurations of a finger, rad, norm over joints.
constexpr double kDistinctConfiguration = 0.5;
/// Poses of the track from which an idle configuration must be clear.
constexpr int kTrackSamples = 5;
constexpr double kMaxIdleClearance = 0.02;  // metres; additional clearance is not rewarded
constexpr double kBendPenalty = 0.002;      // metres per radian

/// Return a rotation that maps a horizontal coordinate axis of the object to the z axis.
/// @param side  0 for +x, 1 for −x, 2 for +y, 3 for −y.
Eigen::Matrix3d OnSide(int side) {
  const Vector3d axis = (side % 2 == 0 ? 1 : -1) * Vector3d::Unit(side / 2);
  return object::AligningRotation(axis, Vector3d::UnitZ()).toRotationMatrix();
}

/// Return whether an upright object turns long about a nearly vertical axis.
bool TurnsAboutVertical(const Turn& turn) {
  return std::abs(turn.angle) > kLongTurn &&
         std::abs(turn.axis.z()) > std::cos(kNearVertical) * turn.axis.norm();
}

/// Return the rotation that maps the z axis to `up`.
Eigen::Matrix3d Upright(const Vector3d& up) {
  return object::AligningRotation(Vector3d::UnitZ(), up).toRotationMatrix();
}

double ScoreOf(const HandSetup& setup, const PoseTrack& track) {
  const int every = std::max<int>(1, static_cast<int>(setup.points.size()) / kScoredContacts);
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

/// A contact that a finger reaches, with the placed finger.
struct Reached {
  int point;
  PlacedFinger placed;
};

/// Draw one contact for each of three fingers.
/// @returns whether they form an admissible grasp of fingers that are clear of each other.
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

/// Score a pose by its admissible grasps.
/// At some steps of the task, draws grasps of three fingers at contacts that they reach. Counts the
/// collision-free admissible ones, in total and, for each finger, those without it, so that this
/// finger is free to move.
double GraspScoreOf(const HandSetup& setup, const PoseTrack& track, criteria::GraspMemory& memory,
                    RandomStream& random) {
  const PoseGrid grid(track, setup.scene.hand().up, PoseGrid::End::kPose);
  ReachMap reach(setup.scene, setup.inverse, setup.points, grid);
  const int every = std::max<int>(1, static_cast<int>(setup.points.size()) / kScoredContacts);
  double score = 0;
  for (int node = grid.start(); node != PoseGrid::kNoNode; node = grid.Onward(node)) {
    std::vector<std::vector<Reached>> reached;
    for (FingerIndex finger{0}; finger < setup.scene.finger_count(); ++finger) {
      std::vector<Reached> contacts;
      for (int point = 0; point < static_cast<int>(setup.points.size()); point += every) {
        const JointConfiguration* configuration = reach.Find(finger, point, node);
        if (configuration != nullptr)
          contacts.push_back({point, setup.scene.Place(finger, *configuration)});
      }
      reached.push_back(std::move(contacts));
    }
    int grasps = 0;
    std::vector<int> grasps_without(reached.size(), 0);
    for (int i = 0; reached.size() >= 3 && i < kGraspDraws; ++i) {
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

/// Return whether distinct fingers may reach all contacts of a grasp.
/// Uses the reach tables only.
bool MayReachAll(const HandSetup& setup, const std::vector<int>& grasp, const Isometry3d& pose) {
  std::vector<std::vector<int>> fingers_of;  // [contact]
  for (const int point : grasp) {
    fingers_of.emplace_back();
    for (FingerIndex finger{0}; finger < setup.scene.finger_count(); ++finger) {
      const auto target = TargetAt(setup.scene.finger(finger), setup.points[point], pose);
      if (setup.inverse[finger].MayReach(target)) fingers_of.back().push_back(finger);
    }
    if (fingers_of.back().empty()) return false;
  }
  std::vector<bool> used(setup.scene.finger_count(), false);
  const auto match = [&](const auto& self, std::size_t contact) -> bool {
    if (contact == fingers_of.size()) return true;
    return std::ranges::any_of(fingers_of[contact], [&](int finger) {
      if (used[finger]) return false;
      used[finger] = true;
      const bool matched = self(self, contact + 1);
      used[finger] = false;
      return matched;
    });
  };
  return match(match, 0);
}

/// Sampler of initial object poses.
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

  Isometry3d Next() {
    if (!grasp_.empty()) return WithContactAtFingertip();
    const bool may_lie =
        TurnsAboutVertical(task_.turn()) ||
        (setup_.relative_width < kSlender && std::abs(task_.turn().angle) > kLongSlenderTurn);
    const int side = may_lie ? static_cast<int>(random_.Index(2 * kSides)) - kSides : -1;
    return PoseOn(side < 0 ? Eigen::Matrix3d::Identity() : OnSide(side));
  }

 private:
  /// @param side  rotation of the upright object onto the side on which it begins.
  Isometry3d PoseOn(const Eigen::Matrix3d& side) {
    Isometry3d pose = Isometry3d::Identity();
    const double yaw = 2 * std::numbers::pi * random_.Uniform();
    pose.linear() = upright_ * Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix() * side;
    Vector3d position;
    for (int k = 0; k < 3; ++k) position[k] = box_.min()[k] + random_.Uniform() * box_.sizes()[k];
    pose.translation() = position - pose.linear() * task_.centre();
    return pose;
  }
  /// Draws any orientation.
  Isometry3d WithContactAtFingertip() {
    const FingerIndex finger{static_cast<int>(random_.Index(setup_.inverse.size()))};
    const std::vector<Vector3d>& tips = setup_.inverse[finger].sampled_tips();
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() = DrawOrientation(random_);
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
  struct Candidate {
    double score;
    Isometry3d pose;
  };
  std::vector<Candidate> candidates;
  for (int i = 0; i < kMaxPoseDraws && static_cast<int>(candidates.size()) < kPoseDraws; ++i) {
    const Isometry3d pose = draw.Next();
    const PoseTrack track = task.From(pose, kTaskSteps);
    if (!MayReachAll(setup, ends.start, pose)) continue;
    if (!MayReachAll(setup, ends.goal, track.PoseAt(track.steps()))) continue;
    candidates.push_back({ScoreOf(setup, track), pose});
  }
  std::ranges::stable_sort(candidates, std::greater<>(), &Candidate::score);
  candidates.resize(std::min<std::size_t>(candidates.size(), kMaxRefined));
  for (Candidate& candidate : candidates) {
    if (!std::isfinite(candidate.score)) continue;
    candidate.score =
        GraspScoreOf(setup, task.From(candidate.pose, kTaskSteps / 2), memory, random);
  }
  std::ranges::stable_sort(candidates, std::greater<>(), &Candidate::score);
  std::vector<Isometry3d> poses;
  for (const Candidate& candidate : candidates) {
    if (static_cast<int>(poses.size()) == kMaxInitialPoses || !std::isfinite(candidate.score))
      break;
    poses.push_back(candidate.pose);
  }
  return poses;
}

std::optional<IdleConfigurations> FindIdleConfigurations(const HandSetup& setup,
                                                         const PoseTrack& track,
                                                         RandomStream& random) {
  struct Candidate {
    double score;
    JointConfiguration configuration;
  };
  const HandScene& scene = setup.scene;
  const int samples = track.steps() == 0 ? 1 : kTrackSamples;
  IdleConfigurations idle_configurations(scene.finger_count());
  for (FingerIndex finger{0}; finger < scene.finger_count(); ++finger) {
    std::vector<Candidate> candidates;
    for (int i = 0; i < kIdleSamples || (i < kMaxIdleSamples && candidates.empty()); ++i) {
      const JointConfiguration& middle = setup.inverse[finger].middle();
      JointConfiguration configuration = i == 0 ? middle : scene.DrawConfiguration(finger, random);
      const PlacedFinger placed = scene.Place(finger, configuration);
      if (!scene.KeepsOffHand(placed)) continue;
      double clearance = kMaxIdleClearance;
      for (int k = 0; k < samples && clearance > scene.margin() + kConfigurationMargin; ++k) {
        const Isometry3d pose = track.PoseAt(track.steps() * k / (kTrackSamples - 1.0));
        clearance = std::min(clearance, scene.DistanceFromObject(placed, pose, clearance));
      }
      if (clearance <= scene.margin() + kConfigurationMargin) continue;
      // Beyond the maximum clearance, prefer configurations near the middle of the joint ranges.
      const double bend = (configuration - middle).norm();
      candidates.push_back({clearance - kBendPenalty * bend, std::move(configuration)});
    }
    std::ranges::stable_sort(candidates, std::greater<>(), &Candidate::score);
    for (Candidate& candidate : candidates) {
      std::vector<JointConfiguration>& chosen = idle_configurations[finger];
      if (static_cast<int>(chosen.size()) == kMaxIdleConfigurations) break;
      const bool is_distinct =
          std::ranges::all_of(chosen, [&](const JointConfiguration& configuration) {
            return (configuration - candidate.configuration).norm() > kDistinctConfiguration;
          });
      if (is_distinct) chosen.push_back(std::move(candidate.configuration));
    }
    if (idle_configurations[finger].empty()) return std::nullopt;
  }
  return idle_configurations;
}

}  // namespace regrasp::gait
