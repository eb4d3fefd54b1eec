#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <string>

#include "planner/base/error.h"
#include "planner/plan/check.h"
#include "planner/plan/plan_io.h"
#include "planner/plan/projection.h"
#include "planner/plan/reason.h"
#include "python/binding.h"
#include "render/figures/plan_figure.h"
#include "sim/validation/validation.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

using Values = py::array_t<double, py::array::c_style>;

render::FigureStyle StyleOf(double width_mm) {
  render::FigureStyle style;
  style.width_mm = style.sheet_width_mm = width_mm;
  return style;
}

/// Draw the overview image of all steps, as SVG.
std::string DrawPlan(const PythonObject& object, const std::string& text, const std::string& name,
                     double width_mm) {
  const py::gil_scoped_release unlocked;
  const plan::Plan plan = plan::ParsePlan(text, name);
  CheckFits(plan, object, name);
  const plan::PlanCheck check = plan::CheckPlan(*object.file.object, plan);
  for (const plan::StepCheck& step : check.steps) {
    if (step.reason == plan::Reason::kNone) continue;
    throw InputError(name + ": step " + std::to_string(step.index) + " (" + step.kind +
                     "): " + std::string(plan::ReasonName(step.reason)) + ": " + step.detail);
  }
  return render::DrawSheet(*render::MakePanels(*object.file.object, check.projected),
                           StyleOf(width_mm));
}

/// Draw one grasp of k x 3 values; in the plane z = 0.
/// @throws InputError  if a contact is not on the object.
std::string DrawGrasp(const PythonObject& object, const Values& points, const Values& normals,
                      double friction_angle, double width_mm) {
  const object::Object& body = *object.file.object;
  const plan::ProjectedGrasps projected =
      plan::ProjectGrasps(body, {points.data(), static_cast<std::size_t>(points.size())},
                          {normals.data(), static_cast<std::size_t>(normals.size())},
                          static_cast<int>(points.shape(0)));
  if (projected.reasons[0] != plan::Reason::kNone) {
    throw InputError("points: " + std::string(plan::ReasonName(projected.reasons[0])));
  }
  grasp::Grasp grasp;
  for (std::size_t i = 0; i < projected.points.size(); i += 3) {
    grasp.push_back(
        {Eigen::Vector3d::Map(&projected.points[i]), Eigen::Vector3d::Map(&projected.normals[i])});
  }
  const plan::Plan hold =
      plan::ProjectPlan(body, validation::MakeHoldPlan(body, grasp, friction_angle, object.scale));
  return render::DrawStepFigure(*render::MakePanels(body, hold), 0, StyleOf(width_mm));
}

}  // namespace

void BindFigures(py::module_& module) {
  module.def("draw_plan", DrawPlan);
  module.def("draw_grasp", DrawGrasp);
}

}  // namespace regrasp::python
