#include "planner/tree/improve_path.h"

#include <algorithm>

#include "planner/tree/least_travel.h"
#include "planner/tree/path_plan.h"
#include "planner/tree/subpath.h"
#include "planner/tree/subset_search.h"

namespace regrasp::tree {

namespace {

/// Passes over all subpaths, each with other random contacts.
constexpr int kPasses = 3;

/// Passes in a row, each with other random contacts, that have not lessened the travel before it is
/// left at that.
constexpr int kIdlePasses = 4;

/// A path that is shorter by a smaller part of itself is not worth another pass.
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

/// Lets subpaths that cover the path be replaced, each overlapping the one before by half.
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
      std::max(space.RequiredHalfAngle(part.start), space.RequiredHalfAngle(part.end()));
  FillUp(subpath, kSubpathContacts, source, random, space);
  const auto wider = SearchWidest(part.start, part.end(), subpath.contacts, UseAligns::kYes,
                                  static_cast<int>(part.steps.size()) + more_steps, least, space);
  // Aligns of the part may have been refused to the search, being more than it takes on.
  if (!wider || RequiredHalfAngleOf(*wider, space) > RequiredHalfAngleOf(part, space)) return;
  ReplaceSubpath(*wider, subpath, path);
}

/// @returns whether anything was gained.
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

double RequiredHalfAngleOf(const GraspPath& path, SearchSpace& space) {
  double required = space.RequiredHalfAngle(path.start);
  for (const PathStep& step : path.steps) {
    required = std::max(required, space.RequiredHalfAngle(step.to));
  }
  return required;
}

}  // namespace regrasp::tree
