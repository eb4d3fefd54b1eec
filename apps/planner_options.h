#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "apps/options.h"
#include "planner/object/polyhedron.h"
#include "planner/roadmap/plan_roadmap.h"

namespace regrasp {

/// The options that `plan` and `graph` have in common.
struct PlannerOptions {
  std::string object;
  FrictionOptions friction;
  std::string planner = "auto";
  std::string spanning = "adaptive";
  std::uint64_t seed = 0;
  int contacts = RoadmapOptions().contacts;
  double scale = 1;
  bool quiet = false;

  void AddTo(CLI::App& app);

  /// @throws InputError  friction is missing, doubled or out of range.
  [[nodiscard]] RoadmapOptions roadmap() const;
};

/// The object as a solid, which the planner `roadmap` needs.
/// @throws InputError  it is planar.
[[nodiscard]] const Polyhedron& SolidOf(const ObjectFile& file, const std::string& path);

}  // namespace regrasp
