#include "bench/inhand/task.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>

#include "bench/csv_table.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"

namespace regrasp::bench {
namespace {

constexpr double kMillimetre = 1e-3;

planning::Turn ParseTurn(const std::string& text, const std::string& place) {
  if (text.empty()) return {};
  const std::size_t axis = std::string("xyz").find(text.front());
  if (axis == std::string::npos) {
    throw InputError(place + ": turn: expected an axis and degrees, as in \"z 90\", found \"" +
                     text + "\"");
  }
  const double degrees = ParseNumbers(text.substr(1), 1, place + ": turn").front();
  return {Eigen::Vector3d::Unit(static_cast<Eigen::Index>(axis)), Radians(degrees)};
}

Eigen::Vector3d ParseMove(const std::string& text, const std::string& place) {
  if (text.empty()) return Eigen::Vector3d::Zero();
  const std::vector<double> mm = ParseNumbers(text, 3, place + ": move_mm");
  return kMillimetre * Eigen::Vector3d(mm[0], mm[1], mm[2]);
}

void CheckTask(const Task& task, const std::vector<Task>& before, const std::string& place) {
  if (std::ranges::find(before, task.name, &Task::name) != before.end()) {
    throw InputError(place + ": there is a task " + task.name + " before");
  }
  if (task.turn.angle == 0 && task.is_turn()) {
    throw InputError(place + ": " + task.name + " has neither turn nor move_mm");
  }
  if (task.after.empty()) return;
  if (before.empty() || before.back().name != task.after || before.back().body != task.body) {
    throw InputError(place + ": after: " + task.after + " is not the task before, of the body " +
                     task.body);
  }
}

bool Matches(const Task& task, const std::vector<std::string>& patterns) {
  return patterns.empty() || std::ranges::any_of(patterns, [&](const std::string& pattern) {
           return fnmatch(pattern.c_str(), task.name.c_str(), 0) == 0 ||
                  fnmatch(pattern.c_str(), task.group.c_str(), 0) == 0;
         });
}

}  // namespace

Eigen::Isometry3d GoalPose(const Task& task, const Eigen::Vector3d& centre,
                           const Eigen::Isometry3d& start) {
  return start * Eigen::Translation3d(centre + task.move_m) *
         Eigen::AngleAxisd(task.turn.angle, task.turn.axis) * Eigen::Translation3d(-centre);
}

std::vector<Task> ReadTasks(const std::filesystem::path& path) {
  const CsvTable table = CsvTable::Parse(ReadFile(path), path.string());
  std::vector<Task> tasks;
  for (int i = 0; i < table.size(); ++i) {
    Task task{table.At(i, "name"),
              table.At(i, "group"),
              table.At(i, "body"),
              table.At(i, "after"),
              ParseTurn(table.At(i, "turn"), table.Place(i)),
              ParseMove(table.At(i, "move_mm"), table.Place(i))};
    CheckTask(task, tasks, table.Place(i));
    tasks.push_back(std::move(task));
  }
  return tasks;
}

std::vector<Chain> ChainsOf(const std::vector<Task>& tasks, const std::vector<std::string>& only) {
  std::vector<Chain> chains;
  for (const Task& task : tasks) {
    if (task.after.empty()) chains.emplace_back();
    chains.back().push_back(task);
  }
  std::erase_if(chains, [&](const Chain& chain) {
    return std::ranges::none_of(chain, [&](const Task& task) { return Matches(task, only); });
  });
  return chains;
}

}  // namespace regrasp::bench
