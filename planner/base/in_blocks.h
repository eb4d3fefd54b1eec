#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace regrasp {

/// Works on the indices below `count` in several threads, a block at a time: `work(begin, end)`.
/// Blocks are taken in order; one that was taken is finished.
/// @param block    ≥ 1 indices that a thread takes: enough that taking them costs nothing, few
///                 enough that the threads end together.
/// @param threads  0: as many as the machine has cores; no more than there are blocks.
/// @throws std::invalid_argument  fewer than 0 threads.
/// @throws what `work` throws in the first block of all that throw; later ones may not be worked
///         on.
void InBlocks(std::size_t count, std::size_t block, int threads,
              const std::function<void(std::size_t begin, std::size_t end)>& work);

/// Told what is being done; may be empty.
using Tell = std::function<void(std::string_view)>;

/// Tells of work that is done piece by piece how much of it there is and how much is done: "testing
/// quadruples of faces: 1200 of 5000". At the beginning, and then once in a hundredth of the work
/// at most: work of any size tells some hundred times.
class CountedProgress {
 public:
  CountedProgress(const Tell& tell, std::string what, std::int64_t total);

  /// A piece is done.
  void Add() { Reach(done_ + 1); }
  /// So many are done.
  void Reach(std::int64_t done) {
    done_ = done;
    if (done_ >= next_) Report();
  }

 private:
  void Report();

  const Tell& tell_;  ///< outlives this object
  std::string what_;
  std::int64_t total_;
  std::int64_t done_ = 0;
  std::int64_t next_ = 0;
};

}  // namespace regrasp
