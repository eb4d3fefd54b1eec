#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/model_text.h"

struct mjModel_;

namespace regrasp::sim {

/// Return numbers as an attribute has them, with enough digits to be read back unchanged.
[[nodiscard]] std::string NumbersText(const double* values, int count);
[[nodiscard]] std::string NumbersText(const std::vector<double>& values);

/// Write the numbers of a model into the MJCF that MuJoCo saved of it, which has six digits: frames
/// and inertias of bodies, joints, couplings, tendons and actuators, primitive geoms.
/// @param root  The elements in the order of the model, as mj_saveLastXML writes them.
void WriteModelNumbers(const mjModel_& model, kinematics::XmlElement& root);

}  // namespace regrasp::sim
