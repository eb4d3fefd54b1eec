#pragma once

#include "planner/base/random.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/tree/grasp_path.h"
#include "planner/tree/search_space.h"

namespace regrasp::tree {

/// Raises the quality of a path's weakest grasps, up to the one that the space asks for.
///
/// The surroundings of the weakest grasp, a few steps before and behind, are replaced by a way over
/// their contacts and random ones near them whose grasps are all a bit better; this again and
/// again, until all grasps but the ends have the quality, or nothing is gained any more.
///
/// @param path  of force-closure grasps, good or not.
/// @returns the quality that all of these grasps have then, at most the one that is asked for.
double RepairQuality(const sampling::SurfaceSampler& source, RandomStream& random,
                     SearchSpace& space, GraspPath& path);

}  // namespace regrasp::tree
