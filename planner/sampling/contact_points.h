#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"

namespace regrasp::sampling {

/// Thin contacts to `count` that are spread like blue noise, in their original order.
/// Weighted sample elimination (Yuksel 2015, "Sample Elimination for Generating Poisson Disk Sample
/// Sets", equations 1–5, α = 8, β = 0.65, γ = 1.5): the contact in the densest neighbourhood is
/// removed first.
///
/// Contacts whose normals differ by more than `kOppositeAngle` do not affect each other, because
/// for a finger the two sides of a thin plate are far apart.
/// @param area  area of the surface that the contacts cover.
/// @returns all contacts if there are at most `count`.
[[nodiscard]] std::vector<grasp::Contact> EliminateSamples(
    const std::vector<grasp::Contact>& contacts, int count, double area);

/// Angle of normals beyond which contacts do not affect each other: 100°, in radians. It exceeds
/// the right angle of a block's edge, across which contacts affect each other.
inline constexpr double kOppositeAngle = 1.7453292519943295;

/// Return `count` contact points of a roadmap, spread evenly over the surface. Equal seeds give
/// equal points.
///
/// `kCandidatesPerPoint` candidates per point are drawn uniformly by area. If the mesh is fine, the
/// candidates are centroids of triangles drawn by area. A mesh is fine if no triangle is larger
/// than a quarter of the area per point. Candidates near the border of their face are removed to
/// give a fingertip clearance. The clearance is the smaller one of `kBorderMargin` diameters and
/// `kBorderFraction` of the largest border distance of the face's candidates. EliminateSamples
/// thins the remaining candidates.
///
/// The result has fewer points if the surface is too small for that many different candidates.
/// @throws std::invalid_argument  if count < 1.
[[nodiscard]] std::vector<grasp::Contact> SpreadContactPoints(const object::Polyhedron& solid,
                                                              int count, std::uint64_t seed);

/// Return the contact points of a triangle mesh (Phoka 2010, section 6.2).
/// They are the centroids of its triangles with the inward normals of their faces, in triangle
/// order.
///
/// This applies to a mesh of at most `most` triangles and at least `most / kFewFaces` faces. For
/// any other mesh, SpreadContactPoints returns `most` points. The reasons are that a mesh with more
/// triangles has too many centroids, and that the centroids of a polyhedron with few faces, such as
/// a cube, depend on its triangulation.
///
/// Laws: centroids move and scale with the solid and do not depend on the seed. The relative
/// distances of spread points do not depend on the unit of length.
/// @throws std::invalid_argument  if most < 1.
[[nodiscard]] std::vector<grasp::Contact> MeshContacts(const object::Polyhedron& solid, int most,
                                                       std::uint64_t seed);

/// Number of contact points per face beyond which a solid has few planar faces.
inline constexpr int kFewFaces = 4;
/// Number of candidates per contact point. Yuksel (2015) recommends at least five.
inline constexpr int kCandidatesPerPoint = 20;
/// Border clearance over the diameter: 2 mm for an object of 10 cm. It is below a fingertip's
/// radius, so that faces keep most of their area.
inline constexpr double kBorderMargin = 0.02;
/// Border clearance relative to a face's inner radius, so that small faces keep their central area.
inline constexpr double kBorderFraction = 0.3;

/// Return the contact at a point of a point file (object/read_object.h).
/// The contact is on a face at the point. It has the smallest allowed distance from the face's
/// border (SurfaceSampler::kFromBorder), so that its normal is defined. Among the faces at the
/// point that accept fingers and are not rough there (Object::IsRough), it is on the one with the
/// normal nearest to their mean.
/// @returns nullopt if no such contact is within kAtGivenPoint · D of the point.
[[nodiscard]] std::optional<grasp::Contact> ContactAt(const object::Polyhedron& solid,
                                                      const Eigen::Vector3d& point);

/// Return contacts at given points (Phoka 2010, chapter 6).
/// At most `most` contacts are returned, spread evenly over the surface. Equal seeds give equal
/// contacts.
/// @throws std::invalid_argument  if most < 1.
/// @throws NoGrasp  if fewer than `least` points accept a contact.
[[nodiscard]] std::vector<grasp::Contact> GivenContacts(const object::Polyhedron& solid,
                                                        std::span<const Eigen::Vector3d> points,
                                                        int least, int most, std::uint64_t seed);

}  // namespace regrasp::sampling
