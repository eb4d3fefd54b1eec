#include "planner/repair/repair_pipeline.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/body_measures.h"
#include "planner/object/mesh_survey.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/polyhedron.h"
#include "planner/object/weld.h"
#include "planner/repair/comparison.h"
#include "planner/repair/repair.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

using object::PolygonSoup;

namespace {

constexpr char kIsSolid[] = "solid";

/// Deviation over the diameter at which a solid ends the repair. A solid with a larger deviation is
/// used only if no later stage gives a closer one.
constexpr double kCloseEnough = 0.002;

/// Volume ratio of a fine to a coarse wrap of an open surface. Below it the fine wrap has entered a
/// hollow object and encloses only its wall.
constexpr double kLeastLeft = 0.5;

/// Return whether a stage can improve a surface.
bool Applies(std::string_view stage, const PolygonSoup& soup) {
  if (stage == "fill-holes") return HasOpenEdges(soup);
  if (stage == "unite-shells") return CountShells(soup) > 1;
  if (stage == "arrange") return !HasOpenEdges(soup);
  return true;
}

/// Merge vertices with equal coordinates: STL lists each vertex once per triangle. Polygons without
/// area are then dropped. A soup with different vertices is unchanged.
PolygonSoup Merged(const PolygonSoup& soup, const std::string& name) {
  object::WeldedSoup welded = object::WeldVertices(soup, name);
  if (welded.vertices.size() == soup.vertices.size()) return soup;
  PolygonSoup merged = soup;
  merged.vertices = std::move(welded.vertices);
  merged.facets.clear();
  merged.filled.clear();
  for (std::size_t f = 0; f < welded.facets.size(); ++f) {
    if (welded.facets[f].empty()) continue;
    merged.facets.push_back(std::move(welded.facets[f]));
    if (!soup.filled.empty()) merged.filled.push_back(soup.filled[f]);
  }
  return merged;
}

class RepairPipeline {
 public:
  RepairPipeline(const PolygonSoup& soup, const std::string& name,
                 const object::RepairOptions& options, const object::Reading& reading)
      : soup_(soup), name_(name), options_(options), reading_(reading) {
    result_.attempt.facets_before = soup.facets.size();
    result_.attempt.diameter = object::ComputeDiameter(soup.vertices);
  }

  PipelineResult Run() {
    if (!(JoinsPoints() && MakesSolid() && MakesCoarser())) result_.solid.reset();
    return std::move(result_);
  }

 private:
  // Each of the following functions returns false if the repair ends without a solid.

  /// Convert a point cloud to a surface.
  bool JoinsPoints() {
    if (!soup_.facets.empty()) return true;
    auto surface = Run("reconstruct", [&] { return ReconstructSurface(soup_); });
    if (!surface) return false;
    if (last().facts["scatter"].get<double>() > kMostScatter) {
      last().outcome =
          "points too noisy: their scatter about the surface equals their distance; "
          "help: smooth or average them first";
      return false;
    }
    last().outcome = "a surface";
    soup_ = *std::move(surface);
    return true;
  }

  bool MakesSolid() {
    if (!options_.thickness && TakesAsItIs()) return true;
    if (!Cleans()) return false;
    return options_.thickness ? MakesSheet() : RunsStages();
  }

  bool Cleans() {
    auto clean = Run("clean", [&] { return CleanSurface(soup_); });
    if (!clean) return false;
    const bool open = HasOpenEdges(*clean);
    original_ = {*std::move(clean), result_.attempt.diameter, open};
    return true;
  }

  /// Return whether the reader accepts the surface of the file, so that no repair is required.
  bool TakesAsItIs() {
    result_.attempt.stages.emplace_back();
    last().stage = "read";
    last().facets = soup_.facets.size();
    if (!Passes(JudgeSurface(soup_, reading_))) return false;
    result_.solid = Merged(soup_, name_);  // keeps the marks of an earlier repair
    result_.comparison.seen_share = 1;     // all differences are zero
    return true;
  }

  bool RunsStages() {
    if (IsCloseEnough(original_.soup)) return true;
    PolygonSoup best = original_.soup;
    using Stage = StageResult (*)(const PolygonSoup&);
    for (const auto& [name, stage] : {std::pair<const char*, Stage>("fill-holes", FillHoles),
                                      {"unite-shells", UniteShells},
                                      {"remove-crossings", RemoveCrossings},
                                      {"arrange", ArrangeSurface}}) {
      if (!Applies(name, best)) continue;
      auto made = Run(name, [&] { return stage(best); });
      if (!made) continue;
      if (IsCloseEnough(*made)) return true;
      // These two stages remove surface, which the following stages require.
      const std::string_view stage_name = name;
      if (stage_name != "remove-crossings" && stage_name != "arrange") best = *std::move(made);
    }
    return Wraps(best) || HasClosest();
  }

  bool Wraps(const PolygonSoup& best) {
    if (WrapIsCloseEnough("wrap", best)) return true;
    // The filling of a wide hole can hide surface that is visible through the hole. A wrap of the
    // unfilled surface keeps it visible, unless the wrap enters a hollow object.
    const bool hides = last().shortfall == Shortfall::kTooFar && !HasOpenEdges(best);
    return !closest_ && hides && original_.open &&
           WrapIsCloseEnough("wrap-unfilled", original_.soup);
  }

  bool WrapIsCloseEnough(const std::string& stage, const PolygonSoup& surface) {
    auto made = Run(stage, [&] { return WrapSurface(surface); });
    if (!made) return false;
    const Json& volumes = last().facts["volumes"];  // coarser wrap first
    const double left =
        volumes.back()["volume"].get<double>() / volumes.front()["volume"].get<double>();
    if (HasOpenEdges(surface) && left < kLeastLeft) {
      last().shortfall = Shortfall::kSheet;
      last().outcome = "open sheet: a wrap enters it and keeps " + FormatShort(100 * left, 3) +
                       " % of the volume of a coarser one; help: --repair wall=T gives it a wall";
      return false;
    }
    return IsCloseEnough(*std::move(made));
  }

  /// Return whether the result of the last stage ends the repair.
  /// A solid that is not close enough is stored if it is closer than all earlier ones.
  bool IsCloseEnough(PolygonSoup soup) {
    std::optional<Comparison> comparison = Judge(soup);
    if (!comparison) return false;
    const double deviation = comparison->seen_most / original_.diameter;
    const bool is_close = deviation <= kCloseEnough;
    if (!closest_ || deviation < closest_->comparison.seen_most / original_.diameter) {
      closest_ = {result_.attempt.stages, std::move(soup), *std::move(comparison)};
    }
    if (is_close) return HasClosest();
    last().facts["deviation_over_diameter"] = deviation;
    return false;
  }

  /// End the repair with the closest solid, if there is one.
  /// The report then ends with the stage of this solid, which lists solids of other stages as
  /// farther off.
  bool HasClosest() {
    if (!closest_) return false;
    std::vector<StageReport>& stages = result_.attempt.stages;
    Json others = Json::array();
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (stages[i].outcome != kIsSolid || i + 1 == closest_->stages.size()) continue;
      others.push_back({{"stage", stages[i].stage},
                        {"deviation_over_diameter", stages[i].facts["deviation_over_diameter"]}});
    }
    stages = std::move(closest_->stages);
    for (std::size_t i = 0; i + 1 < stages.size(); ++i) {
      if (stages[i].outcome == kIsSolid) stages[i].outcome = "a solid, but a later stage is closer";
    }
    if (!others.empty()) last().facts["farther_off"] = others;
    result_.solid = std::move(closest_->solid);
    result_.comparison = std::move(closest_->comparison);
    return true;
  }

  bool MakesSheet() {
    const auto sheet =
        Run("solidify", [&] { return Solidify(original_.soup, *options_.thickness); });
    return sheet && Accepts(*sheet);
  }

  bool MakesCoarser() {
    if (!options_.facets || std::ssize(result_.solid->facets) <= *options_.facets) return true;
    if (original_.soup.facets.empty()) {  // the file is a solid: only its triangles are required
      if (!Cleans()) return false;
      result_.attempt.stages.pop_back();
      result_.solid = original_.soup;
    }
    if (HasOpenEdges(*result_.solid)) {  // the reader closes gaps of the size of rounding errors
      auto closed = Run("fill-holes", [&] { return FillHoles(*result_.solid); });
      if (!closed || !Accepts(*std::move(closed))) return false;
    }
    PolygonSoup fine = *result_.solid;
    MarkFilled(soup_, result_.comparison, fine);
    const auto coarse = Run("simplify", [&] { return Simplify(fine, *options_.facets); });
    if (!coarse) return false;
    if (std::ssize(coarse->facets) > *options_.facets) {
      last().outcome = "at most " + std::to_string(*options_.facets) + " triangles expected, " +
                       std::to_string(coarse->facets.size()) + " remain";
    } else if (Accepts(*coarse, &fine)) {
      return true;
    }
    last().outcome += "; help: use a larger --repair max-triangles";
    return false;
  }

  /// Return the time limit of a stage.
  /// UniteShells can loop forever if shells touch along edges. It takes 5 s for 23,000 triangles,
  /// and later stages can replace it.
  static std::chrono::seconds TimeOf(std::string_view stage) {
    return stage == "unite-shells" ? std::chrono::seconds(60) : kStageTime;
  }

  /// Run a stage and append its report.
  /// @returns nullopt if the stage fails; the report has the reason.
  std::optional<PolygonSoup> Run(const std::string& stage,
                                 const std::function<StageResult()>& task) {
    reading_.Begin("repairing " + name_ + ": " + stage);
    StageRun run = RunStage(task, reading_.deadline, TimeOf(stage));
    StageReport& report = result_.attempt.stages.emplace_back();
    report.stage = stage;
    report.outcome = run.failure;
    if (!run.result) return std::nullopt;
    report.facts = std::move(run.result->facts);
    report.facets = run.result->soup.facets.size();
    return InCanonicalOrder(run.result->soup);
  }

  /// Check the result of the last stage; of several solids the selected one.
  /// @param fine  for a simplified solid, the solid before simplification with its marks. A coarse
  ///     solid is far from the original by nature; therefore its filled surface is that of `fine`.
  /// @returns the comparison with the original; nullopt if the check fails.
  std::optional<Comparison> Judge(PolygonSoup& soup, const PolygonSoup* fine = nullptr) {
    Judgement judgement = JudgeSurface(soup, reading_);
    Passes(judgement);
    std::optional<PolygonSoup> its_original;
    if (judgement.shortfall == Shortfall::kSeveralSolids) {
      const PolygonSoup all = soup;
      if (!TakesPart(soup)) return std::nullopt;
      judgement = JudgeSurface(soup, reading_);
      // Solids that the user excludes by `options.part` do not count as missing.
      if (options_.part) its_original = OriginalOfPart(original_.soup, all, soup);
    }
    if (!Passes(judgement)) return std::nullopt;
    reading_.Begin("repairing " + name_ + ": measuring the changes");
    Comparison comparison =
        Compare(its_original ? *its_original : original_.soup, soup, original_.diameter);
    if (fine != nullptr) {
      PolygonSoup marked = soup;
      MarkFilled(*fine, {}, marked);
      comparison.filled = marked.filled;
      comparison.filled_share = FilledShare(marked);
    }
    if (!Passes(JudgeShape(comparison, original_, options_))) return std::nullopt;
    return comparison;
  }

  /// Use the result of the last stage if `Judge` accepts it.
  /// @param fine  as in `Judge`.
  bool Accepts(PolygonSoup soup, const PolygonSoup* fine = nullptr) {
    std::optional<Comparison> comparison = Judge(soup, fine);
    if (!comparison) return false;
    result_.solid = std::move(soup);
    result_.comparison = *std::move(comparison);
    return true;
  }

  /// Select one of several separate solids.
  bool TakesPart(PolygonSoup& soup) {
    auto part = Run("take-part", [&] { return TakePart(soup, options_.part.value_or(1)); });
    if (!part) {
      last().shortfall = Shortfall::kNotChosen;
      return false;
    }
    const auto shares = last().facts["volume_shares"].get<std::vector<double>>();
    soup = *std::move(part);
    return Passes(JudgeParts(shares, options_));
  }

  /// Store a verdict on the result of the last stage in its report.
  bool Passes(const Judgement& judgement) {
    last().shortfall = judgement.shortfall;
    last().outcome = judgement.passes() ? kIsSolid : judgement.complaint;
    last().deviation = judgement.deviation;
    return judgement.passes();
  }

  StageReport& last() { return result_.attempt.stages.back(); }

  PolygonSoup soup_;
  const std::string& name_;
  const object::RepairOptions& options_;
  const object::Reading& reading_;
  Original original_;
  PipelineResult result_;
  /// Closest solid so far.
  struct Closest {
    std::vector<StageReport> stages;  ///< stages up to and including the one that made the solid
    PolygonSoup solid;
    Comparison comparison;
  };
  std::optional<Closest> closest_;
};

}  // namespace

PipelineResult RunRepairPipeline(const PolygonSoup& soup, const std::string& name,
                                 const object::RepairOptions& options,
                                 const object::Reading& reading) {
  return RepairPipeline(soup, name, options, reading).Run();
}

namespace {

std::string PercentOf(double share) { return FormatShort(100 * share, 3) + " %"; }

}  // namespace

Judgement JudgeSurface(const object::PolygonSoup& soup, const object::Reading& asked) {
  object::Reading reading;
  reading.deadline = asked.deadline;
  reading.counts_defects = false;
  // Shells::kLargest is not passed on: the stage take-part selects the largest solid, so that the
  // matching part of the original is known.
  if (asked.shells == object::Shells::kUnion) reading.shells = asked.shells;
  const std::string name = "surface";
  try {
    (void)object::Polyhedron::FromSoup(soup, name, reading);
    return {};
  } catch (const object::MeshError& error) {
    const bool several = error.defect() == object::MeshDefect::kSeveralSolids;
    const std::string_view message = error.what();
    return {several ? Shortfall::kSeveralSolids : Shortfall::kNoSolid,
            std::string(message.substr(name.size() + 2))};  // ": "
  }
}

Judgement JudgeParts(const std::vector<double>& volume_shares,
                     const object::RepairOptions& options) {
  if (options.part || volume_shares.size() < 2 || volume_shares[1] <= kSmallPart) return {};
  return {Shortfall::kNotChosen, std::to_string(volume_shares.size()) + " separate solids, with " +
                                     object::SharesText(volume_shares) +
                                     " of the volume; help: --repair part=K selects one (1: the "
                                     "largest), --shells union unites "
                                     "all"};
}

Judgement JudgeShape(const Comparison& comparison, const Original& original,
                     const object::RepairOptions& options) {
  const double deviation = comparison.seen_most / original.diameter;
  if (deviation > options.max_deviation + options.thickness.value_or(0) / 2 / original.diameter) {
    return {Shortfall::kTooFar,
            "the solid deviates too much: 95 % of the visible surface is within " +
                PercentOf(deviation) + " of the diameter, limit " +
                PercentOf(options.max_deviation) + " (--repair max-deviation)",
            deviation};
  }
  if (options.thickness) return {};
  if (comparison.filled_share > kMostFilled) {
    return {Shortfall::kNotAllThere,
            "surface incomplete: " + PercentOf(comparison.filled_share) +
                " of the solid would be filled in, limit " + PercentOf(kMostFilled) +
                "; help: scan the other sides too, or give an open sheet a wall "
                "(--repair wall=T)"};
  }
  if (original.open && comparison.thin_share > kMostThin) {
    return {Shortfall::kSheet, "open sheet: " + PercentOf(comparison.thin_share) +
                                   " of the solid would be thinner than " + PercentOf(kThinWall) +
                                   " of the diameter; help: --repair wall=T gives it a wall"};
  }
  return {};
}

}  // namespace regrasp::repair
