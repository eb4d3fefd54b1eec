#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
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
/// Looks for a gait with one of some spares, from each place in the hand with the next of them;
/// without reserve where there are none. What is to have a spare is tried on the way where the
/// hand can try plans.
using FindOne = std::function<FoundGait(const GaitRequest& asked, std::span<const Spare> spares)>;

/// Looks for gaits with reserve where nothing tells whether the hand carries them out: first with
/// more and then with less to spare. One much longer than the one without does not count.
/// @param without  the one without reserve, where the request allows it and there is one.
/// @returns the first that there is, or the one without; where there is none, why.
[[nodiscard]] FoundGait FindWithReserve(const GaitRequest& request, const FindOne& find,
                                        const FoundGait& without);

/// A gait, and how far the hand carries it out, or the one that came farthest of those that are not
/// given because it does not; nullopt: nothing tells, or none was tried.
struct TriedGait {
  FoundGait found;
  std::optional<planning::CarriedOut> trial = {};
};

/// Where and why a plan of so many steps is not carried out.
[[nodiscard]] std::string FailureText(const planning::CarriedOut& carried, std::size_t steps);

/// Looks for gaits with reserve until the hand carries one out (planning::InHandTask::carry_out),
/// with more or less to spare by turns, and again, as each time draws others; where there is none,
/// for one without. Where the hand can't tell, as if it were not asked. Where the request seeks the
/// most to spare, it goes on all the same, and the gait with most is taken, the first of equal
/// ones.
/// @param contacts  of gaits, by their numbers.
/// @returns no gait that is not carried out where the request's reserve is required.
[[nodiscard]] TriedGait FindCarriedOut(const GaitRequest& request,
                                       const std::vector<grasp::Contact>& contacts,
                                       const FindOne& find);

}  // namespace regrasp::gait
