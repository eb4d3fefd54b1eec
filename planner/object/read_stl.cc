#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/object/mesh_readers.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

namespace {

constexpr std::size_t kHeaderBytes = 80 + 4;
constexpr std::size_t kNormalBytes = 12;
constexpr std::size_t kFacetBytes = 50;  // normal, three corners, two bytes of attributes

void AddTriangle(PolygonSoup& soup) {
  const int count = static_cast<int>(soup.vertices.size());
  soup.facets.push_back({count - 3, count - 2, count - 1});
}

PolygonSoup ReadText(std::string_view text, const std::string& name) {
  PolygonSoup soup;
  TextScanner scanner(text, name);
  while (const auto word = scanner.Next()) {
    // Several solids may follow each other; names may be missing or of several words.
    const std::string keyword = LowerCase(*word);
    if (keyword == "solid" || keyword == "endsolid") {
      scanner.SkipLine();
      continue;
    }
    if (keyword != "facet") scanner.Fail(Quoted(*word) + " where a facet should be");
    const std::string facet = "facet " + std::to_string(soup.facets.size());
    scanner.Expect("normal");
    scanner.SkipLine();  // nothing is built on it, and some exporters write NaN
    scanner.Expect("outer");
    scanner.Expect("loop");
    for (int k = 0; k < 3; ++k) {
      scanner.Expect("vertex");
      Eigen::Vector3d& vertex = soup.vertices.emplace_back();
      for (double& x : vertex) x = scanner.ReadDouble(facet);
    }
    scanner.Expect("endloop");
    scanner.Expect("endfacet");
    AddTriangle(soup);
  }
  return soup;
}

PolygonSoup ReadBinary(std::string_view bytes, std::size_t count, const std::string& name) {
  PolygonSoup soup;
  for (std::size_t f = 0; f < count; ++f) {
    const char* at = bytes.data() + kHeaderBytes + f * kFacetBytes + kNormalBytes;
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d& vertex = soup.vertices.emplace_back();
      for (double& x : vertex) {
        float value = 0;
        std::memcpy(&value, at, sizeof value);
        at += sizeof value;
        x = value;
        if (std::isfinite(value)) continue;
        throw InputError(name + ": facet " + std::to_string(f) + ": the coordinate " +
                         FormatDouble(x) + " is not finite");
      }
    }
    AddTriangle(soup);
  }
  return soup;
}

}  // namespace

PolygonSoup ReadStl(std::string_view bytes, const std::string& name) {
  // Binary headers may start with "solid" too: only the size tells for sure.
  std::uint32_t count = 0;
  if (bytes.size() >= kHeaderBytes) std::memcpy(&count, bytes.data() + 80, sizeof count);
  const std::size_t expected = kHeaderBytes + std::size_t{count} * kFacetBytes;
  if (bytes.size() == expected) return ReadBinary(bytes, count, name);
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start != std::string_view::npos && LowerCase(bytes.substr(start, 5)) == "solid") {
    return ReadText(bytes, name);
  }
  if (bytes.size() < kHeaderBytes) throw InputError(name + ": header: not an STL file");
  throw InputError(name + ": header: declares " + std::to_string(count) + " facets, " +
                   std::to_string(expected) + " bytes, but the file has " +
                   std::to_string(bytes.size()) + " bytes");
}

}  // namespace regrasp::object
