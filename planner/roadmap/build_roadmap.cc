#include "planner/roadmap/build_roadmap.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/criteria/reach.h"
#include "planner/object/polyhedron.h"
#include "planner/sampling/contact_points.h"

namespace regrasp::roadmap {

std::optional<int> FindContact(const std::vector<grasp::Contact>& points,
                               const grasp::Contact& contact, double tolerance) {
  const auto found = std::find_if(points.begin(), points.end(), [&](const grasp::Contact& point) {
    return point.face == contact.face && (point.p - contact.p).norm() <= tolerance;
  });
  if (found == points.end()) return std::nullopt;
  return static_cast<int>(found - points.begin());
}

namespace {

constexpr int kPlainContacts = 60;
constexpr int kClusteredContacts = 1000;
constexpr int kClusters = 50;

const object::Polyhedron& SolidOf(const planning::PlanRequest& request) {
  return dynamic_cast<const object::Polyhedron&>(*request.object);
}

void CheckSize(const RoadmapSize& size) {
  const int most = size.clusters > 0 ? kMaxClusteredContacts : kMaxRoadmapContacts;
  if (size.contacts < kRoadmapContacts || size.contacts > most) {
    throw std::invalid_argument("the number of contact points is out of range");
  }
}

void JoinContacts(std::vector<grasp::Contact>& points, const std::vector<grasp::Contact>& more,
                  double tolerance) {
  for (const grasp::Contact& contact : more) {
    if (!FindContact(points, contact, tolerance)) points.push_back(contact);
  }
}

}  // namespace

RoadmapSize SizeOf(const planning::PlanRequest& request) {
  const auto parameters = request.parameters.Get<RoadmapParameters>();
  const std::optional<int>& contacts = parameters.contact_points;
  const bool many = contacts.value_or(request.object->face_count()) > kMaxRoadmapContacts;
  const int clusters = parameters.clusters.value_or(many ? kClusters : 0);
  return {contacts.value_or(clusters > 0 ? kClusteredContacts : kPlainContacts), clusters};
}

std::vector<grasp::Contact> SpreadContacts(const planning::PlanRequest& request) {
  const RoadmapSize size = SizeOf(request);
  CheckSize(size);
  request.progress("spreading " + std::to_string(size.contacts) + " contact points");
  std::vector<grasp::Contact> contacts =
      request.given_points == nullptr
          ? sampling::SpreadContactPoints(SolidOf(request), size.contacts, request.seed)
          : sampling::GivenContacts(SolidOf(request), *request.given_points, kRoadmapContacts,
                                    size.contacts, request.seed);
  std::erase_if(contacts, [&](const grasp::Contact& contact) {
    return request.object->IsRough(contact.face, contact.p) ||
           !criteria::CanReach(*request.object, contact, request.hand.fingertip_radius);
  });
  return contacts;
}

Roadmap BuildRoadmap(const planning::PlanRequest& request,
                     const std::vector<grasp::Contact>& contacts,
                     const std::vector<grasp::Contact>& joined) {
  const double diameter = request.object->diameter();
  std::vector<grasp::Contact> points;
  JoinContacts(points, joined, object::kPointTolerance * diameter);
  JoinContacts(points, contacts, object::kPointTolerance * diameter);
  return Roadmap(std::move(points), request.object->wrench_frame(), request.criteria.friction_angle,
                 criteria::kSamePoint * diameter, request.hand.fingertip_radius, request.deadline,
                 request.progress);
}

ClusteredRoadmap BuildClusteredRoadmap(const planning::PlanRequest& request) {
  const RoadmapSize size = SizeOf(request);
  CheckSize(size);
  return ClusteredRoadmap(SolidOf(request), {.friction_angle = request.criteria.friction_angle,
                                             .contacts = size.contacts,
                                             .clusters = size.clusters,
                                             .seed = request.seed,
                                             .progress = request.progress,
                                             .finger_radius = request.hand.fingertip_radius,
                                             .deadline = request.deadline,
                                             .given_points = request.given_points});
}

}  // namespace regrasp::roadmap
