#pragma once

#include <cstdint>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"

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

/// Contact points of a roadmap: `count` of them spread evenly over the surface, the same for the
/// same seed.
///
/// Candidates, `kCandidatesPerPoint` a point, are drawn evenly by area. Where the mesh is fine
/// enough, no triangle larger than a quarter of the area that a point has for itself, they are
/// the centroids of triangles drawn so. Candidates near the border of their face are left out, so
/// that a fingertip has clearance: nearer than `kBorderMargin` diameters, or `kBorderFraction` of
/// the largest distance from the border that any candidate of the face has, whichever is less. The
/// rest is thinned by EliminateSamples.
///
/// Fewer points come back where the surface is too small for that many different candidates.
/// @throws std::invalid_argument  count < 1.
[[nodiscard]] std::vector<grasp::Contact> SpreadContactPoints(const object::Polyhedron& solid,
                                                              int count, std::uint64_t seed);

/// Contact points of a triangle mesh (Phoka 2010, section 6.2): the centroids of its triangles,
/// with the inward normals of their faces, in the order of the triangles.
///
/// That holds for a mesh of at most `most` triangles and at least `most / kFewFaces` faces.
/// Elsewhere the points are those of SpreadContactPoints, `most` of them on the surface as it is: a
/// mesh of more triangles has too many centroids; on a body of few faces (a cube has six) they
/// would be no choice of places, and depend on how its flat faces happen to be cut.
///
/// Laws: moving and scaling the solid moves and scales the centroids, and they do not depend on the
/// seed; points that are spread are as far apart whatever the unit of length.
/// @throws std::invalid_argument  most < 1.
[[nodiscard]] std::vector<grasp::Contact> MeshContacts(const object::Polyhedron& solid, int most,
                                                       std::uint64_t seed);

/// A solid with fewer than a quarter as many faces as contact points are asked for counts as a body
/// of flat faces.
inline constexpr int kFewFaces = 4;
/// Yuksel (2015) recommends five or more.
inline constexpr int kCandidatesPerPoint = 20;
/// 2 mm on a 10 cm body: less than a fingertip's radius, so that faces keep most of their area.
inline constexpr double kBorderMargin = 0.02;
/// Small faces keep at least the middle of their area.
inline constexpr double kBorderFraction = 0.3;

}  // namespace regrasp::sampling
