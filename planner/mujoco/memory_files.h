#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace regrasp::mujoco {

/// Files in memory that MuJoCo finds before those on disk, by file name without folders.
/// An empty store is 2 MB that MuJoCo clears, so code that creates models often should reuse one.
class MemoryFiles {
 public:
  MemoryFiles();
  ~MemoryFiles();
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;

  /// Add a file.
  /// @throws std::runtime_error  if there are too many files, or there is one with this name.
  void Add(const std::string& name, const std::string& bytes);
  /// Add a file, or replace the file with this name.
  void Replace(const std::string& name, const std::string& bytes);
  [[nodiscard]] const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_;
};

}  // namespace regrasp::mujoco
