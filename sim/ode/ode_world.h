#pragma once

#include <ode/ode.h>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "sim/scene/contact_patches.h"

namespace regrasp::sim {

/// Bounds on the friction of a contact: ± `along` the direction and ± `across` it.
struct FrictionBox {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit vector in the tangent plane
  double along = 0;
  double across = 0;
};

/// Return a box inside the circle of friction forces |t| ≤ μ N about a contact's normal.
/// Its corners are on the circle. It is long in the direction of the last friction force, and
/// narrower the closer this force is to the circle.
///
/// ODE bounds friction by a box. A box with the sides 2 μ N permits forces √2 times too large, even
/// if it is turned towards the last force. Three contacts together turn their boxes from step to
/// step so that each uses a corner. A box inside the circle never permits that. Because it is
/// computed again from each resulting force, that force can reach kLongest of the circle, in every
/// direction.
///
/// Laws: along² + across² = (μ N)², along ≥ across ≥ 0 for any force; equivariant to rotations.
/// @param normal  unit vector.
/// @param force   last force at the contact; its normal component N counts if it is positive.
[[nodiscard]] FrictionBox BoxInCircle(const Eigen::Vector3d& normal, const Eigen::Vector3d& force,
                                      double mu);

/// Return the box along `direction` only, for the plane, in which the friction cone is flat: ± μ N.
[[nodiscard]] FrictionBox BoxInPlane(const Eigen::Vector3d& normal, const Eigen::Vector3d& force,
                                     double mu);

/// Return whether a force that was solved with a box obeys Coulomb's cone.
/// It must not be outside the cone of its own normal component, and must be on it if the box
/// limited it. Both hold within kConeTolerance of μ N and `slack`, newtons.
[[nodiscard]] bool KeepsCone(const Eigen::Vector3d& normal, const FrictionBox& box,
                             const Eigen::Vector3d& force, double mu, double slack);

/// Largest `along` over μ N. The lost friction is a thousandth of the default disturbance, and the
/// force can turn by 0.26° per solution.
inline constexpr double kLongest = 0.99999;
inline constexpr double kConeTolerance = 3e-5;

/// Convex prism under a contact patch, which a fingertip touches.
struct PatchPrism {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< corner of the outline
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: two in the patch, outward
  std::vector<Eigen::Vector2d> outline;                ///< counter-clockwise in the first two axes
  double thickness = 0;                                ///< inward
};

/// Contact of a sphere with a prism.
struct PatchTouch {
  /// Point of the prism nearest to the sphere's centre.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit vector from the sphere into the prism
  double depth = 0;                                  ///< penetration depth of the sphere, positive
};

/// Make the prism of a contact patch.
/// @param inward  unit normal of the patch's face, into the object.
[[nodiscard]] PatchPrism MakePrism(const ContactPatch& patch, const Eigen::Vector3d& inward,
                                   double thickness);

/// Compute the contact of a sphere with a prism, exact up to rounding.
/// Beyond the patch's outline the rim and the sides count. All lengths are in one unit, in the
/// frame of the patch.
/// @returns the contact; nullopt if the sphere does not touch the patch, or its centre is below it.
[[nodiscard]] std::optional<PatchTouch> TouchPatch(const PatchPrism& prism,
                                                   const Eigen::Vector3d& centre, double radius);

// RAII wrappers of ODE's handles, and its messages as exceptions.

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

/// World with its bodies. It owns its step memory, so worlds of several threads share nothing.
struct OdeWorld {
  OdeThreadingPtr threading;
  OdeWorldPtr world;  ///< destroyed before its step memory

  [[nodiscard]] dWorldID get() const { return world.get(); }
};

/// Initialize ODE once per process, and make a world.
/// ODE's errors become UnstableError; none of its messages reach the terminal.
[[nodiscard]] OdeWorld MakeOdeWorld();

/// Simulate one time step with ODE's direct solver.
/// @return whether the solver converged; otherwise the step is unreliable.
[[nodiscard]] bool StepOde(dWorldID world, double timestep);

// Parameters of the solution of a step, for replays by point fingers and by a hand.

/// Compliance of contacts over the mobility of the bodies. It makes the friction of a grasp with
/// redundant contacts unique; the object creeps by 1e-9 of its size per characteristic time.
inline constexpr double kOdeCompliance = 1e-7;
/// Share of a contact's depth that a step recovers, ODE's default.
inline constexpr double kOdeDepthRecovery = 0.2;
/// Largest number of solutions of a step until all contacts obey their cones. If an object slides
/// or a finger makes contact at high speed, forces may alternate; the last ones are then used.
inline constexpr int kMostOdeSolutions = 20;
/// Perturbations of steps that fail. ODE's solver proceeds from contact to contact. It may fail if
/// a force reaches two of its bounds at once, for example in a slide or at a light contact. The
/// step is then repeated up to kMostOdeTries times with another order of the contacts, bounds that
/// are narrower by the share kOdeNarrower, and contacts that are softer by the factor kOdeSofter.
inline constexpr double kOdeNarrower = 1e-6;
inline constexpr double kOdeSofter = 3;
inline constexpr int kMostOdeTries = 8;

/// Append a vector to the numbers of a saved state.
void AppendVector(const Eigen::Vector3d& v, std::vector<double>& values);

/// Return the vector at the start of `values`, and advance `values` beyond it.
[[nodiscard]] Eigen::Vector3d TakeVector(const double*& values);

}  // namespace regrasp::sim
