#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/gait/gait.h"
#include "planner/gait/request.h"

namespace regrasp::gait {

struct GaitResult {
  std::optional<Gait> gait;
  /// How far the hand carries it out, as the request's test has it. Where there is no gait because
  /// it carries none out, of the one that came farthest. None: nothing was tried, or nothing tells.
  std::optional<planning::CarriedOut> trial;
  std::vector<grasp::Contact> contacts;  ///< by the numbers that the gait has, the object's units
  std::string message;                   ///< where there is none: what stopped it, counted
};

/// Finds a gait of the hand that turns the object: chooses where in the hand it begins and with
/// which grasp. A preferred reserve is left out where the gait gets much longer by it.
///
/// Laws: without a deadline the same request gives the same gait, bit for bit, with any jobs; every
/// rest is force closure and meets the criteria where it can; every path is certified
/// (certified_path.h).
/// @throws std::invalid_argument  start_fingers are not one of the hand for each contact.
/// @throws InputError  fewer than three fingers can touch the object at the start or goal pose,
///     however they are bent.
[[nodiscard]] GaitResult FindGait(const GaitRequest& request);

}  // namespace regrasp::gait
