#pragma once

#include <array>

#include "planner/sets/polyhedron/face_part.h"

namespace regrasp {

/// Whether the focus points that see four parts of faces, each from a given side, through pyramids
/// of eight sides inscribed in the friction cones, have an interior: by CGAL's exact linear
/// programs.
///
/// Unknown are the focus point, two coordinates of each contact, and a margin that all pyramids'
/// sides keep; its largest value is positive or not.
///
/// @param halves   2 · part, or 2 · part + 1 for the outer side, as a FocusPiece has them.
/// @param tangent  of the friction half-angle.
[[nodiscard]] bool HasPieceByProgram(const polyhedron::FaceParts& parts,
                                     const std::array<int, 4>& halves, double tangent);

}  // namespace regrasp
