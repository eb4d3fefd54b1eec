#include "planner/gait/successors.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "planner/gait/change_paths.h"

namespace regrasp::gait {

namespace {

/// Maximum distance from the first contact of a cluster, metres, and minimum cosine between their
/// normals.
constexpr double kClusterRadius = 0.02;
constexpr double kClusterCosine = 0.7;

/// Penalty per expanded stance with the same end step, in steps.
constexpr double kSameStep = 0.1;
/// Penalty per expanded stance with the same clusters, in steps.
constexpr double kSameClusters = 0.5;
/// Penalty per expanded stance with the same holding fingers, in steps.
/// Three fingers can slide to many contacts, most of which have no useful successors.
constexpr double kSameFingers = 0.3;

std::vector<bool> HoldingFingers(const ContactAssignment& assignment) {
  std::vector<bool> is_holding;
  for (const int point : assignment) is_holding.push_back(point != kNone);
  return is_holding;
}

template <class Key>
int CountOf(const std::map<Key, int>& counts, const Key& key) {
  const auto found = counts.find(key);
  return found == counts.end() ? 0 : found->second;
}

/// Distance of a finger at a wrong contact: offset, and metres along the surface that count as much
/// as an idle finger.
constexpr double kWrongContact = 0.3;
constexpr double kFarAlongSurface = 0.08;

/// Maximum number of candidate contacts of a placed finger.
constexpr std::size_t kMaxCandidates = 24;
/// Number of subsets of the contacts.
/// At one grid node further subsets are used only if the first yields too few candidates.
constexpr int kSubsets = 4;
/// Maximum number of goal assignments and targets for simultaneous sliding.
constexpr int kMaxJointSlides = 3;
/// Maximum length of a sliding step, metres; the second one applies to goal contacts.
constexpr double kLongestSlide = 0.015;
constexpr double kLongestSlideToGoal = 0.06;

}  // namespace

ContactClusters::ContactClusters(const std::vector<SurfacePoint>& points) {
  std::vector<const SurfacePoint*> firsts;
  for (const SurfacePoint& point : points) {
    const auto found = std::ranges::find_if(firsts, [&](const SurfacePoint* first) {
      return (first->p - point.p).norm() < kClusterRadius && first->n.dot(point.n) > kClusterCosine;
    });
    cluster_of_.push_back(static_cast<int>(found - firsts.begin()));
    if (found == firsts.end()) firsts.push_back(&point);
  }
}

ContactAssignment ContactClusters::ClustersOf(ContactAssignment assignment) const {
  for (int& point : assignment) {
    if (point != kNone) point = cluster_of_[point];
  }
  return assignment;
}

void NoveltyPenalty::Count(const ContactAssignment& assignment, int step) {
  ++by_step_[step];
  ++by_clusters_[clusters_.ClustersOf(assignment)];
  ++by_fingers_[HoldingFingers(assignment)];
}

double NoveltyPenalty::Penalized(double score, const ContactAssignment& assignment,
                                 int step) const {
  return score - kSameStep * by_step_[step] -
         kSameClusters * CountOf(by_clusters_, clusters_.ClustersOf(assignment)) -
         kSameFingers * CountOf(by_fingers_, HoldingFingers(assignment));
}

bool GoalGrasp::IsHeldBy(const ContactAssignment& assignment) const {
  if (points_.empty()) return true;
  return std::ranges::count(assignment, kNone) + std::ssize(points_) == std::ssize(assignment) &&
         std::ranges::all_of(points_, [&](int point) {
           return std::ranges::find(assignment, point) != assignment.end();
         });
}

/// Return the distance of one finger between two contacts, in [0, 1].
double GoalGrasp::DistanceBetween(int from, int to) const {
  if (from == to) return 0;
  if (from == kNone || to == kNone) return 1;
  const double apart = (surface_[from].p - surface_[to].p).norm();
  const double turned = 1 - surface_[from].n.dot(surface_[to].n);
  return std::min(1.0, kWrongContact + apart / kFarAlongSurface + turned / 2);
}

double GoalGrasp::DistanceBetween(const ContactAssignment& from,
                                  const ContactAssignment& to) const {
  double distance = 0;
  for (std::size_t i = 0; i < from.size(); ++i) distance += DistanceBetween(from[i], to[i]);
  return distance;
}

const ContactAssignment* GoalGrasp::NearestTo(const ContactAssignment& assignment) const {
  const ContactAssignment* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto* assignments : {&assignments_, &targets_}) {
    for (const ContactAssignment& other : *assignments) {
      const double distance = DistanceBetween(assignment, other);
      if (distance >= least) continue;
      least = distance;
      nearest = &other;
    }
  }
  return nearest;
}

std::vector<ContactAssignment> GoalGrasp::NearestOfSameFingers(const ContactAssignment& assignment,
                                                               int most) const {
  std::vector<std::pair<double, const ContactAssignment*>> found;
  for (const auto* assignments : {&assignments_, &targets_}) {
    for (const ContactAssignment& other : *assignments) {
      const bool is_same = std::ranges::equal(
          assignment, other, {}, [](int point) { return point == kNone; },
          [](int point) { return point == kNone; });
      if (is_same && other != assignment)
        found.emplace_back(DistanceBetween(assignment, other), &other);
    }
  }
  std::ranges::stable_sort(found, {}, &std::pair<double, const ContactAssignment*>::first);
  std::vector<ContactAssignment> nearest;
  for (const auto& [distance, other] : found) {
    if (std::ssize(nearest) == most) break;
    nearest.push_back(*other);
  }
  return nearest;
}

double GoalGrasp::DistanceFrom(const ContactAssignment& assignment) const {
  const ContactAssignment* nearest = NearestTo(assignment);
  return nearest == nullptr ? 0 : DistanceBetween(assignment, *nearest);
}

std::set<int> GoalGrasp::ContactsOf(FingerIndex finger) const {
  std::set<int> contacts;
  for (const ContactAssignment& assignment : assignments_) {
    if (assignment[finger] != kNone) contacts.insert(assignment[finger]);
  }
  return contacts;
}

const std::vector<int>& SuccessorGenerator::ReachedAt(FingerIndex finger, int node, int subset) {
  const auto [found, is_new] = within_reach_.try_emplace({finger, node, subset});
  if (!is_new) return found->second;
  const int count = static_cast<int>(setup_.points.size());
  for (int point = (node + subset) % kSubsets; point < count; point += kSubsets) {
    if (checker_.reach().Find(finger, point, node) != nullptr) found->second.push_back(point);
  }
  return found->second;
}

std::vector<int> SuccessorGenerator::ContactCandidates(FingerIndex finger,
                                                       const ContactAssignment& from, int node) {
  struct Candidate {
    int point;
    bool is_goal;
    int last;  ///< step up to which the finger keeps it
  };
  std::vector<Candidate> candidates;
  Stance with{from};
  const std::set<int> goals = goal_.ContactsOf(finger);
  const auto consider = [&](int point, bool is_goal) {
    if (IsAssigned(from, point)) return;
    with.assignment[finger] = point;
    if (!checker_.KeepsApart(with, finger, node)) return;
    candidates.push_back({point, is_goal, checker_.reach().RunEnd(finger, point, node)});
  };
  for (const int point : goals) {
    if (checker_.reach().Find(finger, point, node) != nullptr) consider(point, true);
  }
  // Subsets rotate with the grid node, so that adjacent nodes use different contacts.
  for (int subset = 0; subset < kSubsets && candidates.size() < kMaxCandidates; ++subset) {
    for (const int point : ReachedAt(finger, node, subset)) {
      if (!goals.contains(point)) consider(point, false);
    }
  }
  std::ranges::stable_sort(candidates, std::greater<>(), [](const Candidate& candidate) {
    return std::pair(candidate.is_goal, candidate.last);
  });
  if (candidates.size() > kMaxCandidates) candidates.resize(kMaxCandidates);
  std::vector<int> points;
  for (const Candidate& candidate : candidates) points.push_back(candidate.point);
  return points;
}

void SuccessorGenerator::AddSwitches(const ContactAssignment& from, FingerIndex placed, int point,
                                     std::vector<ContactAssignment>& assignments) const {
  ContactAssignment with = from;
  if (placed.valid()) {
    with[placed] = point;
    assignments.push_back(with);
  }
  for (FingerIndex released{0}; released < std::ssize(from); ++released) {
    if (from[released] == kNone) continue;
    assignments.push_back(with);
    assignments.back()[released] = kNone;
  }
}

bool SuccessorGenerator::MaySlide(const ContactAssignment& from, std::size_t fingers) const {
  return setup_.may_slide &&
         CountHoldingFingers(from) - static_cast<int>(fingers) >= setup_.fewest_beside_sliding;
}

void SuccessorGenerator::AddSlidesTogether(const ContactAssignment& from, int node,
                                           std::vector<ContactAssignment>& assignments) {
  for (ContactAssignment& to : goal_.NearestOfSameFingers(from, kMaxJointSlides)) {
    const Change change = ChangeBetween(from, to);
    const bool may_come = std::ranges::all_of(change.slid, [&](FingerIndex finger) {
      return checker_.reach().Find(finger, to[finger], node) != nullptr &&
             HasRoute(from[finger], to[finger]);
    });
    if (may_come && MaySlide(from, change.slid.size())) assignments.push_back(std::move(to));
  }
}

void SuccessorGenerator::AddSlides(const ContactAssignment& from, FingerIndex finger, int node,
                                   std::vector<ContactAssignment>& assignments) {
  if (!MaySlide(from, 1)) return;
  const int at = from[finger];
  const std::set<int> goals = goal_.ContactsOf(finger);
  const int count = static_cast<int>(setup_.points.size());
  for (int point = 0; point < count; ++point) {
    const bool is_goal = goals.contains(point);
    if (!is_goal && point % kSubsets != node % kSubsets) continue;
    const double length = (setup_.points[at].p - setup_.points[point].p).norm();
    if (length > (is_goal ? kLongestSlideToGoal : kLongestSlide) || IsAssigned(from, point))
      continue;
    if (checker_.reach().Find(finger, point, node) == nullptr || !HasRoute(at, point)) continue;
    assignments.push_back(from);
    assignments.back()[finger] = point;
  }
}

std::vector<ContactAssignment> SuccessorGenerator::After(const ContactAssignment& from, int node) {
  std::vector<ContactAssignment> assignments;
  if (may_change_count_) AddSwitches(from, {}, kNone, assignments);
  for (FingerIndex finger{0}; finger < std::ssize(from); ++finger) {
    if (from[finger] != kNone) {
      AddSlides(from, finger, node, assignments);
      continue;
    }
    for (const int point : ContactCandidates(finger, from, node)) {
      AddSwitches(from, finger, point, assignments);
    }
  }
  const ContactAssignment* target = goal_.NearestTo(from);
  for (FingerIndex finger{0}; target != nullptr && finger < std::ssize(from); ++finger) {
    const int point = (*target)[finger];
    if (point == kNone || IsAssigned(from, point)) continue;
    if (checker_.reach().Find(finger, point, node) == nullptr) continue;
    if (from[finger] == kNone) {
      AddSwitches(from, finger, point, assignments);
    } else if (MaySlide(from, 1) && HasRoute(from[finger], point)) {
      assignments.push_back(from);
      assignments.back()[finger] = point;
    }
  }
  AddSlidesTogether(from, node, assignments);
  return assignments;
}

}  // namespace regrasp::gait
