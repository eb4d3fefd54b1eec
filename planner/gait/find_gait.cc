#include "planner/gait/find_gait.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <mutex>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/gait/failure_causes.h"
#include "planner/gait/gait_search.h"
#include "planner/gait/multi_start_search.h"
#include "planner/gait/plan_of_gait.h"
#include "planner/gait/rolled_gait.h"
#include "planner/gait/schedule.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/object/body_measures.h"
#include "planner/plan/reason.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::gait {
namespace {

constexpr int kContacts = 400;
/// Minimum distance between contacts and sharp edges, in diameters.
/// A fingertip that slips a little stays on its face.
constexpr double kEdgeClearance = 0.02;
/// Spatial grasps have at least three contacts.
constexpr std::size_t kFewestHoldingFingers = 3;
/// Distances are exact up to this value.
constexpr double kFarAway_m = 1e3;

std::vector<grasp::Contact> DrawContacts(const GaitRequest& request) {
  const sampling::SurfaceSampler sampler(*request.solid, FingersOf(request).fingertip_radius,
                                         kEdgeClearance);
  RandomStream random(request.seed, RandomUse::kContactPoints);
  std::vector<grasp::Contact> contacts;
  for (int i = 0; i < kContacts; ++i) {
    if (const auto contact = sampler.TryDraw(random)) contacts.push_back(*contact);
  }
  return contacts;
}

std::string ProgressText(const GaitRequest& request, const GaitCounts& counts) {
  const double fraction = counts.fraction();
  if (fraction == 1 && !request.goal_grasp.empty()) return "the goal grasp is not reached";
  if (fraction == 1 && request.goal && request.goal->facing() != nullptr && counts.at_goal == 0) {
    return "the object gets close to its goal, but no stable grasp is found there";
  }
  if (fraction == 1 && request.goal && counts.at_goal == 0) {
    return "the object gets close to its goal pose, but no stable grasp is found there";
  }
  if (fraction == 1) return "every path to the goal is infeasible";
  if (request.goal) {
    return "the object reaches " + FormatShort(100 * fraction, 3) + " % of the path to its goal" +
           (request.goal->pose() != nullptr ? " pose" : "");
  }
  return "the hand rotates the object by " +
         FormatShort(fraction * Degrees(request.turn.angle), 3) + " of " +
         FormatShort(Degrees(request.turn.angle), 3) + " degrees";
}

/// Example: "slipped 5, hand-collides 2".
std::string FailuresText(const FailureCounts& failures) {
  std::string text;
  for (const auto& [reason, count] : failures) {
    text += (text.empty() ? "" : ", ") + std::string(plan::ReasonName(reason)) + " " +
            std::to_string(count);
  }
  return text;
}

/// Describe why no search succeeded, with the counts of the search that moved the object farthest.
std::string FailureSummary(const GaitRequest& request, const std::vector<GaitCounts>& counts) {
  if (counts.empty()) {
    if (request.deadline.IsOver()) return "no initial pose was searched";
    std::string text =
        "no initial pose found: the object must be within reach of the fingers and clear of the "
        "palm";
    if (!request.start_grasp.empty()) text += ", held by the start grasp";
    if (!request.goal_grasp.empty()) text += ", held by the goal grasp at the end";
    return text;
  }
  const GaitCounts& best = *std::ranges::max_element(
      counts, {}, [](const GaitCounts& one) { return std::pair(one.fraction(), one.evaluated); });
  std::string text = ProgressText(request, best) + "; the best of " +
                     CountText(std::ssize(counts), SearchNoun(request)) + " has " +
                     CountText(best.evaluated, "grasp");
  const auto add = [&](std::int64_t count, const std::string& what) {
    if (count > 0) text += ", " + std::to_string(count) + " " + what;
  };
  add(best.colliding, "in which fingers collide");
  add(best.path_failures.no_path, "for which a finger has no free path");
  add(best.path_failures.no_slide, "for which a finger cannot slide");
  add(best.path_failures.no_move, "with infeasible in-hand motions");
  add(best.rolled, "that are lost when their contacts roll");
  add(std::accumulate(best.execution_failures.begin(), best.execution_failures.end(),
                      std::int64_t{0},
                      [](std::int64_t sum, const auto& one) { return sum + one.second; }),
      "whose simulated execution fails (" + FailuresText(best.execution_failures) + ")");
  if (request.robustness == RobustnessLevel::kRequired) text += "; robustness margins required";
  return text;
}

/// Append the contacts of a grasp that are missing.
/// @returns their contact numbers.
std::vector<int> AppendGrasp(const grasp::Grasp& grasp, std::vector<grasp::Contact>& contacts) {
  std::vector<int> numbers;
  for (const grasp::Contact& contact : grasp) {
    const auto found = std::ranges::find_if(contacts, [&](const grasp::Contact& other) {
      return other.p == contact.p && other.n == contact.n;
    });
    numbers.push_back(static_cast<int>(found - contacts.begin()));
    if (found == contacts.end()) contacts.push_back(contact);
  }
  return numbers;
}

/// @param end  "start" or "goal".
/// @throws std::invalid_argument  if the number of fingers differs from the number of contacts, or
///     the hand has no such finger.
void CheckFingers(const GaitRequest& request, const std::vector<FingerIndex>& fingers,
                  const grasp::Grasp& grasp, const std::string& end) {
  const int count = static_cast<int>(request.hand->fingers.size());
  const auto is_there = [&](FingerIndex finger) { return finger >= 0 && finger < count; };
  if (fingers.empty()) return;
  if (fingers.size() != grasp.size() || !std::ranges::all_of(fingers, is_there)) {
    throw std::invalid_argument(
        end + "_fingers: must name one finger of the hand for each contact of the " + end +
        " grasp");
  }
}

/// Return the required joint configuration of each finger at the start; empty if any.
/// @throws std::invalid_argument  if the joints are not those of the hand, or pose or fingers are
///     missing.
std::vector<JointConfiguration> StartConfigurations(const GaitRequest& request) {
  std::vector<JointConfiguration> configurations;
  if (request.start_joints.empty()) return configurations;
  const std::vector<kinematics::Finger>& fingers = request.hand->fingers;
  bool is_complete = request.start_pose && !request.start_fingers.empty() &&
                     request.start_joints.size() == fingers.size();
  for (std::size_t i = 0; is_complete && i < fingers.size(); ++i) {
    is_complete = request.start_joints[i].size() == fingers[i].joints.size();
    if (!is_complete) break;
    configurations.push_back(kinematics::ConfigurationAt(fingers[i], request.start_joints[i]));
  }
  if (is_complete) return configurations;
  throw std::invalid_argument(
      "start_joints: requires start_pose, start_fingers and the angles of all joints");
}

/// Gap between a finger's reach and the object.
struct FingerGap {
  std::string finger;
  double distance = 0;  ///< distance between the object and the finger's first joint, metres
  double reach = 0;     ///< MaximumReach, metres
};

/// @throws InputError  if fewer than three fingers can touch the object at the pose.
void CheckReach(const GaitRequest& request, const collision::SurfaceTree& surface,
                const std::optional<Eigen::Isometry3d>& pose, const std::string& option) {
  if (!pose) return;
  std::vector<FingerGap> gaps;
  for (const kinematics::Finger& finger : request.hand->fingers) {
    const collision::ConvexShape base{{pose->inverse() * finger.joints.front().offset}, 0};
    gaps.push_back(
        {finger.name, surface.DistanceFrom(base, kFarAway_m), kinematics::MaximumReach(finger)});
  }
  const auto missing = [](const FingerGap& gap) { return gap.distance - gap.reach; };
  std::ranges::sort(gaps, {}, missing);
  if (gaps.size() >= kFewestHoldingFingers && missing(gaps[kFewestHoldingFingers - 1]) <= 0) return;
  const std::size_t in_reach =
      std::ranges::count_if(gaps, [&](const FingerGap& gap) { return missing(gap) <= 0; });
  const FingerGap& first = gaps[in_reach];
  throw InputError(
      option + ": the object is out of reach of " +
      (in_reach == 0 ? "every finger" : "all but " + std::to_string(in_reach) + " of the fingers") +
      ", expected at least " + std::to_string(kFewestHoldingFingers) +
      " fingers that can touch it; its surface is " + FormatShort(first.distance, 3) +
      " m from the first joint of finger " + first.finger + ", which reaches " +
      FormatShort(first.reach, 3) + " m");
}

/// @throws InputError  if the object is closer to the palm than the clearance at the pose.
void CheckPalm(const GaitRequest& request, const collision::SurfaceTree& surface,
               const std::optional<Eigen::Isometry3d>& pose, const std::string& option) {
  if (!pose) return;
  for (const kinematics::LinkShape& link : request.hand->palm) {
    const double gap =
        surface.DistanceFrom(collision::Moved(pose->inverse(), link.shape), request.margin);
    if (gap >= request.margin) continue;
    throw InputError(option + ": the object " +
                     (gap > 0 ? "is " + FormatLength(gap) + " from" : "collides with") +
                     " the palm (body " + link.link + "), expected a clearance of at least " +
                     FormatLength(request.margin));
  }
}

bool IsAdmitted(const std::vector<int>& grasp, criteria::GraspMemory& memory) {
  criteria::ContactSet contacts;
  for (const int number : grasp) {
    if (!contacts.Has(number)) contacts.Insert(number);
  }
  return memory.Admits(contacts);
}

criteria::GraspCriteria WithQuality(criteria::GraspCriteria criteria, double quality) {
  criteria.min_quality = quality;
  return criteria;
}

/// Two fingertips balance a third one that slides, with its force at the edge of the friction cone,
/// only if its line of force meets the line through both. Actuators do not achieve this.
constexpr int kFewestBesideSliding = 3;

/// Margin of gravity-supported grasps at grid nodes, for rolling contacts and for the poses between
/// nodes: a factor of the required disturbance, and weights. Rotations by 0.15 rad need
/// 0.0028 weights.
constexpr double kSupportFactor = 2;
constexpr double kSupportMargin = 0.003;

/// Number of gaits, from different random streams, whose contacts are rolled, and the bits that the
/// streams are apart. FindExecutableGait uses lower ones, goal lists higher ones.
constexpr int kRollingDraws = 4;
constexpr int kRollingShift = 40;

/// Search configuration for one set of robustness margins, or for none.
struct SearchConfig {
  double quality;  ///< the margin is smaller for slender objects
  HandScene scene;
  HandSetup setup;
  criteria::GraspMemory memory;
  std::optional<plan::WeightCarrier> carrier = {};
  SimulateExecution simulate = {};

  SearchConfig(const GaitRequest& request, const RobustnessMargins* margins, double relative_width,
               const collision::SurfaceTree& surface,
               const std::vector<kinematics::InverseKinematics>& inverse,
               const std::vector<SurfacePoint>& points, const hand::Hand& fingers)
      : quality(margins == nullptr
                    ? request.criteria.min_quality
                    : std::max(request.criteria.min_quality,
                               std::min(1.0, relative_width / kSlender) * margins->quality)),
        scene(*request.hand, surface,
              request.margin + (margins == nullptr ? 0 : margins->clearance)),
        setup{scene, inverse, points, request.scale},
        memory(*request.solid, WithQuality(request.criteria, quality), fingers,
               criteria::QualityTest::kQuick) {
    setup.relative_width = relative_width;
    if (request.gravity_support) {
      plan::GravitySupport support = *request.gravity_support;
      support.disturbance = kSupportFactor * support.disturbance + kSupportMargin;
      carrier.emplace(request.solid->wrench_frame(), request.criteria.friction_angle, support,
                      request.hand->up);
      setup.carrier = &*carrier;
    }
    if (request.simulate) setup.fewest_beside_sliding = kFewestBesideSliding;
    if (margins == nullptr) return;
    setup.may_slide = false;
    setup.force_margin = margins->force_margin.value_or(0);
  }
};

/// Return the gait as it is planned: with rolling contacts if the request requires them.
/// @param merged  gait with merged in-hand motions.
RolledGait AsPlanned(const HandSetup& setup, const GaitRequest& request,
                     const collision::BallContact& surface, const Gait& merged) {
  if (!request.rolls) return {merged, static_cast<int>(merged.segments.size())};
  return RollContacts(setup, surface, request.criteria.friction_angle, merged,
                      RandomStream(request.seed, RandomUse::kRolledPaths));
}

/// Return a simulator of gaits as they would be planned.
SimulateExecution SimulatorFor(const HandSetup& setup, const GaitRequest& request,
                               const collision::BallContact& surface,
                               const std::vector<grasp::Contact>& contacts) {
  return [&](const Gait& gait) -> GaitExecution {
    Gait merged = MergeMoves(setup, gait);
    RolledGait planned = AsPlanned(setup, request, surface, merged);
    if (!planned.gait) {
      const auto failed = merged.segments.begin() + planned.segments;
      const bool fails_in_move = failed->kind == PlanSegment::Kind::kMove;
      merged.segments.erase(failed, merged.segments.end());
      return {CountChanges(merged, planned.segments),
              true,
              fails_in_move,
              false,
              false,
              planned.reason};
    }
    merged = *std::move(planned.gait);
    request.progress("simulating a plan");
    const plan::Plan plan = PlanOf(merged, request, contacts);
    const auto execution = request.simulate(plan, request.deadline);
    if (!execution) return {.is_whole = true};  // the caller detects the missing result
    const bool fails_in_move = execution->is_held && !execution->is_whole &&
                               std::holds_alternative<plan::Move>(plan.steps[execution->steps]);
    return {CountChanges(merged, execution->steps),
            execution->is_held,
            fails_in_move,
            execution->is_whole,
            execution->is_cut_short,
            execution->reason};
  };
}

/// Return a found gait as it is planned, or the reason why its contacts cannot roll.
FoundGait Planned(const HandSetup& setup, const GaitRequest& request,
                  const collision::BallContact& surface, const Gait& merged) {
  RolledGait planned = AsPlanned(setup, request, surface, merged);
  if (planned.gait) return {std::move(planned.gait), ""};
  return {std::nullopt, "contacts of the gait that was found cannot roll (" +
                            std::string(plan::ReasonName(planned.reason)) + ")"};
}

/// Bounds of the search of an initial grasp whose force is measured: rotation, stances, seconds.
constexpr double kMeasuredTurn = 0.05;
constexpr std::int64_t kMeasuredExpanded = 40;
constexpr std::chrono::seconds kMeasuredTime{1};

/// Return the force that an initial grasp needs, if every grasp fails in simulation.
/// The grasp is the first one of a small rotation without simulation.
std::optional<planning::GraspForceNeed> ForceOfInitialGrasp(
    const GaitRequest& request, const std::vector<grasp::Contact>& contacts, const GaitEnds& ends,
    const FindOne& find) {
  if (!request.simulate || !request.measure_force || !ends.goal.empty()) return std::nullopt;
  GaitRequest asked = request;
  asked.simulate = nullptr;
  asked.robustness = RobustnessLevel::kNone;
  asked.goal.reset();
  asked.turn.angle = std::clamp(asked.turn.angle, -kMeasuredTurn, kMeasuredTurn);
  asked.most_expanded = kMeasuredExpanded;
  asked.deadline = request.deadline.In(kMeasuredTime);
  const FoundGait found = find(asked, {});
  if (!found.gait) return std::nullopt;
  return request.measure_force(PlanOf(*found.gait, asked, contacts), 0);
}

/// Describe the given grasp that cannot be robust in any gait; empty if there is none.
/// @param quality  grasp quality that a robust gait requires.
std::string NonRobustEnd(const GaitEnds& ends, criteria::GraspMemory& memory, double quality) {
  const bool start_is_admitted = ends.start.empty() || IsAdmitted(ends.start, memory);
  if (start_is_admitted && (ends.goal.empty() || IsAdmitted(ends.goal, memory))) return "";
  return std::string("the ") + (start_is_admitted ? "goal" : "start") +
         " grasp has no robustness margin: its quality is below " + FormatShort(quality);
}

}  // namespace

GaitResult FindGait(const GaitRequest& request) {
  CheckFingers(request, request.start_fingers, request.start_grasp, "start");
  CheckFingers(request, request.goal_fingers, request.goal_grasp, "goal");
  const collision::SurfaceTree surface(*request.solid, request.scale);
  CheckPalm(request, surface, request.start_pose, "start pose");
  CheckReach(request, surface, request.start_pose, "start pose");
  if (request.goal && request.goal->HasDefaultTolerance()) {
    CheckPalm(request, surface, request.goal->pose()->pose, "goal pose");
    CheckReach(request, surface, request.goal->pose()->pose, "goal pose");
  }
  GaitResult result;
  result.contacts = DrawContacts(request);
  request.progress("searching a gait");
  GaitEnds ends{AppendGrasp(request.start_grasp, result.contacts),
                AppendGrasp(request.goal_grasp, result.contacts), request.start_fingers,
                request.goal_fingers};
  ends.start_configurations = StartConfigurations(request);
  std::vector<SurfacePoint> points;
  for (const grasp::Contact& contact : result.contacts) {
    points.push_back({request.scale * contact.p, contact.n});
  }
  std::vector<kinematics::InverseKinematics> inverse;
  inverse.reserve(request.hand->fingers.size());
  for (const kinematics::Finger& finger : request.hand->fingers) inverse.emplace_back(finger);
  const collision::BallContact rolled_on(*request.solid, request.scale);
  const hand::Hand fingers = FingersOf(request);
  const double relative_width = object::MeasureWidth(*request.solid) / request.solid->diameter();
  SearchEvidence evidence;
  std::mutex adding;
  const FindOne find = [&](const GaitRequest& asked,
                           std::span<const RobustnessMargins> margin_sets) -> FoundGait {
    std::vector<std::unique_ptr<SearchConfig>> configs;
    std::string rejection;
    const auto add = [&](const RobustnessMargins* margins) {
      auto config = std::make_unique<SearchConfig>(asked, margins, relative_width, surface, inverse,
                                                   points, fingers);
      config->memory.Append(result.contacts);
      if (margins != nullptr) {
        if (margins->force_margin) config->setup.rolled_on = &rolled_on;
        // Whether gravity supports a given grasp depends on the pose.
        if (!asked.gravity_support) rejection = NonRobustEnd(ends, config->memory, config->quality);
        if (!rejection.empty()) return;
        if (asked.simulate)
          config->simulate = SimulatorFor(config->setup, asked, rolled_on, result.contacts);
      }
      configs.push_back(std::move(config));
    };
    if (margin_sets.empty()) add(nullptr);
    for (const RobustnessMargins& margins : margin_sets) add(&margins);
    if (configs.empty()) return {std::nullopt, std::move(rejection)};
    std::vector<SearchTerms> terms;
    for (const auto& config : configs) {
      terms.push_back({config->setup, config->memory, config->simulate});
    }
    FoundGait found;
    GaitRequest drawn = asked;
    for (int draw = 0; draw < (asked.rolls ? kRollingDraws : 1); ++draw) {
      drawn.seed = asked.seed + (static_cast<std::uint64_t>(draw) << kRollingShift);
      MultiStartSearch search(drawn, terms, ends);
      const std::optional<Gait> gait = search.Search();
      if (!gait) {
        const std::scoped_lock lock(adding);
        evidence.Add(search.counts(), asked.simulate || !request.simulate);
        if (!evidence.tracks_seed || asked.seed < *evidence.tracks_seed) {
          evidence.tracks = search.drawn_tracks();
          evidence.tracks_seed = asked.seed;
        }
        return {std::nullopt, FailureSummary(asked, search.counts()), search.reached()};
      }
      found = Planned(configs.front()->setup, asked, rolled_on, *gait);
      if (found.gait) break;
      const std::scoped_lock lock(adding);
      ++evidence.unrolled;
    }
    return found;
  };
  SimulatedGait simulated;
  if (request.robustness == RobustnessLevel::kNone) {
    simulated.found = find(request, {});
  } else if (request.simulate) {
    simulated = FindExecutableGait(request, result.contacts, find);
  } else {
    if (request.robustness == RobustnessLevel::kPreferred) simulated.found = find(request, {});
    if (request.robustness == RobustnessLevel::kRequired || simulated.found.gait) {
      simulated.found = FindRobustGait(request, find, simulated.found);
    }
  }
  result.gait = std::move(simulated.found.gait);
  result.message = std::move(simulated.found.message);
  result.execution = std::move(simulated.execution);
  if (!result.gait && request.names_causes) {
    SearchEvidence searched = evidence;  // the search of an initial grasp adds to it
    searched.force = result.execution ? result.execution->force
                                      : ForceOfInitialGrasp(request, result.contacts, ends, find);
    const SearchConfig config(request, nullptr, relative_width, surface, inverse, points, fingers);
    const std::string causes = CausesText(LikelyCauses(config.setup, request, searched));
    if (!causes.empty()) result.message += "; " + causes;
  }
  return result;
}

}  // namespace regrasp::gait
