#include "planner/tree/improve_path.h"

#include <algorithm>

#include "planner/tree/least_travel.h"
#include "planner/tree/path_plan.h"
#include "planner/tree/subpath.h"
#include "planner/tree/subset_search.h"

namespace regrasp::tree {

namespace {

/// Passes over all stretches, each with other random contacts.
constexpr int kPasses = 3;

/// Passes in a row, each with other random contacts, that have not lessened the travel before it is
/// left at that.
constexpr int kIdlePasses = 4;

/// A way that is shorter by a smaller part of itself is not worth another pass.
constexpr double kLeastGain = 1e-3;

std::optional<GraspPath> SearchSubpath(const GraspPath& path, const Subpath& stretch,
                                       int most_steps, SearchSpace& space) {
  return SearchSubsets(GraspNumber(path, stretch.begin), GraspNumber(path, stretch.end),
                       stretch.contacts, UseAligns::kYes, most_steps, space);
}

bool ShortcutOnce(const sampling::SurfaceSampler& source, RandomStream& random, SearchSpace& space,
                  GraspPath& path) {
  for (int begin = 0; begin + 1 < static_cast<int>(path.steps.size()); ++begin) {
    Subpath stretch = LongestSubpath(path, begin);
    const int steps = stretch.end - stretch.begin;
    if (steps < 2) continue;
    FillUp(stretch, kSubpathContacts, source, random, space);
    if (const auto shorter = SearchSubpath(path, stretch, steps - 1, space)) {
      ReplaceSubpath(*shorter, stretch, path);
      return true;
    }
  }
  return false;
}

/// Lets stretches that cover the path be replaced, each overlapping the one before by half.
template <typename Replace>
void ForEachSubpath(GraspPath& path, const Replace& replace) {
  for (int begin = 0; begin < static_cast<int>(path.steps.size());) {
    const Subpath stretch = LongestSubpath(path, begin);
    if (stretch.end == begin) return;
    const bool last = stretch.end == static_cast<int>(path.steps.size());
    begin += std::max(1, (stretch.end - begin) / 2);
    replace(stretch);
    if (last) return;
  }
}

void MaximiseMarginOn(Subpath stretch, int more_steps, const sampling::SurfaceSampler& source,
                      RandomStream& random, SearchSpace& space, GraspPath& path) {
  const GraspPath part = PartOf(path, stretch);
  const double least =
      std::max(space.RequiredHalfAngle(part.start), space.RequiredHalfAngle(part.end()));
  FillUp(stretch, kSubpathContacts, source, random, space);
  const auto wider = SearchWidest(part.start, part.end(), stretch.contacts, UseAligns::kYes,
                                  static_cast<int>(part.steps.size()) + more_steps, least, space);
  // Aligns of the part may have been refused to the search, being more than it takes on.
  if (!wider || RequiredHalfAngleOf(*wider, space) > RequiredHalfAngleOf(part, space)) return;
  ReplaceSubpath(*wider, stretch, path);
}

/// @returns whether anything was gained.
bool MinimiseTravelOn(Subpath stretch, int more_steps, const sampling::SurfaceSampler& source,
                      RandomStream& random, SearchSpace& space, GraspPath& path) {
  const GraspPath part = PartOf(path, stretch);
  FillAround(stretch, kSubpathContacts, source, random, space);
  const auto shorter = SearchLeastTravel(part.start, part.end(), stretch.contacts,
                                         static_cast<int>(part.steps.size()) + more_steps,
                                         (1 - kLeastGain) * TravelOf(part, space), space);
  if (shorter) ReplaceSubpath(*shorter, stretch, path);
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
    ForEachSubpath(path, [&](const Subpath& stretch) {
      const int more = most_steps - static_cast<int>(path.steps.size());
      MaximiseMarginOn(stretch, more, source, random, space, path);
    });
  }
  return path;
}

GraspPath MinimiseTravel(GraspPath path, const sampling::SurfaceSampler& source,
                         RandomStream& random, SearchSpace& space) {
  const auto most_steps = static_cast<int>(path.steps.size());
  for (int idle = 0; idle < kIdlePasses; ++idle) {
    ForEachSubpath(path, [&](const Subpath& stretch) {
      const int more = most_steps - static_cast<int>(path.steps.size());
      if (MinimiseTravelOn(stretch, more, source, random, space, path)) idle = -1;
    });
  }
  return path;
}

double RequiredHalfAngleOf(const GraspPath& path, SearchSpace& space) {
  double required = space.RequiredHalfAngle(path.start);
  for (const PathStep& step : path.steps) {
    required = std::max(required, space.RequiredHalfAngle(step.to));
  }
  return required;
}

}  // namespace regrasp::tree
