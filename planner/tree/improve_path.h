#pragma once

#include "planner/base/random.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

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

}  // namespace regrasp::tree
