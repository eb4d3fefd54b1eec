#include "planner/object/collada_check.h"

#include <algorithm>
#include <array>
#include <string>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/base/text_encoding.h"
#include "planner/object/text_scanner.h"
#include "planner/object/xml_scan.h"

namespace regrasp::object {

namespace {

/// Elements that assimp 5.2 ignores or converts to a different surface.
constexpr auto kMisread = std::to_array<std::string_view>(
    {"brep", "convex_mesh", "instance_controller", "lookat", "ph", "skew", "spline"});

/// Elements that refer to a surface by `url`.
constexpr auto kInstances = std::to_array<std::string_view>(
    {"instance_geometry", "instance_node", "instance_visual_scene"});

double UnitOfTag(const XmlTag& tag) {
  if (!tag.Find("meter")) return 1;  // the default
  const double metres = tag.Number("meter");
  if (metres > 0) return metres;
  throw InputError("unit: meter: expected a positive number, found " + FormatDouble(metres));
}

}  // namespace

std::optional<double> CheckCollada(std::string_view bytes) {
  std::optional<double> unit;
  ScanXml(TextOf(bytes, "document"), "", [&](const XmlTag& tag) {
    if (std::ranges::find(kMisread, tag.name()) != kMisread.end()) {
      throw InputError("element " + Quoted(tag.name()) + ": not supported");
    }
    if (std::ranges::find(kInstances, tag.name()) != kInstances.end()) {
      const std::string url = tag.Text("url");
      if (!url.starts_with('#')) {
        throw InputError("surface in another file, " + Quoted(url) +
                         ": not supported; help: convert the object to .glb or .ply");
      }
    }
    if (tag.name() != "unit") return;
    const double metres = UnitOfTag(tag);
    if (unit && *unit != metres) {
      throw InputError("unit: several, expected one, found " + FormatDouble(*unit) + " and " +
                       FormatDouble(metres) + " m");
    }
    unit = metres;
  });
  return unit;
}

}  // namespace regrasp::object
