#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/gait/find_gait.h"

namespace regrasp::gait {

/// What gaits with reserve have to spare. None of their fingers slides.
struct Spare {
  double quality = 0;    ///< of their grasps
  double clearance = 0;  ///< of links, beside the margin, metres
  /// As HandSetup has it, where contacts have rolled to. None: contacts are not followed, which is
  /// reserve only where the hand carries a gait out.
  std::optional<double> force_margin = {};
};

struct FoundGait {
  std::optional<Gait> gait;
  std::string message;  ///< where there is none
};
/// Looks for a gait. @param spare  null: without reserve.
using FindOne = std::function<FoundGait(const GaitRequest& asked, const Spare* spare)>;

/// Looks for gaits with reserve, first with more and then with less to spare, until the hand
/// carries one out (planning::InHandTask::is_carried_out), or that without reserve; again and
/// again, as each draws others, and every time for longer. A gait much longer than the one without
/// does not count.
///
/// @param contacts  of gaits, by their numbers.
/// @param found     the one without, where the request allows it and there is one; then the one
///                  that the hand carries out, or else the first with reserve; where reserve is
///                  required and there is none, why.
/// @returns whether the hand carries it out; nullopt where nothing tells.
std::optional<bool> FindWithReserve(const GaitRequest& request,
                                    const std::vector<grasp::Contact>& contacts,
                                    const FindOne& find, FoundGait& found);

}  // namespace regrasp::gait
