#include "apps/validate_batch.h"

#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <system_error>

#include "apps/batch/batch_summary.h"
#include "apps/batch/plan_library.h"
#include "apps/batch/process_pool.h"
#include "apps/earlier_run.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/validate_run.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"

namespace regrasp {

namespace {

namespace fs = std::filesystem;

constexpr char kSummaryName[] = "summary.json";
constexpr char kWarning[] = "warning: ";

/// Before the number of the signal that stopped a batch, as shells count it.
constexpr int kSignalled = 128;

/// Of a child: the earlier run's report stays. Beyond every ExitCode.
constexpr int kExitKept = 4;

void PrepareFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  // A summary never stands beside the results of another run.
  if (!error) fs::remove(folder / kSummaryName, error);
  if (error) throw EnvironmentError(folder.string() + ": " + error.message());
}

/// What a child does.
int ValidateOne(ValidateOptions options, const LibraryPlan& plan, const fs::path& folder) {
  options.plan_path = plan.path.string();
  options.out = (folder / plan.name).string();
  options.junit.clear();
  options.quiet = true;
  return RunGuarded(kValidateName, [&] {
    if (!options.fresh && HasSameRun(options)) return kExitKept;
    RemoveEarlierRun(options.out);
    return RunValidation(options);
  });
}

/// The lines that a child wrote, without the program's name.
std::vector<std::string> LinesOf(const std::string& text) {
  const std::string prefix = std::string(kValidateName) + ": ";
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line.starts_with(prefix) ? line.substr(prefix.size()) : line);
  }
  return lines;
}

/// Why a child is an error by the way that it ended; empty where its exit code tells.
std::string WhyStopped(const ChildExit& exit, const ValidateOptions& options) {
  switch (exit.kind) {
    case ChildExit::Kind::kExited:
      return "";
    case ChildExit::Kind::kSignalled:
      return "crashed: " + std::string(strsignal(exit.code));
    case ChildExit::Kind::kTimedOut:
      return "took longer than --time-limit " + FormatDouble(*options.time_limit_s);
  }
  return "";
}

class Batch {
 public:
  explicit Batch(const ValidateOptions& options)
      : options_(options),
        library_(FindPlans(options.plans)),
        folder_(options.Folder()),
        progress_(options.quiet) {
    summary_.skipped = library_.skipped;
    for (const LibraryPlan& plan : library_.plans) {
      PlanOutcome& outcome = summary_.plans.emplace_back();
      outcome.name = plan.name;
      outcome.file = plan.path.filename().string();
    }
  }

  /// @returns the exit code.
  int Run() {
    PrepareFolder(folder_);
    ShowProgress();
    stop_ = RunInChildren(
        static_cast<int>(library_.plans.size()),
        {options_.jobs, options_.time_limit_s
                            ? std::optional(std::chrono::duration<double>(*options_.time_limit_s))
                            : std::nullopt},
        [this](int index) { return ValidateOne(options_, library_.plans[index], folder_); },
        [this](int index, const ChildExit& exit) { Take(index, exit); });
    progress_.Clear();
    if (stop_ != 0) return kSignalled + stop_;
    WriteFile(folder_ / kSummaryName, FormatSummaryJson(summary_));
    if (!options_.junit.empty()) WriteFile(options_.junit, FormatSummaryJunit(summary_));
    if (!options_.quiet) std::cout << FormatSummaryTable(summary_);
    return static_cast<int>(summary_.verdict());
  }

  /// The signal that stopped it; 0 where all plans were looked at.
  [[nodiscard]] int stop() const { return stop_; }

 private:
  void ShowProgress() {
    progress_.Report(std::to_string(done_) + " of " + std::to_string(library_.plans.size()) +
                     " plans, " + std::to_string(not_passed_) + " not passed");
  }

  void Take(int index, const ChildExit& exit) {
    PlanOutcome& outcome = summary_.plans[index];
    std::vector<std::string> lines = LinesOf(exit.errors);
    for (const std::string& line : lines) {
      if (!line.starts_with(kWarning)) outcome.message = line;
    }
    if (const std::string why = WhyStopped(exit, options_); !why.empty()) {
      lines.push_back(why);
      outcome.message = why;
    } else if (exit.code == kExitBadInput) {
      outcome.verdict = PlanVerdict::kBadInput;
    } else if (exit.code == kExitDone || exit.code == kExitNegative || exit.code == kExitKept) {
      TakeReport(exit.code == kExitKept, outcome);
    }
    if (!outcome.report && outcome.message.empty()) {
      outcome.message = "ended with exit code " + std::to_string(exit.code);
    }
    progress_.Clear();
    for (const std::string& line : lines) PrintMessage(kValidateName, outcome.name + ": " + line);
    ++done_;
    if (outcome.verdict != PlanVerdict::kPass) ++not_passed_;
    ShowProgress();
  }

  /// New and kept results are told from the same file.
  void TakeReport(bool kept, PlanOutcome& outcome) {
    try {
      outcome.report = ReadReportSummary(folder_ / outcome.name / "report.json");
      outcome.kept = kept;
      outcome.verdict = outcome.report->passed ? PlanVerdict::kPass : PlanVerdict::kFail;
      outcome.message.clear();
    } catch (const InputError& error) {
      outcome.message = error.what();
    }
  }

  const ValidateOptions& options_;
  PlanLibrary library_;
  fs::path folder_;
  ProgressLine progress_;
  BatchSummary summary_;
  int done_ = 0;
  int not_passed_ = 0;
  int stop_ = 0;
};

}  // namespace

int RunBatch(const ValidateOptions& options) {
  int exit_code = 0;
  int stop = 0;
  {
    Batch batch(options);
    exit_code = batch.Run();
    stop = batch.stop();
  }
  // As the first process of a container this one goes on: the kernel spares it.
  if (stop != 0) raise(stop);
  return exit_code;
}

}  // namespace regrasp
