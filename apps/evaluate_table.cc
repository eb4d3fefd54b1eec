#include "apps/evaluate_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "apps/evaluate_rows.h"

namespace regrasp::apps {

namespace {

void CountReport(const GraspRow& row, EvaluateCounts& counts) {
  const std::size_t claim = row.claimed ? (*row.claimed ? 0 : 1) : 2;
  const auto measured = [](const std::string& verdict) { return verdict == "pass" ? 0 : 1; };
  ++counts.by_object[row.object].counts[claim][measured(row.verdict)];
  if (!row.hand.empty()) ++counts.by_hand[row.hand].counts[claim][measured(row.verdict)];
  for (std::size_t i = 0; i < kProtocolNames.size(); ++i) {
    const std::string& verdict = row.results[i].verdict;
    if (verdict.empty()) continue;
    ++counts.by_protocol[std::string(kProtocolNames[i])].counts[claim][measured(verdict)];
  }
  if (!row.reason.empty()) ++counts.by_reason[row.reason];
}

/// Names of the claims, in the order of Confusion.
constexpr std::array kClaims = {"claimed success", "claimed failure", "no claim"};

/// Return a confusion table: a row per name, and two columns per claim that a grasp makes.
/// @returns no rows if there are no names.
std::vector<TextRow> ConfusionTable(const std::string& title,
                                    const std::map<std::string, EvaluateCounts::Confusion>& by) {
  if (by.empty()) return {};
  std::vector<TextRow> rows = {{title}};
  for (const auto& [name, confusion] : by) rows.push_back({name});
  for (std::size_t claim = 0; claim < kClaims.size(); ++claim) {
    const auto has_claim = [&](const auto& row) {
      const auto& counts = row.second.counts[claim];
      return counts[0] > 0 || counts[1] > 0;
    };
    if (std::ranges::none_of(by, has_claim)) continue;
    rows[0].push_back(std::string(kClaims[claim]) + ": pass");
    rows[0].push_back("fail");
    std::size_t row = 1;
    for (const auto& [name, confusion] : by) {
      for (const std::int64_t count : confusion.counts[claim]) {
        rows[row].push_back(std::to_string(count));
      }
      ++row;
    }
  }
  return rows;
}

}  // namespace

EvaluateCounts ReadEvaluateCounts(const std::filesystem::path& path) {
  EvaluateCounts counts;
  ReadGraspRows(path, [&](const GraspRow& row) {
    if (row.verdict == "pass" || row.verdict == "fail") CountReport(row, counts);
  });
  return counts;
}

std::vector<std::vector<TextRow>> EvaluateTables(const EvaluateCounts& counts) {
  std::vector<TextRow> reasons = {{"reason", "grasps"}};
  for (const auto& [reason, count] : counts.by_reason) {
    reasons.push_back({reason, std::to_string(count)});
  }
  if (reasons.size() == 1) reasons.clear();
  std::vector<std::vector<TextRow>> tables = {
      reasons, ConfusionTable("protocol", counts.by_protocol),
      ConfusionTable("object", counts.by_object), ConfusionTable("hand", counts.by_hand)};
  std::erase_if(tables, [](const std::vector<TextRow>& table) { return table.empty(); });
  return tables;
}

std::string FormatEvaluateTable(const EvaluateCounts& counts) {
  std::string text;
  for (const std::vector<TextRow>& table : EvaluateTables(counts)) text += FormatRows(table);
  return text;
}

}  // namespace regrasp::apps
