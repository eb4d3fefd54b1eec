#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"

namespace regrasp::sampling {

/// A contact at a given point (object/given_points.h): on one of the faces there, inside it by the
/// least distance that a finger keeps from borders (SurfaceSampler::kFromBorder), so that it has a
/// normal. Of the faces there the one whose normal is nearest to their mean is taken, of those that
/// take fingers and are not rough (Object::IsRough).
/// @returns nullopt  no such contact is within kAtGivenPoint · D of the point.
[[nodiscard]] std::optional<grasp::Contact> ContactAt(const object::Polyhedron& solid,
                                                      const Eigen::Vector3d& point);

/// Contacts at given points (Phoka 2010, chapter 6): `most` of them spread evenly over the surface,
/// all where there are no more; the same for the same seed.
/// @throws std::invalid_argument  most < 1.
/// @throws NoGrasp  fewer than `least` of the points take a contact.
[[nodiscard]] std::vector<grasp::Contact> GivenContacts(const object::Polyhedron& solid,
                                                        std::span<const Eigen::Vector3d> points,
                                                        int least, int most, std::uint64_t seed);

}  // namespace regrasp::sampling
