#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>

#include "planner/object/object.h"

namespace regrasp::apps {

using SharedObject = std::shared_ptr<const object::ObjectFile>;

/// Objects that stay loaded while they are asked for: the last few, by what each was read from and
/// how. What cannot be read is remembered as well, so that a thousand plans for it try once.
class ObjectShelf {
 public:
  static constexpr std::size_t kMost = 32;

  /// @param key   tells the object and how it is read.
  /// @param read  reads it.
  /// @throws InputError  `read` did, now or earlier.
  [[nodiscard]] SharedObject Get(const std::string& key,
                                 const std::function<object::ObjectFile()>& read);

 private:
  struct Place {
    std::string key;
    SharedObject object;  ///< none where it could not be read
    std::string why;
  };
  std::list<Place> places_;  ///< the last that was asked for first
};

/// Finds the file of an object in a folder, by its digest.
class ObjectFinder {
 public:
  /// @param path  of a folder, or of the one file that all objects are.
  explicit ObjectFinder(std::string path);

  /// The file of that name, where its digest is the right one or none is given; otherwise one of
  /// the folder that has the digest, or else the file of that name all the same, for the reader to
  /// say what is wrong.
  /// @param name    of which only the last part counts; in a folder not empty.
  /// @param sha256  empty: any.
  /// @param where   says it: "queries.jsonl: line 3".
  /// @throws InputError  the folder has neither.
  [[nodiscard]] std::string Find(const std::string& name, const std::string& sha256,
                                 const std::string& where);

  [[nodiscard]] bool is_folder() const { return is_folder_; }

  /// Return the SHA-256 of a file, computed once.
  /// @throws InputError  it cannot be read.
  [[nodiscard]] const std::string& DigestOf(const std::string& file);

 private:
  [[nodiscard]] std::string FindByDigest(const std::string& sha256);

  std::string path_;
  bool is_folder_;
  std::map<std::string, std::string> digests_;  ///< of files that were looked at
};

}  // namespace regrasp::apps
