#include "planner/repair/repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "planner/base/file.h"
#include "planner/repair/invented_marks.h"
#include "planner/repair/ladder.h"

namespace regrasp::repair {

using object::PolygonSoup;

namespace {

/// The less, the more the user can do about it.
int RankOf(Shortfall shortfall) {
  switch (shortfall) {
    case Shortfall::kNotChosen:
      return 0;  // one can be chosen
    case Shortfall::kNotAllThere:
    case Shortfall::kSheet:
      return 1;  // what is missing can be scanned, a sheet can get a wall
    case Shortfall::kTooFar:
      return 2;  // a deviation can be allowed
    default:
      return 3;
  }
}

/// The stage whose outcome says what would help; the last one where none does.
const StageReport& MostHelpful(const Attempt& attempt) {
  const auto found = std::ranges::min_element(attempt.stages, {}, [](const StageReport& stage) {
    return std::pair(RankOf(stage.shortfall), stage.deviation);
  });
  return RankOf(found->shortfall) == RankOf(Shortfall::kNoResult) ? attempt.stages.back() : *found;
}

/// The reader takes a solid whose facets all turn inwards; other programs do not.
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
  Climbed climbed = Climb(soup, name, options, reading);
  if (!climbed.solid) throw NotRepaired(name, std::move(climbed.attempt));
  Repaired repaired{std::move(climbed.attempt), *std::move(climbed.solid), 0,
                    std::move(climbed.comparison)};
  if (repaired.solid.invented.empty()) {
    // A sheet's two sides are both off it.
    MarkInvented(soup, options.thickness ? Comparison() : repaired.comparison, repaired.solid);
  }
  InventedLast(repaired.solid);
  TurnOutwards(repaired.solid);
  object::Reading silent;
  silent.deadline = reading.deadline;
  silent.shells = reading.shells;
  repaired.volume =
      object::Polyhedron::FromSoup(repaired.solid, name, silent).mass_properties().volume;
  return repaired;
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
  } catch (const NotRepaired& refusal) {
    return "; --repair makes no solid of it: " + MostHelpful(refusal.attempt()).outcome;
  } catch (const InputError&) {
    return "; --repair makes no solid of it";
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
          object::RepairRecord{options, Sha256(FormatSolid(repaired.solid))}, file.soup.unit};
}

}  // namespace regrasp::repair
