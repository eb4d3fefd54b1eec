// What a replay can tell: random grasps of several bodies, in space and in the plane, at 0.7 to 1.5
// times their critical friction, and switches to such grasps, the analytic check bypassed. Writes
// tables of false passes and false fails by friction and by quality, of what the settings change,
// every sample as CSV, and a plot.

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

#include "bench/sample_table.h"
#include "bench/scatter_plot.h"
#include "bench/table_file.h"
#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/sampling/surface_sampler.h"
#include "sim/replay/replay.h"

namespace {

using namespace regrasp;

constexpr std::array kBodies = {"cube.obj",   "l_block.obj",   "hole_block.obj",  "stone.obj",
                                "mug500.obj", "polygon15.wkt", "polygon_hole.wkt"};
constexpr double kLeastRatio = 0.7;
constexpr double kMostRatio = 1.5;
/// Grasps that need more friction than this are not what anyone plans with.
constexpr double kMostCritical = Radians(50);
constexpr double kLeastCritical = Radians(0.5);
/// The first grasp of a switch resists this much more than the shake, so that a fail is the
/// second's.
constexpr double kFirstQuality = 0.03;

/// Where grasps are drawn, and how.
class Body {
 public:
  explicit Body(const std::filesystem::path& path)
      : name_(path.stem().string()), file_(object::ReadObject(path)), source_(*file_.object) {}

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const object::Object& object() const { return *file_.object; }
  /// Contacts drawn evenly over the surface where a fingertip has room.
  [[nodiscard]] const sampling::SurfaceSampler& source() const { return source_; }
  [[nodiscard]] bool planar() const { return object().dimension() == 2; }
  [[nodiscard]] int hold() const { return planar() ? 3 : 4; }

  [[nodiscard]] grasp::Grasp DrawGrasp(RandomStream& random) const {
    grasp::Grasp grasp;
    for (int i = 0; i < hold(); ++i) grasp.push_back(source_.Draw(random));
    return grasp;
  }

 private:
  std::string name_;
  object::ObjectFile file_;
  sampling::SurfaceSampler source_;
};

/// The smallest μ at which a grasp is force closure, where it is one that is worth a replay.
std::optional<double> CriticalFriction(const Body& body, const grasp::Grasp& grasp) {
  if (!grasp::IsForceClosure(grasp, body.object().wrench_frame(), kMostCritical))
    return std::nullopt;
  const auto required = grasp::ComputeRequiredHalfAngle(grasp, body.object().wrench_frame());
  if (!required || required->upper > kMostCritical || required->upper < kLeastCritical) {
    return std::nullopt;
  }
  return std::tan(required->upper);
}

/// A plan that holds the grasp.
plan::Plan PlanOf(const Body& body, const grasp::Grasp& initial, double half_angle) {
  plan::Plan plan;
  plan.dimension = body.object().dimension();
  plan.half_angle = half_angle;
  plan.fingers = body.hold() + 1;
  plan.initial = plan::FingersInOrder(initial);
  plan.goal = initial;
  return plan;
}

Sample ExamineGrasp(const Body& body, const plan::Plan& plan, const grasp::Grasp& examined,
                    double ratio, const sim::ReplayOptions& options) {
  const sim::ReplayResult result = sim::ReplayPlan(body.object(), plan, options);
  const sim::StepReplay& last = result.steps.back();
  Sample sample;
  sample.body = body.name();
  sample.ratio = ratio;
  sample.quality =
      grasp::ComputeQuality(examined, body.object().wrench_frame(), plan.half_angle).lower;
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

double DrawRatio(RandomStream& random) {
  return kLeastRatio + (kMostRatio - kLeastRatio) * random.Uniform();
}

std::vector<Sample> ExamineHolds(const Body& body, int count, std::uint64_t seed,
                                 const sim::ReplayOptions& options) {
  RandomStream random(seed, RandomUse::kStart);
  std::vector<Sample> samples;
  while (static_cast<int>(samples.size()) < count) {
    const grasp::Grasp grasp = body.DrawGrasp(random);
    const auto critical = CriticalFriction(body, grasp);
    if (!critical) continue;
    const double ratio = DrawRatio(random);
    const plan::Plan plan = PlanOf(body, grasp, std::atan(ratio * *critical));
    samples.push_back(ExamineGrasp(body, plan, grasp, ratio, options));
  }
  return samples;
}

/// Switches of one finger from a good grasp.
std::vector<Sample> ExamineSwitches(const Body& body, int count, std::uint64_t seed,
                                    const sim::ReplayOptions& options) {
  RandomStream random(seed, RandomUse::kGoal);
  std::vector<Sample> samples;
  while (static_cast<int>(samples.size()) < count) {
    const grasp::Grasp first = body.DrawGrasp(random);
    grasp::Grasp second = first;
    second.erase(second.begin());
    second.push_back(body.source().Draw(random));
    const auto critical = CriticalFriction(body, second);
    if (!critical) continue;
    const double ratio = DrawRatio(random);
    const double half_angle = std::atan(ratio * *critical);
    if (!grasp::QualityAtLeast(first, body.object().wrench_frame(), half_angle, kFirstQuality))
      continue;
    plan::Plan plan = PlanOf(body, first, half_angle);
    plan.steps.push_back(
        plan::Switch{{{FingerIndex(body.hold()), second.back()}}, {FingerIndex(0)}});
    plan.goal = second;
    samples.push_back(ExamineGrasp(body, plan, second, ratio, options));
  }
  return samples;
}

/// The settings that the table of settings compares, each a change of one.
struct Variant {
  std::string name;
  std::function<void(sim::ReplayOptions&)> change;
};

const std::vector<Variant> kVariants = {
    {"as they are", [](sim::ReplayOptions&) {}},
    {"shake ρ 0.005", [](sim::ReplayOptions& o) { o.shake = 0.005; }},
    {"shake ρ 0.02", [](sim::ReplayOptions& o) { o.shake = 0.02; }},
    {"no shake, gravity alone", [](sim::ReplayOptions& o) { o.shake = 0; }},
    {"tolerance 1e-4 D", [](sim::ReplayOptions& o) { o.tolerance = 1e-4; }},
    {"tolerance 1e-2 D", [](sim::ReplayOptions& o) { o.tolerance = 1e-2; }},
    {"squeeze 100 weights", [](sim::ReplayOptions& o) { o.squeeze_N = 100; }},
    {"squeeze 10,000 weights", [](sim::ReplayOptions& o) { o.squeeze_N = 10'000; }},
    {"finger stiffness halved", [](sim::ReplayOptions& o) { o.stiffness_factor = 0.5; }},
    {"finger stiffness doubled", [](sim::ReplayOptions& o) { o.stiffness_factor = 2; }},
    {"time step halved", [](sim::ReplayOptions& o) { o.timestep_factor = 0.5; }},
    {"time step doubled", [](sim::ReplayOptions& o) { o.timestep_factor = 2; }},
};

/// A squeeze given in weights becomes newtons of a body of 0.1 kg.
sim::ReplayOptions OptionsFor(const Variant& variant) {
  sim::ReplayOptions options;
  variant.change(options);
  if (options.squeeze_N) {
    constexpr double kGravityOnEarth = 9.81;
    options.mass_kg = 0.1;
    *options.squeeze_N *= *options.mass_kg * kGravityOnEarth;
  }
  return options;
}

TableFile SettingsTable(const std::vector<Body>& bodies, int count, std::uint64_t seed) {
  TableFile table{"settings",
                  "What the settings change: grasps that pass",
                  {"setting", "at most 0.98 of the critical friction", "0.98 to 1",
                   "above it, quality under 0.01", "0.01 to 0.02", "0.02 and more"},
                  {}};
  for (const Variant& variant : kVariants) {
    std::vector<Sample> samples;
    for (const Body& body : bodies) {
      const auto more = ExamineHolds(body, count, seed, OptionsFor(variant));
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
  plot.x_title = "friction over the grasp's critical friction";
  plot.y_title = "largest displacement over the diameter";
  plot.x_from = kLeastRatio;
  plot.x_to = kMostRatio;
  plot.y_from = 1e-8;
  plot.y_to = 10;
  plot.level = sim::ReplayOptions().tolerance;
  plot.level_name = "tolerance";
  plot.series = {{"force closure, quality above the shake", "#2166ac", {}},
                 {"force closure, quality below the shake", "#e08214", {}},
                 {"not force closure", "#b2182b", {}}};
  for (const Sample& sample : samples) {
    const std::size_t series =
        sample.ratio < 1 ? 2 : (sample.quality < sim::ReplayOptions().shake ? 1 : 0);
    plot.series[series].points.emplace_back(sample.ratio, sample.displacement);
  }
  return plot;
}

int Run(const std::filesystem::path& models, const std::filesystem::path& folder, int count) {
  constexpr std::uint64_t kSeed = 2026;
  std::filesystem::create_directories(folder);
  std::vector<Body> bodies;
  for (const char* name : kBodies) bodies.emplace_back(models / name);
  std::vector<Sample> holds;
  std::vector<Sample> switches;
  for (const Body& body : bodies) {
    sim::ReplayOptions both;
    both.protocol = sim::Protocol::kBoth;
    const auto held = ExamineHolds(body, count, kSeed, both);
    const auto switched = ExamineSwitches(body, count, kSeed, both);
    holds.insert(holds.end(), held.begin(), held.end());
    switches.insert(switches.end(), switched.begin(), switched.end());
    std::fprintf(stderr, "%s: %d holds and %d switches\n", body.name().c_str(), count, count);
  }
  const auto ratio = [](const Sample& s) { return std::optional(s.ratio); };
  const auto quality = [](const Sample& s) {
    return s.ratio < 1 ? std::nullopt : std::optional(s.quality);
  };
  WriteTable(
      RangeTable("holds_by_friction", "Random grasps that pass, by friction over the critical one",
                 "friction", kRatios, holds, ratio),
      folder);
  WriteTable(RangeTable("holds_by_quality", "Force-closure grasps that pass, by quality", "quality",
                        kQualities, holds, quality),
             folder);
  WriteTable(
      RangeTable("switches_by_friction",
                 "Random switches that pass, by friction over the critical one of the grasp after",
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
  std::printf("%zu holds, %zu switches, %d passes at or below 0.98 of the critical friction\n",
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
