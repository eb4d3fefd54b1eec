#include "planner/repair/run_stage.h"

#include <algorithm>
#include <chrono>

#include "planner/object/limited_child.h"
#include "planner/object/soup_bytes.h"

namespace regrasp::repair {

namespace {

/// A stage takes seconds on a scan, a minute on a million facets.
constexpr object::ChildLimits kLimits{.memory_bytes = std::size_t{8} << 30,
                                      .processor = std::chrono::seconds(300),
                                      .wall = std::chrono::minutes(10)};

/// The facts in one line, then the surface.
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

}  // namespace

StageRun RunStage(const std::function<StageResult()>& stage, const Deadline& deadline) {
  deadline.Check();
  object::ChildLimits limits = kLimits;
  if (const auto left = deadline.left()) {
    limits.wall = std::min(limits.wall, std::chrono::ceil<std::chrono::milliseconds>(*left));
  }
  const object::ChildResult run =
      object::RunInLimitedChild([&] { return ToBytes(stage()); }, limits);
  deadline.Check();
  switch (run.end) {
    case object::ChildEnd::kDone:
      if (auto result = FromBytes(run.bytes)) return {std::move(result), ""};
      return {std::nullopt, "it did not come to its end"};
    case object::ChildEnd::kThrew:
      return {std::nullopt, run.bytes};
    case object::ChildEnd::kTookTooLong:
      return {std::nullopt, "it took longer than allowed"};
    case object::ChildEnd::kCrashed:
      break;
  }
  return {std::nullopt, "it crashed or ran out of memory"};
}

}  // namespace regrasp::repair
