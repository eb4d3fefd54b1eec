#include "apps/grasps_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "apps/output_files.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/validate_task.h"
#include "planner/base/angle.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/npz.h"
#include "planner/base/number.h"
#include "planner/base/read_npz.h"
#include "planner/base/stopwatch.h"
#include "planner/base/text_table.h"
#include "planner/base/write_file.h"
#include "planner/grasp/judge_grasps.h"
#include "planner/plan/locate_grasps.h"

namespace regrasp::apps {

namespace {

constexpr char kPoints[] = "points";
constexpr char kNormals[] = "normals";

/// The grasps of a file, in space: N x k x 3 values each.
struct GraspTable {
  std::size_t count = 0;
  int contacts = 0;
  std::vector<double> points;
  std::vector<double> normals;  ///< empty where the file has none
};

const NpzArray* Find(const std::vector<NpzArray>& arrays, const std::string& name) {
  const auto found = std::ranges::find(arrays, name, &NpzArray::name);
  return found == arrays.end() ? nullptr : &*found;
}

std::string ShapeText(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t length : shape)
    text += (text.empty() ? "" : ", ") + std::to_string(length);
  return "(" + text + ")";
}

void CheckFinite(const NpzArray& array, const std::string& file) {
  const auto found = std::ranges::find_if(array.values, [](double x) { return !std::isfinite(x); });
  if (found == array.values.end()) return;
  const auto at = static_cast<std::size_t>(found - array.values.begin());
  const std::size_t width = array.shape[2];
  throw InputError(file + ": " + array.name + "[" + std::to_string(at / (array.shape[1] * width)) +
                   ", " + std::to_string(at / width % array.shape[1]) + ", " +
                   std::to_string(at % width) + "] is not finite");
}

/// With z = 0 where it has none.
std::vector<double> InSpace(const NpzArray& array) {
  if (array.shape[2] == 3) return array.values;
  std::vector<double> values;
  values.reserve(array.values.size() / 2 * 3);
  for (std::size_t i = 0; i < array.values.size(); i += 2) {
    values.insert(values.end(), {array.values[i], array.values[i + 1], 0});
  }
  return values;
}

GraspTable ReadGrasps(const std::string& file, int dimension) {
  const std::vector<NpzArray> arrays = ReadNpz(ReadFile(file), file, {kPoints, kNormals});
  const NpzArray* points = Find(arrays, kPoints);
  const NpzArray* normals = Find(arrays, kNormals);
  if (points == nullptr) {
    throw InputError(file + ": no array \"points\", of shape (N, k, " + std::to_string(dimension) +
                     ") for N grasps of k contacts");
  }
  const std::vector<std::size_t>& shape = points->shape;
  constexpr std::size_t kMostContacts = 1000;
  if (shape.size() != 3 || shape[2] != static_cast<std::size_t>(dimension) || shape[1] < 1 ||
      shape[1] > kMostContacts) {
    throw InputError(file + ": points: the shape is (N, k, " + std::to_string(dimension) +
                     ") for N grasps of k contacts, 1 to " + std::to_string(kMostContacts) +
                     ", found " + ShapeText(shape));
  }
  if (shape[0] == 0)
    throw InputError(file + ": points: no grasp, the shape is " + ShapeText(shape));
  if (normals != nullptr && normals->shape != shape) {
    throw InputError(file + ": normals: the shape is that of points, " + ShapeText(shape) +
                     ", found " + ShapeText(normals->shape));
  }
  CheckFinite(*points, file);
  GraspTable table{shape[0], static_cast<int>(shape[1]), InSpace(*points), {}};
  if (normals != nullptr) {
    CheckFinite(*normals, file);
    table.normals = InSpace(*normals);
  }
  return table;
}

/// The verdicts on those grasps that are on the object, at their places among all.
struct Verdicts {
  std::vector<double> holds, too_close, margin, required_deg, quality, reason;

  explicit Verdicts(std::size_t count)
      : holds(count, 0),
        too_close(count, 0),
        margin(count, std::numeric_limits<double>::quiet_NaN()),
        required_deg(margin),
        quality(margin),
        reason(count, 0) {}
};

Verdicts Judge(const object::Object& object, const GraspTable& table,
               const ValidateOptions& options) {
  const plan::LocatedGrasps located =
      plan::LocateGrasps(object, table.points, table.normals, table.contacts);
  const auto values = 3 * static_cast<std::size_t>(table.contacts);
  std::vector<std::size_t> placed;
  std::vector<double> points, normals;
  for (std::size_t g = 0; g < table.count; ++g) {
    if (located.reasons[g] != plan::Reason::kNone) continue;
    placed.push_back(g);
    const auto begin = static_cast<std::ptrdiff_t>(g * values);
    const auto end = begin + static_cast<std::ptrdiff_t>(values);
    points.insert(points.end(), located.points.begin() + begin, located.points.begin() + end);
    normals.insert(normals.end(), located.normals.begin() + begin, located.normals.begin() + end);
  }
  grasp::JudgeOptions judge;
  judge.half_angle = options.friction.required_half_angle();
  judge.frame = object.wrench_frame();
  judge.required_half_angle = options.required_angle;
  judge.quality = options.quality;
  const grasp::GraspVerdicts found = grasp::JudgeGrasps({points, normals, table.contacts}, judge);
  Verdicts verdicts(table.count);
  for (std::size_t g = 0; g < table.count; ++g) {
    verdicts.reason[g] = static_cast<double>(located.reasons[g]);
  }
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const std::size_t g = placed[i];
    const grasp::Decision decision = found.force_closure[i].decision;
    verdicts.holds[g] = decision == grasp::Decision::kYes ? 1 : 0;
    verdicts.too_close[g] = decision == grasp::Decision::kTooClose ? 1 : 0;
    verdicts.margin[g] = found.force_closure[i].margin_lower;
    if (options.required_angle) verdicts.required_deg[g] = Degrees(found.required_half_angle[i]);
    if (options.quality) verdicts.quality[g] = found.quality[i];
    if (decision != grasp::Decision::kYes) {
      verdicts.reason[g] = static_cast<double>(plan::Reason::kNotForceClosure);
    }
  }
  return verdicts;
}

/// The codes that stand in `reason`, as words.
std::vector<std::string> ReasonWords() {
  std::vector<std::string> words;
  for (int i = 0; i <= static_cast<int>(plan::Reason::kUnreachable); ++i) {
    words.emplace_back(plan::ReasonName(static_cast<plan::Reason>(i)));
  }
  return words;
}

std::string FormatVerdicts(Verdicts verdicts, const ValidateOptions& options) {
  const std::size_t count = verdicts.holds.size();
  std::vector<NpzArray> arrays = {{"holds", {count}, std::move(verdicts.holds), {}, true},
                                  {"too_close", {count}, std::move(verdicts.too_close), {}, true},
                                  {"margin", {count}, std::move(verdicts.margin)},
                                  {"reason", {count}, std::move(verdicts.reason)}};
  if (options.required_angle) {
    arrays.push_back({"required_angle_deg", {count}, std::move(verdicts.required_deg)});
  }
  if (options.quality) arrays.push_back({"quality", {count}, std::move(verdicts.quality)});
  const std::vector<std::string> words = ReasonWords();
  arrays.push_back({"reasons", {words.size()}, {}, words});
  return FormatNpz(arrays);
}

std::size_t Count(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::ranges::count(values, value));
}

/// What the table of a terminal has, by verdict.
std::string CountsText(const Verdicts& verdicts) {
  const auto reasons = [&](plan::Reason reason) {
    return Count(verdicts.reason, static_cast<double>(reason));
  };
  std::vector<TextRow> rows = {{"verdict", "grasps"}};
  const auto add = [&](const std::string& what, std::size_t n) {
    if (n > 0) rows.push_back({what, std::to_string(n)});
  };
  const std::size_t too_close = Count(verdicts.too_close, 1);
  add("pass", Count(verdicts.holds, 1));
  add("fail: off-surface", reasons(plan::Reason::kOffSurface));
  add("fail: wrong-normal", reasons(plan::Reason::kWrongNormal));
  add("fail: coincident-fingers", reasons(plan::Reason::kCoincidentFingers));
  add("fail: unreachable", reasons(plan::Reason::kUnreachable));
  add("fail: not-force-closure", reasons(plan::Reason::kNotForceClosure) - too_close);
  add("fail: not-force-closure, too close to call", too_close);
  return FormatRows(rows);
}

}  // namespace

int RunGrasps(const ValidateOptions& options) {
  Stopwatch watch;
  CheckOutputs(options);
  ProgressLine progress(options.quiet);
  const object::ObjectFile object = ReadGraspObject(options, progress);
  progress.Report("reading " + options.grasps_path);
  const GraspTable table = ReadGrasps(options.grasps_path, object.object->dimension());
  progress.Report("judging " + std::to_string(table.count) + " grasps");
  Verdicts verdicts = Judge(*object.object, table, options);
  progress.Clear();
  const std::string counts = CountsText(verdicts);
  const bool passed = Count(verdicts.holds, 1) == table.count;
  std::error_code error;
  std::filesystem::create_directories(options.Folder(), error);
  if (error) throw EnvironmentError(options.Folder().string() + ": " + error.message());
  const std::filesystem::path file = options.Folder() / kVerdictsName;
  WriteFile(file, FormatVerdicts(std::move(verdicts), options));
  if (!options.quiet) {
    std::cout << counts << "files: " << file.string() << "\n"
              << "time: " << FormatShort(watch.Lap(), 2) << " s for " << table.count
              << " grasps of " << table.contacts << " contacts\n"
              << "verdict: " << (passed ? "pass" : "fail") << "\n";
  }
  return passed ? kExitDone : kExitNegative;
}

}  // namespace regrasp::apps
