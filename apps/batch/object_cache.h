#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/batch/line_records.h"
#include "planner/base/file.h"
#include "planner/object/object.h"

namespace regrasp::apps {

using SharedObject = std::shared_ptr<const object::ObjectFile>;

/// Cache of the most recently used objects, keyed by their file and by how it is read.
/// Failures to read a file are cached as well, so that a thousand plans for the same object try
/// only once.
class ObjectCache {
 public:
  static constexpr std::size_t kMost = 32;

  /// @param key   key of the object's file and of how it is read.
  /// @param read  function that reads the object.
  /// @throws InputError  if `read` throws it, now or in an earlier call.
  [[nodiscard]] SharedObject Get(const std::string& key,
                                 const std::function<object::ObjectFile()>& read);

 private:
  struct Place {
    std::string key;
    SharedObject object;  ///< null if it could not be read
    std::string why;
  };
  std::list<Place> places_;  ///< cache entries, most recently used first
};

/// Finder of an object's file in a folder, by its digest.
class ObjectFinder {
 public:
  /// @param path  path of a folder, or of the file that contains the object of all lines.
  explicit ObjectFinder(std::string path);

  /// Return the path of an object file.
  /// It is the file with this name if its digest is the expected one, or if none is expected.
  /// Otherwise it is a file of the folder with this digest. If there is none, it is again the file
  /// with this name, and the reader reports the difference.
  /// @param name    file name, of which only the last component is used; not empty if a folder is
  ///     searched.
  /// @param sha256  expected digest; empty: any.
  /// @param where   place of the reference for messages: "queries.jsonl: line 3".
  /// @throws InputError  if the folder contains neither.
  [[nodiscard]] std::string Find(const std::string& name, const std::string& sha256,
                                 const std::string& where);

  [[nodiscard]] bool is_folder() const { return is_folder_; }

  /// Return the SHA-256 of a file, computed once.
  /// @throws InputError  if it cannot be read.
  [[nodiscard]] const std::string& DigestOf(const std::string& file);

 private:
  [[nodiscard]] std::string FindByDigest(const std::string& sha256);

  std::string path_;
  bool is_folder_;
  std::map<std::string, std::string> digests_;  ///< digests of the files read so far
};

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
