#include "planner/general/improve_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/general/subset_search.h"
#include "planner/grasp/required_half_angle.h"

namespace regrasp {

namespace {

/// A stretch has at most so many contacts of its own; random ones fill it up to this.
constexpr int kStretchContacts = 14;

/// Passes over all stretches.
constexpr int kPasses = 2;

/// Of required half-angles that are only compared, radians.
constexpr double kAngleAccuracy = 1e-5;

double RequiredOf(const ContactSet& set, const SearchSpace& space) {
  const auto required =
      ComputeRequiredHalfAngle(space.GraspOf(set), space.object().wrench_frame(), kAngleAccuracy);
  return required ? required->upper : std::numbers::pi / 2;
}

/// Grasps `begin` to `end` of a path, its start being number 0.
struct Stretch {
  int begin;
  int end;
  std::vector<int> contacts;  ///< of all these grasps
};

const ContactSet& GraspNumber(const GraspPath& path, int number) {
  return number == 0 ? path.start : path.steps[number - 1].to;
}

/// The longest stretch from `begin` on that has no more than kStretchContacts contacts.
Stretch LongestStretch(const GraspPath& path, int begin) {
  Stretch stretch{begin, begin, {}};
  for (int end = begin; end <= static_cast<int>(path.steps.size()); ++end) {
    std::vector<int> contacts = stretch.contacts;
    for (const int contact : GraspNumber(path, end)) {
      if (std::find(contacts.begin(), contacts.end(), contact) == contacts.end()) {
        contacts.push_back(contact);
      }
    }
    if (static_cast<int>(contacts.size()) > kStretchContacts) break;
    stretch.contacts = std::move(contacts);
    stretch.end = end;
  }
  return stretch;
}

void FillUp(Stretch& stretch, const SurfaceSource& source, RandomStream& random,
            SearchSpace& space) {
  while (static_cast<int>(stretch.contacts.size()) < kStretchContacts && space.has_room()) {
    const int drawn = space.Add(source.Draw(random));
    if (std::find(stretch.contacts.begin(), stretch.contacts.end(), drawn) ==
        stretch.contacts.end()) {
      stretch.contacts.push_back(drawn);
    }
  }
}

void Splice(const GraspPath& by, const Stretch& stretch, GraspPath& path) {
  const auto first = path.steps.begin();
  const auto place = path.steps.erase(first + stretch.begin, first + stretch.end);
  path.steps.insert(place, by.steps.begin(), by.steps.end());
}

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
    FillUp(stretch, source, random, space);
    if (const auto shorter = SearchStretch(path, stretch, steps - 1, space)) {
      Splice(*shorter, stretch, path);
      return true;
    }
  }
  return false;
}

void WidenStretch(Stretch stretch, int more_steps, const SurfaceSource& source,
                  RandomStream& random, SearchSpace& space, GraspPath& path) {
  const ContactSet& from = GraspNumber(path, stretch.begin);
  const ContactSet& to = GraspNumber(path, stretch.end);
  const double least = std::max(RequiredOf(from, space), RequiredOf(to, space));
  FillUp(stretch, source, random, space);
  const int steps = stretch.end - stretch.begin + more_steps;
  if (const auto wider =
          SearchWidest(from, to, stretch.contacts, UseAligns::kYes, steps, least, space)) {
    Splice(*wider, stretch, path);
  }
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
  for (int pass = 0; pass < kPasses; ++pass) {
    for (int begin = 0; begin < static_cast<int>(path.steps.size());) {
      const Stretch stretch = LongestStretch(path, begin);
      if (stretch.end == begin) break;
      const bool last = stretch.end == static_cast<int>(path.steps.size());
      const int middle = begin + std::max(1, (stretch.end - begin) / 2);
      WidenStretch(stretch, more_steps, source, random, space, path);
      if (begin == 0 && last) return path;
      if (last) break;
      begin = middle;
    }
  }
  return path;
}

double RequiredHalfAngleOf(const GraspPath& path, const SearchSpace& space) {
  double required = RequiredOf(path.start, space);
  for (const PathStep& step : path.steps) required = std::max(required, RequiredOf(step.to, space));
  return required;
}

}  // namespace regrasp
