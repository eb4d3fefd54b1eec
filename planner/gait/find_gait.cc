#include "planner/gait/find_gait.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "planner/gait/bidirectional_search.h"
#include "planner/gait/fewer_moves.h"
#include "planner/gait/gait_search.h"
#include "planner/gait/turn_search.h"
#include "planner/gait/with_reserve.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::gait {
namespace {

constexpr int kContacts = 400;
/// Of the diameter: contacts keep off the borders of faces, where the least slip is to another one.
constexpr double kFromBorder = 0.02;
/// Grasps expanded from one place in the hand before others have their turn.
constexpr int kExpandedAtOnce = 6;
/// From all places together, by their number, before there is another one.
constexpr int kExpandedForNext = 20;
/// Times that places are looked for.
constexpr int kDrawings = 4;

std::vector<grasp::Contact> DrawContacts(const GaitRequest& request) {
  const sampling::SurfaceSampler sampler(*request.solid, FingersOf(request).fingertip_radius,
                                         kFromBorder);
  RandomStream random(request.seed, RandomUse::kContactPoints);
  std::vector<grasp::Contact> contacts;
  for (int i = 0; i < kContacts; ++i) {
    if (const auto contact = sampler.TryDraw(random)) contacts.push_back(*contact);
  }
  return contacts;
}

/// A place in the hand to begin in.
struct PlaceInHand {
  RandomStream random;
  std::unique_ptr<PlaceSearch> search;
};

/// All places in the hand that are tried, the best first, and more the longer it takes; those where
/// the object comes farther have more turns.
class PlacesInHand {
 public:
  PlacesInHand(const GaitRequest& request, const HandSetup& setup, const GaitEnds& ends,
               criteria::GraspMemory& memory)
      : request_(request),
        setup_(setup),
        ends_(ends),
        memory_(memory),
        random_(request.seed, RandomUse::kHomes),
        journey_(request.scale * request.solid->mass_properties().centroid, request.turn,
                 request.goal_pose) {}

  std::optional<Gait> Search() {
    while (!request_.deadline.IsOver() && expanded_ < request_.most_expanded) {
      PlaceInHand* place = Next();
      if (place == nullptr) return std::nullopt;
      const std::int64_t before = place->search->counts().expanded;
      std::optional<Gait> gait = place->search->Run(before + kExpandedAtOnce, request_.deadline);
      if (gait) return gait;
      expanded_ += place->search->counts().expanded - before;
      request_.progress("searching a gait, " + std::to_string(expanded_) + " grasps from " +
                        std::to_string(places_.size()) + " places in the hand");
    }
    return std::nullopt;
  }

  [[nodiscard]] std::vector<GaitCounts> counts() const {
    std::vector<GaitCounts> counts;
    for (const auto& place : places_) counts.push_back(place->search->counts());
    return counts;
  }

 private:
  /// Null where all places are exhausted.
  PlaceInHand* Next() {
    const std::int64_t enough = kExpandedForNext * static_cast<std::int64_t>(places_.size());
    if (expanded_ >= enough && Open()) return places_.back().get();
    PlaceInHand* next = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& place : places_) {
      if (place->search->IsExhausted()) continue;
      const GaitCounts counts = place->search->counts();
      const double farther = 1.0 + counts.farthest;
      const double had = static_cast<double>(counts.expanded) / (farther * farther);
      if (had >= least) continue;
      least = had;
      next = place.get();
    }
    return next == nullptr && Open() ? places_.back().get() : next;
  }

  /// @returns whether there is another place.
  bool Open() {
    while (true) {
      if (homes_.empty()) {
        if (!DrawHomes()) return false;
        continue;
      }
      const PoseTrack track = journey_.From(homes_.back());
      homes_.pop_back();
      auto place = std::make_unique<PlaceInHand>(
          RandomStream(request_.seed, RandomUse::kGaits, places_.size()));
      place->search = SearchAlong(track, place->random);
      if (!place->search || !place->search->GoalIsHeld()) continue;
      places_.push_back(std::move(place));
      return true;
    }
  }

  /// Null where a finger has no place to wait.
  std::unique_ptr<PlaceSearch> SearchAlong(const PoseTrack& track, RandomStream& random) {
    std::optional<Parking> parking = FindParking(setup_, track, random_);
    if (!parking) return nullptr;
    const bool is_turn = !request_.goal_pose && track.steps() > 0;
    // Contacts roll one way, and so are followed from the beginning.
    const bool may_begin_anywhere = is_turn && !request_.start_pose && ends_.start.empty() &&
                                    ends_.goal.empty() && setup_.rolled_on == nullptr;
    if (may_begin_anywhere) {
      if (auto backwards = FindParking(setup_, track.Backwards(), random_)) {
        return std::make_unique<TurnSearch>(setup_, track, *std::move(parking),
                                            *std::move(backwards), memory_, random);
      }
    }
    const PoseGrid grid(track, setup_.scene.hand().up,
                        is_turn ? PoseGrid::End::kOrientation : PoseGrid::End::kPose);
    return std::make_unique<BidirectionalSearch>(setup_, grid, *std::move(parking), ends_, memory_,
                                                 random);
  }

  /// @returns false where there are no more.
  bool DrawHomes() {
    if (++drawings_ > (request_.start_pose ? 1 : kDrawings)) return false;
    if (request_.start_pose) {
      homes_ = {*request_.start_pose};
      return true;
    }
    homes_ = FindHomes(setup_, journey_, ends_, memory_, random_);
    std::ranges::reverse(homes_);
    return true;
  }

  const GaitRequest& request_;
  const HandSetup& setup_;
  GaitEnds ends_;
  criteria::GraspMemory& memory_;
  RandomStream random_;
  Journey journey_;
  std::vector<Eigen::Isometry3d> homes_;  ///< that were not tried yet, the best last
  int drawings_ = 0;
  std::vector<std::unique_ptr<PlaceInHand>> places_;
  std::int64_t expanded_ = 0;  ///< from all places
};

std::string HowFar(const GaitRequest& request, const GaitCounts& counts) {
  const double share = counts.steps == 0 ? 1 : static_cast<double>(counts.farthest) / counts.steps;
  if (share == 1 && !request.goal_grasp.empty()) return "the goal grasp is not reached";
  if (share == 1) return "every way to the goal fails where its paths are worked out";
  if (request.goal_pose) {
    return "the object comes " + FormatShort(100 * share, 3) + " % of the way to its goal pose";
  }
  return "the hand turns the object by " + FormatShort(share * Degrees(request.turn.angle), 3) +
         " of " + FormatShort(Degrees(request.turn.angle), 3) + " degrees";
}

/// Why no place led to the end, of the one where the object came farthest.
std::string WhatStopped(const GaitRequest& request, const std::vector<GaitCounts>& counts) {
  if (counts.empty()) {
    std::string text =
        "the object is nowhere in the hand within reach of the fingers and off the palm";
    if (!request.start_grasp.empty()) text += ", held by the start grasp";
    if (!request.goal_grasp.empty()) text += ", held by the goal grasp in the end";
    return text;
  }
  const GaitCounts& best = *std::ranges::max_element(counts, {}, &GaitCounts::farthest);
  std::string text = HowFar(request, best) + "; of " + std::to_string(counts.size()) +
                     " places in the hand the best one has " + std::to_string(best.grasps) +
                     " grasps";
  const auto add = [&](std::int64_t count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + " " + what;
  };
  add(best.colliding, "in which fingers collide");
  add(best.ways.no_path, "for which a finger has no free path");
  add(best.ways.no_slide, "for which a finger cannot slide");
  add(best.ways.no_move, "with moves that fingers cannot follow");
  add(best.rolled, "that no longer hold where their contacts roll to");
  if (request.reserve == Reserve::kRequired) {
    text += "; without reserve there may be a plan";
  }
  return text;
}

/// Appends a grasp's contacts that are not there yet. @returns their numbers.
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

/// @throws std::invalid_argument  there are not as many as contacts, or one that the hand lacks.
void CheckStartFingers(const GaitRequest& request) {
  const std::vector<FingerIndex>& fingers = request.start_fingers;
  const int count = static_cast<int>(request.hand->fingers.size());
  const auto is_there = [&](FingerIndex finger) { return finger >= 0 && finger < count; };
  if (fingers.empty()) return;
  if (fingers.size() != request.start_grasp.size() || !std::ranges::all_of(fingers, is_there)) {
    throw std::invalid_argument("start_fingers: one of the hand for each contact of the start");
  }
}

bool Holds(const std::vector<int>& grasp, criteria::GraspMemory& memory) {
  criteria::ContactSet contacts;
  for (const int number : grasp) {
    if (!contacts.Has(number)) contacts.Insert(number);
  }
  return memory.Admits(contacts);
}

/// What of a request can't have reserve, whatever the gait; empty: nothing.
/// @param quality  that a gait with reserve has.
std::string GivenWithoutReserve(const GaitEnds& ends, criteria::GraspMemory& memory,
                                double quality) {
  const bool start_holds = ends.start.empty() || Holds(ends.start, memory);
  if (start_holds && (ends.goal.empty() || Holds(ends.goal, memory))) return "";
  return std::string("the ") + (start_holds ? "goal" : "start") +
         " grasp has no reserve: its quality is below " + FormatShort(quality);
}

}  // namespace

hand::Hand FingersOf(const planning::InHandTask& task) {
  double radius = 0;
  for (const kinematics::Finger& finger : task.hand->fingers) {
    radius = std::max(radius, finger.tip.radius);
  }
  return {static_cast<int>(task.hand->fingers.size()), radius / task.scale};
}

GaitResult FindGait(const GaitRequest& request) {
  CheckStartFingers(request);
  GaitResult result;
  result.contacts = DrawContacts(request);
  const GaitEnds ends{AppendGrasp(request.start_grasp, result.contacts),
                      AppendGrasp(request.goal_grasp, result.contacts), request.start_fingers};
  std::vector<SurfacePoint> points;
  for (const grasp::Contact& contact : result.contacts) {
    points.push_back({request.scale * contact.p, contact.n});
  }
  std::vector<kinematics::InverseKinematics> inverse;
  inverse.reserve(request.hand->fingers.size());
  for (const kinematics::Finger& finger : request.hand->fingers) inverse.emplace_back(finger);
  const collision::SurfaceTree surface(*request.solid, request.scale);
  const collision::BallContact rolled_on(*request.solid, request.scale);
  const hand::Hand fingers = FingersOf(request);
  const FindOne find = [&](const GaitRequest& asked, const Spare* spare) -> FoundGait {
    const HandScene scene(*request.hand, surface, asked.margin);
    HandSetup setup{scene, inverse, points, request.scale};
    criteria::GraspMemory memory(*asked.solid, asked.criteria, fingers,
                                 criteria::QualityTest::kQuick);
    memory.Append(result.contacts);
    if (spare != nullptr) {
      setup.may_slide = false;
      if (spare->force_margin) setup.rolled_on = &rolled_on;
      setup.force_margin = spare->force_margin.value_or(0);
      std::string without = GivenWithoutReserve(ends, memory, asked.criteria.min_quality);
      if (!without.empty()) return {std::nullopt, std::move(without)};
    }
    PlacesInHand places(asked, setup, ends, memory);
    std::optional<Gait> gait = places.Search();
    if (gait) return {WithFewerMoves(setup, *gait), ""};
    return {std::nullopt, WhatStopped(asked, places.counts())};
  };
  const bool is_required = request.reserve == Reserve::kRequired;
  FoundGait found;
  if (!is_required) found = find(request, nullptr);
  if (is_required || (request.reserve == Reserve::kPreferred && found.gait)) {
    result.is_carried_out = FindWithReserve(request, result.contacts, find, found);
  }
  result.gait = std::move(found.gait);
  result.message = std::move(found.message);
  return result;
}

}  // namespace regrasp::gait
