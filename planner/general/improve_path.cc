#include "planner/general/improve_path.h"

#include <algorithm>

#include "planner/general/least_travel.h"
#include "planner/general/path_plan.h"
#include "planner/general/stretch.h"
#include "planner/general/subset_search.h"

namespace regrasp {

namespace {

/// Passes over all stretches, each with other random contacts.
constexpr int kPasses = 3;

/// Passes in a row, each with other random contacts, that have not lessened the travel before it is
/// left at that.
constexpr int kIdlePasses = 4;

/// A way that is shorter by a smaller part of itself is not worth another pass.
constexpr double kLeastGain = 1e-3;

std::optional<GraspPath> SearchStretch(const GraspPath& path, const Stretch& stretch,
                                       int most_steps, SearchSpace& space) {
  return SearchSubsets(GraspNumber(path, stretch.begin), GraspNumber(path, stretch.end),
                       stretch.contacts, UseAligns::kYes, most_steps, space);
}

bool ShortenOnce(const SurfaceSource& source, RandomStream& random, SearchSpace& space,
                 GraspPath& path) {
  for (int begin = 0; begin + 1 < static_cast<int>(path.steps.size()); ++begin) {
    Stretch stretch = LongestStretch(path, begin);
    const int steps = stretch.end - stretch.begin;
    if (steps < 2) continue;
    FillUp(stretch, kStretchContacts, source, random, space);
    if (const auto shorter = SearchStretch(path, stretch, steps - 1, space)) {
      Splice(*shorter, stretch, path);
      return true;
    }
  }
  return false;
}

/// Lets stretches that cover the path be replaced, each overlapping the one before by half.
template <typename Replace>
void ForEachStretch(GraspPath& path, const Replace& replace) {
  for (int begin = 0; begin < static_cast<int>(path.steps.size());) {
    const Stretch stretch = LongestStretch(path, begin);
    if (stretch.end == begin) return;
    const bool last = stretch.end == static_cast<int>(path.steps.size());
    begin += std::max(1, (stretch.end - begin) / 2);
    replace(stretch);
    if (last) return;
  }
}

void WidenStretch(Stretch stretch, int more_steps, const SurfaceSource& source,
                  RandomStream& random, SearchSpace& space, GraspPath& path) {
  const GraspPath part = PartOf(path, stretch);
  const double least =
      std::max(space.RequiredHalfAngle(part.start), space.RequiredHalfAngle(part.end()));
  FillUp(stretch, kStretchContacts, source, random, space);
  const auto wider = SearchWidest(part.start, part.end(), stretch.contacts, UseAligns::kYes,
                                  static_cast<int>(part.steps.size()) + more_steps, least, space);
  // Aligns of the part may have been refused to the search, being more than it takes on.
  if (!wider || RequiredHalfAngleOf(*wider, space) > RequiredHalfAngleOf(part, space)) return;
  Splice(*wider, stretch, path);
}

/// @returns whether anything was gained.
bool ShortenWay(Stretch stretch, int more_steps, const SurfaceSource& source, RandomStream& random,
                SearchSpace& space, GraspPath& path) {
  const GraspPath part = PartOf(path, stretch);
  FillAround(stretch, kStretchContacts, source, random, space);
  const auto shorter = SearchLeastTravel(part.start, part.end(), stretch.contacts,
                                         static_cast<int>(part.steps.size()) + more_steps,
                                         (1 - kLeastGain) * TravelOf(part, space), space);
  if (shorter) Splice(*shorter, stretch, path);
  return shorter.has_value();
}

}  // namespace

GraspPath Renumber(const GraspPath& path, const SearchSpace& from, SearchSpace& to) {
  const auto convert = [&](const ContactSet& set) {
    ContactSet converted;
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

GraspPath ShortenPath(GraspPath path, const SurfaceSource& source, RandomStream& random,
                      SearchSpace& space) {
  while (ShortenOnce(source, random, space, path)) {
  }
  return path;
}

GraspPath WidenPath(GraspPath path, int more_steps, const SurfaceSource& source,
                    RandomStream& random, SearchSpace& space) {
  const int most_steps = static_cast<int>(path.steps.size()) + more_steps;
  for (int pass = 0; pass < kPasses; ++pass) {
    ForEachStretch(path, [&](const Stretch& stretch) {
      const int more = most_steps - static_cast<int>(path.steps.size());
      WidenStretch(stretch, more, source, random, space, path);
    });
  }
  return path;
}

GraspPath LessenTravel(GraspPath path, const SurfaceSource& source, RandomStream& random,
                       SearchSpace& space) {
  const auto most_steps = static_cast<int>(path.steps.size());
  for (int idle = 0; idle < kIdlePasses; ++idle) {
    ForEachStretch(path, [&](const Stretch& stretch) {
      const int more = most_steps - static_cast<int>(path.steps.size());
      if (ShortenWay(stretch, more, source, random, space, path)) idle = -1;
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

}  // namespace regrasp
