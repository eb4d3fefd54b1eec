#include "planner/gait/gait_search.h"

#include <algorithm>
#include <array>
#include <optional>

#include "planner/gait/change_paths.h"
#include "planner/gait/object_motion.h"

namespace regrasp::gait {

bool EdgeSimulation::ExecutesInSimulation(int index) {
  if (!is_enabled()) return true;
  const int last = tree_.LastExecuted(index);
  const int from = last < 0 ? grid_.start() : tree_[last].node;
  if (grid_.StepOf(tree_[index].node) - grid_.StepOf(from) < lookahead_) return true;
  const std::optional<Gait> gait = tree_.PathTo(index, tree_[index].node);
  return gait && Simulate(index, *gait);
}

bool EdgeSimulation::Simulate(int index, const Gait& gait) {
  const GaitExecution execution = simulate_(gait);
  if (execution.is_cut_short) return false;  // an interrupted simulation gives no result
  lookahead_ = execution.is_whole ? std::min(2 * lookahead_, kGreatestLookahead)
                                  : std::max(lookahead_ / 2, kLeastLookahead);
  if (execution.is_whole) {
    MarkExecutedUpTo(index);
    return true;
  }
  ++failures_[execution.reason];
  const int cut = tree_.PruneAfter(index, execution.is_held ? execution.changes : -1);
  if (cut < 0) {
    tree_[index].goal_path_failed = true;
    LimitToMiddle(index, grid_.steps());
    tree_.MarkExecuted(index);
    return false;
  }
  const StanceNode& failed = tree_[cut];
  if (failed.parent >= 0) {
    MarkExecutedUpTo(failed.parent);
    failed_.insert({failed.parent, failed.node, failed.stance.assignment});
    const int step = grid_.StepOf(failed.node);
    if (execution.fails_in_move) {
      LimitToMiddle(failed.parent, step);
    } else {
      CountFailedChange(failed.parent, step);
    }
  }
  return false;
}

void EdgeSimulation::LimitToMiddle(int index, int step) {
  const int from = grid_.StepOf(tree_[index].node);
  if (step > from) tree_.LimitBefore(index, (from + step) / 2);
}

void EdgeSimulation::CountFailedChange(int index, int step) {
  FailedChanges& failed = failed_changes_[index];
  ++failed.count;
  failed.first_step = std::min(failed.first_step, step);
  if (failed.count >= kMaxFailedChanges) tree_.LimitBefore(index, failed.first_step - 1);
}

void EdgeSimulation::MarkExecutedUpTo(int index) {
  tree_.MarkExecuted(index);
  farthest_ = std::max(farthest_, grid_.StepOf(tree_[index].node));
}

namespace {

constexpr int kFewestHolding = 3;
/// Random assignments per set of fingers at the start.
constexpr int kInitialDraws = 120;
/// Maximum number of successors queued from one grid node.
constexpr int kMaxSuccessors = 8;
/// Failed connections to an assignment after which it is not queued again at their grid node.
/// Before, another parent may queue it there.
constexpr int kMaxFailures = 3;
/// Maximum number of successors with the same fingers placed, released and sliding.
constexpr int kMaxSuccessorsPerChange = 2;
/// Factor of both maxima at a given start grasp, because no other root can replace it.
constexpr int kStartFactor = 6;
/// Weight of the mean step that each finger alone could follow, relative to the step that all
/// reach.
constexpr double kSingleFinger = 0.3;
/// Penalty per unit of offset from the track, in steps.
constexpr double kOffTrack = 0.1;
/// Penalty per finger that does not hold its goal contact, in steps.
constexpr double kGoalDistanceWeight = 3;
/// Penalty per sliding step on the path, in steps.
/// A sliding finger holds less reliably than a static one.
constexpr double kSlide = 2;
/// Penalty per earlier expansion of the same node, in steps.
constexpr double kReexpansionPenalty = 2;
/// Number of random reachable grid nodes that are expanded, in addition to those on the path.
constexpr int kRandomNodes = 2;

/// Return the placed finger, the released finger, and a bit mask of the sliding fingers.
std::array<int, 3> ChangeKey(const Change& change) {
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
      start_configurations_(ends.start_configurations),
      goal_(ends.goal, setup.points),
      max_holding_(static_cast<int>(std::max(
          {static_cast<std::size_t>(kFewestHolding), ends.start.size(), ends.goal.size()}))),
      memory_(memory),
      random_(random),
      checker_(checker),
      supported_(setup, grid, memory),
      routes_(memory),
      successors_(setup, checker, goal_, routes_, max_holding_ > kFewestHolding),
      clusters_(setup.points),
      novelty_(clusters_, grid.steps()),
      rolling_(setup, memory),
      tree_(
          setup, grid, checker, memory, routes_, random,
          [this](int node, const ContactAssignment& assignment) {
            return grid_.IsGoal(node) && goal_.IsHeldBy(assignment);
          },
          !ends.start.empty() && ends.start_configurations.empty()),
      simulation_(grid, tree_) {
  counts_.steps = grid.steps();
  if (setup.carrier != nullptr) checker.RequireSupport(supported_);
  if (ends.goal.empty()) return;
  ForEachAssignment(ends.goal, setup.scene.finger_count(), [&](ContactAssignment assignment) {
    if (!AreHeldBy(ends.goal_fingers, ends.goal, assignment)) return;
    Stance stance{std::move(assignment)};
    if (checker_.PlaceIdleFingers(stance, grid.goal(), &random))
      goal_.AddAssignment(std::move(stance.assignment));
  });
}

GaitCounts GaitSearch::counts() const {
  GaitCounts counts = counts_;
  counts.path_failures = tree_.counts();
  counts.execution_failures = simulation_.failures();
  counts.farthest = farthest();
  return counts;
}

void GaitCounts::CountHolding(const ContactAssignment& assignment) {
  holding.resize(assignment.size());
  for (std::size_t finger = 0; finger < assignment.size(); ++finger) {
    holding[finger] += static_cast<std::int64_t>(assignment[finger] != kNone);
  }
}

void GaitCounts::Add(const GaitCounts& other) {
  evaluated += other.evaluated;
  holding.resize(std::max(holding.size(), other.holding.size()));
  for (std::size_t finger = 0; finger < other.holding.size(); ++finger) {
    holding[finger] += other.holding[finger];
  }
  expanded += other.expanded;
  path_failures.no_path += other.path_failures.no_path;
  path_failures.no_slide += other.path_failures.no_slide;
  path_failures.no_move += other.path_failures.no_move;
  colliding += other.colliding;
  rolled += other.rolled;
  for (const auto& [reason, count] : other.execution_failures) execution_failures[reason] += count;
  at_goal += other.at_goal;
}

void GaitSearch::StartFrom(const Stance& stance) {
  Add({.stance = stance, .node = grid_.start()});
  is_started_ = true;
}

bool GaitSearch::IsGrasp(const ContactAssignment& assignment, int node) {
  criteria::ContactSet set;
  for (const int point : assignment) {
    if (point == kNone) continue;
    if (set.Has(point)) return false;
    set.Insert(point);
  }
  return set.size() >= kFewestHolding && supported_.Holds(set, node);
}

GaitSearch::RolledTo GaitSearch::RollTowards(const StanceNode& stance_node, int node) {
  if (setup_.rolled_on == nullptr) return {node, {}};
  RolledTo rolled{stance_node.node, stance_node.rolled};
  for (const int next : stance_node.reachable.PathTo(node)) {
    if (next == stance_node.node) continue;
    auto tips = rolling_.Advance(rolled.tips, grid_.PoseAt(rolled.node), grid_.PoseAt(next),
                                 stance_node.stance);
    if (!tips) {
      ++counts_.rolled;
      break;
    }
    rolled = {next, *std::move(tips)};
  }
  return rolled;
}

bool GaitSearch::InitRolledTips(StanceNode& stance_node) {
  if (setup_.rolled_on == nullptr) return true;
  stance_node.rolled = stance_node.rolled_before;
  stance_node.rolled.resize(stance_node.stance.assignment.size());
  for (FingerIndex finger{0}; finger < std::ssize(stance_node.rolled); ++finger) {
    const int point = stance_node.stance.assignment[finger];
    if (point == kNone) {
      stance_node.rolled[finger].reset();
    } else if (!stance_node.rolled[finger]) {
      stance_node.rolled[finger] = {setup_.points[point],
                                    *checker_.reach().Find(finger, point, stance_node.node)};
    }
  }
  if (rolling_.AreGrasp(stance_node.rolled, grid_.PoseAt(stance_node.node))) return true;
  ++counts_.rolled;
  return false;
}

double GaitSearch::ScoreOf(const ContactAssignment& assignment, int node, int slides, int last) {
  double sum = 0;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (assignment[finger] == kNone) continue;
    sum += checker_.reach().RunEnd(finger, assignment[finger], node);
  }
  return last + kSingleFinger * sum / CountHoldingFingers(assignment) -
         kOffTrack * grid_.OffTrack(node) - kGoalDistanceWeight * goal_.DistanceFrom(assignment) -
         (grid_.steps() > 0 ? kSlide * slides : 0);
}

bool GaitSearch::IsQueued(const ContactAssignment& assignment, int node) const {
  const auto found = queued_.find(assignment);
  return found != queued_.end() &&
         std::ranges::any_of(found->second, [&](const QueuedGrasp& queued) {
           return queued.node == node && (queued.index < 0 || !tree_[queued.index].is_pruned);
         });
}

bool GaitSearch::Add(StanceNode stance_node) {
  if (!IsGrasp(stance_node.stance.assignment, stance_node.node) ||
      IsQueued(stance_node.stance.assignment, stance_node.node))
    return false;
  QueuedGrasp& queued =
      queued_[stance_node.stance.assignment].emplace_back(QueuedGrasp{stance_node.node});
  ++counts_.evaluated;
  counts_.CountHolding(stance_node.stance.assignment);
  const Stance* before = stance_node.parent < 0 ? nullptr : &tree_[stance_node.parent].stance;
  if (!checker_.PlaceIdleFingers(stance_node.stance, stance_node.node, nullptr, before)) {
    ++counts_.colliding;
    return false;
  }
  if (!InitRolledTips(stance_node)) return false;
  stance_node.reachable = checker_.ExtendAlongTrack(stance_node.stance, stance_node.node);
  stance_node.score = ScoreOf(stance_node.stance.assignment, stance_node.node, stance_node.slides,
                              grid_.StepOf(stance_node.reachable.end));
  queued.index = tree_.size();
  queue_.push({stance_node.score, queued.index});
  tree_.Add(std::move(stance_node));
  return true;
}

void GaitSearch::AddGivenStart() {
  ForEachAssignment(start_, setup_.scene.finger_count(), [&](ContactAssignment assignment) {
    if (!AreHeldBy(start_fingers_, start_, assignment)) return;
    Stance stance{std::move(assignment)};
    UseStartConfigurations(stance);
    if (checker_.PlaceIdleFingers(stance, grid_.start(), &random_)) {
      Add({.stance = std::move(stance), .node = grid_.start()});
    } else {
      ++counts_.colliding;
    }
  });
}

void GaitSearch::UseStartConfigurations(Stance& stance) {
  if (start_configurations_.empty()) return;
  stance.idle.resize(stance.assignment.size());
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    const JointConfiguration& configuration = start_configurations_[finger];
    if (const int point = stance.assignment[finger]; point == kNone) {
      stance.idle[finger] = configuration;
    } else {
      checker_.SetConfiguration(finger, point, grid_.start(), configuration);
    }
  }
}

void GaitSearch::AddInitialStances() {
  const int fingers = setup_.scene.finger_count();
  std::vector<std::vector<int>> candidates;
  for (FingerIndex finger{0}; finger < fingers; ++finger) {
    candidates.push_back(
        successors_.ContactCandidates(finger, ContactAssignment(fingers, kNone), grid_.start()));
  }
  std::vector<int> chosen(fingers, 0);
  std::fill(chosen.begin(), chosen.begin() + kFewestHolding, 1);
  do {
    for (int i = 0; i < kInitialDraws; ++i) {
      ContactAssignment assignment(fingers, kNone);
      for (FingerIndex finger{0}; finger < fingers; ++finger) {
        if (chosen[finger] == 0) continue;
        const std::vector<int>& points = candidates[finger];
        if (points.empty()) break;
        // Contacts that a finger keeps longest come first and are drawn most often.
        const double rank = random_.Uniform() * random_.Uniform();
        assignment[finger] = points[static_cast<std::size_t>(rank * points.size())];
      }
      if (CountHoldingFingers(assignment) == kFewestHolding) {
        Add({.stance = {std::move(assignment)}, .node = grid_.start()});
      }
    }
  } while (std::ranges::prev_permutation(chosen).found);
}

std::optional<double> GaitSearch::ScoreAfter(const StanceNode& from, const ContactAssignment& to,
                                             int node) {
  const int count = CountHoldingFingers(to);
  if (count < kFewestHolding || count > max_holding_ || !IsGrasp(to, node)) return std::nullopt;
  int last = grid_.steps();
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (to[finger] == kNone) continue;
    last = std::min(last, checker_.reach().RunEnd(finger, to[finger], node));
  }
  const bool slides = !ChangeBetween(from.stance.assignment, to).slid.empty();
  return ScoreOf(to, node, from.slides + static_cast<int>(slides), last);
}

bool GaitSearch::ExpandAt(int index, int node) {
  const ContactAssignment from = tree_[index].stance.assignment;
  if (grid_.StepOf(node) > tree_[index].farthest) return false;
  const RolledTo rolled = RollTowards(tree_[index], node);
  if (rolled.node != node) return false;
  std::vector<std::pair<double, ContactAssignment>> found;
  for (ContactAssignment& to : successors_.After(from, node)) {
    if (const auto score = ScoreAfter(tree_[index], to, node)) {
      found.emplace_back(*score, std::move(to));
    }
  }
  std::ranges::stable_sort(found, std::greater<>(), &std::pair<double, ContactAssignment>::first);
  const bool is_start = !start_.empty() && tree_[index].parent < 0;
  const int factor = is_start ? kStartFactor : 1;
  int queued = 0;
  std::map<std::array<int, 3>, int> queued_by_change;
  for (const auto& [score, to] : found) {
    if (queued == factor * kMaxSuccessors) break;
    const Change change = ChangeBetween(from, to);
    int& of_change = queued_by_change[ChangeKey(change)];
    if (of_change == factor * kMaxSuccessorsPerChange) continue;
    StanceNode stance_node = tree_.After(index, to, node);
    // During a finger switch all these fingers are in contact.
    Stance all = stance_node.stance;
    if (change.released.valid()) all.assignment[change.released] = from[change.released];
    if (change.placed.valid() && !checker_.IsPassable(all, stance_node.node)) continue;
    stance_node.rolled_before = rolled.tips;
    if (simulation_.HasFailed(index, stance_node.node, stance_node.stance.assignment)) continue;
    if (!Add(std::move(stance_node))) continue;
    ++queued;
    ++of_change;
  }
  return queued > 0;
}

void GaitSearch::Expand(int index) {
  const StanceNode& stance_node = tree_[index];
  const std::vector<int> path = stance_node.reachable.PathTo(stance_node.reachable.end);
  const std::size_t last = path.size() - 1;
  std::set<int> nodes = {path[last], path[last / 2], path[last - std::min<std::size_t>(last, 2)],
                         path[0]};
  const int random_nodes = stance_node.reachable.predecessor.size() == 1 ? 0 : kRandomNodes;
  for (int i = 0; i < random_nodes; ++i) {
    nodes.insert(
        std::next(stance_node.reachable.predecessor.begin(),
                  static_cast<int>(random_.Index(stance_node.reachable.predecessor.size())))
            ->first);
  }
  StanceNode& node_to_expand = tree_[index];
  bool expands_again = ++node_to_expand.expansions == 1;
  for (const int node : nodes) {
    node_to_expand.expanded_at.insert(node);
    expands_again = ExpandAt(index, node) || expands_again;
  }
  // Another expansion considers successors that exceeded the maximum, and other grid nodes.
  if (expands_again ||
      node_to_expand.expanded_at.size() < node_to_expand.reachable.predecessor.size()) {
    queue_.push({node_to_expand.score - kReexpansionPenalty * node_to_expand.expansions, index});
  }
}

bool GaitSearch::ReachesEnd(int index) {
  while (!tree_[index].is_pruned) {
    ReachablePoses& reachable = tree_[index].reachable;
    const int end = reachable.end;
    if (tree_.PathTo(index, end)) return true;
    if (reachable.end == end && reachable.predecessor.contains(end))
      reachable.end = reachable.predecessor.at(end);
  }
  return false;
}

/// Plan the whole gait if the stance reaches the goal.
std::optional<Gait> GaitSearch::GaitFrom(int index) {
  ReachablePoses& reachable = tree_[index].reachable;
  if (!grid_.IsGoal(reachable.end) || !goal_.IsHeldBy(tree_[index].stance.assignment)) {
    return std::nullopt;
  }
  ++counts_.at_goal;
  const int end = reachable.end;
  if (tree_[index].goal_path_failed || grid_.StepOf(end) > tree_[index].farthest)
    return std::nullopt;
  std::optional<Gait> gait = tree_.PathTo(index, end);
  if (gait && simulation_.is_enabled() && !simulation_.Simulate(index, *gait)) return std::nullopt;
  // The stance continues before the failed motion, or elsewhere.
  if (!gait && reachable.predecessor.contains(end)) reachable.end = reachable.predecessor.at(end);
  return gait;
}

void GaitSearch::AddTarget(const ContactAssignment& assignment) {
  if (targets_.insert(clusters_.ClustersOf(assignment)).second) goal_.AddTarget(assignment);
}

int GaitSearch::PopNext() {
  while (true) {
    const QueueEntry top = queue_.top();
    queue_.pop();
    const StanceNode& stance_node = tree_[top.index];
    const double score =
        novelty_.Penalized(stance_node.score - kReexpansionPenalty * stance_node.expansions,
                           stance_node.stance.assignment, grid_.StepOf(stance_node.reachable.end));
    if (queue_.empty() || score >= top.score || score >= queue_.top().score) return top.index;
    queue_.push({score, top.index});
  }
}

/// Return whether the assignment was expanded in a stance that reaches this grid node.
bool GaitSearch::WasExpandedAt(const StanceNode& stance_node) const {
  const auto found = expanded_.find(stance_node.stance.assignment);
  return found != expanded_.end() && std::ranges::any_of(found->second, [&](int other) {
           return !tree_[other].is_pruned &&
                  tree_[other].reachable.predecessor.contains(stance_node.node);
         });
}

int GaitSearch::ConnectToParent(int index) {
  if (tree_.PlanPathFromParent(tree_[index])) return index;
  const int other = tree_.AfterIdlingAbove(index);
  // There may be a path from another parent, which queues the assignment again if this node is
  // pruned.
  StanceNode& failed = tree_[index];
  if (other < 0 && ++failed_[failed.stance.assignment] < kMaxFailures) failed.is_pruned = true;
  return other;
}

std::optional<Gait> GaitSearch::Run(std::int64_t most_expanded, const Deadline& deadline) {
  if (!is_started_) start_.empty() ? AddInitialStances() : AddGivenStart();
  is_started_ = true;
  while (!queue_.empty() && counts_.expanded < most_expanded) {
    if (deadline.IsOver()) return std::nullopt;
    int index = PopNext();
    const bool is_new = tree_[index].expansions == 0;
    if (tree_[index].is_pruned || (is_new && WasExpandedAt(tree_[index]))) continue;
    if (is_new) index = ConnectToParent(index);
    if (index < 0) continue;
    StanceNode& stance_node = tree_[index];
    // If the object need not move, extend stances over the grid only when they are expanded again.
    if (grid_.steps() > 0 || !is_new) tree_.ExtendReachable(stance_node);
    stance_node.reachable.end = RollTowards(stance_node, stance_node.reachable.end).node;
    if (std::optional<Gait> gait = GaitFrom(index)) return gait;
    if (stance_node.is_pruned) continue;
    // Plan the path early if much could grow from it.
    if (grid_.StepOf(stance_node.reachable.end) > reached_ && !ReachesEnd(index)) continue;
    if (!simulation_.ExecutesInSimulation(index)) continue;
    if (is_new) expanded_[stance_node.stance.assignment].push_back(index);
    const int last = grid_.StepOf(stance_node.reachable.end);
    reached_ = std::max(reached_, last);
    ++counts_.expanded;
    novelty_.Count(stance_node.stance.assignment, last);
    last_expanded_ = index;
    Expand(index);
  }
  return std::nullopt;
}

}  // namespace regrasp::gait
