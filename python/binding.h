#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::python {

/// Object held by Python.
struct PythonObject {
  object::ObjectFile file;
  double scale = 1;  ///< metres per unit of length
  std::string text;  ///< text of the corresponding file; empty if it was read from a file
};

/// Hand held by Python.
struct PythonHand {
  kinematics::HandFile file;
};

/// Check that a plan was made for an object. @param name  name of the plan in messages.
/// @throws InputError  if the plan was made for another object or for another scale of it.
void CheckFits(const plan::Plan& plan, const PythonObject& object, const std::string& name);

// Add the functions of one part to the extension module. The Python code above them checks all
// types and shapes, so that they do not.
void BindObjects(pybind11::module_& module);
void BindGrasps(pybind11::module_& module);
void BindHands(pybind11::module_& module);
void BindPlans(pybind11::module_& module);
void BindReports(pybind11::module_& module);
void BindFigures(pybind11::module_& module);

}  // namespace regrasp::python
