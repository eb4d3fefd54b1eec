#include "planner/gait/successors.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "planner/gait/change_paths.h"

namespace regrasp::gait {

namespace {

/// From the first contact of a group, metres, and the cosine between their normals.
constexpr double kRadius = 0.02;
constexpr double kLeastCosine = 0.7;

}  // namespace

ContactClusters::ContactClusters(const std::vector<SurfacePoint>& points) {
  std::vector<const SurfacePoint*> firsts;
  for (const SurfacePoint& point : points) {
    const auto found = std::ranges::find_if(firsts, [&](const SurfacePoint* first) {
      return (first->p - point.p).norm() < kRadius && first->n.dot(point.n) > kLeastCosine;
    });
    groups_.push_back(static_cast<int>(found - firsts.begin()));
    if (found == firsts.end()) firsts.push_back(&point);
  }
}

ContactAssignment ContactClusters::KindOf(ContactAssignment holding) const {
  for (int& point : holding) {
    if (point != kNone) point = groups_[point];
  }
  return holding;
}

namespace {

/// Steps for each rest that ends at the same one.
constexpr double kAtOneStep = 0.1;
/// For each one of the same kind.
constexpr double kAlike = 0.5;
/// For each one that the same fingers hold: there is much to slide to with three fingers, and most
/// of it leads nowhere.
constexpr double kSameFingers = 0.3;

std::vector<bool> WhoHolds(const ContactAssignment& holding) {
  std::vector<bool> holds;
  for (const int point : holding) holds.push_back(point != kNone);
  return holds;
}

template <class Key>
int CountOf(const std::map<Key, int>& counts, const Key& key) {
  const auto found = counts.find(key);
  return found == counts.end() ? 0 : found->second;
}

}  // namespace

void NoveltyPenalty::Count(const ContactAssignment& holding, int step) {
  ++at_[step];
  ++like_[clusters_.KindOf(holding)];
  ++with_[WhoHolds(holding)];
}

double NoveltyPenalty::PenaltyFor(double score, const ContactAssignment& holding, int step) const {
  return score - kAtOneStep * at_[step] - kAlike * CountOf(like_, clusters_.KindOf(holding)) -
         kSameFingers * CountOf(with_, WhoHolds(holding));
}

namespace {

/// What it costs not to be there, and metres along the surface that cost as much as a finger that
/// does not hold at all.
constexpr double kNear = 0.3;
constexpr double kFar = 0.08;

}  // namespace

bool GoalGrasp::IsHeldBy(const ContactAssignment& holding) const {
  if (points_.empty()) return true;
  return std::ranges::count(holding, kNone) + std::ssize(points_) == std::ssize(holding) &&
         std::ranges::all_of(points_, [&](int point) {
           return std::ranges::find(holding, point) != holding.end();
         });
}

/// Of a finger that holds at one contact and should at another one.
double GoalGrasp::DistanceBetween(int from, int to) const {
  if (from == to) return 0;
  if (from == kNone || to == kNone) return 1;
  const double apart = (surface_[from].p - surface_[to].p).norm();
  const double turned = 1 - surface_[from].n.dot(surface_[to].n);
  return std::min(1.0, kNear + apart / kFar + turned / 2);
}

double GoalGrasp::DistanceBetween(const ContactAssignment& from,
                                  const ContactAssignment& to) const {
  double distance = 0;
  for (std::size_t i = 0; i < from.size(); ++i) distance += DistanceBetween(from[i], to[i]);
  return distance;
}

const ContactAssignment* GoalGrasp::NearestTo(const ContactAssignment& holding) const {
  const ContactAssignment* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto* holdings : {&ways_, &targets_}) {
    for (const ContactAssignment& other : *holdings) {
      const double distance = DistanceBetween(holding, other);
      if (distance >= least) continue;
      least = distance;
      nearest = &other;
    }
  }
  return nearest;
}

std::vector<ContactAssignment> GoalGrasp::NearestOfSameFingers(const ContactAssignment& holding,
                                                               int most) const {
  std::vector<std::pair<double, const ContactAssignment*>> found;
  for (const auto* holdings : {&ways_, &targets_}) {
    for (const ContactAssignment& other : *holdings) {
      const bool is_same = std::ranges::equal(
          holding, other, {}, [](int point) { return point == kNone; },
          [](int point) { return point == kNone; });
      if (is_same && other != holding) found.emplace_back(DistanceBetween(holding, other), &other);
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

double GoalGrasp::DistanceFrom(const ContactAssignment& holding) const {
  const ContactAssignment* nearest = NearestTo(holding);
  return nearest == nullptr ? 0 : DistanceBetween(holding, *nearest);
}

std::set<int> GoalGrasp::ContactsOf(FingerIndex finger) const {
  std::set<int> contacts;
  for (const ContactAssignment& way : ways_) {
    if (way[finger] != kNone) contacts.insert(way[finger]);
  }
  return contacts;
}

namespace {

/// Contacts tried for a finger that is placed, those that it keeps longest first.
constexpr std::size_t kTriedContacts = 24;
/// Of all contacts one in so many is looked at from one place, if that is enough.
constexpr int kShares = 4;
/// Goals and targets that all fingers of a grasp may slide to at once, the nearest ones.
constexpr int kSlidesTogether = 3;
/// How far a finger slides at once, metres.
constexpr double kLongestSlide = 0.015;
constexpr double kLongestSlideToGoal = 0.06;

}  // namespace

const std::vector<int>& SuccessorGenerator::ReachedAt(FingerIndex finger, int node, int share) {
  const auto [found, is_new] = within_reach_.try_emplace({finger, node, share});
  if (!is_new) return found->second;
  const int count = static_cast<int>(setup_.points.size());
  for (int point = (node + share) % kShares; point < count; point += kShares) {
    if (checker_.reach().Find(finger, point, node) != nullptr) found->second.push_back(point);
  }
  return found->second;
}

std::vector<int> SuccessorGenerator::PlacesFor(FingerIndex finger, const ContactAssignment& from,
                                               int node) {
  struct Place {
    int point;
    bool is_goal;
    int last;  ///< step to which the finger can keep it
  };
  std::vector<Place> places;
  Stance with{from};
  const std::set<int> goals = goal_.ContactsOf(finger);
  const auto look_at = [&](int point, bool is_goal) {
    if (Holds(from, point)) return;
    with.holding[finger] = point;
    if (!checker_.KeepsApart(with, finger, node)) return;
    places.push_back({point, is_goal, checker_.reach().RunEnd(finger, point, node)});
  };
  for (const int point : goals) {
    if (checker_.reach().Find(finger, point, node) != nullptr) look_at(point, true);
  }
  // At each node some of the contacts, at others others; more where few do.
  for (int share = 0; share < kShares && places.size() < kTriedContacts; ++share) {
    for (const int point : ReachedAt(finger, node, share)) {
      if (!goals.contains(point)) look_at(point, false);
    }
  }
  std::ranges::stable_sort(places, std::greater<>(),
                           [](const Place& place) { return std::pair(place.is_goal, place.last); });
  if (places.size() > kTriedContacts) places.resize(kTriedContacts);
  std::vector<int> points;
  for (const Place& place : places) points.push_back(place.point);
  return points;
}

void SuccessorGenerator::AddSwitches(const ContactAssignment& from, FingerIndex placed, int point,
                                     std::vector<ContactAssignment>& holdings) const {
  ContactAssignment with = from;
  if (placed.valid()) {
    with[placed] = point;
    holdings.push_back(with);
  }
  for (FingerIndex released{0}; released < std::ssize(from); ++released) {
    if (from[released] == kNone) continue;
    holdings.push_back(with);
    holdings.back()[released] = kNone;
  }
}

bool SuccessorGenerator::MaySlide(const ContactAssignment& from, std::size_t fingers) const {
  return setup_.may_slide &&
         CountHoldingFingers(from) - static_cast<int>(fingers) >= setup_.fewest_beside_sliding;
}

void SuccessorGenerator::AddSlidesTogether(const ContactAssignment& from, int node,
                                           std::vector<ContactAssignment>& holdings) {
  for (ContactAssignment& to : goal_.NearestOfSameFingers(from, kSlidesTogether)) {
    const Change change = ChangeBetween(from, to);
    const bool may_come = std::ranges::all_of(change.slid, [&](FingerIndex finger) {
      return checker_.reach().Find(finger, to[finger], node) != nullptr &&
             IsWay(from[finger], to[finger]);
    });
    if (may_come && MaySlide(from, change.slid.size())) holdings.push_back(std::move(to));
  }
}

void SuccessorGenerator::AddSlides(const ContactAssignment& from, FingerIndex finger, int node,
                                   std::vector<ContactAssignment>& holdings) {
  if (!MaySlide(from, 1)) return;
  const int at = from[finger];
  const std::set<int> goals = goal_.ContactsOf(finger);
  const int count = static_cast<int>(setup_.points.size());
  for (int point = 0; point < count; ++point) {
    const bool is_goal = goals.contains(point);
    if (!is_goal && point % kShares != node % kShares) continue;
    const double way = (setup_.points[at].p - setup_.points[point].p).norm();
    if (way > (is_goal ? kLongestSlideToGoal : kLongestSlide) || Holds(from, point)) continue;
    if (checker_.reach().Find(finger, point, node) == nullptr || !IsWay(at, point)) continue;
    holdings.push_back(from);
    holdings.back()[finger] = point;
  }
}

std::vector<ContactAssignment> SuccessorGenerator::After(const ContactAssignment& from, int node) {
  std::vector<ContactAssignment> holdings;
  if (may_hold_more_) AddSwitches(from, {}, kNone, holdings);
  for (FingerIndex finger{0}; finger < std::ssize(from); ++finger) {
    if (from[finger] != kNone) {
      AddSlides(from, finger, node, holdings);
      continue;
    }
    for (const int point : PlacesFor(finger, from, node)) {
      AddSwitches(from, finger, point, holdings);
    }
  }
  const ContactAssignment* target = goal_.NearestTo(from);
  for (FingerIndex finger{0}; target != nullptr && finger < std::ssize(from); ++finger) {
    const int point = (*target)[finger];
    if (point == kNone || Holds(from, point)) continue;
    if (checker_.reach().Find(finger, point, node) == nullptr) continue;
    if (from[finger] == kNone) {
      AddSwitches(from, finger, point, holdings);
    } else if (MaySlide(from, 1) && IsWay(from[finger], point)) {
      holdings.push_back(from);
      holdings.back()[finger] = point;
    }
  }
  AddSlidesTogether(from, node, holdings);
  return holdings;
}

}  // namespace regrasp::gait
