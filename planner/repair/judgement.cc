#include "planner/repair/judgement.h"

#include <string_view>

#include "planner/base/number.h"
#include "planner/object/mesh_survey.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/polyhedron.h"
#include "planner/repair/repair.h"

namespace regrasp::repair {

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
