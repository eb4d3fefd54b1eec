#pragma once

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "planner/base/file.h"

namespace regrasp::apps {

/// The file by which a process holds a folder.
inline constexpr char kRunFileName[] = ".regrasp-run";

/// A folder of results that this process alone writes into while this lives. It is made where it
/// is missing, and goes again where nothing was put into it.
///
/// The folder is held by a lock on a file in it, kRunFileName, which says who holds it and which
/// files it is about to write. The file goes with this object. A process that is killed leaves it,
/// but not its lock; the next one learns from it what was left behind. Forked children hold the
/// lock too, so that a folder is free only when the last of them is gone.
class HeldFolder {
 public:
  /// How long a folder is waited for: the children of a run that was killed take an instant to go.
  static constexpr std::chrono::milliseconds kPatience{1000};

  /// @throws EnvironmentError  another process holds the folder, which it names; or the folder
  ///                           cannot be made or written.
  /// @throws InputError        something that is not ours bears the file's name.
  explicit HeldFolder(std::filesystem::path path, std::chrono::milliseconds patience = kPatience);
  ~HeldFolder();
  HeldFolder(const HeldFolder&) = delete;
  HeldFolder& operator=(const HeldFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// The names of files that processes have announced which were killed here.
  [[nodiscard]] const std::set<std::string>& left_behind() const { return left_behind_; }

  /// To be called before files are written or removed: should this process be killed, the next one
  /// knows them for its own.
  /// @param names  without line breaks.
  /// @throws EnvironmentError  the disk is full.
  void Announce(const std::vector<std::string>& names);

 private:
  /// The folders that were made to make one; those that are still empty at the end go.
  class MadeFolders {
   public:
    explicit MadeFolders(const std::filesystem::path& folder);
    ~MadeFolders();
    MadeFolders(const MadeFolders&) = delete;
    MadeFolders& operator=(const MadeFolders&) = delete;

   private:
    std::vector<std::filesystem::path> folders_;  ///< the innermost last
  };

  void Append(const std::string& lines);

  std::filesystem::path path_;
  MadeFolders made_;
  std::filesystem::path file_;
  Descriptor descriptor_;
  std::set<std::string> left_behind_;
};

}  // namespace regrasp::apps
