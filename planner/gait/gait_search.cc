#include "planner/gait/gait_search.h"

#include <algorithm>
#include <array>
#include <optional>

#include "planner/gait/change_paths.h"
#include "planner/gait/object_motion.h"

namespace regrasp::gait {

bool EdgeSimulation::ExecutesInSimulation(int rest) {
  if (!are_tried()) return true;
  const int last = tree_.LastExecuted(rest);
  const int from = last < 0 ? grid_.start() : tree_[last].node;
  if (grid_.StepOf(tree_[rest].node) - grid_.StepOf(from) < at_once_) return true;
  const std::optional<Gait> gait = tree_.PathTo(rest, tree_[rest].node);
  return gait && Try(rest, *gait);
}

bool EdgeSimulation::Try(int rest, const Gait& gait) {
  const GaitExecution carried = carry_out_(gait);
  if (carried.is_cut_short) return false;  // which says nothing of the rest
  at_once_ = carried.is_whole ? std::min(2 * at_once_, kMostAtOnce)
                              : std::max(at_once_ / 2, kFewestAtOnce);
  if (carried.is_whole) {
    MarkExecutedUpTo(rest);
    return true;
  }
  ++in_vain_[carried.reason];
  const int cut = tree_.CutOffAfter(rest, carried.is_held ? carried.changes : -1);
  if (cut < 0) {
    tree_[rest].ends_in_vain = true;
    LimitToMiddle(rest, grid_.steps());
    tree_.MarkExecuted(rest);
    return false;
  }
  const StanceNode& failed = tree_[cut];
  if (failed.parent >= 0) {
    MarkExecutedUpTo(failed.parent);
    failed_.insert({failed.parent, failed.node, failed.hold.holding});
    const int step = grid_.StepOf(failed.node);
    if (carried.fails_in_move) {
      LimitToMiddle(failed.parent, step);
    } else {
      CountFailedChange(failed.parent, step);
    }
  }
  return false;
}

void EdgeSimulation::LimitToMiddle(int rest, int step) {
  const int from = grid_.StepOf(tree_[rest].node);
  if (step > from) tree_.LimitBefore(rest, (from + step) / 2);
}

void EdgeSimulation::CountFailedChange(int rest, int step) {
  FailedChanges& failed = failed_changes_[rest];
  ++failed.count;
  failed.first_step = std::min(failed.first_step, step);
  if (failed.count >= kMostFailedChanges) tree_.LimitBefore(rest, failed.first_step - 1);
}

void EdgeSimulation::MarkExecutedUpTo(int rest) {
  tree_.MarkExecuted(rest);
  farthest_ = std::max(farthest_, grid_.StepOf(tree_[rest].node));
}

namespace {

constexpr int kFewestHolding = 3;
/// Of first rests: sets of contacts drawn for each set of fingers.
constexpr int kDrawnGrasps = 120;
/// Rests taken up from one place.
constexpr int kTakenUp = 8;
/// Times that a grasp is come to by ways that turn out not to be free.
constexpr int kMostFailures = 3;
/// With the same fingers placed, released or sliding.
constexpr int kTakenUpOfAKind = 2;
/// Times as many from a given start: with it all that comes after is lost.
constexpr int kMoreAtStart = 6;
/// What the steps that single fingers could go on are worth, beside those that all go together.
constexpr double kSingleFinger = 0.3;
/// What a unit beside the track costs, in steps.
constexpr double kOffTrack = 0.1;
/// What a finger costs that does not hold what it is to hold in the end, in steps.
constexpr double kNotYetGoal = 3;
/// What a slide costs on the way, in steps: a finger that slides holds less well than one that
/// rests.
constexpr double kSlide = 2;
/// Steps that a rest is put back for each turn that it had.
constexpr double kAnotherTurn = 2;
/// Of the nodes that a grasp comes to: those drawn to switch fingers at, beside those of its path.
constexpr int kNodesBeside = 2;

/// The finger that is placed, the one that is released, and a bit for each that slides.
std::array<int, 3> KindOf(const Change& change) {
  int slid = 0;
  for (const FingerIndex finger : change.slid) slid |= 1 << finger;
  return {change.placed, change.released, slid};
}

}  // namespace

GaitSearch::GaitSearch(const HandSetup& setup, const PoseGrid& grid, ObjectMotionChecker& checker,
                       const GaitEnds& ends, criteria::GraspMemory& memory, RandomStream& random)
    : setup_(setup),
      grid_(grid),
      start_(ends.start),
      start_fingers_(ends.start_fingers),
      goal_(ends.goal, setup.points),
      most_holding_(static_cast<int>(std::max(
          {static_cast<std::size_t>(kFewestHolding), ends.start.size(), ends.goal.size()}))),
      memory_(memory),
      random_(random),
      checker_(checker),
      routes_(memory),
      next_(setup, checker, goal_, routes_, most_holding_ > kFewestHolding),
      clusters_(setup.points),
      novelty_(clusters_, grid.steps()),
      rolling_(setup, memory),
      tree_(
          setup, grid, checker, memory, routes_, random,
          [this](int node, const ContactAssignment& holding) {
            return grid_.IsGoal(node) && goal_.IsHeldBy(holding);
          },
          !ends.start.empty()),
      simulation_(grid, tree_) {
  counts_.steps = grid.steps();
  if (ends.goal.empty()) return;
  ForEachAssignment(ends.goal, setup.scene.finger_count(), [&](ContactAssignment holding) {
    if (!AreHeldBy(ends.goal_fingers, ends.goal, holding)) return;
    Stance hold{std::move(holding)};
    if (checker_.PlaceIdleFingers(hold, grid.goal(), &random))
      goal_.AddWay(std::move(hold.holding));
  });
}

GaitCounts GaitSearch::counts() const {
  GaitCounts counts = counts_;
  counts.ways = tree_.counts();
  counts.not_carried = simulation_.in_vain();
  counts.farthest = farthest();
  return counts;
}

void GaitCounts::Add(const GaitCounts& other) {
  grasps += other.grasps;
  expanded += other.expanded;
  ways.no_path += other.ways.no_path;
  ways.no_slide += other.ways.no_slide;
  ways.no_move += other.ways.no_move;
  colliding += other.colliding;
  rolled += other.rolled;
  for (const auto& [reason, count] : other.not_carried) not_carried[reason] += count;
  at_goal += other.at_goal;
}

void GaitSearch::StartFrom(const Stance& hold) {
  Add({.hold = hold, .node = grid_.start()});
  begun_ = true;
}

bool GaitSearch::IsGrasp(const ContactAssignment& holding) {
  criteria::ContactSet set;
  for (const int point : holding) {
    if (point == kNone) continue;
    if (set.Has(point)) return false;
    set.Insert(point);
  }
  return set.size() >= kFewestHolding && memory_.Admits(set);
}

GaitSearch::RolledTo GaitSearch::RollTowards(const StanceNode& rest, int node) {
  if (setup_.rolled_on == nullptr) return {node, {}};
  RolledTo rolled{rest.node, rest.rolled};
  for (const int next : rest.carried.PathTo(node)) {
    if (next == rest.node) continue;
    auto tips =
        rolling_.Carry(rolled.tips, grid_.PoseAt(rolled.node), grid_.PoseAt(next), rest.hold);
    if (!tips) {
      ++counts_.rolled;
      break;
    }
    rolled = {next, *std::move(tips)};
  }
  return rolled;
}

bool GaitSearch::TakeRolledTips(StanceNode& rest) {
  if (setup_.rolled_on == nullptr) return true;
  rest.rolled = rest.rolled_before;
  rest.rolled.resize(rest.hold.holding.size());
  for (FingerIndex finger{0}; finger < std::ssize(rest.rolled); ++finger) {
    const int point = rest.hold.holding[finger];
    if (point == kNone) {
      rest.rolled[finger].reset();
    } else if (!rest.rolled[finger]) {
      rest.rolled[finger] = {setup_.points[point],
                             *checker_.reach().Find(finger, point, rest.node)};
    }
  }
  if (rolling_.AreGrasp(rest.rolled, grid_.PoseAt(rest.node))) return true;
  ++counts_.rolled;
  return false;
}

double GaitSearch::ScoreOf(const ContactAssignment& holding, int node, int slides, int last) {
  double sum = 0;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (holding[finger] == kNone) continue;
    sum += checker_.reach().RunEnd(finger, holding[finger], node);
  }
  return last + kSingleFinger * sum / CountHoldingFingers(holding) -
         kOffTrack * grid_.OffTrack(node) - kNotYetGoal * goal_.DistanceFrom(holding) -
         (grid_.steps() > 0 ? kSlide * slides : 0);
}

bool GaitSearch::IsTaken(const ContactAssignment& holding, int node) const {
  const auto found = taken_.find(holding);
  return found != taken_.end() && std::ranges::any_of(found->second, [&](const QueuedGrasp& taken) {
           return taken.node == node && (taken.rest < 0 || !tree_[taken.rest].is_cut_off);
         });
}

bool GaitSearch::Add(StanceNode rest) {
  if (!IsGrasp(rest.hold.holding) || IsTaken(rest.hold.holding, rest.node)) return false;
  QueuedGrasp& taken = taken_[rest.hold.holding].emplace_back(QueuedGrasp{rest.node});
  ++counts_.grasps;
  const Stance* before = rest.parent < 0 ? nullptr : &tree_[rest.parent].hold;
  if (!checker_.PlaceIdleFingers(rest.hold, rest.node, nullptr, before)) {
    ++counts_.colliding;
    return false;
  }
  if (!TakeRolledTips(rest)) return false;
  rest.carried = checker_.ExtendAlongTrack(rest.hold, rest.node);
  rest.score = ScoreOf(rest.hold.holding, rest.node, rest.slides, grid_.StepOf(rest.carried.end));
  taken.rest = tree_.size();
  queue_.push({rest.score, taken.rest});
  tree_.Add(std::move(rest));
  return true;
}

void GaitSearch::AddGivenStart() {
  ForEachAssignment(start_, setup_.scene.finger_count(), [&](ContactAssignment holding) {
    if (!AreHeldBy(start_fingers_, start_, holding)) return;
    Stance hold{std::move(holding)};
    if (checker_.PlaceIdleFingers(hold, grid_.start(), &random_)) {
      Add({.hold = std::move(hold), .node = grid_.start()});
    } else {
      ++counts_.colliding;
    }
  });
}

void GaitSearch::AddInitialStances() {
  const int fingers = setup_.scene.finger_count();
  std::vector<std::vector<int>> places;
  for (FingerIndex finger{0}; finger < fingers; ++finger) {
    places.push_back(next_.PlacesFor(finger, ContactAssignment(fingers, kNone), grid_.start()));
  }
  std::vector<int> chosen(fingers, 0);
  std::fill(chosen.begin(), chosen.begin() + kFewestHolding, 1);
  do {
    for (int i = 0; i < kDrawnGrasps; ++i) {
      ContactAssignment holding(fingers, kNone);
      for (FingerIndex finger{0}; finger < fingers; ++finger) {
        if (chosen[finger] == 0) continue;
        const std::vector<int>& points = places[finger];
        if (points.empty()) break;
        // Those that it keeps longest stand first.
        const double place = random_.Uniform() * random_.Uniform();
        holding[finger] = points[static_cast<std::size_t>(place * points.size())];
      }
      if (CountHoldingFingers(holding) == kFewestHolding) {
        Add({.hold = {std::move(holding)}, .node = grid_.start()});
      }
    }
  } while (std::ranges::prev_permutation(chosen).found);
}

std::optional<double> GaitSearch::ScoreAfter(const StanceNode& from, const ContactAssignment& to,
                                             int node) {
  const int count = CountHoldingFingers(to);
  if (count < kFewestHolding || count > most_holding_ || !IsGrasp(to)) return std::nullopt;
  int last = grid_.steps();
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (to[finger] == kNone) continue;
    last = std::min(last, checker_.reach().RunEnd(finger, to[finger], node));
  }
  const bool slides = !ChangeBetween(from.hold.holding, to).slid.empty();
  return ScoreOf(to, node, from.slides + static_cast<int>(slides), last);
}

bool GaitSearch::SwitchAt(int index, int node) {
  const ContactAssignment from = tree_[index].hold.holding;
  if (grid_.StepOf(node) > tree_[index].farthest) return false;
  const RolledTo rolled = RollTowards(tree_[index], node);
  if (rolled.node != node) return false;
  std::vector<std::pair<double, ContactAssignment>> found;
  for (ContactAssignment& to : next_.After(from, node)) {
    if (const auto score = ScoreAfter(tree_[index], to, node)) {
      found.emplace_back(*score, std::move(to));
    }
  }
  std::ranges::stable_sort(found, std::greater<>(), &std::pair<double, ContactAssignment>::first);
  const bool is_start = !start_.empty() && tree_[index].parent < 0;
  const int many = is_start ? kMoreAtStart : 1;
  int taken = 0;
  std::map<std::array<int, 3>, int> taken_by_fingers;
  for (const auto& [score, to] : found) {
    if (taken == many * kTakenUp) break;
    const Change change = ChangeBetween(from, to);
    int& alike = taken_by_fingers[KindOf(change)];
    if (alike == many * kTakenUpOfAKind) continue;
    StanceNode rest = tree_.After(index, to, node);
    // A switch passes a grasp of all fingers.
    Stance all = rest.hold;
    if (change.released.valid()) all.holding[change.released] = from[change.released];
    if (change.placed.valid() && !checker_.IsPassable(all, rest.node)) continue;
    rest.rolled_before = rolled.tips;
    if (simulation_.HasFailed(index, rest.node, rest.hold.holding)) continue;
    if (!Add(std::move(rest))) continue;
    ++taken;
    ++alike;
  }
  return taken > 0;
}

void GaitSearch::Expand(int index) {
  const StanceNode& rest = tree_[index];
  const std::vector<int> path = rest.carried.PathTo(rest.carried.end);
  const std::size_t last = path.size() - 1;
  std::set<int> nodes = {path[last], path[last / 2], path[last - std::min<std::size_t>(last, 2)],
                         path[0]};
  const int beside = rest.carried.from.size() == 1 ? 0 : kNodesBeside;
  for (int i = 0; i < beside; ++i) {
    nodes.insert(std::next(rest.carried.from.begin(),
                           static_cast<int>(random_.Index(rest.carried.from.size())))
                     ->first);
  }
  StanceNode& again = tree_[index];
  bool is_worth_it = ++again.turns == 1;
  for (const int node : nodes) {
    again.switched_at.insert(node);
    is_worth_it = SwitchAt(index, node) || is_worth_it;
  }
  // Another turn looks at grasps for which there was no room, and at other nodes.
  if (is_worth_it || again.switched_at.size() < again.carried.from.size()) {
    queue_.push({again.score - kAnotherTurn * again.turns, index});
  }
}

bool GaitSearch::ReachesEnd(int index) {
  while (!tree_[index].is_cut_off) {
    ReachablePoses& carried = tree_[index].carried;
    const int end = carried.end;
    if (tree_.PathTo(index, end)) return true;
    if (carried.end == end && carried.from.contains(end)) carried.end = carried.from.at(end);
  }
  return false;
}

/// The whole gait, where a rest's path leads to the goal and is free.
std::optional<Gait> GaitSearch::GaitFrom(int index) {
  ReachablePoses& carried = tree_[index].carried;
  if (!grid_.IsGoal(carried.end) || !goal_.IsHeldBy(tree_[index].hold.holding)) {
    return std::nullopt;
  }
  ++counts_.at_goal;
  const int end = carried.end;
  if (tree_[index].ends_in_vain || grid_.StepOf(end) > tree_[index].farthest) return std::nullopt;
  std::optional<Gait> gait = tree_.PathTo(index, end);
  if (gait && simulation_.are_tried() && !simulation_.Try(index, *gait)) return std::nullopt;
  // Else the rest goes on from where it did not fail, or from another place.
  if (!gait && carried.from.contains(end)) carried.end = carried.from.at(end);
  return gait;
}

void GaitSearch::AddTarget(const ContactAssignment& holding) {
  if (targets_.insert(clusters_.KindOf(holding)).second) goal_.AddTarget(holding);
}

int GaitSearch::PopNext() {
  while (true) {
    const QueueEntry top = queue_.top();
    queue_.pop();
    const StanceNode& rest = tree_[top.rest];
    const double score = novelty_.PenaltyFor(rest.score - kAnotherTurn * rest.turns,
                                             rest.hold.holding, grid_.StepOf(rest.carried.end));
    if (queue_.empty() || score >= top.score || score >= queue_.top().score) return top.rest;
    queue_.push({score, top.rest});
  }
}

/// Whether the same grasp was expanded that passes the rest's node.
bool GaitSearch::WasExpandedAt(const StanceNode& rest) const {
  const auto found = expanded_.find(rest.hold.holding);
  return found != expanded_.end() && std::ranges::any_of(found->second, [&](int other) {
           return !tree_[other].is_cut_off && tree_[other].carried.from.contains(rest.node);
         });
}

int GaitSearch::ConnectToParent(int index) {
  if (tree_.PlanPathFromParent(tree_[index])) return index;
  const int other = tree_.AfterIdlingAbove(index);
  // From another rest there may be a way.
  StanceNode& failed = tree_[index];
  if (other < 0 && ++failed_[failed.hold.holding] < kMostFailures) failed.is_cut_off = true;
  return other;
}

std::optional<Gait> GaitSearch::Run(std::int64_t most_expanded, const Deadline& deadline) {
  if (!begun_) start_.empty() ? AddInitialStances() : AddGivenStart();
  begun_ = true;
  while (!queue_.empty() && counts_.expanded < most_expanded) {
    if (deadline.IsOver()) return std::nullopt;
    int index = PopNext();
    const bool is_new = tree_[index].turns == 0;
    if (tree_[index].is_cut_off || (is_new && WasExpandedAt(tree_[index]))) continue;
    if (is_new) index = ConnectToParent(index);
    if (index < 0) continue;
    StanceNode& rest = tree_[index];
    // Where the object has nowhere to go it stays while there is something else to do.
    if (grid_.steps() > 0 || !is_new) tree_.ExtendReachable(rest);
    rest.carried.end = RollTowards(rest, rest.carried.end).node;
    if (std::optional<Gait> gait = GaitFrom(index)) return gait;
    if (rest.is_cut_off) continue;
    // Whose way can't be gone had better be found out before much grows from it.
    if (grid_.StepOf(rest.carried.end) > reached_ && !ReachesEnd(index)) continue;
    if (!simulation_.ExecutesInSimulation(index)) continue;
    if (is_new) expanded_[rest.hold.holding].push_back(index);
    const int last = grid_.StepOf(rest.carried.end);
    reached_ = std::max(reached_, last);
    ++counts_.expanded;
    novelty_.Count(rest.hold.holding, last);
    last_expanded_ = index;
    Expand(index);
  }
  return std::nullopt;
}

}  // namespace regrasp::gait
