#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/model_text.h"

struct mjModel_;

namespace regrasp::sim {

/// Return numbers as the text of an attribute, with enough digits to be read back unchanged.
[[nodiscard]] std::string NumbersText(const double* values, int count);
[[nodiscard]] std::string NumbersText(const std::vector<double>& values);

/// Write the exact numbers of a model into the MJCF that MuJoCo saved, which has six digits.
/// These are frames and inertias of bodies, joints, couplings, tendons and actuators, and primitive
/// geoms.
/// @param root  MJCF with the elements in the order of the model, as mj_saveLastXML writes them.
void WriteModelNumbers(const mjModel_& model, kinematics::XmlElement& root);

}  // namespace regrasp::sim
