#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace regrasp {

/// Process the indices below `count` by several threads in blocks, as `work(begin, end)`.
/// Blocks are started in ascending order. A started block is completed.
/// @param block    number of indices per block, at least 1. It should be large enough for
///     negligible overhead, and small enough for an even load.
/// @param threads  number of threads; 0: number of cores. At most one per block is used.
/// @throws std::invalid_argument  if `threads` is negative.
/// @throws any exception of `work`: that of the first failed block. Later blocks may be skipped.
void InBlocks(std::size_t count, std::size_t block, int threads,
              const std::function<void(std::size_t begin, std::size_t end)>& work);

/// Callback for progress messages; can be empty.
using Tell = std::function<void(std::string_view)>;

/// Progress messages of work that consists of countable pieces.
/// Example: "testing quadruples of faces: 1200 of 5000". The first message is sent at construction,
/// and later ones at most once per hundredth of the work.
class CountedProgress {
 public:
  CountedProgress(const Tell& tell, std::string what, std::int64_t total);

  /// Count one completed piece.
  void Add() { Reach(done_ + 1); }
  /// Set the number of completed pieces.
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
