#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/polygon_soup.h"
#include "planner/object/read_object.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

namespace {

/// Ignored statements: they neither define a surface nor belong to one that is read.
constexpr auto kIgnored = std::to_array<std::string_view>(
    {"vt",    "vn",     "vp",     "cstype", "deg",    "bmat",       "step",     "p",
     "parm",  "trim",   "hole",   "scrv",   "sp",     "end",        "con",      "s",
     "mg",    "o",      "bevel",  "lod",    "usemap", "c_interp",   "d_interp", "ctech",
     "stech", "maplib", "usemtl", "mtllib", "res",    "shadow_obj", "trace_obj"});

/// Statements that define lines or curves. They are ignored if the file has polygons. Otherwise the
/// file is rejected, because its vertices are not a point cloud.
constexpr auto kCurves = std::to_array<std::string_view>({"l", "curv", "curv2", "cdc"});

/// Unsupported statements that define a surface: free-form surfaces, patches of old versions, other
/// files, and the output of other programs.
constexpr auto kOtherSurfaces =
    std::to_array<std::string_view>({"surf", "bsp", "bzp", "cdp", "call", "csh"});

bool IsOneOf(std::span<const std::string_view> statements, std::string_view statement) {
  return std::ranges::find(statements, statement) != statements.end();
}

/// Group of polygons that a repair added (repair/repair.h).
constexpr std::string_view kFilledGroup = "invented";

/// Read the first three numbers of a vertex; a weight or a colour may follow.
Eigen::Vector3d ReadObjVertex(TextScanner& scanner, std::size_t index) {
  const std::string what = "vertex " + std::to_string(index);
  Eigen::Vector3d vertex;
  for (double& x : vertex) {
    const auto word = scanner.NextOnLine();
    if (!word) scanner.Fail(what + ": expected three coordinates, found fewer");
    const auto value = ParseDouble(*word);
    if (!value) scanner.Fail(what + ": expected a finite number, found " + Quoted(*word));
    x = *value;
  }
  return vertex;
}

/// Read a corner as in the file: "7", "7/1", "7//3" or "-1/2/3".
long long ReadCorner(TextScanner& scanner, std::string_view word, std::size_t facet) {
  const auto index = ParseInteger(word.substr(0, word.find('/')));
  if (!index) {
    scanner.Fail("facet " + std::to_string(facet) + ": " +
                 "expected a corner such as 7, 7/1 or 7//3, found " + Quoted(word));
  }
  return *index;
}

/// Convert an index of the file; negative ones count back from the last vertex so far. The file may
/// refer to later vertices, so the upper bound is checked at the end.
int ResolveIndex(TextScanner& scanner, long long index, std::size_t vertices, std::size_t facet) {
  const auto count = static_cast<long long>(vertices);
  if (index != 0 && index >= -count && index <= std::numeric_limits<int>::max()) {
    return static_cast<int>(index > 0 ? index - 1 : count + index);
  }
  scanner.Fail("facet " + std::to_string(facet) + ": vertex index " + std::to_string(index) +
               " must be positive, at most the number of vertices, or negative, at least -" +
               std::to_string(count) + " (" + std::to_string(count) + " vertices precede it)");
}

void ReadObjFacet(TextScanner& scanner, bool filled, PolygonSoup& soup) {
  if (filled) soup.filled.resize(soup.facets.size());
  if (filled || !soup.filled.empty()) soup.filled.push_back(filled);
  std::vector<int>& facet = soup.facets.emplace_back();
  const std::size_t index = soup.facets.size() - 1;
  while (const auto word = scanner.NextOnLine()) {
    const long long corner = ReadCorner(scanner, *word, index);
    facet.push_back(ResolveIndex(scanner, corner, soup.vertices.size(), index));
  }
}

void CheckIndices(const PolygonSoup& soup, const std::string& name) {
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    for (const int index : soup.facets[f]) {
      if (index < std::ssize(soup.vertices)) continue;
      throw MeshError(MeshDefect::kIndexOutOfRange,
                      name + ": facet " + std::to_string(f) + ": vertex index " +
                          std::to_string(index + 1LL) + " must be at most " +
                          std::to_string(soup.vertices.size()) + ", the number of vertices");
    }
  }
}

}  // namespace

PolygonSoup ReadObj(std::string_view text, const std::string& name) {
  PolygonSoup soup;
  TextScanner scanner(TextOf(text, name), name);
  bool filled = false;
  std::string curve;  // first statement that defines a curve
  while (const auto statement = scanner.Next()) {
    if (*statement == "v") {
      soup.vertices.push_back(ReadObjVertex(scanner, soup.vertices.size()));
    } else if (*statement == "f") {
      ReadObjFacet(scanner, filled, soup);
    } else if (*statement == "g") {
      filled = scanner.NextOnLine() == kFilledGroup;
    } else if (IsOneOf(kCurves, *statement)) {
      if (curve.empty()) curve = *statement;
    } else if (IsOneOf(kOtherSurfaces, *statement)) {
      scanner.Fail("statement " + Quoted(*statement) + ": not supported, expected facets (\"f\")");
    } else if (!IsOneOf(kIgnored, *statement)) {
      scanner.Fail("expected a statement of OBJ, found " + Quoted(*statement));
    }
    scanner.SkipLine();
  }
  if (soup.facets.empty() && !curve.empty()) {
    throw InputError(name + ": statement " + Quoted(curve) +
                     ": not supported, expected facets (\"f\"), found curves only");
  }
  CheckIndices(soup, name);
  return soup;
}

}  // namespace regrasp::object
