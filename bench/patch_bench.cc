// What plans on rough surfaces are worth: plans between random grasps on bodies as they are and
// with noise added to their vertices, and how many of them have a grasp at rest that is not force
// closure with the mean normals of the patches about its contacts. Prints Markdown.
//
// The mean normals are computed by code of the benchmark's own (patch_judge.h).

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/patch_judge.h"
#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_half_angle.h"
#include "planner/object/mesh_defect.h"
#include "planner/object/read_soup.h"
#include "planner/plan/locate.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"
#include "planner/repair/repair.h"

namespace {

using namespace regrasp;
using Eigen::Vector3d;

constexpr int kBadUsage = 2;

/// How a plan takes roughness into account.
struct Design {
  std::string name;
  std::optional<double> most_angle_deg;  ///< between a contact's normal and the patch's
  double in_hand_deg = 0;                ///< of the half-angle
};

const std::vector<Design> kDesigns = {
    {"no patch", std::nullopt, 0}, {"no patch, 5° in hand", std::nullopt, 5},
    {"5°, 0° in hand", 5, 0},      {"5°, 5° in hand", 5, 5},
    {"10°, 5° in hand", 10, 5},    {"10°, 10° in hand", 10, 10}};

struct Arguments {
  std::vector<std::filesystem::path> files;
  std::vector<double> noises = {0};  ///< percent of the diameter
  int cuts = 0;
  int pairs = 20;
  double half_angle_deg = 20;
  double patch = object::kUsualPatch;
  std::string planner = "general";

  void AddTo(CLI::App& app) {
    app.add_option("OBJECT", files, "Solids, and scans that are repaired first")
        ->required()
        ->check(CLI::ExistingFile);
    app.add_option("--noise", noises, "Noise of the vertices, percent of the diameter")
        ->capture_default_str();
    app.add_option("--cuts", cuts, "So many times every triangle is cut in four before")
        ->check(CLI::Range(0, 5))
        ->capture_default_str();
    app.add_option("--pairs", pairs, "Plans on each body")->check(CLI::Range(1, 10'000));
    app.add_option("--friction-angle", half_angle_deg, "Half-angle that grasps are judged with")
        ->capture_default_str();
    app.add_option("--patch", patch, "Radius of the patch over the diameter")
        ->capture_default_str();
    app.add_option("--planner", planner, "The planner")->capture_default_str();
  }
};

/// What became of the plans of one design on one body.
struct Outcome {
  int asked = 0;
  int found = 0;
  int lost_plans = 0;
  int rests = 0;
  int lost_rests = 0;
  double least_margin_deg = 90;  ///< of a rest with mean normals
  double seconds = 0;

  void Add(const Outcome& other) {
    asked += other.asked;
    found += other.found;
    lost_plans += other.lost_plans;
    rests += other.rests;
    lost_rests += other.lost_rests;
    least_margin_deg = std::min(least_margin_deg, other.least_margin_deg);
    seconds += other.seconds;
  }
};

/// A vertex in the middle of each edge, and four triangles of one.
void CutInFour(object::PolygonSoup& soup) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<std::vector<int>> facets;
  const auto middle = [&](int a, int b) {
    const auto [at, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(soup.vertices.size()));
    if (is_new) soup.vertices.push_back((soup.vertices[a] + soup.vertices[b]) / 2);
    return at->second;
  };
  for (const std::vector<int>& facet : soup.facets) {
    const int a = facet[0], b = facet[1], c = facet[2];
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& part : {std::vector{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      facets.push_back(part);
    }
  }
  soup.facets = std::move(facets);
  soup.invented.clear();
}

object::PolygonSoup SoupOf(const object::Polyhedron& solid) {
  object::PolygonSoup soup{solid.vertices(), {}};
  for (const auto& triangle : solid.triangles()) {
    soup.facets.emplace_back(triangle.begin(), triangle.end());
  }
  return soup;
}

/// The solid itself, of one whose facets have no angle to be cut by.
object::PolygonSoup ReadSolid(const std::filesystem::path& path) {
  object::PolygonSoup soup = object::ReadSoup(path, {}).soup;
  try {
    return SoupOf(object::Polyhedron::FromSoup(soup, path.string()));
  } catch (const object::MeshError&) {
    return repair::Repair(soup, path.string(), {}).solid;
  }
}

void AddNoise(double deviation, std::uint64_t seed, object::PolygonSoup& soup) {
  RandomStream random(seed, RandomUse::kTrialContacts);
  for (Vector3d& v : soup.vertices) {
    for (int k = 0; k < 3; ++k) v[k] += deviation * random.Normal();
  }
}

/// A solid; where noise made facets cross, what a repair makes of it.
object::PolygonSoup MakeBody(object::PolygonSoup soup, double noise, double diameter) {
  if (noise == 0) return soup;
  AddNoise(noise / 100 * diameter, 1, soup);
  return repair::Repair(soup, "noisy body", {}).solid;
}

std::vector<grasp::Grasp> RestsOf(const plan::Plan& plan) {
  plan::FingerGrasp holding = plan.initial;
  std::vector<grasp::Grasp> rests = {plan::ContactsOf(holding)};
  for (const plan::Step& step : plan.steps) {
    holding = plan::GraspAfter(holding, step);
    rests.push_back(plan::ContactsOf(holding));
  }
  return rests;
}

void Judge(const PatchJudge& judge, const object::Object& object, const plan::Plan& plan,
           double half_angle, Outcome& outcome) {
  ++outcome.found;
  bool lost = false;
  const plan::Plan located = plan::LocatePlan(object, plan);
  for (const grasp::Grasp& rest : RestsOf(located)) {
    const grasp::Grasp felt = judge.WithMeanNormals(rest);
    const auto required = grasp::ComputeRequiredHalfAngle(felt, object.wrench_frame());
    const bool holds = grasp::IsForceClosure(felt, object.wrench_frame(), half_angle);
    ++outcome.rests;
    outcome.lost_rests += holds ? 0 : 1;
    lost = lost || !holds;
    const double margin_deg = required ? Degrees(half_angle - required->upper) : -90;
    outcome.least_margin_deg = std::min(outcome.least_margin_deg, margin_deg);
  }
  outcome.lost_plans += lost ? 1 : 0;
}

Outcome RunDesign(const Arguments& arguments, const object::PolygonSoup& soup,
                  const Design& design) {
  object::Reading reading;
  if (design.most_angle_deg) {
    reading.patch = object::FeltPatch{std::nullopt, Radians(*design.most_angle_deg)};
  }
  object::Polyhedron body = object::Polyhedron::FromSoup(soup, "body", reading);
  const double radius = arguments.patch * body.diameter();
  if (reading.patch && arguments.patch != object::kUsualPatch) {
    reading.patch->radius = radius;
    body = object::Polyhedron::FromSoup(soup, "body", reading);
  }
  const PatchJudge judge(body, radius);
  const double half_angle = Radians(arguments.half_angle_deg);
  planning::PlanRequest request;
  request.object = &body;
  request.criteria.half_angle = half_angle - Radians(design.in_hand_deg);
  request.start = {planning::GraspChoice::Kind::kRandomAny, {}, "start"};
  request.goal = {planning::GraspChoice::Kind::kRandomAny, {}, "goal"};
  Outcome outcome;
  for (int seed = 0; seed < arguments.pairs; ++seed) {
    request.seed = static_cast<std::uint64_t>(seed);
    const auto begin = std::chrono::steady_clock::now();
    const planning::PlanResult result =
        planning::Solve(registry::PlannerFor(arguments.planner, request), request);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    ++outcome.asked;
    outcome.seconds += time.count();
    if (result.plan) Judge(judge, body, *result.plan, half_angle, outcome);
  }
  return outcome;
}

void PrintRow(const std::string& body, const std::string& noise, const Design& design,
              const Outcome& outcome) {
  std::printf("| %s | %s | %s | %d of %d | %d | %d of %d | %s | %s |\n", body.c_str(),
              noise.c_str(), design.name.c_str(), outcome.found, outcome.asked, outcome.lost_plans,
              outcome.lost_rests, outcome.rests, FormatFixed(outcome.least_margin_deg, 1).c_str(),
              FormatFixed(1e3 * outcome.seconds / std::max(outcome.asked, 1), 0).c_str());
  std::fflush(stdout);
}

void Run(const Arguments& arguments) {
  std::printf(
      "| body | noise, %% D | design | plans | lost plans | lost rests | least margin, ° | ms |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  std::map<double, std::vector<Outcome>> sums;
  for (const std::filesystem::path& file : arguments.files) {
    object::PolygonSoup clean = ReadSolid(file);
    for (int i = 0; i < arguments.cuts; ++i) CutInFour(clean);
    const double diameter = object::Polyhedron::FromSoup(clean, file.string()).diameter();
    for (const double noise : arguments.noises) {
      std::vector<Outcome>& sum = sums[noise];
      sum.resize(kDesigns.size());
      try {
        const object::PolygonSoup body = MakeBody(clean, noise, diameter);
        for (std::size_t d = 0; d < kDesigns.size(); ++d) {
          const Outcome outcome = RunDesign(arguments, body, kDesigns[d]);
          PrintRow(file.stem().string(), FormatShort(noise), kDesigns[d], outcome);
          sum[d].Add(outcome);
        }
      } catch (const InputError& error) {
        std::printf("%s, noise of %s %%: %s\n", file.stem().string().c_str(),
                    FormatShort(noise).c_str(), error.what());
      }
    }
  }
  for (const auto& [noise, sum] : sums) {
    for (std::size_t d = 0; d < kDesigns.size(); ++d) {
      PrintRow("all", FormatShort(noise), kDesigns[d], sum[d]);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Judges plans on rough surfaces with the mean normals of patches.", "patch_bench");
  Arguments arguments;
  arguments.AddTo(app);
  try {
    app.parse(argc, argv);
    Run(arguments);
    return 0;
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : (app.exit(error), kBadUsage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "patch_bench: %s\n", error.what());
    return kBadUsage;
  }
}
