#include "planner/kinematics/mujoco_model.h"

#include <array>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/object/limited_child.h"

namespace regrasp::kinematics {
namespace {

namespace fs = std::filesystem;

constexpr object::ChildLimits kLimits = {.memory_bytes = std::size_t{4} << 30,
                                         .processor = std::chrono::seconds(120),
                                         .wall = std::chrono::seconds(120),
                                         .opens_files = true};
constexpr const char* kBinaryName = "hand.mjb";

/// Called by MuJoCo where it would otherwise end the process.
[[noreturn]] void ThrowError(const char* message) { throw std::runtime_error(message); }
void IgnoreWarning(const char* /*message*/) {}

/// "Error: mass must be positive" of several lines, as one.
std::string OneLine(std::string text) {
  std::string line;
  for (const char c : text) {
    const bool space = c == '\n' || c == '\r' || c == ' ';
    if (!space) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::string CompileToBytes(const fs::path& path) {
  mju_user_error = ThrowError;
  mju_user_warning = IgnoreWarning;
  std::array<char, 1000> error{};
  const ModelPtr model(
      mj_loadXML(path.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  if (!model) throw std::runtime_error(error.data());
  std::string bytes(static_cast<std::size_t>(mj_sizeModel(model.get())), '\0');
  mj_saveModel(model.get(), nullptr, bytes.data(), static_cast<int>(bytes.size()));
  return bytes;
}

ModelPtr FromBytes(const std::string& bytes) {
  struct DeleteVfs {
    void operator()(mjVFS* vfs) const {
      mj_deleteVFS(vfs);
      delete vfs;
    }
  };
  const std::unique_ptr<mjVFS, DeleteVfs> vfs([] {
    auto* fresh = new mjVFS;
    mj_defaultVFS(fresh);
    return fresh;
  }());
  mj_makeEmptyFileVFS(vfs.get(), kBinaryName, static_cast<int>(bytes.size()));
  std::memcpy(vfs->filedata[mj_findFileVFS(vfs.get(), kBinaryName)], bytes.data(), bytes.size());
  return ModelPtr(mj_loadModel(kBinaryName, vfs.get()));
}

}  // namespace

ModelPtr CompileModel(const fs::path& path) {
  // A file that cannot be read is said in our words.
  (void)ReadFile(path);
  const object::ChildResult result =
      object::RunInLimitedChild([&path] { return CompileToBytes(path); }, kLimits);
  switch (result.end) {
    case object::ChildEnd::kDone:
      break;
    case object::ChildEnd::kThrew:
      throw InputError(path.string() +
                       ": MuJoCo does not take the model: " + OneLine(result.bytes));
    case object::ChildEnd::kTookTooLong:
      throw InputError(path.string() + ": MuJoCo takes longer than two minutes to read the model");
    case object::ChildEnd::kCrashed:
      throw InputError(path.string() + ": MuJoCo crashes on the model, or needs more than 4 GiB");
  }
  ModelPtr model = FromBytes(result.bytes);
  if (!model) throw EnvironmentError("MuJoCo cannot read back a model that it compiled");
  return model;
}

DataPtr AtRest(const mjModel& model) {
  DataPtr data(mj_makeData(&model));
  if (!data) throw EnvironmentError("MuJoCo cannot make the data of a hand's model");
  mj_kinematics(&model, data.get());
  return data;
}

}  // namespace regrasp::kinematics
