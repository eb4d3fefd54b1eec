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
  std::string object;
  RepairOptions repair;
  std::optional<double> patch;  ///< radius, the object's unit; 0: none; nullopt: by the object
  double roughness_deg = 5;
  bool allow_invented = false;  ///< fingers on surface that a repair invented
  FrictionOptions friction;
  ContactOptions contact;
  std::string planner = "auto";
  planning::Spanning spanning = planning::Spanning::kAdaptive;
  std::uint64_t seed = 0;
  std::optional<int> contacts;
  bool contacts_given = false;  ///< at the points that the object's file gives
  std::optional<int> clusters;
  double scale = 1;
  std::optional<double> time_limit_s;
  bool force = false;
  bool quiet = false;
  /// What a time limit counts from.
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();

  /// @param automatic  what `--planner auto` takes, for the help.
  void AddTo(CLI::App& app, const std::string& automatic);

  /// Reads the object, repairs it where that is asked, and says so.
  /// @throws TimeUp  the time limit came.
  /// @param program  that says so.
  [[nodiscard]] object::ObjectFile ReadObjectFile(const std::string& program) const;

  /// The points that contacts are to be at (PlanRequest::given_points); none where all of the
  /// surface takes them. Reads the object's file again.
  [[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> ReadGivenPoints() const;

  /// What a fingertip feels of the surface, where normals are to be taken with caution: --patch,
  /// and of repaired objects.
  [[nodiscard]] std::optional<object::FeltPatch> patch_felt() const;

  /// The patch's radius on an object, its unit of length, for the plan; none without a patch.
  [[nodiscard]] std::optional<double> PatchRadius(const object::Object& object) const;

  /// Writes where contacts are into the note of a plan over clustered contact points.
  void NotePlaces(plan::RoadmapNote& note) const;

  /// What the options ask for, on an object; start and goal are left open.
  /// @throws InputError  friction is missing, doubled or out of range; more contact points than a
  ///                     plain roadmap takes, and no clusters.
  [[nodiscard]] planning::PlanRequest RequestFor(const object::Object& object) const;

  /// The planner that is named, or the one that `auto` takes.
  /// @throws InputError  as registry::PlannerFor; its graph would take more than UsableMemory, and
  ///                     there is no --force.
  [[nodiscard]] const planning::Planner& PlannerFor(const planning::PlanRequest& request) const;

 private:
  void AddContacts(CLI::App& app);
  /// Radians: what is left of the friction once the patch's normals may be its facets'.
  [[nodiscard]] double PlannedHalfAngle() const;
  [[nodiscard]] Deadline deadline() const;
};

}  // namespace regrasp::apps
