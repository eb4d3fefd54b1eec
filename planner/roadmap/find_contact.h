#pragma once

#include <optional>
#include <vector>

#include "planner/grasp/contact.h"

namespace regrasp::roadmap {

/// The first of `points` that is the same contact: on the same face, no farther than `tolerance`.
[[nodiscard]] std::optional<int> FindContact(const std::vector<grasp::Contact>& points,
                                             const grasp::Contact& contact, double tolerance);

}  // namespace regrasp::roadmap
