#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/face_align.h"

namespace regrasp::tree {

/// Part of a path that may be replaced, given by grasp numbers; the path's start has number 0.
struct Subpath {
  int begin;
  int end;
  std::vector<int> contacts;  ///< contacts of all these grasps
};

/// Default limit on the number of contacts of a subpath.
inline constexpr int kSubpathContacts = 14;

[[nodiscard]] const criteria::ContactSet& GraspNumber(const GraspPath& path, int number);

[[nodiscard]] Subpath SubpathBetween(const GraspPath& path, int begin, int end);

/// Return the longest subpath from `begin` with at most kSubpathContacts contacts.
[[nodiscard]] Subpath LongestSubpath(const GraspPath& path, int begin);

/// Return the part of a path that a subpath denotes.
[[nodiscard]] GraspPath PartOf(const GraspPath& path, const Subpath& subpath);

/// Add random contacts of the whole surface until there are `most`.
void FillUp(Subpath& subpath, int most, const sampling::SurfaceSampler& source,
            RandomStream& random, SearchSpace& space);

/// Add random contacts near those of the subpath until there are `most`.
/// Distances range from half the diameter to a sixty-fourth. Adds fewer if contacts are not valid.
void FillAround(Subpath& subpath, int most, const sampling::SurfaceSampler& source,
                RandomStream& random, SearchSpace& space);

/// Replace a part of a path by another path between its ends.
void ReplaceSubpath(const GraspPath& by, const Subpath& subpath, GraspPath& path);

/// Return the same path with contact numbers of another space.
[[nodiscard]] GraspPath Renumber(const GraspPath& path, const SearchSpace& from, SearchSpace& to);

/// Shorten a path by shortcuts (Geraerts and Overmars 2007); the result is never longer.
/// Replaces subpaths by paths of fewer steps, over the contacts of the subpath and some random
/// ones, by finger switches and sliding steps, as long as one is found.
[[nodiscard]] GraspPath ShortcutPath(GraspPath path, const sampling::SurfaceSampler& source,
                                     RandomStream& random, SearchSpace& space);

/// Increase the friction margin of a path.
/// Replaces subpaths by the widest paths (SearchWidest) over their contacts and some random ones,
/// so that its weakest grasps and sliding steps require less friction. A subpath cannot become
/// better than its two ends.
/// @param more_steps  largest number of additional steps.
[[nodiscard]] GraspPath MaximiseMargin(GraspPath path, int more_steps,
                                       const sampling::SurfaceSampler& source, RandomStream& random,
                                       SearchSpace& space);
/// Number of additional steps that is worthwhile if the friction margin has priority over the
/// number of steps.
inline constexpr int kMoreSteps = 2;

/// Reduce the total travel of all fingers (TravelOf) without more steps.
/// Replaces subpaths by those of the least travel (SearchLeastTravel) over their contacts and some
/// random ones near those, as long as that reduces the travel.
[[nodiscard]] GraspPath MinimiseTravel(GraspPath path, const sampling::SurfaceSampler& source,
                                       RandomStream& random, SearchSpace& space);

/// Return the largest required friction angle of the path's static grasps, ends included, radians.
[[nodiscard]] double RequiredFrictionAngleOf(const GraspPath& path, SearchSpace& space);

/// Find a path over a few contacts with the least travel (TravelOf, path_plan.h).
/// Dijkstra's search (1959) over finger switches and sliding steps. A subset is tested when it is
/// expanded, and the sliding steps of a path are proved when it is found.
/// @param contacts    contacts of the grasps, ends included, at most kMostSubsetContacts.
/// @param most_steps  largest number of steps.
/// @param bound       travel that the path must be shorter than.
/// @returns the path; nullopt if there is none.
[[nodiscard]] std::optional<GraspPath> SearchLeastTravel(const criteria::ContactSet& from,
                                                         const criteria::ContactSet& to,
                                                         const std::vector<int>& contacts,
                                                         int most_steps, double bound,
                                                         SearchSpace& space);

/// Improve a path's weakest grasps, up to the criteria of the space.
///
/// A few steps around the weakest grasp are replaced by a path over their contacts and random ones
/// near them, whose grasps are all slightly better. This repeats until all grasps except the ends
/// meet the criteria, or until attempts fail.
///
/// @param path  force-closure grasps, with or without the criteria.
/// @returns the share of the criteria that all grasps of the result meet.
double RepairQuality(const sampling::SurfaceSampler& source, RandomStream& random,
                     SearchSpace& space, GraspPath& path);

}  // namespace regrasp::tree
