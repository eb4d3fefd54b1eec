#include <pybind11/numpy.h>

#include <cstdint>
#include <string>
#include <vector>

#include "planner/grasp/force_closure.h"
#include "python/binding.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

using Values = py::array_t<double, py::array::c_style>;

py::array_t<double> ValueArray(const std::vector<double>& values, bool asked) {
  if (!asked) return py::array_t<double>(0);
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// Return decisions (0 no, 1 too close, 2 yes), bounds on the margin, required friction angle, and
/// bounds on the quality.
py::tuple JudgeGrasps(const Values& points, const Values& normals, const PythonObject* object,
                      int dimension, double friction_angle, double torsion, bool required,
                      bool quality, int threads) {
  const grasp::GraspArrays arrays = {{points.data(), static_cast<std::size_t>(points.size())},
                                     {normals.data(), static_cast<std::size_t>(normals.size())},
                                     static_cast<int>(points.shape(1))};
  grasp::JudgeOptions options;
  options.friction_angle = friction_angle;
  options.torsion = torsion;
  options.frame.dimension = dimension;
  if (object != nullptr) options.frame = object->file.object->wrench_frame();
  options.required_friction_angle = required;
  options.quality = quality;
  options.threads = threads;
  grasp::GraspVerdicts verdicts;
  {
    const py::gil_scoped_release unlocked;
    verdicts = grasp::JudgeGrasps(arrays, options);
  }
  const auto count = static_cast<py::ssize_t>(verdicts.force_closure.size());
  py::array_t<std::int8_t> decisions(count);
  py::array_t<double> lower(count);
  py::array_t<double> upper(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const grasp::ForceClosure& verdict = verdicts.force_closure[static_cast<std::size_t>(i)];
    decisions.mutable_at(i) = static_cast<std::int8_t>(verdict.decision);
    lower.mutable_at(i) = verdict.margin_lower;
    upper.mutable_at(i) = verdict.margin_upper;
  }
  return py::make_tuple(
      decisions, lower, upper, ValueArray(verdicts.required_friction_angle, required),
      ValueArray(verdicts.quality, quality), ValueArray(verdicts.quality_upper, quality));
}

}  // namespace

void BindGrasps(py::module_& module) { module.def("judge_grasps", JudgeGrasps); }

}  // namespace regrasp::python
