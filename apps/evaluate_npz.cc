#include "apps/evaluate_npz.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "planner/base/zip_archive.h"

namespace regrasp::apps {

namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

using Rows = std::vector<GraspRow>;

NpzArray TextArray(const char* name, const Rows& rows,
                   const std::function<std::string(const GraspRow&)>& text_of) {
  NpzArray array{.name = name, .shape = {rows.size()}};
  for (const GraspRow& row : rows) array.texts.push_back(text_of(row));
  return array;
}

NpzArray NumberArray(const char* name, const Rows& rows,
                     const std::function<std::optional<double>(const GraspRow&)>& number_of) {
  NpzArray array{.name = name, .shape = {rows.size()}};
  for (const GraspRow& row : rows) array.values.push_back(number_of(row).value_or(kNoNumber));
  return array;
}

/// Return the values of a protocol by direction (N, 6).
NpzArray DirectionArray(const char* name, const Rows& rows, std::size_t protocol) {
  NpzArray array{.name = name, .shape = {rows.size(), kDirections}};
  for (const GraspRow& row : rows) {
    for (const std::optional<double>& value : row.results[protocol].by_direction) {
      array.values.push_back(value.value_or(kNoNumber));
    }
  }
  return array;
}

/// Add the names of all links in contact (L), and their numbers of contacts (N, L).
void AddContacts(const Rows& rows, std::vector<NpzArray>& arrays) {
  std::set<std::string> names;
  for (const GraspRow& row : rows) {
    for (const auto& [link, count] : row.links) names.insert(link);
  }
  NpzArray contacts{.name = "contacts", .shape = {rows.size(), names.size()}};
  for (const GraspRow& row : rows) {
    for (const std::string& name : names) {
      const auto found = std::ranges::find(row.links, name, &std::pair<std::string, int>::first);
      contacts.values.push_back(found == row.links.end() ? 0 : found->second);
    }
  }
  arrays.push_back(
      {.name = "links", .shape = {names.size()}, .texts = {names.begin(), names.end()}});
  arrays.push_back(std::move(contacts));
}

/// Add the names of the tested protocols (P), and their verdicts and reasons (N, P).
void AddProtocols(const Rows& rows, std::vector<NpzArray>& arrays) {
  std::vector<std::size_t> tested;
  for (std::size_t i = 0; i < kProtocolNames.size(); ++i) {
    const auto is_tested = [&](const GraspRow& row) { return !row.results[i].verdict.empty(); };
    if (std::ranges::any_of(rows, is_tested)) tested.push_back(i);
  }
  NpzArray names{.name = "protocols", .shape = {tested.size()}};
  NpzArray verdicts{.name = "protocol_verdict", .shape = {rows.size(), tested.size()}};
  NpzArray reasons{.name = "protocol_reason", .shape = verdicts.shape};
  for (const std::size_t i : tested) names.texts.emplace_back(kProtocolNames[i]);
  for (const GraspRow& row : rows) {
    for (const std::size_t i : tested) {
      verdicts.texts.push_back(row.results[i].verdict);
      reasons.texts.push_back(row.results[i].reason);
    }
  }
  for (NpzArray* array : {&names, &verdicts, &reasons}) arrays.push_back(std::move(*array));
}

std::optional<double> NumberOfTruth(std::optional<bool> truth) {
  if (!truth) return std::nullopt;
  return *truth ? 1 : 0;
}

}  // namespace

std::string FormatGraspNpz(const Rows& rows) {
  // In the order of kProtocolNames.
  constexpr std::size_t kAnalytic = 0, kBench = 1, kFall = 2, kDisturbance = 3;
  std::vector<NpzArray> arrays = {
      NumberArray("index", rows,
                  [](const GraspRow& row) { return static_cast<double>(row.index); }),
      TextArray("id", rows, [](const GraspRow& row) { return row.id; }),
      TextArray("set", rows, [](const GraspRow& row) { return row.set; }),
      TextArray("object", rows, [](const GraspRow& row) { return row.object; }),
      NumberArray("scale", rows, [](const GraspRow& row) { return row.scale; }),
      TextArray("hand", rows, [](const GraspRow& row) { return row.hand; }),
      TextArray("verdict", rows, [](const GraspRow& row) { return row.verdict; }),
      NumberArray("passed", rows,
                  [](const GraspRow& row) { return row.verdict == "pass" ? 1.0 : 0.0; }),
      TextArray("reason", rows, [](const GraspRow& row) { return row.reason; }),
      TextArray("likely_cause", rows, [](const GraspRow& row) { return row.likely_cause; }),
      NumberArray("claimed", rows, [](const GraspRow& row) { return NumberOfTruth(row.claimed); }),
      NumberArray("score", rows, [](const GraspRow& row) { return row.score; }),
      NumberArray("distance_mm", rows, [](const GraspRow& row) { return row.distance_mm; }),
      NumberArray("penetration_mm", rows, [](const GraspRow& row) { return row.depth_mm(); }),
  };
  for (NpzArray& array : arrays) array.is_truth = array.name == "passed";
  AddContacts(rows, arrays);
  AddProtocols(rows, arrays);
  arrays.push_back(NumberArray("quality", rows,
                               [](const GraspRow& row) { return row.results[kAnalytic].quality; }));
  arrays.push_back(NumberArray("moved_mm", rows,
                               [](const GraspRow& row) { return row.results[kBench].moved_mm; }));
  arrays.push_back(NumberArray(
      "rotated_deg", rows, [](const GraspRow& row) { return row.results[kBench].rotated_deg; }));
  arrays.push_back(DirectionArray("held_s", rows, kFall));
  arrays.push_back(DirectionArray("resisted_N", rows, kDisturbance));
  return FormatNpz(arrays);
}

}  // namespace regrasp::apps
