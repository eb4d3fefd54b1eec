#include <memory>

#include "planner/base/file.h"
#include "planner/object/mesh_readers.h"
#include "planner/object/object.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "planner/object/read_with_assimp.h"
#include "planner/object/text_scanner.h"

namespace regrasp {

namespace {

PolygonSoup ReadSoup(const std::filesystem::path& path, const std::string& ending,
                     const std::string& bytes) {
  const std::string name = path.string();
  if (ending == ".obj") return ReadObj(bytes, name);
  if (ending == ".off") return ReadOff(bytes, name);
  if (ending == ".ply") return ReadPly(bytes, name);
  if (ending == ".stl") return ReadStl(bytes, name);
  return ReadWithAssimp(bytes, path);
}

}  // namespace

ObjectFile ReadObject(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  const std::string ending = LowerCase(path.extension().string());
  ObjectFile file{path.filename().string(), Sha256(bytes), nullptr};
  if (ending == ".wkt") {
    file.object = std::make_unique<Polygon>(Polygon::FromWkt(bytes, path.string()));
  } else {
    file.object = std::make_unique<Polyhedron>(
        Polyhedron::FromSoup(ReadSoup(path, ending, bytes), path.string()));
  }
  return file;
}

}  // namespace regrasp
