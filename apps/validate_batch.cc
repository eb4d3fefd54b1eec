#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <set>
#include <sstream>
#include <system_error>

#include "apps/batch/batch_page.h"
#include "apps/batch/batch_summary.h"
#include "apps/batch/plan_library.h"
#include "apps/batch/process_pool.h"
#include "apps/earlier_run.h"
#include "apps/frame_files.h"
#include "apps/locked_output_folder.h"
#include "apps/output_files.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/validate_run.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

namespace fs = std::filesystem;

constexpr char kWarning[] = "warning: ";

/// Exit code minus the number of the signal that stopped a batch, as in shells.
constexpr int kChildSignalled = 128;

/// Exit code of a child process that keeps the report of an earlier run.
/// It is larger than every ExitCode.
constexpr int kExitKept = 4;

/// Validate one plan in a child process, and print the duration of each entry.
int ValidateOne(ValidateOptions options, const LibraryPlan& plan, const fs::path& folder) {
  options.plan_path = plan.path.string();
  options.out = (folder / plan.name).string();
  options.index_key = PlanKey(plan.name);
  options.junit.clear();
  options.quiet = true;
  options.workers = std::max(1, options.workers / options.jobs);
  options.jobs = 1;  // the plans already use all threads
  return RunGuarded(kValidateName, [&] {
    if (!options.fresh && HasSameRun(options)) return kExitKept;
    {
      LockedOutputFolder results(options.out);
      RemoveEarlierRun(results, OwnResults(results));
    }
    const ValidationRun run = RunValidation(options);
    for (const double seconds : run.entry_seconds) std::cout << seconds << ' ';
    return run.exit_code;
  });
}

/// Return the durations of replayed entries in the output of a child process.
std::vector<double> TimesIn(const std::string& output) {
  std::istringstream stream(output);
  std::vector<double> times;
  for (double seconds = 0; stream >> seconds;) times.push_back(seconds);
  return times;
}

/// Return the lines that a child process wrote, without the program's name.
std::vector<std::string> LinesOf(const std::string& text) {
  const std::string prefix = std::string(kValidateName) + ": ";
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line.starts_with(prefix) ? line.substr(prefix.size()) : line);
  }
  return lines;
}

/// Return the reason that a child process was stopped; empty if it exited.
std::string WhyStopped(const ChildExit& exit, const ValidateOptions& options) {
  switch (exit.kind) {
    case ChildExit::Kind::kExited:
      return "";
    case ChildExit::Kind::kSignalled:
      return "crashed: " + std::string(strsignal(exit.code));
    case ChildExit::Kind::kTimedOut:
      return "exceeded --time-limit " + FormatDouble(*options.time_limit_s);
  }
  return "";
}

/// Return all input files of a batch.
/// In a folder of objects, each file may be the object of a plan.
std::vector<NamedFile> InputsOf(const ValidateOptions& options, const PlanLibrary& library) {
  std::vector<NamedFile> inputs = {{"--object", options.object_path},
                                   {"--start", options.start},
                                   {"--goal", options.goal},
                                   {"--hand", options.hand},
                                   {"--conditions", options.ConditionsFile()}};
  std::error_code error;
  for (fs::directory_iterator entry(options.object_path, error), end; !error && entry != end;
       entry.increment(error)) {
    inputs.push_back({"--object", entry->path()});
  }
  for (const LibraryPlan& plan : library.plans) inputs.push_back({"--plan", plan.path});
  return inputs;
}

PlanLibrary FindLibrary(const ValidateOptions& options) {
  PlanLibrary library = FindPlans(options.plans);
  const fs::path folder = options.Folder();
  OutputFiles outputs;
  outputs.Add("--junit", options.junit);
  outputs.folders.push_back({"--output", folder, [](const std::string& name) {
                               return name == kSummaryName || name == kIndexName;
                             }});
  for (const LibraryPlan& plan : library.plans) {
    outputs.folders.push_back({"--output", folder / plan.name, IsValidationFile});
  }
  CheckOutputsDiffer(InputsOf(options, library), outputs);
  // The process of each plan checks the folder of the plan.
  outputs.folders.resize(1);
  CheckOutputsWritable(outputs);
  return library;
}

class Batch {
 public:
  explicit Batch(const ValidateOptions& options)
      : options_(options),
        library_(FindLibrary(options)),
        folder_(options.Folder()),
        progress_(options.quiet),
        log_(kValidateName, options.quiet) {
    summary_.skipped = library_.skipped;
    for (const LibraryPlan& plan : library_.plans) {
      PlanOutcome& outcome = summary_.plans.emplace_back();
      outcome.name = plan.name;
      outcome.file = plan.path.filename().string();
    }
  }

  /// Run the batch.
  /// @returns the exit code.
  int Run() {
    PrepareFolder();
    ShowProgress();
    stop_ = RunInChildren(
        static_cast<int>(library_.plans.size()),
        {options_.jobs, options_.time_limit_s
                            ? std::optional(std::chrono::duration<double>(*options_.time_limit_s))
                            : std::nullopt},
        [this](int index) { return ValidateOne(options_, library_.plans[index], folder_.path()); },
        [this](int index, const ChildExit& exit) { Take(index, exit); });
    progress_.Clear();
    if (stop_ != 0) return kChildSignalled + stop_;
    ExpectResults();
    WriteFile(folder_.path() / kIndexName, FormatBatchPage(summary_));
    WriteFile(folder_.path() / kSummaryName, FormatSummaryJson(summary_));
    if (!options_.junit.empty()) {
      WriteFile(options_.junit, FormatSummaryJunit(summary_, PathForCi(folder_.path())));
    }
    if (!options_.quiet) {
      PrintTable(FormatSummaryTable(summary_), (folder_.path() / kIndexName).string() + ", " +
                                                   kSummaryName + ", and a folder for each plan");
    }
    return static_cast<int>(summary_.verdict());
  }

  /// Signal that stopped the batch; 0 if all plans were validated.
  [[nodiscard]] int stop() const { return stop_; }

 private:
  /// Remove an earlier summary, so that it is never next to results of another run.
  void PrepareFolder() {
    const std::set<std::string> own = OwnSummary(folder_);
    ExpectFree(folder_, own, {kSummaryName, kIndexName});
    RemoveEarlierRun(folder_, own);
    folder_.Announce({kSummaryName, kIndexName});
  }

  void ShowProgress() {
    const std::string text = std::to_string(done_) + " of " +
                             std::to_string(library_.plans.size()) + " plans, " +
                             std::to_string(not_passed_) + " not passed";
    progress_.Report(text);
    log_.Report(text);
  }

  void Take(int index, const ChildExit& exit) {
    PlanOutcome& outcome = summary_.plans[index];
    outcome.seconds = exit.seconds;
    outcome.entry_seconds = TimesIn(exit.output);
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
      // Failures are printed for reused results, too.
      const auto failure = outcome.kept ? outcome.report->failure() : std::nullopt;
      if (failure) lines.push_back(failure->line());
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

  /// Check that all reported results exist.
  /// Another process may have removed them during the run.
  void ExpectResults() {
    for (PlanOutcome& outcome : summary_.plans) {
      if (!outcome.report) continue;
      std::vector<std::string> names = {kReportName};
      for (const report::FileDigest& file : outcome.report->files) names.push_back(file.name);
      const auto gone = std::ranges::find_if_not(names, [&](const std::string& name) {
        std::error_code error;
        return fs::is_regular_file(folder_.path() / outcome.name / name, error);
      });
      if (gone == names.end()) continue;
      outcome.report.reset();
      outcome.kept = false;
      outcome.verdict = PlanVerdict::kError;
      outcome.message = *gone + " was removed during the run";
      PrintMessage(kValidateName, outcome.name + ": " + outcome.message);
    }
  }

  /// Take the result from the report file, for new and for kept results.
  void TakeReport(bool kept, PlanOutcome& outcome) {
    try {
      outcome.report = ReadReportSummary(folder_.path() / outcome.name / kReportName);
      outcome.kept = kept;
      outcome.verdict = outcome.report->passed ? PlanVerdict::kPass : PlanVerdict::kFail;
      outcome.message.clear();
    } catch (const InputError& error) {
      outcome.message = error.what();
    }
  }

  const ValidateOptions& options_;
  PlanLibrary library_;
  LockedOutputFolder folder_;
  ProgressLine progress_;
  ProgressLog log_;
  BatchSummary summary_;
  int done_ = 0;
  int not_passed_ = 0;
  int stop_ = 0;
};

}  // namespace

int RunBatch(const ValidateOptions& given) {
  ValidateOptions options = given;
  try {
    options.hand_sha256 = HandInput(given);  // computed once for all plans
  } catch (const InputError&) {
    // The run of each plan reports the error.
  }
  int exit_code = 0;
  int stop = 0;
  {
    Batch batch(options);
    exit_code = batch.Run();
    stop = batch.stop();
  }
  // The signal has no effect on the first process of a container, which therefore continues.
  if (stop != 0) raise(stop);
  return exit_code;
}

}  // namespace regrasp::apps
