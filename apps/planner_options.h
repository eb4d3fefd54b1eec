#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "apps/options.h"
#include "apps/repair_options.h"
#include "planner/base/deadline.h"
#include "planner/object/object.h"
#include "planner/object/reading.h"
#include "planner/plan/plan.h"
#include "planner/planning/planner.h"

namespace regrasp::apps {

/// The options that `plan` and `graph` have in common.
struct PlannerOptions {
  /// Program that has the options.
  enum class Purpose { kPlan, kGraph };

  std::string object;
  RepairOptions repair;
  std::optional<double>
      patch;  ///< radius, object units. 0 for none, nullopt for the default of the object
  double roughness_deg = 5;
  bool allow_invented = false;  ///< contacts on surface that a repair filled in
  FrictionOptions friction;
  ContactOptions contact;
  std::string planner = "auto";
  planning::Spanning spanning = planning::Spanning::kAdaptive;
  std::uint64_t seed = 0;
  std::optional<int> contacts;
  bool contacts_given = false;  ///< at the points that the object's file gives
  std::optional<int> clusters;
  bool fallback = true;                ///< search in the full contact set
  std::optional<std::int64_t> budget;  ///< search budget (PlanRequest::effort)
  int queries = 0;                     ///< random queries of `graph`
  double scale = 1;
  std::optional<double> time_limit_s;
  bool force = false;
  bool quiet = false;
  /// Start of the time limit.
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();

  void AddTo(CLI::App& app, Purpose purpose);

  /// Read the object, repair it if required, and report the repair.
  /// @throws TimeUp  if the time limit is reached.
  /// @param program  name of the program in messages.
  [[nodiscard]] object::ObjectFile ReadObjectFile(const std::string& program) const;

  /// Points that contacts must be at (PlanRequest::given_points); none if they are free. Reads the
  /// object's file again.
  [[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> ReadGivenPoints() const;

  /// Contact patch that bounds the error of normals, with --patch or for repaired objects.
  [[nodiscard]] std::optional<object::FeltPatch> patch_felt() const;

  /// The patch's radius on an object, its unit of length, for the plan; none without a patch.
  [[nodiscard]] std::optional<double> PatchRadius(const object::Object& object) const;

  /// Writes where contacts are into the note of a plan over clustered contact points.
  void NotePlaces(plan::RoadmapNote& note) const;

  /// Request of the options for an object, without start and goal.
  /// @throws InputError  friction is missing, doubled or out of range; more contact points than a
  ///                     plain roadmap takes, and no clusters.
  [[nodiscard]] planning::PlanRequest RequestFor(const object::Object& object) const;

  /// The planner that is named, or the one that `auto` takes.
  /// @throws InputError  as registry::PlannerFor; its graph would take more than UsableMemory, and
  ///                     --allow large-graph is not given.
  [[nodiscard]] const planning::Planner& PlannerFor(const planning::PlanRequest& request) const;

 private:
  void AddPlanner(CLI::App& app, Purpose purpose);
  /// Friction angle minus the roughness, radians.
  [[nodiscard]] double PlannedHalfAngle() const;
  [[nodiscard]] Deadline deadline() const;
};

}  // namespace regrasp::apps
