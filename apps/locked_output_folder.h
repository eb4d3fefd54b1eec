#pragma once

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "planner/base/file.h"

namespace regrasp::apps {

/// Name of the file whose lock restricts a folder to one process.
inline constexpr char kRunFileName[] = ".regrasp-run";

/// A locked output folder, into which only this process writes.
/// The lock lasts for the lifetime of this object. The folder is made if it does not exist, and
/// removed at the end if it is empty.
///
/// The lock is on the file kRunFileName in the folder. The file names the process that has the lock
/// and the files that it is about to write. The destructor removes the file. If a process is
/// killed, the file remains without the lock. The next process reads from it which files the killed
/// process wrote. Forked children share the lock, so the folder is free when the last of them has
/// ended.
class LockedOutputFolder {
 public:
  /// Waiting time for a locked folder.
  /// The children of a killed run take an instant to end.
  static constexpr std::chrono::milliseconds kPatience{1000};

  /// Lock a folder.
  /// @throws EnvironmentError  if another process has locked the folder (the message names it), or
  ///     the folder cannot be made or written.
  /// @throws InputError        if a file of the same name exists that regrasp did not write.
  explicit LockedOutputFolder(std::filesystem::path path,
                              std::chrono::milliseconds patience = kPatience);
  ~LockedOutputFolder();
  LockedOutputFolder(const LockedOutputFolder&) = delete;
  LockedOutputFolder& operator=(const LockedOutputFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Names of files that killed processes had announced in this folder.
  [[nodiscard]] const std::set<std::string>& left_behind() const { return left_behind_; }

  /// Announce files before they are written or removed.
  /// If this process is killed, the next one recognizes them as files of regrasp.
  /// @param names  file names without line breaks.
  /// @throws EnvironmentError  if the disk is full.
  void Announce(const std::vector<std::string>& names);

 private:
  /// Folders that were made for one path.
  /// The destructor removes those that are empty.
  class MadeFolders {
   public:
    explicit MadeFolders(const std::filesystem::path& folder);
    ~MadeFolders();
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;

   private:
    std::vector<std::filesystem::path> folders_;  ///< folders that were made, the innermost last
  };

  void Append(const std::string& lines);

  std::filesystem::path path_;
  MadeFolders made_;
  std::filesystem::path file_;
  Descriptor descriptor_;
  std::set<std::string> left_behind_;
};

}  // namespace regrasp::apps
