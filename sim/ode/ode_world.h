#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "sim/scene/contact_patches.h"

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

/// The convex prism under a contact patch, which a fingertip touches.
struct PatchPrism {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< a corner of the outline
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: two in the patch, outward
  std::vector<Eigen::Vector2d> outline;                ///< counter-clockwise in the first two axes
  double thickness = 0;                                ///< inward
};

/// A ball that reaches into a prism.
struct PatchTouch {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< of the prism, nearest to the ball's centre
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, from the ball into the prism
  double depth = 0;                                  ///< of the ball in the prism, positive
};

/// @param inward  unit normal of the patch's face, into the object.
[[nodiscard]] PatchPrism MakePrism(const ContactPatch& patch, const Eigen::Vector3d& inward,
                                   double thickness);

/// Where a ball touches a prism: beyond the patch's outline its rim and sides count. Nothing where
/// the ball is off it, or its centre is below it. Exact up to rounding. All lengths in one unit, in
/// the frame of the patch.
[[nodiscard]] std::optional<PatchTouch> TouchPatch(const PatchPrism& prism,
                                                   const Eigen::Vector3d& centre, double radius);

// RAII around ODE's handles, and its messages as exceptions.

struct OdeThreadingDeleter {
  void operator()(dThreadingImplementationID threading) const {
    dThreadingFreeImplementation(threading);
  }
};
struct OdeWorldDeleter {
  void operator()(dWorldID world) const { dWorldDestroy(world); }
};
struct OdeJointsDeleter {
  void operator()(dJointGroupID joints) const { dJointGroupDestroy(joints); }
};
using OdeThreadingPtr =
    std::unique_ptr<std::remove_pointer_t<dThreadingImplementationID>, OdeThreadingDeleter>;
using OdeWorldPtr = std::unique_ptr<std::remove_pointer_t<dWorldID>, OdeWorldDeleter>;
using OdeJointsPtr = std::unique_ptr<std::remove_pointer_t<dJointGroupID>, OdeJointsDeleter>;

/// A world with its bodies. What it steps with is its own: worlds of several threads share nothing.
struct OdeWorld {
  OdeThreadingPtr threading;
  OdeWorldPtr world;  ///< goes before what it steps with

  [[nodiscard]] dWorldID get() const { return world.get(); }
};

/// Starts ODE once in a process and takes its messages. Its errors become UnstableError; nothing
/// reaches the terminal.
[[nodiscard]] OdeWorld MakeOdeWorld();

/// One time step with ODE's direct solver.
/// @return whether the solver came to an end; where not, the step is not to be trusted.
[[nodiscard]] bool StepOde(dWorldID world, double timestep);

}  // namespace regrasp::sim
