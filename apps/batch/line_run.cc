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

/// A child works on as many entries as take about this long, seconds: so many that a process more
/// does not matter (with eight plans of 70 ms each 0.7 % of the time went to processes, and each
/// looks the engine's functions up anew), and few enough that little is lost with a run that is
/// killed, and that the last ones do not wait for one.
constexpr double kChunkTime = 4;
constexpr int kFirstChunk = 8;
constexpr int kLargestChunk = 64;

/// How far ahead of the output children may be, in entries a job: their results wait in memory.
constexpr int kMostAhead = 2048;

/// Entries that are kept from one report of progress to the next.
constexpr std::int64_t kToldEvery = 1024;

/// Groups that are remembered; to forget one costs time alone.
constexpr std::size_t kMostGroups = 4096;

/// Memory that a child keeps while it has entries to do; the most that malloc takes for it.
constexpr int kKeptBytes = 1 << 25;

using Chunk = std::vector<Line>;
using Clock = std::chrono::steady_clock;

/// What a child has been given, and when.
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
  /// Keeps the results of an earlier run from the first entry on, up to one that is not reused.
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

  /// The next line with the digest of its inputs.
  std::optional<Line> Get() {
    if (waiting_) return std::exchange(waiting_, std::nullopt);
    std::optional<Line> line = input_.Next();
    if (line && work_.inputs) line->inputs = work_.inputs(*line);
    return line;
  }

  /// Messages of a record that is reused are repeated: whoever reads them sees no difference.
  [[nodiscard]] bool IsReusable(const Line& line, std::string_view record) const {
    if (line.inputs.empty() || SealedInputs(record) != line.inputs) return false;
    if (work_.complete && !work_.complete(line, record)) return false;
    if (!work_.messages) return true;
    try {
      for (const std::string& message : work_.messages(line, record)) options_.on_message(message);
    } catch (const InputError&) {
      return false;  // somebody edited and sealed it
    }
    return true;
  }

  /// A chunk that has to be begun, under a number.
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

  /// Reads lines to work on, and finishes those on the way that an earlier run has done.
  /// @param last  entry to read up to.
  /// @returns false at the end of the input.
  bool Read(Chunk& chunk, std::int64_t last) {
    // By the clock of a process a limit is that of one entry.
    const int most = options_.time_limit_s ? 1 : chunk_size_;
    while (static_cast<int>(chunk.size()) < most && read_to_ < last) {
      std::optional<Line> line = Get();
      if (!line) return false;
      read_to_ = line->entry;
      const auto earlier = output_.FindEarlier(
          line->entry, [&](std::string_view record) { return IsReusable(*line, record); });
      if (earlier) {
        // A chunk has neighbours only, whose results are appended together.
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

  /// In a child.
  int Work(int task) {
    // What an engine took for one plan it asks for again for the next: to return it to the system
    // and to be given fresh pages took as long as to compile the scene.
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

  /// What a child has written, as far as lines are whole; where it ended early the entry that it
  /// was at is an error, and others go on with the rest.
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

  /// What is done at a time goes by what the last child has done.
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
  std::optional<Line> waiting_;                   ///< the first one that is not kept
  std::deque<Chunk> again_;                       ///< rests of chunks whose process ended early
  std::map<std::int64_t, std::string> finished_;  ///< lines that wait for others, by first entry
  std::set<std::string> groups_;                  ///< that were prepared
};

}  // namespace

int RunLines(LinesInput& input, LinesOutput& output, const LineWork& work,
             const LineRunOptions& options) {
  return LineRun(input, output, work, options).Run();
}

}  // namespace regrasp::apps
