#pragma once

#include <array>

#include "planner/sets/polyhedron/face_part.h"

namespace regrasp {

/// Return true if the set of focus points that see four parts of faces has an interior, by exact
/// linear programs of CGAL.
/// Each part is seen from a given side, through pyramids with eight sides inscribed in the friction
/// cones. The unknowns are the focus point, two coordinates of each contact, and a margin to all
/// sides of the pyramids. The function tests whether its maximum is positive.
///
/// @param halves   2 · part, or 2 · part + 1 for the outer side, as in a FocusPiece.
/// @param tangent  tangent of the friction angle.
[[nodiscard]] bool HasPieceByProgram(const polyhedron::FaceParts& parts,
                                     const std::array<int, 4>& halves, double tangent);

}  // namespace regrasp
