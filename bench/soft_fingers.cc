// Random grasps of soft fingers, of two to four contacts on solids, at 0.5 to 0.98 of their
// critical friction, where the analytic check and a replay must fail, and at 1.1 to 1.5 times it,
// where the check must pass and the replay of those whose quality is above the shake. Ends with 1
// where a grasp below passes either.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/table_file.h"
#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/in_blocks.h"
#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/quality.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/sampling/surface_sampler.h"
#include "sim/replay/replay.h"

namespace {

using namespace regrasp;

constexpr std::array kBodies = {"cube.obj", "l_block.obj", "hole_block.obj", "stone.obj",
                                "mug500.obj"};
constexpr double kMostCritical = Radians(50);
constexpr double kLeastCritical = Radians(0.5);
/// Of the diameter: a fingertip of a few millimetres on a body of ten centimetres.
constexpr double kLeastTorsion = 0.005;
constexpr double kMostTorsion = 0.1;

struct Case {
  grasp::Grasp grasp;
  double critical_mu = 0;
  bool needs_torsion = false;  ///< hard points would need more friction, or fail at any
  double below = 0;            ///< factors of the critical friction
  double above = 0;
};

struct Outcome {
  bool too_close = false;  ///< the analysis below the critical friction is too close to call
  bool passed_analysis = false;
  bool passed_replay = false;
  bool above_analysis = false;
  bool above_good = false;  ///< its quality is above the shake
  bool above_replay = false;
};

/// Contacts drawn evenly over the surface, all of one torsion.
grasp::Grasp DrawGrasp(const object::Object& body, const sampling::SurfaceSampler& source,
                       int count, RandomStream& random) {
  grasp::Grasp grasp;
  const double torsion =
      body.diameter() * (kLeastTorsion * std::pow(kMostTorsion / kLeastTorsion, random.Uniform()));
  for (int i = 0; i < count; ++i) {
    grasp.push_back(source.Draw(random));
    grasp.back().torsion = torsion;
  }
  return grasp;
}

std::optional<Case> DrawCase(const object::Object& body, const sampling::SurfaceSampler& source,
                             int count, RandomStream& random) {
  Case drawn;
  drawn.grasp = DrawGrasp(body, source, count, random);
  const object::WrenchFrame frame = body.wrench_frame();
  if (!grasp::IsForceClosure(drawn.grasp, frame, kMostCritical)) return std::nullopt;
  const auto required = grasp::ComputeRequiredHalfAngle(drawn.grasp, frame);
  if (!required || required->upper < kLeastCritical) return std::nullopt;
  drawn.critical_mu = std::tan(required->upper);
  grasp::Grasp hard = drawn.grasp;
  for (grasp::Contact& contact : hard) contact.torsion = 0;
  drawn.needs_torsion = !grasp::IsForceClosure(hard, frame, 1.01 * required->upper);
  drawn.below = 0.5 + 0.48 * random.Uniform();
  drawn.above = 1.1 + 0.4 * random.Uniform();
  return drawn;
}

bool Replays(const object::Object& body, const grasp::Grasp& grasp, double mu) {
  plan::Plan plan;
  plan.half_angle = std::atan(mu);
  plan.fingers = static_cast<int>(grasp.size());
  plan.initial = plan::FingersInOrder(grasp);
  plan.goal = grasp;
  plan.torsion = grasp.front().torsion;
  return sim::ReplayPlan(body, plan, {}).steps.back().reason == plan::Reason::kNone;
}

Outcome Examine(const object::Object& body, const Case& of) {
  const object::WrenchFrame frame = body.wrench_frame();
  const auto decide = [&](double mu) {
    return grasp::TestForceClosure(of.grasp, frame, std::atan(mu)).decision;
  };
  Outcome outcome;
  const double below = of.below * of.critical_mu, above = of.above * of.critical_mu;
  outcome.too_close = decide(below) == grasp::Decision::kTooClose;
  outcome.passed_analysis = decide(below) == grasp::Decision::kYes;
  outcome.passed_replay = Replays(body, of.grasp, below);
  outcome.above_analysis = decide(above) == grasp::Decision::kYes;
  // Some margin, as the replay is at the contacts as they come to be.
  const double least = 1.2 * sim::ReplayOptions().shake;
  outcome.above_good = grasp::QualityAtLeast(of.grasp, frame, std::atan(above), least);
  if (outcome.above_good) outcome.above_replay = Replays(body, of.grasp, above);
  return outcome;
}

struct Row {
  int grasps = 0, needs_torsion = 0, too_close = 0, analysis = 0, replay = 0;
  int above = 0, good = 0, above_replay = 0;

  Row& operator+=(const Row& o) {
    grasps += o.grasps;
    needs_torsion += o.needs_torsion;
    too_close += o.too_close;
    analysis += o.analysis;
    replay += o.replay;
    above += o.above;
    good += o.good;
    above_replay += o.above_replay;
    return *this;
  }
};

Row CountAll(const std::vector<Case>& cases, const std::vector<Outcome>& outcomes) {
  Row row;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Outcome& outcome = outcomes[i];
    ++row.grasps;
    row.needs_torsion += cases[i].needs_torsion;
    row.too_close += outcome.too_close;
    row.analysis += outcome.passed_analysis;
    row.replay += outcome.passed_replay;
    row.above += outcome.above_analysis;
    row.good += outcome.above_good;
    row.above_replay += outcome.above_replay;
  }
  return row;
}

std::vector<std::string> Cells(const std::string& name, const Row& row) {
  std::vector<std::string> cells = {name};
  for (const int count : {row.grasps, row.needs_torsion, row.too_close, row.analysis, row.replay,
                          row.above, row.good, row.above_replay}) {
    cells.push_back(std::to_string(count));
  }
  return cells;
}

Row ExamineBody(const object::Object& body, int contacts, int count) {
  const sampling::SurfaceSampler source(body);
  RandomStream random(2026, RandomUse::kStart);
  std::vector<Case> cases;
  while (static_cast<int>(cases.size()) < count) {
    if (auto drawn = DrawCase(body, source, contacts, random)) cases.push_back(*std::move(drawn));
  }
  std::vector<Outcome> outcomes(cases.size());
  InBlocks(cases.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) outcomes[i] = Examine(body, cases[i]);
  });
  return CountAll(cases, outcomes);
}

int Run(const std::filesystem::path& models, const std::filesystem::path& folder, int count) {
  std::filesystem::create_directories(folder);
  TableFile table{
      "soft_fingers",
      "Random grasps of soft fingers below and above their critical friction",
      {"body and contacts", "grasps", "hard points need more friction", "below: too close to call",
       "below: pass the analysis", "below: pass the replay", "above: pass the analysis",
       "of these above 1.2 times the shake", "of these pass the replay"},
      {}};
  Row all;
  for (const char* name : kBodies) {
    const object::ObjectFile file = object::ReadObject(models / name);
    for (const int contacts : {2, 3, 4}) {
      const Row row = ExamineBody(*file.object, contacts, count);
      all += row;
      const std::string title =
          std::filesystem::path(name).stem().string() + ", " + std::to_string(contacts);
      table.rows.push_back(Cells(title, row));
      std::fprintf(stderr, "%s done\n", title.c_str());
    }
  }
  table.rows.push_back(Cells("all", all));
  WriteTable(table, folder);
  std::printf("%d grasps below their critical friction: %d pass the analysis, %d the replay\n",
              all.grasps, all.analysis, all.replay);
  return all.analysis + all.replay == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = argc == 4 ? ParseDouble(argv[3]) : std::optional<double>();
  if (!count || *count < 1 || *count > 1e6) {
    std::fprintf(stderr, "usage: soft_fingers MODELS_FOLDER OUTPUT_FOLDER GRASPS_PER_KIND\n");
    return 2;
  }
  try {
    return Run(argv[1], argv[2], static_cast<int>(*count));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "soft_fingers: %s\n", error.what());
    return 2;
  }
}
