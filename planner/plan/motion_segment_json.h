#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/motion/motion_segment.h"
#include "planner/plan/json_reader.h"

namespace regrasp::plan {

[[nodiscard]] Json ForcesJson(const std::vector<Eigen::Vector3d>& forces, int dimension);
[[nodiscard]] Json MotionSegmentsJson(const motion::MotionSegments& pieces, int dimension);
/// @throws InputError
[[nodiscard]] std::vector<Eigen::Vector3d> ReadForces(const JsonReader& json, int dimension);
/// A list of numbers where there is one of that name; otherwise empty. @throws InputError
[[nodiscard]] std::vector<double> ReadTorques(const JsonReader& json, const char* name);
[[nodiscard]] motion::MotionSegments ReadMotionSegments(const JsonReader& json, int dimension);

}  // namespace regrasp::plan
