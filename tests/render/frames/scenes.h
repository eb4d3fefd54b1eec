#pragma once

#include <vector>

#include "planner/plan/snapshot.h"
#include "render/frames/facet_mesh.h"
#include "tests/fixtures/solids.h"

namespace regrasp::render {

/// Bodies in metres, built without files.
[[nodiscard]] object::Polyhedron MakeThinLBlock();  ///< 0.08 × 0.08 × 0.03, legs 0.035 wide
[[nodiscard]] object::Polyhedron
MakeHoledBlock();  ///< 0.08 × 0.06 × 0.03 with a square hole along z

/// Of a closed mesh; negative where it is inside out.
[[nodiscard]] double Volume(const FacetMesh& mesh);

/// A finger at rest on a body in its first pose, pressing with 2 N at 8° to the normal.
[[nodiscard]] plan::FingerState MakeFinger(int finger, plan::FingerRole role,
                                           const Eigen::Vector3d& contact,
                                           const Eigen::Vector3d& inward_normal);

/// Frames of a regrasp: hold, switch (place 4, release 0), align of finger 2.
[[nodiscard]] std::vector<plan::Snapshot> MakeCubeSequence();
/// Holds with fingers in the inner corner, and inside the hole.
[[nodiscard]] std::vector<plan::Snapshot> MakeLBlockSequence();
[[nodiscard]] std::vector<plan::Snapshot> MakeHoledBlockSequence();

}  // namespace regrasp::render
