#include <sstream>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"

namespace regrasp {
ObjectFile ReadObject(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  ObjectFile file{path.filename().string(), Sha256(bytes), nullptr};
  if (path.extension() == ".wkt") {
    file.object = std::make_unique<Polygon>(Polygon::FromWkt(bytes, path.string()));
    return file;
  }
  PolygonSoup soup;
  std::istringstream lines(bytes);
  lines.imbue(std::locale::classic());
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string key;
    words >> key;
    if (key == "v") {
      Eigen::Vector3d v;
      words >> v.x() >> v.y() >> v.z();
      soup.vertices.push_back(v);
    } else if (key == "f") {
      std::vector<int> facet;
      for (std::string word; words >> word;) facet.push_back(std::stoi(word) - 1);
      soup.facets.push_back(facet);
    }
  }
  file.object = std::make_unique<Polyhedron>(Polyhedron::FromSoup(soup, path.string()));
  return file;
}
}  // namespace regrasp
