#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/batch/line_input.h"
#include "apps/batch/object_cache.h"
#include "planner/base/file.h"

namespace regrasp::apps {

/// SHA-256 over named values: all inputs of a result.
///
/// Different values give different digests: names and values are preceded by their lengths, and an
/// absent value differs from every value, including the empty one. Values are raw bytes.
/// Command-line texts are added as typed, because a program may treat any two texts differently.
class InputsDigest {
 public:
  using Options = std::vector<std::pair<std::string, std::vector<std::string>>>;

  InputsDigest& Add(std::string_view name, std::string_view value);
  InputsDigest& AddAbsent(std::string_view name);
  /// @param options  names with their values, in order.
  InputsDigest& Add(std::string_view name, const Options& options);
  /// Return the digest as 64 hexadecimal digits. May be called only once, after all additions.
  [[nodiscard]] std::string Finish() { return sum_.Finish(); }

 private:
  void AddText(std::string_view text);

  Sha256Sum sum_;
};

/// Object reference of a line.
struct ObjectOfLine {
  std::string name;         ///< name of the object file; empty if --object is a file
  std::string sha256 = {};  ///< expected SHA-256; empty: any
  std::string repair = {};  ///< digest of the module that repairs the object; empty: no repair
};

/// Return the digest of all inputs of a line's result.
/// These are the common inputs of the run, the number of the entry, the bytes of the line, and the
/// name and bytes of the object file that `finder` finds now.
/// @param common  digest of the options, of the program's build, and of all files that every line
///     uses.
/// @param object  object reference of the line; nullopt if it cannot be read or has no object.
[[nodiscard]] std::string EntryDigest(const std::string& common, const Line& line,
                                      const std::optional<ObjectOfLine>& object,
                                      ObjectFinder& finder);

}  // namespace regrasp::apps
