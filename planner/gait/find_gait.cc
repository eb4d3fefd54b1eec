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

/// Of each place in the hand at first.
constexpr int kFirstExpanded = 25;

/// A place in the hand to turn the object in.
struct PlaceInHand {
  PoseTrack track;
  Parking parking;
  RandomStream random;
  GaitSearch search;

  PlaceInHand(const HandSetup& setup, const PoseTrack& poses, Parking postures,
              criteria::GraspMemory& memory, std::uint64_t seed, std::size_t index)
      : track(poses),
        parking(std::move(postures)),
        random(seed, RandomUse::kGaits, index),
        search(setup, track, parking, memory, random) {}
};

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

  const Eigen::Vector3d centre = request.scale * request.solid->mass_properties().centroid;
  RandomStream random(request.seed, RandomUse::kHomes);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(request.turn.angle) / kStep)));
  std::vector<std::unique_ptr<PlaceInHand>> places;
  for (const Eigen::Isometry3d& home : FindHomes(setup, centre, request.turn, memory, random)) {
    const PoseTrack track(home, centre, request.turn.axis, request.turn.angle, steps);
    const std::optional<Parking> parking = FindParking(setup, track, random);
    if (!parking) continue;
    places.push_back(
        std::make_unique<PlaceInHand>(setup, track, *parking, memory, request.seed, places.size()));
  }
  // A good place shows soon; all get a little, then all more.
  for (int expanded = kFirstExpanded; expanded <= request.most_expanded && !result.gait;
       expanded *= 2) {
    for (const auto& place : places) {
      if (request.deadline.IsOver() || place->search.IsExhausted()) continue;
      result.gait = place->search.Run(expanded, request.deadline);
      if (result.gait) break;
      request.progress("searching a gait, " + std::to_string(expanded) + " grasps from each of " +
                       std::to_string(places.size()) + " places in the hand");
    }
  }
  for (const auto& place : places) result.counts.push_back(place->search.counts());
  if (result.gait) return result;
  result.message = WhatStopped(result.counts, request.turn, steps);
  return result;
}

}  // namespace regrasp::gait
