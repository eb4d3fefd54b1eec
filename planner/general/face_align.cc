#include "planner/general/face_align.h"

#include <algorithm>
#include <array>
#include <limits>

#include "planner/grasp/force_closure.h"
#include "planner/motion/contact_motion.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/plan/plan_reach.h"

namespace regrasp {

namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// Instants of a motion that are looked at first, the most telling ones before the others: one that
/// is not force closure spares the search for a proof.
constexpr std::array kProbes = {0.5, 0.25, 0.75, 0.125, 0.375, 0.625, 0.875};

/// A motion that needs shorter pieces of a proof keeps too close to the limit.
constexpr double kShortestStretch = 1.0 / 64;

bool SeemsToHold(const GraspMotion& motion, SearchSpace& space) {
  return std::all_of(kProbes.begin(), kProbes.end(), [&](double t) {
    space.CountTests(1);
    return IsForceClosure(GraspAt(motion, t), space.object().wrench_frame(), space.half_angle());
  });
}

/// What remains of a set without the contacts of another, face by face.
std::vector<int> MovingContacts(const ContactSet& set, const ContactSet& other,
                                const SearchSpace& space) {
  std::vector<int> moving;
  for (const int contact : set) {
    if (!other.Has(contact)) moving.push_back(contact);
  }
  std::stable_sort(moving.begin(), moving.end(),
                   [&](int a, int b) { return space.contact(a).face < space.contact(b).face; });
  return moving;
}

double WayOf(const std::vector<int>& from, const std::vector<int>& to, const SearchSpace& space) {
  double way = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Contact& a = space.contact(from[i]);
    const Contact& b = space.contact(to[i]);
    if (a.face != b.face) return std::numeric_limits<double>::infinity();
    way += (a.p - b.p).norm();
  }
  return way;
}

bool HaveEqualNeighbours(const std::vector<int>& contacts, const SearchSpace& space) {
  return std::adjacent_find(contacts.begin(), contacts.end(), [&](int a, int b) {
           return space.contact(a).face == space.contact(b).face;
         }) != contacts.end();
}

/// Whether fingers that are no points can carry the motion out.
bool IsFree(const GraspMotion& motion, const SearchSpace& space) {
  if (space.demands().finger_radius == 0) return true;
  Align align{{{}, {}}};
  for (std::size_t i = 0; i < motion.size(); ++i) {
    align.waypoints[0].push_back({static_cast<int>(i), motion[i].from()});
    align.waypoints[1].push_back({static_cast<int>(i), motion[i].to()});
  }
  return !FindStepObstacle(space.object(), align.waypoints[0], align,
                           space.demands().finger_radius);
}

}  // namespace

FaceTuple TupleOf(const ContactSet& set, const SearchSpace& space) {
  FaceTuple tuple;
  for (const int contact : set) tuple.push_back(space.contact(contact).face);
  std::sort(tuple.begin(), tuple.end());
  return tuple;
}

Pairs PairContacts(const ContactSet& from, const ContactSet& to, const SearchSpace& space) {
  const std::vector<int> left = MovingContacts(from, to, space);
  std::vector<int> right = MovingContacts(to, from, space);
  std::vector<int> best = right;
  if (HaveEqualNeighbours(right, space)) {
    std::sort(right.begin(), right.end());
    double least = WayOf(left, best, space);
    do {
      const double way = WayOf(left, right, space);
      if (way >= least) continue;
      least = way;
      best = right;
    } while (std::next_permutation(right.begin(), right.end()));
  }
  Pairs pairs;
  for (const int contact : from) {
    const auto place = std::find(left.begin(), left.end(), contact);
    pairs.emplace_back(contact, place == left.end() ? contact : best[place - left.begin()]);
  }
  return pairs;
}

double WayBetween(const ContactSet& from, const ContactSet& to, const SearchSpace& space) {
  double way = 0;
  for (const auto& [a, b] : PairContacts(from, to, space)) {
    way += (space.contact(a).p - space.contact(b).p).norm();
  }
  return way;
}

std::optional<FaceAlign> AlignStraight(const ContactSet& from, const ContactSet& to,
                                       SearchSpace& space) {
  FaceAlign align{PairContacts(from, to, space), {}};
  GraspMotion motion;
  for (const auto& [a, b] : align.contacts) {
    const Contact& start = space.contact(a);
    const Contact& end = space.contact(b);
    const double tolerance = kPointTolerance * space.object().diameter();
    if (a != b && !space.object().ContainsSegment(start.face, start.p, end.p, tolerance)) {
      return std::nullopt;
    }
    motion.emplace_back(start, end);
  }
  if (!SeemsToHold(motion, space) || !IsFree(motion, space)) return std::nullopt;
  auto proof = FindMotionProof(motion, space.dimension(), space.half_angle(), kShortestStretch);
  if (!proof) return std::nullopt;
  align.proof = *std::move(proof);
  return align;
}

}  // namespace regrasp
