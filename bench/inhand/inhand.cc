// Scoreboard of in-hand planners (README.md). The program plans tasks in hands, replays the plans
// on the hands' own actuators and writes the tables, or evaluates a third-party plan.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "apps/options.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "bench/inhand/bih_tasks.h"
#include "bench/inhand/judge.h"
#include "bench/inhand/run.h"
#include "bench/inhand/score_table.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/plan/plan_io.h"

namespace {

using namespace regrasp;
using bench::HandBody;
using bench::Row;
using bench::Task;

constexpr char kProgram[] = "inhand";
constexpr double kLongest_s = 86'400;
constexpr int kMostJobs = 256;

struct InHandProgram {
  std::vector<std::string> hand_files;
  std::string tasks_file = REGRASP_INHAND "/tasks.csv";
  std::string results;
  std::string table;
  std::string plans;
  std::string write_bodies;
  std::string task;
  std::string plan;
  std::string bih;
  std::string meshes;
  std::vector<std::string> only;
  double limit_s = bench::ScoreRun().limit_s;
  bool gravity = false;
  bool rolls = false;
  int jobs = 1;
  bool list = false;
  bool quiet = false;

  void AddTo(CLI::App& app);
  int Run();

 private:
  void Check() const;
  void Read();
  void ReadBih();
  void PrintTasks() const;
  void WriteBodies() const;
  int RunTasks() const;
  int JudgePlan() const;
  void WriteTable() const;

  std::vector<Task> tasks_;
  std::vector<HandBody> bodies_;
  std::vector<kinematics::HandFile> hands_;
};

void InHandProgram::AddTo(CLI::App& app) {
  app.add_option("hands", hand_files, "Hand files (format regrasp-hand)")->type_name("HAND");
  app.add_option("--tasks", tasks_file, "File of tasks [default: the tasks of the scoreboard]")
      ->type_name("FILE");
  app.add_option("--only", only, "Shell pattern of names or groups of tasks; repeatable")
      ->type_name("PATTERN")
      ->allow_extra_args(false);
  app.add_option("--results", results, "File of result rows (JSON Lines). Existing rows are reused")
      ->type_name("FILE");
  app.add_option("--table", table, "Markdown file whose tables are updated from the results")
      ->type_name("FILE");
  app.add_option("--plans", plans, "Folder for plan files, with one subfolder per hand")
      ->type_name("FOLDER");
  apps::AddNumber(app, "--limit", limit_s, {0, kLongest_s, false, true},
                  "Processor time per task, seconds [default: 8]", "S");
  app.add_flag("--gravity-support", gravity,
               "Let gravity support grasps (plan --closure gravity). Requires a results file of "
               "its own");
  app.add_flag("--rolling", rolls,
               "Let fingertips roll (plan --rolling on). Requires a results file of its own");
  apps::AddInteger(app, "--jobs", jobs, 1, kMostJobs, "Number of parallel tasks [default: 1]");
  app.add_option("--task", task, "Task for which --plan is validated")->type_name("NAME");
  app.add_option("--plan", plan, "Plan file to validate")->type_name("FILE");
  app.add_option("--bih", bih,
                 "Also run the tasks of the benchmark BIH: its table of palm poses as CSV")
      ->type_name("FILE");
  app.add_option("--meshes", meshes, "Folder of the solids of BIH's objects, metres")
      ->type_name("FOLDER");
  app.add_flag("--list", list, "Print tasks and objects");
  app.add_option("--bodies", write_bodies,
                 "Folder to which the object files are written, for other planners")
      ->type_name("FOLDER");
  app.add_flag("--quiet", quiet, "Do not print progress");
}

void InHandProgram::Check() const {
  if (task.empty() != plan.empty())
    throw InputError("--task: requires --plan, and --plan requires --task");
  if (!task.empty() && hand_files.size() != 1) {
    throw InputError("--plan: requires exactly one hand file");
  }
  if (bih.empty() != meshes.empty())
    throw InputError("--bih: requires --meshes, and --meshes requires --bih");
  if (!table.empty() && results.empty()) throw InputError("--table: requires --results");
  if (task.empty() && !hand_files.empty() && results.empty()) {
    throw InputError("--results is required to run tasks");
  }
  if (hand_files.empty() && table.empty() && write_bodies.empty() && !list) {
    throw InputError("hand files, --table, --list or --bodies is required");
  }
}

void InHandProgram::Read() {
  tasks_ = bench::ReadTasks(tasks_file);
  bodies_ = bench::TenBodies(REGRASP_MODELS);
  for (HandBody& body : bench::CompetitionBodies(REGRASP_MODELS)) {
    if (std::ranges::find(bodies_, body.name, &HandBody::name) == bodies_.end()) {
      bodies_.push_back(std::move(body));
    }
  }
  std::ranges::move(bench::EverydayBodies(), std::back_inserter(bodies_));
  for (const Task& read : tasks_) (void)bench::BodyNamed(bodies_, read.body);
  if (!bih.empty()) ReadBih();
  for (const std::string& file : hand_files) hands_.push_back(kinematics::ReadHandFile(file));
}

void InHandProgram::ReadBih() {
  bench::BihTasks read = bench::ReadBih(bih, meshes);
  std::ranges::move(read.tasks, std::back_inserter(tasks_));
  std::ranges::move(read.bodies, std::back_inserter(bodies_));
  for (const std::string& object : read.without_mesh) {
    apps::PrintMessage(kProgram, "warning: " + meshes + ": mesh of the object " + object +
                                     " not found, its tasks are skipped");
  }
}

void InHandProgram::PrintTasks() const {
  for (const bench::Chain& chain : bench::ChainsOf(tasks_, only)) {
    for (const Task& listed : chain) std::cout << listed.name << '\n';
  }
  for (const HandBody& body : bodies_) {
    std::cout << body.name << ": " << body.file.file << " times " << FormatDouble(body.scale)
              << " m, " << body.what << '\n';
  }
}

void InHandProgram::WriteBodies() const {
  std::filesystem::create_directories(write_bodies);
  for (const HandBody& body : bodies_) {
    WriteFile(std::filesystem::path(write_bodies) / body.file.file, body.bytes);
  }
}

int InHandProgram::RunTasks() const {
  bench::ScoreRun run;
  run.chains = bench::ChainsOf(tasks_, only);
  run.bodies = &bodies_;
  run.hands = &hands_;
  run.limit_s = limit_s;
  run.plans = plans;
  if (gravity) run.way.gravity_support.emplace();
  run.way.rolls = rolls;
  if (run.chains.empty()) throw InputError("--only: no task has such a name or group");
  apps::ProgressLine line(quiet);
  apps::ProgressLog log(kProgram, quiet);
  const int signal = bench::RunAll(run, results, jobs, [&](std::string_view text) {
    line.Report(text);
    log.Report(text);
  });
  line.Clear();
  if (signal != 0) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  return apps::kExitDone;
}

int InHandProgram::JudgePlan() const {
  const auto asked = std::ranges::find(tasks_, task, &Task::name);
  if (asked == tasks_.end()) throw InputError("--task: there is no task " + task);
  const HandBody& body = bench::BodyNamed(bodies_, asked->body);
  const std::string bytes = ReadFile(plan);
  const plan::Plan read = plan::ParsePlan(bytes, plan);
  bench::CheckIsFor(*asked, body, hands_.front(), read, plan);
  Row row = bench::RowOf(*asked, hands_.front());
  bench::AddPlan(read, bytes, bench::Judge(*asked, body, hands_.front(), read), row);
  std::cout << bench::FormatRow(row);
  if (!results.empty()) bench::AppendRows(results, bench::FormatRow(row));
  return row.passed ? apps::kExitDone : apps::kExitNegative;
}

void InHandProgram::WriteTable() const {
  const std::string tables = bench::ScoreTables(bench::ReadRows(results), tasks_);
  WriteFile(table, bench::ReplaceBetweenMarkers(ReadFile(table), tables, table));
}

int InHandProgram::Run() {
  Check();
  Read();
  if (list) PrintTasks();
  if (!write_bodies.empty()) WriteBodies();
  int code = apps::kExitDone;
  if (!hands_.empty()) code = task.empty() ? RunTasks() : JudgePlan();
  if (!table.empty()) WriteTable();
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Run in-hand tasks on hands, and validate plans on the hands' actuators.", kProgram);
  InHandProgram program;
  program.AddTo(app);
  return regrasp::apps::RunProgram(app, argc, argv, [&] { return program.Run(); });
}
