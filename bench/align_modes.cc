// How aligns are carried out: aligns of plans, and aligns of grasps that need every finger,
// replayed with spare fingers that take over and with fingers that slide, at the plan's friction
// and at 0.9 of what the align needs, the analytic check bypassed. Writes a table.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/table_file.h"
#include "bench/tight_aligns.h"
#include "planner/base/angle.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/check.h"
#include "planner/planning/solve.h"
#include "planner/sets/contour/contour_planner.h"
#include "planner/sets/polygon/polygon_planner.h"
#include "planner/sets/polyhedron/polyhedron_planner.h"
#include "sim/replay/replay.h"

namespace {

using namespace regrasp;

/// Below it an align is not force closure somewhere on its way, by a clear margin.
constexpr double kBadFriction = 0.9;

/// With little friction every finger of a grasp of four (in the plane: two or three) is needed;
/// with much the others often hold the object alone.
constexpr std::array kSpatialFrictions = {20.0, 40.0};  // degrees
constexpr std::array kPlanarFrictions = {15.0, 35.0};

using PlanFinder = std::function<planning::PlanResult(std::uint64_t seed)>;

/// One align as a plan of its own.
struct AlignCase {
  const object::Object* object;
  std::string body;
  plan::Plan plan;
  double required = 0;  ///< half-angle, radians
};

struct Outcome {
  std::string body;
  bool passed = false;
  bool held = false;  ///< the hold before the align passed
  plan::Reason reason = plan::Reason::kNone;
  double drift = 0;  ///< over D, as slip
  double slip = 0;
  double milliseconds = 0;
  sim::AlignShares shares;
};

/// Adds the aligns of a plan in which a finger moves.
void AddAligns(const object::Object& object, const std::string& body, const plan::Plan& plan,
               std::vector<AlignCase>& cases) {
  const plan::PlanCheck check = plan::CheckPlan(object, plan);
  plan::FingerGrasp before = check.located.initial;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const plan::Step& step = check.located.steps[i];
    if (const auto* align = std::get_if<plan::Align>(&step); align && check.steps[i + 1].required) {
      AlignCase found{&object, body, check.located, check.steps[i + 1].required->upper};
      found.plan.initial = before;
      found.plan.steps = {*align};
      cases.push_back(std::move(found));
    }
    before = plan::GraspAfter(before, step);
  }
}

/// Aligns of plans between random grasps, from the seeds 0, 1, … on.
void CollectAligns(const object::ObjectFile& file, const PlanFinder& find, std::size_t count,
                   std::vector<AlignCase>& cases) {
  constexpr std::uint64_t kMostSeeds = 1000;
  const std::size_t wanted = cases.size() + count;
  for (std::uint64_t seed = 0; seed < kMostSeeds && cases.size() < wanted; ++seed) {
    const planning::PlanResult result = find(seed);
    if (result.plan) AddAligns(*file.object, file.file, *result.plan, cases);
  }
  cases.resize(std::min(cases.size(), wanted));
}

const planning::GraspChoice kAny = {planning::GraspChoice::Kind::kRandom, {}, "random"};

Outcome Replay(const AlignCase& align, sim::AlignChoice choice, double half_angle) {
  sim::ReplayOptions options;
  options.align = choice;
  options.half_angle = half_angle;
  const auto begin = std::chrono::steady_clock::now();
  const sim::ReplayResult result = sim::ReplayPlan(*align.object, align.plan, options);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - begin;
  const sim::StepReplay& last = result.steps.back();
  Outcome outcome;
  outcome.body = align.body;
  outcome.held = result.steps.size() == 2;
  outcome.passed = outcome.held && last.reason == plan::Reason::kNone;
  outcome.reason = last.reason;
  outcome.drift = last.drift_m / result.settings.diameter_m;
  outcome.slip = last.slip_m / result.settings.diameter_m;
  outcome.milliseconds = time.count();
  outcome.shares = last.align_shares;
  return outcome;
}

std::vector<Outcome> ReplayAll(const std::vector<AlignCase>& cases, sim::AlignChoice choice,
                               bool bad) {
  std::vector<Outcome> outcomes;
  for (const AlignCase& align : cases) {
    const double half_angle =
        bad ? std::atan(kBadFriction * std::tan(align.required)) : align.plan.half_angle;
    outcomes.push_back(Replay(align, choice, half_angle));
  }
  return outcomes;
}

double Mean(const std::vector<Outcome>& outcomes, const std::function<double(const Outcome&)>& of) {
  double sum = 0;
  for (const Outcome& outcome : outcomes) sum += of(outcome);
  return outcomes.empty() ? 0 : sum / static_cast<double>(outcomes.size());
}

/// Over those that pass: what failed has gone anywhere.
double Largest(const std::vector<Outcome>& outcomes, double Outcome::*of) {
  double largest = 0;
  for (const Outcome& outcome : outcomes) {
    if (outcome.passed) largest = std::max(largest, outcome.*of);
  }
  return largest;
}

std::string Count(const std::vector<Outcome>& outcomes, bool Outcome::*of) {
  const auto count = std::ranges::count(outcomes, true, of);
  return std::to_string(count) + " of " + std::to_string(outcomes.size());
}

struct Table {
  TableFile file = {"aligns",
                    "How aligns are carried out",
                    {"aligns", "mode", "pass", "of the way imitated", "slid", "best effort",
                     "largest drift over D", "largest slip over D", "mean ms",
                     "at 0.9 of the friction: pass", "hold passes"},
                    {}};
  std::string samples = "aligns,mode,body,friction,verdict,reason,drift,slip,ms,slid\n";
  int false_passes = 0;

  void Add(const std::string& name, const std::vector<AlignCase>& cases) {
    for (const sim::AlignChoice choice : {sim::AlignChoice::kImitate, sim::AlignChoice::kSlide}) {
      const std::string mode = choice == sim::AlignChoice::kSlide ? "slide" : "imitate";
      const std::vector<Outcome> good = ReplayAll(cases, choice, false);
      const std::vector<Outcome> bad = ReplayAll(cases, choice, true);
      const auto share = [&](double sim::AlignShares::*of) {
        return FormatFixed(Mean(good, [of](const Outcome& o) { return o.shares.*of; }), 2);
      };
      file.rows.push_back(
          {name, mode, Count(good, &Outcome::passed), share(&sim::AlignShares::imitated),
           share(&sim::AlignShares::slid), share(&sim::AlignShares::best_effort),
           FormatShort(Largest(good, &Outcome::drift), 2),
           FormatShort(Largest(good, &Outcome::slip), 2),
           FormatFixed(Mean(good, [](const Outcome& o) { return o.milliseconds; }), 0),
           Count(bad, &Outcome::passed), Count(bad, &Outcome::held)});
      AddSamples(name + "," + mode, "plan", good);
      AddSamples(name + "," + mode, "0.9", bad);
      false_passes += static_cast<int>(std::ranges::count(bad, true, &Outcome::passed));
      std::fprintf(stderr, "%s, %s: %s\n", name.c_str(), mode.c_str(), file.rows.back()[2].c_str());
    }
  }

  void AddSamples(const std::string& name, const char* friction,
                  const std::vector<Outcome>& outcomes) {
    for (const Outcome& o : outcomes) {
      samples += name + "," + o.body + "," + friction + "," + (o.passed ? "pass" : "fail") + "," +
                 std::string(plan::ReasonName(o.reason)) + "," + FormatShort(o.drift, 3) + "," +
                 FormatShort(o.slip, 3) + "," + FormatFixed(o.milliseconds, 1) + "," +
                 FormatFixed(o.shares.slid, 3) + "\n";
    }
  }
};

/// Some of the models.
struct Bodies {
  std::vector<object::ObjectFile> files;

  Bodies(const std::filesystem::path& folder, const std::vector<const char*>& names) {
    for (const char* name : names) files.push_back(object::ReadObject(folder / name));
  }
};

/// Plans between random grasps by a planner, one for each seed. Both outlive what is returned.
std::function<planning::PlanResult(std::uint64_t)> PlansOf(const planning::Planner& planner,
                                                           const object::ObjectFile& file,
                                                           double half_angle) {
  return [&planner, &file, half_angle](std::uint64_t seed) {
    return planning::Solve(planner, {.object = file.object.get(),
                                     .start = kAny,
                                     .goal = kAny,
                                     .criteria = {.half_angle = half_angle},
                                     .seed = seed});
  };
}

std::vector<AlignCase> PolyhedronAligns(const Bodies& bodies, double half_angle, std::size_t each) {
  std::vector<AlignCase> cases;
  for (const object::ObjectFile& file : bodies.files) {
    const auto& solid = dynamic_cast<const object::Polyhedron&>(*file.object);
    polyhedron::PolyhedronGraph graph(solid, half_angle, planning::Spanning::kAdaptive);
    const polyhedron::PolyhedronPlanner planner(&graph);
    CollectAligns(file, PlansOf(planner, file, half_angle), each, cases);
  }
  return cases;
}

std::vector<AlignCase> PlanarAligns(const planning::Planner& planner, const Bodies& bodies,
                                    double half_angle, std::size_t each) {
  std::vector<AlignCase> cases;
  for (const object::ObjectFile& file : bodies.files) {
    CollectAligns(file, PlansOf(planner, file, half_angle), each, cases);
  }
  return cases;
}

std::vector<AlignCase> TightAligns(const Bodies& bodies, double half_angle, int each) {
  std::vector<AlignCase> cases;
  for (const object::ObjectFile& file : bodies.files) {
    for (const plan::Plan& plan : DrawTightAligns(*file.object, half_angle, each, 2026)) {
      AddAligns(*file.object, file.file, plan, cases);
    }
  }
  return cases;
}

int Run(const std::filesystem::path& models, const std::filesystem::path& folder, int each) {
  std::filesystem::create_directories(folder);
  const Bodies solids(models, {"body14.obj", "body24.obj", "body36.obj", "stone.obj"});
  const Bodies polygons(models, {"polygon15.wkt", "polygon25.wkt", "polygon40.wkt"});
  const Bodies contours(models, {"bottle200.wkt", "leaf300.wkt"});
  const auto wanted = static_cast<std::size_t>(each);
  Table table;
  const auto at = [](const char* name, double degrees) {
    return std::string(name) + ", " + FormatShort(degrees) + "°";
  };
  for (const double degrees : kSpatialFrictions) {
    table.Add(at("polyhedron", degrees), PolyhedronAligns(solids, Radians(degrees), wanted));
  }
  for (const double degrees : kPlanarFrictions) {
    table.Add(at("polygon", degrees),
              PlanarAligns(polygon::PolygonPlanner(), polygons, Radians(degrees), wanted));
    table.Add(at("contour", degrees),
              PlanarAligns(contour::ContourPlanner(), contours, Radians(degrees), wanted));
  }
  const int tight = (each + 3) / 4;
  const double spatial = kSpatialFrictions.front(), planar = kPlanarFrictions.front();
  table.Add(at("five contacts, each needed", spatial),
            TightAligns(solids, Radians(spatial), tight));
  table.Add(at("three contacts, each needed", planar),
            TightAligns(polygons, Radians(planar), tight));
  WriteTable(table.file, folder);
  WriteFile(folder / "aligns_samples.csv", table.samples);
  std::printf("%d passes at %s of the friction that the align needs\n", table.false_passes,
              FormatShort(kBadFriction).c_str());
  return table.false_passes == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = argc == 4 ? ParseDouble(argv[3]) : std::optional<double>();
  if (!count || *count < 1 || *count > 1e6) {
    std::fprintf(stderr, "usage: align_modes MODELS_FOLDER OUTPUT_FOLDER ALIGNS_PER_BODY\n");
    return 2;
  }
  try {
    return Run(argv[1], argv[2], static_cast<int>(*count));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "align_modes: %s\n", error.what());
    return 2;
  }
}
