#pragma once

#include <vector>

#include "planner/grasp/contact.h"

namespace regrasp::sampling {

/// Thins contacts to `count` that are spread as evenly as blue noise, in their original order:
/// weighted sample elimination (Yuksel 2015, "Sample Elimination for Generating Poisson Disk Sample
/// Sets", equations 1–5, α = 8, β = 0.65, γ = 1.5). The contact that is most crowded goes first.
///
/// Two contacts whose normals differ by more than `kOppositeAngle` do not crowd each other: the two
/// sides of a thin plate are apart for a finger.
/// @param area  of the surface that the contacts cover.
/// @returns all contacts where there are no more than `count`.
[[nodiscard]] std::vector<grasp::Contact> EliminateSamples(
    const std::vector<grasp::Contact>& contacts, int count, double area);

/// Radians, 100°: more than the right angle between two faces of a block, whose points do crowd
/// each other across the edge.
inline constexpr double kOppositeAngle = 1.7453292519943295;

}  // namespace regrasp::sampling
