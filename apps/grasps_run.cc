#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/grasp_table.h"
#include "apps/output_files.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/validate_run.h"
#include "apps/validate_task.h"
#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/in_blocks.h"
#include "planner/base/number.h"
#include "planner/base/text_table.h"
#include "planner/base/zip_archive.h"
#include "planner/grasp/force_closure.h"
#include "planner/plan/projection.h"
#include "sim/validation/validation.h"

namespace regrasp::apps {

namespace {

/// Version of the file format.
/// Version 2 has `valid` and `is_force_closure` instead of `holds`.
constexpr double kVerdictsVersion = 2;

/// Last reason in the enumeration that a single grasp can fail for.
constexpr auto kLastReason = plan::Reason::kObjectMoved;

/// A contact that is off the surface, with the indices of its grasp and contact.
struct OffSurface {
  std::size_t grasp;
  int contact;
  Eigen::Vector3d point;
};

/// Verdicts of all grasps of a file. Only grasps on the object are checked.
struct Verdicts {
  std::vector<double> is_force_closure, valid, too_close, margin, required_deg, quality, reason,
      replayed;
  std::optional<OffSurface> off_surface;  ///< contact of the first grasp that has one

  explicit Verdicts(std::size_t count)
      : is_force_closure(count, 0),
        valid(count, 0),
        too_close(count, 0),
        margin(count, std::numeric_limits<double>::quiet_NaN()),
        required_deg(margin),
        quality(margin),
        reason(count, 0),
        replayed(count, 0) {}
};

/// Grasps of a group whose contacts are on the object.
struct PlacedGrasps {
  std::vector<std::size_t> places;  ///< index of each grasp among all grasps
  std::vector<double> points, normals;
};

void NoteOffSurface(const GraspGroup& group, std::size_t i, int contact, Verdicts& verdicts) {
  if (verdicts.off_surface && verdicts.off_surface->grasp < group.places[i]) return;
  const std::size_t at =
      i * static_cast<std::size_t>(group.contacts) + static_cast<std::size_t>(contact);
  verdicts.off_surface = {group.places[i], group.fingers[at],
                          Eigen::Vector3d::Map(&group.points[3 * at])};
}

PlacedGrasps Place(const object::Object& object, const GraspGroup& group, Verdicts& verdicts) {
  const plan::ProjectedGrasps projected =
      plan::ProjectGrasps(object, group.points, group.normals, group.contacts);
  const auto values = 3 * static_cast<std::size_t>(group.contacts);
  PlacedGrasps placed;
  for (std::size_t i = 0; i < group.places.size(); ++i) {
    verdicts.reason[group.places[i]] = static_cast<double>(projected.reasons[i]);
    if (projected.reasons[i] == plan::Reason::kOffSurface) {
      NoteOffSurface(group, i, projected.contacts[i], verdicts);
    }
    if (projected.reasons[i] != plan::Reason::kNone) continue;
    placed.places.push_back(group.places[i]);
    const auto begin = static_cast<std::ptrdiff_t>(i * values);
    const auto end = begin + static_cast<std::ptrdiff_t>(values);
    placed.points.insert(placed.points.end(), projected.points.begin() + begin,
                         projected.points.begin() + end);
    placed.normals.insert(placed.normals.end(), projected.normals.begin() + begin,
                          projected.normals.begin() + end);
  }
  return placed;
}

void Judge(const object::Object& object, const PlacedGrasps& placed, int contacts,
           const ValidateOptions& options, Verdicts& verdicts) {
  grasp::JudgeOptions judge;
  judge.friction_angle = options.friction.required_friction_angle();
  judge.frame = object.wrench_frame();
  judge.torsion = options.contact.torsion().value_or(0);
  judge.required_friction_angle = options.required_angle;
  judge.quality = options.quality;
  const grasp::GraspVerdicts found =
      grasp::JudgeGrasps({placed.points, placed.normals, contacts}, judge);
  for (std::size_t i = 0; i < placed.places.size(); ++i) {
    const std::size_t g = placed.places[i];
    const grasp::Decision decision = found.force_closure[i].decision;
    verdicts.is_force_closure[g] = decision == grasp::Decision::kYes ? 1 : 0;
    verdicts.valid[g] = verdicts.is_force_closure[g];
    verdicts.too_close[g] = decision == grasp::Decision::kTooClose ? 1 : 0;
    verdicts.margin[g] = found.force_closure[i].margin_lower;
    if (options.required_angle)
      verdicts.required_deg[g] = Degrees(found.required_friction_angle[i]);
    if (options.quality) verdicts.quality[g] = found.quality[i];
    if (decision != grasp::Decision::kYes) {
      verdicts.reason[g] = static_cast<double>(plan::Reason::kNotForceClosure);
    }
  }
}

grasp::Grasp GraspAt(const PlacedGrasps& placed, int contacts, std::size_t i) {
  grasp::Grasp grasp;
  for (int c = 0; c < contacts; ++c) {
    const std::size_t at =
        3 * (i * static_cast<std::size_t>(contacts) + static_cast<std::size_t>(c));
    grasp.push_back(
        {Eigen::Vector3d::Map(&placed.points[at]), Eigen::Vector3d::Map(&placed.normals[at])});
  }
  return grasp;
}

/// Simulate the force-closure grasps in MuJoCo, with the disturbance test.
/// Each grasp has a separate simulation. All cores are used.
void Replay(const object::Object& object, const PlacedGrasps& placed, int contacts,
            const ValidateOptions& options, ProgressLine& progress, Verdicts& verdicts) {
  const validation::ValidationOptions given = ValidationOptionsOf(options);
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < placed.places.size(); ++i) {
    if (verdicts.is_force_closure[placed.places[i]] == 1) held.push_back(i);
  }
  std::size_t done = 0;
  std::mutex telling;
  InBlocks(held.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t g = placed.places[held[k]];
      const plan::Plan hold = validation::MakeHoldPlan(object, GraspAt(placed, contacts, held[k]),
                                                       options.friction.required_friction_angle(),
                                                       options.scale.value_or(1));
      const validation::Report report =
          validation::Validate({.object = object, .plan = hold, .options = given}).report;
      verdicts.reason[g] = static_cast<double>(report.steps.front().reason());
      verdicts.valid[g] = report.passed() ? 1 : 0;
      verdicts.replayed[g] = 1;
      const std::lock_guard lock(telling);
      progress.Report("replayed " + std::to_string(++done) + " of " + std::to_string(held.size()) +
                      " grasps of " + std::to_string(contacts) + " contacts");
    }
  });
}

Verdicts JudgeAll(const object::Object& object, const GraspTable& table,
                  const ValidateOptions& options, ProgressLine& progress) {
  Verdicts verdicts(table.count);
  // Default reason, which remains for grasps that are not force closure.
  verdicts.reason.assign(table.count, static_cast<double>(plan::Reason::kNotForceClosure));
  for (const GraspGroup& group : table.groups) {
    const PlacedGrasps placed = Place(object, group, verdicts);
    Judge(object, placed, group.contacts, options, verdicts);
    if (options.replay_grasps) {
      Replay(object, placed, group.contacts, options, progress, verdicts);
    }
  }
  return verdicts;
}

/// Return the names of the codes in the array `reason`.
std::vector<std::string> ReasonWords() {
  std::vector<std::string> words;
  for (int i = 0; i <= static_cast<int>(kLastReason); ++i) {
    words.emplace_back(plan::ReasonName(static_cast<plan::Reason>(i)));
  }
  return words;
}

std::string FormatVerdicts(Verdicts verdicts, const ValidateOptions& options) {
  const std::size_t count = verdicts.valid.size();
  std::vector<NpzArray> arrays = {
      {"format_version", {}, {kVerdictsVersion}},
      {"is_force_closure", {count}, std::move(verdicts.is_force_closure), {}, true},
      {"valid", {count}, std::move(verdicts.valid), {}, true},
      {"too_close", {count}, std::move(verdicts.too_close), {}, true},
      {"margin", {count}, std::move(verdicts.margin)},
      {"reason", {count}, std::move(verdicts.reason)}};
  if (options.required_angle) {
    arrays.push_back({"required_angle_deg", {count}, std::move(verdicts.required_deg)});
  }
  if (options.quality) arrays.push_back({"quality", {count}, std::move(verdicts.quality)});
  if (options.replay_grasps) {
    arrays.push_back({"replayed", {count}, std::move(verdicts.replayed), {}, true});
  }
  const std::vector<std::string> words = ReasonWords();
  arrays.push_back({"reasons", {words.size()}, {}, words});
  return FormatNpz(arrays);
}

std::size_t Count(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::ranges::count(values, value));
}

/// Return the table for the terminal: the number of grasps per verdict.
std::string CountsText(const Verdicts& verdicts) {
  std::vector<TextRow> rows = {{"verdict", "grasps"}};
  const auto add = [&](const std::string& what, std::size_t n) {
    if (n > 0) rows.push_back({what, std::to_string(n)});
  };
  const std::size_t too_close = Count(verdicts.too_close, 1);
  add("pass", Count(verdicts.valid, 1));
  for (int i = 1; i <= static_cast<int>(kLastReason); ++i) {
    const auto reason = static_cast<plan::Reason>(i);
    const bool closure = reason == plan::Reason::kNotForceClosure;
    add("fail: " + std::string(plan::ReasonName(reason)),
        Count(verdicts.reason, i) - (closure ? too_close : 0));
    if (closure) add("fail: not-force-closure, too close to call", too_close);
  }
  return FormatRows(rows);
}

/// Return the line about the first contact off the surface; empty if none is.
/// Example: "off-surface: grasp 3, contact 1 (the first): off the surface, expected at most …".
std::string OffSurfaceLine(const object::Object& object, const Verdicts& verdicts) {
  if (!verdicts.off_surface) return "";
  const OffSurface& first = *verdicts.off_surface;
  return "off-surface: grasp " + std::to_string(first.grasp) + ", contact " +
         std::to_string(first.contact) +
         " (the first): " + plan::OffSurfaceText(object, first.point) + "\n";
}

}  // namespace

int RunGrasps(const ValidateOptions& options) {
  Stopwatch watch;
  CheckOutputs(options);
  ProgressLine progress(options.quiet);
  const object::ObjectFile object = ReadGraspObject(options, progress);
  CheckTorsionFits(options, *object.object);
  progress.Report("reading " + options.grasps_path);
  const GraspTable table = ReadGrasps(options.grasps_path, object.object->dimension());
  progress.Report("judging " + std::to_string(table.count) + " grasps");
  Verdicts verdicts = JudgeAll(*object.object, table, options, progress);
  progress.Clear();
  const std::string counts = CountsText(verdicts) + OffSurfaceLine(*object.object, verdicts);
  const bool passed = Count(verdicts.valid, 1) == table.count;
  std::error_code error;
  std::filesystem::create_directories(options.Folder(), error);
  if (error)
    throw EnvironmentError(options.Folder().string() + ": cannot be created: " + error.message());
  const std::filesystem::path file = options.Folder() / kVerdictsName;
  WriteFile(file, FormatVerdicts(std::move(verdicts), options));
  if (!options.quiet) {
    std::cout << counts << "files: " << file.string() << "\n"
              << "time: " << FormatShort(watch.Lap(), 2) << " s for " << table.count
              << " grasps of " << table.contacts << " contacts\n"
              << "verdict: " << (passed ? "pass" : "fail") << "\n";
  }
  return passed ? kExitDone : kExitNegative;
}

}  // namespace regrasp::apps
