#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::python {

/// An object as Python holds it.
struct PythonObject {
  object::ObjectFile file;
  double scale = 1;  ///< metres per unit of length
  std::string text;  ///< of the file that it would be; empty where it was read from one
};

/// A hand as Python holds it.
struct PythonHand {
  kinematics::HandFile file;
};

/// @param name  of the plan, for the message.
/// @throws InputError  if the plan was made for another object or for another scale of it.
void CheckFits(const plan::Plan& plan, const PythonObject& object, const std::string& name);

// Each adds its functions to the extension module. They check no argument whose type or shape the
// Python code above them has already checked.
void BindObjects(pybind11::module_& module);
void BindGrasps(pybind11::module_& module);
void BindHands(pybind11::module_& module);
void BindPlans(pybind11::module_& module);
void BindReports(pybind11::module_& module);
void BindFigures(pybind11::module_& module);

}  // namespace regrasp::python
