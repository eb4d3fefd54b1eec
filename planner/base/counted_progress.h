#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace regrasp {

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
