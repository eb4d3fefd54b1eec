#include "planner/tree/bidirectional_tree.h"

#include <algorithm>
#include <cassert>

#include "planner/tree/subset_search.h"

namespace regrasp::tree {

ReachedGrasps::ReachedGrasps(const criteria::ContactSet& root, const SearchSpace& space)
    : space_(space) {
  Reach(root, -1);
}

int ReachedGrasps::Find(const criteria::ContactSet& set) const {
  const auto found = numbers_.find(set);
  return found == numbers_.end() ? -1 : found->second;
}

const std::vector<int>& ReachedGrasps::OnTuple(const FaceTuple& tuple) const {
  static const std::vector<int> kNone;
  const auto found = tuples_.find(tuple);
  return found == tuples_.end() ? kNone : found->second;
}

int ReachedGrasps::Reach(const criteria::ContactSet& set, int parent,
                         std::optional<FaceAlign> align) {
  const int node = size();
  nodes_.push_back({set, parent, std::move(align)});
  numbers_.emplace(set, node);
  tuples_[TupleOf(set, space_)].push_back(node);
  return node;
}

GraspPath ReachedGrasps::PathTo(int node) const {
  GraspPath path{nodes_.front().set, {}};
  for (; nodes_[node].parent >= 0; node = nodes_[node].parent) {
    path.steps.push_back({nodes_[node].set, nodes_[node].align});
  }
  std::reverse(path.steps.begin(), path.steps.end());
  return path;
}

namespace {

/// Initial number of random candidates; it doubles when all have been tested.
constexpr int kFirstCandidates = 8;

/// Number of grasps of the other tree to which a sliding step is tested from each new grasp.
constexpr int kAlignsToMeet = 2;

/// Number of force-closure tests of a tree's first turn; it doubles in every round.
constexpr std::int64_t kFirstTurn = 200;

/// Number of draws for a grasp around another, in decreasing neighbourhoods.
constexpr int kDrawsAround = 24;
constexpr double kNarrower = 0.7;

/// Distance over the diameter below which a grasp near one of the tree adds nothing. On the small
/// faces of a mesh all grasps are closer.
constexpr double kLeastTravel = 0.05;

/// Return whether a face is too small for contacts to move on it.
bool IsSmall(FaceIndex face, const object::Object& object) {
  const double travel = kLeastTravel * object.diameter();
  return object.face_measure(face) < (object.dimension() == 3 ? travel * travel : travel);
}

/// Delay of a grasp, in candidates, per earlier grasp on its tuple of faces.
constexpr int kBehind = 8;

/// Cost of a draw in addition to its test, in tests.
constexpr int kDrawCost = 2;

}  // namespace

BidirectionalTree::BidirectionalTree(const criteria::ContactSet& from,
                                     const criteria::ContactSet& to,
                                     const sampling::SurfaceSampler& source, RandomStream& random,
                                     SearchSpace& space)
    : source_(source),
      random_(random),
      space_(space),
      trees_{Tree{ReachedGrasps(from, space), {}, {}}, Tree{ReachedGrasps(to, space), {}, {}}} {
  for (const criteria::ContactSet* set : {&to, &from}) {
    for (const int contact : *set) {
      if (std::find(candidates_.begin(), candidates_.end(), contact) == candidates_.end()) {
        candidates_.push_back(contact);
      }
    }
  }
}

std::optional<GraspPath> BidirectionalTree::Join() {
  if (trees_[0].reached[0] == trees_[1].reached[0]) {
    return GraspPath{trees_[0].reached[0], {}};
  }
  Meet(0, 0);
  for (int side = 0; side < 2; ++side) MakeQueueEntry(side, 0);
  bool around = false;
  for (std::int64_t turn = kFirstTurn; !found_ && !space_.IsSpent() && space_.has_capacity();
       turn *= 2) {
    for (int side = 0; side < 2 && !found_; ++side) {
      GrowBySwitches(side, space_.tests() + turn);
      if (around && !found_) GrowAround(side, space_.tests() + turn);
      if (around && !found_) GrowAcross(side, space_.tests() + turn);
    }
    around = true;
  }
  return found_;
}

void BidirectionalTree::AddCandidates() {
  const int more = std::max(kFirstCandidates, static_cast<int>(candidates_.size()));
  for (int i = 0; i < more && space_.has_capacity(); ++i) {
    candidates_.push_back(space_.Add(source_.Draw(random_)));
  }
  for (Tree& tree : trees_) {
    for (const QueueEntry& entry : tree.waiting) tree.queue.push(entry);
    tree.waiting.clear();
  }
}

void BidirectionalTree::GrowBySwitches(int side, std::int64_t until) {
  Tree& tree = trees_[side];
  while (!found_ && space_.tests() < until && !space_.IsSpent()) {
    if (tree.queue.empty()) {
      if (tree.waiting.empty() || !space_.has_capacity()) return;
      AddCandidates();
    }
    QueueEntry entry = tree.queue.top();
    tree.queue.pop();
    if (entry.next >= static_cast<int>(candidates_.size())) {
      tree.waiting.push_back(entry);
      continue;
    }
    TryCandidate(side, entry.node, candidates_[entry.next]);
    ++entry.next;
    ++entry.rank;
    tree.queue.push(entry);
  }
}

void BidirectionalTree::TryCandidate(int side, int node, int candidate) {
  const criteria::ContactSet set = trees_[side].reached[node];
  const int fingers = space_.fingers();
  if (set.Has(candidate) || !space_.CanMeet(set, candidate)) return;
  if (set.size() < fingers - 1) {
    TryToReach(side, set.With(candidate), node);
    return;
  }
  for (const int contact : set) {
    TryToReach(side, set.Without(contact).With(candidate), node);
    if (found_) return;
  }
}

void BidirectionalTree::TryToReach(int side, const criteria::ContactSet& set, int parent) {
  if (trees_[side].reached.Find(set) < 0 && space_.Admits(set)) Reach(side, set, parent);
}

void BidirectionalTree::Reach(int side, const criteria::ContactSet& set, int parent,
                              std::optional<FaceAlign> align) {
  const int node = trees_[side].reached.Reach(set, parent, std::move(align));
  Meet(side, node);
  if (!found_) MakeQueueEntry(side, node);
}

void BidirectionalTree::MakeQueueEntry(int side, int node) {
  Tree& tree = trees_[side];
  const criteria::ContactSet set = tree.reached[node];
  if (set.size() == space_.fingers()) {
    // A hand without a free finger can only release one.
    for (const int contact : set) TryToReach(side, set.Without(contact), node);
    return;
  }
  const int on_tuple = static_cast<int>(tree.reached.OnTuple(TupleOf(set, space_)).size());
  tree.queue.push({kBehind * (on_tuple - 1), node, 0});
}

std::vector<BidirectionalTree::NodeAt> BidirectionalTree::NearestOnTuple(
    int side, const criteria::ContactSet& set, int most) const {
  const ReachedGrasps& reached = trees_[side].reached;
  std::vector<NodeAt> nearest;
  for (const int node : reached.OnTuple(TupleOf(set, space_))) {
    nearest.push_back({DistanceBetween(set, reached[node], space_), node});
  }
  most = std::min(most, static_cast<int>(nearest.size()));
  std::partial_sort(nearest.begin(), nearest.begin() + most, nearest.end());
  nearest.resize(most);
  return nearest;
}

void BidirectionalTree::Meet(int side, int node) {
  const ReachedGrasps& own = trees_[side].reached;
  const ReachedGrasps& other = trees_[1 - side].reached;
  const criteria::ContactSet set = own[node];
  const auto join = [&](int there, const GraspPath& between) {
    GraspPath path = own.PathTo(node);
    Append(between, path);
    Append(Reversed(other.PathTo(there)), path);
    found_ = side == 0 ? path : Reversed(path);
  };
  if (const int there = other.Find(set); there >= 0) {
    join(there, {set, {}});
    return;
  }
  const int any = static_cast<int>(random_.Index(other.size()));
  if (const auto between = SearchOwnSubsets(set, other[any], space_)) {
    join(any, *between);
    return;
  }
  std::vector<NodeAt> near = NearestOnTuple(1 - side, set, kAlignsToMeet);
  // A hand without a free finger cannot switch, but may reach the other's faces across edges.
  if (near.empty() && set.size() == space_.fingers()) near.push_back({0, any});
  for (const auto& [distance, there] : near) {
    if (auto align = AlignBetween(set, other[there], space_)) {
      join(there, {set, {{other[there], std::move(align)}}});
      return;
    }
  }
}

void BidirectionalTree::GrowAround(int side, std::int64_t until) {
  while (!found_ && space_.tests() < until && !space_.IsSpent() && space_.has_capacity()) {
    const int node = static_cast<int>(random_.Index(trees_[side].reached.size()));
    double reach = space_.object().diameter();
    for (int draw = 0; draw < kDrawsAround && !found_; ++draw, reach *= kNarrower) {
      space_.CountTests(kDrawCost);
      if (draw % 2 == 0 ? AlignAround(side, node, reach) : SwitchAround(side, node, reach)) break;
    }
  }
}

bool BidirectionalTree::AlignAround(int side, int node, double reach) {
  const criteria::ContactSet& from = trees_[side].reached[node];
  // One contact of a hand without a free finger leaves its face, because a switch is impossible.
  const bool full = from.size() == space_.fingers();
  const int leaving = full ? static_cast<int>(random_.Index(from.size())) : -1;
  const double least_travel = kLeastTravel * space_.object().diameter();
  grasp::Grasp drawn;
  double straight = 0;
  for (int i = 0; i < from.size(); ++i) {
    const grasp::Contact& contact = space_.contact(from[i]);
    drawn.push_back(i == leaving ? source_.DrawAround(contact, reach, random_)
                                 : source_.DrawNear(contact, reach, random_));
    straight += (drawn.back().p - contact.p).norm();
  }
  if (straight < least_travel) return false;
  const auto is_valid = [this](const grasp::Contact& contact) { return source_.IsValid(contact); };
  if (!space_.IsAdmitted(drawn) || !std::ranges::all_of(drawn, is_valid)) return false;
  const criteria::ContactSet set = space_.Add(drawn);
  for (const auto& [distance, near] : NearestOnTuple(side, set, 1)) {
    if (distance < least_travel) return false;
    node = near;
  }
  return AlignTo(side, node, set) >= 0;
}

bool BidirectionalTree::SwitchAround(int side, int node, double reach) {
  const criteria::ContactSet set = trees_[side].reached[node];
  if (set.size() == space_.fingers()) return false;
  const int leaving = set[static_cast<int>(random_.Index(set.size()))];
  grasp::Grasp drawn = space_.GraspOf(set.Without(leaving));
  drawn.push_back(source_.DrawAround(space_.contact(leaving), reach, random_));
  if (!space_.IsAdmitted(drawn) || !source_.IsValid(drawn.back())) return false;
  const int placed = space_.Add(drawn.back());
  if (!space_.CanMeet(leaving, placed)) return false;
  const criteria::ContactSet after = set.Without(leaving).With(placed);
  space_.Accept(after);
  if (trees_[side].reached.Find(after) < 0) Reach(side, after, node);
  return true;
}

void BidirectionalTree::GrowAcross(int side, std::int64_t until) {
  while (!found_ && space_.tests() < until && !space_.IsSpent() && space_.has_capacity()) {
    const int node = static_cast<int>(random_.Index(trees_[side].reached.size()));
    const criteria::ContactSet set = trees_[side].reached[node];
    space_.CountTests(kDrawCost);
    if (set.size() == space_.fingers()) continue;
    const int leaving = static_cast<int>(random_.Index(set.size()));
    const FaceIndex face = FaceAcross(side);
    const grasp::Grasp before = space_.GraspOf(set);
    FaceTuple tuple;
    for (int i = 0; i < set.size(); ++i) tuple.push_back(i == leaving ? face : before[i].face);
    std::sort(tuple.begin(), tuple.end());
    if (IsSmall(face, space_.object()) || !space_.object().TakesFingers(face) ||
        !trees_[side].reached.OnTuple(tuple).empty())
      continue;
    const auto found =
        FindTransition(before, leaving, source_.DrawOn(face, random_), source_, random_, space_);
    if (!found) continue;
    const int last = AlignAlong(side, node, std::span(found->path).subspan(1));
    if (last < 0 || found_) continue;
    const criteria::ContactSet after = space_.Add(found->after);
    space_.Accept(after);
    if (trees_[side].reached.Find(after) < 0) Reach(side, after, last);
  }
}

FaceIndex BidirectionalTree::FaceAcross(int side) {
  const ReachedGrasps& other = trees_[1 - side].reached;
  if (random_.Index(2) == 0) return FaceIndex(random_.Index(space_.object().face_count()));
  const criteria::ContactSet set = other[static_cast<int>(random_.Index(other.size()))];
  return space_.contact(set[static_cast<int>(random_.Index(set.size()))]).face;
}

int BidirectionalTree::AlignTo(int side, int node, const criteria::ContactSet& set) {
  space_.Accept(set);
  if (trees_[side].reached.Find(set) < 0) {
    auto align = AlignBetween(trees_[side].reached[node], set, space_);
    if (!align) return -1;
    Reach(side, set, node, std::move(align));
  }
  return trees_[side].reached.Find(set);
}

int BidirectionalTree::AlignAlong(int side, int node, std::span<const grasp::Grasp> path) {
  if (path.empty() || found_) return node;
  if (!space_.has_capacity()) return -1;
  if (const int end = AlignTo(side, node, space_.Add(path.back())); end >= 0) return end;
  if (path.size() == 1) return -1;
  const int middle = AlignAlong(side, node, path.first(path.size() / 2));
  return middle < 0 ? -1 : AlignAlong(side, middle, path.subspan(path.size() / 2));
}

namespace {

/// Factor by which a move must reduce the required friction angle above its useful minimum; smaller
/// gains are not worth a test.
constexpr double kWorthwhile = 0.98;

/// Initial size of moves over the diameter. It grows after a move that was kept, and shrinks after
/// one that was not.
constexpr double kFirstReach = 0.3;
constexpr double kFarther = 1.5;
constexpr double kNearer = 0.85;
constexpr double kLeastReach = 1e-3;

/// Number of bisection steps for a lower level after a move.
constexpr int kTransitionHalvings = 4;

/// Largest initial required friction angle of the later grasp, radians.
constexpr double kHighest = 1.2;

class Descent {
 public:
  Descent(const grasp::Grasp& before, int leaving, const grasp::Contact& placed,
          const sampling::SurfaceSampler& source, RandomStream& random, SearchSpace& space)
      : leaving_(leaving),
        source_(source),
        random_(random),
        space_(space),
        held_(before),
        placed_(placed),
        path_{before},
        lowest_(space.criteria().AsksMore() ? 0 : space.friction_angle()) {}

  std::optional<Transition> Find() {
    if (!space_.HoldsAt(After(held_, placed_), kHighest)) return std::nullopt;
    level_ = kHighest;
    Lower(held_, placed_);
    double reach = kFirstReach;
    while (reach > kLeastReach && !space_.IsSpent()) {
      if (level_ <= space_.friction_angle()) {
        if (auto found = Finish()) return found;
      }
      reach *= Move(reach * space_.object().diameter()) ? kFarther : kNearer;
      reach = std::min(reach, kFirstReach);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] grasp::Grasp After(const grasp::Grasp& held, const grasp::Contact& placed) const {
    grasp::Grasp after = held;
    after[leaving_] = placed;
    return after;
  }

  bool Move(double reach) {
    grasp::Grasp held;
    for (const grasp::Contact& contact : held_)
      held.push_back(source_.DrawNear(contact, reach, random_));
    const grasp::Contact placed = source_.DrawNear(placed_, reach, random_);
    const double aim = lowest_ + kWorthwhile * (level_ - lowest_);
    if (!space_.HoldsAt(After(held, placed), aim) || !space_.IsAdmitted(held)) return false;
    const auto is_valid = [this](const grasp::Contact& contact) {
      return source_.IsValid(contact);
    };
    if (!is_valid(placed) || !std::ranges::all_of(held, is_valid)) return false;
    level_ = aim;
    Lower(held, placed);
    held_ = held;
    placed_ = placed;
    path_.push_back(held);
    return true;
  }

  /// Lower the level to approximately the required friction angle of the later grasp.
  void Lower(const grasp::Grasp& held, const grasp::Contact& placed) {
    const grasp::Grasp after = After(held, placed);
    double below = lowest_;
    if (below > 0 && space_.HoldsAt(after, below)) {
      level_ = below;
      return;
    }
    for (int i = 0; i < kTransitionHalvings; ++i) {
      const double middle = (below + level_) / 2;
      (space_.HoldsAt(after, middle) ? level_ : below) = middle;
    }
  }

  std::optional<Transition> Finish() {
    const grasp::Grasp after = After(held_, placed_);
    const bool together = std::all_of(
        held_.begin(), held_.end(),
        [&](const grasp::Contact& contact) { return space_.CanMeet(contact, placed_); });
    if (!together || !space_.IsAdmitted(after)) return std::nullopt;
    return Transition{path_, after};
  }

  int leaving_;
  const sampling::SurfaceSampler& source_;
  RandomStream& random_;
  SearchSpace& space_;
  grasp::Grasp held_;
  grasp::Contact placed_;
  std::vector<grasp::Grasp> path_;
  /// Lower bound on the level. Levels below the space's friction angle help only if more than force
  /// closure is required.
  double lowest_;
  double level_ = 0;
};

}  // namespace

std::optional<Transition> FindTransition(const grasp::Grasp& before, int leaving,
                                         const grasp::Contact& placed,
                                         const sampling::SurfaceSampler& source,
                                         RandomStream& random, SearchSpace& space) {
  return Descent(before, leaving, placed, source, random, space).Find();
}

}  // namespace regrasp::tree
