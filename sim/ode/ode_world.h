#pragma once

#include <ode/ode.h>

#include <memory>
#include <type_traits>

namespace regrasp::sim {

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
