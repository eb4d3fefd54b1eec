#pragma once

#include <Eigen/Core>

namespace regrasp::sim {

/// What friction may push at a contact: `along` the direction and `across` it, each way.
struct FrictionBox {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit, in the tangent plane
  double along = 0;
  double across = 0;
};

/// A box inside the circle of friction forces |t| ≤ μ N about a contact's normal, with its corners
/// on the circle: long in the direction of the last friction force and the narrower the nearer this
/// is to the circle.
///
/// ODE bounds friction by a box. One with the sides 2 μ N lets forces be √2 times too large, also
/// where it is turned towards the last force: three contacts together turn theirs from step to step
/// so that each uses a corner. A box inside the circle never does. As it is made anew from the
/// force that it led to, that force comes as near to the circle as kLongest of it, in every
/// direction.
///
/// Laws: along² + across² = (μ N)², along ≥ across ≥ 0, whatever the force; turns with the force.
/// @param normal  unit.
/// @param force   the last one at the contact, whose normal part N counts where it is positive.
[[nodiscard]] FrictionBox BoxInCircle(const Eigen::Vector3d& normal, const Eigen::Vector3d& force,
                                      double mu);

/// The box along `direction` alone, for the plane, where the friction cone is flat: ± μ N.
[[nodiscard]] FrictionBox BoxInPlane(const Eigen::Vector3d& normal, const Eigen::Vector3d& force,
                                     double mu);

/// Whether a force found with a box is one of Coulomb's cone about its own normal part: not outside
/// it, and on it where the box held it back; both within kConeTolerance of μ N and `slack`,
/// newtons.
[[nodiscard]] bool KeepsCone(const Eigen::Vector3d& normal, const FrictionBox& box,
                             const Eigen::Vector3d& force, double mu, double slack);

/// Of μ N, the largest `along`: what friction is given away is a thousandth of the default shake,
/// and the force can turn by 0.26° in a solution.
inline constexpr double kLongest = 0.99999;
inline constexpr double kConeTolerance = 3e-5;

}  // namespace regrasp::sim
