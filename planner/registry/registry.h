#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planner/planning/planner.h"

namespace regrasp::registry {

/// Return all planners in order of preference.
/// The first one is `general`. Then follow the planners that are complete over their grasps: by
/// default a graph is built by the first of them in the plane or in space. `gait` is for hands.
[[nodiscard]] const std::vector<const planning::Planner*>& AllPlanners();

/// Add a planner after all others, for programs with their own planners (examples/planner).
/// Must be called before planning, while no other thread uses this header.
/// @throws InputError  if there is a planner with that name, or the name is "auto".
void RegisterPlanner(std::unique_ptr<const planning::Planner> planner);

/// Return the names of "auto" and all planners, for messages: "auto, general, polygon …".
[[nodiscard]] std::string PlannerNames();

/// Return the planner with a name; nullptr if there is none.
[[nodiscard]] const planning::Planner* FindPlanner(const std::string& name);

/// Return the planner for `--planner auto`.
/// It is the first of AllPlanners that supports all options of a request.
/// This is `general` unless an option requires another planner, because it solves at least as many
/// pairs of grasps as any other, and faster (bench/planners). Such options are contact regions
/// (contour), uniform spanning (polygon, polyhedron), contact points or clusters (roadmap), and a
/// hand (gait).
/// @throws InputError  if no planner supports the request. The message names the planners of each
///     option.
[[nodiscard]] const planning::Planner& ChoosePlanner(const planning::PlanRequest& request);

/// Return the planner with a name, or that of ChoosePlanner for "auto".
/// @throws InputError  if there is no planner with that name, or it does not support the request.
///     The message names a planner that does, if there is one.
[[nodiscard]] const planning::Planner& PlannerFor(const std::string& name,
                                                  const planning::PlanRequest& request);

}  // namespace regrasp::registry
