#pragma once

#include "planner/grasp/contact.h"
#include "planner/plan/json_reader.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

/// Reads `{"point": […], "normal": […]}`, both of `dimension` numbers; further fields are ignored.
[[nodiscard]] grasp::Contact ReadContact(const JsonReader& json, int dimension);

/// Reads an array of contacts, each with its `finger` and, if it has one, its `region`.
[[nodiscard]] FingerGrasp ReadFingerGrasp(const JsonReader& json, int dimension);

/// Reads a finger's number. Numbers outside the hand are left to the checker.
[[nodiscard]] FingerIndex ReadFinger(const JsonReader& json);

[[nodiscard]] Json ContactJson(const grasp::Contact& contact, int dimension);
[[nodiscard]] Json GraspJson(const grasp::Grasp& grasp, int dimension);
[[nodiscard]] Json FingerGraspJson(const FingerGrasp& grasp, int dimension);

}  // namespace regrasp::plan
