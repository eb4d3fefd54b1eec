#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "apps/options.h"
#include "apps/repair_module.h"
#include "planner/base/deadline.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/planning/planner.h"

namespace regrasp::apps {

/// Options that `plan` and `graph` have in common.
struct PlannerOptions {
  /// Program that has the options.
  enum class Purpose { kPlan, kGraph };

  std::string object;
  RepairOptions repair;
  std::optional<double>
      /// contact patch radius, object units; 0: none, nullopt: default
      patch;
  double roughness_deg = 5;
  bool allow_filled = false;  ///< whether contacts may be on filled surfaces
  FrictionOptions friction;
  ContactOptions contact;
  std::string planner = "auto";
  planning::Spanning spanning = planning::Spanning::kAdaptive;
  std::uint64_t seed = 0;
  std::optional<int> contacts;
  bool contacts_given = false;  ///< whether contacts are at the points of the object's file
  std::optional<int> clusters;
  bool fallback = true;                ///< whether to search in the full contact set
  std::optional<std::int64_t> budget;  ///< search budget (SearchParameters::budget)
  int queries = 0;                     ///< number of random queries of `graph`
  int focus_points = 0;                ///< number of random focus points of `graph`; 0: none
  bool compare = false;  ///< whether `graph` compares the cells of these points with all cells
  double scale = 1;
  std::optional<double> time_limit_s;
  bool force = false;
  bool quiet = false;
  /// Start of the time limit.
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();

  void AddTo(CLI::App& app, Purpose purpose);

  /// Read the object, repair it if required, and report the repair.
  /// @param program  name of the program in messages.
  /// @throws TimeUp  if the time limit is reached.
  [[nodiscard]] object::ObjectFile ReadObjectFile(const std::string& program) const;

  /// Read the points that contacts must be at; nullopt if contacts are free.
  /// The points are in the object's file, which is read again.
  [[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> ReadGivenPoints() const;

  /// Contact patch that bounds the error of normals; nullopt without a patch.
  /// There is one with --patch and for repaired objects.
  [[nodiscard]] std::optional<object::FeltPatch> patch_felt() const;

  /// Return the radius of the contact patch on an object; nullopt without a patch.
  /// The radius is in the object's unit of length.
  [[nodiscard]] std::optional<double> PatchRadius(const object::Object& object) const;

  /// Write the constraints on contact locations into a plan's roadmap note.
  /// These are the roughness of the contact patch and whether filled surfaces are allowed.
  void NotePlaces(plan::RoadmapNote& note) const;

  /// Return the request for an object, without start and goal.
  /// @throws InputError  if the friction is missing, given twice or out of range, or the roughness
  ///     is not less than the friction angle.
  [[nodiscard]] planning::PlanRequest RequestFor(const object::Object& object) const;

  /// Return the named planner, or the one that `auto` selects.
  /// @throws InputError  as registry::PlannerFor, or if its graph needs more than UsableMemory and
  ///     --allow large-graph is not given.
  [[nodiscard]] const planning::Planner& PlannerFor(const planning::PlanRequest& request) const;

 private:
  void AddPlanner(CLI::App& app, Purpose purpose);
  /// Friction angle minus the roughness, radians.
  [[nodiscard]] double PlannedFrictionAngle() const;
  [[nodiscard]] Deadline deadline() const;
};

}  // namespace regrasp::apps
