#pragma once

#include "planner/base/random.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

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
