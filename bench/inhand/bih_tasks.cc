#include "bench/inhand/bih_tasks.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "bench/csv_table.h"
#include "planner/base/error.h"
#include "planner/base/file.h"

namespace regrasp::bench {
namespace {

using Eigen::Vector3d;

/// Prefix of object names, which distinguishes them from other objects of the same name.
constexpr char kPrefix[] = "bih-";

Eigen::Isometry3d ParsePose(const std::string& text, const std::string& place) {
  constexpr int kNumbers = 6;
  const std::vector<double> v = ParseNumbers(text, kNumbers, place);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      (Eigen::AngleAxisd(v[5], Vector3d::UnitZ()) * Eigen::AngleAxisd(v[4], Vector3d::UnitY()) *
       Eigen::AngleAxisd(v[3], Vector3d::UnitX()))
          .toRotationMatrix();
  pose.translation() = Vector3d(v[0], v[1], v[2]);
  return pose;
}

/// Return the file name of an object: "tuna_fish_can" for "Tuna fish can".
std::string FileNameOf(const std::string& object) {
  std::string name;
  for (const char c : object) {
    name += c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

/// Return the mesh file; empty if there is none.
std::filesystem::path MeshOf(const std::string& object, const std::filesystem::path& folder) {
  const std::string name = FileNameOf(object);
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string stem = FileNameOf(entry.path().stem().string());
    if (stem == name || stem.ends_with("_" + name)) found.push_back(entry.path());
  }
  return found.empty() ? "" : *std::ranges::min_element(found);
}

HandBody BodyOfFile(const std::string& name, const std::filesystem::path& path) {
  HandBody body{name, path.filename().string(), ReadFile(path), object::ReadObject(path), 1};
  if (body.file.object->dimension() != 3) throw InputError(path.string() + ": must be a solid");
  return body;
}

/// Set the motion of the object in the hand that corresponds to a motion of the palm.
void SetDisplacement(const Eigen::Isometry3d& palm, const Eigen::Isometry3d& palm_at_goal,
                     const Vector3d& centre, Task& task) {
  const Eigen::Isometry3d displacement = palm * palm_at_goal.inverse();
  const Eigen::AngleAxisd turn(displacement.linear());
  task.turn = {turn.axis(), turn.angle()};
  task.move_m = displacement * centre - centre;
}

}  // namespace

BihTasks ReadBih(const std::filesystem::path& sheet, const std::filesystem::path& meshes) {
  if (!std::filesystem::is_directory(meshes)) {
    throw InputError(meshes.string() + ": must be a folder of meshes");
  }
  const CsvTable table = CsvTable::Parse(ReadFile(sheet), sheet.string());
  BihTasks bih;
  std::map<std::string, int> counts;
  for (int i = 0; i < table.size(); ++i) {
    const std::string& object = table.At(i, "Object");
    if (object.empty()) continue;
    const std::string name = FileNameOf(object);
    if (++counts[name] == 1) {
      const std::filesystem::path mesh = MeshOf(object, meshes);
      if (mesh.empty()) {
        bih.without_mesh.push_back(object);
      } else {
        bih.bodies.push_back(BodyOfFile(kPrefix + name, mesh));
      }
    }
    const auto body = std::ranges::find(bih.bodies, kPrefix + name, &HandBody::name);
    if (body == bih.bodies.end()) continue;
    Task task;
    task.name = "bih/" + name + "/" + std::to_string(counts[name]);
    task.group = "bih";
    task.body = body->name;
    SetDisplacement(ParsePose(table.At(i, "Initial palm pose"), table.Place(i)),
                    ParsePose(table.At(i, "Desired palm pose"), table.Place(i)), body->centre(),
                    task);
    bih.tasks.push_back(std::move(task));
  }
  return bih;
}

}  // namespace regrasp::bench
