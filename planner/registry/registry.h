#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/planning/planner.h"

namespace regrasp::registry {

/// All planners: `general` first, then those that are complete over the grasps that they know, of
/// which the first one in the plane and the first one in space are those whose graph is built where
/// none is named; and `gait`, for hands.
[[nodiscard]] const std::vector<const planning::Planner*>& AllPlanners();

/// Adds a planner after all others, for programs that bring their own (examples/planner). Call it
/// before planning: no other thread may use this header meanwhile.
/// @throws InputError  there is a planner of that name already, or it is "auto".
void RegisterPlanner(std::unique_ptr<const planning::Planner> planner);

/// Their names and "auto", in the order of AllPlanners, for messages: "auto, general, polygon …".
[[nodiscard]] std::string PlannerNames();

/// @returns nullptr where no planner has that name.
[[nodiscard]] const planning::Planner* FindPlanner(const std::string& name);

/// The planner that `--planner auto` takes: the first of AllPlanners that serves the request, with
/// every option that it asks for. For a plan that is `general`, which joins at least as many pairs
/// of grasps as any other and faster (bench/planners), unless an option asks for what only another
/// gives: contact regions (contour), uniform spanning (polygon, polyhedron), contact points or
/// clusters (roadmap), a hand (gait).
/// @throws InputError  none does; the message says for which option.
[[nodiscard]] const planning::Planner& ChoosePlanner(const planning::PlanRequest& request);

/// The planner of a name, or ChoosePlanner's for "auto".
/// @throws InputError  there is none of that name, or it does not serve the request; the message
///                     names a planner that does, where there is one.
[[nodiscard]] const planning::Planner& PlannerFor(const std::string& name,
                                                  const planning::PlanRequest& request);

}  // namespace regrasp::registry
