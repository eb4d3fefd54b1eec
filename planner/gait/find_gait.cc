#include "planner/gait/find_gait.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::gait {
namespace {

constexpr int kContacts = 400;
/// Of the diameter: contacts keep off the borders of faces, where the least slip is to another one.
constexpr double kFromBorder = 0.02;
/// Of a track, radians.
constexpr double kStep = 0.06;

/// Grasps expanded from one place in the hand before others have their turn.
constexpr int kExpandedAtOnce = 6;
/// From all places together, by their number, before there is another one.
constexpr int kExpandedForNext = 20;
/// Times that places are looked for.
constexpr int kDrawings = 4;

double LargestTip(const kinematics::HandModel& hand) {
  double radius = 0;
  for (const kinematics::Finger& finger : hand.fingers)
    radius = std::max(radius, finger.tip.radius);
  return radius;
}

std::vector<grasp::Contact> DrawContacts(const GaitRequest& request) {
  const sampling::SurfaceSampler sampler(*request.solid, LargestTip(*request.hand) / request.scale,
                                         kFromBorder);
  RandomStream random(request.seed, RandomUse::kContactPoints);
  std::vector<grasp::Contact> contacts;
  for (int i = 0; i < kContacts; ++i) {
    if (const auto contact = sampler.TryDraw(random)) contacts.push_back(*contact);
  }
  return contacts;
}

/// A place in the hand to turn the object in.
struct PlaceInHand {
  PoseGrid grid;
  Parking parking;
  RandomStream random;
  GaitSearch search;

  PlaceInHand(const HandSetup& setup, const PoseTrack& poses, Parking postures,
              criteria::GraspMemory& memory, std::uint64_t seed, std::size_t index)
      : grid(poses, setup.scene.hand().up, PoseGrid::End::kOrientation),
        parking(std::move(postures)),
        random(seed, RandomUse::kGaits, index),
        search(setup, grid, parking, {}, memory, random) {}
};

/// All places in the hand that are tried, the best first, and more the longer it takes; those where
/// the object comes farther have more turns.
class PlacesInHand {
 public:
  PlacesInHand(const GaitRequest& request, const HandSetup& setup, criteria::GraspMemory& memory)
      : request_(request),
        setup_(setup),
        memory_(memory),
        random_(request.seed, RandomUse::kHomes),
        centre_(request.scale * request.solid->mass_properties().centroid),
        steps_(std::max(1, static_cast<int>(std::ceil(std::abs(request.turn.angle) / kStep)))) {}

  std::optional<Gait> Search() {
    while (!request_.deadline.IsOver() && expanded_ < request_.most_expanded) {
      PlaceInHand* place = Next();
      if (place == nullptr) return std::nullopt;
      const std::int64_t before = place->search.counts().expanded;
      std::optional<Gait> gait = place->search.Run(before + kExpandedAtOnce, request_.deadline);
      if (gait) return gait;
      expanded_ += place->search.counts().expanded - before;
      request_.progress("searching a gait, " + std::to_string(expanded_) + " grasps from " +
                        std::to_string(places_.size()) + " places in the hand");
    }
    return std::nullopt;
  }

  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] std::vector<GaitCounts> counts() const {
    std::vector<GaitCounts> counts;
    for (const auto& place : places_) counts.push_back(place->search.counts());
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
      if (place->search.IsExhausted()) continue;
      const GaitCounts& counts = place->search.counts();
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
        if (++drawings_ > kDrawings) return false;
        homes_ = FindHomes(setup_, centre_, request_.turn, memory_, random_);
        std::ranges::reverse(homes_);
        continue;
      }
      const PoseTrack track(homes_.back(), centre_, request_.turn, Eigen::Vector3d::Zero(), steps_);
      homes_.pop_back();
      const std::optional<Parking> parking = FindParking(setup_, track, random_);
      if (!parking) continue;
      places_.push_back(std::make_unique<PlaceInHand>(setup_, track, *parking, memory_,
                                                      request_.seed, places_.size()));
      return true;
    }
  }

  const GaitRequest& request_;
  const HandSetup& setup_;
  criteria::GraspMemory& memory_;
  RandomStream random_;
  Eigen::Vector3d centre_;
  int steps_;
  std::vector<Eigen::Isometry3d> homes_;  ///< that were not tried yet, the best last
  int drawings_ = 0;
  std::vector<std::unique_ptr<PlaceInHand>> places_;
  std::int64_t expanded_ = 0;  ///< from all places
};

/// Why no home led to the end, of the one that came farthest.
std::string WhatStopped(const std::vector<GaitCounts>& counts, const Turn& turn, int steps) {
  if (counts.empty()) {
    return "the object is nowhere in the hand within reach of the fingers and off the palm";
  }
  const GaitCounts& best = *std::ranges::max_element(counts, {}, &GaitCounts::farthest);
  const double reached = Degrees(turn.angle) * best.farthest / steps;
  std::string text = "the hand turns the object by " + FormatShort(reached, 3) + " of " +
                     FormatShort(Degrees(turn.angle), 3) + " degrees; of " +
                     std::to_string(counts.size()) + " places in the hand the best one has " +
                     std::to_string(best.grasps) + " grasps";
  const auto add = [&](std::int64_t count, const char* what) {
    if (count > 0) text += ", " + std::to_string(count) + " " + what;
  };
  add(best.colliding, "in which fingers collide");
  add(best.no_path, "for which a finger has no free path");
  add(best.no_move, "with moves that fingers cannot follow");
  return text;
}

}  // namespace

GaitResult FindGait(const GaitRequest& request) {
  GaitResult result;
  result.contacts = DrawContacts(request);
  std::vector<SurfacePoint> points;
  for (const grasp::Contact& contact : result.contacts) {
    points.push_back({request.scale * contact.p, contact.n});
  }
  std::vector<kinematics::InverseKinematics> inverse;
  inverse.reserve(request.hand->fingers.size());
  for (const kinematics::Finger& finger : request.hand->fingers) inverse.emplace_back(finger);
  const collision::SurfaceTree surface(*request.solid, request.scale);
  const HandScene scene(*request.hand, surface, request.margin);
  const HandSetup setup{scene, inverse, points};
  const hand::Hand fingers{static_cast<int>(request.hand->fingers.size()),
                           LargestTip(*request.hand) / request.scale};
  criteria::GraspMemory memory(*request.solid, request.criteria, fingers,
                               criteria::QualityTest::kQuick);
  memory.Append(result.contacts);

  PlacesInHand places(request, setup, memory);
  result.gait = places.Search();
  result.counts = places.counts();
  if (!result.gait) result.message = WhatStopped(result.counts, request.turn, places.steps());
  return result;
}

}  // namespace regrasp::gait
