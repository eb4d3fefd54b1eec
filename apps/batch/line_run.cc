#include "apps/batch/line_run.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <iostream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "apps/batch/line_records.h"
#include "apps/batch/process_pool.h"
#include "planner/base/error.h"
#include "planner/base/number.h"

namespace regrasp::apps {

namespace {

/// Intended duration of a child process, s, which determines its number of entries.
/// It is long enough that the cost of a process is negligible: with eight plans of 70 ms each,
/// processes took 0.7 % of the time, and each resolves the engine's symbols again. It is short
/// enough that a killed run loses little, and that the other jobs do not wait long for the last
/// child.
constexpr double kChunkTime = 4;
constexpr int kFirstChunk = 8;
constexpr int kLargestChunk = 64;

/// Maximum lead of children over the output, in entries per job, because their results wait in
/// memory.
constexpr int kMostAhead = 2048;

/// Number of kept entries between two progress reports.
constexpr std::int64_t kToldEvery = 1024;

/// Maximum number of remembered groups. A forgotten group is prepared again, which only costs time.
constexpr std::size_t kMostGroups = 4096;

/// Memory that a child retains between entries, bytes: the maximum that malloc accepts.
constexpr int kKeptBytes = 1 << 25;

using Chunk = std::vector<Line>;
using Clock = std::chrono::steady_clock;

/// Chunk of a running child, and its start time.
struct Running {
  Chunk chunk;
  Clock::time_point since;
};

class LineRun {
 public:
  LineRun(LinesInput& input, LinesOutput& output, const LineWork& work,
          const LineRunOptions& options)
      : input_(input), output_(output), work_(work), options_(options) {}

  int Run() {
    KeepResults();
    PoolOptions pool;
    pool.jobs = options_.jobs;
    pool.most_output = std::numeric_limits<std::size_t>::max();
    if (options_.time_limit_s) pool.time_limit.emplace(*options_.time_limit_s);
    return RunInChildren([this] { return Next(); }, pool, [this](int task) { return Work(task); },
                         [this](int task, const ChildExit& exit) { Take(task, exit); });
  }

 private:
  /// Keep the results of an earlier run from the first entry up to the first that is not reusable.
  void KeepResults() {
    for (std::optional<Line> line = Get(); line; line = Get()) {
      const bool kept =
          output_.KeepNext([&](std::string_view record) { return IsReusable(*line, record); });
      if (!kept) {
        waiting_ = std::move(line);
        return;
      }
      if (line->entry % kToldEvery == 0) options_.on_progress();
    }
  }

  /// Return the next line with the digest of its inputs.
  std::optional<Line> Get() {
    if (waiting_) return std::exchange(waiting_, std::nullopt);
    std::optional<Line> line = input_.Next();
    if (line && work_.inputs) line->inputs = work_.inputs(*line);
    return line;
  }

  /// The messages of a reused record are printed again, so that the output does not differ from
  /// that of a first run.
  [[nodiscard]] bool IsReusable(const Line& line, std::string_view record) const {
    if (line.inputs.empty() || SealedInputs(record) != line.inputs) return false;
    if (work_.complete && !work_.complete(line, record)) return false;
    if (!work_.messages) return true;
    try {
      for (const std::string& message : work_.messages(line, record)) options_.on_message(message);
    } catch (const InputError&) {
      return false;  // the line was edited and sealed again
    }
    return true;
  }

  /// Return the number of a chunk to start.
  std::optional<int> Next() {
    Chunk chunk;
    if (!again_.empty()) {
      chunk = std::move(again_.front());
      again_.pop_front();
    } else {
      const std::int64_t ahead = std::int64_t{kMostAhead} * options_.jobs;
      bool more = true;
      while (more && chunk.empty()) {
        if (read_to_ >= output_.next() + ahead) return std::nullopt;
        more = Read(chunk, output_.next() + ahead);
        AppendFinished();
      }
      if (chunk.empty()) return std::nullopt;
      Prepare(chunk);
    }
    running_[task_] = {std::move(chunk), Clock::now()};
    return task_++;
  }

  /// Read lines for a chunk, and finish those that have a reusable result of an earlier run.
  /// @param last  last entry to read.
  /// @returns false at the end of the input.
  bool Read(Chunk& chunk, std::int64_t last) {
    // The time limit applies to a process, so with a limit a process has only one entry.
    const int most = options_.time_limit_s ? 1 : chunk_size_;
    while (static_cast<int>(chunk.size()) < most && read_to_ < last) {
      std::optional<Line> line = Get();
      if (!line) return false;
      read_to_ = line->entry;
      const auto earlier = output_.FindEarlier(
          line->entry, [&](std::string_view record) { return IsReusable(*line, record); });
      if (earlier) {
        // Entries of a chunk are consecutive, because their results are appended together.
        finished_[line->entry] = *earlier + "\n";
        if (!chunk.empty()) return true;
      } else {
        chunk.push_back(std::move(*line));
      }
    }
    return true;
  }

  void Prepare(const Chunk& chunk) {
    for (const Line& line : chunk) {
      if (groups_.size() >= kMostGroups) groups_.clear();
      if (groups_.insert(work_.group(line)).second) work_.prepare(line);
    }
  }

  /// Runs in a child.
  int Work(int task) {
    // Retain the memory that the engine used for one plan, because the next plan uses it again.
    // Returning it to the system and getting new pages took as long as compiling the scene.
    mallopt(M_MMAP_THRESHOLD, kKeptBytes);
    mallopt(M_TRIM_THRESHOLD, kKeptBytes);
    for (const Line& line : running_.at(task).chunk) {
      const std::string record = work_.work(line);
      std::cout << (line.inputs.empty() ? record : SealRecord(record, line.entry, line.inputs))
                << '\n'
                << std::flush;
    }
    return 0;
  }

  /// Take the complete lines that a child has written. If the child ended early, its current entry
  /// is an error, and other children continue with the remaining entries.
  void Take(int task, const ChildExit& exit) {
    auto [chunk, since] = std::move(running_.extract(task).mapped());
    Say(exit.errors);
    const std::int64_t first = chunk.front().entry;
    std::string lines = exit.output.substr(0, exit.output.rfind('\n') + 1);
    auto done = static_cast<std::size_t>(std::ranges::count(lines, '\n'));
    MeasureChunk(done, std::chrono::duration<double>(Clock::now() - since).count());
    if (done < chunk.size()) {
      const Line& stopped = chunk[done];
      const std::string why = Why(exit);
      options_.on_message(stopped.name + ": " + why);
      lines += FormatNoResult(stopped.entry, Outcome::kError, why) + "\n";
      ++done;
    }
    if (done < chunk.size()) {
      chunk.erase(chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(done));
      again_.push_back(std::move(chunk));
    }
    finished_[first] = std::move(lines);
    AppendFinished();
  }

  /// The chunk size is based on the speed of the last child.
  void MeasureChunk(std::size_t done, double seconds) {
    const double size = kChunkTime * static_cast<double>(done) / std::max(seconds, 1e-9);
    chunk_size_ = static_cast<int>(std::clamp(size, 1.0, double{kLargestChunk}));
  }

  void AppendFinished() {
    std::string lines;
    std::int64_t next = output_.next();
    for (auto found = finished_.find(next); found != finished_.end();
         found = finished_.find(next)) {
      next += std::ranges::count(found->second, '\n');
      lines += found->second;
      finished_.erase(found);
    }
    if (lines.empty()) return;
    output_.Append(lines);
    options_.on_progress();
  }

  [[nodiscard]] std::string Why(const ChildExit& exit) const {
    switch (exit.kind) {
      case ChildExit::Kind::kExited:
        return "ended with exit code " + std::to_string(exit.code);
      case ChildExit::Kind::kSignalled:
        return "crashed: " + std::string(strsignal(exit.code));
      case ChildExit::Kind::kTimedOut:
        return "took longer than --time-limit " + FormatDouble(*options_.time_limit_s);
    }
    return "";
  }

  void Say(const std::string& errors) const {
    std::istringstream stream(errors);
    for (std::string line; std::getline(stream, line);) options_.on_message(line);
  }

  LinesInput& input_;
  LinesOutput& output_;
  const LineWork& work_;
  const LineRunOptions& options_;
  int task_ = 0;
  std::int64_t read_to_ = 0;
  int chunk_size_ = kFirstChunk;
  std::map<int, Running> running_;
  std::optional<Line> waiting_;  ///< first line that is not kept
  std::deque<Chunk> again_;      ///< remaining entries of chunks whose process ended early
  /// lines waiting for earlier ones, by first entry
  std::map<std::int64_t, std::string> finished_;
  std::set<std::string> groups_;  ///< prepared groups
};

}  // namespace

int RunLines(LinesInput& input, LinesOutput& output, const LineWork& work,
             const LineRunOptions& options) {
  return LineRun(input, output, work, options).Run();
}

}  // namespace regrasp::apps
