#include "planner/base/number.h"
#include "planner/repair/invented_marks.h"
#include "planner/repair/repair.h"

namespace regrasp::repair {

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

/// Below a thousandth of a percent is rounding.
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

/// What is said alike of a solid and of a refusal.
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
  report["invented_share"] = InventedShare(repaired.solid);
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
  if (stage == "read" && !cloud) return "a solid as it is";
  const std::string before =
      cloud ? "a cloud of points" : std::to_string(repaired.facets_before) + " facets";
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
         " of the diameter, " + Percent(InventedShare(repaired.solid)) + " of the surface invented";
}

}  // namespace regrasp::repair
