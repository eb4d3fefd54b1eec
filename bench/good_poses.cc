#include "bench/good_poses.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "planner/gait/find_gait.h"
#include "planner/gait/initial_pose.h"

namespace regrasp::bench {
namespace {

/// Return the contacts that a search for the request uses.
std::vector<grasp::Contact> ContactsOf(gait::GaitRequest request) {
  request.most_expanded = 0;
  return gait::FindGait(request).contacts;
}

}  // namespace

GoodPoses FindGoodPoses(const gait::GaitRequest& request, const planning::Turn& turn,
                        const Eigen::Vector3d& shift) {
  std::vector<grasp::Contact> contacts = ContactsOf(request);
  const collision::SurfaceTree surface(*request.solid, request.scale);
  const gait::HandScene scene(*request.hand, surface, request.margin);
  criteria::GraspMemory memory(*request.solid, request.criteria, gait::FingersOf(request),
                               criteria::QualityTest::kQuick);
  memory.Append(contacts);
  std::vector<kinematics::InverseKinematics> inverse;
  for (const kinematics::Finger& finger : request.hand->fingers) inverse.emplace_back(finger);
  std::vector<gait::SurfacePoint> points;
  for (const grasp::Contact& contact : contacts) {
    points.push_back({request.scale * contact.p, contact.n});
  }
  const gait::HandSetup setup{scene, inverse, points, request.scale};
  const gait::ObjectTask task(request.scale * request.solid->mass_properties().centroid, turn, {},
                              {}, shift);
  RandomStream random(request.seed, RandomUse::kHomes);
  auto homes = gait::FindInitialPoses(setup, task, {}, memory, random);
  if (homes.empty()) throw std::runtime_error("the object is nowhere within reach of the fingers");
  return {std::move(homes), std::move(contacts)};
}

}  // namespace regrasp::bench
