#include "bench/inhand/task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "bench/csv_table.h"
#include "bench/hand_bodies.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "tests/fixtures/folder_test.h"
#include "tests/fixtures/project_path.h"

namespace regrasp::bench {
namespace task_test {

using Eigen::Vector3d;
using testing::HasSubstr;

std::filesystem::path TasksFile() { return ProjectPath("bench/inhand/tasks.csv"); }

TEST(InHandTasks, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Task& task : ReadTasks(TasksFile())) EXPECT_TRUE(names.insert(task.name).second);
  EXPECT_FALSE(names.empty());
}

TEST(InHandTasks, TurnEachOfTenBodiesAboutThreeAxesByTwoAngles) {
  std::map<std::string, std::set<std::pair<int, int>>> turns;  // axis and degrees, by object
  for (const Task& task : ReadTasks(TasksFile())) {
    if (!task.group.starts_with("turn-")) continue;
    EXPECT_TRUE(task.is_turn());
    EXPECT_TRUE(task.after.empty());
    int axis = 0;
    task.turn.axis.maxCoeff(&axis);
    const int degrees = static_cast<int>(std::lround(Degrees(task.turn.angle)));
    EXPECT_EQ(task.group, "turn-" + std::to_string(degrees));
    EXPECT_EQ(task.name,
              "turn/" + task.body + "/" + std::string("xyz")[axis] + std::to_string(degrees));
    turns[task.body].emplace(axis, degrees);
  }
  EXPECT_EQ(turns.size(), 10U);
  for (const HandBody& body : TenBodies(ProjectPath("models"))) {
    EXPECT_EQ(turns[body.name], (std::set<std::pair<int, int>>{
                                    {0, 90}, {0, 360}, {1, 90}, {1, 360}, {2, 90}, {2, 360}}))
        << body.name;
  }
}

/// Results files, tables and other planners refer to these names, in this order.
TEST(InHandTasks, TurnEverydayBodiesInAFixedOrder) {
  std::vector<std::string> names;
  for (const Task& task : ReadTasks(TasksFile())) {
    if (task.group != "everyday") continue;
    EXPECT_TRUE(task.is_turn());
    EXPECT_TRUE(task.after.empty());
    int axis = 0;
    task.turn.axis.maxCoeff(&axis);
    const int degrees = static_cast<int>(std::lround(Degrees(task.turn.angle)));
    EXPECT_EQ(task.name,
              "everyday/" + task.body + "/" + std::string("xyz")[axis] + std::to_string(degrees));
    names.push_back(task.name.substr(std::string("everyday/").size()));
  }
  EXPECT_THAT(names,
              testing::ElementsAre("box/x180", "box/y180", "box/z180", "rod-square/x180",
                                   "rod-square/z360", "rod-20/x180", "rod-20/z360", "cap/z360",
                                   "pen/x180", "pen/z360", "screwdriver/x180", "screwdriver/z360"));
}

TEST(InHandTasks, TurnOnlyBodiesOfTheProgram) {
  std::set<std::string> bodies;
  for (const auto& some : {TenBodies(ProjectPath("models")),
                           CompetitionBodies(ProjectPath("models")), EverydayBodies()}) {
    for (const HandBody& body : some) bodies.insert(body.name);
  }
  std::set<std::string> used;
  for (const Task& task : ReadTasks(TasksFile())) used.insert(task.body);
  EXPECT_EQ(used, bodies);
}

/// Return the column `what` of each task, without its first word: "facet +y up", "waypoint 0 20 0".
std::map<std::string, std::string> WhatOfTasks() {
  const CsvTable table = CsvTable::Parse(ReadFile(TasksFile()), "tasks.csv");
  std::map<std::string, std::string> what;
  for (int i = 0; i < table.size(); ++i) what[table.At(i, "name")] = table.At(i, "what");
  return what;
}

/// The face that is up, computed from the goal poses one after the other, starting with z upright.
TEST(InHandTasks, TurnTheFacetUpThatTheySay) {
  const auto what = WhatOfTasks();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  int checked = 0;
  for (const Task& task : ReadTasks(TasksFile())) {
    if (task.group != "rgmc-cubes") continue;
    if (task.after.empty()) pose = Eigen::Isometry3d::Identity();
    pose = GoalPose(task, Vector3d::Zero(), pose);
    const std::string facet = what.at(task.name).substr(std::string("facet ").size(), 2);
    const Vector3d normal = (facet[0] == '+' ? 1 : -1) * Vector3d::Unit(facet[1] - 'x');
    EXPECT_NEAR((pose.linear() * normal).z(), 1, 1e-12) << task.name;
    ++checked;
  }
  EXPECT_EQ(checked, 10);
}

TEST(InHandTasks, MoveCylindersToTheWaypointsThatTheySayWithin25Millimetres) {
  const auto what = WhatOfTasks();
  const Vector3d centre(0.01, -0.02, 0.03);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  int checked = 0;
  for (const Task& task : ReadTasks(TasksFile())) {
    if (task.group != "rgmc-cylinders") continue;
    if (task.after.empty()) pose = Eigen::Isometry3d::Identity();
    pose = GoalPose(task, centre, pose);
    const auto mm = ParseNumbers(what.at(task.name).substr(std::string("waypoint ").size()), 3, "");
    const Vector3d waypoint = 1e-3 * Vector3d(mm[0], mm[1], mm[2]);
    EXPECT_LT((pose * centre - centre - waypoint).norm(), 1e-12) << task.name;
    EXPECT_LE(waypoint.cwiseAbs().maxCoeff(), 0.025) << task.name;
    ++checked;
  }
  EXPECT_EQ(checked, 18);
}

/// Independent calculation: rotate points about the centroid and move them, instead of using poses.
TEST(GoalPose, TurnsAboutTheCentroidAndMovesAlongTheAxesOfTheStart) {
  Task task;
  task.turn = {Vector3d::UnitZ(), Radians(90)};
  task.move_m = {0.01, 0.02, 0.03};
  const Vector3d centre(1, 2, 3);
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  start.linear() = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2) / 3).toRotationMatrix();
  start.translation() = Vector3d(4, 5, 6);
  const Eigen::Isometry3d goal = GoalPose(task, centre, start);
  for (const Vector3d& offset : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0.3, -2, 0.5)}) {
    const Vector3d turned(-offset.y(), offset.x(), offset.z());
    const Vector3d expected = start * (centre + task.move_m + turned);
    EXPECT_LT((goal * (centre + offset) - expected).norm(), 1e-12);
  }
}

class TaskFiles : public FolderTest {
 protected:
  /// Return the error message for a file with these lines after the header.
  std::string Complaint(const std::string& lines) {
    const auto file = folder_ / "tasks.csv";
    WriteFile(file, "name,group,body,after,turn,move_mm\n" + lines);
    try {
      (void)ReadTasks(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(TaskFiles, AreRefusedWithTheLineAndTheValue) {
  EXPECT_EQ(Complaint("a,g,b,,z 90,\n"), "");
  EXPECT_THAT(Complaint("a,g,b,,z 90,\na,g,b,,z 90,\n"), HasSubstr("line 3: there is a task a"));
  EXPECT_THAT(Complaint("a,g,b,,,\n"), HasSubstr("line 2: a has neither turn nor move_mm"));
  EXPECT_THAT(Complaint("a,g,b,,w 90,\n"), HasSubstr("line 2: turn: expected an axis"));
  EXPECT_THAT(Complaint("a,g,b,,z many,\n"), HasSubstr("expected a number, found \"many\""));
  EXPECT_THAT(Complaint("a,g,b,,,1 2\n"), HasSubstr("line 2: move_mm: expected 3 numbers"));
  EXPECT_THAT(Complaint("a,g,b,c,z 90,\n"), HasSubstr("line 2: after: c is not the task before"));
  EXPECT_THAT(Complaint("a,g,b,,z 90,\nd,g,e,a,z 90,\n"), HasSubstr("of the body e"));
  EXPECT_THAT(Complaint("a,g,b\n"), HasSubstr("line 2: 3 cells, but there are 6 columns"));
}

TEST(ChainsOf, TakesWholeChainsOfWhichATaskMatches) {
  const std::vector<Task> tasks = ReadTasks(TasksFile());
  EXPECT_EQ(ChainsOf(tasks, {}).size(), 60U + 2 + 3 + 12);
  const auto chains = ChainsOf(tasks, {"rgmc/cube-50/3"});
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains.front().size(), 5U);
  EXPECT_EQ(ChainsOf(tasks, {"turn-90"}).size(), 30U);
  EXPECT_TRUE(ChainsOf(tasks, {"nothing"}).empty());
}

TEST(CsvTable, KeepsCommasBetweenQuotationMarks) {
  const CsvTable table = CsvTable::Parse("# note\na,b\r\n\"1,2\",\"say \"\"no\"\"\"\n\n", "x.csv");
  ASSERT_EQ(table.size(), 1);
  EXPECT_EQ(table.At(0, "a"), "1,2");
  EXPECT_EQ(table.At(0, "b"), "say \"no\"");
  EXPECT_EQ(table.Place(0), "x.csv: line 3");
  EXPECT_THROW((void)table.At(0, "c"), InputError);
  EXPECT_THROW((void)CsvTable::Parse("a\n\"1\n", "x.csv"), InputError);
}

}  // namespace task_test
}  // namespace regrasp::bench
