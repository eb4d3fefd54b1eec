#include <limits>

#include "planner/base/file.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/read_object.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

namespace {

struct OffHeader {
  bool plain = true;  ///< vertices consist of three numbers only
  long long vertices = 0, facets = 0;
};

/// Return whether the format is [ST][C][N]OFF: texture coordinates, colours and normals after the
/// three numbers of a vertex. "4OFF" and "nOFF" have other dimensions.
bool IsKnownKind(const std::string& kind) {
  std::string_view rest = kind;
  for (const std::string_view prefix : {"st", "c", "n"}) {
    if (rest.starts_with(prefix)) rest.remove_prefix(prefix.size());
  }
  return rest == "off";
}

OffHeader ReadHeader(TextScanner& scanner) {
  OffHeader header;
  const std::string kind = LowerCase(scanner.Next().value_or(""));
  if (!IsKnownKind(kind))
    scanner.Fail("not an OFF file, expected \"off\" at the start, found " + Quoted(kind));
  header.plain = kind == "off";
  header.vertices = scanner.ReadInteger("the number of vertices");
  header.facets = scanner.ReadInteger("the number of facets");
  scanner.SkipLine();  // number of edges, which is ignored
  if (header.vertices < 0 || header.facets < 0)
    scanner.Fail("numbers of elements must not be negative");
  return header;
}

std::vector<int> ReadOffFacet(TextScanner& scanner, const OffHeader& header, long long facet) {
  const std::string what = "facet " + std::to_string(facet);
  const long long corners = scanner.ReadInteger(what);
  if (corners < 0) scanner.Fail(what + ": the number of corners must not be negative");
  std::vector<int> indices;
  for (long long k = 0; k < corners; ++k) {
    const long long index = scanner.ReadInteger(what);
    if (index < 0 || index >= header.vertices || index > std::numeric_limits<int>::max()) {
      scanner.Fail(what + ": vertex index " + std::to_string(index) +
                   " must be at least 0 and less than " + std::to_string(header.vertices) +
                   ", the number of vertices");
    }
    indices.push_back(static_cast<int>(index));
  }
  scanner.SkipLine();  // colour
  return indices;
}

}  // namespace

PolygonSoup ReadOff(std::string_view text, const std::string& name) {
  PolygonSoup soup;
  TextScanner scanner(TextOf(text, name), name);
  const OffHeader header = ReadHeader(scanner);
  for (long long v = 0; v < header.vertices; ++v) {
    Eigen::Vector3d& vertex = soup.vertices.emplace_back();
    for (double& x : vertex) x = scanner.ReadDouble("vertex " + std::to_string(v));
    if (!header.plain) scanner.SkipLine();
  }
  for (long long f = 0; f < header.facets; ++f) {
    soup.facets.push_back(ReadOffFacet(scanner, header, f));
  }
  if (const auto word = scanner.Next()) {
    scanner.Fail("expected the end of the file, found " + Quoted(*word));
  }
  return soup;
}

}  // namespace regrasp::object
