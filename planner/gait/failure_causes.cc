#include "planner/gait/failure_causes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string_view>
#include <utility>

#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/object/body_measures.h"
#include "planner/plan/reason.h"

namespace regrasp::gait {
namespace {

using Eigen::Vector3d;

/// Sampled configurations of a finger, in addition to the combinations of its joint limits.
constexpr int kGripSamples = 200;
/// Steps of a track at which reach is tested.
constexpr int kReachSteps = 5;
/// Fewest evaluated grasps from which counts are conclusive.
constexpr std::int64_t kFewestGrasps = 20;
/// Share of grasps with colliding fingers, and of grasps or simulations lost by rolling, that
/// indicate a cause.
constexpr double kMostlyColliding = 0.9;
constexpr double kMostlyLost = 0.5;

std::string Newtons(double force) { return FormatShort(force, 3) + " N"; }

struct SampledTip {
  Vector3d centre;
  Vector3d axis;
};

std::vector<SampledTip> SampleTips(const kinematics::Finger& finger, RandomStream& random) {
  std::vector<SampledTip> tips;
  const auto add = [&](const JointConfiguration& configuration) {
    const kinematics::TipState tip = kinematics::TipAt(finger, configuration);
    tips.push_back({tip.centre, tip.axis});
  };
  JointConfiguration configuration(finger.drives);
  for (int corner = 0; corner < 1 << finger.drives; ++corner) {
    for (int i = 0; i < finger.drives; ++i) {
      configuration[i] = (corner >> i & 1) != 0 ? finger.upper[i] : finger.lower[i];
    }
    add(configuration);
  }
  for (int sample = 0; sample < kGripSamples; ++sample) {
    for (int i = 0; i < finger.drives; ++i) {
      configuration[i] = finger.lower[i] + random.Uniform() * (finger.upper[i] - finger.lower[i]);
    }
    add(configuration);
  }
  return tips;
}

std::optional<FailureCause> TooHeavy(const SearchEvidence& evidence) {
  if (!evidence.force || evidence.force->available >= evidence.force->required) return {};
  return FailureCause{"too-heavy",
                      "a failed grasp requires a force of " + Newtons(evidence.force->required) +
                          " to support a weight of " + Newtons(evidence.force->weight) +
                          ", the actuators exert " + Newtons(evidence.force->available)};
}

double LargestTipDiameter(const kinematics::HandModel& hand) {
  double radius = 0;
  for (const kinematics::Finger& finger : hand.fingers)
    radius = std::max(radius, finger.tip.radius);
  return 2 * radius;
}

std::optional<FailureCause> TooThickOrThin(const GaitRequest& request,
                                           const SearchEvidence& evidence) {
  const GaitCounts& counts = evidence.counts;
  const double width = request.scale * object::MeasureWidth(*request.solid);
  if (counts.evaluated == 0) {
    const GripRange grip = MeasureGripRange(*request.hand);
    if (width > grip.largest) {
      return FailureCause{"too-thick", "the object is " + FormatLength(width) +
                                           " wide, two fingertips grip at most " +
                                           FormatLength(grip.largest)};
    }
    const double diameter = request.scale * request.solid->diameter();
    if (diameter < grip.smallest) {
      return FailureCause{"too-thin", "the object measures " + FormatLength(diameter) +
                                          ", two fingertips come no closer than " +
                                          FormatLength(grip.smallest)};
    }
    return {};
  }
  const double tip = LargestTipDiameter(*request.hand);
  const bool collide = counts.evaluated >= kFewestGrasps &&
                       static_cast<double>(counts.colliding) >=
                           kMostlyColliding * static_cast<double>(counts.evaluated);
  if (!collide || width >= tip) return {};
  return FailureCause{"too-thin", "fingers collide in " + std::to_string(counts.colliding) +
                                      " of " + std::to_string(counts.evaluated) +
                                      " grasps, the object is " + FormatLength(width) +
                                      " wide and a fingertip " + FormatLength(tip)};
}

/// Fingers that reach the object at one pose.
struct FingersInReach {
  int count = 0;
  FingerIndex missing = {};  ///< of the other fingers, the one nearest to a contact
  double missing_by = 0;     ///< its distance from there, metres
  double fraction = 0;       ///< fraction of the track
};

FingersInReach InReachAt(const HandSetup& setup, const Eigen::Isometry3d& pose, double fraction) {
  FingersInReach in_reach;
  in_reach.fraction = fraction;
  in_reach.missing_by = std::numeric_limits<double>::infinity();
  for (FingerIndex finger{0}; finger < setup.scene.finger_count(); ++finger) {
    const kinematics::InverseKinematics& inverse = setup.inverse[finger];
    std::vector<kinematics::TipTarget> targets;
    for (const SurfacePoint& point : setup.points) {
      targets.push_back(TargetAt(setup.scene.finger(finger), point, pose));
    }
    if (std::ranges::any_of(targets,
                            [&](const auto& target) { return inverse.MayReach(target); })) {
      ++in_reach.count;
      continue;
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vector3d& tip : inverse.sampled_tips()) {
      for (const auto& target : targets) nearest = std::min(nearest, (tip - target.centre).norm());
    }
    if (nearest < in_reach.missing_by) {
      in_reach.missing_by = nearest;
      in_reach.missing = finger;
    }
  }
  return in_reach;
}

/// Return the pose of a track that the fewest fingers reach.
FingersInReach WorstReachOn(const HandSetup& setup, const PoseTrack& track) {
  FingersInReach worst;
  worst.count = setup.scene.finger_count() + 1;
  for (int k = 0; k < kReachSteps; ++k) {
    const double fraction = k / (kReachSteps - 1.0);
    const FingersInReach at = InReachAt(setup, track.PoseAt(fraction * track.steps()), fraction);
    if (at.count < worst.count) worst = at;
    if (track.steps() == 0) break;
  }
  return worst;
}

std::optional<FailureCause> OutOfReach(const HandSetup& setup, const SearchEvidence& evidence) {
  constexpr int kFewestHolding = 3;
  if (evidence.tracks.empty() || setup.points.empty()) return {};
  FingersInReach best;
  best.count = -1;
  for (const PoseTrack& track : evidence.tracks) {
    const FingersInReach worst = WorstReachOn(setup, track);
    if (worst.count > best.count) best = worst;
    if (best.count >= kFewestHolding) return {};
  }
  return FailureCause{
      "out-of-reach",
      "at " + FormatShort(100 * best.fraction, 3) + " % of the path " + std::to_string(best.count) +
          " of " + std::to_string(setup.scene.finger_count()) +
          " fingers reach the object, finger " + setup.scene.finger(best.missing).name + " is " +
          FormatLength(best.missing_by) + " away from its nearest contact"};
}

/// Such a finger never changes its contact, which ends a long rotation.
std::optional<FailureCause> AlwaysRequired(const kinematics::HandModel& hand,
                                           const GaitCounts& counts) {
  constexpr std::size_t kFewestHolding = 3;
  if (hand.fingers.size() <= kFewestHolding || counts.evaluated < kFewestGrasps) return {};
  std::string fingers;
  for (std::size_t finger = 0; finger < counts.holding.size(); ++finger) {
    if (counts.holding[finger] < counts.evaluated) continue;
    fingers += (fingers.empty() ? "" : " and ") + hand.fingers[finger].name;
  }
  if (fingers.empty()) return {};
  return FailureCause{"finger-always-required", "all " + std::to_string(counts.evaluated) +
                                                    " grasps are held by " + fingers +
                                                    ", which therefore keeps its contact"};
}

std::optional<FailureCause> RollOff(const SearchEvidence& evidence) {
  if (evidence.unrolled > 0) {
    return FailureCause{"contacts-roll-off", "contacts of " + std::to_string(evidence.unrolled) +
                                                 " found gaits cannot roll"};
  }
  const GaitCounts& counts = evidence.counts;
  if (counts.evaluated >= kFewestGrasps &&
      static_cast<double>(counts.rolled) >= kMostlyLost * static_cast<double>(counts.evaluated)) {
    return FailureCause{"contacts-roll-off", std::to_string(counts.rolled) +
                                                 " losses by rolling in " +
                                                 std::to_string(counts.evaluated) + " grasps"};
  }
  std::int64_t all = 0;
  std::int64_t lost = 0;
  for (const auto& [reason, count] : counts.execution_failures) {
    all += count;
    if (reason == plan::Reason::kSlipped || reason == plan::Reason::kContactLost) lost += count;
  }
  if (lost == 0 || static_cast<double>(lost) < kMostlyLost * static_cast<double>(all)) return {};
  return FailureCause{"contacts-roll-off", "fingertips leave their contacts in " +
                                               std::to_string(lost) + " of " + std::to_string(all) +
                                               " failed simulations"};
}

std::string SearchedText(const GaitRequest& request, const SearchEvidence& evidence) {
  return "in all searches " + CountText(evidence.counts.expanded, "stance") + " expanded from " +
         CountText(evidence.searches, SearchNoun(request)) + ", " +
         FormatShort(100 * evidence.farthest, 3) + " % of the path reached";
}

}  // namespace

std::string CountText(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string SearchNoun(const GaitRequest& request) {
  return request.start_pose ? "attempt" : "initial pose";
}

void SearchEvidence::Add(const std::vector<GaitCounts>& of_poses, bool counts_reach) {
  searches += static_cast<int>(of_poses.size());
  for (const GaitCounts& one : of_poses) {
    counts.Add(one);
    if (!counts_reach) continue;
    farthest = std::max(farthest, one.fraction());
  }
}

GripRange MeasureGripRange(const kinematics::HandModel& hand) {
  const double least_cosine = std::cos(kinematics::ConfigurationLimits().approach);
  RandomStream random(0, RandomUse::kHomes);
  std::vector<std::vector<SampledTip>> tips;
  for (const kinematics::Finger& finger : hand.fingers) tips.push_back(SampleTips(finger, random));
  GripRange range{std::numeric_limits<double>::infinity(), 0};
  for (std::size_t a = 0; a < tips.size(); ++a) {
    for (std::size_t b = a + 1; b < tips.size(); ++b) {
      const double radii = hand.fingers[a].tip.radius + hand.fingers[b].tip.radius;
      for (const SampledTip& one : tips[a]) {
        for (const SampledTip& other : tips[b]) {
          const Vector3d apart = other.centre - one.centre;
          const double distance = apart.norm();
          if (distance <= radii) {
            range.smallest = 0;
            continue;
          }
          const bool are_facing = one.axis.dot(apart) >= least_cosine * distance &&
                                  -other.axis.dot(apart) >= least_cosine * distance;
          if (!are_facing) continue;
          range.smallest = std::min(range.smallest, distance - radii);
          range.largest = std::max(range.largest, distance - radii);
        }
      }
    }
  }
  return range;
}

std::vector<FailureCause> LikelyCauses(const HandSetup& setup, const GaitRequest& request,
                                       const SearchEvidence& evidence) {
  std::vector<FailureCause> causes;
  const auto add = [&](std::optional<FailureCause> cause) {
    if (cause) causes.push_back(*std::move(cause));
  };
  add(TooHeavy(evidence));
  add(TooThickOrThin(request, evidence));
  add(OutOfReach(setup, evidence));
  add(AlwaysRequired(*request.hand, evidence.counts));
  add(RollOff(evidence));
  if (request.deadline.IsOver()) add(FailureCause{"time-limit", SearchedText(request, evidence)});
  if (causes.empty() && evidence.searches > 0)
    add(FailureCause{"search-budget", SearchedText(request, evidence)});
  return causes;
}

std::string CausesText(const std::vector<FailureCause>& causes) {
  if (causes.empty()) return "";
  std::string text;
  for (const auto& [name, figures] : causes) {
    text += (text.empty() ? "" : ", ") + name + " (" + figures + ")";
  }
  return (causes.size() > 1 ? "likely causes: " : "likely cause: ") + text;
}

}  // namespace regrasp::gait
