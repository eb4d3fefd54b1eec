#include "apps/graph_text.h"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

#include "planner/base/number.h"
#include "planner/base/text_table.h"

namespace regrasp::apps {

namespace {

/// Format a table. Columns are as wide as their widest cell.
/// The first column is aligned to the left, all others to the right.
std::string FormatTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  std::ostringstream table;
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      table << (k == 0 ? std::left : std::right) << (k == 0 ? "" : "  ")
            << std::setw(static_cast<int>(widths[k])) << row[k];
    }
    table << '\n';
  }
  return table.str();
}

std::string QueryText(const planning::QuerySummary& queries) {
  const auto milliseconds = [](double seconds) { return FormatShort(1000 * seconds, 3); };
  return std::to_string(queries.connected) + " of " + std::to_string(queries.count) +
         " random queries joined, " + milliseconds(queries.shortest_seconds) + " to " +
         milliseconds(queries.longest_seconds) + " ms each, mean " +
         milliseconds(queries.mean_seconds) + " ms\n";
}

}  // namespace

Json GraphJson(const planning::GraphSummary& summary, double friction_angle) {
  Json types = Json::object();
  for (const planning::TypeSummary& type : summary.types) {
    types[type.name] = {{"candidates", type.candidates},
                        {"combinations", type.combinations},
                        {"vertices", type.vertices},
                        {"components", type.components}};
  }
  Json edges = Json::object();
  for (const auto& [name, count] : summary.edges) edges[name] = count;
  Json json = {
      {"format", "regrasp-graph"},
      {"version", 1},
      {"planner", summary.planner},
      {"friction", {{"half_angle_deg", Degrees(friction_angle)}}},
      {"faces", summary.faces},
      {"types", types},
      {"edges", edges},
      {"vertices", summary.vertices},
      {"components", summary.components},
      {"seconds", {{"vertices", summary.vertex_seconds}, {"edges", summary.edge_seconds}}}};
  if (summary.unclear) json["unclear"] = *summary.unclear;
  if (summary.clusters > 0) json["clusters"] = summary.clusters;
  if (summary.queries) {
    json["queries"] = {{"count", summary.queries->count},
                       {"connected", summary.queries->connected},
                       {"shortest_seconds", summary.queries->shortest_seconds},
                       {"longest_seconds", summary.queries->longest_seconds},
                       {"mean_seconds", summary.queries->mean_seconds}};
  }
  if (summary.sampling_share) {
    const planning::SamplingShare& share = *summary.sampling_share;
    json["compare"] = {{"combinations", share.quadruples},
                       {"found_combinations", share.found_quadruples},
                       {"links", share.links},
                       {"found_links", share.found_links}};
  }
  return json;
}

std::string GraphTable(const planning::GraphSummary& summary, const std::string& title) {
  const auto cell = [](std::int64_t count) { return std::to_string(count); };
  std::vector<std::vector<std::string>> types = {{"grasps", "#can", "#comb", "#vertex", "#CC"}};
  for (const planning::TypeSummary& type : summary.types) {
    types.push_back({type.name, cell(type.candidates), cell(type.combinations), cell(type.vertices),
                     cell(type.components)});
  }
  if (summary.types.size() > 1) {
    types.push_back({"all", "", "", cell(summary.vertices), cell(summary.components)});
  }
  std::vector<std::vector<std::string>> edges = {{"switches", "#edge"}};
  for (const auto& [name, count] : summary.edges) edges.push_back({name, cell(count)});
  const std::string queries = summary.queries ? QueryText(*summary.queries) : "";
  const std::string unclear = summary.unclear.value_or(0) > 0
                                  ? cell(*summary.unclear) + " decisions were too close to call\n"
                                  : "";
  return OneLine(title) + "\n\n" + FormatTable(types) + "\n" + FormatTable(edges) + "\nvertices " +
         FormatShort(summary.vertex_seconds, 3) + " s, edges " +
         FormatShort(summary.edge_seconds, 3) + " s\n" + unclear + queries;
}

std::string ShareText(const planning::SamplingShare& share) {
  const auto part = [](std::int64_t found, std::int64_t all) {
    const double percent =
        all == 0 ? 100 : 100.0 * static_cast<double>(found) / static_cast<double>(all);
    return std::to_string(found) + " of " + std::to_string(all) + " (" + FormatShort(percent, 3) +
           " %)";
  };
  return "of the direct graph sampling found " + part(share.found_quadruples, share.quadruples) +
         " combinations and " + part(share.found_links, share.links) + " links between them\n";
}

}  // namespace regrasp::apps
