#include "planner/mujoco/handles.h"

#include <cstring>
#include <stdexcept>

namespace regrasp::mujoco {

MemoryFiles::MemoryFiles() : files_(std::make_unique<mjVFS>()) { mj_defaultVFS(files_.get()); }

MemoryFiles::~MemoryFiles() { mj_deleteVFS(files_.get()); }

void MemoryFiles::Add(const std::string& name, const std::string& bytes) {
  if (mj_makeEmptyFileVFS(files_.get(), name.c_str(), static_cast<int>(bytes.size())) != 0) {
    throw std::runtime_error("too many files, or two of the name " + name);
  }
  std::memcpy(files_->filedata[mj_findFileVFS(files_.get(), name.c_str())], bytes.data(),
              bytes.size());
}

void MemoryFiles::Replace(const std::string& name, const std::string& bytes) {
  mj_deleteFileVFS(files_.get(), name.c_str());
  Add(name, bytes);
}

}  // namespace regrasp::mujoco
