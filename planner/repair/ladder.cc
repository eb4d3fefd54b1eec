#include "planner/repair/ladder.h"

#include <chrono>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/object/body_measures.h"
#include "planner/repair/canonical_order.h"
#include "planner/repair/invented_marks.h"
#include "planner/repair/judgement.h"
#include "planner/repair/reconstruct.h"
#include "planner/repair/run_stage.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

using object::PolygonSoup;

namespace {

constexpr char kIsSolid[] = "solid";

/// A solid this close to its original, over the diameter, ends the climb; others are the last word
/// only where no later stage comes closer.
constexpr double kCloseEnough = 0.002;

/// Where a wrap of an open surface has less than this of the volume of a coarser one, it has
/// entered a hollow body and leaves nothing but its wall.
constexpr double kLeastLeft = 0.5;

/// Whether a stage can do anything about a surface.
bool Applies(std::string_view stage, const PolygonSoup& soup) {
  if (stage == "fill-holes") return HasOpenEdges(soup);
  if (stage == "unite-shells") return CountShells(soup) > 1;
  if (stage == "arrange") return !HasOpenEdges(soup);
  return true;
}

class Ladder {
 public:
  Ladder(const PolygonSoup& soup, const std::string& name, const object::RepairOptions& options,
         const object::Reading& reading)
      : soup_(soup), name_(name), options_(options), reading_(reading) {
    climbed_.attempt.facets_before = soup.facets.size();
    climbed_.attempt.diameter = object::ComputeDiameter(soup.vertices);
  }

  Climbed Climb() {
    if (!(JoinsPoints() && MakesSolid() && MakesCoarser())) climbed_.solid.reset();
    return std::move(climbed_);
  }

 private:
  // Each true where the climb goes on, false where it ends without a solid.

  /// A cloud of points becomes a surface first.
  bool JoinsPoints() {
    if (!soup_.facets.empty()) return true;
    auto surface = Run("reconstruct", [&] { return ReconstructSurface(soup_); });
    if (!surface) return false;
    if (last().facts["scatter"].get<double>() > kMostScatter) {
      last().outcome =
          "its points lie about a surface and not on one: they scatter as widely as they are "
          "apart; smooth or average them first";
      return false;
    }
    last().outcome = "a surface";
    soup_ = *std::move(surface);
    return true;
  }

  bool MakesSolid() {
    if (!options_.thickness && TakesAsItIs()) return true;
    if (!Cleans()) return false;
    return options_.thickness ? MakesSheet() : ClimbsStages();
  }

  bool Cleans() {
    auto clean = Run("clean", [&] { return CleanSurface(soup_); });
    if (!clean) return false;
    const bool open = HasOpenEdges(*clean);
    original_ = {*std::move(clean), climbed_.attempt.diameter, open};
    return true;
  }

  /// Whether the reader takes the file's surface, so that there is nothing to do.
  bool TakesAsItIs() {
    climbed_.attempt.stages.emplace_back();
    last().stage = "read";
    last().facets = soup_.facets.size();
    if (!Passes(JudgeSurface(soup_, reading_))) return false;
    climbed_.solid = soup_;              // with the marks of an earlier repair
    climbed_.comparison.seen_share = 1;  // and all differences are none
    return true;
  }

  bool ClimbsStages() {
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
      // What was cut out is not to be missed by those that follow.
      const std::string_view stage_name = name;
      if (stage_name != "remove-crossings" && stage_name != "arrange") best = *std::move(made);
    }
    return Wraps(best) || HasClosest();
  }

  bool Wraps(const PolygonSoup& best) {
    if (WrapIsCloseEnough("wrap", best)) return true;
    // What fills a wide hole may hide what is seen through it; a wrap of the surface as it is shows
    // that, where it does not enter a hollow body.
    const bool hides = last().shortfall == Shortfall::kTooFar && !HasOpenEdges(best);
    return !closest_ && hides && original_.open &&
           WrapIsCloseEnough("wrap-unfilled", original_.soup);
  }

  bool WrapIsCloseEnough(const std::string& stage, const PolygonSoup& surface) {
    auto made = Run(stage, [&] { return WrapSurface(surface); });
    if (!made) return false;
    const Json& volumes = last().facts["volumes"];  // from the coarser wrap to the finer one
    const double left =
        volumes.back()["volume"].get<double>() / volumes.front()["volume"].get<double>();
    if (HasOpenEdges(surface) && left < kLeastLeft) {
      last().shortfall = Shortfall::kSheet;
      last().outcome = "it is an open sheet: a wrap enters it, and leaves " +
                       FormatShort(100 * left, 3) +
                       " % of the volume of a coarser one; give it a wall (--repair wall=T)";
      return false;
    }
    return IsCloseEnough(*std::move(made));
  }

  /// Whether what the last stage made ends the climb. Where it is a solid but not that close it is
  /// kept, if none before was closer.
  bool IsCloseEnough(PolygonSoup soup) {
    std::optional<Comparison> comparison = Judge(soup);
    if (!comparison) return false;
    const double deviation = comparison->seen_most / original_.diameter;
    const bool is_close = deviation <= kCloseEnough;
    if (!closest_ || deviation < closest_->comparison.seen_most / original_.diameter) {
      closest_ = {climbed_.attempt.stages, std::move(soup), *std::move(comparison)};
    }
    if (is_close) return HasClosest();
    last().facts["deviation_over_diameter"] = deviation;
    return false;
  }

  /// Ends the climb with the closest solid of all, where there is one: its stage is then the last
  /// one, and says which others were farther off.
  bool HasClosest() {
    if (!closest_) return false;
    std::vector<StageReport>& stages = climbed_.attempt.stages;
    Json others = Json::array();
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (stages[i].outcome != kIsSolid || i + 1 == closest_->stages.size()) continue;
      others.push_back({{"stage", stages[i].stage},
                        {"deviation_over_diameter", stages[i].facts["deviation_over_diameter"]}});
    }
    stages = std::move(closest_->stages);
    for (std::size_t i = 0; i + 1 < stages.size(); ++i) {
      if (stages[i].outcome == kIsSolid) stages[i].outcome = "a solid, but a later one is closer";
    }
    if (!others.empty()) last().facts["farther_off"] = others;
    climbed_.solid = std::move(closest_->solid);
    climbed_.comparison = std::move(closest_->comparison);
    return true;
  }

  bool MakesSheet() {
    const auto sheet =
        Run("solidify", [&] { return Solidify(original_.soup, *options_.thickness); });
    return sheet && Accepts(*sheet);
  }

  bool MakesCoarser() {
    if (!options_.facets || std::ssize(climbed_.solid->facets) <= *options_.facets) return true;
    if (original_.soup.facets.empty()) {  // a solid as it is: of triangles, to measure against
      if (!Cleans()) return false;
      climbed_.attempt.stages.pop_back();
      const auto is_triangle = [](const auto& facet) { return facet.size() == 3; };
      if (!std::ranges::all_of(climbed_.solid->facets, is_triangle)) {
        climbed_.solid = original_.soup;
      }
    }
    PolygonSoup fine = *climbed_.solid;
    MarkInvented(soup_, climbed_.comparison, fine);
    const auto coarse = Run("simplify", [&] { return Simplify(fine, *options_.facets); });
    if (!coarse) return false;
    if (Accepts(*coarse, &fine)) return true;
    last().outcome += "; with a larger --repair max-triangles it may come out";
    return false;
  }

  /// How long a stage may take. What unites shells may go round for ever where they touch along
  /// edges; it takes 5 s for 23,000 facets, and others come after it.
  static std::chrono::seconds TimeOf(std::string_view stage) {
    return stage == "unite-shells" ? std::chrono::seconds(60) : kStageTime;
  }

  /// @returns nullopt where the stage failed; the report says so.
  std::optional<PolygonSoup> Run(const std::string& stage,
                                 const std::function<StageResult()>& task) {
    reading_.Begin("repairing " + name_ + ": " + stage);
    StageRun run = RunStage(task, reading_.deadline, TimeOf(stage));
    StageReport& report = climbed_.attempt.stages.emplace_back();
    report.stage = stage;
    report.outcome = run.failure;
    if (!run.result) return std::nullopt;
    report.facts = std::move(run.result->facts);
    report.facets = run.result->soup.facets.size();
    return InCanonicalOrder(run.result->soup);
  }

  /// Judges what the last stage made, of several solids the one that is taken.
  /// @param fine  of a coarser solid the finer one, with its marks: that is far from its original
  ///              because it is coarse, and only where that one was invented it is, too.
  /// @returns how it differs from the original, where nothing is wrong with it.
  std::optional<Comparison> Judge(PolygonSoup& soup, const PolygonSoup* fine = nullptr) {
    Judgement judgement = JudgeSurface(soup, reading_);
    Passes(judgement);
    std::optional<PolygonSoup> its_original;
    if (judgement.shortfall == Shortfall::kSeveralSolids) {
      const PolygonSoup all = soup;
      if (!TakesPart(soup)) return std::nullopt;
      judgement = JudgeSurface(soup, reading_);
      // What was asked to be left out is not missing.
      if (options_.part) its_original = OriginalOfPart(original_.soup, all, soup);
    }
    if (!Passes(judgement)) return std::nullopt;
    reading_.Begin("repairing " + name_ + ": measuring what changed");
    Comparison comparison =
        Compare(its_original ? *its_original : original_.soup, soup, original_.diameter);
    if (fine != nullptr) {
      PolygonSoup marked = soup;
      MarkInvented(*fine, {}, marked);
      comparison.invented = marked.invented;
      comparison.invented_share = InventedShare(marked);
    }
    if (!Passes(JudgeShape(comparison, original_, options_))) return std::nullopt;
    return comparison;
  }

  /// Takes what the last stage made, where nothing is wrong with it.
  /// @param fine  as Judge has it.
  bool Accepts(PolygonSoup soup, const PolygonSoup* fine = nullptr) {
    std::optional<Comparison> comparison = Judge(soup, fine);
    if (!comparison) return false;
    climbed_.solid = std::move(soup);
    climbed_.comparison = *std::move(comparison);
    return true;
  }

  /// Of several solids beside each other takes one.
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

  /// Writes a judgement of what the last stage made into its report.
  bool Passes(const Judgement& judgement) {
    last().shortfall = judgement.shortfall;
    last().outcome = judgement.passes() ? kIsSolid : judgement.complaint;
    last().deviation = judgement.deviation;
    return judgement.passes();
  }

  StageReport& last() { return climbed_.attempt.stages.back(); }

  PolygonSoup soup_;
  const std::string& name_;
  const object::RepairOptions& options_;
  const object::Reading& reading_;
  Original original_;
  Climbed climbed_;
  /// The closest of the solids that were made so far.
  struct Closest {
    std::vector<StageReport> stages;  ///< up to the one that made it
    PolygonSoup solid;
    Comparison comparison;
  };
  std::optional<Closest> closest_;
};

}  // namespace

Climbed Climb(const PolygonSoup& soup, const std::string& name,
              const object::RepairOptions& options, const object::Reading& reading) {
  return Ladder(soup, name, options, reading).Climb();
}

}  // namespace regrasp::repair
