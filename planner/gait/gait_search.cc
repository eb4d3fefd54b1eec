#include "planner/gait/gait_search.h"

#include <algorithm>
#include <array>

#include "planner/gait/move_path.h"
#include "planner/gait/slide_path.h"

namespace regrasp::gait {
namespace {

constexpr int kFewestHolding = 3;
/// Of first rests: sets of contacts drawn for each set of fingers.
constexpr int kDrawnGrasps = 120;
/// Contacts tried for a finger at a place, those that it keeps longest first.
constexpr int kTriedContacts = 24;
/// Of all contacts one in so many is looked at from one place, if that is enough.
constexpr int kShares = 4;
/// Rests taken up from one place.
constexpr int kTakenUp = 8;
/// With the same fingers placed, released or sliding.
constexpr int kTakenUpOfAKind = 2;
/// Steps that a rest is put back for each one like it that was expanded.
constexpr double kPutBackAlike = 0.5;
/// How far a finger slides at once, metres.
constexpr double kLongestSlide = 0.015;
constexpr double kLongestSlideToGoal = 0.06;
/// What the steps that single fingers could go on are worth, beside those that all go together.
constexpr double kSingleFinger = 0.3;
/// What a unit beside the track costs, in steps.
constexpr double kOffTrack = 0.1;
/// What a finger costs that does not hold what it is to hold in the end, in steps.
constexpr double kNotYetGoal = 3;
/// What a slide costs on the way, in steps: a finger that slides holds less well than one that
/// rests.
constexpr double kSlide = 2;
/// Steps that a rest is put back for each one that was expanded and ends where it ends.
constexpr double kPutBack = 0.1;
/// Steps that it is put back for each turn that it had.
constexpr double kAnotherTurn = 2;
/// Nodes from which a hold is carried on in vain.
constexpr int kPatience = 40;
/// Of the nodes that a grasp comes to: those drawn to switch fingers at, beside those of its path.
constexpr int kNodesBeside = 2;

}  // namespace

GaitSearch::GaitSearch(const HandSetup& setup, const PoseGrid& grid, Carrier& carrier,
                       const GaitEnds& ends, criteria::GraspMemory& memory, RandomStream& random)
    : setup_(setup),
      grid_(grid),
      start_(ends.start),
      goal_(ends.goal, setup.points),
      most_holding_(static_cast<int>(std::max(
          {static_cast<std::size_t>(kFewestHolding), ends.start.size(), ends.goal.size()}))),
      memory_(memory),
      random_(random),
      carrier_(carrier),
      routes_(memory),
      kinds_(setup.points),
      rolling_(setup, memory),
      paths_(setup, memory, carrier, routes_, random),
      expanded_at_(grid.steps() + 1, 0) {
  counts_.steps = grid.steps();
  if (ends.goal.empty()) return;
  ForEachAssignment(ends.goal, setup.scene.finger_count(), [&](Holding holding) {
    Hold hold{std::move(holding)};
    if (carrier_.LetFreeFingersWait(hold, grid.goal(), &random))
      goal_.AddWay(std::move(hold.holding));
  });
}

const std::vector<GaitSearch::Candidate>& GaitSearch::CandidatesAt(FingerIndex finger, int node) {
  const auto [found, is_new] = candidates_.try_emplace({finger, node});
  std::vector<Candidate>& candidates = found->second;
  if (!is_new) return candidates;
  const auto look_at = [&](int point, bool is_goal) {
    if (carrier_.reach().Find(finger, point, node) == nullptr) return;
    candidates.push_back({point, is_goal, carrier_.reach().RunEnd(finger, point, node)});
  };
  const std::set<int> goals = goal_.ContactsOf(finger);
  for (const int point : goals) look_at(point, true);
  // At each node some of the contacts, at others others; more where few are within reach.
  const int count = static_cast<int>(setup_.points.size());
  for (int share = 0; share < kShares && candidates.size() < kTriedContacts; ++share) {
    for (int point = (node + share) % kShares; point < count; point += kShares) {
      if (!goals.contains(point)) look_at(point, false);
    }
  }
  std::ranges::stable_sort(candidates, std::greater<>(), [](const Candidate& candidate) {
    return std::pair(candidate.is_goal, candidate.last);
  });
  return candidates;
}

bool GaitSearch::IsGrasp(const Holding& holding) {
  criteria::ContactSet set;
  for (const int point : holding) {
    if (point == kNone) continue;
    if (set.Has(point)) return false;
    set.Insert(point);
  }
  return set.size() >= kFewestHolding && memory_.Admits(set);
}

GaitSearch::RolledTo GaitSearch::RollTowards(const Rest& rest, int node) {
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

bool GaitSearch::TakeRolledTips(Rest& rest) {
  if (setup_.rolled_on == nullptr) return true;
  rest.rolled = rest.rolled_before;
  rest.rolled.resize(rest.hold.holding.size());
  for (FingerIndex finger{0}; finger < std::ssize(rest.rolled); ++finger) {
    const int point = rest.hold.holding[finger];
    if (point == kNone) {
      rest.rolled[finger].reset();
    } else if (!rest.rolled[finger]) {
      rest.rolled[finger] = {setup_.points[point],
                             *carrier_.reach().Find(finger, point, rest.node)};
    }
  }
  if (rolling_.AreGrasp(rest.rolled)) return true;
  ++counts_.rolled;
  return false;
}

double GaitSearch::ScoreOf(const Rest& rest, int last) {
  double sum = 0;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (rest.hold.holding[finger] == kNone) continue;
    sum += carrier_.reach().RunEnd(finger, rest.hold.holding[finger], rest.node);
  }
  return last + kSingleFinger * sum / CountHolding(rest.hold.holding) -
         kOffTrack * grid_.OffTrack(rest.node) -
         kNotYetGoal * goal_.DistanceFrom(rest.hold.holding) -
         (grid_.steps() > 0 ? kSlide * rest.slides : 0);
}

bool GaitSearch::Add(Rest rest) {
  if (!IsGrasp(rest.hold.holding)) return false;
  std::vector<int>& taken = taken_[rest.hold.holding];
  if (std::ranges::find(taken, rest.node) != taken.end()) return false;
  taken.push_back(rest.node);
  ++counts_.grasps;
  if (!carrier_.LetFreeFingersWait(rest.hold, rest.node)) {
    ++counts_.colliding;
    return false;
  }
  if (!TakeRolledTips(rest)) return false;
  rest.carried = carrier_.StraightOn(rest.hold, rest.node);
  rest.score = ScoreOf(rest, grid_.StepOf(rest.carried.end));
  queue_.push({rest.score, static_cast<int>(rests_.size())});
  rests_.push_back(std::move(rest));
  return true;
}

void GaitSearch::AddGivenStart() {
  ForEachAssignment(start_, setup_.scene.finger_count(), [&](Holding holding) {
    Hold hold{std::move(holding)};
    if (carrier_.LetFreeFingersWait(hold, grid_.start(), &random_)) {
      Add({.hold = std::move(hold), .node = grid_.start()});
    } else {
      ++counts_.colliding;
    }
  });
}

void GaitSearch::AddFirstRests() {
  const int fingers = setup_.scene.finger_count();
  std::vector<int> chosen(fingers, 0);
  std::fill(chosen.begin(), chosen.begin() + kFewestHolding, 1);
  do {
    for (int i = 0; i < kDrawnGrasps; ++i) {
      Holding holding(fingers, kNone);
      for (FingerIndex finger{0}; finger < fingers; ++finger) {
        if (chosen[finger] == 0) continue;
        const std::vector<Candidate>& candidates = CandidatesAt(finger, grid_.start());
        if (candidates.empty()) break;
        // Those that it keeps longest stand first.
        const double place = random_.Uniform() * random_.Uniform();
        holding[finger] = candidates[static_cast<std::size_t>(place * candidates.size())].point;
      }
      if (CountHolding(holding) == kFewestHolding) {
        Add({.hold = {std::move(holding)}, .node = grid_.start()});
      }
    }
  } while (std::ranges::prev_permutation(chosen).found);
}

void GaitSearch::AddSwitches(const Holding& from, FingerIndex placed, int point,
                             std::vector<Change>& changes) const {
  if (placed.valid()) changes.push_back({.placed = placed, .point = point});
  for (FingerIndex released{0}; released < std::ssize(from); ++released) {
    if (from[released] == kNone) continue;
    changes.push_back({.placed = placed, .released = released, .point = point});
  }
}

bool GaitSearch::MaySlide(int from, int to) {
  return setup_.rolled_on == nullptr && routes_.Between(from, to) != nullptr;
}

std::vector<Change> GaitSearch::ChangesFrom(const Holding& from, int node) {
  std::vector<Change> changes;
  if (most_holding_ > kFewestHolding) AddSwitches(from, {}, kNone, changes);
  for (FingerIndex finger{0}; finger < std::ssize(from); ++finger) {
    const int at = from[finger];
    int tried = 0;
    for (const auto& [point, is_goal, last] : CandidatesAt(finger, node)) {
      if (Holds(from, point)) continue;
      if (at == kNone) {
        if (++tried > kTriedContacts) break;
        AddSwitches(from, finger, point, changes);
        continue;
      }
      const double way = (setup_.points[at].p - setup_.points[point].p).norm();
      if (way > (is_goal ? kLongestSlideToGoal : kLongestSlide)) continue;
      if (!MaySlide(at, point)) continue;
      changes.push_back({.slid = finger, .point = point});
    }
  }
  const Holding* target = goal_.NearestTo(from);
  for (FingerIndex finger{0}; target != nullptr && finger < std::ssize(from); ++finger) {
    const int point = (*target)[finger];
    if (point == kNone || Holds(from, point)) continue;
    if (carrier_.reach().Find(finger, point, node) == nullptr) continue;
    if (from[finger] == kNone) {
      AddSwitches(from, finger, point, changes);
    } else if (MaySlide(from[finger], point)) {
      changes.push_back({.slid = finger, .point = point});
    }
  }
  return changes;
}

std::optional<GaitSearch::Rest> GaitSearch::After(const Rest& from, const Change& change,
                                                  int node) {
  Rest rest{.hold = from.hold,
            .node = node,
            .slides = from.slides + static_cast<int>(change.slid.valid()),
            .change = change};
  Holding& holding = rest.hold.holding;
  if (change.slid.valid()) holding[change.slid] = change.point;
  if (change.placed.valid()) {
    holding[change.placed] = change.point;
    rest.hold.waiting[change.placed] = {};
  }
  if (change.released.valid()) holding[change.released] = kNone;
  const int count = CountHolding(holding);
  if (count < kFewestHolding || count > most_holding_ || !IsGrasp(holding)) return std::nullopt;
  int last = grid_.steps();
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (holding[finger] == kNone) continue;
    last = std::min(last, carrier_.reach().RunEnd(finger, holding[finger], node));
  }
  rest.score = ScoreOf(rest, last);
  return rest;
}

void GaitSearch::SwitchAt(int index, int node) {
  const Rest from = rests_[index];
  const RolledTo rolled = RollTowards(from, node);
  if (rolled.node != node) return;
  std::vector<Rest> found;
  for (const Change& change : ChangesFrom(from.hold.holding, node)) {
    if (auto rest = After(from, change, node)) found.push_back(*std::move(rest));
  }
  std::ranges::stable_sort(found, std::greater<>(), &Rest::score);
  int taken = 0;
  std::map<std::array<int, 3>, int> taken_by_fingers;
  for (Rest& rest : found) {
    if (taken == kTakenUp) break;
    const Change& change = rest.change;
    int& alike = taken_by_fingers[{change.placed, change.slid, change.released}];
    if (alike == kTakenUpOfAKind) continue;
    // A switch passes a grasp of all fingers.
    Hold all = rest.hold;
    if (change.released.valid()) all.holding[change.released] = from.hold.holding[change.released];
    if (change.placed.valid() && !carrier_.IsPassable(all, rest.node)) continue;
    rest.parent = index;
    rest.rolled_before = rolled.tips;
    if (!Add(std::move(rest))) continue;
    ++taken;
    ++alike;
  }
}

void GaitSearch::Expand(int index) {
  const Rest& rest = rests_[index];
  const std::vector<int> path = rest.carried.PathTo(rest.carried.end);
  const std::size_t last = path.size() - 1;
  std::set<int> nodes = {path[last], path[last / 2], path[last - std::min<std::size_t>(last, 2)],
                         path[0]};
  std::erase_if(nodes, [&](int node) { return rest.switched_at.contains(node); });
  // Where the object has nowhere to go it stays while there is something else to do.
  const int beside = grid_.steps() == 0 && rest.turns == 0 ? 0 : kNodesBeside;
  for (int i = 0; i < beside; ++i) {
    nodes.insert(std::next(rest.carried.from.begin(),
                           static_cast<int>(random_.Index(rest.carried.from.size())))
                     ->first);
  }
  for (const int node : nodes) {
    if (rests_[index].switched_at.insert(node).second) SwitchAt(index, node);
  }
  // Somewhere else it may be worth another turn.
  Rest& again = rests_[index];
  ++again.turns;
  if (again.switched_at.size() < again.carried.from.size()) {
    queue_.push({again.score - kAnotherTurn * again.turns, index});
  }
}

const std::vector<Keyframe>& GaitSearch::MoveFrom(Rest& rest, int node) {
  const auto [found, is_new] = rest.moves.try_emplace(node);
  if (!is_new) return found->second;
  const std::vector<int> path = rest.carried.PathTo(node);
  // What lies beyond a node that can't be reached can't be reached either.
  const bool beyond = std::ranges::any_of(path.begin() + 1, path.end() - 1, [&](int between) {
    const auto move = rest.moves.find(between);
    return move != rest.moves.end() && move->second.empty();
  });
  if (!beyond) {
    std::vector<Eigen::Isometry3d> poses;
    for (std::size_t i = 1; i + 1 < path.size(); ++i) poses.push_back(grid_.PoseAt(path[i]));
    auto move =
        FindMove(setup_, rest.hold.holding, rest.at, poses, carrier_.FrameAt(rest.hold, node));
    if (move) found->second = std::move(*move);
  }
  if (found->second.empty()) ++counts_.no_move;
  return found->second;
}

/// The switch to this rest, from where its parent brought the object.
bool GaitSearch::WorkOutWay(Rest& rest) {
  rest.at = carrier_.FrameAt(rest.hold, rest.node);
  if (rest.parent < 0) return true;
  auto way = paths_.Find(rest.change, rests_[rest.parent].hold, rest.hold, rest.node,
                         {rest.rolled_before, rest.rolled});
  if (!way) {
    ++(rest.change.slid.valid() ? counts_.no_slide : counts_.no_path);
    return false;
  }
  rest.way = *std::move(way);
  rest.at = rest.way.back().path.back();
  return true;
}

bool GaitSearch::IsCutOff(const Rest& rest) const {
  return rest.is_cut_off || (rest.parent >= 0 && IsCutOff(rests_[rest.parent]));
}

std::optional<Gait> GaitSearch::WayTo(int index, int node) {
  std::vector<int> chain;
  for (int i = index; i >= 0; i = rests_[i].parent) chain.push_back(i);
  std::ranges::reverse(chain);
  Gait gait{rests_[chain.front()].hold.holding, rests_[chain.front()].at, {}};
  const auto move_to = [&](Rest& rest, int to) {
    if (rest.node == to) return true;
    const std::vector<Keyframe>& move = MoveFrom(rest, to);
    if (!move.empty()) gait.stretches.push_back({Stretch::Kind::kMove, {}, kNone, move});
    return !move.empty();
  };
  for (const int i : chain) {
    Rest& rest = rests_[i];
    if (rest.parent >= 0 && !move_to(rests_[rest.parent], rest.node)) {
      rest.is_cut_off = true;
      return std::nullopt;
    }
    gait.stretches.insert(gait.stretches.end(), rest.way.begin(), rest.way.end());
  }
  if (!move_to(rests_[index], node)) return std::nullopt;
  return gait;
}

/// The whole gait, where a rest's path leads to the goal and is free.
std::optional<Gait> GaitSearch::GaitFrom(int index) {
  Carried& carried = rests_[index].carried;
  if (!grid_.IsGoal(carried.end) || !goal_.IsHeldBy(rests_[index].hold.holding)) {
    return std::nullopt;
  }
  std::optional<Gait> gait = WayTo(index, carried.end);
  if (!gait) carried.end = carried.from.at(carried.end);
  return gait;
}

void GaitSearch::AddTarget(const Holding& holding) {
  if (targets_.insert(kinds_.KindOf(holding)).second) goal_.AddTarget(holding);
}

int GaitSearch::PopNext() {
  while (true) {
    const Waiting top = queue_.top();
    queue_.pop();
    const Rest& rest = rests_[top.rest];
    const double score = rest.score - kAnotherTurn * rest.turns -
                         kPutBack * expanded_at_[grid_.StepOf(rest.carried.end)] -
                         kPutBackAlike * expanded_like_[kinds_.KindOf(rest.hold.holding)];
    if (queue_.empty() || score >= top.score || score >= queue_.top().score) return top.rest;
    queue_.push({score, top.rest});
  }
}

/// Whether the same grasp was expanded that passes the rest's node.
bool GaitSearch::WasExpandedAt(const Rest& rest) const {
  const auto found = passed_.find(rest.hold.holding);
  return found != passed_.end() &&
         std::ranges::find(found->second, rest.node) != found->second.end();
}

std::optional<Gait> GaitSearch::Run(std::int64_t most_expanded, const Deadline& deadline) {
  if (!begun_) start_.empty() ? AddFirstRests() : AddGivenStart();
  begun_ = true;
  while (!queue_.empty() && counts_.expanded < most_expanded) {
    if (deadline.IsOver()) return std::nullopt;
    const int index = PopNext();
    Rest& rest = rests_[index];
    if (IsCutOff(rest)) {
      std::erase(taken_[rest.hold.holding], rest.node);
      continue;
    }
    if (rest.turns == 0 && (WasExpandedAt(rest) || !WorkOutWay(rest))) continue;
    rest.carried = carrier_.Around(
        rest.hold, rest.node, kPatience * (1 + rest.turns),
        [&](int node) { return grid_.IsGoal(node) && goal_.IsHeldBy(rest.hold.holding); });
    rest.carried.end = RollTowards(rest, rest.carried.end).node;
    if (std::optional<Gait> gait = GaitFrom(index)) return gait;
    std::vector<int>& passed = passed_[rest.hold.holding];
    for (const auto& [node, from] : rest.carried.from) passed.push_back(node);
    const int last = grid_.StepOf(rest.carried.end);
    counts_.farthest = std::max(counts_.farthest, last);
    ++counts_.expanded;
    ++expanded_at_[last];
    ++expanded_like_[kinds_.KindOf(rest.hold.holding)];
    last_expanded_ = index;
    Expand(index);
  }
  return std::nullopt;
}

}  // namespace regrasp::gait
