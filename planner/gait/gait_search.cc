#include "planner/gait/gait_search.h"

#include <algorithm>
#include <array>

#include "planner/gait/move_path.h"

namespace regrasp::gait {
namespace {

constexpr int kFewestHolding = 3;
/// Of first rests: sets of contacts drawn for each set of fingers.
constexpr int kDrawnGrasps = 120;
/// Contacts tried for a finger at a place, those that it keeps longest first.
constexpr int kTriedContacts = 24;
/// Rests taken up from one place.
constexpr int kTakenUp = 6;
/// What the steps that single fingers could go on are worth, beside those that all go together.
constexpr double kSingleFinger = 0.3;
/// Steps that a rest is put back for each one that was expanded and ends where it ends.
constexpr double kPutBack = 0.1;

int CountHolding(const Holding& holding) {
  return static_cast<int>(std::ranges::count_if(holding, [](int point) { return point != kNone; }));
}

}  // namespace

GaitSearch::GaitSearch(const HandSetup& setup, const PoseTrack& track, const Parking& parking,
                       criteria::GraspMemory& memory, RandomStream& random)
    : setup_(setup),
      track_(track),
      parking_(parking),
      memory_(memory),
      random_(random),
      reach_(setup.scene, setup.inverse, setup.points, track),
      expanded_at_(track.steps() + 1, 0) {}

const std::vector<GaitSearch::Candidate>& GaitSearch::CandidatesAt(FingerIndex finger, int step) {
  const auto [found, is_new] = candidates_.try_emplace({finger, step});
  std::vector<Candidate>& candidates = found->second;
  if (!is_new) return candidates;
  for (int point = 0; point < static_cast<int>(setup_.points.size()); ++point) {
    if (reach_.Find(finger, point, step) == nullptr) continue;
    candidates.push_back({point, reach_.RunEnd(finger, point, step, 1)});
  }
  std::ranges::stable_sort(candidates, std::greater<>(), &Candidate::last);
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

Keyframe GaitSearch::FrameAt(const Holding& holding, int step) {
  Keyframe frame{track_.PoseAt(step), parking_};
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (holding[finger] == kNone) continue;
    frame.postures[finger] = *reach_.Find(finger, holding[finger], step);
  }
  return frame;
}

bool GaitSearch::FingersKeepApart(const Holding& holding, int step) {
  const Keyframe frame = FrameAt(holding, step);
  std::vector<PlacedFinger> placed;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    placed.push_back(setup_.scene.Place(finger, frame.postures[finger]));
    for (FingerIndex other{0}; other < finger; ++other) {
      if (!setup_.scene.KeepApart(placed[other], placed.back())) return false;
    }
  }
  return true;
}

/// How far along the track the grasp holds, from where it is taken.
bool GaitSearch::FindStretch(Rest& rest) {
  if (!FingersKeepApart(rest.holding, rest.step)) return false;
  const auto end_of = [&](int direction) {
    int end = direction > 0 ? track_.steps() : 0;
    for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
      if (rest.holding[finger] == kNone) continue;
      const int run = reach_.RunEnd(finger, rest.holding[finger], rest.step, direction);
      end = direction > 0 ? std::min(end, run) : std::max(end, run);
    }
    int reached = rest.step;
    while (reached != end && FingersKeepApart(rest.holding, reached + direction)) {
      reached += direction;
    }
    return reached;
  };
  rest.last = end_of(1);
  rest.first = end_of(-1);
  return true;
}

double GaitSearch::ScoreOf(const Rest& rest) {
  double sum = 0;
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (rest.holding[finger] == kNone) continue;
    sum += reach_.RunEnd(finger, rest.holding[finger], rest.step, 1);
  }
  return rest.last + kSingleFinger * sum / CountHolding(rest.holding);
}

bool GaitSearch::Add(Rest rest) {
  if (known_.contains({rest.holding, rest.step}) || !IsGrasp(rest.holding)) return false;
  known_.insert({rest.holding, rest.step});
  ++counts_.grasps;
  if (!FindStretch(rest)) {
    ++counts_.colliding;
    return false;
  }
  rest.score = ScoreOf(rest);
  queue_.push({rest.score, static_cast<int>(rests_.size())});
  rests_.push_back(std::move(rest));
  return true;
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
        const std::vector<Candidate>& candidates = CandidatesAt(finger, 0);
        if (candidates.empty()) break;
        // Those that it keeps longest stand first.
        const double place = random_.Uniform() * random_.Uniform();
        holding[finger] = candidates[static_cast<std::size_t>(place * candidates.size())].point;
      }
      if (CountHolding(holding) == kFewestHolding) Add({.holding = holding});
    }
  } while (std::ranges::prev_permutation(chosen).found);
}

void GaitSearch::SwitchAt(int index, int step) {
  const Holding holding = rests_[index].holding;
  std::vector<Rest> found;
  for (FingerIndex placed{0}; placed < setup_.scene.finger_count(); ++placed) {
    if (holding[placed] != kNone) continue;
    int tried = 0;
    for (const Candidate& candidate : CandidatesAt(placed, step)) {
      if (tried == kTriedContacts) break;
      if (std::ranges::find(holding, candidate.point) != holding.end()) continue;
      ++tried;
      for (FingerIndex released{0}; released < setup_.scene.finger_count(); ++released) {
        if (holding[released] == kNone) continue;
        Rest rest{.holding = holding, .step = step};
        rest.holding[placed] = candidate.point;
        rest.holding[released] = kNone;
        rest.parent = index;
        rest.placed = placed;
        rest.released = released;
        if (known_.contains({rest.holding, step}) || !IsGrasp(rest.holding)) continue;
        rest.last = track_.steps();
        for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
          if (rest.holding[finger] == kNone) continue;
          rest.last = std::min(rest.last, reach_.RunEnd(finger, rest.holding[finger], step, 1));
        }
        rest.score = ScoreOf(rest);
        found.push_back(std::move(rest));
      }
    }
  }
  std::ranges::stable_sort(found, std::greater<>(), &Rest::score);
  int taken = 0;
  for (Rest& rest : found) {
    if (taken == kTakenUp) break;
    // The way there passes a grasp of all fingers.
    Holding all = rest.holding;
    all[rest.released] = holding[rest.released];
    if (!FingersKeepApart(all, step)) continue;
    if (Add(std::move(rest))) ++taken;
  }
}

void GaitSearch::Expand(int index) {
  const Rest& rest = rests_[index];
  const int first = rest.first;
  const int last = rest.last;
  const int step = rest.step;
  std::set<int> places = {last, (step + last) / 2, std::max(first, last - 2), step};
  for (const int place : places) SwitchAt(index, place);
}

Surroundings GaitSearch::Around(const Keyframe& frame, FingerIndex moving) const {
  Surroundings around{frame.pose, {}};
  for (FingerIndex finger{0}; finger < setup_.scene.finger_count(); ++finger) {
    if (finger == moving) continue;
    around.others.push_back(setup_.scene.Place(finger, frame.postures[finger]));
  }
  return around;
}

bool GaitSearch::Place(Rest& rest, const Keyframe& before, Keyframe& after) {
  const int point = rest.holding[rest.placed];
  const Posture touching = *reach_.Find(rest.placed, point, rest.step);
  const auto path = FindPathToContact(
      setup_.scene, setup_.inverse[rest.placed], rest.placed, before.postures[rest.placed],
      TargetAt(setup_.scene.finger(rest.placed), setup_.points[point], before.pose), touching,
      Around(before, rest.placed), random_);
  if (!path) return false;
  Stretch stretch{Stretch::Kind::kPlace, rest.placed, point, {}};
  for (const Posture& posture : *path) {
    stretch.path.push_back(before);
    stretch.path.back().postures[rest.placed] = posture;
  }
  after = stretch.path.back();
  rest.way.push_back(std::move(stretch));
  return true;
}

bool GaitSearch::Release(const Rest& rest, const Keyframe& before, std::vector<Stretch>& way) {
  const int point = rests_[rest.parent].holding[rest.released];
  const auto path = FindPathToContact(
      setup_.scene, setup_.inverse[rest.released], rest.released, parking_[rest.released],
      TargetAt(setup_.scene.finger(rest.released), setup_.points[point], before.pose),
      before.postures[rest.released], Around(before, rest.released), random_);
  if (!path) return false;
  Stretch stretch{Stretch::Kind::kRelease, rest.released, point, {}};
  for (auto posture = path->rbegin(); posture != path->rend(); ++posture) {
    stretch.path.push_back(before);
    stretch.path.back().postures[rest.released] = *posture;
  }
  way.push_back(std::move(stretch));
  return true;
}

const std::vector<Keyframe>& GaitSearch::MoveFrom(Rest& rest, int step) {
  const auto [found, is_new] = rest.moves.try_emplace(step);
  if (!is_new) return found->second;
  // What lies beyond a step that can't be reached can't be reached either.
  const bool beyond = std::ranges::any_of(rest.moves, [&](const auto& move) {
    const bool between = (move.first - rest.step) * (step - move.first) > 0;
    return between && move.second.empty();
  });
  if (!beyond) {
    auto move = FindMove(setup_, track_, rest.holding, rest.at, rest.step, step);
    if (move) found->second = std::move(*move);
  }
  if (found->second.empty()) ++counts_.no_move;
  return found->second;
}

/// From the parent's rest along the track, then the switch.
bool GaitSearch::WorkOutWay(Rest& rest) {
  if (rest.parent < 0) {
    rest.at = FrameAt(rest.holding, rest.step);
    return true;
  }
  Rest& parent = rests_[rest.parent];
  Keyframe frame = parent.at;
  if (parent.step != rest.step) {
    const std::vector<Keyframe>& move = MoveFrom(parent, rest.step);
    if (move.empty()) return false;
    frame = move.back();
    rest.way.push_back({Stretch::Kind::kMove, {}, kNone, move});
  }
  Keyframe placed;
  if (!Place(rest, frame, placed) || !Release(rest, placed, rest.way)) {
    ++counts_.no_path;
    return false;
  }
  rest.at = rest.way.back().path.back();
  return true;
}

Gait GaitSearch::GaitTo(int index, std::vector<Keyframe> last_move) const {
  std::vector<int> chain;
  for (int i = index; i >= 0; i = rests_[i].parent) chain.push_back(i);
  std::ranges::reverse(chain);
  Gait gait{rests_[chain.front()].holding, rests_[chain.front()].at, {}};
  for (const int i : chain) {
    gait.stretches.insert(gait.stretches.end(), rests_[i].way.begin(), rests_[i].way.end());
  }
  if (last_move.size() > 1) {
    gait.stretches.push_back({Stretch::Kind::kMove, {}, kNone, std::move(last_move)});
  }
  return gait;
}

int GaitSearch::PopNext() {
  while (true) {
    const Waiting top = queue_.top();
    queue_.pop();
    const Rest& rest = rests_[top.rest];
    const double score = rest.score - kPutBack * expanded_at_[rest.last];
    if (queue_.empty() || score >= top.score || score >= queue_.top().score) return top.rest;
    queue_.push({score, top.rest});
  }
}

std::optional<Gait> GaitSearch::Run(int most_expanded, const Deadline& deadline) {
  if (!begun_) AddFirstRests();
  begun_ = true;
  while (!queue_.empty() && counts_.expanded < most_expanded) {
    if (deadline.IsOver()) return std::nullopt;
    const int index = PopNext();
    Rest& rest = rests_[index];
    if (!WorkOutWay(rest)) continue;
    if (rest.last == track_.steps()) {
      if (rest.step == rest.last) return GaitTo(index, {});
      const std::vector<Keyframe>& move = MoveFrom(rest, rest.last);
      if (!move.empty()) return GaitTo(index, move);
      --rest.last;
    }
    counts_.farthest = std::max(counts_.farthest, rest.last);
    ++counts_.expanded;
    ++expanded_at_[rest.last];
    Expand(index);
  }
  return std::nullopt;
}

}  // namespace regrasp::gait
