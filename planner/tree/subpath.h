#pragma once

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

}  // namespace regrasp::tree
