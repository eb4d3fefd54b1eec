#include "planner/base/in_blocks.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace regrasp {

namespace {

class Blocks {
 public:
  Blocks(std::size_t count, std::size_t block,
         const std::function<void(std::size_t, std::size_t)>& work)
      : count_(count), block_(block), work_(work) {}

  void Run() {
    while (!failed_) {
      const std::size_t begin = next_.fetch_add(block_);
      if (begin >= count_) return;
      try {
        work_(begin, std::min(count_, begin + block_));
      } catch (...) {
        Fail(begin, std::current_exception());
      }
    }
  }

  void ThrowFailure() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void Fail(std::size_t begin, std::exception_ptr failure) {
    const std::scoped_lock lock(mutex_);
    failed_ = true;
    if (failure_ && failed_at_ <= begin) return;
    failure_ = std::move(failure);
    failed_at_ = begin;
  }

  std::size_t count_;
  std::size_t block_;
  const std::function<void(std::size_t, std::size_t)>& work_;
  std::atomic<std::size_t> next_ = 0;
  std::atomic<bool> failed_ = false;
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::size_t failed_at_ = 0;
};

}  // namespace

void InBlocks(std::size_t count, std::size_t block, int threads,
              const std::function<void(std::size_t, std::size_t)>& work) {
  if (threads < 0) throw std::invalid_argument(std::to_string(threads) + " threads");
  const std::size_t asked =
      threads > 0 ? static_cast<std::size_t>(threads) : std::thread::hardware_concurrency();
  const std::size_t used = std::clamp<std::size_t>(asked, 1, 1 + count / block);
  Blocks blocks(count, block, work);
  {
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < used; ++i) others.emplace_back([&blocks] { blocks.Run(); });
    blocks.Run();
  }
  blocks.ThrowFailure();
}

namespace {

/// Number of messages per work.
constexpr std::int64_t kReports = 100;

}  // namespace

CountedProgress::CountedProgress(const Tell& tell, std::string what, std::int64_t total)
    : tell_(tell), what_(std::move(what)), total_(total) {
  Report();
}

void CountedProgress::Report() {
  // Rounding up keeps the number of messages below this limit.
  next_ = done_ + (total_ + kReports - 1) / kReports;
  if (tell_) tell_(what_ + ": " + std::to_string(done_) + " of " + std::to_string(total_));
}

}  // namespace regrasp
