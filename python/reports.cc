#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/plan/plan_io.h"
#include "python/binding.h"
#include "python/interrupt.h"
#include "report/failure.h"
#include "report/report.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

struct ValidateArguments {
  std::optional<double> half_angle, mass_kg, squeeze_N;
  double shake = sim::ReplayOptions().shake;
  double tolerance = sim::ReplayOptions().tolerance;
  bool stress = false;
};

void CheckFits(const plan::Plan& plan, const PythonObject& object, const std::string& name) {
  const bool repaired =
      plan.repair && !object.file.repair && plan.repair->sha256 == object.file.sha256;
  if (!repaired &&
      (plan.object_sha256 != object.file.sha256 || plan.repair != object.file.repair)) {
    throw InputError(name + ": /object/sha256: the plan was made for " + plan.object_file +
                     " with digest " + plan.object_sha256 + ", but " + object.file.file + " has " +
                     object.file.sha256);
  }
  if (plan.at_given_points) {
    throw InputError(name + ": its contacts are at points of " + plan.object_file +
                     "; the program validate checks that");
  }
}

report::Report Validate(const PythonObject& object, const std::string& text,
                        const std::string& name, const ValidateArguments& given,
                        Interrupt& interrupt) {
  const plan::Plan plan = plan::ParsePlan(text, name);
  CheckFits(plan, object, name);
  plan::CheckOptions check;
  check.half_angle = given.half_angle;
  sim::ReplayOptions replay;
  replay.half_angle = given.half_angle;
  replay.mass_kg = given.mass_kg;
  replay.squeeze_N = given.squeeze_N;
  replay.shake = given.shake;
  replay.tolerance = given.tolerance;
  replay.stress = given.stress;
  sim::ReplayObserver observer;
  const auto progress = interrupt.progress();
  observer.on_progress = [&](int done, int total) {
    progress("replay: " + std::to_string(done) + " of " + std::to_string(total) + " steps");
    if (interrupt.raised()) throw TimeUp();
  };
  report::Report report = report::Validate(*object.file.object, plan, check, replay, observer);
  report.object_file = object.file.file;
  report.object_sha256 = object.file.sha256;
  report.plan_file = name;
  report.plan_sha256 = Sha256(text);
  return report;
}

/// The text of report.json, the table, and what failed, why and what would mend it (or None).
py::tuple ValidatePlan(const PythonObject& object, const std::string& text, const std::string& name,
                       const ValidateArguments& given, py::object progress) {
  Interrupt interrupt({}, std::move(progress));
  std::string json, table;
  std::optional<std::string> failure;
  {
    const py::gil_scoped_release unlocked;
    try {
      const report::Report report = Validate(object, text, name, given, interrupt);
      json = report::FormatReportJson(report);
      table = report::FormatReportTable(report);
      if (const auto failed = report::DescribeFailure(report)) {
        failure =
            failed->headline() + "; why: " + failed->why + "; what would mend it: " + failed->mend;
      }
    } catch (const TimeUp&) {
      if (!interrupt.raised()) throw;
    }
  }
  interrupt.ThrowIfRaised();
  return py::make_tuple(json, table, failure);
}

}  // namespace

void BindReports(py::module_& module) {
  py::class_<ValidateArguments>(module, "ValidateArguments")
      .def(py::init<>())
      .def_readwrite("half_angle", &ValidateArguments::half_angle)
      .def_readwrite("mass_kg", &ValidateArguments::mass_kg)
      .def_readwrite("squeeze_N", &ValidateArguments::squeeze_N)
      .def_readwrite("shake", &ValidateArguments::shake)
      .def_readwrite("tolerance", &ValidateArguments::tolerance)
      .def_readwrite("stress", &ValidateArguments::stress);
  module.def("validate_plan", ValidatePlan);
}

}  // namespace regrasp::python
