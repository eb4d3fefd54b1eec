#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/batch/line_input.h"
#include "apps/batch/object_shelf.h"
#include "planner/base/file.h"

namespace regrasp::apps {

/// A SHA-256 over named values: all that a result depends on.
///
/// Different values give different digests: names and values are preceded by their lengths, and a
/// value that is absent differs from every value, also from an empty one. Values are raw bytes; the
/// text of a command line is taken as it was typed, because a program may treat any two texts
/// differently.
class InputsDigest {
 public:
  using Options = std::vector<std::pair<std::string, std::vector<std::string>>>;

  InputsDigest& Add(std::string_view name, std::string_view value);
  InputsDigest& AddAbsent(std::string_view name);
  /// @param options  names with their values, in order.
  InputsDigest& Add(std::string_view name, const Options& options);
  /// Return the digest, 64 hexadecimal digits. To be called once, at the end.
  [[nodiscard]] std::string Finish() { return sum_.Finish(); }

 private:
  void AddText(std::string_view text);

  Sha256Sum sum_;
};

/// What a line says of its object.
struct ObjectOfLine {
  std::string name;         ///< of the file; empty if --object is a file
  std::string sha256 = {};  ///< that the line expects; empty: any
  std::string repair = {};  ///< digest of the module that repairs the object; empty: no repair
};

/// Return the digest of all that the result of a line depends on: what the run has in common, the
/// number of the entry, the bytes of the line, and name and bytes of the object's file that
/// `finder` finds now.
/// @param common  digest of the options, the program's build and all files that every line uses.
/// @param object  what the line says of its object; none: it cannot be read, or has no object.
[[nodiscard]] std::string EntryDigest(const std::string& common, const Line& line,
                                      const std::optional<ObjectOfLine>& object,
                                      ObjectFinder& finder);

}  // namespace regrasp::apps
