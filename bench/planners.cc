// Benchmark of all planners that support an object, on the same random pairs of force-closure
// grasps. It measures solved queries, times and properties of the plans, and writes Markdown and
// CSV into a folder.
//
// The program fails if a planner solves more pairs than the planner general.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/contest.h"
#include "bench/table_file.h"
#include "planner/base/number.h"
#include "planner/object/object.h"

namespace {

using namespace regrasp;

constexpr std::array kFrictions = {25.0, 10.0, 5.0};  // friction angles, degrees
constexpr std::array kModels = {
    "cube.obj",        "prism.obj",        "l_block.obj",  "hole_block.obj",    "body24.obj",
    "tetrahedron.obj", "pyramid.obj",      "stone.obj",    "ellipsoid1000.obj", "star1000.obj",
    "polygon20.wkt",   "polygon_hole.wkt", "triangle.wkt", "bottle200.wkt",     "gear128.wkt"};
/// Size of the disturbance that plans are validated with.
constexpr double kGoodQuality = 0.01;

constexpr int kMostPairs = 100'000;
constexpr int kBadUsage = 2;

/// Validate an option's text for CLI11. @returns problem; empty if there is none.
std::string IsPositive(const std::string& text) {
  const std::optional<double> value = ParseDouble(text);
  return value && *value > 0 ? "" : text + " is not a number above 0";
}

struct Arguments {
  std::filesystem::path models;
  std::filesystem::path folder;
  std::vector<std::string> names;
  ContestLimits limits = {100, 60};

  void AddTo(CLI::App& app) {
    app.add_option("MODELS_FOLDER", models, "Folder of the models")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("OUTPUT_FOLDER", folder, "Folder of the tables")->required();
    app.add_option("MODEL", names, "Files of the folder (default: ten in space, five planar)");
    app.add_option("--pairs", limits.pairs, "Number of pairs of grasps per object and friction")
        ->check(CLI::Range(1, kMostPairs))
        ->capture_default_str();
    app.add_option("--seconds", limits.seconds,
                   "Processor time per planner, object and friction; no further pair starts "
                   "after it")
        ->check(IsPositive)
        ->capture_default_str();
  }
};

/// Return the mean over the found plans; "-" if there are none.
template <typename Value>
std::string Mean(const Standing& standing, Value value, int decimals) {
  const int count = standing.joined_count();
  if (count == 0) return "-";
  double sum = 0;
  for (const PairAnswer& answer : standing.answers) sum += answer.joined ? value(answer) : 0;
  return FormatFixed(sum / count, decimals);
}

std::string Milliseconds(double seconds) { return FormatFixed(1e3 * seconds, 2); }

/// Return the cells from the share of solved pairs to the travel and the remarks.
std::vector<std::string> Cells(const Standing& standing, int pairs) {
  if (!standing.absent.empty() || standing.answers.empty()) {
    return {
        "0", "-", "-", "-", "-",
        "-", "-", "-", "-", standing.absent.empty() ? "no such grasp was drawn" : standing.absent};
  }
  const auto asked = static_cast<int>(standing.answers.size());
  double sum = 0;
  double largest = 0;
  for (const PairAnswer& answer : standing.answers) {
    sum += answer.seconds;
    largest = std::max(largest, answer.seconds);
  }
  return {std::to_string(asked),
          FormatFixed(100.0 * standing.joined_count() / asked, 1),
          standing.build_seconds > 0 ? Milliseconds(standing.build_seconds) : "-",
          Milliseconds(sum / asked),
          Milliseconds(largest),
          Mean(
              standing, [](const PairAnswer& answer) { return answer.steps; }, 2),
          Mean(
              standing, [](const PairAnswer& answer) { return answer.aligns; }, 2),
          Mean(
              standing, [](const PairAnswer& answer) { return Degrees(answer.margin); }, 2),
          Mean(
              standing, [](const PairAnswer& answer) { return answer.travel; }, 2),
          asked < pairs ? "time limit" : ""};
}

std::vector<std::string> Columns(const std::string& last) {
  return {"object",        "friction angle (°)", "contacts",   "planner",   "pairs",
          "solved (%)",    "graph (ms)",         "mean (ms)",  "most (ms)", "steps",
          "sliding steps", "margin (°)",         "travel (D)", last};
}

class Tables {
 public:
  explicit Tables(const ContestLimits& limits) : limits_(limits) {}

  void Fill(const std::string& name, const object::Object& object) {
    for (const double degrees : kFrictions) {
      if (object.dimension() == 3) {
        Add(name, object, {Radians(degrees), 0, 4, 4}, space_);
        Add(name, object, {Radians(degrees), kGoodQuality, 4, 4}, quality_);
      } else {
        Add(name, object, {Radians(degrees), 0, 2, 2}, plane_);
        Add(name, object, {Radians(degrees), 0, 2, 3}, plane_);
        Add(name, object, {Radians(degrees), kGoodQuality, 2, 3}, quality_);
      }
    }
  }

  void Write(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder);
    for (const TableFile* table : {&space_, &plane_, &quality_}) WriteTable(*table, folder);
  }

  /// Return the number of settings with a pair and another planner. better_count() is the number of
  /// those in which a planner solves more than general.
  [[nodiscard]] int contest_count() const { return contests_; }
  [[nodiscard]] int better_count() const { return better_; }

 private:
  void Add(const std::string& name, const object::Object& object, const ContestSetting& setting,
           TableFile& table) {
    const std::vector<GraspPair> pairs = DrawPairs(object, setting, limits_);
    std::vector<Contender> contenders = MakeContenders(object, setting);
    if (setting.min_quality > 0) {
      std::erase_if(contenders, [](const Contender& c) { return c.planner != kGeneral; });
    }
    const Contest contest = RunContest(object, pairs, contenders, limits_.seconds);
    const std::string contacts = std::to_string(setting.fewest_contacts) +
                                 (setting.most_contacts > setting.fewest_contacts
                                      ? " or " + std::to_string(setting.most_contacts)
                                      : "");
    for (const Standing& standing : contest.standings) {
      std::vector<std::string> row = {name, FormatShort(Degrees(setting.friction_angle)), contacts,
                                      standing.planner};
      for (std::string& cell : Cells(standing, limits_.pairs)) row.push_back(std::move(cell));
      if (setting.min_quality > 0) {
        row.back() = std::to_string(std::ranges::count(standing.answers, true, &PairAnswer::good));
      }
      table.rows.push_back(std::move(row));
      Report(table.rows.back());
    }
    contests_ += !pairs.empty() && contenders.size() > 1 ? 1 : 0;
    if (const auto better = FindBetterThanGeneral(contest)) {
      ++better_;
      std::printf("%s, %s°, %s contacts: %s joins more than general\n", name.c_str(),
                  FormatShort(Degrees(setting.friction_angle)).c_str(), contacts.c_str(),
                  better->c_str());
    }
  }

  static void Report(const std::vector<std::string>& row) {
    std::fprintf(stderr, "%s, %s°, %s contacts, %s: %s %% of %s pairs joined, %s ms each\n",
                 row[0].c_str(), row[1].c_str(), row[2].c_str(), row[3].c_str(), row[5].c_str(),
                 row[4].c_str(), row[7].c_str());
  }

  ContestLimits limits_;
  TableFile space_ = {"planners_space", "Planners in space", Columns("note"), {}};
  TableFile plane_ = {"planners_plane", "Planners in the plane", Columns("note"), {}};
  TableFile quality_ = {
      "planners_quality",
      "The planner general, grasps of a quality of at least " + FormatShort(kGoodQuality),
      Columns("plans without a weaker grasp"),
      {}};
  int contests_ = 0;
  int better_ = 0;
};

int Run(const Arguments& arguments) {
  std::vector<std::string> names = arguments.names;
  if (names.empty()) names.assign(kModels.begin(), kModels.end());
  Tables tables(arguments.limits);
  for (const std::string& name : names) {
    tables.Fill(name, *object::ReadObject(arguments.models / name).object);
    tables.Write(arguments.folder);
  }
  std::printf("in %d of %d comparisons a planner joins more than general\n", tables.better_count(),
              tables.contest_count());
  return tables.contest_count() > 0 && tables.better_count() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares the planners on random pairs of grasps and writes tables.", "planners");
  Arguments arguments;
  arguments.AddTo(app);
  try {
    app.parse(argc, argv);
    return Run(arguments);
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error) : (app.exit(error), kBadUsage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "planners: %s\n", error.what());
    return kBadUsage;
  }
}
