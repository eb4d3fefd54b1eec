#include "planner/repair/repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/repair/comparison.h"
#include "planner/repair/repair_pipeline.h"

namespace regrasp::repair {

using object::PolygonSoup;

namespace {

/// Return how little the user can do about a shortfall; 0 is the most actionable.
int RankOf(Shortfall shortfall) {
  switch (shortfall) {
    case Shortfall::kNotChosen:
      return 0;  // the user can select a solid
    case Shortfall::kNotAllThere:
    case Shortfall::kSheet:
      return 1;  // the user can scan the missing surface, or give a sheet a wall
    case Shortfall::kTooFar:
      return 2;  // the user can allow a deviation
    default:
      return 3;
  }
}

/// Return the stage with the most actionable outcome; the last stage if none is actionable.
const StageReport& MostHelpful(const Attempt& attempt) {
  const auto found = std::ranges::min_element(attempt.stages, {}, [](const StageReport& stage) {
    return std::pair(RankOf(stage.shortfall), stage.deviation);
  });
  return RankOf(found->shortfall) == RankOf(Shortfall::kNoResult) ? attempt.stages.back() : *found;
}

/// Orient a solid outwards.
/// The reader accepts inward solids, but other programs do not.
void TurnOutwards(PolygonSoup& solid) {
  const Eigen::Vector3d& from = solid.vertices[solid.facets[0][0]];
  double volume = 0;
  for (const auto& facet : solid.facets) {
    const Eigen::Vector3d a = solid.vertices[facet[0]] - from;
    for (std::size_t k = 1; k + 1 < facet.size(); ++k) {
      volume += a.dot((solid.vertices[facet[k]] - from).cross(solid.vertices[facet[k + 1]] - from));
    }
  }
  if (volume >= 0) return;
  for (auto& facet : solid.facets) std::ranges::reverse(facet);
}

std::string RefusalText(const std::string& name, const Attempt& attempt) {
  const StageReport& cause = MostHelpful(attempt);
  return name + ": not repaired: " + cause.stage + ": " + cause.outcome;
}

}  // namespace

NotRepaired::NotRepaired(const std::string& name, Attempt attempt)
    : InputError(RefusalText(name, attempt)), attempt_(std::move(attempt)) {}

Repaired Repair(const PolygonSoup& soup, const std::string& name,
                const object::RepairOptions& asked, const object::Reading& reading) {
  object::RepairOptions options = asked;
  if (reading.shells == object::Shells::kLargest) options.part = options.part.value_or(1);
  PipelineResult pipeline_result = RunRepairPipeline(soup, name, options, reading);
  if (!pipeline_result.solid) throw NotRepaired(name, std::move(pipeline_result.attempt));
  Repaired repaired{std::move(pipeline_result.attempt), *std::move(pipeline_result.solid), 0,
                    std::move(pipeline_result.comparison)};
  if (repaired.solid.filled.empty()) {
    // Both sides of a sheet are off its original, so the comparison would mark all of it.
    MarkFilled(soup, options.thickness ? Comparison() : repaired.comparison, repaired.solid);
  }
  FilledLast(repaired.solid);
  TurnOutwards(repaired.solid);
  object::Reading silent;
  silent.deadline = reading.deadline;
  silent.shells = reading.shells;
  repaired.volume =
      object::Polyhedron::FromSoup(repaired.solid, name, silent).mass_properties().volume;
  return repaired;
}

std::string RepairHint(const std::filesystem::path& path, const object::Reading& reading) {
  /// Largest delay of an error message by the trial repair.
  constexpr double kSeconds = 20;
  object::Reading limited = reading;
  const Deadline own = DeadlineAfter(Deadline::Clock::now(), kSeconds);
  if (!reading.deadline.left() || *own.left() < *reading.deadline.left()) limited.deadline = own;
  try {
    const Repaired repaired =
        Repair(object::ReadSoup(path, limited).soup, path.string(), {}, limited);
    return "; help: --repair produces a solid: " + RepairText(repaired);
  } catch (const NotRepaired& refusal) {
    return "; --repair does not produce a solid: " + MostHelpful(refusal.attempt()).outcome;
  } catch (const InputError&) {
    return "; --repair does not produce a solid";
  } catch (const TimeUp&) {
    return "; help: try regrasp repair";
  }
}

object::ObjectFile ReadRepaired(const std::filesystem::path& path,
                                const object::RepairOptions& options,
                                const object::Reading& reading, std::string* text) {
  const object::SoupFile file = object::ReadSoup(path, reading);
  const Repaired repaired = Repair(file.soup, path.string(), options, reading);
  if (text != nullptr) *text = RepairText(repaired);
  return {file.file, file.sha256,
          std::make_unique<object::Polyhedron>(
              object::Polyhedron::FromSoup(repaired.solid, path.string(), reading)),
          object::RepairRecord{options, Sha256(FormatSolid(repaired.solid))}, file.soup.unit};
}

std::string FormatSolid(const object::PolygonSoup& solid) {
  std::string text = "# repaired solid\n";
  for (const auto& v : solid.vertices) {
    text +=
        "v " + FormatDouble(v.x()) + " " + FormatDouble(v.y()) + " " + FormatDouble(v.z()) + "\n";
  }
  for (const bool filled : {false, true}) {
    bool named = false;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
      if ((!solid.filled.empty() && solid.filled[f]) != filled) continue;
      if (!named) text += filled ? "g invented\n" : "g original\n";
      named = true;
      text += "f";
      for (const int v : solid.facets[f]) text += " " + std::to_string(v + 1);
      text += "\n";
    }
  }
  return text;
}

namespace {

Json SummaryJson(const DistanceSummary& summary, double diameter) {
  const auto length = [&](double value) {
    return Json{{"units", value}, {"over_diameter", value / diameter}};
  };
  return {{"mean", length(summary.mean)},
          {"p95", length(summary.most)},
          {"largest", length(summary.largest)},
          {"bound", length(summary.bound)},
          {"where", {summary.where.x(), summary.where.y(), summary.where.z()}}};
}

/// Format a share. Values below 0.001 % are rounding errors.
std::string Percent(double share) {
  constexpr double kRounding = 1e-5;
  return share < kRounding ? "0 %" : FormatShort(100 * share, 3) + " %";
}

Json StagesJson(const std::vector<StageReport>& stages) {
  Json list = Json::array();
  for (const StageReport& stage : stages) {
    list.push_back({{"stage", stage.stage},
                    {"outcome", stage.outcome},
                    {"facets", stage.facets},
                    {"did", stage.facts}});
  }
  return list;
}

template <class T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// Return the part of a report that solids and failed repairs have in common.
Json AttemptJson(const Attempt& attempt, const object::SoupFile& file,
                 const object::RepairOptions& options) {
  Json report;
  report["object"] = {{"file", file.file}, {"sha256", file.sha256}};
  report["options"] = {{"max_deviation", options.max_deviation},
                       {"facets", OrNull(options.facets)},
                       {"part", OrNull(options.part)},
                       {"thickness", OrNull(options.thickness)}};
  report["stages"] = StagesJson(attempt.stages);
  report["facets_before"] = attempt.facets_before;
  report["diameter"] = attempt.diameter;
  return report;
}

}  // namespace

Json RepairReport(const Repaired& repaired, const object::SoupFile& file,
                  const object::RepairOptions& options) {
  const Comparison& c = repaired.comparison;
  constexpr double kDegrees = 57.29577951308232;
  Json report = AttemptJson(repaired, file, options);
  report["verdict"] = "solid";
  report["facets_after"] = repaired.solid.facets.size();
  report["volume"] = repaired.volume;
  report["deviation_over_diameter"] = c.seen_most / repaired.diameter;
  report["seen_share"] = c.seen_share;
  report["original_to_solid"] = SummaryJson(c.to_solid, repaired.diameter);
  report["solid_to_original"] = SummaryJson(c.to_original, repaired.diameter);
  report["normals"] = {{"mean_deg", c.normal_mean * kDegrees},
                       {"p95_deg", c.normal_most * kDegrees}};
  report["invented_share"] = FilledShare(repaired.solid);
  return report;
}

Json RefusalReport(const NotRepaired& refusal, const object::SoupFile& file,
                   const object::RepairOptions& options) {
  Json report = AttemptJson(refusal.attempt(), file, options);
  report["verdict"] = "refused";
  report["reason"] = refusal.what();
  return report;
}

std::string RepairText(const Repaired& repaired) {
  const std::string& stage = repaired.stages.back().stage;
  const bool cloud = repaired.facets_before == 0;
  if (stage == "read" && !cloud) return "already a solid";
  const std::string before =
      cloud ? "a point cloud" : std::to_string(repaired.facets_before) + " facets";
  std::string text =
      before + ", " + std::to_string(repaired.solid.facets.size()) + " after the repair (";
  bool first = true;
  for (const StageReport& tried : repaired.stages) {
    if (tried.stage == "read" || tried.facets == 0) continue;
    text += (first ? "" : ", ") + tried.stage;
    first = false;
  }
  const double d = repaired.diameter;
  return text + "); deviation " + Percent(repaired.comparison.seen_most / d) +
         " of the diameter, " + Percent(FilledShare(repaired.solid)) + " of the surface filled in";
}

}  // namespace regrasp::repair
