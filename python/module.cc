// Extension module _regrasp, the basis of the Python package regrasp.

#include <pybind11/stl/filesystem.h>

#include <exception>
#include <filesystem>
#include <string_view>

#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
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
  module.def("write_file", [](const std::filesystem::path& path, const py::bytes& content) {
    WriteFile(path, std::string_view(content));
  });
  python::BindObjects(module);
  python::BindGrasps(module);
  python::BindHands(module);
  python::BindHandGrasps(module);
  python::BindPlans(module);
  python::BindReports(module);
  python::BindFigures(module);
}
