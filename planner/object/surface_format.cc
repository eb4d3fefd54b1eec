#include "planner/object/surface_format.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "planner/base/error.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

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

}  // namespace regrasp::object
