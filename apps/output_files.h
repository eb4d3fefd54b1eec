#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/plan/plan.h"

namespace regrasp::apps {

/// A file of the command line and the option that names it.
struct NamedFile {
  std::string option;
  std::filesystem::path path;
};

/// A folder for results, which may also have other files.
struct OutputFolder {
  std::string option;
  std::filesystem::path path;
  /// Function that returns whether the program may write or remove a file.
  std::function<bool(const std::string&)> takes;
};

/// All files that a program may write or remove.
struct OutputFiles {
  std::vector<NamedFile> files;
  std::vector<OutputFolder> folders;

  /// Add a file if the option is given.
  void Add(const std::string& option, const std::string& path);
};

/// Check that no output is an input, and that no two outputs are the same file.
/// An output must not be named - either. An option that supports standard output does not add it.
/// Existing files are the same if device and inode are equal, for any path, link or hard link.
/// Files that do not exist yet are the same if their paths are equal after links are resolved. In a
/// folder, every file that it `takes` counts. Files that are not regular (/dev/null, a pipe) may be
/// named any number of times.
///
/// The folders are read once, because a batch may have thousands of inputs and folders. Call this
/// function before anything is written or removed.
/// @param inputs  files to read. Folders and files that do not exist are ignored. The model and the
///     meshes of the hand file of `--hand` are inputs too.
/// @throws InputError  if two files are the same; the message names the file and both options. Also
///     if an output is named -; the message names the option.
void CheckOutputsDiffer(const std::vector<NamedFile>& inputs, const OutputFiles& outputs);

/// Check that every output can be written, before the work begins.
/// The check leaves no files. The folder of a file may be one that the program will make.
/// @throws EnvironmentError  if one cannot be written; the message names it.
void CheckOutputsWritable(const OutputFiles& outputs);

/// Return whether a file name has the suffix .html or .htm, in any case.
[[nodiscard]] bool IsHtmlFile(const std::string& file);

/// Return a path in the form that CI servers search for.
/// It is relative to the working directory, which is the job's folder (GitLab's CI_PROJECT_DIR,
/// Jenkins' workspace). It is absolute if the path is outside that folder.
[[nodiscard]] std::filesystem::path PathForCi(const std::filesystem::path& path);

/// Return the bytes of a file that the program itself has written.
/// @throws EnvironmentError  if it was removed or cannot be read. This is not an input error.
[[nodiscard]] std::string ReadOutput(const std::filesystem::path& path);

/// Return the number of a plan's entry for file names.
/// It has at least three digits, so that names sort.
[[nodiscard]] std::string EntryNumber(plan::EntryIndex index);

/// Return the part of a name after its leading entry number.
/// nullopt if the name does not start with one.
[[nodiscard]] std::optional<std::string> AfterEntryNumber(const std::string& name);

/// Return the name of an entry's image: "000_hold.png", "001_switch.png".
/// @param ending  file name extension: "png".
[[nodiscard]] std::string EntryFileName(plan::EntryIndex index, const std::string& kind,
                                        const std::string& ending);

/// Return whether EntryFileName returns this name for any entry.
[[nodiscard]] bool IsEntryFileName(const std::string& name, const std::string& ending);

}  // namespace regrasp::apps
