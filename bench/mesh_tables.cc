// Tables 6.1 to 6.12 of Phoka 2010.
// They are for meshes of about 500 and 1000 triangles in 30, 50 and 70 clusters at a friction angle
// of 10 degrees. They contain the roadmaps of representatives, 30 random queries on each, and the
// success of the local planners. The program writes Markdown and CSV into a folder.
//
// The queries of the tables do not use the fallback to all contact points. Each query is run once
// more with it. The program fails if this run finds no sequence without showing that there is none.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bench/table_file.h"
#include "planner/base/number.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/object/polyhedron.h"
#include "planner/roadmap/roadmap_planner.h"

namespace {

using namespace regrasp;

constexpr double kDegrees = 10;
constexpr int kQueries = 30;
constexpr int kSamples = 10'000;
constexpr std::uint64_t kSeed = 1;
constexpr std::array kSizes = {500, 1000};
constexpr std::array kClusterCounts = {30, 50, 70};
constexpr std::array kBodies = {"ellipsoid", "flask", "mug", "spanner", "star", "duck"};

std::string Milliseconds(double seconds) { return FormatFixed(1e3 * seconds, 2); }

struct Setting {
  std::string body;
  int triangles = 0;
  int clusters = 0;
};

/// Return one row of tables 6.1 to 6.6.
std::vector<std::string> QueryRow(const Setting& setting, const roadmap::ClusteredRoadmap& roadmap,
                                  double seconds,
                                  const std::vector<roadmap::RandomQuery>& queries) {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  double sum = 0;
  int connected = 0;
  for (const roadmap::RandomQuery& query : queries) {
    shortest = std::min(shortest, query.seconds);
    longest = std::max(longest, query.seconds);
    sum += query.seconds;
    connected += query.chain.grasps.empty() ? 0 : 1;
  }
  return {setting.body,
          std::to_string(roadmap.roadmap.vertex_count()),
          std::to_string(roadmap.components.count()),
          Milliseconds(seconds),
          std::to_string(connected),
          Milliseconds(shortest),
          Milliseconds(longest),
          Milliseconds(sum / static_cast<double>(queries.size()))};
}

/// Return one row of tables 6.7 to 6.12:
/// - the share of random force-closure grasps accepted by Algorithms 1 and 2;
/// - the number of links by them of the first 30 accepted grasps;
/// - the number of links by Algorithm 3 of the first 30 grasps accepted by neither.
std::vector<std::string> LocalRow(const Setting& setting, const roadmap::ClusteredRoadmap& roadmap,
                                  const object::Polyhedron& solid) {
  const criteria::GraspCriteria force_closure = {roadmap.friction_angle, 0};
  const criteria::GraspEvaluator evaluator(solid, force_closure);
  roadmap::GraspOracle oracle(solid, roadmap.clusters.contacts(), force_closure);
  roadmap::LocalPlanners local(roadmap.clusters, roadmap.roadmap, oracle);
  RandomStream random(kSeed, RandomUse::kStart);
  struct Count {
    int taken = 0;
    int linked = 0;
    void Add(const std::vector<roadmap::Quadruple>& way) {
      if (++taken <= kQueries) linked += way.empty() ? 0 : 1;
    }
  };
  Count first, second, third;
  int samples = 0;
  for (; samples < kSamples; ++samples) {
    const std::optional<roadmap::Quadruple> grasp =
        roadmap::DrawContactGrasp(roadmap, evaluator, random);
    if (!grasp) break;
    const bool takes_first = local.OwnRepresentatives(*grasp).has_value();
    const bool takes_second = local.FindNearestCluster(*grasp).has_value();
    const auto add = [&](Count& count, auto run) {
      count.Add(count.taken < kQueries ? run() : std::vector<roadmap::Quadruple>());
    };
    if (takes_first) add(first, [&] { return local.RunAlgorithm1(*grasp); });
    if (takes_second) add(second, [&] { return local.RunAlgorithm2(*grasp); });
    if (!takes_first && !takes_second) add(third, [&] { return local.RunAlgorithm3(*grasp); });
  }
  const auto percent = [&](const Count& count) {
    return FormatFixed(100.0 * count.taken / std::max(samples, 1), 2);
  };
  const auto of_those = [](const Count& count) {
    const int asked = std::min(count.taken, kQueries);
    return std::to_string(count.linked) + (asked == kQueries ? "" : " of " + std::to_string(asked));
  };
  return {setting.body,    percent(first),   of_those(first),
          percent(second), of_those(second), of_those(third)};
}

class Tables {
 public:
  explicit Tables(std::filesystem::path models) : models_(std::move(models)) {
    int number = 1;
    for (const int triangles : kSizes) {
      for (const int clusters : kClusterCounts) AddEmpty(number++, triangles, clusters);
    }
  }

  /// @returns true if all queries were answered.
  bool Fill(const std::string& body) {
    bool answered = true;
    int table = 0;
    for (const int triangles : kSizes) {
      for (const int clusters : kClusterCounts) {
        answered = Fill({body, triangles, clusters}, table++) && answered;
      }
    }
    return answered;
  }

  void Write(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder);
    for (const TableFile& table : queries_) WriteTable(table, folder);
    for (const TableFile& table : local_) WriteTable(table, folder);
  }

 private:
  void AddEmpty(int number, int triangles, int clusters) {
    const auto name = [](int table) { return "table_6_" + std::to_string(table); };
    const auto title = [&](int table, const std::string& what) {
      return "Table 6." + std::to_string(table) + ": " + what + " of meshes of about " +
             std::to_string(triangles) + " triangles in " + std::to_string(clusters) + " clusters";
    };
    queries_.push_back({name(number),
                        title(number, "roadmaps and queries"),
                        {"body", "# vertices", "# cc", "time (ms)", "# joined of 30",
                         "search min (ms)", "max (ms)", "mean (ms)"},
                        {}});
    const int second = number + static_cast<int>(kSizes.size() * kClusterCounts.size());
    local_.push_back({name(second),
                      title(second, "local planning"),
                      {"body", "Algorithm 1 % run", "# linked of 30", "Algorithm 2 % run",
                       "# linked of 30", "Algorithm 3 # linked of 30"},
                      {}});
  }

  bool Fill(const Setting& setting, int table) {
    const std::string name = setting.body + std::to_string(setting.triangles) + ".obj";
    const object::ObjectFile file = object::ReadObject(models_ / name);
    const auto& solid = dynamic_cast<const object::Polyhedron&>(*file.object);
    roadmap::ClusteredRoadmapOptions options;
    options.friction_angle = Radians(kDegrees);
    options.clusters = setting.clusters;
    const auto begin = std::chrono::steady_clock::now();
    const roadmap::ClusteredRoadmap roadmap(solid, options);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    queries_[table].rows.push_back(QueryRow(
        setting, roadmap, time.count(),
        roadmap::RunRandomQueries(roadmap, solid, kQueries, kSeed, /*last_resort=*/false)));
    local_[table].rows.push_back(LocalRow(setting, roadmap, solid));
    int answered = 0;
    int exhausted = 0;
    for (const roadmap::RandomQuery& query :
         roadmap::RunRandomQueries(roadmap, solid, kQueries, kSeed, /*last_resort=*/true)) {
      exhausted += query.chain.exhausted && query.chain.grasps.empty() ? 1 : 0;
      answered += query.chain.grasps.empty() ? 0 : 1;
    }
    std::printf(
        "%s, %d clusters: with the last resort %d of %d queries joined, %d shown to have "
        "no sequence\n",
        name.c_str(), setting.clusters, answered, kQueries, exhausted);
    return answered + exhausted == kQueries;
  }

  std::filesystem::path models_;
  std::vector<TableFile> queries_;
  std::vector<TableFile> local_;
};

int Run(const std::vector<std::string>& arguments) {
  Tables tables(arguments[0]);
  std::vector<std::string> bodies(arguments.begin() + 2, arguments.end());
  if (bodies.empty()) bodies.assign(kBodies.begin(), kBodies.end());
  bool answered = true;
  for (const std::string& body : bodies) answered = tables.Fill(body) && answered;
  tables.Write(arguments[1]);
  return answered ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: mesh_tables MODELS_FOLDER OUTPUT_FOLDER [BODY…]\n");
    return 2;
  }
  try {
    return Run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mesh_tables: %s\n", error.what());
    return 2;
  }
}
