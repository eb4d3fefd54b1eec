// The extension module _regrasp: what the Python package regrasp is made of.

#include <exception>

#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "python/binding.h"

PYBIND11_MODULE(_regrasp, module) {
  using namespace regrasp;
  namespace py = pybind11;
  module.attr("version") = REGRASP_VERSION;
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const EnvironmentError& error) {
      PyErr_SetString(PyExc_OSError, error.what());
    } catch (const TimeUp& error) {
      PyErr_SetString(PyExc_TimeoutError, error.what());
    }
  });
  python::BindObjects(module);
  python::BindGrasps(module);
  python::BindHands(module);
  python::BindPlans(module);
  python::BindReports(module);
  python::BindFigures(module);
}
