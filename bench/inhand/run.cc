#include "bench/inhand/run.h"

#include <algorithm>
#include <iostream>
#include <optional>
#include <utility>

#include "apps/batch/process_pool.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/plan/plan_io.h"

namespace regrasp::bench {
namespace {

/// Chain in a hand.
struct Job {
  const Chain* chain;
  const kinematics::HandFile* hand;
};

void WritePlan(const std::filesystem::path& folder, const Row& row, std::string_view bytes) {
  std::string file = row.task + ".json";
  std::ranges::replace(file, '/', '-');
  std::filesystem::create_directories(folder / row.hand);
  WriteFile(folder / row.hand / file, bytes);
}

bool IsDone(const Job& job, const std::vector<Row>& rows, double limit_s) {
  return std::ranges::all_of(*job.chain, [&](const Task& task) {
    const Row asked = RowOf(task, *job.hand);
    return std::ranges::any_of(rows, [&](const Row& row) {
      return row.task == asked.task && row.hand_sha256 == asked.hand_sha256 &&
             row.planner == asked.planner && row.limit_s == limit_s;
    });
  });
}

std::vector<Job> OpenJobs(const ScoreRun& run, const std::vector<Row>& rows) {
  std::vector<Job> jobs;
  for (const Chain& chain : run.chains) {
    for (const kinematics::HandFile& hand : *run.hands) {
      const Job job{&chain, &hand};
      if (!IsDone(job, rows, run.limit_s)) jobs.push_back(job);
    }
  }
  return jobs;
}

/// Return the rows of a chain whose process crashed.
std::vector<Row> CrashRows(const ScoreRun& run, const Job& job, const apps::ChildExit& exit) {
  std::vector<Row> rows;
  for (const Task& task : *job.chain) {
    Row row = RowOf(task, *job.hand);
    row.limit_s = run.limit_s;
    row.reason = kCrash;
    row.detail = (exit.kind == apps::ChildExit::Kind::kSignalled ? "signal " : "exit code ") +
                 std::to_string(exit.code) + ": " + exit.errors;
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Evaluate a plan for a task, which may begin at the end of another one.
Verdict JudgeFrom(const std::optional<TaskStart>& start, const Task& task, const HandBody& body,
                  const kinematics::HandFile& hand, const plan::Plan& plan) {
  if (start) {
    if (const auto fault = CheckStart(*start, plan)) return {fault, {}};
  }
  try {
    CheckIsFor(task, body, hand, plan, "the planner's plan");
  } catch (const InputError& error) {  // a rotation may end too far away
    return {TrialFault{plan::Reason::kGoalNotReached, error.what()}, {}};
  }
  return Judge(task, body, hand, plan);
}

/// @param start  final state of the task before; updated to that of this task. Empty if it has no
///     plan to continue.
Row RunTask(const ScoreRun& run, const Task& task, const kinematics::HandFile& hand,
            std::optional<TaskStart>& start) {
  const HandBody& body = BodyNamed(*run.bodies, task.body);
  Row row = RowOf(task, hand);
  row.limit_s = run.limit_s;
  if (!task.after.empty() && !start) {
    row.reason = kNoStart;
    row.detail = task.after + " has no plan to continue";
    return row;
  }
  const PlannedTask planned = PlanTask(hand, body, task, start, run.limit_s, run.way);
  row.seconds = planned.seconds;
  if (!planned.plan) {
    row.reason = planned.trial ? plan::ReasonName(*planned.trial) : kNoPlan;
    row.detail = planned.message;
    start.reset();
    return row;
  }
  const Verdict verdict = JudgeFrom(start, task, body, hand, *planned.plan);
  const std::string bytes = plan::FormatPlan(*planned.plan);
  AddPlan(*planned.plan, bytes, verdict, row);
  if (!run.plans.empty()) WritePlan(run.plans, row, bytes);
  start = EndOf(*planned.plan);
  if (verdict.fault && verdict.fault->reason == plan::Reason::kStartDiffers) start.reset();
  return row;
}

std::string FormatRows(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) text += FormatRow(row);
  return text;
}

}  // namespace

const HandBody& BodyNamed(const std::vector<HandBody>& bodies, const std::string& name) {
  const auto found = std::ranges::find(bodies, name, &HandBody::name);
  if (found == bodies.end()) throw InputError("there is no body " + name);
  return *found;
}

std::vector<Row> RunChain(const ScoreRun& run, const Chain& chain,
                          const kinematics::HandFile& hand) {
  std::vector<Row> rows;
  std::optional<TaskStart> start;
  for (const Task& task : chain) rows.push_back(RunTask(run, task, hand, start));
  return rows;
}

int RunAll(const ScoreRun& run, const std::filesystem::path& results, int jobs,
           const std::function<void(std::string_view)>& report) {
  const std::vector<Job> open = OpenJobs(run, ReadRows(results));
  const int count = static_cast<int>(open.size());
  int done = 0;
  int passed = 0;
  const auto work = [&](int i) {
    std::cout << FormatRows(RunChain(run, *open[i].chain, *open[i].hand)) << std::flush;
    return 0;
  };
  const auto on_exit = [&](int i, const apps::ChildExit& exit) {
    const bool is_whole = exit.kind == apps::ChildExit::Kind::kExited && exit.code == 0;
    const std::vector<Row> rows =
        is_whole ? ParseRows(exit.output, "rows") : CrashRows(run, open[i], exit);
    AppendRows(results, FormatRows(rows));
    passed += static_cast<int>(std::ranges::count(rows, true, &Row::passed));
    report(std::to_string(++done) + " of " + std::to_string(count) + " done, " +
           std::to_string(passed) + " passes; last " + rows.back().task + " in " +
           rows.back().hand);
  };
  return apps::RunInChildren(count, {.jobs = jobs, .time_limit = std::nullopt}, work, on_exit);
}

}  // namespace regrasp::bench
