#include "apps/repair_options.h"

#include <vector>

#include "apps/options.h"

namespace regrasp::apps {

namespace {

constexpr int kFewestFacets = 4;
constexpr int kMostFacets = 1'000'000;
constexpr int kMostParts = 100'000;

std::vector<CLI::Option*> AddAll(CLI::App& app, double& max_deviation_percent,
                                 object::RepairOptions& options) {
  return {AddNumber(app, "--max-deviation", max_deviation_percent, NumberRange::Positive(),
                    "Largest deviation of the solid, percent of its diameter: 95 % of the surface "
                    "that is seen from outside stays within it (default 1)",
                    "PERCENT"),
          AddInteger(app, "--faces", options.facets, kFewestFacets, kMostFacets,
                     "Most triangles of the solid, within --max-deviation (default: as many as "
                     "come out)"),
          AddInteger(app, "--part", options.part, 1, kMostParts,
                     "Which of several solids beside each other, by volume, from 1 (default: "
                     "refused where a second one has more than 1 % of the volume)"),
          AddNumber(app, "--solidify", options.thickness, NumberRange::Positive(),
                    "Thickness of the wall that an open sheet gets; in the object file's unit of "
                    "length",
                    "THICKNESS")};
}

void AddShells(CLI::App& app, std::optional<object::Shells>& shells) {
  AddChoice<std::optional<object::Shells>>(
      app, "--shells", shells,
      {{"union", object::Shells::kUnion}, {"largest", object::Shells::kLargest}},
      "What several closed shells are: union, all are one rigid body, also beside each other; "
      "largest, the one of the largest volume and its cavities is the object (default: refused, "
      "but for a solid and its cavities)");
}

}  // namespace

void RepairOptions::AddTo(CLI::App& app) {
  AddShells(app, shells_);
  AddAll(app, max_deviation_percent_, options_);
}

void RepairOptions::AddWithSwitch(CLI::App& app) {
  AddShells(app, shells_);
  CLI::Option* repair = app.add_flag(
      "--repair", wanted_,
      "Make a solid of a scan or a broken mesh; as the program repair does; fingers keep off what "
      "it must invent");
  for (CLI::Option* option : AddAll(app, max_deviation_percent_, options_)) option->needs(repair);
}

object::RepairOptions RepairOptions::Get() const {
  object::RepairOptions options = options_;
  options.max_deviation = max_deviation_percent_ / 100;
  return options;
}

}  // namespace regrasp::apps
