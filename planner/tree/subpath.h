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

/// Where nothing else is said a stretch has at most so many contacts.
inline constexpr int kSubpathContacts = 14;

[[nodiscard]] const criteria::ContactSet& GraspNumber(const GraspPath& path, int number);

[[nodiscard]] Subpath SubpathBetween(const GraspPath& path, int begin, int end);

/// The longest stretch from `begin` on that has no more than kSubpathContacts contacts.
[[nodiscard]] Subpath LongestSubpath(const GraspPath& path, int begin);

/// The part of a path that a stretch is.
[[nodiscard]] GraspPath PartOf(const GraspPath& path, const Subpath& stretch);

/// Adds random contacts of the whole surface until there are `most`.
void FillUp(Subpath& stretch, int most, const sampling::SurfaceSampler& source,
            RandomStream& random, SearchSpace& space);

/// Adds random contacts near those of the stretch, from half the diameter away to a sixty-fourth,
/// until there are `most`; fewer where contacts are not valid.
void FillAround(Subpath& stretch, int most, const sampling::SurfaceSampler& source,
                RandomStream& random, SearchSpace& space);

/// Replaces a stretch of a path by another way between its ends.
void ReplaceSubpath(const GraspPath& by, const Subpath& stretch, GraspPath& path);

}  // namespace regrasp::tree
