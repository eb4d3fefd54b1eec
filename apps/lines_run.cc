#include "apps/lines_run.h"

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>

#include "apps/program.h"
#include "apps/progress.h"
#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

/// Exit code minus the number of the signal that stopped a run, as in shells.
constexpr int kSignalled = 128;

/// Maximum number of printed messages.
/// A million bad lines may have the same message.
constexpr int kMostMessages = 20;

/// Return the exit code of an outcome.
/// If the input lines are plans, a line without a plan is not an error.
int ExitCodeOf(Outcome outcome, const std::string& content) {
  switch (outcome) {
    case Outcome::kPlan:
    case Outcome::kPass:
      return kExitDone;
    case Outcome::kNoPlan:
      return content == "plans" ? kExitNegative : kExitDone;
    case Outcome::kFail:
      return kExitNegative;
    case Outcome::kBadInput:
      return kExitBadInput;
    case Outcome::kError:
      return kExitEnvironment;
  }
  return kExitEnvironment;
}

int ExitCodeOf(const OutcomeCounts& counts, const std::string& content) {
  int worst = kExitDone;
  for (const auto& [outcome, count] : counts) worst = std::max(worst, ExitCodeOf(outcome, content));
  return worst;
}

class Messages {
 public:
  Messages(const LinesRun& run, ProgressLine& progress) : run_(run), progress_(progress) {}
  void Print(const std::string& message) {
    if (++count_ > kMostMessages) return;
    progress_.Clear();
    PrintMessage(run_.program, message);
  }
  void PrintRest() const {
    if (count_ <= kMostMessages) return;
    PrintMessage(run_.program, run_.output.string() + ": " +
                                   std::to_string(count_ - kMostMessages) + " more messages");
  }

 private:
  const LinesRun& run_;
  ProgressLine& progress_;
  std::int64_t count_ = 0;
};

}  // namespace

int RunLinesFile(const LinesRun& run) {
  Stopwatch watch;
  LinesInput input(run.input, run.shard.empty() ? Shard() : ParseShard("--shard", run.shard));
  const LinesHeader header{run.content, input.entries(), input.shard(), run.digest(input.source())};
  ProgressLine progress(run.quiet);
  ProgressLog log(run.program, run.quiet);
  Messages messages(run, progress);
  int stop = 0;
  OutcomeCounts counts;
  std::int64_t kept = 0;
  {
    LinesOutput output(run.output, header, run.fresh);
    const auto tell = [&] {
      const EntryRange range = header.range();
      const std::string text = std::to_string(output.next() - range.first) + " of " +
                               std::to_string(range.count()) + " entries";
      progress.Report(text);
      log.Report(text);
    };
    tell();
    stop = RunLines(input, output, run.work,
                    {run.jobs, run.time_limit_s,
                     [&](const std::string& message) { messages.Print(message); }, tell});
    if (stop == 0) output.Finish();
    counts = output.counts();
    kept = output.kept();
  }
  progress.Clear();
  messages.PrintRest();
  // The signal has no effect on the first process of a container, which therefore continues.
  if (stop != 0) raise(stop);
  if (stop != 0) return kSignalled + stop;
  if (!run.quiet) {
    PrintMessage(run.program,
                 run.output.string() + ": " + OutcomeCountsText(counts) +
                     (kept > 0 ? "; " + std::to_string(kept) + " kept from an earlier run" : "") +
                     "; " + FormatPlain(watch.Lap(), 2) + " s");
  }
  return ExitCodeOf(counts, run.content);
}

std::string GuardLine(const Line& line, const std::function<std::string()>& work) {
  const auto result = [&line](Outcome outcome, const std::string& message) {
    const bool named = message.starts_with(line.name);
    std::cerr << (named ? "" : line.name + ": ") + message + "\n";
    return FormatNoResult(line.entry, outcome, named ? message : line.name + ": " + message);
  };
  try {
    return work();
  } catch (const InputError& error) {
    return result(Outcome::kBadInput, error.what());
  } catch (const TimeUp& time_up) {
    return FormatNoResult(line.entry, Outcome::kNoPlan, time_up.what());
  } catch (const std::bad_alloc&) {
    return result(Outcome::kError, "not enough memory");
  } catch (const std::exception& error) {
    return result(Outcome::kError, error.what());
  }
}

}  // namespace regrasp::apps
