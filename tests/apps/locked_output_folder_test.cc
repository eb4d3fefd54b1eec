#include "apps/locked_output_folder.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "tests/fixtures/folder_test.h"

namespace regrasp::apps {
namespace locked_output_folder_test {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr milliseconds kAtOnce{0};
/// Time limit, ms, far above the time for which a test holds a folder.
constexpr milliseconds kHang{120'000};

/// Run work in a forked child, whose result is an exit code: neither an exception nor a test
/// failure can leave it.
int InChild(const std::function<int()>& work) {
  const pid_t child = fork();
  if (child == 0) {
    int code = 99;
    try {
      code = work();
    } catch (const std::exception&) {
    }
    _exit(code);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

class LockedOutputFolderTest : public FolderTest {
 protected:
  template <class Error>
  std::string Refusal() const {
    try {
      LockedOutputFolder(folder_, kAtOnce);
    } catch (const Error& error) {
      return error.what();
    }
    return "nothing was refused";
  }
};

TEST_F(LockedOutputFolderTest, OneWhoComesLaterIsToldWhoHoldsIt) {
  const std::string process = std::to_string(getpid());
  {
    const LockedOutputFolder held(folder_);
    const std::string said = Refusal<EnvironmentError>();
    EXPECT_THAT(said, HasSubstr(folder_.string() + ": process " + process + " on "));
    EXPECT_THAT(said, HasSubstr("writes into this folder"));
    EXPECT_EQ(InChild([&] { return LockedOutputFolder(folder_, kAtOnce).left_behind().empty(); }),
              99);
  }
  EXPECT_EQ(Refusal<EnvironmentError>(), "nothing was refused");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(LockedOutputFolderTest, AFolderIsMadeAndGoesWhereNothingWasPutIntoIt) {
  const fs::path outer = folder_ / "a";
  const fs::path inner = outer / "b" / "c";
  { const LockedOutputFolder folder(inner); }
  EXPECT_FALSE(fs::exists(outer));
  {
    const LockedOutputFolder folder(inner);
    WriteFile(outer / "mine", "");
  }
  EXPECT_FALSE(fs::exists(outer / "b"));
  EXPECT_TRUE(fs::exists(outer / "mine"));
  { const LockedOutputFolder folder(outer); }
  EXPECT_TRUE(fs::exists(outer / "mine"));
  fs::create_directory(folder_ / "empty");
  { const LockedOutputFolder folder(folder_ / "empty"); }
  EXPECT_TRUE(fs::exists(folder_ / "empty"));
}

TEST_F(LockedOutputFolderTest, AKilledProcessLeavesNoLockButWhatItAnnounced) {
  const auto announce = [&](const std::vector<std::string>& names) {
    return InChild([&] {
      LockedOutputFolder folder(folder_, kAtOnce);
      folder.Announce(names);
      return raise(SIGKILL);
    });
  };
  EXPECT_EQ(announce({"a.png", "b.png"}), -SIGKILL);
  // A process that is killed adds its own files as well.
  EXPECT_EQ(announce({"c d.png"}), -SIGKILL);
  {
    const LockedOutputFolder folder(folder_, kAtOnce);
    EXPECT_THAT(folder.left_behind(), ElementsAre("a.png", "b.png", "c d.png"));
  }
  EXPECT_THAT(LockedOutputFolder(folder_, kAtOnce).left_behind(), IsEmpty());
}

TEST_F(LockedOutputFolderTest, ChildrenHoldTheFolderUntilTheLastIsGone) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  pid_t child = -1;
  {
    const LockedOutputFolder folder(folder_, kAtOnce);
    child = fork();
    if (child == 0) {
      char byte = 0;
      close(ends[1]);
      _exit(static_cast<int>(read(ends[0], &byte, 1)));
    }
    WriteFile(folder_ / "copy", ReadFile(folder_ / kRunFileName));
    // State after a kill: the file remains.
    fs::create_hard_link(folder_ / kRunFileName, folder_ / "kept");
  }
  fs::rename(folder_ / "kept", folder_ / kRunFileName);
  EXPECT_THAT(Refusal<EnvironmentError>(), HasSubstr("writes into this folder"));
  close(ends[1]);
  waitpid(child, nullptr, 0);
  close(ends[0]);
  EXPECT_EQ(Refusal<EnvironmentError>(), "nothing was refused");
}

TEST_F(LockedOutputFolderTest, NoTwoProcessesHoldItHoweverOftenItChangesHands) {
  constexpr int kProcesses = 4;
  constexpr int kTurns = 200;
  const auto take_turns = [&] {
    int turns = 0;
    for (int i = 0; i < kTurns; ++i) {
      const LockedOutputFolder folder(folder_ / "out", kHang);
      const std::string mark = folder_ / "mark";
      const int alone = open(mark.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
      turns += alone >= 0;
      sched_yield();
      close(alone);
      unlink(mark.c_str());
    }
    return turns;
  };
  std::vector<pid_t> children;
  for (int i = 0; i < kProcesses; ++i) {
    children.push_back(fork());
    if (children.back() == 0) _exit(InChild(take_turns));
  }
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), kTurns);
  }
}

TEST_F(LockedOutputFolderTest, WhatIsNotOursIsRefusedAndStays) {
  const fs::path file = folder_ / kRunFileName;
  WriteFile(file, "shopping list\n");
  EXPECT_THAT(Refusal<InputError>(), HasSubstr("cannot overwrite"));
  EXPECT_EQ(ReadFile(file), "shopping list\n");
  fs::remove(file);
  WriteFile(folder_ / "other", "");
  fs::create_symlink("other", file);
  EXPECT_THAT(Refusal<EnvironmentError>(), HasSubstr(file.string()));
  EXPECT_EQ(ReadFile(folder_ / "other"), "");
  fs::remove(file);
  fs::create_directory(file);
  EXPECT_THAT(Refusal<EnvironmentError>(), HasSubstr(file.string()));
  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_THAT(Refusal<InputError>(), HasSubstr("cannot overwrite"));
  EXPECT_TRUE(fs::is_fifo(file));
}

TEST_F(LockedOutputFolderTest, AFolderThatCannotBeMadeIsNamed) {
  WriteFile(folder_ / "file", "");
  EXPECT_THROW(LockedOutputFolder(folder_ / "file" / "out", kAtOnce), EnvironmentError);
  EXPECT_THROW(LockedOutputFolder(folder_ / "file", kAtOnce), EnvironmentError);
  fs::create_symlink("nowhere", folder_ / "link");
  EXPECT_THROW(LockedOutputFolder(folder_ / "link", kAtOnce), EnvironmentError);
}

}  // namespace locked_output_folder_test
}  // namespace regrasp::apps
