#pragma once

#include <optional>
#include <string>

#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp::plan {

/// What is wrong with a motion between two contacts that lie on the object: nullopt where the
/// contact stays on one face all the way, or keeps its point (to within kPointTolerance · D) and
/// turns from one face to another at a point that both have in common. Faces that are merely near
/// each other, on the two sides of a thin wall or of a slit, have none.
[[nodiscard]] std::optional<std::string> FindMotionFault(const object::Object& object,
                                                         const grasp::Contact& from,
                                                         const grasp::Contact& to);

}  // namespace regrasp::plan
