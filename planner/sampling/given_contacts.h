#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"

namespace regrasp::sampling {

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
