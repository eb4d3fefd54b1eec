#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace regrasp::mujoco {

/// Files that MuJoCo finds in memory before it looks for them on the disk, by the last part of
/// their paths. An empty store is 2 MB that the engine clears: keep one where models are made
/// often.
class MemoryFiles {
 public:
  MemoryFiles();
  ~MemoryFiles();
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;

  /// @throws std::runtime_error  there are too many, or one of this name.
  void Add(const std::string& name, const std::string& bytes);
  /// The same in place of one of this name.
  void Replace(const std::string& name, const std::string& bytes);
  [[nodiscard]] const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_;
};

}  // namespace regrasp::mujoco
