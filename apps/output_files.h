#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace regrasp::apps {

/// A file that the command line names, and the option that does.
struct NamedFile {
  std::string option;
  std::filesystem::path path;
};

/// A folder that results go into, among other files perhaps.
struct OutputFolder {
  std::string option;
  std::filesystem::path path;
  /// Whether the program may write or remove a file of this name in it.
  std::function<bool(const std::string&)> takes;
};

/// All that a program may write or remove.
struct OutputFiles {
  std::vector<NamedFile> files;
  std::vector<OutputFolder> folders;

  /// Adds a file where the option is given.
  void Add(const std::string& option, const std::string& path);
};

/// Makes sure that no output is an input and no two outputs are the same file: same device and
/// inode, so by whatever path, link or hard link; of files that do not exist yet the same path
/// after links. In a folder every file that it `takes` counts. What is no regular file (/dev/null,
/// a pipe) may be named as often as one likes. Reads the folders once; inputs and folders may be
/// thousands, as those of a batch are. To be called before anything is written or removed.
/// @param inputs  those that do not exist, or are folders, do not count.
/// @throws InputError  names the file and both options.
void CheckOutputsDiffer(const std::vector<NamedFile>& inputs, const OutputFiles& outputs);

/// Makes sure that every output could be written now, so that nobody waits for results that are
/// then lost. Leaves nothing behind. The folder of a file may be one that the program will make.
/// @throws EnvironmentError  names the one that cannot.
void CheckOutputsWritable(const OutputFiles& outputs);

/// A path as CI servers look for it: from the folder that the program runs in, which is the job's
/// (GitLab's CI_PROJECT_DIR, Jenkins' workspace), or absolute where it does not lead below it.
[[nodiscard]] std::filesystem::path PathForCi(const std::filesystem::path& path);

/// The bytes of a file that the program has written itself.
/// @throws EnvironmentError  it is gone, or cannot be read any more: that is no bad input.
[[nodiscard]] std::string ReadOutput(const std::filesystem::path& path);

}  // namespace regrasp::apps
