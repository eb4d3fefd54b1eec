#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// A part of a path that may be replaced: from one of its grasps to a later one, by their numbers,
/// the path's start being number 0.
struct Subpath {
  int begin;
  int end;
  std::vector<int> contacts;  ///< of all these grasps
};

/// Where nothing else is said a subpath has at most so many contacts.
inline constexpr int kSubpathContacts = 14;

[[nodiscard]] const criteria::ContactSet& GraspNumber(const GraspPath& path, int number);

[[nodiscard]] Subpath SubpathBetween(const GraspPath& path, int begin, int end);

/// The longest subpath from `begin` on that has no more than kSubpathContacts contacts.
[[nodiscard]] Subpath LongestSubpath(const GraspPath& path, int begin);

/// The part of a path that a subpath is.
[[nodiscard]] GraspPath PartOf(const GraspPath& path, const Subpath& subpath);

/// Adds random contacts of the whole surface until there are `most`.
void FillUp(Subpath& subpath, int most, const sampling::SurfaceSampler& source,
            RandomStream& random, SearchSpace& space);

/// Adds random contacts near those of the subpath, from half the diameter away to a sixty-fourth,
/// until there are `most`; fewer where contacts are not valid.
void FillAround(Subpath& subpath, int most, const sampling::SurfaceSampler& source,
                RandomStream& random, SearchSpace& space);

/// Replaces a part of a path by another path between its ends.
void ReplaceSubpath(const GraspPath& by, const Subpath& subpath, GraspPath& path);

/// The same path with its contacts numbered by another space.
[[nodiscard]] GraspPath Renumber(const GraspPath& path, const SearchSpace& from, SearchSpace& to);

/// Shortens a path: subpaths of it are replaced by paths of fewer steps, over the contacts of the
/// subpath and some random ones, by switches and aligns, as long as one is found (shortcuts,
/// Geraerts and Overmars 2007). Never longer.
[[nodiscard]] GraspPath ShortcutPath(GraspPath path, const sampling::SurfaceSampler& source,
                                     RandomStream& random, SearchSpace& space);

/// Widens a path, with at most `more_steps` steps more: its weakest grasps and aligns come to need
/// less friction. Subpaths of it are replaced by the widest paths (SearchWidest) over their
/// contacts and some random ones. A subpath can't become better than its two ends.
[[nodiscard]] GraspPath MaximiseMargin(GraspPath path, int more_steps,
                                       const sampling::SurfaceSampler& source, RandomStream& random,
                                       SearchSpace& space);
/// So many are worth while where the margin counts more than the number of steps.
inline constexpr int kMoreSteps = 2;

/// Lessens the travel of all fingers together (TravelOf), with no more steps than before: subpaths
/// of the path are replaced by those of the least travel (SearchLeastTravel) over their contacts
/// and some random ones near those, as long as that gains anything.
[[nodiscard]] GraspPath MinimiseTravel(GraspPath path, const sampling::SurfaceSampler& source,
                                       RandomStream& random, SearchSpace& space);

/// The largest required half-angle of the path's grasps at rest, the ends included, radians.
[[nodiscard]] double RequiredHalfAngleOf(const GraspPath& path, SearchSpace& space);

/// Joins two grasps over grasps of a few contacts, by switches and aligns, with the least travel
/// (TravelOf, path_plan.h): Dijkstra's search (1959), in which a subset is tested when its turn
/// comes and the aligns of a path are proved when it is found.
/// @param contacts    those of the ends included, at most kMostSubsetContacts.
/// @param most_steps  no path has more.
/// @param bound       no path is looked for that is not shorter than this.
/// @returns nullopt where there is no such path.
[[nodiscard]] std::optional<GraspPath> SearchLeastTravel(const criteria::ContactSet& from,
                                                         const criteria::ContactSet& to,
                                                         const std::vector<int>& contacts,
                                                         int most_steps, double bound,
                                                         SearchSpace& space);

/// Raises a path's weakest grasps, up to the criteria of the space.
///
/// The surroundings of the weakest grasp, a few steps before and behind, are replaced by a path
/// over their contacts and random ones near them whose grasps are all a bit better; this again and
/// again, until all grasps but the ends meet the criteria, or nothing is gained any more.
///
/// @param path  of force-closure grasps, good or not.
/// @returns the share of the criteria that all of these grasps meet then.
double RepairQuality(const sampling::SurfaceSampler& source, RandomStream& random,
                     SearchSpace& space, GraspPath& path);

}  // namespace regrasp::tree
