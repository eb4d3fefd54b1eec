#pragma once

#include <vector>

#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp {

// Bodies that the tests of plans grasp.

/// [−1, 1]³, moved by `offset` and scaled by `size` first.
Polyhedron MakeCube(double size = 1, const Eigen::Vector3d& offset = Eigen::Vector3d::Zero());

/// The prism over a counter-clockwise outline, z = 0 … 1.
Polyhedron MakePrism(const std::vector<Eigen::Vector2d>& outline);

/// The L with corners (0,0), (3,0), (3,1), (1,1), (1,3), (0,3), as high as z = 0 … 1.
Polyhedron MakeLBlock();

/// [−3, 3]² × [0, 1] with the hole [−1, 1]² through it along z.
Polyhedron MakeRing();

/// [−1, 1]³ with the sealed cavity [−0.5, 0.5]³.
Polyhedron MakeHollowCube();

/// [−1, 1]², its lower edge divided in two at (0, −1) where `divided`.
Polygon MakeSquare(bool divided = false);

}  // namespace regrasp
