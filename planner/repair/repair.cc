#include "planner/repair/repair.h"

#include <algorithm>
#include <functional>
#include <set>
#include <string_view>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/diameter.h"
#include "planner/object/mesh_defect.h"
#include "planner/object/read_soup.h"
#include "planner/repair/run_stage.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

using object::PolygonSoup;

namespace {

constexpr char kIsSolid[] = "solid";

std::string Percent(double share) { return FormatShort(100 * share, 3) + " %"; }

/// "67.3 %, 30.2 %, 2.48 %", the first few of them.
std::string SharesText(const std::vector<double>& shares) {
  constexpr std::size_t kListed = 5;
  std::string list;
  for (std::size_t i = 0; i < std::min(shares.size(), kListed); ++i) {
    list += (i == 0 ? "" : ", ") + Percent(shares[i]);
  }
  return shares.size() > kListed ? list + ", …" : list;
}

/// As the file of the solid has its facets.
void InventedLast(PolygonSoup& solid) {
  if (std::ranges::find(solid.invented, true) == solid.invented.end()) solid.invented.clear();
  PolygonSoup sorted{solid.vertices, {}};
  for (const bool invented : {false, true}) {
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
      if ((!solid.invented.empty() && solid.invented[f]) != invented) continue;
      sorted.facets.push_back(solid.facets[f]);
      if (!solid.invented.empty()) sorted.invented.push_back(invented);
    }
  }
  solid = std::move(sorted);
}

/// The climb from stage to stage.
class Ladder {
 public:
  Ladder(const PolygonSoup& soup, const std::string& name, const object::RepairOptions& options,
         const object::Reading& reading)
      : soup_(soup), name_(name), options_(options), reading_(reading) {
    repaired_.facets_before = soup.facets.size();
    repaired_.diameter = object::ComputeDiameter(soup.vertices);
  }

  Repaired Climb() {
    if (soup_.facets.empty()) JoinPoints();
    if (options_.thickness) {
      MakeSheet();
    } else if (!TakesAsItIs()) {
      MakeSolid();
    }
    if (options_.facets && repaired_.solid.facets.size() > std::size_t(*options_.facets)) {
      MakeCoarser();
    }
    Finish();
    return std::move(repaired_);
  }

 private:
  /// A cloud of points becomes a surface first.
  void JoinPoints() {
    const auto surface = Run("reconstruct", [&] { return ReconstructSurface(soup_); });
    if (!surface) Refuse();
    repaired_.stages.back().outcome = "a surface";
    soup_ = surface->soup;
  }

  /// Whether the reader takes the file's surface, so that there is nothing to do.
  bool TakesAsItIs() {
    const std::string complaint = ReaderComplaint(soup_);
    repaired_.stages.push_back(
        {"read", complaint.empty() ? kIsSolid : complaint, Json::object(), soup_.facets.size()});
    if (!complaint.empty()) return false;
    repaired_.solid = soup_;              // with the marks of an earlier repair
    repaired_.comparison.seen_share = 1;  // and all differences are none
    if (!options_.facets) return true;
    const auto clean = Run("clean", [&] { return CleanSurface(soup_); });
    if (!clean) return false;
    repaired_.stages.pop_back();
    repaired_.solid = original_ = clean->soup;
    return true;
  }

  void MakeSolid() {
    const auto clean = Run("clean", [&] { return CleanSurface(soup_); });
    if (!clean) Refuse();
    original_ = clean->soup;
    if (Accepts(clean->soup)) return;
    PolygonSoup best = clean->soup;
    using Stage = StageResult (*)(const PolygonSoup&);
    for (const auto& [name, stage] : {std::pair<const char*, Stage>("fill-holes", FillHoles),
                                      {"unite-shells", UniteShells},
                                      {"remove-crossings", RemoveCrossings},
                                      {"wrap", WrapSurface}}) {
      if (!Applies(name, best)) continue;
      const auto result = Run(name, [&] { return stage(best); });
      if (!result) continue;
      if (Accepts(result->soup)) return;
      // What was cut out is not to be missed by the wrap.
      if (std::string_view(name) != "remove-crossings") best = result->soup;
    }
    Refuse();
  }

  void MakeSheet() {
    const auto clean = Run("clean", [&] { return CleanSurface(soup_); });
    if (!clean) Refuse();
    original_ = clean->soup;
    const auto sheet = Run("solidify", [&] { return Solidify(original_, *options_.thickness); });
    if (!sheet || !Accepts(sheet->soup)) Refuse();
  }

  void MakeCoarser() {
    const PolygonSoup fine = repaired_.solid;
    const auto coarse = Run("simplify", [&] { return Simplify(fine, *options_.facets); });
    if (!coarse || !Accepts(coarse->soup)) Refuse();
  }

  /// @returns nullopt where the stage failed; the report says so.
  std::optional<StageResult> Run(const std::string& stage,
                                 const std::function<StageResult()>& task) {
    reading_.Begin("repairing " + name_ + ": " + stage);
    StageRun run = RunStage(task, reading_.deadline);
    StageReport& report = repaired_.stages.emplace_back();
    report.stage = stage;
    if (!run.result) {
      report.outcome = run.failure;
      return std::nullopt;
    }
    report.facts = run.result->facts;
    report.facets = run.result->soup.facets.size();
    return std::move(run.result);
  }

  [[nodiscard]] object::Reading Silently() const {
    object::Reading reading;
    reading.deadline = reading_.deadline;
    reading.counts_defects = false;
    return reading;
  }

  std::string ReaderComplaint(const PolygonSoup& soup) {
    try {
      (void)object::Polyhedron::FromSoup(soup, "", Silently());
      return "";
    } catch (const object::MeshError& error) {
      defect_ = error.defect();
      return error.what();
    }
  }

  /// Judges what the last stage made, and takes it where nothing is wrong with it.
  bool Accepts(PolygonSoup soup) {
    const std::size_t judged = repaired_.stages.size() - 1;
    std::string complaint = ReaderComplaint(soup);
    if (!complaint.empty() && defect_ == object::MeshDefect::kSeveralSolids) {
      complaint = TakePartOf(soup);
    }
    if (complaint.empty()) complaint = ShapeComplaint(soup);
    repaired_.stages[judged].outcome = complaint.empty() ? kIsSolid : complaint;
    if (judged + 1 < repaired_.stages.size()) {
      repaired_.stages.back().outcome = repaired_.stages[judged].outcome;
    }
    if (!complaint.empty()) return false;
    repaired_.solid = std::move(soup);
    return true;
  }

  /// Of several solids beside each other one. @returns why there is none; empty where there is.
  std::string TakePartOf(PolygonSoup& soup) {
    const auto part = Run("take-part", [&] { return TakePart(soup, options_.part.value_or(1)); });
    if (!part) return repaired_.stages.back().outcome;
    const auto shares = part->facts["volume_shares"].get<std::vector<double>>();
    if (!options_.part && shares.size() > 1 && shares[1] > kSmallPart) {
      return std::to_string(shares.size()) + " solids beside each other, with " +
             SharesText(shares) + " of the volume; --part K takes one (1: the largest)";
    }
    soup = part->soup;
    return ReaderComplaint(soup);
  }

  /// What is wrong with a solid as an image of the original; empty where nothing is.
  std::string ShapeComplaint(const PolygonSoup& soup) {
    reading_.Begin("repairing " + name_ + ": measuring what changed");
    const Comparison comparison = Compare(original_, soup, repaired_.diameter);
    const double deviation = comparison.seen_most / repaired_.diameter;
    const double allowed =
        options_.max_deviation + options_.thickness.value_or(0) / 2 / repaired_.diameter;
    repaired_.comparison = comparison;
    if (deviation > allowed) {
      return "the solid is too far from its surface: 95 % of what is seen from outside lies "
             "within " +
             Percent(deviation) + " of the diameter, " + Percent(options_.max_deviation) +
             " are allowed (--max-deviation)";
    }
    if (options_.thickness) return "";
    if (comparison.invented_share > kMostInvented) {
      return "the surface is not all there: " + Percent(comparison.invented_share) +
             " of the solid's would be invented, " + Percent(kMostInvented) +
             " at most are taken; scan the other sides too, or give an open sheet a wall "
             "(--solidify THICKNESS)";
    }
    if (comparison.thin_share > kMostThin) {
      return "it is an open sheet: " + Percent(comparison.thin_share) +
             " of the solid would be thinner than " + Percent(kThinWall) +
             " of the diameter; give it a wall (--solidify THICKNESS)";
    }
    return "";
  }

  /// Whether a stage can do anything about a surface.
  bool Applies(const std::string& stage, const PolygonSoup& best) {
    if (stage == "fill-holes") return HasOpenEdges(best);
    if (stage == "unite-shells") return CountShells(best) > 1;
    return true;
  }

  /// @param soup  as CleanSurface makes it: no edge has more than two facets.
  static bool HasOpenEdges(const PolygonSoup& soup) {
    std::set<std::pair<int, int>> edges;
    for (const auto& facet : soup.facets) {
      for (std::size_t k = 0; k < facet.size(); ++k) {
        const int from = facet[k], to = facet[(k + 1) % facet.size()];
        if (edges.erase({to, from}) == 0) edges.insert({from, to});
      }
    }
    return !edges.empty();
  }

  static int CountShells(const PolygonSoup& soup) {
    std::vector<int> root(soup.vertices.size());
    for (int v = 0; v < std::ssize(root); ++v) root[v] = v;
    const auto find = [&](int v) {
      while (root[v] != v) v = root[v] = root[root[v]];
      return v;
    };
    for (const auto& facet : soup.facets) {
      for (const int v : facet) root[find(v)] = find(facet[0]);
    }
    int shells = 0;
    std::vector<bool> used(root.size(), false);
    for (const auto& facet : soup.facets) {
      const int v = find(facet[0]);
      shells += !used[v];
      used[v] = true;
    }
    return shells;
  }

  void Finish() {
    const std::vector<bool>& invented = repaired_.comparison.invented;
    if (!options_.thickness && !invented.empty()) repaired_.solid.invented = invented;
    InventedLast(repaired_.solid);
    const auto solid = object::Polyhedron::FromSoup(repaired_.solid, name_, Silently());
    repaired_.volume = solid.mass_properties().volume;
  }

  [[noreturn]] void Refuse() {
    const StageReport& last = repaired_.stages.back();
    throw InputError(name_ + ": not repaired: " + last.stage + ": " + last.outcome);
  }

  PolygonSoup soup_;
  const std::string& name_;
  const object::RepairOptions& options_;
  const object::Reading& reading_;
  PolygonSoup original_;  ///< as triangles
  object::MeshDefect defect_ = {};
  Repaired repaired_;
};

}  // namespace

Repaired Repair(const PolygonSoup& soup, const std::string& name,
                const object::RepairOptions& options, const object::Reading& reading) {
  return Ladder(soup, name, options, reading).Climb();
}

std::string RepairHint(const std::filesystem::path& path, const object::Reading& reading) {
  /// A refusal is not delayed by more than this.
  constexpr double kSeconds = 20;
  object::Reading limited = reading;
  const Deadline own = DeadlineAfter(Deadline::Clock::now(), kSeconds);
  if (!reading.deadline.left() || *own.left() < *reading.deadline.left()) limited.deadline = own;
  try {
    const Repaired repaired =
        Repair(object::ReadSoup(path, limited).soup, path.string(), {}, limited);
    return "; --repair makes a solid of it: " + RepairText(repaired);
  } catch (const InputError&) {
    return "; no repair is found within the default limits (the program repair says why)";
  } catch (const TimeUp&) {
    return "; the program repair may make a solid of it";
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
          object::RepairRecord{options, Sha256(FormatSolid(repaired.solid))}};
}

}  // namespace regrasp::repair
