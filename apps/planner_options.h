#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "apps/options.h"
#include "planner/base/deadline.h"
#include "planner/base/memory.h"
#include "planner/object/object.h"
#include "planner/planning/plan_request.h"

namespace regrasp::apps {

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

  /// @param automatic  what `--planner auto` takes, for the help.
  void AddTo(CLI::App& app, const std::string& automatic);

  /// Reads the object and says so while it does.
  /// @throws TimeUp  the deadline came.
  [[nodiscard]] object::ObjectFile ReadObjectFile(const Deadline& deadline = {}) const;

  /// What the options ask for, on an object; start and goal are left open.
  /// @throws InputError  friction is missing, doubled or out of range; more contact points than a
  ///                     plain roadmap takes, and no clusters.
  [[nodiscard]] planning::PlanRequest RequestFor(const object::Object& object) const;

  /// Bytes that a graph may take: UsableMemory, or any number with --force.
  [[nodiscard]] double memory() const;
  /// @throws InputError  the graph would take more than that.
  void CheckMemory(const MemoryNeed& need) const;
};

}  // namespace regrasp::apps
