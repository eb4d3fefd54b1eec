#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "apps/options.h"
#include "planner/base/memory.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/roadmap/plan_roadmap.h"
#include "planner/sets/polygon/grasp_set.h"

namespace regrasp {

/// What `--planner auto` takes, for the help.
struct AutomaticPlanner {
  std::string in_plane;
  std::string in_space;
};

/// The options that `plan` and `graph` have in common.
struct PlannerOptions {
  std::string object;
  FrictionOptions friction;
  std::string planner = "auto";
  std::string spanning = "adaptive";
  std::uint64_t seed = 0;
  std::optional<int> contacts;
  std::optional<int> clusters;
  double scale = 1;
  bool force = false;
  bool quiet = false;

  void AddTo(CLI::App& app, const AutomaticPlanner& automatic);

  /// Reads the object and says so while it does.
  /// @throws TimeUp  the deadline came.
  [[nodiscard]] ObjectFile ReadObjectFile(const Deadline& deadline = {}) const;

  [[nodiscard]] Spanning spanning_value() const;

  /// @throws InputError  friction is missing, doubled or out of range; more contact points than a
  ///                     plain roadmap takes, and no clusters.
  [[nodiscard]] RoadmapOptions roadmap(const Polyhedron& solid) const;

  /// Bytes that a graph may take: UsableMemory, or any number with --force.
  [[nodiscard]] double memory() const;
  /// @throws InputError  the graph would take more than that.
  void CheckMemory(const MemoryNeed& need) const;
};

/// The object as a polygon, which the planners `polygon` and `contour` need.
/// @throws InputError  it is a solid.
[[nodiscard]] const Polygon& PolygonOf(const ObjectFile& file, const PlannerOptions& options);

/// The object as a solid, which the planners `polyhedron` and `roadmap` need.
/// @throws InputError  it is planar.
[[nodiscard]] const Polyhedron& SolidOf(const ObjectFile& file, const PlannerOptions& options);

}  // namespace regrasp
