#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/container/small_vector.hpp>
#include <span>

#include "planner/grasp/unit_contacts.h"

namespace regrasp::motion {

/// A contact on a straight segment of its path, in a frame in which the grasp is centred and of
/// about radius 1 at both ends, with the friction cone that its forces keep to all along.
struct MovingContact {
  Eigen::Vector3d start;
  Eigen::Vector3d end;
  /// end − start, times any factor that is the same for all contacts. On short pieces the
  /// difference of rounded points would lose the digits that say which torques are redundant.
  Eigen::Vector3d velocity;
  Eigen::Vector3d n;
  /// The rim of the cone, axial · n + tangential · t, of unit length.
  double axial;
  double tangential;
  double torsion = 0;  ///< grasp::Contact::torsion in the frame's unit
};

struct MovingContacts : boost::container::small_vector<MovingContact, grasp::kInlineContacts> {
  // Boost's iterators are not contiguous ones, so std::span does not take the container itself.
  operator std::span<const MovingContact>() const { return {data(), size()}; }  // NOLINT
};

/// Bernstein coefficients f_0 … f_d of the force of one contact, f(t) = Σ_k B_k(t) f_k.
template <int kDegree>
using ForceCoefficients = std::array<Eigen::Vector3d, kDegree + 1>;

template <int kDegree>
using MovingForces =
    boost::container::small_vector<ForceCoefficients<kDegree>, grasp::kInlineContacts>;

/// Those of the torques of soft fingers about their normals, in the frame's unit of length.
template <int kDegree>
using MovingTorques =
    boost::container::small_vector<std::array<double, kDegree + 1>, grasp::kInlineContacts>;

/// Forces with more weight in all than this beside the fixed part of 1 to 1.5 along each normal are
/// not looked for: hardly any motion needs them that is not close to the limit, and to rule them
/// out takes twice the pivots.
inline constexpr double kLargestWeight = 1e4;

/// Enough for motions that are force closure with 1e-8 rad to spare: their forces are about the
/// inverse of that times larger than what they keep off their cones.
inline constexpr double kLargestWeightNearLimit = 1e10;

/// Looks for forces of degree d in t that balance at every instant of a piece, all coefficients
/// strictly inside their contacts' cones.
///
/// With p_i(t) = (1 − t) p_i + t p'_i, forces and torques of Σ f_i(t) are polynomials of degree d
/// and d + 1: 6 d + 9 linear equations in space, 3 d + 4 in the plane. The forces are f = a n + g
/// with fixed weights a > 0 and g inside the cone, so that Σ W(g) = −Σ a W(n) over all contacts and
/// coefficients: a cone program without bounds, solved by the simplex method with the rim forces g
/// as columns. The best column for a dual solution is closed form, as in WrenchSimplex; here each
/// coefficient has a velocity of its own, u_ik, the sum of the blocks' twists at its arms.
///
/// The torques are written as values at the ends (and in the middle for degree 2) and as their
/// leading coefficient, Σ v × Δ^d f over the largest |v| of the velocities, so that short pieces
/// are as well conditioned as long ones. A soft finger has a torque of degree d about its normal
/// with each force, which is a part of the values alone.
///
/// Source of the idea: force closure by balanced forces inside the cones, Murray, Li and Sastry
/// 1994, Prop. 5.3; column generation, Dantzig and Wolfe 1960.
/// @tparam kSpace  3, or 2 for planar contacts. @tparam kDegree  1 or 2.
/// @param forces  set where true is returned: of largest length 1.
/// @param torques  the same; may be null where all contacts are hard points.
/// @returns false where there are none, or none was found within the limit on pivots.
template <int kSpace, int kDegree>
[[nodiscard]] bool FindMovingForces(std::span<const MovingContact> contacts,
                                    MovingForces<kDegree>& forces,
                                    double largest_weight = kLargestWeight,
                                    MovingTorques<kDegree>* torques = nullptr);

/// The same of degree 1 for contacts whose equations are not independent, as where all of them are
/// in one plane: rounding makes equations of what the others imply that nothing can satisfy. Those
/// are left out.
/// @returns false also where the equations are independent.
template <int kSpace>
[[nodiscard]] bool FindMovingForcesWithoutRedundancy(std::span<const MovingContact> contacts,
                                                     MovingForces<1>& forces,
                                                     double largest_weight = kLargestWeight,
                                                     MovingTorques<1>* torques = nullptr);

}  // namespace regrasp::motion
