// Benchmark of the replay's verdicts. It draws random grasps of several objects, in space and in
// the plane, at 0.7 to 1.5 times their required friction, and switches to such grasps. The analytic
// check is bypassed.
// It writes tables of false passes and false fails by friction and by quality, a table of the
// effect of the settings, every sample as CSV, and a plot.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/random_grasps.h"
#include "bench/sample_table.h"
#include "bench/scatter_plot.h"
#include "bench/table_file.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/grasp/quality.h"
#include "sim/replay/replay.h"

namespace {

using namespace regrasp;

Sample Examine(const GraspedBody& body, const RandomCase& drawn,
               const sim::ReplayOptions& options) {
  const plan::Plan& plan = drawn.plan;
  const sim::ReplayResult result = sim::ReplayPlan(body.object(), plan, options);
  const sim::StepReplay& last = result.steps.back();
  Sample sample;
  sample.body = body.name();
  sample.ratio = drawn.ratio;
  sample.quality =
      grasp::ComputeQuality(drawn.examined, body.object().wrench_frame(), plan.friction_angle)
          .lower;
  const bool complete = result.steps.size() == plan.steps.size() + 1;
  sample.passed = complete && last.reason == plan::Reason::kNone;
  sample.reason = plan::ReasonName(last.reason);
  if (last.fixed) {
    sample.passed_fixed = complete && last.fixed->reason == plan::Reason::kNone;
    sample.reason_fixed = plan::ReasonName(last.fixed->reason);
    sample.give = last.fixed->give_m / result.settings.diameter_m;
  }
  sample.displacement =
      last.displacement_m / result.settings.diameter_m + last.rotation_deg * Radians(1) / 2;
  return sample;
}

std::vector<Sample> ExamineAll(const GraspedBody& body, const std::vector<RandomCase>& cases,
                               const sim::ReplayOptions& options) {
  std::vector<Sample> samples;
  for (const RandomCase& drawn : cases) samples.push_back(Examine(body, drawn, options));
  return samples;
}

/// Variant in the table of settings: a change of one setting.
struct Variant {
  std::string name;
  std::function<void(sim::ReplayOptions&)> change;
};

const std::vector<Variant> kVariants = {
    {"default", [](sim::ReplayOptions&) {}},
    {"disturbance ρ 0.005", [](sim::ReplayOptions& o) { o.disturbance_ratio = 0.005; }},
    {"disturbance ρ 0.02", [](sim::ReplayOptions& o) { o.disturbance_ratio = 0.02; }},
    {"gravity only", [](sim::ReplayOptions& o) { o.disturbance_ratio = 0; }},
    {"tolerance 1e-4 D", [](sim::ReplayOptions& o) { o.tolerance = 1e-4; }},
    {"tolerance 1e-2 D", [](sim::ReplayOptions& o) { o.tolerance = 1e-2; }},
    {"grasp force 10 weights", [](sim::ReplayOptions& o) { o.grasp_force_N = 10; }},
    {"grasp force 30 weights", [](sim::ReplayOptions& o) { o.grasp_force_N = 30; }},
    {"grasp force 100 weights", [](sim::ReplayOptions& o) { o.grasp_force_N = 100; }},
    {"grasp force 10,000 weights", [](sim::ReplayOptions& o) { o.grasp_force_N = 10'000; }},
    {"finger stiffness halved", [](sim::ReplayOptions& o) { o.stiffness_factor = 0.5; }},
    {"finger stiffness doubled", [](sim::ReplayOptions& o) { o.stiffness_factor = 2; }},
    {"time step halved", [](sim::ReplayOptions& o) { o.timestep_factor = 0.5; }},
    {"time step doubled", [](sim::ReplayOptions& o) { o.timestep_factor = 2; }},
};

/// Grasp forces in multiples of the weight are converted to newtons for an object of 0.1 kg.
sim::ReplayOptions OptionsFor(const Variant& variant) {
  sim::ReplayOptions options;
  variant.change(options);
  if (options.grasp_force_N) {
    constexpr double kGravityOnEarth = 9.81;
    options.mass_kg = 0.1;
    *options.grasp_force_N *= *options.mass_kg * kGravityOnEarth;
  }
  return options;
}

TableFile SettingsTable(const std::vector<GraspedBody>& bodies, int count, std::uint64_t seed) {
  TableFile table{"settings",
                  "Grasps that pass, by setting",
                  {"setting", "at most 0.98 of the required friction", "0.98 to 1",
                   "above it, quality under 0.01", "0.01 to 0.02", "0.02 and more"},
                  {}};
  for (const Variant& variant : kVariants) {
    std::vector<Sample> samples;
    for (const GraspedBody& body : bodies) {
      const auto more = ExamineAll(body, DrawHolds(body, count, seed), OptionsFor(variant));
      samples.insert(samples.end(), more.begin(), more.end());
    }
    const auto between = [](double x, double from, double to) { return x >= from && x < to; };
    table.rows.push_back(
        {variant.name, Share(samples, [](const Sample& s) { return s.ratio <= 0.98; }),
         Share(samples, [&](const Sample& s) { return s.ratio > 0.98 && s.ratio < 1; }),
         Share(samples, [&](const Sample& s) { return s.ratio >= 1 && s.quality < 0.01; }),
         Share(samples,
               [&](const Sample& s) { return s.ratio >= 1 && between(s.quality, 0.01, 0.02); }),
         Share(samples, [&](const Sample& s) { return s.ratio >= 1 && s.quality >= 0.02; })});
    std::fprintf(stderr, "settings: %s done\n", variant.name.c_str());
  }
  return table;
}

ScatterPlot PlotOf(const std::vector<Sample>& samples) {
  ScatterPlot plot;
  plot.x_title = "friction over the grasp's required friction";
  plot.y_title = "largest displacement over the diameter";
  plot.x_from = kLeastRatio;
  plot.x_to = kMostRatio;
  plot.y_from = 1e-8;
  plot.y_to = 10;
  plot.level = sim::ReplayOptions().tolerance;
  plot.level_name = "tolerance";
  plot.series = {{"force closure, quality above the disturbance", "#2166ac", {}},
                 {"force closure, quality below the disturbance", "#e08214", {}},
                 {"not force closure", "#b2182b", {}}};
  for (const Sample& sample : samples) {
    const std::size_t series =
        sample.ratio < 1 ? 2 : (sample.quality < sim::ReplayOptions().disturbance_ratio ? 1 : 0);
    plot.series[series].points.emplace_back(sample.ratio, sample.displacement);
  }
  return plot;
}

int Run(const std::filesystem::path& models, const std::filesystem::path& folder, int count) {
  constexpr std::uint64_t kSeed = 2026;
  std::filesystem::create_directories(folder);
  std::vector<GraspedBody> bodies;
  for (const char* name : kGraspedBodies) bodies.emplace_back(models / name);
  std::vector<Sample> holds;
  std::vector<Sample> switches;
  for (const GraspedBody& body : bodies) {
    sim::ReplayOptions both;
    both.protocol = sim::Protocol::kBoth;
    const auto held = ExamineAll(body, DrawHolds(body, count, kSeed), both);
    const auto switched = ExamineAll(body, DrawSwitches(body, count, kSeed), both);
    holds.insert(holds.end(), held.begin(), held.end());
    switches.insert(switches.end(), switched.begin(), switched.end());
    std::fprintf(stderr, "%s: %d holds and %d switches\n", body.name().c_str(), count, count);
  }
  const auto ratio = [](const Sample& s) { return std::optional(s.ratio); };
  const auto quality = [](const Sample& s) {
    return s.ratio < 1 ? std::nullopt : std::optional(s.quality);
  };
  WriteTable(
      RangeTable("holds_by_friction", "Random grasps that pass, by friction over the required one",
                 "friction", kRatios, holds, ratio),
      folder);
  WriteTable(RangeTable("holds_by_quality", "Force-closure grasps that pass, by quality", "quality",
                        kQualities, holds, quality),
             folder);
  WriteTable(
      RangeTable("switches_by_friction",
                 "Random switches that pass, by friction over the required one of the grasp after",
                 "friction", kRatios, switches, ratio),
      folder);
  WriteTable(RangeTable("switches_by_quality",
                        "Switches to force-closure grasps that pass, by quality of the grasp after",
                        "quality", kQualities, switches, quality),
             folder);
  WriteTable(ProtocolTable(holds, switches), folder);
  WriteSamples(holds, folder / "holds.csv");
  WriteSamples(switches, folder / "switches.csv");
  WriteTable(SettingsTable(bodies, std::max(count / 5, 1), kSeed + 1), folder);
  WriteFile(folder / "discrimination.svg", FormatScatterPlot(PlotOf(holds)));
  const auto false_pass = [](const Sample& s) {
    return (s.passed || s.passed_fixed) && s.ratio <= 0.98;
  };
  const auto false_passes = std::count_if(holds.begin(), holds.end(), false_pass) +
                            std::count_if(switches.begin(), switches.end(), false_pass);
  std::printf("%zu holds, %zu switches, %d passes at or below 0.98 of the required friction\n",
              holds.size(), switches.size(), static_cast<int>(false_passes));
  return false_passes == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = argc == 4 ? ParseDouble(argv[3]) : std::optional<double>();
  if (!count || *count < 1 || *count > 1e6) {
    std::fprintf(stderr, "usage: discrimination MODELS_FOLDER OUTPUT_FOLDER GRASPS_PER_BODY\n");
    return 2;
  }
  try {
    return Run(argv[1], argv[2], static_cast<int>(*count));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "discrimination: %s\n", error.what());
    return 2;
  }
}
