#include "planner/repair/run_stage.h"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <numeric>
#include <stdexcept>

#include "planner/object/limited_child.h"
#include "planner/object/polygon_soup.h"
#include "planner/repair/cgal_mesh.h"
#include "planner/repair/stages.h"

namespace regrasp::repair {

namespace {

constexpr std::size_t kMemoryBytes = std::size_t{8} << 30;
constexpr std::chrono::minutes kWallTime{10};

/// Serialize a result: one line of facts, then the surface.
std::string ToBytes(const StageResult& result) {
  return result.facts.dump() + '\n' + object::SoupToBytes(result.soup);
}

std::optional<StageResult> FromBytes(const std::string& bytes) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string::npos) return std::nullopt;
  auto soup = object::SoupFromBytes(std::string_view(bytes).substr(end + 1));
  if (!soup) return std::nullopt;
  return StageResult{*std::move(soup), ParseJson(bytes.substr(0, end), "facts of a stage")};
}

/// Run a stage in a new thread, whose heap is empty.
/// CGAL often orders equal elements by memory address. An empty heap makes these addresses ascend
/// in the same order in each run.
std::string WithItsOwnHeap(const std::function<StageResult()>& stage) {
  return std::async(std::launch::async, [&] { return ToBytes(stage()); }).get();
}

}  // namespace

StageRun RunStage(const std::function<StageResult()>& stage, const Deadline& deadline,
                  std::chrono::seconds processor) {
  deadline.Check();
  object::ChildLimits limits{
      .memory_bytes = kMemoryBytes, .processor = processor, .wall = kWallTime};
  if (const auto left = deadline.left()) {
    limits.wall = std::min(limits.wall, std::chrono::ceil<std::chrono::milliseconds>(*left));
  }
  const object::ChildResult run =
      object::RunInLimitedChild([&] { return WithItsOwnHeap(stage); }, limits);
  deadline.Check();
  switch (run.end) {
    case object::ChildEnd::kDone:
      if (auto result = FromBytes(run.bytes)) return {std::move(result), ""};
      return {std::nullopt, "terminated abnormally"};
    case object::ChildEnd::kThrew:
      return {std::nullopt, run.bytes};
    case object::ChildEnd::kTookTooLong:
      return {std::nullopt, "time limit reached"};
    case object::ChildEnd::kCrashed:
      break;
  }
  return {std::nullopt, "crashed or ran out of memory"};
}

StageResult TakePart(const object::PolygonSoup& soup, int part) {
  std::vector<Mesh> solids, cavities;
  for (Mesh& shell : PartsOf(MeshOf(soup))) {
    (VolumeOf(shell) > 0 ? solids : cavities).push_back(std::move(shell));
  }
  std::ranges::stable_sort(solids, std::ranges::greater(), VolumeOf);
  StageResult result;
  Json& shares = result.facts["volume_shares"] = Json::array();
  const double all =
      std::transform_reduce(solids.begin(), solids.end(), 0.0, std::plus(), VolumeOf);
  for (const Mesh& solid : solids) shares.push_back(VolumeOf(solid) / all);
  if (part > std::ssize(solids)) {
    throw std::runtime_error("no part " + std::to_string(part) + ", found " +
                             std::to_string(solids.size()));
  }
  Mesh taken = solids[part - 1];
  for (const Mesh& cavity : cavities) {
    if (IsInside(cavity, solids[part - 1])) CGAL::copy_face_graph(cavity, taken);
  }
  result.facts["taken"] = part;
  result.soup = SoupOf(taken);
  return result;
}

}  // namespace regrasp::repair
