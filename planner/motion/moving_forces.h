#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/container/small_vector.hpp>
#include <span>

#include "planner/grasp/unit_contacts.h"

namespace regrasp::motion {

/// Contact on a straight segment of its path, with the cone of its forces throughout the segment.
/// The frame is centred on the grasp, which has about radius 1 in it at both ends.
struct MovingContact {
  Eigen::Vector3d start;
  Eigen::Vector3d end;
  /// Difference end − start, times any factor common to all contacts. On short pieces the
  /// difference of rounded points would lose the digits that determine which torques are redundant.
  Eigen::Vector3d velocity;
  Eigen::Vector3d n;
  /// Rim of the cone: axial · n + tangential · t, of unit length.
  double axial;
  double tangential;
  double torsion = 0;  ///< grasp::Contact::torsion in the frame's unit
};

struct MovingContacts : boost::container::small_vector<MovingContact, grasp::kInlineContacts> {
  // Boost's iterators are not contiguous iterators, so std::span does not accept the container
  // itself.
  operator std::span<const MovingContact>() const { return {data(), size()}; }  // NOLINT
};

/// Bernstein coefficients f_0 … f_d of the force of one contact, f(t) = Σ_k B_k(t) f_k.
template <int kDegree>
using ForceCoefficients = std::array<Eigen::Vector3d, kDegree + 1>;

template <int kDegree>
using MovingForces =
    boost::container::small_vector<ForceCoefficients<kDegree>, grasp::kInlineContacts>;

/// Bernstein coefficients of the torques of soft fingers about their normals, in the frame's unit
/// of length.
template <int kDegree>
using MovingTorques =
    boost::container::small_vector<std::array<double, kDegree + 1>, grasp::kInlineContacts>;

/// Largest total weight of forces, in addition to the fixed part of 1 to 1.5 along each normal. Few
/// motions that are not close to the limit need more, and excluding larger weights takes twice the
/// pivots.
inline constexpr double kLargestWeight = 1e4;

/// Largest total weight for motions near the limit. It is enough for motions that are force closure
/// with a friction margin of 1e-8 rad: their forces are about the inverse of that times larger than
/// their distance to the cones.
inline constexpr double kLargestWeightNearLimit = 1e10;

/// Search for forces of degree d in t that balance at every instant of a piece.
/// All coefficients are strictly inside their contacts' cones.
///
/// With p_i(t) = (1 − t) p_i + t p'_i, forces and torques of Σ f_i(t) are polynomials of degree d
/// and d + 1: 6 d + 9 linear equations in space, 3 d + 4 in the plane. The forces are f = a n + g
/// with fixed weights a > 0 and g inside the cone, so that Σ W(g) = −Σ a W(n) over all contacts and
/// coefficients. This is a cone program without bounds, solved by the simplex method with the rim
/// forces g as columns. The best column for a dual solution has a closed form, as in WrenchSimplex.
/// Here each coefficient has its own velocity u_ik, the sum of the blocks' twists at its arms.
///
/// The torques are represented by their values at the ends (and in the middle for degree 2) and by
/// their leading coefficient, Σ v × Δ^d f over the largest |v| of the velocities. Short pieces are
/// thus as well conditioned as long ones. A soft finger has a torque of degree d about its normal
/// with each force, which contributes to the values only.
///
/// Sources: force closure by balanced forces inside the cones, Murray, Li and Sastry 1994, Prop.
/// 5.3; column generation, Dantzig and Wolfe 1960.
/// @tparam kSpace  3, or 2 for planar contacts.
/// @tparam kDegree  1 or 2.
/// @param forces  output if true is returned, with largest length 1.
/// @param torques  output if true is returned; may be null if all contacts are hard-finger
///     contacts.
/// @returns false if there are no such forces, or none were found within the limit on pivots.
template <int kSpace, int kDegree>
[[nodiscard]] bool FindMovingForces(std::span<const MovingContact> contacts,
                                    MovingForces<kDegree>& forces,
                                    double largest_weight = kLargestWeight,
                                    MovingTorques<kDegree>* torques = nullptr);

/// Search for forces of degree 1 for contacts with dependent equations.
/// Equations are dependent, for example, if all contacts are in one plane. Rounding then makes
/// implied equations infeasible, so they are omitted.
/// @returns false also if the equations are independent.
template <int kSpace>
[[nodiscard]] bool FindMovingForcesWithoutRedundancy(std::span<const MovingContact> contacts,
                                                     MovingForces<1>& forces,
                                                     double largest_weight = kLargestWeight,
                                                     MovingTorques<1>* torques = nullptr);

}  // namespace regrasp::motion
