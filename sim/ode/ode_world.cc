#include "sim/ode/ode_world.h"

#include <array>
#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <string>

#include "sim/scene/engine.h"

namespace regrasp::sim {
namespace {

/// Set where ODE complains during a step of this thread: its solver of complementarity problems
/// came upon a pivot that is not positive.
thread_local bool complained = false;

void TakeMessage(int /*number*/, const char* /*format*/, va_list /*values*/) { complained = true; }

/// Called where ODE would otherwise end the process.
[[noreturn]] void ThrowError(int /*number*/, const char* format, va_list values) {
  std::array<char, 500> text{};
  (void)std::vsnprintf(text.data(), text.size(), format, values);
  throw UnstableError(std::string("engine error: ") + text.data());
}

}  // namespace

OdeWorld MakeOdeWorld() {
  static std::once_flag once;
  std::call_once(once, [] {
    dInitODE2(0);
    dSetMessageHandler(TakeMessage);
    dSetErrorHandler(ThrowError);
    dSetDebugHandler(ThrowError);
  });
  OdeWorld made{OdeThreadingPtr(dThreadingAllocateSelfThreadedImplementation()),
                OdeWorldPtr(dWorldCreate())};
  dWorldSetStepThreadingImplementation(
      made.get(), dThreadingImplementationGetFunctions(made.threading.get()), made.threading.get());
  return made;
}

bool StepOde(dWorldID world, double timestep) {
  complained = false;
  dWorldStep(world, timestep);
  return !complained;
}

}  // namespace regrasp::sim
