#include "planner/repair/judgement.h"

#include <string_view>

#include "planner/base/number.h"
#include "planner/object/mesh_defect.h"
#include "planner/object/mesh_survey.h"
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
  // The largest is taken by a stage, so that its original is known.
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
  return {
      Shortfall::kNotChosen,
      std::to_string(volume_shares.size()) + " solids beside each other, with " +
          object::SharesText(volume_shares) +
          " of the volume; --repair part=K takes one (1: the largest), --shells union all as one "
          "body"};
}

Judgement JudgeShape(const Comparison& comparison, const Original& original,
                     const object::RepairOptions& options) {
  const double deviation = comparison.seen_most / original.diameter;
  if (deviation > options.max_deviation + options.thickness.value_or(0) / 2 / original.diameter) {
    return {Shortfall::kTooFar,
            "the solid is too far from its surface: 95 % of what is seen from outside lies "
            "within " +
                PercentOf(deviation) + " of the diameter, " + PercentOf(options.max_deviation) +
                " are allowed (--repair max-deviation)",
            deviation};
  }
  if (options.thickness) return {};
  if (comparison.invented_share > kMostInvented) {
    return {Shortfall::kNotAllThere,
            "the surface is not all there: " + PercentOf(comparison.invented_share) +
                " of the solid's would be invented, " + PercentOf(kMostInvented) +
                " at most are taken; scan the other sides too, or give an open sheet a wall "
                "(--repair wall=T)"};
  }
  if (original.open && comparison.thin_share > kMostThin) {
    return {Shortfall::kSheet, "it is an open sheet: " + PercentOf(comparison.thin_share) +
                                   " of the solid would be thinner than " + PercentOf(kThinWall) +
                                   " of the diameter; give it a wall (--repair wall=T)"};
  }
  return {};
}

}  // namespace regrasp::repair
