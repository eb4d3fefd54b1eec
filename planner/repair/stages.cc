#include "planner/repair/stages.h"

#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "planner/object/limited_child.h"
#include "planner/object/polygon_soup.h"
#include "planner/repair/cgal_mesh.h"

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
  return {std::nullopt, "crashed or exceeded its memory limit"};
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

using object::PolygonSoup;

namespace {

std::vector<int> Numbers(std::size_t count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

PolygonSoup InCanonicalOrder(const PolygonSoup& soup) {
  std::vector<int> vertices = Numbers(soup.vertices.size());
  std::ranges::stable_sort(vertices, {}, [&](int v) {
    const Eigen::Vector3d& p = soup.vertices[v];
    return std::tuple(p.x(), p.y(), p.z());
  });
  PolygonSoup ordered;
  ordered.unit = soup.unit;
  std::vector<int> number(vertices.size());
  for (const int v : vertices) {
    number[v] = static_cast<int>(ordered.vertices.size());
    ordered.vertices.push_back(soup.vertices[v]);
  }
  std::vector<std::vector<int>> renumbered;
  for (std::vector<int> facet : soup.facets) {
    for (int& v : facet) v = number[v];
    std::ranges::rotate(facet, std::ranges::min_element(facet));
    renumbered.push_back(std::move(facet));
  }
  std::vector<int> facets = Numbers(soup.facets.size());
  std::ranges::stable_sort(
      facets, {}, [&](int f) -> const auto& { return renumbered[f]; });
  for (const int f : facets) {
    ordered.facets.push_back(renumbered[f]);
    if (!soup.filled.empty()) ordered.filled.push_back(soup.filled[f]);
  }
  return ordered;
}

}  // namespace regrasp::repair
