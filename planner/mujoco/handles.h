#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace regrasp::mujoco {

/// Owners of a model and of a state of MuJoCo.
struct DeleteModel {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
  void operator()(mjData* data) const { mj_deleteData(data); }
};
using ModelPtr = std::unique_ptr<mjModel, DeleteModel>;
using DataPtr = std::unique_ptr<mjData, DeleteData>;

/// Files in memory that MuJoCo reads instead of files on the disk whose paths have the same last
/// part. An empty store is 2 MB that the engine clears: keep one if you make many models.
class MemoryFiles {
 public:
  MemoryFiles();
  ~MemoryFiles();
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;

  /// Add a file.
  /// @throws std::runtime_error  if there are too many files, or one of this name.
  void Add(const std::string& name, const std::string& bytes);
  /// Add a file, in place of the file of this name if there is one.
  void Replace(const std::string& name, const std::string& bytes);
  [[nodiscard]] const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_;
};

}  // namespace regrasp::mujoco
