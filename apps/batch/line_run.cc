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

#include "apps/batch/process_pool.h"
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
      : input_(input), output_(output), work_(work), options_(options) {
    input_.SkipTo(output_.next());
  }

  int Run() {
    PoolOptions pool;
    pool.jobs = options_.jobs;
    pool.most_output = std::numeric_limits<std::size_t>::max();
    if (options_.time_limit_s) pool.time_limit.emplace(*options_.time_limit_s);
    return RunInChildren([this] { return Next(); }, pool, [this](int task) { return Work(task); },
                         [this](int task, const ChildExit& exit) { Take(task, exit); });
  }

 private:
  /// A chunk that has to be begun, under a number.
  std::optional<int> Next() {
    Chunk chunk;
    if (!again_.empty()) {
      chunk = std::move(again_.front());
      again_.pop_front();
    } else {
      const std::int64_t ahead = std::int64_t{kMostAhead} * options_.jobs;
      if (read_to_ >= output_.next() + ahead) return std::nullopt;
      chunk = Read();
      if (chunk.empty()) return std::nullopt;
      Prepare(chunk);
    }
    running_[task_] = {std::move(chunk), Clock::now()};
    return task_++;
  }

  Chunk Read() {
    Chunk chunk;
    // By the clock of a process a limit is that of one entry.
    const int most = options_.time_limit_s ? 1 : chunk_size_;
    while (static_cast<int>(chunk.size()) < most) {
      std::optional<Line> line = input_.Next();
      if (!line) break;
      read_to_ = line->entry;
      chunk.push_back(std::move(*line));
    }
    return chunk;
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
      std::cout << work_.work(line) << '\n' << std::flush;
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
