#include "planner/object/read_object.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/object/assimp_scene.h"
#include "planner/object/object.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/object/reading.h"
#include "planner/object/surface_format.h"
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
    throw TimeUp(path.string() + ": time limit reached while reading it");
  }
}

ObjectFile ReadObject(const std::filesystem::path& path) { return ReadObject(path, Reading()); }

}  // namespace regrasp::object
