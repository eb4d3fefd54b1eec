#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/read_object.h"
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
    // A file may contain several solids. Their names may be missing, have several words, or follow
    // the keyword without a blank.
    const std::string keyword = LowerCase(*word);
    if (keyword.starts_with("solid") || keyword.starts_with("endsolid")) {
      scanner.SkipLine();
      continue;
    }
    if (keyword != "facet") scanner.Fail("expected a facet, found " + Quoted(*word));
    const std::string facet = "facet " + std::to_string(soup.facets.size());
    scanner.Expect("normal");
    scanner.SkipLine();  // the normal is not used, and some exporters write NaN
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

/// Return the number of triangles in the header. @pre The header is complete.
std::size_t DeclaredFacets(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeaderBytes - sizeof count, sizeof count);
  return count;
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
        throw InputError(name + ": facet " + std::to_string(f) +
                         ": coordinates must be finite, found " + FormatDouble(x));
      }
    }
    AddTriangle(soup);
  }
  return soup;
}

/// Return the number of triangles of a binary file, if its size matches the header. Zero bytes
/// after the last triangle are padding.
std::optional<std::size_t> BinaryFacets(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes) return std::nullopt;
  const std::size_t end = kHeaderBytes + DeclaredFacets(bytes) * kFacetBytes;
  if (bytes.size() < end) return std::nullopt;
  const bool padded = bytes.find_first_not_of('\0', end) == std::string_view::npos;
  return padded ? std::optional(DeclaredFacets(bytes)) : std::nullopt;
}

/// Return whether the file is text. Binary headers may start with "solid", too, but only binary
/// files contain zero bytes.
bool IsText(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  return start != std::string_view::npos && LowerCase(text.substr(start, 5)) == "solid" &&
         text.find('\0') == std::string_view::npos;
}

}  // namespace

PolygonSoup ReadStl(std::string_view bytes, const std::string& name) {
  if (const auto facets = BinaryFacets(bytes)) return ReadBinary(bytes, *facets, name);
  const std::string_view text = TextOf(bytes, name);
  if (IsText(text)) return ReadText(text, name);
  if (bytes.size() < kHeaderBytes) throw InputError(name + ": header: not an STL file");
  const std::size_t facets = DeclaredFacets(bytes);
  throw InputError(name + ": size: wrong, expected " +
                   std::to_string(kHeaderBytes + facets * kFacetBytes) + " bytes for " +
                   std::to_string(facets) + " facets, found " + std::to_string(bytes.size()) +
                   " bytes");
}

}  // namespace regrasp::object
