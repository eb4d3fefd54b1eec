#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp {
namespace write_file_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Test with a folder of its own, which is removed afterwards.
class WriteFileTest : public ::testing::Test {
 protected:
  WriteFileTest()
      : folder_(fs::path(::testing::TempDir()) /
                ("regrasp_write_file_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~WriteFileTest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  [[nodiscard]] std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  fs::path folder_;
};

struct stat StatusOf(const fs::path& path) {
  struct stat status = {};
  EXPECT_EQ(lstat(path.c_str(), &status), 0) << path;
  return status;
}

mode_t ModeOf(const fs::path& path) { return StatusOf(path).st_mode & 07777; }

std::string WhyNot(const std::function<void()>& call) {
  try {
    call();
  } catch (const EnvironmentError& error) {
    return error.what();
  }
  return "no error";
}

/// Return the error of CheckWritable and WriteFile, which must be equal.
std::string WhyNotWritten(const fs::path& path) {
  const std::string before = WhyNot([&] { CheckWritable(path); });
  EXPECT_EQ(before, WhyNot([&] { WriteFile(path, "x"); }));
  return before;
}

std::string ReadSome(int descriptor) {
  std::array<char, 100> bytes;
  const ssize_t count = read(descriptor, bytes.data(), bytes.size());
  return {bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

TEST_F(WriteFileTest, BytesComeBackAsWritten) {
  std::string bytes;
  for (int i = 0; i < 200000; ++i) bytes += static_cast<char>(i * 7);
  const fs::path path = folder_ / "bytes";
  for (const std::string& written : {bytes, std::string(), std::string("x\0\r\n", 4)}) {
    for (const Durability durability : {Durability::kSynced, Durability::kCached}) {
      WriteFile(path, written, durability);
      EXPECT_EQ(ReadFile(path), written);
    }
  }
  EXPECT_THAT(Names(), ElementsAre("bytes"));
}

TEST_F(WriteFileTest, WhatCannotBeWrittenIsAFailureOfTheEnvironment) {
  EXPECT_THAT(WhyNotWritten(folder_ / "missing" / "file"), HasSubstr("cannot be written"));
  EXPECT_THAT(WhyNotWritten(folder_), HasSubstr("Is a directory"));
  EXPECT_THAT(WhyNotWritten(folder_ / "missing" / ""), HasSubstr("cannot be written"));
  EXPECT_THAT(WhyNotWritten(""), HasSubstr("cannot be written"));
  std::ofstream(folder_ / "file");
  EXPECT_THAT(WhyNotWritten(folder_ / "file" / "x"), HasSubstr("Not a directory"));
  EXPECT_THAT(WhyNotWritten("/proc/regrasp"), HasSubstr("cannot be written"));
  EXPECT_THAT(WhyNotWritten(folder_ / std::string(NAME_MAX + 1, 'x')), HasSubstr("too long"));
  EXPECT_THAT(Names(), ElementsAre("file"));
  fs::create_directories(folder_ / "occupied" / "inside");
  EXPECT_THAT(WhyNotWritten(folder_ / "occupied"), HasSubstr("Is a directory"));
  fs::create_symlink("loop", folder_ / "loop");
  EXPECT_THAT(WhyNotWritten(folder_ / "loop"), HasSubstr("Too many levels of symbolic links"));
  EXPECT_THAT(Names(), ElementsAre("file", "loop", "occupied"));
}

TEST_F(WriteFileTest, TheLongestNameCanBeWritten) {
  const std::string name(NAME_MAX, 'x');
  WriteFile(folder_ / name, "text");
  EXPECT_THAT(Names(), ElementsAre(name));
}

TEST_F(WriteFileTest, AFullDiskIsAFailureAndLeavesTheOldFile) {
  // A limit of the file size simulates a full disk.
  const fs::path path = folder_ / "kept";
  WriteFile(path, "old");
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small = {1000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string why = WhyNot([&] { WriteFile(path, std::string(5000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(why, HasSubstr("kept: cannot be written: File too large"));
  EXPECT_EQ(ReadFile(path), "old");
  EXPECT_THAT(Names(), ElementsAre("kept"));
}

TEST_F(WriteFileTest, AReaderNeverSeesHalfAFile) {
  const fs::path path = folder_ / "whole";
  const std::string a(3'000'000, 'a'), b(2'000'000, 'b');
  WriteFile(path, a);
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int i = 0; i < 40; ++i) WriteFile(path, i % 2 == 0 ? b : a, Durability::kCached);
    done = true;
  });
  int reads = 0;
  do {
    const std::string seen = ReadFile(path);
    EXPECT_TRUE(seen == a || seen == b) << seen.size() << " bytes";
    ++reads;
  } while (!done);
  writer.join();
  EXPECT_GT(reads, 0);
  EXPECT_THAT(Names(), ElementsAre("whole"));
}

TEST_F(WriteFileTest, ModeAndOwnerOfAReplacedFileStay) {
  const fs::path path = folder_ / "file";
  for (const mode_t mode : {0600, 0640, 0666, 0755}) {
    std::ofstream(path) << "old";
    chmod(path.c_str(), mode);
    if (geteuid() == 0) {
      EXPECT_EQ(chown(path.c_str(), 1234, 5678), 0);
    }
    const struct stat before = StatusOf(path);
    WriteFile(path, "new");
    const struct stat after = StatusOf(path);
    EXPECT_EQ(ReadFile(path), "new");
    EXPECT_EQ(after.st_mode, before.st_mode);
    EXPECT_EQ(after.st_uid, before.st_uid);
    EXPECT_EQ(after.st_gid, before.st_gid);
    EXPECT_NE(after.st_ino, before.st_ino) << "written over";
  }
}

TEST_F(WriteFileTest, TheModeOfANewFileFollowsTheMask) {
  for (const mode_t mask : {0022, 0077, 0002}) {
    const mode_t before = umask(mask);
    WriteFile(folder_ / std::to_string(mask), "");
    umask(before);
    EXPECT_EQ(ModeOf(folder_ / std::to_string(mask)), 0666 & ~mask);
  }
}

TEST_F(WriteFileTest, AWriteProtectedFileStays) {
  const fs::path path = folder_ / "protected";
  std::ofstream(path) << "old";
  chmod(path.c_str(), 0444);
  // Root can write whatever the mode is.
  const bool root = geteuid() == 0;
  if (root) {
    EXPECT_EQ(chown(folder_.c_str(), 1234, 1234), 0);
    ASSERT_EQ(seteuid(1234), 0);
  }
  const std::string why = WhyNotWritten(path);
  if (root) {
    ASSERT_EQ(seteuid(0), 0);
  }
  EXPECT_THAT(why, HasSubstr("protected: cannot be written: Permission denied"));
  EXPECT_EQ(ReadFile(path), "old");
}

TEST_F(WriteFileTest, LinksAreFollowed) {
  fs::create_directory(folder_ / "far");
  std::ofstream(folder_ / "far" / "file") << "old";
  fs::create_symlink("far/file", folder_ / "relative");
  fs::create_symlink(folder_ / "relative", folder_ / "twice");
  fs::create_symlink("far/new", folder_ / "dangling");
  for (const char* name : {"relative", "twice", "dangling"}) {
    CheckWritable(folder_ / name);
    WriteFile(folder_ / name, name);
    EXPECT_TRUE(fs::is_symlink(folder_ / name)) << name;
    EXPECT_EQ(ReadFile(folder_ / name), name);
  }
  EXPECT_EQ(ReadFile(folder_ / "far" / "file"), "twice");
  EXPECT_EQ(ReadFile(folder_ / "far" / "new"), "dangling");
  EXPECT_EQ(EndOfLinks(folder_ / "dangling"), folder_ / "far" / "new");
  EXPECT_THAT(Names(), ElementsAre("dangling", "far", "relative", "twice"));
}

/// Create a device in the test's folder, so that a program that replaces its target cannot damage
/// the machine's devices.
/// @returns false if that is not permitted.
bool MakeDevice(const fs::path& path, int minor) {
  constexpr int kMemory = 1;
  if (mknod(path.c_str(), S_IFCHR | 0666, makedev(kMemory, minor)) != 0) return false;
  const int opened = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  close(opened);
  return opened >= 0;  // a file system can forbid devices
}

TEST_F(WriteFileTest, ADeviceIsWrittenToAndStays) {
  const fs::path null = folder_ / "null";
  const fs::path full = folder_ / "full";
  if (!MakeDevice(null, 3) || !MakeDevice(full, 7)) GTEST_SKIP() << "devices are not permitted";
  CheckWritable(null);
  WriteFile(null, "text");
  EXPECT_THAT(WhyNot([&] { WriteFile(full, "x"); }), HasSubstr("No space left"));
  EXPECT_TRUE(fs::is_character_file(null));
  EXPECT_TRUE(fs::is_character_file(full));
}

TEST_F(WriteFileTest, ADiskIsRefused) {
  const fs::path disk = folder_ / "disk";
  // No device has this number.
  if (mknod(disk.c_str(), S_IFBLK | 0666, makedev(0xfff, 0)) != 0) {
    GTEST_SKIP() << "devices are not permitted";
  }
  EXPECT_THAT(WhyNotWritten(disk), HasSubstr("cannot be written"));
  EXPECT_TRUE(fs::is_block_file(disk));
}

TEST_F(WriteFileTest, APipeWithANameIsWrittenTo) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  CheckWritable(pipe);
  EXPECT_EQ(ReadSome(reader), "");
  WriteFile(pipe, "text");
  EXPECT_EQ(ReadSome(reader), "text");
  close(reader);
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(WriteFileTest, ADescriptorsNameIsTheDescriptorAtItsPlace) {
  const fs::path path = folder_ / "log";
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(write(file, "head\n", 5), 5);
  const ino_t before = StatusOf(path).st_ino;
  const std::string name = "/dev/fd/" + std::to_string(file);
  fs::create_symlink(name, folder_ / "stdout");  // like /dev/stdout
  for (const fs::path& named : {fs::path(name), folder_ / "stdout"}) {
    CheckWritable(named);
    WriteFile(named, "text\n");
  }
  EXPECT_EQ(ReadFile(path), "head\ntext\ntext\n");
  EXPECT_EQ(StatusOf(path).st_ino, before);
  fs::remove(path);
  WriteFile(name, "more\n");
  EXPECT_EQ(lseek(file, 0, SEEK_SET), 0);
  EXPECT_EQ(ReadSome(file), "head\ntext\ntext\nmore\n");
  EXPECT_THAT(Names(), ElementsAre("stdout")) << "the removed file came back";
  close(file);
  EXPECT_THAT(WhyNotWritten(name), HasSubstr("Bad file descriptor"));
}

TEST_F(WriteFileTest, ADescriptorMayBeAPipeOrASocketButMustBeForWriting) {
  std::array<int, 2> ends;
  for (const bool socket : {false, true}) {
    ASSERT_EQ(socket ? socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) : pipe(ends.data()), 0);
    WriteFile("/dev/fd/" + std::to_string(ends[1]), "text");
    EXPECT_EQ(ReadSome(ends[0]), "text");
    if (!socket) {
      EXPECT_THAT(WhyNotWritten("/dev/fd/" + std::to_string(ends[0])),
                  HasSubstr("Bad file descriptor"));
    }
    close(ends[0]);
    close(ends[1]);
  }
}

TEST_F(WriteFileTest, APipeThatIsFullIsWaitedFor) {
  std::array<int, 2> ends;
  ASSERT_EQ(pipe2(ends.data(), O_NONBLOCK), 0);
  const std::string bytes(1'000'000, 'x');  // more than the capacity of a pipe
  std::thread writer([&] { WriteFile("/dev/fd/" + std::to_string(ends[1]), bytes); });
  std::size_t count = 0;
  while (count < bytes.size()) count += ReadSome(ends[0]).size();
  writer.join();
  EXPECT_EQ(count, bytes.size());
  close(ends[0]);
  close(ends[1]);
}

TEST_F(WriteFileTest, ALinkAtTheNameOfThisProcessIsNotFollowed) {
  const fs::path other = folder_ / "other";
  std::ofstream(other) << "other";
  fs::create_symlink(other, folder_ / ("file.tmp" + std::to_string(getpid())));
  WriteFile(folder_ / "file", "text");
  EXPECT_EQ(ReadFile(folder_ / "file"), "text");
  EXPECT_EQ(ReadFile(other), "other");
}

/// Watcher of file names that are created in a folder.
class Watch {
 public:
  explicit Watch(const fs::path& folder) : events_(inotify_init1(IN_CLOEXEC)) {
    EXPECT_GE(inotify_add_watch(events_, folder.c_str(), IN_CREATE), 0);
  }
  ~Watch() { close(events_); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  /// Wait for the next name.
  std::string Next() const {
    alignas(inotify_event) std::array<char, sizeof(inotify_event) + NAME_MAX + 1> buffer;
    const ssize_t count = read(events_, buffer.data(), buffer.size());
    EXPECT_GT(count, 0);
    return reinterpret_cast<const inotify_event*>(buffer.data())->name;
  }

 private:
  int events_;
};

TEST_F(WriteFileTest, NamesAsideAreNeverTheSameAndTellTheirFile) {
  const Watch watch(folder_);
  std::set<std::string> names;
  for (int i = 0; i < 10; ++i) {
    WriteFile(folder_ / "report.json", "", Durability::kCached);
    const std::string name = watch.Next();
    EXPECT_EQ(NameBesideAside(name), "report.json") << name;
    names.insert(name);
  }
  EXPECT_EQ(names.size(), 10u);
}

TEST_F(WriteFileTest, OnlyNamesAsideAreTakenForSuch) {
  EXPECT_EQ(NameBesideAside("a.tmp0123456789abcdef"), "a");
  EXPECT_EQ(NameBesideAside("a.tmp0123456789abcdef.tmp0123456789abcdef"), "a.tmp0123456789abcdef");
  for (const char* name :
       {"report.json", "report.json.tmp", "report.json.tmp123", "", ".tmp0123456789abcdef",
        "a.tmp0123456789abcdeF", "a.tmp0123456789abcdef0", "a.tmp123456789abcdef"}) {
    EXPECT_EQ(NameBesideAside(name), "") << name;
  }
}

TEST_F(WriteFileTest, AStoppedWriterLeavesAWholeFileAndNothingAside) {
  const fs::path path = folder_ / "file";
  const std::string bytes(2'000'000, 'x');
  for (const int stop : {SIGINT, SIGTERM, SIGHUP}) {
    for (int i = 0; i < 5; ++i) {
      const Watch watch(folder_);
      const pid_t writer = fork();
      ASSERT_GE(writer, 0);
      if (writer == 0) {
        while (true) WriteFile(path, bytes, Durability::kCached);
      }
      watch.Next();
      kill(writer, stop);
      int status = 0;
      ASSERT_EQ(waitpid(writer, &status, 0), writer);
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == stop);
      EXPECT_THAT(Names(), ElementsAre("file"));
      EXPECT_EQ(ReadFile(path), bytes);
    }
  }
}

TEST_F(WriteFileTest, ACheckLeavesEverythingAsItIs) {
  const fs::path path = folder_ / "file";
  CheckWritable(path);
  EXPECT_THAT(Names(), ElementsAre());
  std::ofstream(path) << "old";
  const struct stat before = StatusOf(path);
  CheckWritable(path);
  const struct stat after = StatusOf(path);
  EXPECT_EQ(ReadFile(path), "old");
  EXPECT_EQ(after.st_ino, before.st_ino);
  EXPECT_EQ(after.st_mtim.tv_nsec, before.st_mtim.tv_nsec);
  EXPECT_THAT(Names(), ElementsAre("file"));
}

}  // namespace write_file_test
}  // namespace regrasp
