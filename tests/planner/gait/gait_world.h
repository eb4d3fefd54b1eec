#pragma once

#include <cstdint>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/gait/gait_search.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/initial_pose.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/request.h"
#include "planner/object/body_measures.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::gait {

/// Number of random contacts of a GaitWorld; further contacts have the next numbers.
inline constexpr int kWorldContacts = 200;

/// Draw the contacts of a request, and append further ones, in object units.
inline std::vector<grasp::Contact> DrawWorldContacts(const GaitRequest& request,
                                                     const grasp::Grasp& more) {
  constexpr double kEdgeClearance = 0.02;
  const sampling::SurfaceSampler sampler(*request.solid, FingersOf(request).fingertip_radius,
                                         kEdgeClearance);
  RandomStream random(request.seed, RandomUse::kContactPoints);
  std::vector<grasp::Contact> contacts;
  while (contacts.size() < kWorldContacts) contacts.push_back(sampler.Draw(random));
  contacts.insert(contacts.end(), more.begin(), more.end());
  return contacts;
}

/// Hand, object, contacts and memory of a request, as searches need them.
struct GaitWorld {
  explicit GaitWorld(const GaitRequest& asked, const grasp::Grasp& more = {})
      : request(asked), contacts(DrawWorldContacts(asked, more)) {
    for (const kinematics::Finger& finger : asked.hand->fingers) inverse.emplace_back(finger);
    for (const grasp::Contact& contact : contacts) {
      points.push_back({asked.scale * contact.p, contact.n});
    }
    memory.Append(contacts);
    setup.relative_width = object::MeasureWidth(*request.solid) / request.solid->diameter();
  }
  GaitWorld(const GaitWorld&) = delete;  // members refer to each other
  GaitWorld& operator=(const GaitWorld&) = delete;

  /// Return the best initial pose of the task.
  [[nodiscard]] Eigen::Isometry3d BestPose() {
    RandomStream random(request.seed, RandomUse::kHomes);
    return FindInitialPoses(setup, task, {}, memory, random).at(0);
  }

  const GaitRequest request;
  const std::vector<grasp::Contact> contacts;  ///< by number, in object units
  const collision::SurfaceTree surface{*request.solid, request.scale};
  const HandScene scene{*request.hand, surface, request.margin};
  std::vector<kinematics::InverseKinematics> inverse;
  std::vector<SurfacePoint> points;
  HandSetup setup{scene, inverse, points, request.scale};
  criteria::GraspMemory memory{*request.solid, request.criteria, FingersOf(request),
                               criteria::QualityTest::kQuick};
  const ObjectTask task{request.scale * request.solid->mass_properties().centroid, request.turn,
                        request.goal};
};

/// A GaitSearch with everything that it refers to.
struct WorldSearch {
  WorldSearch(GaitWorld& world, const PoseTrack& track, const GaitEnds& ends = {},
              std::uint64_t seed = 1)
      : grid(track, world.scene.hand().up, PoseGrid::End::kOrientation),
        random(seed, RandomUse::kGaits),
        idle_configurations(FindIdleConfigurations(world.setup, track, random).value()),
        checker(world.setup, grid, idle_configurations),
        search(world.setup, grid, checker, ends, world.memory, random) {}
  WorldSearch(const WorldSearch&) = delete;  // members refer to each other
  WorldSearch& operator=(const WorldSearch&) = delete;

  PoseGrid grid;
  RandomStream random;
  IdleConfigurations idle_configurations;
  ObjectMotionChecker checker;
  GaitSearch search;
};

/// Return the numbers of the assigned contacts, in finger order.
inline std::vector<int> ContactNumbers(const ContactAssignment& assignment) {
  std::vector<int> numbers;
  for (const int point : assignment) {
    if (point != kNone) numbers.push_back(point);
  }
  return numbers;
}

}  // namespace regrasp::gait
