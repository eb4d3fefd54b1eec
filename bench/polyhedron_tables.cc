// Tables 5.1 to 5.5 of Phoka 2010 for the models body*.obj.
// They contain focus cells, links, connected components and time of the switching graph. The
// friction angle is 10 degrees, with uniform spanning, by direct computation and by random focus
// points. The program writes Markdown and CSV into a folder.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/sets/polyhedron/polyhedron_graph.h"

namespace {

using namespace regrasp;

constexpr double kDegrees = 10;
constexpr int kSampleCounts[] = {1000, 5000, 10000, 20000};
constexpr std::uint64_t kSeed = 1;
constexpr int kRuns = 5;  // the minimum time counts

struct Row {
  std::string body;
  int faces = 0;
  std::int64_t cells = 0;
  std::int64_t links = 0;
  int components = 0;
  double seconds = 0;
};

struct Table {
  std::string file;
  std::string title;
  std::vector<Row> rows;
};

std::vector<std::filesystem::path> BodyFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("body") && name.ends_with(".obj")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Return the processor time, which other programs do not affect.
double SecondsOf(const auto& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Return the result of `make` and its minimum time.
template <class Make>
auto Fastest(const Make& make, double& seconds) {
  seconds = std::numeric_limits<double>::infinity();
  for (int run = 0; run < kRuns; ++run) {
    seconds = std::min(seconds, SecondsOf([&] { (void)make(); }));
  }
  return make();
}

void AddBody(const std::filesystem::path& file, std::vector<Table>& tables) {
  const object::ObjectFile model = object::ReadObject(file);
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*model.object);
  const double friction_angle = Radians(kDegrees);
  Row row{file.stem().string(), solid.face_count(), 0, 0, 0, 0};
  polyhedron::PolyhedronGraph graph = Fastest(
      [&] {
        return polyhedron::PolyhedronGraph(solid, friction_angle, planning::Spanning::kUniform);
      },
      row.seconds);
  row.cells = graph.vertex_count();
  row.links = std::ssize(graph.switches());
  row.components = graph.components().count();
  tables.front().rows.push_back(row);
  const Eigen::AlignedBox3d region = polyhedron::FindSamplingRegion(solid, graph);
  for (std::size_t t = 1; t < tables.size(); ++t) {
    const polyhedron::SampledGraph sampled = Fastest(
        [&] {
          return polyhedron::SamplePolyhedron(solid, friction_angle, planning::Spanning::kUniform,
                                              region, kSampleCounts[t - 1], kSeed);
        },
        row.seconds);
    row.cells = std::ssize(sampled.quadruples);
    row.links = std::ssize(sampled.links);
    row.components = sampled.components;
    tables[t].rows.push_back(row);
  }
}

void Write(const Table& table, const std::filesystem::path& folder) {
  std::string markdown = "# " + table.title +
                         "\n\n| body | faces | # focus cells | # links | # cc | time (ms) |\n"
                         "| --- | --- | --- | --- | --- | --- |\n";
  std::string csv = "body,faces,focus_cells,links,components,seconds\n";
  for (const Row& row : table.rows) {
    const std::string counts[] = {row.body, std::to_string(row.faces), std::to_string(row.cells),
                                  std::to_string(row.links), std::to_string(row.components)};
    markdown += "|";
    for (const std::string& cell : counts) {
      markdown += " " + cell + " |";
      csv += cell + ",";
    }
    constexpr double kMillisecondsPerSecond = 1e3;
    markdown += " " + FormatFixed(kMillisecondsPerSecond * row.seconds, 2) + " |\n";
    csv += FormatFixed(row.seconds, 6) + "\n";
  }
  WriteFile(folder / (table.file + ".md"), markdown);
  WriteFile(folder / (table.file + ".csv"), csv);
}

int Run(const std::filesystem::path& models, const std::filesystem::path& folder) {
  std::vector<Table> tables = {{"table_5_1", "Table 5.1: direct computation", {}}};
  for (const int points : kSampleCounts) {
    const std::string number = std::to_string(tables.size() + 1);
    tables.push_back(
        {"table_5_" + number,
         "Table 5." + number + ": random sampling with " + std::to_string(points) + " points",
         {}});
  }
  const auto files = BodyFiles(models);
  if (files.empty()) {
    std::fprintf(stderr, "%s: no body*.obj\n", models.c_str());
    return 2;
  }
  for (const std::filesystem::path& file : files) AddBody(file, tables);
  std::filesystem::create_directories(folder);
  for (const Table& table : tables) Write(table, folder);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: polyhedron_tables MODELS_FOLDER OUTPUT_FOLDER\n");
    return 2;
  }
  try {
    return Run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "polyhedron_tables: %s\n", error.what());
    return 2;
  }
}
