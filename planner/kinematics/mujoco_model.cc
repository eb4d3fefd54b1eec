#include "planner/kinematics/mujoco_model.h"

#include <mujoco/mujoco.h>
#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/text_table.h"
#include "planner/kinematics/model_text.h"
#include "planner/mujoco/handles.h"
#include "planner/object/limited_child.h"

namespace regrasp::kinematics {

namespace {

constexpr std::size_t kIndent = 3;
/// Column that separates elements from attributes: names of elements begin left of it.
constexpr std::size_t kAttributeColumn = 30;

std::string PrintedSchema() {
  std::string text(1 << 18, '\0');
  const int size = mj_printSchema(nullptr, text.data(), static_cast<int>(text.size()), 0, 0);
  if (size <= 0 || static_cast<std::size_t>(size) >= text.size()) {
    throw std::logic_error("MuJoCo does not print its schema");
  }
  text.resize(static_cast<std::size_t>(size));
  return text;
}

/// Parse the printed schema.
/// Lines are "   name (type)    attribute attribute …", with deeper indentation for children. Lines
/// that begin in the column of the attributes continue the previous element.
SchemaElement Parse(const std::string& text) {
  SchemaElement root;
  std::vector<SchemaElement*> open;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t start = line.find_first_not_of(' ');
    if (start == std::string::npos) continue;
    std::istringstream words(line);
    if (start < kAttributeColumn) {
      std::string name;
      std::string type;
      words >> name >> type;
      if (name == "(world)body") name = "body";
      open.resize(std::min(open.size(), start / kIndent));
      SchemaElement& element = open.empty() ? root : open.back()->children[name];
      element.recursive = type == "(R)";
      open.push_back(&element);
    }
    if (open.empty()) throw std::logic_error("the schema of MuJoCo has another format");
    for (std::string attribute; words >> attribute;) open.back()->attributes.insert(attribute);
  }
  return root;
}

}  // namespace

const SchemaElement* SchemaElement::Child(const std::string& parent,
                                          const std::string& child) const {
  // The schema lists worldbody as body.
  const std::string known = child == "worldbody" ? "body" : child;
  const std::string self = parent == "worldbody" ? "body" : parent;
  if (recursive && known == self) return this;
  const auto found = children.find(known);
  return found == children.end() ? nullptr : &found->second;
}

const SchemaElement& MujocoSchema() {
  static const SchemaElement kSchema = Parse(PrintedSchema());
  return kSchema;
}

namespace {

namespace fs = std::filesystem;

constexpr object::ChildLimits kLimits = {.memory_bytes = std::size_t{4} << 30,
                                         .processor = std::chrono::seconds(120),
                                         .wall = std::chrono::seconds(120),
                                         .opens_files = true};
constexpr const char* kBinaryName = "hand.mjb";

/// Error handler of MuJoCo, whose default ends the process.
[[noreturn]] void ThrowError(const char* message) { throw std::runtime_error(message); }
void IgnoreWarning(const char* /*message*/) {}

/// Return whether MuJoCo would not read the whole mesh, and would find its joined file.
/// MuJoCo finds files in memory by their names without folders.
bool IsJoined(const MeshFile& mesh, const ModelText& text) {
  const auto has_its_name = [&](const MeshFile& other) {
    return other.path.filename() == mesh.path.filename();
  };
  return std::ranges::count_if(text.meshes, has_its_name) == 1 && fs::exists(mesh.path) &&
         ReadMeshFile(mesh.path) != ReadFile(mesh.path);
}

ModelPtr Load(const fs::path& path, const ModelText& text) {
  mju_user_error = ThrowError;
  mju_user_warning = IgnoreWarning;
  mujoco::MemoryFiles files;
  // The model's own name makes MuJoCo search for meshes in its folder.
  files.Add(path.filename().string(), FormatXml(text.root));
  for (const MeshFile& mesh : text.meshes) {
    if (!mesh.alias.empty()) {
      files.Add(mesh.alias, ReadMeshFile(mesh.path));
    } else if (IsJoined(mesh, text)) {
      files.Add(mesh.path.filename().string(), ReadMeshFile(mesh.path));
    }
  }
  std::array<char, 1000> error{};
  ModelPtr model(
      mj_loadXML(path.c_str(), files.get(), error.data(), static_cast<int>(error.size())));
  if (!model) throw std::runtime_error(error.data());
  return model;
}

/// Return the model that was loaded last as MJCF.
std::string SaveMjcf(const ModelPtr& model) {
  // MuJoCo can write to files only.
  const std::string name = "/proc/self/fd/" + std::to_string(memfd_create("mjcf", 0));
  std::array<char, 1000> error{};
  if (mj_saveLastXML(name.c_str(), model.get(), error.data(), static_cast<int>(error.size())) ==
      0) {
    throw std::runtime_error(error.data());
  }
  return ReadFile(name);
}

std::string BytesOf(const ModelPtr& model) {
  std::string bytes(static_cast<std::size_t>(mj_sizeModel(model.get())), '\0');
  mj_saveModel(model.get(), nullptr, bytes.data(), static_cast<int>(bytes.size()));
  return bytes;
}

ModelPtr FromBytes(const std::string& bytes) {
  mujoco::MemoryFiles files;
  files.Add(kBinaryName, bytes);
  ModelPtr model(mj_loadModel(kBinaryName, files.get()));
  if (!model) throw EnvironmentError("MuJoCo cannot read back a model that it compiled");
  return model;
}

/// Run a task with a model in a limited child process.
/// @throws std::runtime_error  if MuJoCo rejects the model; with its message.
std::string InChild(const std::function<std::string()>& task) {
  const object::ChildResult result = object::RunInLimitedChild(task, kLimits);
  switch (result.end) {
    case object::ChildEnd::kDone:
      return result.bytes;
    case object::ChildEnd::kThrew:
      throw std::runtime_error(OneLine(result.bytes));
    case object::ChildEnd::kTookTooLong:
      throw std::runtime_error("reading the model takes longer than 2 minutes");
    case object::ChildEnd::kCrashed:
      throw std::runtime_error("reading the model crashes or requires more than 4 GiB");
  }
  throw std::logic_error("CompileModel: a child's end");
}

/// Compile a model in a limited child process.
/// @throws std::runtime_error  if MuJoCo rejects the model; with its message.
ModelPtr Compile(const fs::path& path, const ModelText& text) {
  return FromBytes(InChild([&] { return BytesOf(Load(path, text)); }));
}

bool IsUrdf(const ModelText& text) { return text.root.name == "robot"; }

/// Set the model of the text, and the conversion of a URDF.
/// MuJoCo reads the meshes once for both, because they are most of the time.
/// @throws std::runtime_error  as Compile.
void Compile(const fs::path& path, CompiledModel& compiled) {
  const ModelText& text = compiled.text;
  if (!IsUrdf(text)) {
    compiled.model = Compile(path, text);
    return;
  }
  const std::string both = InChild([&] {
    const ModelPtr model = Load(path, text);
    return SaveMjcf(model) + '\0' + BytesOf(model);
  });
  const std::size_t end = both.find('\0');
  compiled.mjcf = ParseXml(both.substr(0, end), path.string());
  compiled.model = FromBytes(both.substr(end + 1));
}

InputError Refused(const fs::path& path, const std::runtime_error& error) {
  return InputError(path.string() + ": rejected by MuJoCo: " + error.what());
}

/// Compute dampings as newer MuJoCo versions do: the ratio times the critical damping of the
/// inertia that an actuator moves in the reference configuration.
std::vector<double> DampingsOf(const mjModel& model, const std::vector<DampingRatio>& ratios) {
  const DataPtr data(mj_makeData(&model));
  if (!data) throw EnvironmentError("MuJoCo cannot allocate the data of the hand's model");
  mj_kinematics(&model, data.get());
  mj_comPos(&model, data.get());
  mj_tendon(&model, data.get());
  mj_transmission(&model, data.get());
  std::vector<double> dampings;
  for (const DampingRatio& wanted : ratios) {
    double inertia = 0;
    for (int dof = 0; dof < model.nv; ++dof) {
      const double moment = data->actuator_moment[wanted.actuator * model.nv + dof];
      if (std::abs(moment) > mjMINVAL) inertia += model.dof_M0[dof] / (moment * moment);
    }
    const double stiffness = model.actuator_gainprm[wanted.actuator * mjNGAIN];
    dampings.push_back(2 * wanted.ratio * std::sqrt(stiffness * inertia));
  }
  return dampings;
}

}  // namespace

CompiledModel CompileModel(const fs::path& path) {
  CompiledModel compiled{nullptr, ReadModelText(path), {}};
  ModelText& text = compiled.text;
  try {
    try {
      Compile(path, compiled);
    } catch (const std::runtime_error& error) {
      // MuJoCo's requirements on meshes are stricter than visual geoms need.
      if (!IsUrdf(text)) throw;
      DiscardVisuals(error.what(), text);
      Compile(path, compiled);
    }
    if (!text.damping_ratios.empty()) {
      SetDampings(DampingsOf(*compiled.model, text.damping_ratios), text);
      compiled.model = Compile(path, text);
    }
  } catch (const EnvironmentError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw Refused(path, error);
  }
  return compiled;
}

ModelText MjcfOf(const CompiledModel& compiled) {
  ModelText text = compiled.text;
  if (IsUrdf(text)) text.root = compiled.mjcf;
  return text;
}

ModelPtr CompileText(const fs::path& path, const ModelText& text) {
  try {
    return Compile(path, text);
  } catch (const EnvironmentError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw Refused(path, error);
  }
}

ModelText AsMjcf(const fs::path& path, const ModelText& text) {
  try {
    ModelText mjcf = text;
    mjcf.root = ParseXml(InChild([&] { return SaveMjcf(Load(path, text)); }), path.string());
    return mjcf;
  } catch (const EnvironmentError&) {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw Refused(path, error);
  }
}

DataPtr AtRest(const mjModel& model) {
  DataPtr data(mj_makeData(&model));
  if (!data) throw EnvironmentError("MuJoCo cannot allocate the data of the hand's model");
  mj_kinematics(&model, data.get());
  return data;
}

}  // namespace regrasp::kinematics
