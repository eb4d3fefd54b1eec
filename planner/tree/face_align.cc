#include "planner/tree/face_align.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "planner/grasp/force_closure.h"
#include "planner/motion/find_motion_proof.h"
#include "planner/plan/plan_reach.h"
#include "planner/tree/surface_route.h"

namespace regrasp::tree {

namespace {

/// Number of tests between two readings of the clock, about a millisecond.
constexpr std::int64_t kTestsBetweenChecks = 500;

/// Cost of ray shooting for a quality, in force-closure tests.
constexpr std::int64_t kShotCost = 40;

}  // namespace

SearchSpace::SearchSpace(const object::Object& object, const criteria::GraspCriteria& criteria,
                         const hand::Hand& hand)
    : criteria::GraspMemory(object, criteria, hand, criteria::QualityTest::kQuick),
      fingers_(std::min(hand.FingersIn(object.dimension()), criteria::ContactSet::kMostHeld)) {}

std::int64_t SearchSpace::tests() const {
  return counts().force_closure + kShotCost * shot_count() + more_tests_;
}

bool SearchSpace::IsSpent() {
  if (tests() >= next_check_) {
    next_check_ = tests() + kTestsBetweenChecks;
    out_of_time_ = limits_.deadline.IsOver();
    limits_.on_check(tests());
  }
  return out_of_time_ || tests() >= limits_.most_tests;
}

namespace {

/// Instant that is tested before a proof is searched for: most infeasible motions fail there. More
/// instants would cost more on feasible motions than they save on infeasible ones.
constexpr double kProbe = 0.5;

/// Approximate cost of a search for a proof, in force-closure tests.
constexpr int kTestsOfAProof = 6;

/// Shortest piece of a proof. A motion that needs shorter pieces is too close to the limit.
constexpr double kShortestPiece = 1.0 / 64;

/// Share of the criteria of static grasps that is required at turns. Only static grasps undergo
/// disturbance tests.
constexpr double kShareAtTurns = 0.25;

motion::GraspMotion MotionBetween(const grasp::Grasp& from, const grasp::Grasp& to) {
  motion::GraspMotion motion;
  motion.reserve(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) motion.emplace_back(from[i], to[i]);
  return motion;
}

bool HoldsAt(const motion::GraspMotion& motion, double t, SearchSpace& space) {
  space.CountTests(1);
  return grasp::IsForceClosure(motion::GraspAt(motion, t), space.object().wrench_frame(),
                               space.friction_angle());
}

/// Return whether fingers with a radius can execute a sliding step.
bool IsFree(const std::vector<grasp::Grasp>& waypoints, const SearchSpace& space) {
  if (space.finger_radius() == 0) return true;
  plan::Align align;
  for (const grasp::Grasp& grasp : waypoints) {
    align.waypoints.push_back(plan::FingersInOrder(grasp));
  }
  return !plan::FindStepObstacle(space.object(), align.waypoints.front(), align,
                                 space.finger_radius());
}

/// Return the contacts of a set that another set does not contain.
criteria::ContactSet Difference(const criteria::ContactSet& set,
                                const criteria::ContactSet& other) {
  criteria::ContactSet rest;
  for (const int contact : set) {
    if (!other.Has(contact)) rest.Insert(contact);
  }
  return rest;
}

/// Cheapest assignment between two sets of contacts, by exhaustive search over at most five
/// contacts.
class Pairing {
 public:
  Pairing(const criteria::ContactSet& from, const criteria::ContactSet& to,
          const SearchSpace& space)
      : count_(from.size()) {
    for (int i = 0; i < count_; ++i) {
      bool some = false;
      for (int k = 0; k < count_; ++k) {
        costs_[i][k] = CostOf(space.contact(from[i]), space.contact(to[k]), space);
        some = some || costs_[i][k] != kNever;
      }
      if (!some) return;
    }
    Assign(0, 0, {0, 0});
  }

  [[nodiscard]] bool found() const { return best_ != kNever; }
  [[nodiscard]] int operator[](int i) const { return chosen_[i]; }

 private:
  /// Number of changed faces, and distance.
  using Cost = std::pair<int, double>;
  static constexpr Cost kNever = {std::numeric_limits<int>::max(), 0};

  static Cost CostOf(const grasp::Contact& a, const grasp::Contact& b, const SearchSpace& space) {
    const double distance = (a.p - b.p).norm();
    if (a.face == b.face) return {0, distance};
    return MayHandOver(a, b, space.object()) ? Cost{1, distance} : kNever;
  }

  void Assign(int i, unsigned taken, const Cost& cost) {
    if (cost >= best_) return;
    if (i == count_) {
      best_ = cost;
      chosen_ = choice_;
      return;
    }
    for (int k = 0; k < count_; ++k) {
      if ((taken >> k & 1) != 0 || costs_[i][k] == kNever) continue;
      choice_[i] = k;
      Assign(i + 1, taken | 1u << k,
             {cost.first + costs_[i][k].first, cost.second + costs_[i][k].second});
    }
  }

  int count_;
  std::array<std::array<Cost, criteria::ContactSet::kMostHeld>, criteria::ContactSet::kMostHeld>
      costs_{};
  std::array<int, criteria::ContactSet::kMostHeld> choice_{};
  std::array<int, criteria::ContactSet::kMostHeld> chosen_{};
  Cost best_ = kNever;
};

/// Change of a contact's face: it is at the `number`-th edge of its route at this share of the
/// motion.
struct Turn {
  double share;
  std::size_t contact;
  std::size_t number;
  auto operator<=>(const Turn&) const = default;
};

/// Simultaneous motion of contacts along their routes.
class JointPath {
 public:
  explicit JointPath(const std::vector<SurfaceRoute>& routes)
      : routes_(routes), leg_(routes.size(), 0) {
    for (std::size_t i = 0; i < routes.size(); ++i) shares_.push_back(SharesOf(routes[i]));
  }

  /// Return the grasps before and after each turn, and the ends.
  std::vector<grasp::Grasp> Waypoints() {
    std::vector<grasp::Grasp> waypoints = {At(0)};
    double at = 0;
    for (const Turn& turn : Turns()) {
      if (turn.share > at) waypoints.push_back(At(turn.share));
      at = turn.share;
      ++leg_[turn.contact];
      waypoints.push_back(At(at));
    }
    if (at < 1) waypoints.push_back(At(1));
    return waypoints;
  }

 private:
  /// Return, for each contact of a route, the share of the path before it.
  static std::vector<double> SharesOf(const SurfaceRoute& route) {
    const double whole = LengthOf(route);
    std::vector<double> shares = {0};
    for (std::size_t k = 1; k < route.size(); ++k) {
      const double leg = (route[k].p - route[k - 1].p).norm();
      shares.push_back(std::min(shares.back() + (whole > 0 ? leg / whole : 0), 1.0));
    }
    shares.back() = 1;
    return shares;
  }

  [[nodiscard]] std::vector<Turn> Turns() const {
    std::vector<Turn> turns;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
      for (std::size_t k = 1; 2 * k < routes_[i].size(); ++k) {
        turns.push_back({shares_[i][2 * k - 1], i, k});
      }
    }
    std::sort(turns.begin(), turns.end());
    return turns;
  }

  [[nodiscard]] grasp::Grasp At(double share) const {
    grasp::Grasp grasp;
    for (std::size_t i = 0; i < routes_.size(); ++i) {
      const std::size_t k = 2 * leg_[i];
      grasp::Contact contact = routes_[i][k];
      const double begin = shares_[i][k];
      const double end = shares_[i][k + 1];
      const Eigen::Vector3d& goal = routes_[i][k + 1].p;
      if (share >= end) {
        contact.p = goal;
      } else if (share > begin && contact.p != goal) {
        const double t = (share - begin) / (end - begin);
        contact.p = (1 - t) * contact.p + t * goal;
      }
      grasp.push_back(contact);
    }
    return grasp;
  }

  const std::vector<SurfaceRoute>& routes_;
  std::vector<std::vector<double>> shares_;
  std::vector<std::size_t> leg_;  ///< number of turns made [contact]
};

/// Return the waypoints of a sliding step with these pairs; empty if a contact has no route.
std::vector<grasp::Grasp> FindWaypoints(const ContactPairs& pairs, const SearchSpace& space) {
  std::vector<SurfaceRoute> routes;
  for (const auto& [a, b] : pairs) {
    auto route = a == b ? SurfaceRoute{space.contact(a), space.contact(a)}
                        : FindSurfaceRoute(space.object(), space.contact(a), space.contact(b));
    if (!route) return {};
    routes.push_back(*std::move(route));
  }
  return JointPath(routes).Waypoints();
}

/// Return whether the grasps at turns, during which fingers wait, meet part of the criteria.
bool AreGood(const std::vector<grasp::Grasp>& waypoints, SearchSpace& space) {
  const double share = space.share();
  if (!space.criteria().AsksMore()) return true;
  space.SetShare(kShareAtTurns * share);
  const bool good = std::all_of(waypoints.begin() + 1, waypoints.end() - 1,
                                [&](const grasp::Grasp& grasp) { return space.IsAdmitted(grasp); });
  space.SetShare(share);
  return good;
}

std::optional<FaceAlign> Prove(ContactPairs pairs, std::vector<grasp::Grasp> waypoints,
                               SearchSpace& space) {
  std::vector<motion::GraspMotion> motions;
  for (std::size_t w = 0; w + 1 < waypoints.size(); ++w) {
    motions.push_back(MotionBetween(waypoints[w], waypoints[w + 1]));
  }
  for (const motion::GraspMotion& motion : motions) {
    if (!HoldsAt(motion, kProbe, space)) return std::nullopt;
  }
  if (!IsFree(waypoints, space) || !AreGood(waypoints, space)) return std::nullopt;
  FaceAlign align{std::move(pairs), {}, {}};
  for (const motion::GraspMotion& motion : motions) {
    space.CountTests(kTestsOfAProof);
    auto proof =
        motion::FindMotionProof(motion, space.dimension(), space.friction_angle(), kShortestPiece);
    if (!proof) return std::nullopt;
    align.proof.push_back(*std::move(proof));
  }
  if (waypoints.size() > 2) align.between.assign(waypoints.begin() + 1, waypoints.end() - 1);
  return align;
}

}  // namespace

std::vector<grasp::Grasp> WaypointsOf(const FaceAlign& align, const SearchSpace& space) {
  std::vector<grasp::Grasp> waypoints(1);
  grasp::Grasp last;
  for (const auto& [from, to] : align.contacts) {
    waypoints.front().push_back(space.contact(from));
    last.push_back(space.contact(to));
  }
  waypoints.insert(waypoints.end(), align.between.begin(), align.between.end());
  waypoints.push_back(std::move(last));
  return waypoints;
}

bool AdmitsPath(const FaceAlign& align, SearchSpace& space) {
  return AreGood(WaypointsOf(align, space), space);
}

double TravelOf(const FaceAlign& align, const SearchSpace& space) {
  const std::vector<grasp::Grasp> waypoints = WaypointsOf(align, space);
  double travel = 0;
  for (std::size_t w = 1; w < waypoints.size(); ++w) {
    for (std::size_t i = 0; i < waypoints[w].size(); ++i) {
      travel += (waypoints[w][i].p - waypoints[w - 1][i].p).norm();
    }
  }
  return travel;
}

FaceTuple TupleOf(const criteria::ContactSet& set, const SearchSpace& space) {
  FaceTuple tuple;
  for (const int contact : set) tuple.push_back(space.contact(contact).face);
  std::sort(tuple.begin(), tuple.end());
  return tuple;
}

bool MayHandOver(const grasp::Contact& from, const grasp::Contact& to,
                 const object::Object& object) {
  return (from.p - to.p).norm() <= kNear * object.diameter() ||
         object.AreNeighbours(from.face, to.face);
}

std::optional<ContactPairs> PairContacts(const criteria::ContactSet& from,
                                         const criteria::ContactSet& to, const SearchSpace& space) {
  if (from.size() != to.size()) return std::nullopt;
  const criteria::ContactSet left = Difference(from, to);
  const criteria::ContactSet right = Difference(to, from);
  const Pairing pairing(left, right, space);
  if (!pairing.found()) return std::nullopt;
  ContactPairs pairs;
  int moving = 0;
  for (const int contact : from) {
    pairs.emplace_back(contact, to.Has(contact) ? contact : right[pairing[moving++]]);
  }
  return pairs;
}

double DistanceBetween(const criteria::ContactSet& from, const criteria::ContactSet& to,
                       const SearchSpace& space) {
  const auto pairs = PairContacts(from, to, space);
  if (!pairs) return std::numeric_limits<double>::infinity();
  double travel = 0;
  for (const auto& [a, b] : *pairs) travel += (space.contact(a).p - space.contact(b).p).norm();
  return travel;
}

std::optional<FaceAlign> AlignBetween(const criteria::ContactSet& from,
                                      const criteria::ContactSet& to, SearchSpace& space) {
  auto pairs = PairContacts(from, to, space);
  if (!pairs) return std::nullopt;
  std::vector<grasp::Grasp> waypoints = FindWaypoints(*pairs, space);
  if (waypoints.empty()) return std::nullopt;
  return Prove(*std::move(pairs), std::move(waypoints), space);
}

FaceAlign Reversed(FaceAlign align) {
  for (auto& [from, to] : align.contacts) std::swap(from, to);
  std::reverse(align.between.begin(), align.between.end());
  std::reverse(align.proof.begin(), align.proof.end());
  for (motion::MotionSegments& pieces : align.proof) {
    std::reverse(pieces.begin(), pieces.end());
    for (motion::MotionSegment& piece : pieces) {
      std::swap(piece.start, piece.end);
      std::swap(piece.from, piece.to);
      piece.from = 1 - piece.from;
      piece.to = 1 - piece.to;
    }
  }
  return align;
}

GraspPath Reversed(const GraspPath& path) {
  GraspPath reversed{path.end(), {}};
  for (auto step = path.steps.rbegin(); step != path.steps.rend(); ++step) {
    const auto before = std::next(step);
    PathStep back{before == path.steps.rend() ? path.start : before->to, std::nullopt};
    if (step->align) back.align = Reversed(*step->align);
    reversed.steps.push_back(std::move(back));
  }
  return reversed;
}

void Append(const GraspPath& more, GraspPath& path) {
  assert(more.start == path.end());
  path.steps.insert(path.steps.end(), more.steps.begin(), more.steps.end());
}

}  // namespace regrasp::tree
