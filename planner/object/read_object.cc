#include "planner/object/read_object.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/object/assimp_scene.h"
#include "planner/object/object.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

namespace {

/// Read with assimp; the child process is killed at the deadline.
PolygonSoup ReadWithAssimp(const std::string& bytes, const std::filesystem::path& path,
                           const Deadline& deadline) {
  AssimpLimits limits;
  if (const auto left = deadline.left()) {
    limits.wall = std::min(limits.wall, std::chrono::ceil<std::chrono::milliseconds>(*left));
  }
  try {
    return ReadWithAssimp(bytes, path, limits);
  } catch (const InputError&) {
    deadline.Check();
    throw;
  }
}

PolygonSoup ParseSoup(const std::filesystem::path& path, const std::string& bytes,
                      const Deadline& deadline) {
  const std::string name = path.string();
  switch (FormatOf(path, bytes)) {
    case SurfaceFormat::kObj:
      return ReadObj(bytes, name);
    case SurfaceFormat::kOff:
      return ReadOff(bytes, name);
    case SurfaceFormat::kPly:
      return ReadPly(bytes, name);
    case SurfaceFormat::kStl:
      return ReadStl(bytes, name);
    case SurfaceFormat::kXyz:
      return ReadXyz(bytes, name);
    case SurfaceFormat::kPcd:
      return ReadPcd(bytes, name);
    default:
      return ReadWithAssimp(bytes, path, deadline);
  }
}

ObjectFile Read(const std::filesystem::path& path, const Reading& reading) {
  reading.Begin("reading " + path.string());
  std::string bytes = ReadFile(path);
  const std::string ending = LowerCase(path.extension().string());
  ObjectFile file{path.filename().string(), Sha256(bytes), nullptr};
  if (ending == ".wkt") {
    if (reading.shells) {
      throw InputError(path.string() + ": --shells cannot be used with a polygon");
    }
    file.object = std::make_unique<Polygon>(Polygon::FromWkt(bytes, path.string()));
  } else {
    const PolygonSoup soup = ParseSoup(path, bytes, reading.deadline);
    std::string().swap(bytes);  // frees memory while a large file is processed
    file.unit = soup.unit;
    file.object = std::make_unique<Polyhedron>(Polyhedron::FromSoup(soup, path.string(), reading));
  }
  reading.deadline.Check();
  return file;
}

}  // namespace

SoupFile ReadSoup(const std::filesystem::path& path, const Reading& reading) {
  reading.Begin("reading " + path.string());
  const std::string bytes = ReadFile(path);
  const std::string ending = LowerCase(path.extension().string());
  if (ending == ".wkt")
    throw InputError(path.string() + ": --repair cannot be used with a polygon");
  return {path.filename().string(), Sha256(bytes), ParseSoup(path, bytes, reading.deadline)};
}

ObjectFile ReadObject(const std::filesystem::path& path, const Reading& reading) {
  try {
    return Read(path, reading);
  } catch (const TimeUp&) {
    throw TimeUp(path.string() + ": time limit reached while reading");
  }
}

ObjectFile ReadObject(const std::filesystem::path& path) { return ReadObject(path, Reading()); }

namespace {

struct NamedFormat {
  std::string_view ending;
  SurfaceFormat format;
};

constexpr auto kByEnding = std::to_array<NamedFormat>({{".obj", SurfaceFormat::kObj},
                                                       {".off", SurfaceFormat::kOff},
                                                       {".ply", SurfaceFormat::kPly},
                                                       {".stl", SurfaceFormat::kStl},
                                                       {".xyz", SurfaceFormat::kXyz},
                                                       {".pwn", SurfaceFormat::kXyz},
                                                       {".pcd", SurfaceFormat::kPcd},
                                                       {".3mf", SurfaceFormat::k3mf},
                                                       {".gltf", SurfaceFormat::kGltf},
                                                       {".glb", SurfaceFormat::kGltf},
                                                       {".dae", SurfaceFormat::kCollada},
                                                       {".fbx", SurfaceFormat::kFbx}});

struct FormatStart {
  std::string_view bytes;
  SurfaceFormat format;
};

/// First bytes of files of a format.
constexpr auto kByStart = std::to_array<FormatStart>({{"ply\n", SurfaceFormat::kPly},
                                                      {"ply\r", SurfaceFormat::kPly},
                                                      {"glTF", SurfaceFormat::kGltf},
                                                      {"{", SurfaceFormat::kGltf},
                                                      {"PK\x03\x04", SurfaceFormat::k3mf},
                                                      {"Kaydara FBX", SurfaceFormat::kFbx},
                                                      {"; FBX", SurfaceFormat::kFbx},
                                                      {"<?xml", SurfaceFormat::kCollada},
                                                      {"<COLLADA", SurfaceFormat::kCollada},
                                                      {"solid", SurfaceFormat::kStl},
                                                      {"OFF", SurfaceFormat::kOff},
                                                      {"COFF", SurfaceFormat::kOff},
                                                      {"NOFF", SurfaceFormat::kOff},
                                                      {"#", SurfaceFormat::kObj},
                                                      {"v ", SurfaceFormat::kObj},
                                                      {"o ", SurfaceFormat::kObj},
                                                      {"g ", SurfaceFormat::kObj},
                                                      {"mtllib ", SurfaceFormat::kObj}});

}  // namespace

SurfaceFormat FormatOf(const std::filesystem::path& path, std::string_view bytes) {
  const std::string ending = LowerCase(path.extension().string());
  const auto by_ending = std::ranges::find(kByEnding, ending, &NamedFormat::ending);
  if (by_ending != kByEnding.end()) return by_ending->format;
  if (ending.empty()) {
    constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
    if (bytes.starts_with(kUtf8Mark)) bytes.remove_prefix(kUtf8Mark.size());
    const auto by_start = std::ranges::find_if(
        kByStart, [&](const FormatStart& start) { return bytes.starts_with(start.bytes); });
    if (by_start != kByStart.end()) return by_start->format;
  }
  std::string expected;
  for (const NamedFormat& format : kByEnding) expected += std::string(format.ending) + ", ";
  throw InputError(path.string() + ": format: not supported, expected " + expected +
                   "or .wkt, found " +
                   (ending.empty() ? "a file without an ending" : Quoted(ending)) +
                   "; help: convert the file to .ply or .glb");
}

std::vector<Eigen::Vector3d> ReadGivenPoints(const std::filesystem::path& path,
                                             const Reading& reading) {
  return ReadSoup(path, reading).soup.vertices;
}

const Eigen::Vector3d& NearestPoint(std::span<const Eigen::Vector3d> points,
                                    const Eigen::Vector3d& place) {
  return *std::ranges::min_element(
      points, {}, [&](const Eigen::Vector3d& point) { return (point - place).squaredNorm(); });
}

}  // namespace regrasp::object
