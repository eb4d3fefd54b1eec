#include "apps/batch/process_pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>
#include <vector>

namespace regrasp::apps {
namespace process_pool_test {

/// Time limit far above the need of any child here. It ends a child that hangs, which fails the
/// test.
constexpr std::chrono::seconds kHang{120};

std::map<int, ChildExit> RunAll(int count, int jobs, const std::function<int(int)>& work) {
  std::map<int, ChildExit> exits;
  const int stop = RunInChildren(count, {jobs, kHang}, work, [&](int index, ChildExit exit) {
    EXPECT_FALSE(exits.contains(index));
    exits[index] = std::move(exit);
  });
  EXPECT_EQ(stop, 0);
  EXPECT_EQ(static_cast<int>(exits.size()), count);
  return exits;
}

TEST(ProcessPoolTest, EveryTaskRunsInAProcessOfItsOwnAndItsExitCodeComesBack) {
  int changed_by_children = 0;
  for (const int jobs : {1, 3, 100}) {
    const auto exits = RunAll(10, jobs, [&](int index) {
      ++changed_by_children;
      return index;
    });
    for (const auto& [index, exit] : exits) {
      EXPECT_EQ(exit.kind, ChildExit::Kind::kExited);
      EXPECT_EQ(exit.code, index);
      EXPECT_EQ(exit.errors, "");
    }
  }
  EXPECT_EQ(changed_by_children, 0);
  EXPECT_TRUE(RunAll(0, 2, [](int) { return 0; }).empty());
}

TEST(ProcessPoolTest, TasksThatBecomeKnownWhenOthersEndAreRunToo) {
  // Each task except the last makes the next one available when it ends.
  constexpr int kLast = 5;
  int known = 0, begun = -1;
  std::vector<int> ended;
  const auto next = [&]() -> std::optional<int> {
    if (begun == known) return std::nullopt;
    return ++begun;
  };
  const int stop = RunInChildren(
      next, {3, kHang}, [](int task) { return task; },
      [&](int task, const ChildExit& exit) {
        EXPECT_EQ(exit.code, task);
        ended.push_back(task);
        if (known < kLast) ++known;
      });
  EXPECT_EQ(stop, 0);
  EXPECT_EQ(ended, (std::vector{0, 1, 2, 3, 4, 5}));
}

TEST(ProcessPoolTest, AsMuchOutputIsKeptAsTheOptionsSay) {
  const std::size_t length = 3 * kLongestText;
  for (const std::size_t most : {kLongestText, 2 * length}) {
    PoolOptions options;
    options.most_output = most;
    std::string output;
    const int stop = RunInChildren(
        1, options,
        [&](int) {
          std::cout << std::string(length, 'x');
          return 0;
        },
        [&](int, const ChildExit& exit) { output = exit.output; });
    EXPECT_EQ(stop, 0);
    EXPECT_EQ(output.size(), std::min(most, length));
  }
}

TEST(ProcessPoolTest, NoMoreThanTheJobsRunAtATime) {
  struct Shared {
    std::atomic<int> running{0}, most{0};
  };
  void* memory =
      mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  for (const int jobs : {1, 3}) {
    auto* shared = new (memory) Shared;
    RunAll(12, jobs, [&](int) {
      const int now = ++shared->running;
      int most = shared->most;
      while (most < now && !shared->most.compare_exchange_weak(most, now)) {
      }
      usleep(2000);
      --shared->running;
      return 0;
    });
    EXPECT_GE(shared->most, 1);
    EXPECT_LE(shared->most, jobs);
  }
  munmap(memory, sizeof(Shared));
}

TEST(ProcessPoolTest, WhatAChildDoesToItselfStopsNoOther) {
  const auto exits = RunAll(6, 2, [](int index) {
    if (index == 1) raise(SIGSEGV);
    if (index == 2) std::abort();
    if (index == 3) throw std::runtime_error("nobody catches this");
    if (index == 4) raise(SIGKILL);
    return 0;
  });
  for (const int good : {0, 5}) {
    EXPECT_EQ(exits.at(good).kind, ChildExit::Kind::kExited);
    EXPECT_EQ(exits.at(good).code, 0);
  }
  for (const int bad : {1, 2, 3, 4}) {
    // The address sanitizer turns a segmentation fault into an exit code.
    EXPECT_TRUE(exits.at(bad).kind == ChildExit::Kind::kSignalled || exits.at(bad).code != 0)
        << bad;
  }
  EXPECT_EQ(exits.at(2).kind, ChildExit::Kind::kSignalled);
  EXPECT_EQ(exits.at(2).code, SIGABRT);
  EXPECT_EQ(exits.at(4).code, SIGKILL);
}

TEST(ProcessPoolTest, MessagesComeBackCutWhereTheyNeverEnd) {
  const auto exits = RunAll(2, 2, [](int index) {
    if (index == 0) {
      std::cerr << "one line\n";
      std::cout << "on another stream";
      return 0;
    }
    const std::string piece(1 << 12, 'x');
    for (std::size_t sent = 0; sent < 4 * kLongestText; sent += piece.size()) std::cerr << piece;
    return 7;
  });
  EXPECT_EQ(exits.at(0).errors, "one line\n");
  EXPECT_EQ(exits.at(0).output, "on another stream");
  EXPECT_EQ(exits.at(1).code, 7);
  EXPECT_EQ(exits.at(1).errors.size(), kLongestText);
}

TEST(ProcessPoolTest, AChildThatNeverEndsIsStoppedAtTheLimit) {
  std::map<int, ChildExit> exits;
  const auto work = [](int) {
    while (true) pause();
    return 0;
  };
  const PoolOptions options{2, std::chrono::milliseconds(50)};
  (void)RunInChildren(3, options, work, [&](int index, ChildExit exit) { exits[index] = exit; });
  ASSERT_EQ(exits.size(), 3u);
  for (const auto& [index, exit] : exits) EXPECT_EQ(exit.kind, ChildExit::Kind::kTimedOut) << index;
}

TEST(ProcessPoolTest, AChildThatClosesItsMessagesIsStillWaitedFor) {
  const auto exits = RunAll(1, 1, [](int) {
    close(STDERR_FILENO);
    usleep(50000);
    return 5;
  });
  EXPECT_EQ(exits.at(0).code, 5);
}

TEST(ProcessPoolTest, NoChildIsLeftWhereTheCallerThrows) {
  const auto run = [] {
    (void)RunInChildren(
        4, {4, kHang},
        [](int index) {
          while (index != 0) pause();
          return 0;
        },
        [](int, const ChildExit&) { throw std::runtime_error("enough"); });
  };
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(ProcessPoolTest, ASignalStopsTheChildrenAndIsTheAnswer) {
  const int stop = RunInChildren(
      2, {2, kHang},
      [parent = getpid()](int index) {
        if (index == 0) kill(parent, SIGTERM);
        while (true) pause();
        return 0;
      },
      [](int, const ChildExit&) { ADD_FAILURE() << "none ends by itself"; });
  EXPECT_EQ(stop, SIGTERM);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

/// Shared state of a process that was stopped and its helper.
struct Stop {
  std::atomic<std::int64_t> clock_ns{0};
  std::atomic<bool> over{false};
};

bool IsStopped(pid_t process) {
  std::ifstream stream("/proc/" + std::to_string(process) + "/stat");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  return text.substr(text.rfind(')') + 2, 1) == "T";
}

/// Simulate a stop of this process for an hour, by a prescribed clock, while one child waits for
/// the end.
/// @returns how that child ended.
ChildExit::Kind RunThroughAStop(Stop& stop) {
  PoolOptions options{2, std::chrono::minutes(1)};
  options.now = [&] {
    return PoolOptions::Clock::time_point(std::chrono::nanoseconds(stop.clock_ns));
  };
  const auto work = [&, parent = getpid()](int index) {
    if (index == 0) {
      while (!stop.over) usleep(1000);
      return 0;
    }
    kill(parent, SIGSTOP);
    while (!IsStopped(parent)) usleep(1000);
    stop.clock_ns += std::chrono::nanoseconds(std::chrono::hours(1)).count();
    kill(parent, SIGCONT);
    return 0;
  };
  ChildExit::Kind kind = ChildExit::Kind::kSignalled;
  (void)RunInChildren(2, options, work, [&](int index, const ChildExit& exit) {
    // By now this process has read its clock.
    if (index == 1) stop.over = true;
    if (index == 0) kind = exit.kind;
  });
  return kind;
}

TEST(ProcessPoolTest, TimeInWhichThisProcessIsStoppedDoesNotCount) {
  void* memory =
      mmap(nullptr, sizeof(Stop), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  auto* stop = new (memory) Stop;
  // The test runs in its own process, so that the process that started the tests does not see them
  // stop.
  const auto run = [&] { std::exit(RunThroughAStop(*stop) == ChildExit::Kind::kExited ? 0 : 1); };
  EXPECT_EXIT(run(), testing::ExitedWithCode(0), "");
  EXPECT_TRUE(stop->over);
  munmap(memory, sizeof(Stop));
}

TEST(ProcessPoolTest, TimeThatPassesInSmallStepsCounts) {
  PoolOptions options{1, std::chrono::minutes(1)};
  int looks = 0;
  options.now = [&] { return PoolOptions::Clock::time_point(std::chrono::seconds(++looks) / 5); };
  ChildExit::Kind kind = ChildExit::Kind::kExited;
  const auto work = [](int) {
    // Messages make the parent read its clock.
    while (true) std::cerr << "still here" << std::endl;
    return 0;
  };
  (void)RunInChildren(1, options, work, [&](int, const ChildExit& exit) { kind = exit.kind; });
  EXPECT_EQ(kind, ChildExit::Kind::kTimedOut);
  EXPECT_GT(looks, 5 * 60);
}

TEST(ProcessPoolTest, SignalsAreAsTheyWereAfterwards) {
  sigset_t before, after;
  sigprocmask(SIG_BLOCK, nullptr, &before);
  RunAll(3, 2, [](int) {
    sigset_t inside;
    sigprocmask(SIG_BLOCK, nullptr, &inside);
    return sigismember(&inside, SIGINT);
  });
  sigprocmask(SIG_BLOCK, nullptr, &after);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) {
    EXPECT_EQ(sigismember(&before, signal), sigismember(&after, signal)) << signal;
  }
}

TEST(ProcessPoolTest, ExitCodesArriveWhereThisProcessIgnoresItsChildren) {
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  struct sigaction before {};
  sigaction(SIGCHLD, &ignore, &before);
  EXPECT_EQ(RunAll(1, 1, [](int) { return 9; }).at(0).code, 9);
  sigaction(SIGCHLD, &before, nullptr);
}

}  // namespace process_pool_test
}  // namespace regrasp::apps
