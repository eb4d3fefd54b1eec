#pragma once

#include <vector>

#include "planner/plan/projection.h"
#include "render/frames/shaded_mesh.h"
#include "tests/fixtures/solids.h"

namespace regrasp::render {

/// Objects in metres that are built without files.
[[nodiscard]] object::Polyhedron MakeThinLBlock();  ///< 0.08 × 0.08 × 0.03 with legs of width 0.035
[[nodiscard]] object::Polyhedron
MakeHoledBlock();  ///< 0.08 × 0.06 × 0.03 with a square hole along z

/// Return the volume of a closed mesh; negative if it is oriented inwards.
[[nodiscard]] double Volume(const ShadedMesh& mesh);

/// Return a finger in contact with the object at its initial pose, with a force of 2 N at 8° to the
/// normal.
[[nodiscard]] plan::FingerState MakeFinger(int finger, plan::FingerRole role,
                                           const Eigen::Vector3d& contact,
                                           const Eigen::Vector3d& inward_normal);

/// Return the snapshots of a regrasp: initial grasp, switch (place 4, release 0), sliding step of
/// finger 2.
[[nodiscard]] std::vector<plan::Snapshot> MakeCubeSequence();
/// Return static grasps with fingers in the inner corner, and inside the hole.
[[nodiscard]] std::vector<plan::Snapshot> MakeLBlockSequence();
[[nodiscard]] std::vector<plan::Snapshot> MakeHoledBlockSequence();

}  // namespace regrasp::render
