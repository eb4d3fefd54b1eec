// How exactly engines hold Coulomb's friction at rest. A plate on three or four balls, tilted in
// twelve directions and twisted, at 0.7 to 1.1 times its critical friction: below it the plate has
// to slide, above it to stay. Then how fast a body creeps that is held inside its cones by the
// fingers of the replay. Writes both as tables.

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bench/plate.h"
#include "bench/random_grasps.h"
#include "bench/table_file.h"
#include "planner/base/angle.h"
#include "planner/base/number.h"
#include "sim/control/motions.h"
#include "sim/world/replay_world.h"
#include "sim/world/stillness.h"

namespace {

using namespace regrasp;

constexpr std::array kFrictions = {0.7, 0.9, 0.97, 0.98, 0.99, 0.995, 1.005, 1.01, 1.02, 1.03, 1.1};
constexpr double kTilt = Radians(20), kTwist = 0.3;
constexpr int kDirections = 12;
/// A plate that moves less, over its size, stays: at 0.995 it would slide by 0.08.
constexpr double kStays = 1e-3;

struct Contestant {
  std::string name;
  std::function<PlateMotion(const Plate&)> move;
};

sim::FrictionBox Square(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal,
                        const Eigen::Vector3d& force, double mu) {
  const double limit = mu * std::max(force.dot(normal), 0.0);
  return {direction, limit, limit};
}

/// ODE's own bound: a square with fixed directions.
sim::FrictionBox FixedSquare(const Eigen::Vector3d& normal, const Eigen::Vector3d& force,
                             double mu) {
  return Square((Eigen::Vector3d::UnitX() - normal.x() * normal).normalized(), normal, force, mu);
}

/// The same, turned towards the last friction force.
sim::FrictionBox TurnedSquare(const Eigen::Vector3d& normal, const Eigen::Vector3d& force,
                              double mu) {
  return Square(sim::BoxInCircle(normal, force, mu).direction, normal, force, mu);
}

std::vector<Contestant> Contestants() {
  constexpr int kMostSolutions = 20;
  return {{"MuJoCo, elliptic cones, settings of the replay",
           [](const Plate& plate) { return MoveInMujoco(plate, "elliptic", true); }},
          {"MuJoCo, elliptic cones, defaults",
           [](const Plate& plate) { return MoveInMujoco(plate, "elliptic", false); }},
          {"MuJoCo, pyramids, settings of the replay",
           [](const Plate& plate) { return MoveInMujoco(plate, "pyramidal", true); }},
          {"ODE, squares in fixed directions",
           [](const Plate& plate) { return MoveInOde(plate, FixedSquare, 1); }},
          {"ODE, squares turned towards the last force",
           [](const Plate& plate) { return MoveInOde(plate, TurnedSquare, 1); }},
          {"ODE, boxes in the circle, solved once",
           [](const Plate& plate) { return MoveInOde(plate, sim::BoxInCircle, 1); }},
          {"ODE, boxes in the circle, settings of the replay",
           [](const Plate& plate) { return MoveInOde(plate, sim::BoxInCircle, kMostSolutions); }}};
}

std::vector<Plate> Plates() {
  std::vector<Plate> plates;
  for (const int points : {3, 4}) {
    for (int k = 0; k < kDirections; ++k) {
      constexpr double kFirst = 0.1;
      plates.push_back({points, 0, kTilt, kFirst + 2 * std::numbers::pi * k / kDirections, 0});
    }
    plates.push_back({points, 0, 0, 0, kTwist});
  }
  return plates;
}

TableFile RestTable() {
  TableFile table{"friction_at_rest",
                  "Plates that do what they must not, by friction over the critical one",
                  {"engine"},
                  {}};
  for (const double friction : kFrictions) table.columns.push_back(FormatShort(friction));
  table.columns.emplace_back("creep");
  for (const Contestant& contestant : Contestants()) {
    std::vector<std::string> row = {contestant.name};
    double creep = 0;
    for (const double friction : kFrictions) {
      int wrong = 0;
      int all = 0;
      for (Plate plate : Plates()) {
        plate.mu = friction * plate.critical();
        const PlateMotion motion = contestant.move(plate);
        const bool stays = motion.moved < kStays;
        wrong += stays == (friction > 1) ? 0 : 1;
        if (stays && friction > 1) creep = std::max(creep, motion.creep);
        ++all;
      }
      row.push_back(std::to_string(wrong) + " of " + std::to_string(all));
    }
    row.push_back(FormatShort(creep, 2));
    table.rows.push_back(row);
  }
  return table;
}

/// How fast a held body creeps inside its cones, in diameters in a natural time.
double CreepOf(const GraspedBody& body, const RandomCase& drawn, sim::EngineChoice engine,
               double& metres_per_second) {
  sim::ReplayOptions options;
  options.engine = engine;
  const sim::ReplayObserver observer;
  sim::ReplayWorld world(body.object(), drawn.plan,
                         sim::MakeScene(body.object(), drawn.plan, 0, options), observer);
  sim::TakeHold(world, sim::ToScene(body.object(), drawn.plan.scale, drawn.plan.initial));
  if (!sim::WaitUntilStill(world)) return 0;
  constexpr double kWatched = 40;
  const Eigen::Isometry3d before = world.X_SB();
  world.Run(kWatched, [](double) {});
  const double moved = sim::MeasureMotion(before, world.X_SB(), world.settings().diameter_m / 2);
  metres_per_second =
      std::max(metres_per_second, moved / (kWatched * world.settings().natural_time_s));
  return moved / world.settings().diameter_m / kWatched;
}

TableFile CreepTable(const std::filesystem::path& models) {
  TableFile table{"creep",
                  "Creep of bodies held inside their cones, the largest of random grasps",
                  {"body", "grasps", "MuJoCo, D in a natural time", "MuJoCo, µm/s",
                   "ODE, D in a natural time", "ODE, µm/s"},
                  {}};
  constexpr int kGrasps = 40;
  constexpr std::uint64_t kSeed = 155;
  for (const char* name : kGraspedBodies) {
    const GraspedBody body(models / name);
    std::vector<RandomCase> cases = DrawHolds(body, kGrasps, kSeed);
    std::erase_if(cases, [](const RandomCase& drawn) { return drawn.ratio < 1.02; });
    std::vector<std::string> row = {body.name(), std::to_string(cases.size())};
    for (const sim::EngineChoice engine : {sim::EngineChoice::kMujoco, sim::EngineChoice::kOde}) {
      double creep = 0;
      double speed = 0;
      for (const RandomCase& drawn : cases) {
        creep = std::max(creep, CreepOf(body, drawn, engine, speed));
      }
      constexpr double kMicrometre = 1e-6;
      row.push_back(FormatShort(creep, 2));
      row.push_back(FormatShort(speed / kMicrometre, 2));
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: friction_at_rest MODELS_FOLDER OUTPUT_FOLDER\n");
    return 2;
  }
  // MuJoCo otherwise warns of plates that slide off their balls.
  mju_user_warning = [](const char*) {};
  try {
    std::filesystem::create_directories(argv[2]);
    WriteTable(RestTable(), argv[2]);
    WriteTable(CreepTable(argv[1]), argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "friction_at_rest: %s\n", error.what());
    return 2;
  }
}
