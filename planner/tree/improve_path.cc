#include "planner/tree/improve_path.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <queue>

#include "planner/tree/subset_search.h"
#include "planner/tree/tree_planner.h"

namespace regrasp::tree {

namespace {

/// Number of halvings of the distance at which contacts are drawn, from half the diameter.
constexpr int kHalvings = 5;

/// Number of draws per missing contact.
constexpr int kDraws = 8;

void AddContact(int contact, std::vector<int>& contacts) {
  if (std::find(contacts.begin(), contacts.end(), contact) == contacts.end()) {
    contacts.push_back(contact);
  }
}

void AddContacts(const criteria::ContactSet& set, std::vector<int>& contacts) {
  for (const int contact : set) AddContact(contact, contacts);
}

}  // namespace

const criteria::ContactSet& GraspNumber(const GraspPath& path, int number) {
  return number == 0 ? path.start : path.steps[number - 1].to;
}

Subpath SubpathBetween(const GraspPath& path, int begin, int end) {
  Subpath subpath{begin, end, {}};
  for (int number = begin; number <= end; ++number) {
    AddContacts(GraspNumber(path, number), subpath.contacts);
  }
  return subpath;
}

Subpath LongestSubpath(const GraspPath& path, int begin) {
  Subpath subpath{begin, begin, {}};
  for (int end = begin; end <= static_cast<int>(path.steps.size()); ++end) {
    std::vector<int> contacts = subpath.contacts;
    AddContacts(GraspNumber(path, end), contacts);
    if (static_cast<int>(contacts.size()) > kSubpathContacts) break;
    subpath.contacts = std::move(contacts);
    subpath.end = end;
  }
  return subpath;
}

GraspPath PartOf(const GraspPath& path, const Subpath& subpath) {
  const auto first = path.steps.begin();
  return {GraspNumber(path, subpath.begin), {first + subpath.begin, first + subpath.end}};
}

void FillUp(Subpath& subpath, int most, const sampling::SurfaceSampler& source,
            RandomStream& random, SearchSpace& space) {
  while (static_cast<int>(subpath.contacts.size()) < most && space.has_capacity()) {
    AddContact(space.Add(source.Draw(random)), subpath.contacts);
  }
}

void FillAround(Subpath& subpath, int most, const sampling::SurfaceSampler& source,
                RandomStream& random, SearchSpace& space) {
  const auto own = static_cast<int>(subpath.contacts.size());
  for (int draw = 0; draw < kDraws * (most - own); ++draw) {
    if (static_cast<int>(subpath.contacts.size()) == most || !space.has_capacity()) return;
    const grasp::Contact& near = space.contact(subpath.contacts[random.Index(own)]);
    const int halvings = static_cast<int>(random.Index(kHalvings + 1));
    const double reach = space.object().diameter() * std::ldexp(0.5, -halvings);
    const grasp::Contact contact = source.DrawAround(near, reach, random);
    if (source.IsValid(contact)) AddContact(space.Add(contact), subpath.contacts);
  }
}

void ReplaceSubpath(const GraspPath& by, const Subpath& subpath, GraspPath& path) {
  const auto first = path.steps.begin();
  const auto place = path.steps.erase(first + subpath.begin, first + subpath.end);
  path.steps.insert(place, by.steps.begin(), by.steps.end());
}

namespace {

/// Number of passes over all subpaths, each with new random contacts.
constexpr int kPasses = 3;

/// Number of consecutive passes without less travel, each with new random contacts, after which the
/// search stops.
constexpr int kIdlePasses = 4;

/// Relative reduction below which another pass is not worthwhile.
constexpr double kLeastGain = 1e-3;

std::optional<GraspPath> SearchSubpath(const GraspPath& path, const Subpath& subpath,
                                       int most_steps, SearchSpace& space) {
  return SearchSubsets(GraspNumber(path, subpath.begin), GraspNumber(path, subpath.end),
                       subpath.contacts, UseAligns::kYes, most_steps, space);
}

bool ShortcutOnce(const sampling::SurfaceSampler& source, RandomStream& random, SearchSpace& space,
                  GraspPath& path) {
  for (int begin = 0; begin + 1 < static_cast<int>(path.steps.size()); ++begin) {
    Subpath subpath = LongestSubpath(path, begin);
    const int steps = subpath.end - subpath.begin;
    if (steps < 2) continue;
    FillUp(subpath, kSubpathContacts, source, random, space);
    if (const auto shorter = SearchSubpath(path, subpath, steps - 1, space)) {
      ReplaceSubpath(*shorter, subpath, path);
      return true;
    }
  }
  return false;
}

/// Call `replace` for subpaths that cover the path; each overlaps the previous one by half.
template <typename Replace>
void ForEachSubpath(GraspPath& path, const Replace& replace) {
  for (int begin = 0; begin < static_cast<int>(path.steps.size());) {
    const Subpath subpath = LongestSubpath(path, begin);
    if (subpath.end == begin) return;
    const bool last = subpath.end == static_cast<int>(path.steps.size());
    begin += std::max(1, (subpath.end - begin) / 2);
    replace(subpath);
    if (last) return;
  }
}

void MaximiseMarginOn(Subpath subpath, int more_steps, const sampling::SurfaceSampler& source,
                      RandomStream& random, SearchSpace& space, GraspPath& path) {
  const GraspPath part = PartOf(path, subpath);
  const double least =
      std::max(space.RequiredFrictionAngle(part.start), space.RequiredFrictionAngle(part.end()));
  FillUp(subpath, kSubpathContacts, source, random, space);
  const auto wider = SearchWidest(part.start, part.end(), subpath.contacts, UseAligns::kYes,
                                  static_cast<int>(part.steps.size()) + more_steps, least, space);
  // The search may have refused sliding steps of the part because of its limits.
  if (!wider || RequiredFrictionAngleOf(*wider, space) > RequiredFrictionAngleOf(part, space))
    return;
  ReplaceSubpath(*wider, subpath, path);
}

/// Replace a subpath by one with less travel.
/// @returns whether the travel decreased.
bool MinimiseTravelOn(Subpath subpath, int more_steps, const sampling::SurfaceSampler& source,
                      RandomStream& random, SearchSpace& space, GraspPath& path) {
  const GraspPath part = PartOf(path, subpath);
  FillAround(subpath, kSubpathContacts, source, random, space);
  const auto shorter = SearchLeastTravel(part.start, part.end(), subpath.contacts,
                                         static_cast<int>(part.steps.size()) + more_steps,
                                         (1 - kLeastGain) * TravelOf(part, space), space);
  if (shorter) ReplaceSubpath(*shorter, subpath, path);
  return shorter.has_value();
}

}  // namespace

GraspPath Renumber(const GraspPath& path, const SearchSpace& from, SearchSpace& to) {
  const auto convert = [&](const criteria::ContactSet& set) {
    criteria::ContactSet converted;
    for (const int contact : set) converted.Insert(to.Add(from.contact(contact)));
    return converted;
  };
  GraspPath renumbered{convert(path.start), {}};
  for (const PathStep& step : path.steps) {
    PathStep& added = renumbered.steps.emplace_back(PathStep{convert(step.to), step.align});
    if (!added.align) continue;
    for (auto& [a, b] : added.align->contacts) {
      a = to.Add(from.contact(a));
      b = to.Add(from.contact(b));
    }
  }
  return renumbered;
}

GraspPath ShortcutPath(GraspPath path, const sampling::SurfaceSampler& source, RandomStream& random,
                       SearchSpace& space) {
  while (ShortcutOnce(source, random, space, path)) {
  }
  return path;
}

GraspPath MaximiseMargin(GraspPath path, int more_steps, const sampling::SurfaceSampler& source,
                         RandomStream& random, SearchSpace& space) {
  const int most_steps = static_cast<int>(path.steps.size()) + more_steps;
  for (int pass = 0; pass < kPasses; ++pass) {
    ForEachSubpath(path, [&](const Subpath& subpath) {
      const int more = most_steps - static_cast<int>(path.steps.size());
      MaximiseMarginOn(subpath, more, source, random, space, path);
    });
  }
  return path;
}

GraspPath MinimiseTravel(GraspPath path, const sampling::SurfaceSampler& source,
                         RandomStream& random, SearchSpace& space) {
  const auto most_steps = static_cast<int>(path.steps.size());
  for (int idle = 0; idle < kIdlePasses; ++idle) {
    ForEachSubpath(path, [&](const Subpath& subpath) {
      const int more = most_steps - static_cast<int>(path.steps.size());
      if (MinimiseTravelOn(subpath, more, source, random, space, path)) idle = -1;
    });
  }
  return path;
}

double RequiredFrictionAngleOf(const GraspPath& path, SearchSpace& space) {
  double required = space.RequiredFrictionAngle(path.start);
  for (const PathStep& step : path.steps) {
    required = std::max(required, space.RequiredFrictionAngle(step.to));
  }
  return required;
}

namespace {

using Mask = SubsetGraph::Mask;

class TravelSearch {
 public:
  TravelSearch(const criteria::ContactSet& from, const criteria::ContactSet& to,
               const std::vector<int>& contacts, int most_steps, double bound, SearchSpace& space)
      : graph_(from, to, contacts, UseAligns::kYes, space),
        space_(space),
        most_steps_(most_steps),
        bound_(bound),
        distances_(contacts.size(), std::vector<double>(contacts.size())) {
    for (int a = 0; a < graph_.contact_count(); ++a) {
      for (int b = 0; b < graph_.contact_count(); ++b) distances_[a][b] = graph_.Distance(a, b);
    }
  }

  std::optional<GraspPath> Search() {
    for (;;) {
      FindLastTravels();
      const std::vector<Mask> masks = Find();
      if (masks.empty()) return std::nullopt;
      auto path = graph_.MakePath(masks);
      if (!path) continue;
      // Over an edge a sliding step's path is longer than the straight one.
      if (TravelOf(*path, space_) < bound_) return path;
      return std::nullopt;
    }
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  /// Path to a grasp, given by its last step.
  struct Label {
    double travel;
    int steps;
    Mask mask;
    int parent;  ///< index in `settled_`; -1 for the start
    bool operator<(const Label& other) const {
      if (travel != other.travel) return travel > other.travel;
      if (steps != other.steps) return steps > other.steps;
      return mask > other.mask;
    }
  };

  void FindLastTravels() {
    last_travel_.assign(graph_.mask_count(), kNone);
    const auto any = [](Mask /*mask*/, double /*travel*/ = 0) { return true; };
    graph_.ForEachSwitch(graph_.to(), any, [&](Mask mask) {
      last_travel_[mask] = TravelOfSwitch(mask, graph_.to());
    });
    graph_.ForEachAlign(graph_.to(), any, [&](Mask mask, double travel) {
      last_travel_[mask] = std::min(last_travel_[mask], travel);
    });
  }

  /// Return the grasps of the path; empty if there is none.
  std::vector<Mask> Find() {
    fewest_.assign(graph_.mask_count(), std::numeric_limits<int>::max());
    settled_.clear();
    queue_ = {};
    queue_.push({0, 0, graph_.from(), -1});
    while (!queue_.empty() && !space_.IsSpent()) {
      const Label label = queue_.top();
      queue_.pop();
      // Labels settled earlier have travelled less.
      if (fewest_[label.mask] <= label.steps || !graph_.Admits(label.mask)) continue;
      fewest_[label.mask] = label.steps;
      settled_.push_back(label);
      if (label.mask == graph_.to()) return PathToLast();
      Expand(label, static_cast<int>(settled_.size()) - 1);
    }
    return {};
  }

  void Expand(const Label& label, int number) {
    const int steps = label.steps + 1;
    const auto push = [&](Mask next, double travel) {
      if (label.travel + travel < bound_) queue_.push({label.travel + travel, steps, next, number});
    };
    if (last_travel_[label.mask] < kNone) push(graph_.to(), last_travel_[label.mask]);
    if (steps >= most_steps_) return;
    const auto matters = [&](Mask next, double travel = 0) {
      return fewest_[next] > steps && label.travel + travel < bound_ &&
             (steps + 1 < most_steps_ || last_travel_[next] < kNone);
    };
    graph_.ForEachSwitch(label.mask, matters,
                         [&](Mask next) { push(next, TravelOfSwitch(label.mask, next)); });
    graph_.ForEachAlign(label.mask, matters, push);
  }

  /// Return the travel as TravelOf does.
  [[nodiscard]] double TravelOfSwitch(Mask from, Mask to) const {
    const Mask left = from & ~to;
    if (left == 0) return 0;
    double travel = 0;
    for (Mask placed = to & ~from; placed != 0; placed &= placed - 1) {
      const std::vector<double>& to_others = distances_[std::countr_zero(placed)];
      double nearest = std::numeric_limits<double>::infinity();
      for (Mask rest = left; rest != 0; rest &= rest - 1) {
        nearest = std::min(nearest, to_others[std::countr_zero(rest)]);
      }
      travel += nearest;
    }
    return travel;
  }

  [[nodiscard]] std::vector<Mask> PathToLast() const {
    std::vector<Mask> path;
    for (int at = static_cast<int>(settled_.size()) - 1; at >= 0; at = settled_[at].parent) {
      path.push_back(settled_[at].mask);
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  SubsetGraph graph_;
  SearchSpace& space_;
  int most_steps_;
  double bound_;
  std::vector<std::vector<double>> distances_;
  std::vector<double>
      last_travel_;          ///< travel of one step to the goal [mask]; kNone if there is none
  std::vector<int> fewest_;  ///< number of steps of the paths settled so far [mask]
  std::vector<Label> settled_;
  std::priority_queue<Label> queue_;
};

}  // namespace

std::optional<GraspPath> SearchLeastTravel(const criteria::ContactSet& from,
                                           const criteria::ContactSet& to,
                                           const std::vector<int>& contacts, int most_steps,
                                           double bound, SearchSpace& space) {
  return TravelSearch(from, to, contacts, most_steps, bound, space).Search();
}

namespace {

/// Number of levels between no criteria and all criteria.
constexpr int kLevels = 8;

/// Number of consecutive failed attempts after which the repair stops.
constexpr int kMostFailures = 30;

/// Largest number of steps before and after the weakest grasp that are replaced.
constexpr int kMostAround = 3;

/// Largest number of additional steps of a replacement.
constexpr int kMoreRepairSteps = 1;

class QualityRepair {
 public:
  QualityRepair(const sampling::SurfaceSampler& source, RandomStream& random, SearchSpace& space,
                GraspPath& path)
      : source_(source), random_(random), space_(space), path_(path) {}

  double Run() {
    int failures = 0;
    while (failures < kMostFailures && !space_.IsSpent()) {
      const auto [weakest, level] = Weakest();
      if (weakest < 0) break;
      failures = Raise(weakest, level + 1) ? 0 : failures + 1;
    }
    const double reached = ShareOf(Weakest().second);
    space_.SetShare(1);
    return reached;
  }

 private:
  [[nodiscard]] static double ShareOf(int level) { return static_cast<double>(level) / kLevels; }

  /// Return the level of a step.
  /// It is the level of the grasp that the step reaches, unless that is the path's end, and of its
  /// sliding step.
  int LevelOf(const PathStep& step) {
    const bool is_end = &step == &path_.steps.back();
    int level = kLevels;
    for (; level > 0; --level) {
      space_.SetShare(ShareOf(level));
      if ((is_end || space_.Admits(step.to)) && (!step.align || AdmitsPath(*step.align, space_))) {
        break;
      }
    }
    return level;
  }

  /// Return the number, from 1, of the first step of the lowest level, and that level.
  /// The number is -1 if all steps meet the criteria.
  std::pair<int, int> Weakest() {
    std::pair<int, int> weakest = {-1, kLevels};
    for (int number = 1; number <= static_cast<int>(path_.steps.size()); ++number) {
      const int level = LevelOf(path_.steps[number - 1]);
      if (level < weakest.second) weakest = {number, level};
    }
    return weakest;
  }

  bool Raise(int weakest, int level) {
    const int around = 1 + static_cast<int>(random_.Index(kMostAround));
    const int end = std::min(weakest + around, static_cast<int>(path_.steps.size()));
    Subpath subpath = SubpathBetween(path_, std::max(weakest - around, 0), end);
    if (static_cast<int>(subpath.contacts.size()) >= kMostSubsetContacts) return false;
    FillAround(subpath, kMostSubsetContacts, source_, random_, space_);
    space_.SetShare(ShareOf(level));
    const auto better = SearchSubsets(
        GraspNumber(path_, subpath.begin), GraspNumber(path_, subpath.end), subpath.contacts,
        UseAligns::kYes, subpath.end - subpath.begin + kMoreRepairSteps, space_);
    if (!better) return false;
    ReplaceSubpath(*better, subpath, path_);
    return true;
  }

  const sampling::SurfaceSampler& source_;
  RandomStream& random_;
  SearchSpace& space_;
  GraspPath& path_;
};

}  // namespace

double RepairQuality(const sampling::SurfaceSampler& source, RandomStream& random,
                     SearchSpace& space, GraspPath& path) {
  return QualityRepair(source, random, space, path).Run();
}

}  // namespace regrasp::tree
